// Foam of whitecaps: how much of it a pixel holds, and what it looks like.

// Simulated front above which a cell shows one, and from which it is full. Between, billows tear its edge.
const FOAM_FRONT_RANGE = vec2f(0.3, 0.65);
// Cover of a full front: between its billows a few holes stay open.
const FOAM_FULL_FRONT = 0.96;
// Range and cover of a front in a sea with a coast. There the range above would make a low bore a white carpet.
const FOAM_SURF_FRONT_RANGE = vec2f(FOAM_FRONT_RANGE.x, 1.0);
const FOAM_SURF_FULL_FRONT = 0.88;
// Excess over the breaking criterion, which is twice the strength of a coast's roller (foam/foam.wgsl), from which a
// roller is there, and at which it is strongest. Factor on the cover of a front where no roller is.
const FOAM_SURF_ROLLING = vec2f(1.7, 2.0);
const FOAM_SURF_PASSED = 0.6;
// Means, relative to that of the foam, of fronts that fill their cells, and of the foam that lies in them. With them,
// the mean of fronts and of the rest is that of the simulated foam, within 3 % in winds of 10 to 20 m/s without a coast.
const FOAM_FRONT_SHARES = vec2f(0.32, 0.18);
// Mean of the plume relative to that of the foam.
const FOAM_MEAN_PLUME_RATIO = 1.4;
// Amount of foam, 0 to 1, below which none is drawn.
const FOAM_MIN_AMOUNT = 0.002;
// Ratio of foam to the plume of bubbles below from which foam counts as old, and one over the range up to that of new
// foam. Foam decays faster than bubbles, so the ratio is 1 where a wave breaks, and falls with the age of the foam.
const FOAM_OLD_RATIO = 0.3;
const FOAM_INVERSE_RATIO_RANGE = 1.6;

// Foam in a pixel.
struct FoamAmount {
  // Fraction of the surface that foam covers.
  cover: f32,
  // Fraction of this foam that belongs to fronts, where waves break now.
  fresh: f32,
  // Fraction of the water below that bubbles fill.
  plume: f32,
  // Youth of the rest of the foam: 1 where a wave has just broken, 0 after about two decay times.
  young: f32,
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
  // Fraction of the sunlight that billows towards the sun let through.
  lit: f32,
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
    return FoamAmount(0.0, 0.0, plume, 0.0);
  }
  // Where the crest no longer breaks, the foam that its front has left is lace.
  var breaking = maths_smooth(cell.y);
  var front = FOAM_FULL_FRONT * maths_rise(cell.z, FOAM_FRONT_RANGE);
  if WATER_COAST {
    breaking = maths_rise(cell.y, FOAM_SURF_ROLLING);
    front = FOAM_SURF_FULL_FRONT * mix(FOAM_SURF_PASSED, 1.0, breaking) * maths_rise(cell.z, FOAM_SURF_FRONT_RANGE);
  }
  front *= filled;
  let rest = (1.0 - FOAM_FRONT_SHARES.x * filled) / (1.0 - FOAM_FRONT_SHARES.y * filled);
  let all = front + (1.0 - front) * (rest * old) + mean;
  let fresh = (front * breaking + FOAM_FRONT_SHARES.x * mean) / max(all, 1e-4);
  let young = ((cell.x + mean) / max(plume, 1e-4) - FOAM_OLD_RATIO) * FOAM_INVERSE_RATIO_RANGE;
  return FoamAmount(min(all * frame.foam_amount, 1.0), fresh, plume, saturate(young));
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
