// Light of air and fog between eye and sea. Needs the module variables frame, sky, light, clouds and those of the sky
// model, and the functions of cloud_sun.wgsl.

// Features that are compiled in: a sky from an image file instead of the computed one, and fog.
override SKY_IMAGE = true;
override SKY_FOG = true;

// Radiance of a sky from a file just above the horizon in this direction. Distant air takes its colour from it.
fn air_horizon_radiance(dir: vec3f) -> vec3f {
  let u = sky_azimuth_turns(dir.xz);
  return textureSampleLevel(environment_map, sky_sampler, vec2f(u, 0.5 + 1.5 / 128.0), 1.0).rgb;
}

// Clear air between the eye and a point of the sea: the radiance that it adds, and its transmittance.
fn air_clear_on_ray(dir: vec3f, distance_m: f32) -> array<vec3f, 2> {
  let km = 0.001 * distance_m;
  let extinction =
    ATM_RAYLEIGH_SCATTERING * frame.mean_air_density.x + ATM_AEROSOL_EXTINCTION * (sky.haze * frame.mean_air_density.y);
  let salt = frame.salt_extinction_per_km;
  let through = atm_linear_srgb(exp(-(extinction + salt) * km)) * ATM_INVERSE_SUN;
  if SKY_IMAGE && sky.has_image > 0.0 {
    return array<vec3f, 2>(air_horizon_radiance(dir) * (1.0 - through), through);
  }
  // The look-up table holds the light of the air down to the still sea. A wave crest has less air in front of it.
  // A polynomial that is within 0.001 rad of the arc sine down to 30 degrees below the horizontal. Steeper rays pass
  // through little air.
  let sine_square = dir.y * dir.y;
  let elevation = dir.y * (1.0 + sine_square * (1.0 / 6.0 + sine_square * (0.075 + sine_square * 0.12)));
  let below = min(elevation + frame.horizon_dip, -1e-5);
  // The dip is so small that it equals its sine.
  let dip = frame.horizon_dip;
  let fall = max(-dir.y, dip);
  // At the horizon, a fused multiply-add can make the difference of two equal squares negative.
  let root = max(fall * fall - dip * dip, 0.0);
  let whole_km = ATM_EARTH_RADIUS_KM * (fall - sqrt(root));
  // The tables hold no sea salt. It counts only on the way to the point, so the share may exceed 1. One wavelength
  // stands for all.
  let opacities = 1.0 - exp(-vec2f((extinction.y + salt) * km, extinction.y * whole_km));
  let share = opacities.x / max(opacities.y, 1e-6);
  var clear = sky_clear_radiance(dir, below) * share;
  let grey = sky_overcast_horizon_radiance() * (1.0 - through);
  if SKY_CLOUD_SHADOWS {
    clear = sky_shaded_air(clear, grey);
  }
  return array<vec3f, 2>(mix(clear, grey, sky.overcast * sky.overcast), through);
}

// Height up to which sunlit rain shows its bow before the sky, m.
const AIR_RAIN_COLUMN_M = 800.0;

// Radiance of the rainbow on a ray of the slope `mu`, through fog and rain of the transmittance `through`. The light
// comes in along the ray and goes back, so it passes rain twice. Before the sky, rain counts up to the clouds from which
// it falls; the layer of fog that hides distant water ends lower.
fn air_rainbow(dir: vec3f, mu: f32, through: f32, is_sky: bool) -> vec3f {
  var path_m = -log(max(through, 1e-6)) / sky.fog.extinction_per_m;
  if is_sky {
    path_m = max(path_m, max(AIR_RAIN_COLUMN_M - frame.eye_height_m, 0.0) / max(mu, 0.02));
  }
  // Half of the extinction by drops is light that they diffract, which hardly turns: it is not lost.
  let there_and_back = 2.0 * sky.fog.extinction_per_m - sky.rain_extinction_per_m;
  let opacity = 0.5 * sky.rain_extinction_per_m / there_and_back * (1.0 - exp(-there_and_back * path_m));
  // The sun above the rain: the way through it is counted here.
  let sun = light.sun_irradiance * (light.cloud_sun_transmittance * opacity * light.sun_above_fog);
  return sun * rainbow_phase(dot(dir, sky.sun_direction));
}

// Fraction of the sunlight that clouds let through to the fog on a ray with the transmittance `through`: to a point at
// the mean distance of the light that the fog adds, averaged over the way there.
fn air_sunlit_fog(dir: vec3f, through: f32) -> f32 {
  let depth = clamp(-log(max(through, 1e-6)), 1e-3, 10.0);
  let distance_m = sky.fog.start_m + (1.0 - depth / (exp(depth) - 1.0)) / sky.fog.extinction_per_m;
  // The beam that lights that point meets the sea here. Towards the sun, this is near the point below the eye.
  let sun = frame.sun_direction;
  let height_m = max(frame.eye_height_m + distance_m * dir.y, 0.0);
  let place = distance_m * dir.xz - sun.xz * (height_m / max(sun.y, SKY_LOWEST_BEAM));
  return cloud_sun_transmittance(place, log2(max(length(place), 1.0)));
}

// Fog and rain on a ray, with the rainbow, and the clear air before them: the radiance that they add (rgb), and the
// transmittance of fog and rain (w).
fn air_fog_on_ray(dir: vec3f, distance_m: f32) -> vec4f {
  // A ray that ends in the sky does not go below the horizon.
  let mu = select(dir.y, max(dir.y, -sin(frame.horizon_dip)), distance_m >= FOG_FAR_M);
  let through = fog_transmittance(frame.eye_height_m, mu, sky.fog.start_m, distance_m);
  var sunlit = 1.0;
  if clouds.height_km > 0.0 {
    sunlit = air_sunlit_fog(dir, through);
  }
  var radiance = fog_radiance(dir, sunlit);
  // Seen from above, the fog lies at the far end of the ray, behind clear air.
  let over = frame.eye_height_m - sky.fog.top_m - sky.fog.scale_height_m;
  if over > 0.0 && mu < 0.0 {
    let root = sqrt(max(mu * mu - 2.0 * over / FOG_EARTH_RADIUS_M, 0.0));
    let air = air_clear_on_ray(dir, min(2.0 * over / (root - mu), distance_m));
    radiance = air[0] + air[1] * radiance;
  }
  var bow = vec3f(0.0);
  if sky.rain_extinction_per_m > 0.0 {
    bow = air_rainbow(dir, mu, through, distance_m >= FOG_FAR_M);
  }
  return vec4f(radiance * (1.0 - through) + bow, through);
}

// Air and fog between the eye and a point of the sea: the radiance that they add, and their transmittance.
fn air_to_point(dir: vec3f, distance_m: f32) -> array<vec3f, 2> {
  var air = air_clear_on_ray(dir, distance_m);
  if SKY_FOG {
    if sky.fog.extinction_per_m > 0.0 {
      let fog = air_fog_on_ray(dir, distance_m);
      air = array<vec3f, 2>(air[0] * fog.w + fog.rgb, air[1] * fog.w);
    }
  }
  return air;
}
