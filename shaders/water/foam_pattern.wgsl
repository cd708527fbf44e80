// The pattern that the foam in a pixel covers.
//
// Foam covers what lies above a threshold in a pattern, a sum of noise layers that is distributed normally. The part of
// the pattern that the pixel does not resolve softens the threshold, so that the mean is kept at every distance. A wide
// soft threshold makes the film, which is thickest along its threads, and a sharper, higher one the body. Half of the
// body's opacity comes from its core, whose threshold lies higher still.
//
// The pattern, the opacity and the relief follow the age of the foam: the front of a breaker is a heap of billows, new
// foam behind it a thick sheet with round holes, and old foam thin threads and streaks along the wind.

// Weights of the layers in the pattern of a breaker's front: windrows, billows, strands and threads. Their squares add up
// to 1.
const FOAM_FRONT_WEIGHTS = vec4f(0.08, 0.45, 0.72, 0.52);
// Change of these weights at the edge of a front, where it covers half of the water: fewer billows, more strands and
// threads, so that the edge is lace.
const FOAM_FRONT_EDGE_WEIGHTS = vec4f(0.0, -0.24, 0.08, 0.2);
// Factors on the weights of the layers (material.rs), which grow with the wind, in the oldest foam and in new foam.
const FOAM_OLD_WEIGHTS = vec4f(1.3, 1.6, 0.6, 0.4);
const FOAM_NEW_WEIGHTS = vec4f(0.5, 1.5, 1.05, 1.2);
// Softness of the edges of film (x) and body (y), in deviations of the pattern.
const FOAM_SOFTNESS = vec2f(0.4, 0.12);
// Opacity of the film (x), through which water shows, and what the body adds where it lies on it (y): of the oldest
// foam, of new foam and of a front. The mean over the life of whitecaps is about half of that of a front (Koepke 1984).
const FOAM_OLD_OPACITY = vec2f(0.11, 0.55);
const FOAM_NEW_OPACITY = vec2f(0.16, 0.70);
const FOAM_FRONT_OPACITY = vec2f(0.20, 0.78);
// Deviations of the pattern by which film (x) and body (y) reach beyond the area that the foam covers, or, if negative,
// fall short of it: in all foam but fronts, and in fronts.
const FOAM_OLD_SHIFT = vec2f(0.45, -0.10);
const FOAM_FRONT_SHIFT = vec2f(0.35, -0.32);
// Shares of a kind of foam below this count as 0, and shares above 1 - FOAM_LEAST_SHARE as 1. Layers of a kind without a
// share are not read.
const FOAM_LEAST_SHARE = 0.04;

// Mip levels of the noise layers in a pixel.
struct FoamLods {
  layers: vec4f,
  // Mip levels of the layers of foam that the wind has not drawn out: billows and strands.
  round: vec2f,
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
  let of_round = vec2f(
    material.noise_layers[FOAM_BILLOW_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_TUMBLE_LAYER].log_texels_per_m);
  return FoamLods(logs.xyyz + densities, logs.y + of_round, whole_m);
}

// Shares of the foam that the wind has not drawn out (x), which are fronts and, in light wind, new foam; and of fronts
// alone (y); 0 to 1. The change from old to new foam is steep, and small shares count as none, so that most pixels need
// the layers of one kind alone.
fn foam_round_shares(amount: FoamAmount) -> vec2f {
  let new_foam = saturate(2.0 * amount.young * material.foam_calm - 0.5);
  let shares = vec2f(max(amount.fresh, new_foam), amount.fresh);
  return saturate((shares - FOAM_LEAST_SHARE) * (1.0 / (1.0 - 2.0 * FOAM_LEAST_SHARE)));
}

// How the noise layers make the pattern of a pixel's foam.
struct FoamPattern {
  // Factors on the noise of the four layers, less its mean.
  factors: vec4f,
  // Roots of the shares of the variance of patches and strands that each kind of foam has. Old foam, which the wind has
  // drawn out:
  drawn_out: f32,
  // All other foam, whose share is the sum of the next two:
  round: f32,
  // New foam:
  new_foam: f32,
  // Fronts:
  billows: f32,
  // Edges of film (x) and body (y), in deviations of the pattern, and their sharpness.
  edge: vec2f,
  sharp: vec2f,
  // Opacity of the film, and what the body adds.
  opacity: vec2f,
  // Mean of the resolved height of billows where foam covers.
  usual: f32,
}

