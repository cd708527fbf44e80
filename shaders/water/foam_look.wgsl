// Opacity and relief of the foam in a pixel. foam_pattern.wgsl holds the pattern of noise that tells where foam lies.

// Standard deviation of the height of a front's billows of metres (x), lumps of decimetres (y) and bubbles of
// centimetres (z), m.
const FOAM_LUMP_HEIGHT_M = vec3f(0.2, 0.04, 0.008);
// Height of the body of old foam (x) and of a front (y) above the water, m.
const FOAM_BODY_HEIGHT_M = vec2f(0.03, 0.15);
// Least distances, m, over which their slopes are measured, and that to billows that may cast a shadow.
const FOAM_RELIEF_STEP_M = vec3f(0.4, 0.08, 0.01);
const FOAM_SHADOW_STEP_M = 1.5;
// Part of the sunlight that a billow takes from the next one: foam lets light through, and scatters it about.
const FOAM_SHADOW = 0.65;
// Share of billows in the height of a front's grain, relative to that of lumps.
const FOAM_BILLOW_GRAIN = 1.2;
// Grain by which the mean light of uneven foam exceeds that of its mean grain: half the variance of the grain of lumps,
// times the natural logarithm of the change of light with it (FOAM_HOLLOW_STOPS).
const FOAM_GRAIN_SKEW = 0.039;
// Height of the relief of the oldest foam and of new foam, relative to that of a front.
const FOAM_AGED_RELIEF = vec2f(0.1, 0.5);
// Standard deviation of the slope of the relief.
const FOAM_RELIEF_SLOPE_SIGMA = 0.3;
// Sum of the resolved fractions of the variance of patches and strands, below which one sample of them is enough.
const FOAM_MIN_RESOLVED = 0.05;
// Fraction of a noise layer's variance below which the layer counts as even, at its mean of 0.5.
const FOAM_MIN_LAYER_VARIANCE = 0.02;
// Fraction of a pixel's light from foam, below which its relief is not seen.
const FOAM_MIN_RELIEF_COVER = 0.02;
// Mip levels by which the noise of a front is sharper.
const FOAM_FRONT_SHARPER = 1.0;
// Length over which the finest noise changes, m. Longer pixels have two samples.
const FOAM_FINEST_DETAIL_M = 0.02;

// A place in foam, with the values of its noise, less their mean of 0.5.
struct FoamPlace {
  at: vec2f,
  // Noise of the four layers.
  noise: vec4f,
  // Height of billows (x), lumps (y) and bubbles (z).
  heights: vec3f,
  // Opacity of the body.
  body: f32,
}

// Slope of the foam's relief towards the sun at a place (x), and the fraction of the sunlight that reaches it (y).
// Slopes matter towards the sun only: light across them changes little. Steps are no shorter than `step_m`.
fn foam_relief(pattern: FoamPattern, place: FoamPlace, lods: FoamLods, sees_bubbles: bool, step_m: f32) -> vec2f {
  let flat_square = max(dot(frame.sun_direction.xz, frame.sun_direction.xz), 1e-6);
  let sun = frame.sun_direction.xz * inverseSqrt(flat_square);
  let steps = max(FOAM_RELIEF_STEP_M, vec3f(step_m));
  var noise = place.noise;
  let ahead = foam_strands(pattern, place.at + steps.y * sun, lods);
  noise.z = ahead.x;
  let body = foam_body(dot(noise, pattern.factors), pattern.edge, pattern.sharp);
  let thick_m = mix(FOAM_BODY_HEIGHT_M.x, FOAM_BODY_HEIGHT_M.y, pattern.billows);
  var rise = (6.08 * FOAM_LUMP_HEIGHT_M.y * (ahead.y - place.heights.y) + thick_m * (body - place.body)) / steps.y;
  var lit = 1.0;
  if pattern.billows > 0.0 {
    let height_m = 6.08 * FOAM_LUMP_HEIGHT_M.x * pattern.billows;
    let near = material_noise(FOAM_BILLOW_LAYER, place.at + steps.x * sun, lods.round.x).a - 0.5 - place.heights.x;
    rise += height_m * near / steps.x;
    let far = material_noise(FOAM_BILLOW_LAYER, place.at + FOAM_SHADOW_STEP_M * sun, lods.round.x).a - 0.5;
    let ray_m = FOAM_SHADOW_STEP_M * frame.sun_direction.y * inverseSqrt(flat_square);
    let over = height_m * (far - place.heights.x) - ray_m;
    lit = 1.0 - FOAM_SHADOW * maths_smooth(0.5 + over * (0.3 / FOAM_LUMP_HEIGHT_M.x));
  }
  if sees_bubbles {
    let fine = material_noise(FOAM_THREAD_LAYER, place.at + steps.z * sun, lods.layers.w).a - 0.5 - place.heights.z;
    rise += 6.08 * FOAM_LUMP_HEIGHT_M.z * fine / steps.z;
  }
  // Light that spreads inside foam rounds off its steepest walls.
  return vec2f(rise * inverseSqrt(1.0 + rise * rise), lit);
}

