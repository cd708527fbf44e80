// Traces of waves on sand: lines of driftweed, arcs where single waves turned back, the film of water that a wave leaves,
// and the foam on it.

// Colour of dry driftweed, and heights above the run-up, m, at which the swash of two tides has left it.
const LAND_WRACK = vec3f(0.105, 0.080, 0.050);
const LAND_WRACK_LINES_M = vec2f(0.10, 0.42);

// Share of the sand under driftweed: broken strands along two lines, which let sand through, and scraps beside them.
// `above` is the height above the run-up.
fn land_wrack(above: f32, middle: vec4f, fine: vec4f, size: f32) -> f32 {
  // Swash ends in curves, and each line is a few strands. A pixel averages what is narrower than it.
  let bent = above + 0.06 * middle.z + 0.016 * fine.z + 0.007 * fine.w;
  let off = abs(vec2f(bent) - LAND_WRACK_LINES_M);
  let strand = abs(off - vec2f(0.035, 0.025));
  let least = vec2f(0.010, 0.007);
  let width = least + 0.08 * size;
  let lines = saturate(1.2 - strand / width) * (least / width);
  let scraps = saturate(1.0 - off * vec2f(7.0, 12.0)) * saturate(0.9 * fine.w + 0.8 * fine.z - 1.1);
  let left = saturate(vec2f(0.75, 0.45) + vec2f(0.6 * middle.w, 0.55 * middle.z) + 0.35 * fine.w);
  return saturate(0.4 * dot(lines, left) + 0.12 * dot(scraps, left));
}

// Distance between the marks of two waves, relative to 0.4 m more than the height of the run-up.
const LAND_MARKS_SHARE = 0.12;
// Width of a pixel, m, from which these marks are left out: it averages them to a few per cent of darkness.
const LAND_MARKS_SEEN_M = 0.5;

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

// Film (x) and body (y) of foam on sand, as in shaders/water/foam_pattern.wgsl: softness of their edges, deviations of
// the pattern; deviations by which they reach beyond the area that the foam covers; and their opacity.
const SWASH_SOFTNESS = vec2f(0.4, 0.14);
const SWASH_SHIFT = vec2f(0.35, -0.36);
const SWASH_OPACITY = vec2f(0.12, 0.80);
// Weights of patches of metres, strands of decimetres and threads of centimetres in the pattern. Their squares add up
// to 1.
const SWASH_WEIGHTS = vec3f(0.5, 0.77, 0.396);
// Albedo of foam, and how much of the sunlight its slopes shade; light that spreads inside evens out the rest.
const SWASH_ALBEDO = 0.6;
const SWASH_FACING = 0.6;
// Height of the body, m, from which follow its slopes and the length of its shadow, and the shortest of both, m.
const SWASH_BODY_M = 0.02;
const SWASH_STEP_M = 0.05;
// Part of the sunlight that the body takes from what is behind it.
const SWASH_SHADOW = 0.45;
// Sunlight that comes through the body from behind, relative to that which falls on a plane towards the sun.
const SWASH_GLOW = 0.16;
// Stops of light between hollows and lumps of the body, for each deviation of their noise.
const SWASH_LUMPS = 0.35;

// Length of the pattern of the edges of films along y of the frame of the coast, relative to that along x: built-in
// beaches run along y. The side of its tile along y, m. And the least width, m, over which it is averaged, so that
// edges are smooth curves.
const SWASH_TONGUE_STRETCH = 0.12;
const SWASH_TONGUE_TILE_M = 97.0;
const SWASH_TONGUE_WIDTH_M = 1.2;

// Noise that shapes the edge of a film of water on sand: it retreats in tongues, not in patches.
fn swash_tongues(place: vec2f, size: f32) -> vec4f {
  let at = vec2f(SWASH_TONGUE_STRETCH * place.x, place.y);
  return land_noise(at, SWASH_TONGUE_TILE_M, max(size, SWASH_TONGUE_WIDTH_M));
}

// Cover of the foam that a wave has left: where it is more than x, the wave has also left a film of water, and from y on
// the film covers all sand.
const SWASH_SWEPT = vec2f(0.03, 0.45);
// Heights, relative to the run-up, between which that film ends, and how far a normal noise moves this line.
const SWASH_SWEPT_HEIGHTS = vec2f(0.785, 0.815);
const SWASH_SWEPT_LOBES = 0.06;

// Share of the film at which its lip of foam is thickest, and the reciprocal of half the range of shares that it covers.
const SWASH_LIP = vec2f(0.2, 6.0);
// Part of the ground that the foam of the lip covers.
const SWASH_LIP_COVER = 0.7;