// The pattern of foam in a pixel that keeps the fractions `kept` of the variance of the layers. `shares` are those of
// foam_round_shares.
fn foam_pattern(amount: FoamAmount, shares: vec2f, kept: vec4f) -> FoamPattern {
  let fresh = amount.fresh;
  let layers = vec4f(
    material.noise_layers[FOAM_WINDROW_LAYER].foam_weight, material.noise_layers[FOAM_PATCH_LAYER].foam_weight,
    material.noise_layers[FOAM_STRAND_LAYER].foam_weight, material.noise_layers[FOAM_THREAD_LAYER].foam_weight);
  let aged = layers * mix(FOAM_OLD_WEIGHTS, FOAM_NEW_WEIGHTS, amount.young);
  let edge = 4.0 * amount.cover * (1.0 - amount.cover);
  let front = FOAM_FRONT_WEIGHTS + edge * FOAM_FRONT_EDGE_WEIGHTS;
  let raw = mix(aged * inverseSqrt(dot(aged, aged)), front, fresh);
  let weights = raw * inverseSqrt(dot(raw, raw));
  let unresolved = 1.0 - dot(weights * weights, kept);
  var out: FoamPattern;
  out.factors = weights * FOAM_PER_DEVIATION;
  // The kinds of foam have noise that is independent: layers of their own, or in one layer lace and lumps. So their sum
  // keeps its variance.
  let roots = sqrt(vec4f(1.0 - shares.x, shares, shares.x - shares.y));
  out.drawn_out = roots.x;
  out.round = roots.y;
  out.billows = roots.z;
  out.new_foam = roots.w;
  let quantile = maths_normal_quantile(clamp(amount.cover, 1e-4, 1.0 - 1e-4));
  let shift = mix(FOAM_OLD_SHIFT, FOAM_FRONT_SHIFT, fresh);
  let square = FOAM_SOFTNESS * FOAM_SOFTNESS;
  out.edge = sqrt(1.0 + square) * (quantile + shift);
  out.sharp = inverseSqrt(square + unresolved);
  out.opacity = mix(mix(FOAM_OLD_OPACITY, FOAM_NEW_OPACITY, amount.young), FOAM_FRONT_OPACITY, fresh);
  let covered = exp(-0.5 * quantile * quantile) * (0.4 / 6.08) / max(amount.cover, 1e-4);
  out.usual = out.billows * weights.y * kept.y * covered;
  return out;
}

// Strands (x) and lumps (y) at a place, less their means.
fn foam_strands(pattern: FoamPattern, at: vec2f, lods: FoamLods) -> vec2f {
  var out = vec2f(0.0);
  if pattern.drawn_out > 0.0 {
    out = pattern.drawn_out * (material_noise(FOAM_STRAND_LAYER, at, lods.layers.z).ra - 0.5);
  }
  if pattern.round > 0.0 {
    out += pattern.round * (material_noise(FOAM_TUMBLE_LAYER, at, lods.round.y).ra - 0.5);
  }
  return out;
}

// Patches (x) and the height of billows (y) at a place, less their means.
fn foam_patches(pattern: FoamPattern, at: vec2f, lods: FoamLods) -> vec2f {
  var out = vec2f(0.0);
  if pattern.drawn_out > 0.0 {
    out.x = pattern.drawn_out * (material_noise(FOAM_PATCH_LAYER, at, lods.layers.y).r - 0.5);
  }
  if pattern.round > 0.0 {
    let lace_and_lumps = material_noise(FOAM_BILLOW_LAYER, at, lods.round.x).ra - 0.5;
    out += vec2f(dot(vec2f(pattern.new_foam, pattern.billows), lace_and_lumps), lace_and_lumps.y);
  }
  return out;
}
