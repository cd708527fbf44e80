// Light from behind that comes through thin crests.

// Mean cosine of scattering in a crest: less than the particles' 0.9, because light is scattered several times.
const WATER_CREST_MEAN_COSINE = 0.6;
// Wave number of the waves that sharpen a crest, in reciprocals of the significant wave height.
const WATER_CREST_WAVE_NUMBER = 2.0;
// Path through a broad crest, m: light that enters through its top meets the ray to the eye sooner than at its far end.
const WATER_CREST_LONGEST_M = 2.0;
// Share of a crest, as below, up to which no light is drawn through it.
const WATER_CREST_LEAST_SHARE = 0.08;

// How much more light comes through the steep wall of water before a breaker at a coast.
const WATER_CREST_SURF = 8.0;

// A crest in front of the sun.
struct WaterCrest {
  // How high and steep the crest is, from 0 where no light comes through it to 1.
  share: f32,
  // Length of the path of light through the crest, m.
  path_m: f32,
}

// The crest that the refracted ray `ray` passes through from a point `height_m` above the mean level with the slope
// `slope`. The crest is a parabola. Its curvature is the product of a wave number and the steepness of the waves there,
// by which they have compressed the surface: 1 - jacobian.
fn water_crest(ray: vec3f, slope: vec2f, height_m: f32, jacobian: f32) -> WaterCrest {
  let steepness = 1.0 - jacobian;
  let hs_m = max(frame.hs_m, 0.05);
  let share = maths_smooth(2.4 * height_m / hs_m) * maths_smooth(0.35 + 1.3 * steepness);
  if share <= WATER_CREST_LEAST_SHARE {
    return WaterCrest();
  }
  // The water over the ray gains depth at first, and loses it with the curvature.
  let depth_gain = max(dot(slope, ray.xz) - ray.y, 0.0);
  let curving = WATER_CREST_WAVE_NUMBER * max(0.1 + 0.6 * steepness, 0.1) * max(dot(ray.xz, ray.xz), 0.05);
  let chord_m = 2.0 * depth_gain * hs_m / curving;
  return WaterCrest(share - WATER_CREST_LEAST_SHARE, chord_m / (1.0 + chord_m * (1.0 / WATER_CREST_LONGEST_M)));
}

// Fraction of the light behind a crest that comes through it scattered.
fn water_crest_transmittance(path_m: f32, jacobian: f32, plume: f32) -> vec3f {
  // A crest that is about to break draws in air.
  let air = clamp(0.9 - jacobian, 0.0, 0.7);
  let bubbles = water_bubble_backscatter(plume) + WATER_PLUME_BACKSCATTER * material.bubble_density * air;
  let extinction = material.absorption + material.backscatter + bubbles;
  // Bubbles scatter mostly forward, too, and light that is scattered twice still gets through.
  let forward = material.scattering + 12.0 * bubbles * material.bubble_colour;
  return exp(-extinction * path_m) * (1.0 - exp(-forward * path_m));
}

// Light through the back of a crest towards the eye, against the refracted ray `ray`.
fn water_crest_radiance(n: vec3f, ray: vec3f, slope: WaterSlope, height_m: f32, plume: f32) -> vec3f {
  let crest = water_crest(ray, slope.mean, height_m, slope.jacobian);
  if crest.share == 0.0 || frame.sun_direction.y <= -0.02 {
    return vec3f(0.0);
  }
  // The far side of the crest slopes the opposite way.
  let back = vec3f(-n.x, n.y, -n.z);
  let entry = max(dot(back, frame.sun_direction), 0.0);
  let beam = water_refract(-frame.sun_direction, back);
  let phase = atm_henyey_greenstein(dot(beam, -ray), WATER_CREST_MEAN_COSINE);
  let through = water_crest_transmittance(crest.path_m, slope.jacobian, plume);
  let sun = cloud_sun_irradiance() * (entry * (1.0 - water_fresnel(entry)) * phase);
  // The bright sky behind the crest shines through it, too.
  let sky = light.sky_irradiance * (0.25 / ATM_PI * saturate(1.0 + ray.y));
  var share = material.crest_transmission * crest.share;
  if WATER_COAST {
    // The wall is thin only below the lip.
    let lip = maths_smooth(1.5 * height_m / max(frame.hs_m, 0.05) - 0.4);
    share *= 1.0 + WATER_CREST_SURF * lip * maths_smooth(2.5 * (0.8 - slope.jacobian));
  }
  return (sun + sky) * through * share;
}
