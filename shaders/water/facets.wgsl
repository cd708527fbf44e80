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

// Tilt of the surface towards one direction: minus the slope along it.
struct WaterTilt {
  // Unit vector (x, z) of the direction's azimuth.
  toward: vec2f,
  // Vertical and horizontal part of the direction.
  height: f32,
  across: f32,
  mean: f32,
  sigma: f32,
}

// Slope statistics as seen along one direction.
struct WaterFacets {
  tilt: WaterTilt,
  // Covariance of the tilt with the slope across the direction, divided by the tilt's deviation.
  tilt_side_shear: f32,
  // Unit vector (x, z) across the direction; mean and deviation of the slope along this vector.
  side: vec2f,
  side_mean: f32,
  side_sigma: f32,
}

fn water_tilt_towards(dir: vec3f, slope: WaterSlope) -> WaterTilt {
  // For a vertical direction any azimuth will do.
  let level = select(vec2f(1e-4, 0.0), dir.xz, dot(dir.xz, dir.xz) > 1e-8);
  var t: WaterTilt;
  t.across = length(level);
  t.height = dir.y;
  t.toward = level / t.across;
  t.mean = -dot(slope.mean, t.toward);
  let square = dot(slope.variance.xy, t.toward * t.toward) + 2.0 * slope.variance.z * t.toward.x * t.toward.y;
  t.sigma = sqrt(max(square, 1e-6));
  return t;
}

fn water_facets_towards(dir: vec3f, slope: WaterSlope) -> WaterFacets {
  var f: WaterFacets;
  f.tilt = water_tilt_towards(dir, slope);
  f.side = vec2f(-f.tilt.toward.y, f.tilt.toward.x);
  let cov_side = mat2x2f(slope.variance.x, slope.variance.z, slope.variance.z, slope.variance.y) * f.side;
  f.side_sigma = sqrt(max(dot(f.side, cov_side), 1e-6));
  f.tilt_side_shear = dot(f.tilt.toward, cov_side) / f.tilt.sigma;
  f.side_mean = dot(slope.mean, f.side);
  return f;
}

// Projected area towards the direction per horizontal area: of all visible facets, and of the mean facet.
fn water_tilt_projected_area(t: WaterTilt) -> vec2f {
  return vec2f(water_projected_area(t.height, t.across, t.mean, t.sigma), t.height + t.across * t.mean);
}

const WATER_QUADRATURE_NODES = 8;

// Quadrature over the slopes that are visible from a direction, weighted by projected area.
struct WaterQuadrature {
  // Tilts are counted in deviations from the mean tilt. `low` is the tilt below which facets are turned away from the
  // eye; the nodes begin at `from_t` and cover `range`. GGX uses the three otherwise: `low` is the cosine of the mean
  // facet towards the eye (unscaled, divided by alpha and the eye's horizontal part), `from_t` is sqrt(1 + low^2), and
  // `range` is atan(1 / low), from 0 to pi.
  low: f32,
  from_t: f32,
  range: f32,
  // Slope at tilt 0, and its change with the tilt.
  slope: vec2f,
  slope_per_tilt: vec2f,
  // Variance of the slope across the direction, given the slope along it.
  side_variance: f32,
}

struct WaterQuadratureNode {
  slope: vec2f,
  side_variance: f32,
  weight: f32,
  // Interval of slopes that the node represents.
  slope_interval: f32,
}

fn water_quadrature(f: WaterFacets) -> WaterQuadrature {
  var q: WaterQuadrature;
  if WATER_GGX {
    let alpha = 1.41421356 * f.tilt.sigma;
    q.low = (f.tilt.height / f.tilt.across + f.tilt.mean) / alpha;
    q.from_t = sqrt(1.0 + q.low * q.low);
    q.range = 0.5 * ATM_PI - atan2(q.low, 1.0);
  } else {
    // Slopes that are turned away from the eye are invisible.
    q.low = -(f.tilt.height / f.tilt.across + f.tilt.mean) / f.tilt.sigma;
    q.from_t = max(q.low, -2.8);
    // Nodes cover the density up to 3 deviations, or a length of about 8 / t in its far tail.
    q.range = max(3.0 - q.from_t, 8.0 / max(q.from_t, 2.9));
  }
  q.slope = f.side * f.side_mean - f.tilt.toward * f.tilt.mean;
  q.slope_per_tilt = -(f.tilt.toward * f.tilt.sigma + f.side * f.tilt_side_shear);
  q.side_variance = max(f.side_sigma * f.side_sigma - f.tilt_side_shear * f.tilt_side_shear, 0.0);
  return q;
}

// Node i of a quadrature over slopes whose tilt has the deviation `sigma`. Small even steps resolve the edge of the sky
// that the slopes reflect.
fn water_quadrature_node(q: WaterQuadrature, sigma: f32, i: i32) -> WaterQuadratureNode {
  let at = (f32(i) + 0.5) * (1.0 / f32(WATER_QUADRATURE_NODES));
  var t: f32;
  var node: WaterQuadratureNode;
  node.side_variance = q.side_variance;
  if WATER_GGX {
    // The visible area beyond the slope alpha tan(a) is (r cos(a + phi) + c) / 2. Nodes are steps of this area, finer
    // towards facets seen at grazing angles, which reflect most.
    let area = at * (1.4 - 0.4 * at);
    let a = q.range - atm_asin((area * (q.from_t + q.low) - q.low) / q.from_t);
    t = 1.41421356 * tan(clamp(a, -1.5, 1.5));
    node.weight = 1.4 - 0.8 * at;
    node.slope_interval = 1.3 * node.weight * sigma * (1.0 + 0.5 * t * t) / f32(WATER_QUADRATURE_NODES);
    // With GGX, a large slope along the direction makes a large slope across it more likely.
    node.side_variance *= 0.5 * (2.0 + t * t);
  } else {
    t = q.from_t + at * q.range;
    // Scaled, so that not all weights underflow in the far tail. Differences come first, to keep their precision there.
    let scale = max(q.low, 0.0);
    let past = q.from_t - scale + at * q.range;
    node.weight = exp(-0.5 * past * (t + scale)) * (q.from_t - q.low + at * q.range);
    node.slope_interval = q.range * sigma * (1.0 / f32(WATER_QUADRATURE_NODES));
  }
  node.slope = q.slope + t * q.slope_per_tilt;
  return node;
}
