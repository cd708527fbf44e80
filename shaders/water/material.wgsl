// Optical properties of water, foam and bed. The struct `Material` is declared in src/render/water/material.rs.

// For each noise layer (channels cloud, net, net, bubbles; cloud, bubbles): texel size, in texels of mip level 0, at
// which half the variance is left, and steepness of the decrease. Fitted to the mip levels of src/render/water/noise.rs
// as the sampler interpolates them.
const MATERIAL_HALF_VARIANCE = array<vec2f, 6>(
  vec2f(42.0, 1.8), vec2f(10.9, 1.5), vec2f(10.9, 1.5), vec2f(2.7, 1.65), vec2f(42.0, 1.8), vec2f(2.7, 1.65));

fn material_uv(layer: u32, at: vec2f) -> vec2f {
  let place = material.noise_layers[layer];
  return place.uv_below_eye + place.uv_from_position * at;
}

// Mip level of a noise layer whose texels are `size` metres wide.
fn material_lod(layer: u32, size: f32) -> f32 {
  return log2(max(size * sqrt(abs(determinant(material.noise_layers[layer].uv_from_position))) * 512.0, 1e-4));
}

// Noise of a layer at a position relative to the point below the eye, m, at a mip level.
fn material_noise(layer: u32, at: vec2f, lod: f32) -> vec4f {
  return textureSampleLevel(noise_map, noise_sampler, material_uv(layer, at), max(lod, 0.0));
}

// Fraction of the variance of a layer's channel that is left at a mip level, 0 to 1.
fn material_variance_left(layer: u32, lod: f32) -> f32 {
  let half_kept = MATERIAL_HALF_VARIANCE[layer];
  return 1.0 / (1.0 + exp2(half_kept.y * (lod - log2(half_kept.x))));
}
