// What foam looks like in a pixel: the pattern that it covers, its thickness and its relief.
//
// Foam covers what lies above a threshold in a pattern, a sum of noise layers that is distributed normally. The part of
// the pattern that the pixel does not resolve softens the threshold, so that the mean is kept at every distance. A wide
// soft threshold makes the film, which is thickest along its threads, and a sharper, higher one the body.
//
// The pattern, the opacity and the relief follow the age of the foam: the front of a breaker is a heap of billows, new
// foam behind it a thick sheet with holes, and old foam thin threads and streaks along the wind.

// Weights of the layers in the pattern of a breaker's front: windrows, billows, strands and threads. Their squares add up
// to 1.
const FOAM_FRONT_WEIGHTS = vec4f(0.08, 0.68, 0.6, 0.41);
// Weights in the pattern of a front near a coast. Surf draws strands and threads out to long streaks, so they count less.
const FOAM_SURF_WEIGHTS = vec4f(0.08, 0.93, 0.25, 0.25);
// Change of these weights at the edge of a front, where it covers half of the water: fewer billows, more strands and
// threads, so that the edge is lace.
const FOAM_FRONT_EDGE_WEIGHTS = vec4f(0.0, -0.24, 0.08, 0.2);
// Factors on the weights of the layers (material.rs), which grow with the wind, in the oldest foam and in new foam.
const FOAM_OLD_WEIGHTS = vec4f(1.3, 1.6, 0.6, 0.4);
const FOAM_NEW_WEIGHTS = vec4f(0.5, 0.8, 1.05, 1.2);
// Softness of the edge of the film, and of the body of old foam (x) and of a front (y), in deviations of the pattern.
const FOAM_FILM_SOFTNESS = 0.4;
const FOAM_BODY_SOFTNESS = vec2f(0.2, 0.28);
// Opacity of the film (x), through which water shows, and what the body adds where it lies on it (y): of the oldest
// foam, of new foam and of a front. The mean over the life of whitecaps is about half of that of a front (Koepke 1984).
const FOAM_OLD_OPACITY = vec2f(0.11, 0.55);
const FOAM_NEW_OPACITY = vec2f(0.16, 0.70);
const FOAM_FRONT_OPACITY = vec2f(0.36, 0.62);
// Deviations of the pattern by which film (x) and body (y) reach beyond the area that the foam covers.
const FOAM_OLD_SHIFT = vec2f(0.45, -0.22);
const FOAM_FRONT_SHIFT = vec2f(0.35, -0.45);
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
const FOAM_GRAIN_SKEW = 0.056;
// Fraction of the foam that belongs to fronts, from which billows show.
const FOAM_MIN_BILLOWING = 0.2;
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

// Mip levels of the noise layers in a pixel.
struct FoamLods {
  layers: vec4f,
  billow: f32,
  // Size of the pixel's texels, m, if all of it is read at once.
  whole_m: f32,
}

// Mip levels of the noise layers in a pixel that has one or two samples. Each covers its part of the pixel. Windrows
// are longer than most pixels and threads shorter: one sample is enough for them.
fn foam_lods(pixel: WaterFootprint, has_halves: bool) -> FoamLods {
  let whole_m = WATER_TAP_TEXEL_RATIO * sqrt(pixel.width_m * pixel.length_m);
  let part_m = pixel.length_m * select(1.0, 0.5, has_halves);
  let size = WATER_TAP_TEXEL_RATIO * sqrt(part_m * max(pixel.width_m, part_m));
  let logs = vec3f(pixel.log_whole_texel_m, log2(max(vec2f(size, whole_m), vec2f(1e-6))));
  let densities = vec4f(
    material.noise_layers[FOAM_WINDROW_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_PATCH_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_STRAND_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_THREAD_LAYER].log_texels_per_m);
  return FoamLods(logs.xyyz + densities, logs.y + material.noise_layers[FOAM_BILLOW_LAYER].log_texels_per_m, whole_m);
}

// How the noise layers make the pattern of a pixel's foam.
struct FoamPattern {
  // Factors on the noise of the four layers, less its mean.
  factors: vec4f,
  // Shares of patches (x) and of billows (y) in the noise: roots of the shares of their variance.
  turn: vec2f,
  // Edges of film (x) and body (y), in deviations of the pattern, and their sharpness.
  edge: vec2f,
  sharp: vec2f,
  // Opacity of the film, and what the body adds.
  opacity: vec2f,
  // Mean of the resolved height of billows where foam covers.
  usual: f32,
}

