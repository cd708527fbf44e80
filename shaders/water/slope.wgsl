// Mean and variance of the slope of the surface within a pixel.

// Geometric mean of a footprint's sides over the patch from which on the slopes of a cascade fade into variance, and where
// nothing else is left: its longest waves are as short as the footprint, and 2 % of its slopes would be left in their mean.
const WATER_FADE = 0.08;
const WATER_FAR = 0.16;
// Slopes of waves of more texels than this are smooth enough between them without a spline.
const WATER_SMOOTH = 6.0;

struct WaterSlope {
  // Mean slope of the displaced surface over the pixel.
  mean: vec2f,
  // Variances of the slope within it: xx, zz, xz.
  variance: vec3f,
  jacobian: f32,
  // How much the farther half of a long pixel's slope has more than the mean, and the nearer less.
  lean: vec2f,
}

// Unit normal of a surface of this slope.
fn water_normal(slope: vec2f) -> vec3f {
  return normalize(vec3f(-slope.x, 1.0, -slope.y));
}

// Variances xx, zz, xz that can be a covariance: a sum of estimates may hold more of xz than of xx and zz, and a Gaussian of
// that would be greatest where there are no slopes.
fn water_covariance(variance: vec3f) -> vec3f {
  let most = 0.97 * sqrt(max(variance.x * variance.y, 0.0));
  return vec3f(variance.xy, clamp(variance.z, -most, most));
}

// Footprint of a pixel on the undisplaced sea: its length along the longer side, filtered by several taps so that it is
// not blurred across. Hardware anisotropy is not used: it differs between GPUs and takes minutes in software.
struct WaterFootprint {
  axis: vec2f,
  // Size of one tap, m.
  size: f32,
  taps: i32,
}

const WATER_TAPS = 3;
// Size of a tap over the length that it stands for: 1 / sqrt(3), because a mip read with interpolation between its texels
// (a box and a tent) blurs as much as a box of sqrt(3) times the texel.
const WATER_TAP = 0.58;

fn water_footprint(dx: vec2f, dy: vec2f) -> WaterFootprint {
  let x = length(dx);
  let y = length(dy);
  let large = max(x, y);
  // Area over length: also right where the two sides are nearly parallel.
  let small = max(abs(dx.x * dy.y - dx.y * dy.x) / max(large, 1e-9), 1e-6);
  let taps = clamp(i32(ceil(large / small - 0.3)), 1, WATER_TAPS);
  return WaterFootprint(select(dy, dx, x > y), WATER_TAP * max(small, large / f32(taps)), taps);
}

// Sums over the waves within a footprint.
struct WaterWaves {
  sums: WaterSums,
  // Variances of the slope: xx, zz, xz.
  variance: vec3f,
  // Of the slope, as in WaterSlope.
  lean: vec2f,
}

