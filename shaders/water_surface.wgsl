// The surface from the maps of the simulation: every cascade blended from shifted copies (tiles.wgsl).

@group(1) @binding(0) var displacement_map: texture_2d_array<f32>;
@group(1) @binding(1) var gradients_map: texture_2d_array<f32>;
@group(1) @binding(2) var moments_map: texture_2d_array<f32>;
@group(1) @binding(3) var foam_map: texture_2d_array<f32>;
// Between the levels of a map, and of the nearest one.
@group(1) @binding(4) var wave_sampler: sampler;
@group(1) @binding(5) var level_sampler: sampler;

// Geometric mean of a footprint's sides over the patch from which on the slopes of a cascade fade into variance, and where
// nothing else is left: its longest waves are as short as the footprint, and 2 % of its slopes would be left in their mean.
const WATER_FADE = 0.08;
const WATER_FAR = 0.16;
// Slopes of waves of more texels than this are smooth enough between them without a spline.
const WATER_SMOOTH = 6.0;

// Between texels: from linear (0) to Catmull-Rom's spline over 4 x 4 texels (1), in five bilinear taps; the spline's
// corners, at most 1.6 % of its weight, are left out. A mixture is one of weights, so it costs no more.
struct WaterSpline {
  before: vec2f,
  middle: vec2f,
  after: vec2f,
  // Along each axis: of the texel before, the two in the middle, the one after.
  outer: vec4f,
  inner: vec2f,
}

const WATER_SPLINE_TAPS = 5;

// At texture coordinates of a map of n texels.
fn water_spline(uv: vec2f, n: f32, smoothness: f32) -> WaterSpline {
  let p = uv * n - 0.5;
  let base = floor(p);
  let f = p - base;
  let w0 = smoothness * (f * (f * (1.0 - 0.5 * f) - 0.5));
  let w2 = mix(f, f * (f * (2.0 - 1.5 * f) + 0.5), smoothness);
  let w3 = smoothness * (f * f * (0.5 * f - 0.5));
  let w12 = 1.0 - w0 - w3;
  var out: WaterSpline;
  out.before = (base - 0.5) / n;
  out.middle = (base + 0.5 + w2 / w12) / n;
  out.after = (base + 2.5) / n;
  let scale = inverseSqrt(1.0 - (w0.x + w3.x) * (w0.y + w3.y));
  out.outer = scale * vec4f(w0, w3);
  out.inner = scale * w12;
  return out;
}

// Texture coordinates of a tap, and its weight: the middle, then before and after along x and along z.
fn water_spline_tap(s: WaterSpline, k: i32) -> vec3f {
  let x = select(select(s.middle.x, s.before.x, k == 1), s.after.x, k == 2);
  let z = select(select(s.middle.y, s.before.y, k == 3), s.after.y, k == 4);
  let wx = select(select(s.inner.x, s.outer.x, k == 1), s.outer.z, k == 2);
  let wz = select(select(s.inner.y, s.outer.y, k == 3), s.outer.w, k == 4);
  return vec3f(x, z, wx * wz);
}

// The lattice of a cascade's copies; those of the ripples are the last.
fn water_tile(i: u32) -> TilePlace {
  let lattice = frame.tile_lattice[i];
  let cell = frame.tile_cell[i];
  return TilePlace(lattice.xy, lattice.zw, cell.xy, bitcast<u32>(cell.z), u32(cell.w));
}