// The pattern of foam in a pixel that keeps the fractions `kept` of the variance of the layers.
fn foam_pattern(amount: FoamAmount, kept: vec4f) -> FoamPattern {
  let fresh = amount.fresh;
  let layers = vec4f(
    material.noise_layers[FOAM_WINDROW_LAYER].foam_weight, material.noise_layers[FOAM_PATCH_LAYER].foam_weight,
    material.noise_layers[FOAM_STRAND_LAYER].foam_weight, material.noise_layers[FOAM_THREAD_LAYER].foam_weight);
  let aged = layers * mix(FOAM_OLD_WEIGHTS, FOAM_NEW_WEIGHTS, amount.young);
  let edge = 4.0 * amount.cover * (1.0 - amount.cover);
  let front = select(FOAM_FRONT_WEIGHTS, FOAM_SURF_WEIGHTS, WATER_COAST) + edge * FOAM_FRONT_EDGE_WEIGHTS;
  let raw = mix(aged * inverseSqrt(dot(aged, aged)), front, fresh);
  let weights = raw * inverseSqrt(dot(raw, raw));
  let unresolved = 1.0 - dot(weights * weights, kept);
  var out: FoamPattern;
  out.factors = weights * FOAM_PER_DEVIATION;
  // Billows take the place of patches in a front. Both are independent, so that the sum keeps its variance.
  out.turn = sqrt(vec2f(1.0 - fresh, fresh));
  let quantile = maths_normal_quantile(clamp(amount.cover, 1e-4, 1.0 - 1e-4));
  let soft = vec2f(FOAM_FILM_SOFTNESS, mix(FOAM_BODY_SOFTNESS.x, FOAM_BODY_SOFTNESS.y, fresh));
  let shift = mix(FOAM_OLD_SHIFT, FOAM_FRONT_SHIFT, fresh);
  out.edge = sqrt(1.0 + soft * soft) * (quantile + shift);
  out.sharp = inverseSqrt(soft * soft + unresolved);
  out.opacity = mix(mix(FOAM_OLD_OPACITY, FOAM_NEW_OPACITY, amount.young), FOAM_FRONT_OPACITY, fresh);
  let covered = exp(-0.5 * quantile * quantile) * (0.4 / 6.08) / max(amount.cover, 1e-4);
  out.usual = out.turn.y * weights.y * kept.y * covered;
  return out;
}

// Opacity of film (x) and body (y) where the pattern has the value `z`.
fn foam_film_and_body(pattern: FoamPattern, z: f32) -> vec2f {
  let film = maths_normal_cdf((z + pattern.edge.x) * pattern.sharp.x);
  return vec2f(film, maths_normal_cdf((z + pattern.edge.y) * pattern.sharp.y));
}

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
  let ahead = material_noise(FOAM_STRAND_LAYER, place.at + steps.y * sun, lods.layers.z).ra - 0.5;
  noise.z = ahead.x;
  let body = foam_film_and_body(pattern, dot(noise, pattern.factors)).y;
  let thick_m = mix(FOAM_BODY_HEIGHT_M.x, FOAM_BODY_HEIGHT_M.y, pattern.turn.y);
  var rise = (6.08 * FOAM_LUMP_HEIGHT_M.y * (ahead.y - place.heights.y) + thick_m * (body - place.body)) / steps.y;
  var lit = 1.0;
  if pattern.turn.y > FOAM_MIN_BILLOWING {
    let height_m = 6.08 * FOAM_LUMP_HEIGHT_M.x * pattern.turn.y;
    let near = material_noise(FOAM_BILLOW_LAYER, place.at + steps.x * sun, lods.billow).a - 0.5 - place.heights.x;
    rise += height_m * near / steps.x;
    let far = material_noise(FOAM_BILLOW_LAYER, place.at + FOAM_SHADOW_STEP_M * sun, lods.billow).a - 0.5;
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
// `kept` are the resolved fractions of the variance of billows (x) and lumps (y), `turn` is the share of billows.
fn foam_grain_skew(kept: vec2f, turn: f32) -> f32 {
  let billows = FOAM_BILLOW_GRAIN * turn;
  return FOAM_GRAIN_SKEW * (kept.y + billows * billows * kept.x);
}

// Appearance of foam in a pixel.
fn foam_appearance(at: vec2f, pixel: WaterFootprint, amount: FoamAmount) -> FoamAppearance {
  let has_detail = pixel.length_m > FOAM_FINEST_DETAIL_M;
  var lods = foam_lods(pixel, has_detail);
  // The leaning front of a breaker squeezes its foam: without sharper levels it would be blurred sideways. Far away
  // they would flicker.
  let sharper = FOAM_FRONT_SHARPER * amount.fresh * saturate(1.3 - pixel.length_m);
  lods.layers -= vec4f(sharper);
  lods.billow -= sharper;
  var kept = material_variance_left(lods.layers);
  let billows = MATERIAL_VARIANCE_STEEPNESS.y * (lods.billow - MATERIAL_HALF_VARIANCE_LOD.y);
  kept.y = mix(kept.y, 1.0 / (1.0 + exp2(billows)), amount.fresh);
  // Where the pixel resolves neither patches nor strands, all samples are alike.
  let is_resolved = kept.y + kept.z >= FOAM_MIN_RESOLVED;
  let has_halves = has_detail && is_resolved;
  let sees_bubbles = kept.w > FOAM_MIN_LAYER_VARIANCE;
  let pattern = foam_pattern(amount, kept);
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
      let patches = material_noise(FOAM_PATCH_LAYER, place.at, lods.layers.y).r - 0.5;
      let strands = material_noise(FOAM_STRAND_LAYER, place.at, lods.layers.z).ra - 0.5;
      if pattern.turn.y > FOAM_MIN_BILLOWING {
        place.heights.x = material_noise(FOAM_BILLOW_LAYER, place.at, lods.billow).a - 0.5;
      }
      place.heights.y = strands.y;
      place.noise.y = dot(pattern.turn, vec2f(patches, place.heights.x));
      place.noise.z = strands.x;
    }
    let thickness = foam_film_and_body(pattern, dot(place.noise, pattern.factors));
    place.body = thickness.y;
    out.cover += share * dot(pattern.opacity, thickness);
    out.film += share * pattern.opacity.x * thickness.x;
    out.grain += share * (place.heights.y + FOAM_BILLOW_GRAIN * pattern.turn.y * place.heights.x);
  }
  out.film *= (1.0 - amount.fresh) / max(out.cover, 1e-4);
  // Billows are higher where foam covers; the grain is relative to their mean there.
  out.grain = 0.5 + 1.3 * (out.grain - FOAM_BILLOW_GRAIN * pattern.usual) + 0.7 * place.heights.z;
  out.grain -= foam_grain_skew(kept.yz, pattern.turn.y);
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