// Correction of the grain of foam: the light of foam grows exponentially with its grain, so without this correction
// uneven foam would be brighter on average than even foam.
// `kept` are the resolved fractions of the variance of billows (x) and lumps (y), `billows` is the root of the share of
// fronts.
fn foam_grain_skew(kept: vec2f, billows: f32) -> f32 {
  let grain = FOAM_BILLOW_GRAIN * billows;
  return FOAM_GRAIN_SKEW * (kept.y + grain * grain * kept.x);
}

// Appearance of foam in a pixel.
fn foam_appearance(at: vec2f, pixel: WaterFootprint, amount: FoamAmount) -> FoamAppearance {
  let has_detail = pixel.length_m > FOAM_FINEST_DETAIL_M;
  var lods = foam_lods(pixel, has_detail);
  // The leaning front of a breaker squeezes its foam: without sharper levels it would be blurred sideways. Far away
  // they would flicker.
  let sharper = FOAM_FRONT_SHARPER * amount.fresh * saturate(1.3 - pixel.length_m);
  lods.layers -= vec4f(sharper);
  lods.round -= sharper;
  var kept = material_variance_left(lods.layers);
  let shares = foam_round_shares(amount);
  if shares.x > 0.0 {
    let of_round = MATERIAL_VARIANCE_STEEPNESS.yz * (lods.round - MATERIAL_HALF_VARIANCE_LOD.yz);
    kept = vec4f(kept.x, mix(kept.yz, 1.0 / (1.0 + exp2(of_round)), shares.x), kept.w);
  }
  // Where the pixel resolves neither patches nor strands, all samples are alike.
  let is_resolved = kept.y + kept.z >= FOAM_MIN_RESOLVED;
  let has_halves = has_detail && is_resolved;
  let sees_bubbles = kept.w > FOAM_MIN_LAYER_VARIANCE;
  let pattern = foam_pattern(amount, shares, kept);
  var place: FoamPlace;
  if kept.x > FOAM_MIN_LAYER_VARIANCE {
    place.noise.x = material_noise(FOAM_WINDROW_LAYER, at, lods.layers.x).b - 0.5;
  }
  if sees_bubbles {
    let threads = material_noise(FOAM_THREAD_LAYER, at, lods.layers.w).ra - 0.5;
    place.noise.w = threads.x;
    place.heights.z = threads.y;
  }
  var out: FoamAppearance;
  out.lit = 1.0;
  let share = select(1.0, 0.5, has_halves);
  // Two samples lie in the two halves, and on both sides of the pixel's axis. The last one has the relief.
  let step = select(vec2f(0.0), 0.25 * pixel.axis + 0.31 * pixel.across, has_halves);
  place.at = at - step;
  for (var i = 0; i < select(1, 2, has_halves); i++) {
    place.at += (2.0 * f32(i)) * step;
    if is_resolved {
      let patches = foam_patches(pattern, place.at, lods);
      let strands = foam_strands(pattern, place.at, lods);
      place.noise = vec4f(place.noise.x, patches.x, strands.x, place.noise.w);
      place.heights = vec3f(patches.y, strands.y, place.heights.z);
    }
    let z = dot(place.noise, pattern.factors);
    let film = pattern.opacity.x * foam_film(z, pattern.edge, pattern.sharp);
    place.body = foam_body(z, pattern.edge, pattern.sharp);
    out.cover += share * (film + pattern.opacity.y * place.body);
    out.film += share * film;
    out.grain += share * (place.heights.y + FOAM_BILLOW_GRAIN * pattern.billows * place.heights.x);
  }
  out.film *= (1.0 - amount.fresh) / max(out.cover, 1e-4);
  // Billows are higher where foam covers; the grain is relative to their mean there.
  out.grain = 0.5 + 1.3 * (out.grain - FOAM_BILLOW_GRAIN * pattern.billows * pattern.usual) + 0.7 * place.heights.z;
  out.grain -= foam_grain_skew(kept.yz, pattern.billows);
  let aged = mix(FOAM_AGED_RELIEF.x, FOAM_AGED_RELIEF.y, amount.young);
  let strength = material.foam_relief * mix(aged, 1.0, amount.fresh);
  let slope_sigma = FOAM_RELIEF_SLOPE_SIGMA * strength;
  out.rough = slope_sigma * slope_sigma * (1.0 - kept.w);
  if strength > 0.0 && kept.z > 0.05 && out.cover > FOAM_MIN_RELIEF_COVER {
    let relief = foam_relief(pattern, place, lods, sees_bubbles, lods.whole_m);
    out.lit = mix(1.0, relief.y, min(strength, 1.0));
    let sun = frame.sun_direction.xz;
    out.relief = (strength * relief.x * inverseSqrt(max(dot(sun, sun), 1e-6))) * sun;
  }
  return out;
}
