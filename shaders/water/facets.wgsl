// Distributions of unresolved slopes: Gaussian (Beckmann), as Cox and Munk (1954) measured at sea, or GGX (Trowbridge
// and Reitz) with alpha^2 = 2 sigma^2, both with any mean and covariance; or a Blinn-Phong lobe. They are compiled in
// by override constants, because a software GPU executes both sides of a branch.

override WATER_GGX: bool = false;
override WATER_PHONG: bool = false;

// Projected area of the facets that are visible from a direction, per horizontal area (Smith's masking). `height` and
// `across`: vertical and horizontal part of the direction; `mean`, `sigma`: mean and deviation of the tilt towards it.
fn water_projected_area(height: f32, across: f32, mean: f32, sigma: f32) -> f32 {
  let facing = height + across * mean;
  let scale = max(across * sigma, 1e-6);
  if WATER_GGX {
    return 0.5 * (facing + sqrt(facing * facing + 2.0 * scale * scale));
  }
  let a = facing / scale;
  let density = 0.39894228 * exp(-0.5 * min(a * a, 80.0));
  // Upper tail of the normal distribution at |a|, divided by its density (Abramowitz and Stegun 26.2.17).
  let t = 1.0 / (1.0 + 0.2316419 * abs(a));
  let tail = t * (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  return scale * max(density * (1.0 - abs(a) * tail) + max(a, 0.0), 1e-7);
}

// Probability density of slopes with the covariance `variance` (xx, zz, xz), at the distance `off` from their mean.
fn water_slope_density(off: vec2f, variance: vec3f) -> f32 {
  // The finite disc of the sun widens the range of slopes that reflect it.
  let xx = variance.x + frame.sun_slope_variance;
  let zz = variance.y + frame.sun_slope_variance;
  let xz = variance.z;
  let det = max(xx * zz - xz * xz, 0.02 * xx * zz);
  let square = (zz * off.x * off.x - 2.0 * xz * off.x * off.y + xx * off.y * off.y) / det;
  let peak = 1.0 / (2.0 * ATM_PI * sqrt(det));
  if WATER_GGX {
    let w = 1.0 + 0.5 * max(square, 0.0);
    return peak / (w * w);
  }
  return peak * exp(-0.5 * clamp(square, 0.0, 160.0));
}

// Slope statistics as seen along one direction: towards it, across it, and the covariance of both.
struct WaterFacets {
  toward: vec2f,
  side: vec2f,
  height: f32,
  across: f32,
  // Tilt towards the direction: mean, deviation, and covariance with the slope across it, divided by the deviation.
  mean_tilt: f32,
  tilt_sigma: f32,
  tilt_side_shear: f32,
  side_mean: f32,
  side_sigma: f32,
}

fn water_facets_towards(dir: vec3f, slope: WaterSlope) -> WaterFacets {
  // For a vertical direction any azimuth will do.
  let level = select(vec2f(1e-4, 0.0), dir.xz, dot(dir.xz, dir.xz) > 1e-8);
  var f: WaterFacets;
  f.across = length(level);
  f.height = dir.y;
  f.toward = level / f.across;
  f.side = vec2f(-f.toward.y, f.toward.x);
  let cov = mat2x2f(slope.variance.x, slope.variance.z, slope.variance.z, slope.variance.y);
  f.tilt_sigma = sqrt(max(dot(f.toward, cov * f.toward), 1e-6));
  f.side_sigma = sqrt(max(dot(f.side, cov * f.side), 1e-6));
  f.tilt_side_shear = dot(f.toward, cov * f.side) / f.tilt_sigma;
  // The tilt towards the eye is minus the slope along the direction.
  f.mean_tilt = -dot(slope.mean, f.toward);
  f.side_mean = dot(slope.mean, f.side);
  return f;
}

// Projected area towards the direction per horizontal area: of all visible facets, and of the mean facet.
fn water_facets_projected_area(f: WaterFacets) -> vec2f {
  return vec2f(water_projected_area(f.height, f.across, f.mean_tilt, f.tilt_sigma), f.height + f.across * f.mean_tilt);
}

const WATER_QUADRATURE_NODES = 8;

struct WaterQuadratureNode {
  slope: vec2f,
  // Variance of the slope across the direction, given the slope along it.
  side_variance: f32,
  weight: f32,
  // Interval of slopes that the node represents.
  slope_interval: f32,
}

// Node i of a quadrature over the visible slopes, weighted by projected area. Small even steps resolve the edge of the
// sky that the slopes reflect.
fn water_quadrature_node(f: WaterFacets, i: i32) -> WaterQuadratureNode {
  let at = (f32(i) + 0.5) / f32(WATER_QUADRATURE_NODES);
  var t: f32;
  var node: WaterQuadratureNode;
  var spread = 1.0;
  if WATER_GGX {
    // The visible area beyond the slope alpha tan(a) is (r cos(a + phi) + c) / 2. Nodes are steps of this area, finer
    // towards facets seen at grazing angles, which reflect most.
    let area = at * (1.4 - 0.4 * at);
    let alpha = 1.41421356 * f.tilt_sigma;
    let c = f.height / f.across + f.mean_tilt;
    let r = sqrt(alpha * alpha + c * c);
    let a = 0.5 * ATM_PI - atm_asin((area * (r + c) - c) / r) - atan2(c, alpha);
    t = 1.41421356 * tan(clamp(a, -1.5, 1.5));
    node.weight = 1.4 - 0.8 * at;
    node.slope_interval = 1.3 * node.weight * f.tilt_sigma * (1.0 + 0.5 * t * t) / f32(WATER_QUADRATURE_NODES);
    // With GGX, a large slope along the direction makes a large slope across it more likely.
    spread = 0.5 * (2.0 + t * t);
  } else {
    // Slopes that are turned away from the eye are invisible.
    let low = -(f.height / f.across + f.mean_tilt) / f.tilt_sigma;
    let from_t = max(low, -2.8);
    // Nodes cover the density up to 3 deviations, or a length of about 8 / t in its far tail.
    let range = max(3.0 - from_t, 8.0 / max(from_t, 2.9));
    t = from_t + at * range;
    // Scaled, so that not all weights underflow in the far tail. Differences come first, to keep their precision there.
    let scale = max(low, 0.0);
    let past = from_t - scale + at * range;
    node.weight = exp(-0.5 * past * (t + scale)) * (from_t - low + at * range);
    node.slope_interval = range * f.tilt_sigma / f32(WATER_QUADRATURE_NODES);
  }
  node.slope = f.toward * -(f.mean_tilt + f.tilt_sigma * t) + f.side * (f.side_mean - f.tilt_side_shear * t);
  node.side_variance = spread * max(f.side_sigma * f.side_sigma - f.tilt_side_shear * f.tilt_side_shear, 0.0);
  return node;
}