// Share of the ground that is under the film of the last waves that have passed (x), where their foam covers the part
// `cover`, and how far the point is in the lip of foam along the film's upper edge (y). The film drains as the foam
// dissolves. `bend` is normal noise, and `steep` the slope of the land: rock keeps no such film.
fn swash_film(cover: f32, height: f32, run_up: f32, bend: f32, steep: f32) -> vec2f {
  // No lobe goes beyond the run-up, where nothing of this is computed.
  let lobe = max(SWASH_SWEPT_LOBES * bend, SWASH_SWEPT_HEIGHTS.y - 1.0);
  let below = 1.0 - maths_rise(height / max(run_up, 0.05) + lobe, SWASH_SWEPT_HEIGHTS);
  let left = maths_rise(cover, SWASH_SWEPT) * land_film_share(steep);
  return left * vec2f(below, saturate(1.0 - SWASH_LIP.y * abs(below - SWASH_LIP.x)));
}

// Part of the foam of a wave that stays on the film.
const SWASH_LEFT = 0.7;

// Part of the water that foam covers at a point (x, z) relative to the one below the eye, by the finest level of the map
// that holds it, over texels of `size` metres.
fn swash_cover(at: vec2f, size: f32) -> f32 {
  let level = foam_finest_level(0u, at, size);
  if level == frame.foam_level_count {
    return 0.0;
  }
  return min(foam_cell(level, at).x * frame.foam_amount, 1.0);
}

// Foam on a film of water.
struct SwashFoam {
  opacity: f32,
  // Irradiance by the sun, relative to that of a plane towards it.
  lit: f32,
  // Light of the sky, relative to that of level ground.
  open: f32,
  // Part of the sunlight that reaches what is beside the foam.
  beside: f32,
}

// The foam on a film of water: the pattern of new foam on the water in light wind, with fewer layers. `cover` is the part
// of the ground that it covers, `dir` the direction from the eye.
fn swash_foam(at: vec2f, size: f32, cover: f32, dir: vec3f) -> SwashFoam {
  let l = frame.sun_direction;
  var out = SwashFoam(0.0, max(l.y, 0.0), 1.0, 1.0);
  if cover < 0.01 {
    return out;
  }
  let lods = vec3f(
    material_lod(FOAM_BILLOW_LAYER, size), material_lod(FOAM_TUMBLE_LAYER, size),
    material_lod(FOAM_THREAD_LAYER, size));
  let kept = material_variance_left(lods.xxyz).yzw;
  let patches = material_noise(FOAM_BILLOW_LAYER, at, lods.x).r;
  let strands = material_noise(FOAM_TUMBLE_LAYER, at, lods.y).ra;
  var threads = vec2f(0.5);
  if kept.z > 0.02 {
    threads = material_noise(FOAM_THREAD_LAYER, at, lods.z).ra;
  }
  let z = FOAM_PER_DEVIATION.z * dot(SWASH_WEIGHTS, vec3f(patches, strands.x, threads.x) - 0.5);
  let edge = maths_normal_quantile(clamp(cover, 1e-4, 1.0 - 1e-4));
  let unresolved = 1.0 - dot(SWASH_WEIGHTS * SWASH_WEIGHTS, kept);
  let square = SWASH_SOFTNESS * SWASH_SOFTNESS;
  let edges = sqrt(1.0 + square) * (edge + SWASH_SHIFT);
  let sharp = inverseSqrt(square + unresolved);
  let body = foam_body(z, edges, sharp);
  out.opacity = dot(SWASH_OPACITY, vec2f(foam_film(z, edges, sharp), body));
  // Slope and shadow of the body follow from the difference between the pattern here and at a step towards the sun.
  let across = max(length(l.xz), 1e-3);
  let step_m = max(SWASH_STEP_M, size);
  let ahead = material_noise(FOAM_TUMBLE_LAYER, at + (step_m / across) * l.xz, lods.y).ra;
  let before = foam_body(z + FOAM_PER_DEVIATION.z * SWASH_WEIGHTS.y * (ahead.x - strands.x), edges, sharp);
  let lumps = FOAM_PER_DEVIATION.z * (ahead.y - strands.y);
  let rise = (SWASH_BODY_M / step_m) * (before - body + 0.25 * body * lumps);
  let cosine = max(l.y - across * rise, 0.0) * inverseSqrt(1.0 + rise * rise);
  let grain = body * FOAM_PER_DEVIATION.z * (strands.y + 0.6 * threads.y - 0.8);
  let behind = max(dot(dir, l), 0.0);
  let glow = SWASH_GLOW * behind * behind * saturate(8.0 * l.y);
  out.lit = mix(out.lit, cosine, SWASH_FACING) * exp2(SWASH_LUMPS * grain) + glow;
  out.open = exp2(0.5 * SWASH_LUMPS * grain);
  out.beside = 1.0 - SWASH_SHADOW * saturate(before - body);
  return out;
}
