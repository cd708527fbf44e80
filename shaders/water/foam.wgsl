// Foam of whitecaps: how much of it a pixel holds, and what it looks like.

// Noise layers: windrows of tens of metres, patches of metres, strands of decimetres, threads of centimetres.
const FOAM_WINDROW_LAYER = 0u;
const FOAM_PATCH_LAYER = 1u;
const FOAM_STRAND_LAYER = 2u;
const FOAM_THREAD_LAYER = 3u;
// Weights of the layers in the pattern of a breaker's front. Those of old foam grow with the wind (material.rs).
const FOAM_FRONT_WEIGHTS = vec4f(0.1, 0.75, 0.8, 0.8);
// Reciprocal of the standard deviations of the values of cloud (evenly spread) and of lace and lumps (normal).
const FOAM_PER_DEVIATION = vec4f(3.464, 6.08, 6.08, 6.08);
// Softness of the edge of the film, and of the body of old foam (x) and of a front (y), in deviations of the pattern.
const FOAM_FILM_SOFTNESS = 0.4;
const FOAM_BODY_SOFTNESS = vec2f(0.13, 0.14);
// Opacity of the film (x), through which water shows, and what the body adds where it lies on it (y).
const FOAM_OLD_OPACITY = vec2f(0.26, 0.52);
const FOAM_FRONT_OPACITY = vec2f(0.4, 0.56);
// Deviations of the pattern by which film (x) and body (y) reach beyond the area that the foam covers.
const FOAM_OLD_SHIFT = vec2f(0.45, -0.22);
const FOAM_FRONT_SHIFT = vec2f(0.0, -0.2);
// Standard deviation of the height of a front's billows of metres (x), lumps of decimetres (y) and bubbles of
// centimetres (z), m.
const FOAM_LUMP_HEIGHT_M = vec3f(0.6, 0.08, 0.008);
// Height of the body of a front above the water, m.
const FOAM_BODY_HEIGHT_M = 0.07;
// Least distances, m, over which their slopes are measured.
const FOAM_RELIEF_STEP_M = vec3f(0.5, 0.07, 0.01);
// Share of billows in the height of a front's grain, relative to that of lumps.
const FOAM_BILLOW_GRAIN = 1.2;
// Fraction of the foam that belongs to fronts, from which billows show.
const FOAM_MIN_BILLOWING = 0.2;
// Height of old foam's relief relative to that of a front.
const FOAM_OLD_RELIEF = 0.25;
// Standard deviation of the slope of the relief.
const FOAM_RELIEF_SLOPE_SIGMA = 0.3;
// Simulated front above which a cell shows one, and from which it is full.
const FOAM_FRONT_RANGE = vec2f(0.45, 0.65);
// Cover of a full front: between its billows a few holes stay open.
const FOAM_FULL_FRONT = 0.92;
// Means, relative to that of the foam, of fronts that fill their cells, and of the foam that lies in them. With them,
// the mean of fronts and of the rest is that of the simulated foam, within 3 % in winds of 10 to 20 m/s.
const FOAM_FRONT_SHARES = vec2f(0.29, 0.18);
// Mean of the plume relative to that of the foam.
const FOAM_MEAN_PLUME_RATIO = 1.4;
// Amount of foam, 0 to 1, below which none is drawn.
const FOAM_MIN_AMOUNT = 0.002;
// Sum of the resolved fractions of the variance of patches and strands, below which one sample of them is enough.
const FOAM_MIN_RESOLVED = 0.05;
// Fraction of a noise layer's variance below which the layer counts as even, at its mean of 0.5.
const FOAM_MIN_LAYER_VARIANCE = 0.02;
// Fraction of a pixel's light from foam, below which its relief is not seen.
const FOAM_MIN_RELIEF_COVER = 0.02;
// Length over which the finest noise changes, m. Longer pixels have two samples.
const FOAM_FINEST_DETAIL_M = 0.02;

