// Foam that the last waves have left on the film of water over sand.

// Softness of the edges of this lace, in deviations of its pattern, and its opacity.
const SWASH_SOFTNESS = 0.4;
const SWASH_OPACITY = 0.62;
// Weights of patches of metres and of strands of decimetres in the pattern; their squares add up to 1.
const SWASH_WEIGHTS = vec2f(0.6, 0.8);
// Albedo of old foam.
const SWASH_ALBEDO = 0.55;

// Part of the water that foam covers at a point (x, z) relative to the one below the eye, by the finest level of the map
// that holds it, over texels of `size` metres.
fn swash_cover(at: vec2f, size: f32) -> f32 {
  for (var level = 0u; level < frame.foam_level_count; level++) {
    let map = frame.foam_levels[level];
    let off = abs(at - map.centre);
    if max(off.x, off.y) * map.inverse_half_side < 1.0 && size * map.inverse_cell < 3.0 {
      let uv = map.uv_below_eye + at * map.inverse_side;
      let foam = textureSampleLevel(foam_map, nearest_mip_sampler, uv, level, 0.0).x;
      return min(foam * frame.foam_amount, 1.0);
    }
  }
  return 0.0;
}

// Opacity of the foam on a film of water: the pattern of old foam on the water beside it (shaders/water/foam_look.wgsl),
// with fewer layers. `film` is the share of the ground under the film.
fn swash_foam(at: vec2f, size: f32, film: f32) -> f32 {
  let cover = film * swash_cover(at, size);
  if cover < 0.01 {
    return 0.0;
  }
  let lods = vec2f(material_lod(FOAM_PATCH_LAYER, size), material_lod(FOAM_STRAND_LAYER, size));
  let kept = material_variance_left(lods.xxyy).yz;
  let patches = material_noise(FOAM_PATCH_LAYER, at, lods.x).r;
  let strands = material_noise(FOAM_STRAND_LAYER, at, lods.y).r;
  let noise = vec2f(patches, strands) - 0.5;
  let z = dot(SWASH_WEIGHTS * FOAM_PER_DEVIATION.yz, noise);
  let edge = sqrt(1.0 + SWASH_SOFTNESS * SWASH_SOFTNESS) * maths_normal_quantile(clamp(cover, 1e-4, 1.0 - 1e-4));
  let unresolved = 1.0 - dot(SWASH_WEIGHTS * SWASH_WEIGHTS, kept);
  return SWASH_OPACITY * maths_normal_cdf((z + edge) * inverseSqrt(SWASH_SOFTNESS * SWASH_SOFTNESS + unresolved));
}
