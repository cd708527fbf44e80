// Mean and covariance of the slope of the surface within a pixel's footprint.

struct WaterSlope {
  // Mean slope of the displaced surface over the footprint.
  mean: vec2f,
  // Covariance (xx, zz, xz) of the slopes that the footprint does not resolve.
  variance: vec3f,
  jacobian: f32,
  // Half the difference of the slope between the two halves of an elongated footprint.
  half_slope_difference: vec2f,
}

// Unit normal of a surface with the slope `slope` along x and z.
fn water_normal(slope: vec2f) -> vec3f {
  return normalize(vec3f(-slope.x, 1.0, -slope.y));
}

// Limits xz of a covariance (xx, zz, xz) that sums several estimates to what its xx and zz allow. Beyond that, a
// Gaussian would be largest where there are no slopes.
fn water_limit_covariance(variance: vec3f) -> vec3f {
  let most = 0.97 * sqrt(max(variance.x * variance.y, 0.0));
  return vec3f(variance.xy, clamp(variance.z, -most, most));
}

// Sums over the waves within a footprint, in undisplaced coordinates.
struct WaterSlopeSums {
  sums: WaterDerivatives,
  // Covariance (xx, zz, xz) of the unresolved slopes.
  variance: vec3f,
  // Half the difference of the slope between the two halves of the footprint.
  half_slope_difference: vec2f,
}

struct WaterGradientMean {
  // Mean of the gradients map over the footprint.
  mean: vec4f,
  // Half the difference of the slope between the two halves of the footprint.
  half_slope_difference: vec2f,
}

// Gradients of a cascade at texture coordinates, averaged over the footprint.
fn water_gradient_mean(map: FrameCascade, sampling: WaterSampling, uv: vec2f) -> WaterGradientMean {
  var out: WaterGradientMean;
  if sampling.spline_smoothness > 0.0 {
    let taps = water_spline_taps(uv, frame.n, sampling.spline_smoothness);
    out.mean = water_sample_spline(gradients_map, taps, map.layer);
    return out;
  }
  let part = 1.0 / f32(sampling.taps);
  for (var k = 0; k < sampling.taps; k++) {
    let off = (f32(k) + 0.5) * part - 0.5;
    let at = uv + sampling.along * off;
    let tap = textureSampleLevel(gradients_map, trilinear_sampler, at, map.layer, sampling.slope_lod);
    out.mean += part * tap;
    out.half_slope_difference += (part * sign(off)) * tap.xy;
  }
  return out;
}

// Second moments (xx, zz, xz) of a cascade's slopes at texture coordinates, averaged over the footprint.
fn water_slope_moments(map: FrameCascade, sampling: WaterSampling, uv: vec2f) -> vec3f {
  let part = 1.0 / f32(max(sampling.moment_taps, 1));
  var sum = vec3f(0.0);
  for (var k = 0; k < sampling.moment_taps; k++) {
    let tap = uv + sampling.along * ((f32(k) + 0.5) * part - 0.5);
    sum += textureSampleLevel(moments_map, nearest_mip_sampler, tap, map.layer, sampling.moment_lod).xyz;
  }
  return (map.moment_unit * part) * sum;
}