// Foam in a pixel.
struct FoamAmount {
  // Fraction of the surface that foam covers.
  cover: f32,
  // Fraction of this foam that belongs to fronts, where waves break now.
  fresh: f32,
  // Fraction of the water below that bubbles fill.
  plume: f32,
}

// Appearance of the foam in a pixel.
struct FoamAppearance {
  // Fraction of the pixel's light that comes from foam: the covered area, less where foam is thin.
  cover: f32,
  // Part of this light that comes from the film of old foam.
  film: f32,
  // Height of the fine relief, around 0.5.
  grain: f32,
  // Slope of the foam's relief.
  relief: vec2f,
  // Variance of the slope of the foam's relief that the pixel does not resolve.
  rough: f32,
}

// Foam in a pixel, from values of the foam map: foam (x), its current source (y), front of a breaker (z) and plume of
// bubbles (w). A front fills at most the fraction `filled` of a cell of the map. The fraction `beyond` of the pixel lies
// beyond all levels of the map, where the sea's means are drawn.
fn foam_amount(cell: vec4f, filled: f32, beyond: f32) -> FoamAmount {
  let mean = beyond * frame.mean_foam;
  let plume = cell.w + FOAM_MEAN_PLUME_RATIO * mean;
  let old = cell.x + material.foam_streak_share * (frame.mean_foam - mean - cell.x);
  // Most pixels have no front, and less foam than is drawn.
  if cell.z <= FOAM_FRONT_RANGE.x && (old + mean) * frame.foam_amount < FOAM_MIN_AMOUNT {
    return FoamAmount(0.0, 0.0, plume);
  }
  let rise = (cell.z - FOAM_FRONT_RANGE.x) / (FOAM_FRONT_RANGE.y - FOAM_FRONT_RANGE.x);
  let front = FOAM_FULL_FRONT * filled * maths_smooth(rise);
  let rest = (1.0 - FOAM_FRONT_SHARES.x * filled) / (1.0 - FOAM_FRONT_SHARES.y * filled);
  let all = front + (1.0 - front) * (rest * old) + mean;
  let fresh = (front + FOAM_FRONT_SHARES.x * mean) / max(all, 1e-4);
  return FoamAmount(min(all * frame.foam_amount, 1.0), fresh, plume);
}

// Foam in a pixel, from the finest levels that hold the pixel and are no finer than it; beyond all levels, its mean.
fn foam_level(at: vec2f, pixel: WaterFootprint) -> FoamAmount {
  let half_whole_m = 0.5 * WATER_TAP_TEXEL_RATIO * sqrt(pixel.width_m * pixel.length_m);
  let half_axis = 0.5 * abs(pixel.axis);
  // Two samples if the pixel is longer than a cell of the finest level.
  let has_halves = pixel.length_m * frame.foam_levels[0].inverse_cell > 1.0;
  var foam = vec4f(0.0);
  var filled = 0.0;
  var left = 1.0;
  for (var level = 0u; level < frame.foam_level_count && left > 0.0; level++) {
    let map = frame.foam_levels[level];
    let off = abs(at - map.centre) + half_axis;
    let inside = saturate(5.0 - 5.0 * max(off.x, off.y) * map.inverse_half_side);
    let coarse = saturate(2.0 - half_whole_m * map.inverse_cell);
    let share = left * inside * coarse;
    if share <= 0.0 {
      continue;
    }
    let uv = map.uv_below_eye + at * map.inverse_side;
    if has_halves {
      let half = (0.25 * map.inverse_side) * pixel.axis;
      let first = textureSampleLevel(foam_map, nearest_mip_sampler, uv - half, level, 0.0);
      let last = textureSampleLevel(foam_map, nearest_mip_sampler, uv + half, level, 0.0);
      foam += (0.5 * share) * (first + last);
    } else {
      foam += share * textureSampleLevel(foam_map, nearest_mip_sampler, uv, level, 0.0);
    }
    filled += share * map.front_fill;
    left -= share;
  }
  return foam_amount(foam, filled, left);
}