// Displacement of all cascades at a point beside the eye, filtered to `spacing` metres, chop applied.
fn water_displacement(at: vec2f, spacing: f32) -> vec3f {
  var sum = vec3f(0.0);
  for (var c = 0u; c < frame.count; c++) {
    let place = frame.cascades[c];
    let layer = u32(frame.layers[c].y);
    let uv = place.xy + at * place.z;
    let lod = log2(max(spacing * place.z * frame.n, 1e-3));
    // Nothing is left of waves that are shorter than two vertices.
    let share = clamp(log2(frame.n) - 2.0 - lod, 0.0, 1.0);
    if share > 0.0 {
      let tile = water_tile(c);
      let blend = tile_blend(tile, at);
      let smoothness = clamp(-2.0 * lod, 0.0, 1.0);
      let spline = water_spline(uv, frame.n, smoothness);
      let taps = select(1, WATER_SPLINE_TAPS, smoothness > 0.0);
      for (var i = 0u; i < blend.count; i++) {
        let shift = tile_shift(tile, blend, i);
        for (var k = 0; k < taps; k++) {
          let tap = water_spline_tap(spline, k);
          let d = textureSampleLevel(displacement_map, wave_sampler, tap.xy + shift, layer, lod);
          sum += (share * blend.weight[i] * tap.z) * d.xyz;
        }
      }
    }
  }
  return sum * vec3f(frame.chop_x, 1.0, frame.chop_z);
}

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

// The waves of one map within a footprint, before chop.
struct WaterWaves {
  // Of the height; and what the gradients of the weights add to it.
  slope: vec2f,
  lift: vec2f,
  // dDx/dx and dDz/dz, dDx/dz and dDz/dx.
  stretch: vec2f,
  shear: vec2f,
  // Variances of the slope: xx, zz, xz.
  variance: vec3f,
  // Of the slope, as in WaterSlope.
  lean: vec2f,
}

// From the map's texture coordinates at the eye's foot, 1 / patch and unit of the moments.
fn water_waves(at: vec2f, foot: WaterFootprint, cascade: u32, place: vec4f, tile: TilePlace) -> WaterWaves {
  var out: WaterWaves;
  let map = frame.layers[cascade];
  let layer = u32(map.y);
  let uv = place.xy + at * place.z;
  let texels = foot.size * place.z * frame.n;
  let long = max(length(foot.axis) * place.z * frame.n, texels);
  let blend = tile_blend(tile, at);
  let wide = texels / WATER_TAP;
  let share = 1.0 - smoothstep(WATER_FADE, WATER_FAR, sqrt(wide * long) / frame.n);
  let distant = share <= 0.0;
  // Magnified: smooth between texels, in one place.
  let near = select(0.0, 1.0 - smoothstep(0.8, 1.25, long), map.x < WATER_SMOOTH);
  let spline = water_spline(uv, frame.n, near);
  // Several texels in the footprint: as many taps as are worth it (one between texels blurs as much as a box of 1.4), half
  // as many for the smoother moments, and one for the displacement, whose part in the slope is of second order: both from
  // the nearest level. The weights are those of the middle. Of a distant map there is only its variance. What counts for
  // nothing is not read: the loops are empty then, since a software GPU reads on both sides of a branch.
  let places = clamp(i32(ceil(long / max(wide, 1.4) - 0.3)), 1, foot.taps);
  let taps = select(select(places, WATER_SPLINE_TAPS, near > 0.0), 0, distant);
  let lod = log2(max(texels, 1e-6));
  let long_lod = log2(max(WATER_TAP * long, 1e-6));
  // The moments know nothing finer than two texels; closer up they would count resolved waves twice. From where on they
  // count is fitted to the whole.
  let unresolved = select((1.0 - near * near) * clamp(lod + 0.5, 0.0, 1.0), 1.0, distant);
  let pairs = select((select(places, 1, distant) + 1) / 2, 0, unresolved <= 0.0);
  let wide_lod = select(min(lod + log2(f32(places) / f32(max(pairs, 1))), long_lod) - 1.0, 16.0, distant);
  let along = foot.axis * place.z;
  let copies = select(blend.count, 1u, distant);
  let resolved = select(1, 0, distant);
  for (var i = 0u; i < copies; i++) {
    let shift = tile_shift(tile, blend, i);
    var g = vec4f(0.0);
    var lean = vec2f(0.0);
    for (var k = 0; k < taps; k++) {
      let smooth_tap = water_spline_tap(spline, k);
      let off = (f32(k) + 0.5) / f32(places) - 0.5;
      let plain_tap = vec3f(uv + along * off, 1.0 / f32(places));
      let tap = select(plain_tap, smooth_tap, near > 0.0);
      let there = tap.z * textureSampleLevel(gradients_map, wave_sampler, tap.xy + shift, layer, lod);
      g += there;
      lean += select(sign(off), 0.0, near > 0.0) * there.xy;
    }
    var second = vec3f(0.0);
    for (var k = 0; k < pairs; k++) {
      let tap = uv + shift + along * ((f32(k) + 0.5) / f32(pairs) - 0.5);
      second += textureSampleLevel(moments_map, level_sampler, tap, layer, wide_lod).xyz;
    }
    g *= share;
    out.lean += share * blend.weight[i] * lean;
    second *= place.w / f32(max(pairs, 1));
    for (var k = 0; k < resolved; k++) {
      let d = share * textureSampleLevel(displacement_map, level_sampler, uv + shift, layer, long_lod);
      water_add(&out, g, d, vec3f(blend.weight[i], blend.along_x[i], blend.along_z[i]));
    }
    // Copies are independent: their variances add with the squares of the weights.
    let weight = map.z * unresolved * select(blend.weight[i] * blend.weight[i], 1.0, distant);
    out.variance += weight * max(second - vec3f(g.x * g.x, g.y * g.y, g.x * g.y), vec3f(0.0, 0.0, -1.0));
  }
  return out;
}

