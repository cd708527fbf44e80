// Slopes of the water in the lean tier (lean.wgsl): one sample of each map, and one copy of each patch.

// Footprint sizes, relative to the patch of a cascade, at which its slopes begin to fade into variance, and at which
// none are left. They are smaller than in the full tier, which leaves more pixels with fewer cascades.
const LEAN_FADE_START = 0.05;
const LEAN_FADE_END = 0.1;
// Binary logarithm of WATER_TAP_TEXEL_RATIO.
const LEAN_LOG_TEXEL_RATIO = -0.786;

// Square piece of the undisplaced sea that one sample of each map covers. It has the pixel's area: one sample is either
// sharp along the pixel, and aliases, or blurred across it.
struct LeanFootprint {
  side_m: f32,
  // Binary logarithm of the size of the texels that are read, m.
  log_texel_m: f32,
}

// Footprint of a pixel whose longer side is `long_m`, at a distance at which a pixel is `wide_m` wide.
fn lean_footprint(long_m: f32, wide_m: f32) -> LeanFootprint {
  let side_m = sqrt(long_m * min(long_m, wide_m)) + 1e-6;
  return LeanFootprint(side_m, log2(side_m) + LEAN_LOG_TEXEL_RATIO);
}

// Shift, in texture coordinates, of the copy of a patch that weighs most at a point (tile_blend in tiles.wgsl).
fn lean_copy_shift(position: TileLatticePosition, at: vec2f) -> vec2f {
  if position.shift_step == 0.0 {
    return vec2f(0.0);
  }
  let q = position.fraction + vec2f(dot(position.gradient_u, at), dot(position.gradient_v, at));
  let whole = floor(q);
  let rest = q - whole;
  // The corner of the triangle with the largest barycentric coordinate: beside the diagonal of the cell, or on it.
  let sum = rest.x + rest.y;
  var corner = select(vec2i(0, 1), vec2i(1, 0), rest.x > rest.y);
  corner = select(corner, vec2i(0), max(rest.x, rest.y) + sum < 1.0);
  corner = select(corner, vec2i(1), min(rest.x, rest.y) + sum > 2.0);
  let cell = bitcast<vec2u>(position.cell + vec2i(whole) + corner);
  return vec2f(noise_pcg4d(vec4u(cell, position.shift_key, 0u)).xy >> vec2u(26u)) * position.shift_step;
}

// Adds the waves of a cascade or of ripples, without the fraction `carried` that the mesh vertices already hold.
// `gust` is a factor on their slope variance, and `gains` those of a coast.
fn lean_add_waves(
  out: ptr<function, WaterSlopeSums>, at: vec2f, foot: LeanFootprint, map: FrameCascade, carried: f32, gust: f32,
  gains: vec3f,
) {
  let uv = map.uv_below_eye + at * map.inverse_patch + lean_copy_shift(map.tile_position, at);
  let lod = foot.log_texel_m + map.log_texels_per_m;
  let fading = (foot.side_m * map.inverse_patch - LEAN_FADE_START) * (1.0 / (LEAN_FADE_END - LEAN_FADE_START));
  let weight = saturate(1.0 - fading);
  let gradients = weight * textureSampleLevel(gradients_map, trilinear_sampler, uv, map.layer, lod);
  var own = (1.0 - carried) * map.slope_scale;
  var variance_factor = map.variance_factor;
  if WATER_GUSTS {
    own *= sqrt(gust);
    variance_factor *= gust;
  }
  if WATER_COAST {
    let gain = coast_slope_gain(map, gains);
    own *= gain;
    variance_factor *= gain * gain;
  }
  (*out).sums.slope += own * gradients.xy;
  (*out).sums.stretch += own * gradients.zw;
  // As in water_sampling: the moments hold nothing finer than two texels.
  let counted = saturate(lod + 0.5) * variance_factor;
  if counted > 0.0 {
    (*out).variance += counted * water_unresolved_covariance(map, uv, lod - 1.0, gradients.xy);
  }
}

// Slope statistics within a footprint at an undisplaced position, with the slopes `carried` that the mesh holds there.
// The waves have moved the water by `moved`, m.
fn lean_slope(at: vec2f, moved: vec3f, foot: LeanFootprint, carried: WaterDerivatives) -> WaterSlope {
  var waves: WaterSlopeSums;
  waves.sums = carried;
  let gust = water_gust_gain(at, foot.side_m);
  var gains: vec3f;
  if WATER_COAST {
    gains = coast_gains(at);
  }
  let inverse_step = water_inverse_carrying_step(at);
  for (var c = 0u; c < frame.cascade_count + frame.ripple_count; c++) {
    let map = frame.cascades[c];
    let own_gust = water_gust_share(map, gust);
    if foot.side_m * map.inverse_patch >= LEAN_FADE_END {
      waves.variance += water_distant_covariance(map, at, own_gust, gains);
      continue;
    }
    let share = select(0.0, water_carried_fraction(map, inverse_step), c < frame.cascade_count);
    if share < 1.0 {
      lean_add_waves(&waves, at, foot, map, share, own_gust, gains);
    }
  }
  // As water_displaced_slope, with a cheaper limit and one mean for the whole pixel.
  let sums = waves.sums;
  let sides = 1.0 + frame.choppiness * sums.stretch;
  let jacobian = water_jacobian(sums, sides);
  var out: WaterSlope;
  let bound = water_bound_factors(moved, gains);
  let over = 1.0 / max(jacobian, 0.25);
  out.mean = water_slope_displaced(sums.slope + water_bound_slope(sums, bound), sums, sides) * over;
  out.mean = clamp(out.mean, vec2f(-1.2), vec2f(1.2));
  out.variance = water_unresolved_variance(waves, jacobian, bound, gains, gust);
  out.jacobian = jacobian;
  return out;
}
