// Slopes of the displaced surface from those of the undisplaced sea: bound waves add to them, and the displacement
// squeezes or stretches them.

// Factors that turn gradients of the waves into the slope of their bound waves, where the waves have moved the water
// by `moved`: x is for the gradient of the height, y and z for those of the displacements along x and z. The height of
// bound waves is a sum of products of heights and displacements, so its gradient has each times the gradient of the
// other. The waves at a coast have no bound waves, as the factor of offshore waves in `gains` tells.
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

// Slope statistics of the displaced surface from sums over its waves, without the waves that are in no map.
fn water_displaced_slope(waves: WaterSlopeSums) -> WaterSlope {
  let sums = waves.sums;
  let sides = 1.0 + frame.choppiness * sums.stretch;
  let jacobian = water_jacobian(sums, sides);
  // Where the surface folds over itself, its slope has no meaning. It only needs to stay finite below the foam.
  let over = 1.0 / max(jacobian, 0.25);
  var out: WaterSlope;
  out.mean = water_slope_displaced(waves.sums.slope, sums, sides) * over;
  out.mean *= min(1.0, 1.6 / max(length(out.mean), 1e-6));
  out.variance = water_covariance_displaced(waves.variance, sums, sides, jacobian);
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
fn water_covariance_displaced(undisplaced: vec3f, sums: WaterDerivatives, sides: vec2f, jacobian: f32) -> vec3f {
  let covariance = water_limit_covariance(undisplaced);
  let shear = -frame.choppiness * sums.shear;
  let over = 1.0 / max(abs(jacobian), 0.25);
  let map = over * mat2x2f(sides.y, shear.x, shear.y, sides.x);
  let out = map * mat2x2f(covariance.xz, covariance.zy) * transpose(map);
  let sum = out[0].x + out[1].y;
  return vec3f(out[0].x, out[1].y, out[0].y) * min(1.0, WATER_MOST_VARIANCE / max(sum, 1e-9));
}