// Adds the waves of a cascade or of ripples, without the fraction `carried` that the mesh vertices already hold.
fn water_add_waves(out: ptr<function, WaterSlopeSums>, at: vec2f, foot: WaterFootprint, cascade: u32, carried: f32) {
  let map = frame.cascades[cascade];
  let sampling = water_sampling(map, foot);
  let is_distant = sampling.slope_weight <= 0.0;
  // Ripples add slopes, but no displacement.
  let slope_gain = (1.0 - carried) * map.slope_scale;
  let own = select(0.0, 1.0 - carried, cascade < frame.cascade_count);
  let variance_gain = map.slope_scale * map.slope_scale * map.variance_correction * sampling.variance_weight;
  var blend = tile_blend(map.tile_position, at);
  // The variance of a distant map is the same for every copy of the patch.
  let copies = select(blend.count, 1u, is_distant);
  for (var i = 0u; i < copies; i++) {
    let uv = map.uv_below_eye + at * map.inverse_patch + tile_copy_shift(map.tile_position, blend);
    let weight = tile_copy_weight(blend);
    var mean = vec2f(0.0);
    if !is_distant {
      let gradients = water_gradient_mean(map, sampling, uv);
      let g = sampling.slope_weight * gradients.mean;
      let d = textureSampleLevel(displacement_map, nearest_mip_sampler, uv, map.layer, sampling.displacement_lod);
      let own_g = vec4f(slope_gain * g.xy, own * g.zw);
      (*out).sums = water_add_patch_copy((*out).sums, own_g, (own * sampling.slope_weight) * d, weight);
      (*out).half_slope_difference += (slope_gain * sampling.slope_weight * weight.x) * gradients.half_slope_difference;
      mean = g.xy;
    }
    // Copies of the patch are independent: their variances add with the squares of their weights.
    let part = variance_gain * select(weight.x * weight.x, 1.0, is_distant);
    let beyond = water_slope_moments(map, sampling, uv) - vec3f(mean * mean, mean.x * mean.y);
    (*out).variance += part * max(beyond, vec3f(0.0, 0.0, -1.0));
    blend = tile_next_copy(blend);
  }
}

// Slope statistics within a footprint at an undisplaced position relative to the point below the eye, m.
fn water_slope(at: vec2f, foot: WaterFootprint) -> WaterSlope {
  return water_slope_with_carried(at, foot, foot, WaterDerivatives(), false);
}

// Slope statistics within a footprint, with another footprint for the ripples. If `carries`, the maps are added to the
// slopes `carried` that the mesh holds at this point; else `carried` must be 0.
fn water_slope_with_carried(
  at: vec2f, foot: WaterFootprint, ripple_foot: WaterFootprint, carried: WaterDerivatives, carries: bool,
) -> WaterSlope {
  var waves: WaterSlopeSums;
  waves.sums = carried;
  // Covariance of the slopes of all waves that are in no map (Cox and Munk 1954).
  waves.variance = frame.residual_slope_covariance;
  // Slopes of short gravity waves are similar at every scale, so that a shrunk copy of a cascade can serve as ripples.
  for (var c = 0u; c < frame.cascade_count + frame.ripple_count; c++) {
    let is_ripple = c >= frame.cascade_count;
    let share = select(0.0, water_carried_fraction(c, at), carries && !is_ripple);
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
fn water_displaced_slope(waves: WaterSlopeSums) -> WaterSlope {
  let sums = waves.sums;
  let sides = 1.0 + frame.choppiness * sums.stretch;
  let jacobian = sides.x * sides.y - frame.choppiness.x * frame.choppiness.y * sums.shear.x * sums.shear.y;
  // Where the surface folds over itself, its slope has no meaning. It only needs to stay finite below the foam.
  let over = 1.0 / max(jacobian, 0.25);
  var out: WaterSlope;
  out.mean = water_slope_displaced(waves.sums.slope, sums, sides) * over;
  out.mean *= min(1.0, 1.6 / max(length(out.mean), 1e-6));
  out.variance = water_limit_covariance(waves.variance);
  out.jacobian = jacobian;
  out.half_slope_difference = water_slope_displaced(waves.half_slope_difference, sums, sides) * over;
  return out;
}

// Slope of the displaced surface times its Jacobian, from the undisplaced slope. `sides` is 1 + chop (dDx/dx, dDz/dz).
fn water_slope_displaced(slope: vec2f, sums: WaterDerivatives, sides: vec2f) -> vec2f {
  return slope * sides.yx - slope.yx * frame.choppiness.yx * sums.shear.yx;
}