// Cumulative normal distribution (Bowling and others 2009, accurate to 2e-4).
fn foam_normal_cdf(x: f32) -> f32 {
  return 1.0 / (1.0 + exp(clamp(-x * (1.5976 + 0.07056 * x * x), -40.0, 40.0)));
}

// Inverse of the cumulative normal distribution (Abramowitz and Stegun 26.2.22, accurate to 3e-3).
fn foam_normal_quantile(share: f32) -> f32 {
  let t = sqrt(-2.0 * log(min(share, 1.0 - share)));
  return sign(share - 0.5) * (t - (2.30753 + 0.27061 * t) / (1.0 + t * (0.99229 + 0.04481 * t)));
}

// Appearance of foam in a pixel.
//
// Foam covers what lies above a threshold in a pattern, a sum of noise layers that is distributed normally. The part of
// the pattern that the pixel does not resolve softens the threshold, so that the mean is kept at every distance. A wide
// soft threshold makes the film, which is thickest along its threads, and a sharper, higher one the body.
fn foam_appearance(at: vec2f, pixel: WaterFootprint, amount: FoamAmount) -> FoamAppearance {
  let whole_m = WATER_TAP_TEXEL_RATIO * sqrt(pixel.width_m * pixel.length_m);
  var has_halves = pixel.length_m > FOAM_FINEST_DETAIL_M;
  // Each sample covers its part of the pixel. Windrows are longer than most pixels and threads shorter: one is enough.
  let part_m = pixel.length_m * select(1.0, 0.5, has_halves);
  let size = WATER_TAP_TEXEL_RATIO * sqrt(part_m * max(pixel.width_m, part_m));
  let logs = vec3f(pixel.log_whole_texel_m, log2(max(vec2f(size, whole_m), vec2f(1e-6))));
  let densities = vec4f(
    material.noise_layers[FOAM_WINDROW_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_PATCH_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_STRAND_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_THREAD_LAYER].log_texels_per_m);
  let lods = logs.xyyz + densities;
  let kept = material_variance_left(lods);
  // Where the pixel resolves neither patches nor strands, all samples are alike.
  let is_resolved = kept.y + kept.z >= FOAM_MIN_RESOLVED;
  has_halves = has_halves && is_resolved;
  // Noise less its mean of 0.5; of the finer layers, lace (x) and lumps (y).
  var noise = vec4f(0.0);
  if kept.x > FOAM_MIN_LAYER_VARIANCE {
    noise.x = material_noise(FOAM_WINDROW_LAYER, at, lods.x).b - 0.5;
  }
  var threads = vec2f(0.0);
  if kept.w > FOAM_MIN_LAYER_VARIANCE {
    threads = material_noise(FOAM_THREAD_LAYER, at, lods.w).ra - 0.5;
  }
  let fresh = amount.fresh;
  // Lumps take the place of lace in a front. Both are independent, so that the sum keeps its variance.
  let turn = sqrt(vec2f(1.0 - fresh, fresh));
  let old_weights = vec4f(
    material.noise_layers[FOAM_WINDROW_LAYER].foam_weight,
    material.noise_layers[FOAM_PATCH_LAYER].foam_weight,
    material.noise_layers[FOAM_STRAND_LAYER].foam_weight,
    material.noise_layers[FOAM_THREAD_LAYER].foam_weight);
  let raw_weights = mix(old_weights, FOAM_FRONT_WEIGHTS, fresh);
  let weights = raw_weights * inverseSqrt(dot(raw_weights, raw_weights));
  let unresolved = 1.0 - dot(weights * weights, kept);
  let factors = weights * FOAM_PER_DEVIATION;
  noise.w = dot(turn, threads);
  // Edges (x) and sharpness (y) of film and body.
  let quantile = foam_normal_quantile(clamp(amount.cover, 1e-4, 1.0 - 1e-4));
  let soft = vec2f(FOAM_FILM_SOFTNESS, mix(FOAM_BODY_SOFTNESS.x, FOAM_BODY_SOFTNESS.y, fresh));
  let shift = mix(FOAM_OLD_SHIFT, FOAM_FRONT_SHIFT, fresh);
  let edge = sqrt(1.0 + soft * soft) * (quantile + shift);
  let sharp = inverseSqrt(soft * soft + unresolved);
  let film_opacity = mix(FOAM_OLD_OPACITY.x, FOAM_FRONT_OPACITY.x, fresh);
  let body_opacity = mix(FOAM_OLD_OPACITY.y, FOAM_FRONT_OPACITY.y, fresh);
  var out: FoamAppearance;
  var first_body = 0.0;
  let depth_between = FOAM_BILLOW_GRAIN * turn.y;
  var heights = vec2f(0.0); // of billows and of lumps
  // Two samples lie in the two halves, and on both sides of the pixel's axis.
  let step = select(vec2f(0.0), 0.25 * pixel.axis + 0.31 * pixel.across, has_halves);
  var tap = at - step;
  for (var i = 0; i < select(1, 2, has_halves); i++) {
    if is_resolved {
      let patches = material_noise(FOAM_PATCH_LAYER, tap, lods.y).ra - 0.5;
      noise.y = dot(turn, patches);
      let strands = material_noise(FOAM_STRAND_LAYER, tap, lods.z).ra - 0.5;
      noise.z = dot(turn, strands);
      heights = vec2f(patches.y, strands.y);
    }
    tap += 2.0 * step;
    let z = dot(noise, factors);
    let body = foam_normal_cdf((z + edge.y) * sharp.y);
    let film = film_opacity * foam_normal_cdf((z + edge.x) * sharp.x);
    out.cover += film + body_opacity * body;
    out.film += film;
    out.grain += heights.y + depth_between * heights.x;
    first_body = body;
  }
  let share = select(1.0, 0.5, has_halves);
  out.film *= (1.0 - fresh) / max(out.cover, 1e-4);
  out.cover *= share;
  // Lumps are higher where foam covers; the grain is relative to their mean there.
  let usual = turn.y * weights.z * kept.z * exp(-0.5 * quantile * quantile) * (0.4 / 6.08) / max(amount.cover, 1e-4);
  out.grain = 0.5 + 1.3 * (out.grain * share - usual) + 0.7 * threads.y;
  let strength = material.foam_relief * mix(FOAM_OLD_RELIEF, 1.0, fresh);
  let slope_sigma = FOAM_RELIEF_SLOPE_SIGMA * strength;
  out.rough = slope_sigma * slope_sigma * (1.0 - kept.w);
  if strength > 0.0 && kept.z > 0.05 && out.cover > FOAM_MIN_RELIEF_COVER {
    // Slopes matter towards the sun only: light across them changes little.
    let sun = frame.sun_direction.xz * inverseSqrt(max(dot(frame.sun_direction.xz, frame.sun_direction.xz), 1e-6));
    let steps = max(FOAM_RELIEF_STEP_M, vec3f(whole_m));
    let last = tap - 2.0 * step;
    let ahead = material_noise(FOAM_STRAND_LAYER, last + steps.y * sun, lods.z).ra - 0.5;
    noise.z = dot(turn, ahead);
    let body = foam_normal_cdf((dot(noise, factors) + edge.y) * sharp.y);
    var rise = 6.08 * FOAM_LUMP_HEIGHT_M.y * (ahead.y - heights.y) + FOAM_BODY_HEIGHT_M * (body - first_body);
    rise /= steps.y;
    if fresh > FOAM_MIN_BILLOWING {
      let billow = material_noise(FOAM_PATCH_LAYER, last + steps.x * sun, lods.y).a - 0.5 - heights.x;
      rise += 6.08 * FOAM_LUMP_HEIGHT_M.x * turn.y * billow / steps.x;
    }
    if kept.w > FOAM_MIN_LAYER_VARIANCE {
      let fine = material_noise(FOAM_THREAD_LAYER, at + steps.z * sun, lods.w).a - 0.5 - threads.y;
      rise += 6.08 * FOAM_LUMP_HEIGHT_M.z * fine / steps.z;
    }
    out.relief = (strength * clamp(rise, -1.5, 1.5)) * sun;
  }
  return out;
}