// Adds the waves of a cascade or of ripples, but for the share of them that the mesh carries.
fn water_add_waves(out: ptr<function, WaterWaves>, at: vec2f, foot: WaterFootprint, cascade: u32, carried: f32) {
  let map = frame.cascades[cascade];
  let scale = map.inverse_patch * frame.n;
  let texels = foot.size * scale;
  let wide = texels / WATER_TAP;
  let long = max(length(foot.axis) * scale, texels);
  let share = 1.0 - smoothstep(WATER_FADE, WATER_FAR, sqrt(wide * long) / frame.n);
  let distant = share <= 0.0;
  // Magnified: smooth between texels, in one place.
  let near = select(0.0, 1.0 - smoothstep(0.8, 1.25, long), map.wave_texels < WATER_SMOOTH);
  // Several texels in the footprint: as many taps as are worth it (one between texels blurs as much as a box of 1.4), half
  // as many for the smoother moments, and one for the displacement, whose part in the slope is of second order: both from
  // the nearest level. The weights are those of the middle. Of a distant map there is only its variance. What counts for
  // nothing is not read, but for the displacement: the loops are empty then, since a software GPU reads on both sides of a branch.
  let places = clamp(i32(ceil(long / max(wide, 1.4) - 0.3)), 1, foot.taps);
  let taps = select(places, 0, distant || near > 0.0);
  let splines = select(0, 1, near > 0.0 && !distant);
  let lod = log2(max(texels, 1e-6));
  let long_lod = log2(max(WATER_TAP * long, 1e-6));
  // The moments know nothing finer than two texels; closer up they would count resolved waves twice. From where on they
  // count is fitted to the whole.
  let unresolved = select((1.0 - near * near) * clamp(lod + 0.5, 0.0, 1.0), 1.0, distant);
  let pairs = select((select(places, 1, distant) + 1) / 2, 0, unresolved <= 0.0);
  let wide_lod = select(min(lod + log2(f32(places) / f32(max(pairs, 1))), long_lod) - 1.0, 16.0, distant);
  let along = foot.axis * map.inverse_patch;
  // Ripples are slopes alone.
  let gain = (1.0 - carried) * map.slope_scale;
  let own = select(0.0, 1.0 - carried, cascade < frame.count);
  let blend = tile_blend(map.tile, at);
  let copies = select(blend.count, 1u, distant);
  for (var i = 0u; i < copies; i++) {
    let uv = map.uv + at * map.inverse_patch + tile_shift(map.tile, blend, i);
    let weight = vec3f(blend.weight[i], blend.along_x[i], blend.along_z[i]);
    var g = vec4f(0.0);
    var lean = vec2f(0.0);
    for (var k = 0; k < taps; k++) {
      let off = (f32(k) + 0.5) / f32(places) - 0.5;
      let there = textureSampleLevel(gradients_map, wave_sampler, uv + along * off, map.layer, lod);
      g += there;
      lean += sign(off) * there.xy;
    }
    g *= 1.0 / f32(places);
    for (var k = 0; k < splines; k++) {
      g = water_splined(gradients_map, water_spline(uv, frame.n, near), map.layer);
    }
    var second = vec3f(0.0);
    for (var k = 0; k < pairs; k++) {
      let tap = uv + along * ((f32(k) + 0.5) / f32(pairs) - 0.5);
      second += textureSampleLevel(moments_map, level_sampler, tap, map.layer, wide_lod).xyz;
    }
    g *= share;
    second *= map.moment_scale / f32(max(pairs, 1));
    (*out).lean += (gain * share * weight.x / f32(places)) * lean;
    let d = (own * share) * textureSampleLevel(displacement_map, level_sampler, uv, map.layer, long_lod);
    (*out).sums = water_sum((*out).sums, vec4f(gain * g.xy, own * g.zw), d, weight);
    // Copies are independent: their variances add with the squares of the weights.
    let part = map.slope_scale * map.slope_scale * map.variance_gain * unresolved * select(weight.x * weight.x, 1.0, distant);
    (*out).variance += part * max(second - vec3f(g.x * g.x, g.y * g.y, g.x * g.y), vec3f(0.0, 0.0, -1.0));
  }
}

// Mean and variance of the slope within a footprint.
fn water_slope(at: vec2f, foot: WaterFootprint) -> WaterSlope {
  return water_slope_beyond(at, foot, foot, WaterSums(), false);
}

// The same beyond what the mesh carries of it, if it does; and with another footprint for the ripples.
fn water_slope_beyond(
  at: vec2f, foot: WaterFootprint, ripple_foot: WaterFootprint, carried: WaterSums, carries: bool,
) -> WaterSlope {
  var waves: WaterWaves;
  waves.sums = carried;
  // Cox and Munk 1954: waves shorter than the finest cascade.
  waves.variance = frame.residual;
  // What the mesh has all of is not looked at.
  var first = 0u;
  while carries && first < frame.count && water_carried(first, at) >= 1.0 {
    first++;
  }
  for (var c = first; c < frame.count + frame.ripple_count; c++) {
    // Ripples below the finest cascade are a shrunk copy of it: slopes of short gravity waves are nearly scale-free.
    let is_ripple = c >= frame.count;
    let share = select(0.0, water_carried(c, at), carries && !is_ripple);
    let within = WaterFootprint(
      select(foot.axis, ripple_foot.axis, is_ripple), select(foot.size, ripple_foot.size, is_ripple),
      select(foot.taps, ripple_foot.taps, is_ripple));
    water_add_waves(&waves, at, within, c, share);
  }
  let sums = waves.sums;
  let l = frame.chop;
  let sx = 1.0 + l.x * sums.stretch.x;
  let sz = 1.0 + l.y * sums.stretch.y;
  let jacobian = sx * sz - l.x * l.y * sums.shear.x * sums.shear.y;
  // Where the surface folds the slope has no meaning: it stays finite under the foam.
  let over = 1.0 / max(jacobian, 0.25);
  var out: WaterSlope;
  out.mean = water_tilted(sums.slope, sums, vec2f(sx, sz)) * over;
  let steep = length(out.mean);
  out.mean *= min(1.0, 1.6 / max(steep, 1e-6));
  out.variance = water_covariance(waves.variance);
  out.jacobian = jacobian;
  out.lean = water_tilted(waves.lean, sums, vec2f(sx, sz)) * over;
  return out;
}

// A slope of the undisplaced sea on the displaced one, times the Jacobian; `sides` are those of a unit square there.
fn water_tilted(slope: vec2f, sums: WaterSums, sides: vec2f) -> vec2f {
  let l = frame.chop;
  return vec2f(slope.x * sides.y - slope.y * l.y * sums.shear.y, slope.y * sides.x - slope.x * l.x * sums.shear.x);
}
