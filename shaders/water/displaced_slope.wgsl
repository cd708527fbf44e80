// Slopes of the displaced surface from those of the undisplaced sea: bound waves add to them, and the displacement
// squeezes or stretches them.

// Factors that turn gradients of the waves into the slope of their bound waves, where the waves have moved the water
// by `moved`: x is for the gradient of the height, y and z for those of the displacements along x and z. The height of
// bound waves is a sum of products of heights and displacements, so its gradient has each times the gradient of the
// other. Waves that come ashore have no bound waves: `gains.y` is the factor of the waves offshore.
fn water_bound_factors(moved: vec3f, gains: vec3f) -> vec3f {
  var factors = frame.bound_slope_factors * moved.yxz;
  if WATER_COAST {
    factors *= gains.y;
  }
  // `moved` contains the bound waves, whose height does not count in the products.
  factors.x -= frame.bound_slope_factors.x * (0.5 * dot(factors, moved.yxz) + frame.bound_level_m);
  factors.x += frame.bound_elevation_gain;
  return factors;
}

// Slope that the bound waves add to the slope of the elevation.
fn water_bound_slope(sums: WaterDerivatives, factors: vec3f) -> vec2f {
  return factors.x * sums.slope + factors.y * vec2f(sums.stretch.x, sums.shear.x)
    + factors.z * vec2f(sums.shear.y, sums.stretch.y);
}

// Mean slope of the displaced surface from sums over its waves, its Jacobian and the difference of the halves. The
// variance is left at 0 (water_unresolved_variance).
fn water_displaced_slope(waves: WaterSlopeSums) -> WaterSlope {
  let sums = waves.sums;
  let sides = 1.0 + frame.choppiness * sums.stretch;
  let jacobian = water_jacobian(sums, sides);
  // Where the surface folds over itself, its slope has no meaning. It only needs to stay finite below the foam.
  let over = 1.0 / max(jacobian, 0.25);
  var out: WaterSlope;
  out.mean = water_slope_displaced(waves.sums.slope, sums, sides) * over;
  out.mean *= min(1.0, 1.6 / max(length(out.mean), 1e-6));
  out.jacobian = jacobian;
  out.half_slope_difference = water_slope_displaced(waves.half_slope_difference, sums, sides) * over;
  return out;
}

// Jacobian of the displacement. `sides` is 1 + chop (dDx/dx, dDz/dz).
fn water_jacobian(sums: WaterDerivatives, sides: vec2f) -> f32 {
  return sides.x * sides.y - frame.choppiness.x * frame.choppiness.y * sums.shear.x * sums.shear.y;
}

// Slope of the displaced surface times its Jacobian, from the undisplaced slope. `sides` is 1 + chop (dDx/dx, dDz/dz).
fn water_slope_displaced(slope: vec2f, sums: WaterDerivatives, sides: vec2f) -> vec2f {
  return slope * sides.yx - slope.yx * frame.choppiness.yx * sums.shear.yx;
}

// Largest sum of the two variances of slopes of the displaced surface: where it folds, they have no meaning.
const WATER_MOST_VARIANCE = 0.5;

// Covariance (xx, zz, xz) of slopes of the displaced surface, from that of undisplaced slopes: waves are squeezed and
// steep on the crests that carry them, and drawn out in the troughs.
fn water_covariance_displaced(undisplaced: vec3f, sums: WaterDerivatives, jacobian: f32) -> vec3f {
  let sides = 1.0 + frame.choppiness * sums.stretch;
  let shear = -frame.choppiness * sums.shear;
  let over = 1.0 / max(abs(jacobian), 0.25);
  let map = over * mat2x2f(sides.y, shear.x, shear.y, sides.x);
  let out = map * mat2x2f(undisplaced.xz, undisplaced.zy) * transpose(map);
  let sum = out[0].x + out[1].y;
  return vec3f(out[0].x, out[1].y, out[0].y) * min(1.0, WATER_MOST_VARIANCE / max(sum, 1e-9));
}

// Covariance (xx, zz, xz) of all slopes that a footprint does not resolve, on the displaced surface. `bound` is
// water_bound_factors there: bound waves add the share `bound.x` of each slope to it. `gains` are those of a coast.
fn water_unresolved_variance(waves: WaterSlopeSums, jacobian: f32, bound: vec3f, gains: vec3f, gust: f32) -> vec3f {
  let with_bound = 1.0 + bound.x;
  let of_maps = water_limit_covariance(with_bound * with_bound * waves.variance);
  var out = water_covariance_displaced(of_maps, waves.sums, jacobian);
  if WATER_COAST {
    // Waves that come ashore do not squeeze the short waves that ride on them.
    out = mix(out, of_maps, gains.z);
  }
  // The slopes of all waves that are in no map (Cox and Munk 1954).
  let in_no_map = frame.residual_slope_covariance;
  if WATER_GUSTS {
    return out + gust * in_no_map;
  }
  return out + in_no_map;
}
