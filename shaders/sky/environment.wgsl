// Environment map for reflected rays, azimuth by elevation: the sky without the sun's disc, behind fog if there is any,
// and below the horizon an estimate of the sea.

@group(0) @binding(0) var<uniform> sky: Sky;
@group(0) @binding(1) var<storage, read> light: Light;
@group(0) @binding(2) var sky_view_map: texture_2d<f32>;
@group(0) @binding(3) var sky_sampler: sampler;
@group(0) @binding(4) var noise_map: texture_2d_array<f32>;
@group(0) @binding(5) var noise_sampler: sampler;
// The sky from a file without its sun.
@group(0) @binding(6) var image_map: texture_2d<f32>;
@group(0) @binding(7) var<uniform> clouds: Clouds;
@group(0) @binding(8) var dome_map: texture_2d_array<f32>;
@group(0) @binding(9) var environment_out: texture_storage_2d<rgba16float, write>;

// Radiance of the sky with volumetric clouds at this azimuth and elevation.
fn environment_cloudy_point(azimuth: f32, above: f32) -> vec3f {
  let dir = vec3f(sin(azimuth) * cos(above), sin(above), -cos(azimuth) * cos(above));
  let clear = mix(sky_clear_radiance(dir, above), sky_overcast_radiance(above), sky.overcast * sky.overcast);
  let uv = cloud_map_uv(dir.xz, above, vec2f(textureDimensions(dome_map)), clouds.new_ahead);
  let dome = textureSampleLevel(dome_map, sky_sampler, uv, clouds.new_layer, 0.0);
  return clear * dome.a + dome.rgb;
}

// Mean radiance of the sky with volumetric clouds over a texel of the environment map, `pixel` rad wide and high around
// this azimuth and elevation. It takes many samples, because the dome has finer texels in the direction of the view.
fn environment_cloudy_radiance(azimuth: f32, above: f32, pixel: f32) -> vec3f {
  const SIDE = 4;
  var sum = vec3f(0.0);
  for (var i = 0; i < SIDE * SIDE; i++) {
    let off = (vec2f(f32(i % SIDE), f32(i / SIDE)) + 0.5) / f32(SIDE) - 0.5;
    let high = clamp(above + pixel * off.y, 0.0, 0.5 * ATM_PI);
    sum += environment_cloudy_point(azimuth + pixel * off.x, high);
  }
  return sum / f32(SIDE * SIDE);
}

// Half of the side of the square around the sun that environment_sunlit covers, rad.
const ENVIRONMENT_SUN_RAD = 0.04;

// Fraction of the sunlight that volumetric clouds let through to the sea below the eye, averaged over directions around
// the sun.
fn environment_sunlit() -> f32 {
  if sky.has_cloud_dome <= 0.0 {
    return 1.0;
  }
  const SIDE = 4;
  let sun = sky.sun_direction;
  let above = atm_asin(sun.y);
  var sum = 0.0;
  for (var i = 0; i < SIDE * SIDE; i++) {
    let off = ENVIRONMENT_SUN_RAD * ((2.0 * vec2f(f32(i % SIDE), f32(i / SIDE)) + 1.0) / f32(SIDE) - 1.0);
    let heading = vec2f(sun.x - off.x * sun.z, sun.z + off.x * sun.x);
    let uv = cloud_map_uv(heading, max(above + off.y, 0.0), vec2f(textureDimensions(dome_map)), clouds.new_ahead);
    sum += textureSampleLevel(dome_map, sky_sampler, uv, clouds.new_layer, 0.0).a;
  }
  return sum / f32(SIDE * SIDE);
}

// Elevation at which the radiance of the sky, averaged over its azimuths, is about its irradiance on the sea over pi, rad.
const ENVIRONMENT_MEAN_ELEVATION = 0.75;

// Irradiance of the sea by the sky with its clouds, which has not been measured yet.
fn environment_sky_irradiance() -> vec3f {
  if sky.has_cloud_dome <= 0.0 {
    return mix(light.clear_sky_irradiance, ATM_PI * sky_deck_radiance(), sky.overcast * sky.overcast);
  }
  const SIDES = 8;
  let sun = sky_azimuth_turns(sky.sun_heading);
  var sum = vec3f(0.0);
  for (var i = 0; i < SIDES; i++) {
    let azimuth = 2.0 * ATM_PI * (sun + (f32(i) + 0.5) / f32(SIDES));
    sum += environment_cloudy_point(azimuth, ENVIRONMENT_MEAN_ELEVATION);
  }
  return sum * (ATM_PI / f32(SIDES));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = vec2f(textureDimensions(environment_out));
  let at = (vec2f(id.xy) + 0.5) / size;
  let azimuth = 2.0 * ATM_PI * at.x;
  let elevation = (at.y - 0.5) * ATM_PI;
  let pixel = ATM_PI / size.y;
  let heading = vec2f(sin(azimuth), -cos(azimuth));
  var above = elevation;
  var gain = vec3f(1.0);
  var own = vec3f(0.0);
  if elevation < 0.0 {
    // Rays below the horizon meet another wave: it shows the sky from higher up, dimmed, and some water colour.
    above = min(0.25 - elevation, 1.5);
    let f = 0.02 + 0.98 * pow(1.0 - sin(above), 5.0);
    gain = vec3f(f);
    let on_sea = light.sun_irradiance * light.cloud_sun_transmittance;
    let from_sky = environment_sky_irradiance();
    own = (from_sky + on_sea * max(sky.sun_direction.y, 0.0)) * vec3f(0.0012, 0.0045, 0.0085);
  }
  let dir = vec3f(heading.x * cos(above), sin(above), heading.y * cos(above));
  var radiance = vec3f(0.0);
  if sky.has_image > 0.0 {
    radiance = sky.image_gain * textureSampleLevel(image_map, sky_sampler, sky_image_uv(dir), 0.0).rgb;
  } else if sky.has_cloud_dome > 0.0 {
    radiance = environment_cloudy_radiance(azimuth, above, pixel);
  } else {
    radiance = sky_radiance(dir, above, pixel, sky.reflected_cloud_drift_km).rgb;
  }
  if sky.fog.extinction_per_m > 0.0 {
    radiance = mix(fog_radiance(dir, environment_sunlit()), radiance, fog_transmittance(0.0, dir.y, 0.0, FOG_FAR_M));
  }
  textureStore(environment_out, id.xy, vec4f(min(radiance * gain + own, vec3f(6e4)), 1.0));
}
