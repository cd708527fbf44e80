// Irradiances and exposure. `clear_irradiance` runs before the environment map is made: it measures the cloudless sky,
// from which overcast clouds take their brightness. `sky_irradiance` runs afterwards and measures the sky with clouds
// and fog. Before each, 256 threads sum parts of the sky (`clear_irradiance_parts`, `sky_irradiance_parts`); then one
// thread adds these sums. Barriers instead of two dispatches would be slow on software GPUs, above all to compile.

@group(0) @binding(0) var<uniform> sky: Sky;
@group(0) @binding(1) var<storage, read_write> light: Light;
@group(0) @binding(2) var transmittance_map: texture_2d<f32>;
@group(0) @binding(3) var sky_view_map: texture_2d<f32>;
@group(0) @binding(4) var sky_sampler: sampler;
@group(0) @binding(5) var environment_map: texture_2d<f32>;
// The sunlight between volumetric clouds.
@group(0) @binding(6) var cloud_shadow_map: texture_2d<f32>;
@group(0) @binding(7) var<storage, read_write> light_parts: array<vec4f, 256>;

const LIGHT_THREADS = 256u;

fn light_sum_of_parts() -> vec4f {
  var total = vec4f(0.0);
  for (var i = 0u; i < LIGHT_THREADS; i++) {
    total += light_parts[i];
  }
  return total;
}

@compute @workgroup_size(64)
fn clear_irradiance_parts(@builtin(global_invocation_id) id: vec3u) {
  let thread = id.x;
  var sum = vec4f(0.0);
  for (var i = thread; i < 2048u; i += LIGHT_THREADS) {
    let azimuth = 2.0 * ATM_PI * (f32(i % 64u) + 0.5) / 64.0;
    // The samples have equal steps in the square of the sine of elevation, so that each has the same irradiance weight.
    let s = sqrt((f32(i / 64u) + 0.5) / 32.0);
    let dir = vec3f(sin(azimuth) * sqrt(1.0 - s * s), s, -cos(azimuth) * sqrt(1.0 - s * s));
    sum += vec4f(sky_clear_radiance(dir, atm_asin(s)), 0.0) * (ATM_PI / 2048.0);
  }
  light_parts[thread] = sum;
}

@compute @workgroup_size(1)
fn clear_irradiance() {
  let total = light_sum_of_parts();
  let through = atm_transmittance(transmittance_map, sky_sampler, 0.0, sky.sun_direction.y, sky.sun_radius_rad);
  var beam = atm_linear_srgb(through) * sky.sun_tint;
  var diffuse = total.rgb;
  if sky.has_image > 0.0 {
    beam = sky.image_sun_irradiance;
    diffuse = sky.image_sky_irradiance;
  }
  let high = max(sky.sun_direction.y, 0.0);
  let globally = diffuse + beam * high;
  light.cloud_sun_transmittance = 1.0;
  light.cloud_gap_share = 1.0;
  if sky.has_cloud_dome > 0.0 {
    // The last mip level holds the means.
    let means = textureLoad(cloud_shadow_map, vec2u(0u), textureNumLevels(cloud_shadow_map) - 1u);
    light.cloud_sun_transmittance = means.r;
    light.cloud_gap_share = means.g;
  }
  light.sun_irradiance = beam * pow(1.0 - sky.overcast, 1.5);
  light.sky_irradiance = diffuse;
  light.clear_sky_irradiance = diffuse;
  // A cloud deck scatters all colours equally. A trace of the blue sky above it remains.
  let grey = mix(vec3f(sky_luminance(globally)), globally, 0.35) * vec3f(0.92, 1.0, 1.09);
  light.overcast_zenith_radiance = grey * (SKY_OVERCAST_TRANSMITTANCE * 9.0 / (7.0 * ATM_PI));
  light.fog_sky_radiance = vec3f(0.0);
  light.fog_sun_irradiance = vec3f(0.0);
  light.sun_above_fog = 1.0;
  if sky.fog.extinction_per_m > 0.0 {
    // Sunlight in the middle of the fog, and the diffuse light there, which includes the sunlight that the fog above
    // has scattered. About as much light goes up as comes down.
    let sunlight = fog_transmittance(0.5 * max(sky.fog.top_m, 0.0), sky.sun_direction.y, 0.0, FOG_FAR_M);
    let sun = light.sun_irradiance * light.cloud_sun_transmittance;
    light.fog_sun_irradiance = light.sun_irradiance * sunlight;
    light.sun_above_fog = 1.0 / max(fog_transmittance(0.0, sky.sun_direction.y, 0.0, FOG_FAR_M), 1e-3);
    let lost = sun * (high * (1.0 - sunlight));
    light.fog_sky_radiance = (mix(diffuse, SKY_OVERCAST_TRANSMITTANCE * grey, sky_closed_share()) + lost) * (0.6 / ATM_PI);
    let tint = vec3f(sky.fog_red, sky.fog_green, sky.fog_blue);
    light.fog_sky_radiance *= tint;
    light.fog_sun_irradiance *= tint;
  }
}

@compute @workgroup_size(64)
fn sky_irradiance_parts(@builtin(global_invocation_id) id: vec3u) {
  let thread = id.x;
  let size = textureDimensions(environment_map, 1);
  let half_rows = size.y / 2u;
  var sum = vec4f(0.0);
  for (var i = thread; i < size.x * half_rows; i += LIGHT_THREADS) {
    let x = i % size.x;
    let y = i / size.x;
    let elevation = (f32(y) + 0.5) * ATM_PI / f32(size.y);
    let solid = cos(elevation) * (ATM_PI / f32(size.y)) * (2.0 * ATM_PI / f32(size.x));
    let radiance = textureLoad(environment_map, vec2u(x, y + half_rows), 1).rgb;
    // Weight in the adaptation luminance: the low sky counts most, because it is in the picture and reflected by the
    // sea.
    let low = exp(-elevation * elevation / 0.18) * solid;
    let luminance = min(sky_luminance(radiance), 6.0 * sky_luminance(light.overcast_zenith_radiance) + 1e-4);
    sum += vec4f(radiance * (sin(elevation) * solid), luminance * low);
  }
  light_parts[thread] = sum;
}

@compute @workgroup_size(1)
fn sky_irradiance() {
  let total = light_sum_of_parts();
  light.sky_irradiance = total.rgb;
  if sky.fog.extinction_per_m > 0.0 {
    light.sun_irradiance *= fog_transmittance(0.0, sky.sun_direction.y, 0.0, FOG_FAR_M);
  }
  // Mean luminance of the low sky: 2.26 sr is the integral of the weight `low` over the sky.
  let band = total.w / 2.26;
  let on_sea = light.sun_irradiance * (light.cloud_sun_transmittance * max(sky.sun_direction.y, 0.0));
  let ground = sky_luminance(total.rgb + on_sea) / ATM_PI;
  // The adaptation luminance does not contain the factor `night_gain`.
  light.adaptation_luminance = max((0.85 * band + 0.2 * ground) / sky.night_gain, 1e-9);
  // Like an eye, the exposure adapts only in part: dusk stays darker than noon, and night is dark. By day, foam in the
  // sun is to be nearly white.
  let day = light.adaptation_luminance / (light.adaptation_luminance + 0.4);
  light.exposure = (0.66 + 0.6 * day) / pow(light.adaptation_luminance, 0.77) / sky.night_gain;
}
