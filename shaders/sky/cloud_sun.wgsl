// Sunlight on the sea between and below volumetric clouds. Needs the module variables clouds, light, cloud_shadow_map
// and noise_sampler.

// Whether the shadows of clouds are compiled in.
override SKY_CLOUD_SHADOWS = false;

// Fraction of the sunlight that the clouds let through to the point that is lit; a pass sets it once per pixel.
var<private> cloud_sun_fraction: f32 = 1.0;

// Fraction of the sunlight that the clouds let through to `place`, a point of the sea (x, z) relative to the eye, m,
// averaged over 2^`log_size_m` metres.
fn cloud_sun_transmittance(place: vec2f, log_size_m: f32) -> f32 {
  let along = vec2f(dot(place, clouds.shadow_along), dot(place, clouds.shadow_across));
  let lod = max(log_size_m + clouds.log_shadow_texels_per_m, 0.0);
  return textureSampleLevel(cloud_shadow_map, noise_sampler, along + clouds.shadow_offset, lod).r;
}

// Irradiance by the sun on a plane that faces it at `place` (see cloud_sun_transmittance), in shaders that have no variant
// with and without clouds.
fn cloud_sun_irradiance_at(place: vec2f, log_size_m: f32) -> vec3f {
  if clouds.height_km > 0.0 {
    return light.sun_irradiance * cloud_sun_transmittance(place, log_size_m);
  }
  return light.sun_irradiance;
}

// Irradiance by the sun on a plane that faces it at the point that is lit.
fn cloud_sun_irradiance() -> vec3f {
  if SKY_CLOUD_SHADOWS {
    return light.sun_irradiance * cloud_sun_fraction;
  }
  return light.sun_irradiance;
}
