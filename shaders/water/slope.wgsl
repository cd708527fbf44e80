// Mean and covariance of the slope of the surface within a pixel's footprint.

struct WaterSlope {
  // Mean slope of the displaced surface over the footprint.
  mean: vec2f,
  // Covariance (xx, zz, xz) of the slopes that the footprint does not resolve.
  variance: vec3f,
  jacobian: f32,
  // Half the difference of the slope between the two halves of an elongated footprint.
  half_slope_difference: vec2f,
  // How far the mean has been moved towards the first half, in these differences (water_seen).
  moved_by_halves: f32,
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
  // Covariance (xx, zz, xz) of the slopes of the waves in the maps that the footprint does not resolve.
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

// Gradients of a cascade at texture coordinates, averaged over the footprint, whose longer side is `along` there.
// `smoothness` is that of the spline between texels, or 0.
fn water_gradient_mean(
  map: FrameCascade, sampling: WaterSampling, smoothness: f32, along: vec2f, uv: vec2f,
) -> WaterGradientMean {
  var out: WaterGradientMean;
  if smoothness > 0.0 {
    let taps = water_spline_taps(uv, frame.n, smoothness);
    out.mean = water_sample_spline(gradients_map, taps, map.layer);
    return out;
  }
  // The middle of the first half, or of the whole footprint.
  let first_uv = uv - select(0.0, 0.25, sampling.has_halves) * along;
  out.mean = textureSampleLevel(gradients_map, trilinear_sampler, first_uv, map.layer, sampling.slope_lod);
  if sampling.has_halves {
    let last = textureSampleLevel(gradients_map, trilinear_sampler, uv + 0.25 * along, map.layer, sampling.slope_lod);
    out.half_slope_difference = 0.5 * (last.xy - out.mean.xy);
    out.mean = 0.5 * (out.mean + last);
  }
  return out;
}

// Mip level of the displacement map from which shears, and the change of weights between copies, are left out.
const WATER_SHEAR_LOD = 1.0;

// Weight of a copy of a patch from which it is interpolated by a spline.
const WATER_SPLINE_COPY_WEIGHT = 0.5;

// Adds the waves of a cascade or of ripples, without the fraction `carried` that the mesh vertices already hold. `gust`
// is a factor on their slope variance, and `gains` those of a coast.
fn water_add_waves(
  out: ptr<function, WaterSlopeSums>, at: vec2f, foot: WaterFootprint, cascade: u32, carried: f32, gust: f32,
  gains: vec3f,
) {
  let map = frame.cascades[cascade];
  let sampling = water_sampling(map, foot);
  let along = foot.axis * map.inverse_patch;
  var own = (1.0 - carried) * sampling.slope_weight;
  var variance_gain = map.variance_factor * sampling.variance_weight;
  if WATER_GUSTS {
    own *= sqrt(gust);
    variance_gain *= gust;
  }
  if WATER_COAST {
    let gain = coast_slope_gain(map, gains);
    own *= gain;
    variance_gain *= gain * gain;
  }
  let slope_gain = own * map.slope_scale;
  let stretch_gain = select(0.0, own, cascade < frame.cascade_count);
  // Ripples add slopes, but no displacement. Where maps are minified, products of shears have a mean near 0.
  let has_shear = cascade < frame.cascade_count && sampling.displacement_lod < WATER_SHEAR_LOD;
  let first_uv = map.uv_below_eye + at * map.inverse_patch;
  var next = tile_blend(map.tile_position, at, has_shear);
  for (var i = 0u; i < TILE_COPIES; i++) {
    let blend = next;
    next = tile_next_copy(blend);
    let weight = blend.weight.x;
    if weight <= WATER_LEAST_COPY_WEIGHT {
      continue;
    }
    let uv = first_uv + tile_copy_shift(map.tile_position, blend);
    let smoothness = select(0.0, sampling.spline_smoothness, weight > WATER_SPLINE_COPY_WEIGHT);
    let gradients = water_gradient_mean(map, sampling, smoothness, along, uv);
    if has_shear {
      let d = textureSampleLevel(displacement_map, nearest_mip_sampler, uv, map.layer, sampling.displacement_lod);
      let weights = own * vec3f(weight, tile_weight_gradient(map.tile_position, blend));
      (*out).sums = water_add_patch_copy((*out).sums, gradients.mean, d, weights);
    } else {
      (*out).sums.slope += (slope_gain * weight) * gradients.mean.xy;
      (*out).sums.stretch += (stretch_gain * weight) * gradients.mean.zw;
    }
    (*out).half_slope_difference += (slope_gain * weight) * gradients.half_slope_difference;
    if sampling.variance_weight > 0.0 {
      // Copies of the patch are independent: their variances add with the squares of their weights.
      let mean = sampling.slope_weight * gradients.mean.xy;
      (*out).variance +=
        (variance_gain * weight * weight) * water_unresolved_covariance(map, uv, sampling.displacement_lod - 1.0, mean);
    }
  }
}

// Least part of the second moments of slopes that counts as unresolved variance, and the factor of the square of the
// mean slope that makes up for it. With them, the mean square of all slopes in the full tier is right within 3 % for
// pixels that are not very long, and within 4 % for all.
const WATER_LEAST_UNRESOLVED = 0.2;
const WATER_RESOLVED_FACTOR = 1.2;

// Covariance (xx, zz, xz) of a cascade's slopes that a footprint with the mean slope `mean` does not resolve, at
// texture coordinates, from a mip level of their second moments. The moments less the square of the mean would be 0
// wherever the mean is steep: such pixels would mirror a single point, and be dark or bright dots.
fn water_unresolved_covariance(map: FrameCascade, uv: vec2f, lod: f32, mean: vec2f) -> vec3f {
  let all = map.moment_unit * textureSampleLevel(moments_map, nearest_mip_sampler, uv, map.layer, lod).xyz;
  return max(all - WATER_RESOLVED_FACTOR * maths_self_products(mean), vec3f(WATER_LEAST_UNRESOLVED * all.xy, -1.0));
}

// Covariance (xx, zz, xz) of all slopes of a cascade around an undisplaced position, from the coarsest mip level.
fn water_whole_covariance(map: FrameCascade, at: vec2f) -> vec3f {
  let uv = map.uv_below_eye + at * map.inverse_patch;
  let moments = textureSampleLevel(moments_map, nearest_mip_sampler, uv, map.layer, WATER_COARSEST_LOD).xyz;
  return (map.variance_factor * map.moment_unit) * moments;
}

// As water_whole_covariance, with the factors of gusts and of a coast.
fn water_distant_covariance(map: FrameCascade, at: vec2f, gust: f32, gains: vec3f) -> vec3f {
  var whole = water_whole_covariance(map, at);
  if WATER_GUSTS {
    whole *= gust;
  }
  if WATER_COAST {
    let gain = coast_slope_gain(map, gains);
    whole *= gain * gain;
  }
  return whole;
}

// Slope statistics within a footprint at an undisplaced position relative to the point below the eye, m, from which the
// waves have moved the water by `moved`, m, without gusts.
fn water_slope(at: vec2f, moved: vec3f, foot: WaterFootprint) -> WaterSlope {
  return water_slope_with_carried(at, moved, foot, foot, WaterDerivatives(), false, 1.0);
}

// Slope statistics within a footprint, with another footprint for the ripples. If `carries`, the maps are added to the
// slopes `carried` that the mesh holds at this point; else `carried` must hold no waves. `gust`: water_gust_gain there.
fn water_slope_with_carried(
  at: vec2f, moved: vec3f, foot: WaterFootprint, ripple_foot: WaterFootprint, carried: WaterDerivatives, carries: bool,
  gust: f32,
) -> WaterSlope {
  var waves: WaterSlopeSums;
  waves.sums = carried;
  var gains: vec3f;
  if WATER_COAST {
    gains = coast_gains(at);
  }
  let inverse_step = water_inverse_carrying_step(at);
  // Slopes of short gravity waves are similar at every scale, so that a shrunk copy of a cascade can serve as ripples.
  for (var c = 0u; c < frame.cascade_count + frame.ripple_count; c++) {
    let map = frame.cascades[c];
    let is_ripple = c >= frame.cascade_count;
    var within = foot;
    if is_ripple {
      within = ripple_foot;
    }
    let share = select(0.0, water_carried_fraction(map, inverse_step), carries && !is_ripple);
    let own_gust = water_gust_share(map, gust);
    if water_is_distant(map, within) {
      waves.variance += water_distant_covariance(map, at, own_gust, gains);
    } else if share < 1.0 {
      water_add_waves(&waves, at, within, c, share, own_gust, gains);
    }
  }
  if WATER_COAST {
    // Surf squeezes the waves that the mesh carries, but not the short waves that ride on them.
    let of_mesh = water_jacobian(carried, 1.0 + frame.choppiness * carried.stretch);
    let squeeze = mix(1.0, clamp(of_mesh, 0.25, 1.0), gains.z);
    waves.sums.slope = mix(carried.slope, waves.sums.slope, squeeze);
    waves.half_slope_difference *= squeeze;
  }
  let bound = water_bound_factors(moved, gains);
  waves.sums.slope += water_bound_slope(waves.sums, bound);
  waves.half_slope_difference *= 1.0 + bound.x;
  var out = water_displaced_slope(waves);
  out.variance = water_unresolved_variance(waves, out.jacobian, bound, gains, gust);
  return out;
}
