// Optical properties of water, foam and bed. The struct `Material` is declared in src/render/water/material.rs.

// For the four noise layers of foam (channels cloud, lace, lace, lace): mip level at which half the variance is left,
// and steepness of the decrease. Fitted to the mip levels of src/render/water/noise.rs as the sampler interpolates
// them.
const MATERIAL_HALF_VARIANCE_LOD = vec4f(5.45, 4.00, 4.00, 4.00);
const MATERIAL_VARIANCE_STEEPNESS = vec4f(1.75, 1.36, 1.36, 1.36);

fn material_uv(layer: u32, at: vec2f) -> vec2f {
  let place = material.noise_layers[layer];
  return place.uv_below_eye + place.uv_from_position * at;
}

// Mip level of a noise layer whose texels are `size` metres wide.
fn material_lod(layer: u32, size: f32) -> f32 {
  return log2(max(size, 1e-6)) + material.noise_layers[layer].log_texels_per_m;
}

// Noise of a layer at a position relative to the point below the eye, m, at a mip level.
fn material_noise(layer: u32, at: vec2f, lod: f32) -> vec4f {
  return textureSampleLevel(noise_map, noise_sampler, material_uv(layer, at), 0, max(lod, 0.0));
}

// Fractions of the variance of the four layers of foam that are left at their mip levels, 0 to 1.
fn material_variance_left(lods: vec4f) -> vec4f {
  return 1.0 / (1.0 + exp2(MATERIAL_VARIANCE_STEEPNESS * (lods - MATERIAL_HALF_VARIANCE_LOD)));
}
