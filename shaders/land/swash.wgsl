// Traces of waves on sand: lines of driftweed, arcs where single waves turned back, and foam on the film of water.

// Colour of dry driftweed, and heights above the run-up, m, at which the swash of two tides has left it.
const LAND_WRACK = vec3f(0.105, 0.080, 0.050);
const LAND_WRACK_LINES_M = vec2f(0.10, 0.42);

// Share of the sand under driftweed: broken strands along two lines. `above` is the height above the run-up.
fn land_wrack(above: f32, middle: vec4f, fine: vec4f, size: f32) -> f32 {
  // Swash ends in curves, and each line is a few strands. A pixel averages what is narrower than it.
  let bent = above + 0.10 * middle.z + 0.016 * fine.z + 0.007 * fine.w;
  let off = abs(vec2f(bent) - LAND_WRACK_LINES_M);
  let strand = abs(off - vec2f(0.035, 0.025));
  let least = vec2f(0.010, 0.007);
  let width = least + 0.08 * size;
  let lines = saturate(1.2 - strand / width) * (least / width);
  let scraps = saturate(1.0 - off * vec2f(7.0, 12.0)) * saturate(0.9 * fine.w + 0.8 * fine.z - 1.1);
  let left = saturate(vec2f(0.75, 0.45) + vec2f(0.6 * middle.w, 0.55 * middle.z) + 0.35 * fine.w);
  return saturate(0.85 * dot(lines, left) + 0.22 * dot(scraps, left));
}

// Distance between the marks of two waves, relative to 0.4 m more than the height of the run-up.
const LAND_MARKS_SHARE = 0.12;

// Darkness of the thin arcs of grains and scraps that single waves have left at their highest line. Those of two tides
// cross.
fn land_swash_marks(height: f32, run_up: f32, middle: vec4f, fine: vec4f, size: f32) -> f32 {
  let apart = LAND_MARKS_SHARE * (0.4 + run_up);
  let bent = vec2f(height) + vec2f(0.07, -0.045) * middle.zw + vec2f(0.010, 0.007) * fine.zw;
  let off = apart * abs(fract(bent / (apart * vec2f(1.0, 1.37))) - 0.5);
  let width = 0.003 + 0.08 * size;
  let lines = saturate(1.3 - off / width) * (0.003 / width);
  return dot(lines, saturate(vec2f(0.35) + vec2f(0.5, -0.45) * middle.wz + 0.3 * fine.w));
}

// Softness of the edges of the lace of foam, in deviations of its pattern, and its opacity.
const SWASH_SOFTNESS = 0.4;
const SWASH_OPACITY = 0.62;
// Weights of patches of metres and of strands of decimetres in the pattern; their squares add up to 1.
const SWASH_WEIGHTS = vec2f(0.6, 0.8);
// Albedo of old foam.
const SWASH_ALBEDO = 0.55;

// Part of the water that foam covers at a point (x, z) relative to the one below the eye, by the finest level of the map
// that holds it, over texels of `size` metres.
fn swash_cover(at: vec2f, size: f32) -> f32 {
  let level = foam_finest_level(0u, at, size);
  if level == frame.foam_level_count {
    return 0.0;
  }
  return min(foam_cell(level, at).x * frame.foam_amount, 1.0);
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
