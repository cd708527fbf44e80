// Mean and covariance of the slope of the surface within a pixel's footprint.

struct WaterSlope {
  // Mean slope of the displaced surface over the footprint.
  mean: vec2f,
  // Covariance (xx, zz, xz) of the slopes that the footprint does not resolve.
  variance: vec3f,
  jacobian: f32,
  // Half the difference of the slope between the two halves of an elongated footprint.
  lean: vec2f,
}

// Unit normal of a surface with the slope `slope` along x and z.
fn water_normal(slope: vec2f) -> vec3f {
  return normalize(vec3f(-slope.x, 1.0, -slope.y));
}

// Limits xz of a covariance (xx, zz, xz) that sums several estimates to what its xx and zz allow. Beyond that, a
// Gaussian would be largest where there are no slopes.
fn water_covariance(variance: vec3f) -> vec3f {
  let most = 0.97 * sqrt(max(variance.x * variance.y, 0.0));
  return vec3f(variance.xy, clamp(variance.z, -most, most));
}

// Sums over the waves within a footprint, in undisplaced coordinates.
struct WaterWaves {
  sums: WaterSums,
  // Covariance (xx, zz, xz) of the unresolved slopes.
  variance: vec3f,
  // Half the difference of the slope between the two halves of the footprint.
  lean: vec2f,
}

struct WaterGradients {
  // Mean of the gradients map over the footprint.
  mean: vec4f,
  // Half the difference of the slope between the two halves of the footprint.
  lean: vec2f,
}

// Gradients of a cascade at texture coordinates, averaged over the footprint.
fn water_gradients(map: FrameCascade, reading: WaterReading, uv: vec2f) -> WaterGradients {
  var out: WaterGradients;
  if reading.near > 0.0 {
    out.mean = water_splined(gradients_map, water_spline(uv, frame.n, reading.near), map.layer);
    return out;
  }
  let part = 1.0 / f32(reading.taps);
  for (var k = 0; k < reading.taps; k++) {
    let off = (f32(k) + 0.5) * part - 0.5;
    let tap = textureSampleLevel(gradients_map, wave_sampler, uv + reading.along * off, map.layer, reading.slope_lod);
    out.mean += part * tap;
    out.lean += (part * sign(off)) * tap.xy;
  }
  return out;
}

// Second moments (xx, zz, xz) of a cascade's slopes at texture coordinates, averaged over the footprint.
fn water_moments(map: FrameCascade, reading: WaterReading, uv: vec2f) -> vec3f {
  let part = 1.0 / f32(max(reading.moment_taps, 1));
  var sum = vec3f(0.0);
  for (var k = 0; k < reading.moment_taps; k++) {
    let tap = uv + reading.along * ((f32(k) + 0.5) * part - 0.5);
    sum += textureSampleLevel(moments_map, level_sampler, tap, map.layer, reading.moment_lod).xyz;
  }
  return (map.moment_scale * part) * sum;
}

// Adds the waves of a cascade or of ripples, without the fraction `carried` that the mesh vertices already hold.
fn water_add_waves(out: ptr<function, WaterWaves>, at: vec2f, foot: WaterFootprint, cascade: u32, carried: f32) {
  let map = frame.cascades[cascade];
  let reading = water_reading(map, foot);
  let is_distant = reading.share <= 0.0;
  // Ripples add slopes, but no displacement.
  let slope_gain = (1.0 - carried) * map.slope_scale;
  let own = select(0.0, 1.0 - carried, cascade < frame.count);
  let variance_gain = map.slope_scale * map.slope_scale * map.variance_gain * reading.unresolved;
  var blend = tile_blend(map.tile, at);
  // The variance of a distant map is the same for every copy of the patch.
  let copies = select(blend.count, 1u, is_distant);
  for (var i = 0u; i < copies; i++) {
    let uv = map.uv + at * map.inverse_patch + tile_shift(map.tile, blend);
    let weight = tile_weight(blend);
    var mean = vec2f(0.0);
    if !is_distant {
      let gradients = water_gradients(map, reading, uv);
      let g = reading.share * gradients.mean;
      let d = textureSampleLevel(displacement_map, level_sampler, uv, map.layer, reading.displacement_lod);
      (*out).sums = water_sum((*out).sums, vec4f(slope_gain * g.xy, own * g.zw), (own * reading.share) * d, weight);
      (*out).lean += (slope_gain * reading.share * weight.x) * gradients.lean;
      mean = g.xy;
    }
    // Copies of the patch are independent: their variances add with the squares of their weights.
    let part = variance_gain * select(weight.x * weight.x, 1.0, is_distant);
    let beyond = water_moments(map, reading, uv) - vec3f(mean * mean, mean.x * mean.y);
    (*out).variance += part * max(beyond, vec3f(0.0, 0.0, -1.0));
    blend = tile_next(blend);
  }
}

// Slope statistics within a footprint at an undisplaced position relative to the point below the eye, m.
fn water_slope(at: vec2f, foot: WaterFootprint) -> WaterSlope {
  return water_slope_beyond(at, foot, foot, WaterSums(), false);
}

// Slope statistics within a footprint, with another footprint for the ripples. If `carries`, the maps are added to the
// slopes `carried` that the mesh holds at this point; else `carried` must be 0.
fn water_slope_beyond(
  at: vec2f, foot: WaterFootprint, ripple_foot: WaterFootprint, carried: WaterSums, carries: bool,
) -> WaterSlope {
  var waves: WaterWaves;
  waves.sums = carried;
  // Covariance of the slopes of all waves that are in no map (Cox and Munk 1954).
  waves.variance = frame.residual;
  // Slopes of short gravity waves are similar at every scale, so that a shrunk copy of a cascade can serve as ripples.
  for (var c = 0u; c < frame.count + frame.ripple_count; c++) {
    let is_ripple = c >= frame.count;
    let share = select(0.0, water_carried(c, at), carries && !is_ripple);
    if share < 1.0 {
      var within = foot;
      if is_ripple {
        within = ripple_foot;
      }
      water_add_waves(&waves, at, within, c, share);
    }
  }
  return water_displaced_slope(waves);
}

// Slope statistics of the displaced surface from sums over its waves.
fn water_displaced_slope(waves: WaterWaves) -> WaterSlope {
  let sums = waves.sums;
  let sides = 1.0 + frame.chop * sums.stretch;
  let jacobian = sides.x * sides.y - frame.chop.x * frame.chop.y * sums.shear.x * sums.shear.y;
  // Where the surface folds over itself, its slope has no meaning. It only needs to stay finite below the foam.
  let over = 1.0 / max(jacobian, 0.25);
  var out: WaterSlope;
  out.mean = water_tilted(waves.sums.slope, sums, sides) * over;
  out.mean *= min(1.0, 1.6 / max(length(out.mean), 1e-6));
  out.variance = water_covariance(waves.variance);
  out.jacobian = jacobian;
  out.lean = water_tilted(waves.lean, sums, sides) * over;
  return out;
}

// Slope of the displaced surface times its Jacobian, from the undisplaced slope. `sides` is 1 + chop (dDx/dx, dDz/dz).
fn water_tilted(slope: vec2f, sums: WaterSums, sides: vec2f) -> vec2f {
  return slope * sides.yx - slope.yx * frame.chop.yx * sums.shear.yx;
}