// Adds a copy with its weight and the weight's derivatives along x and z.
fn water_add(waves: ptr<function, WaterWaves>, g: vec4f, d: vec4f, weight: vec3f) {
  (*waves).slope += weight.x * g.xy;
  (*waves).lift += weight.yz * d.y;
  (*waves).stretch += weight.x * g.zw + weight.yz * d.xz;
  (*waves).shear += weight.x * d.ww + weight.zy * d.xz;
}

// Mean and variance of the slope within a footprint.
fn water_slope(at: vec2f, foot: WaterFootprint) -> WaterSlope {
  return water_slope_within(at, foot, foot);
}

// The same with another footprint for the ripples.
fn water_slope_within(at: vec2f, foot: WaterFootprint, ripple_foot: WaterFootprint) -> WaterSlope {
  var slope = vec2f(0.0);
  var stretch = vec2f(0.0);
  var shear = vec2f(0.0);
  var lean = vec2f(0.0);
  // Cox and Munk 1954: waves shorter than the finest cascade.
  var variance = frame.residual.xyz;
  for (var c = 0u; c < frame.count; c++) {
    let waves = water_waves(at, foot, c, frame.cascades[c], water_tile(c));
    slope += waves.slope + waves.lift;
    stretch += waves.stretch;
    shear += waves.shear;
    variance += waves.variance;
    lean += waves.lean;
  }
  // Ripples below the finest cascade, as a shrunk copy of it: slopes of short gravity waves are nearly scale-free.
  for (var r = 0u; r < frame.ripple_count; r++) {
    let c = select(frame.ripple_cascade_1, frame.ripple_cascade_0, r == 0u);
    let ripples = frame.ripples[r];
    let waves = water_waves(at, ripple_foot, c, vec4f(ripples.xyz, frame.cascades[c].w), water_tile(8u + r));
    slope += ripples.w * waves.slope;
    variance += ripples.w * ripples.w * waves.variance;
    lean += ripples.w * waves.lean;
  }
  let l = vec2f(frame.chop_x, frame.chop_z);
  let sx = 1.0 + l.x * stretch.x;
  let sz = 1.0 + l.y * stretch.y;
  let jacobian = sx * sz - l.x * l.y * shear.x * shear.y;
  // Where the surface folds the slope has no meaning: it stays finite under the foam.
  let over = 1.0 / max(jacobian, 0.25);
  var out: WaterSlope;
  out.mean = vec2f(slope.x * sz - slope.y * l.y * shear.y, slope.y * sx - slope.x * l.x * shear.x) * over;
  let steep = length(out.mean);
  out.mean *= min(1.0, 1.6 / max(steep, 1e-6));
  out.variance = water_covariance(variance);
  out.jacobian = jacobian;
  out.lean = vec2f(lean.x * sz - lean.y * l.y * shear.y, lean.y * sx - lean.x * l.x * shear.x) * over;
  return out;
}
