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

// Probability density of slopes around their mean.
struct WaterSlopeDensity {
  // Inverse (xx, zz, xz) of the covariance.
  inverse: vec3f,
  // Density at the mean.
  peak: f32,
}

// Density of slopes with the covariance `variance` (xx, zz, xz). The finite disc of the sun widens the range of slopes
// that reflect it.
fn water_slope_density(variance: vec3f) -> WaterSlopeDensity {
  let wide = variance + vec3f(vec2f(frame.sun_slope_variance), 0.0);
  let product = wide.x * wide.y;
  let over = inverseSqrt(max(product - wide.z * wide.z, 0.02 * product));
  return WaterSlopeDensity((over * over) * vec3f(wide.yx, -wide.z), over * (0.5 / ATM_PI));
}

// Square of the distance `off` from the mean slope, in standard deviations.
fn water_slope_distance(density: WaterSlopeDensity, off: vec2f) -> f32 {
  return max(dot(density.inverse.xy, off * off) + 2.0 * density.inverse.z * off.x * off.y, 0.0);
}

// Density at a slope whose distance from the mean has the square `square`, in standard deviations.
fn water_slope_density_at(density: WaterSlopeDensity, square: f32) -> f32 {
  if WATER_GGX {
    let w = 1.0 + 0.5 * square;
    return density.peak / (w * w);
  }
  return density.peak * exp(-0.5 * min(square, 160.0));
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
  let is_vertical = dot(dir.xz, dir.xz) <= 1e-8;
  let level = select(dir.xz, vec2f(1e-4, 0.0), is_vertical);
  let level_square = dot(level, level);
  let over_across = inverseSqrt(level_square);
  var t: WaterTilt;
  t.across = level_square * over_across;
  t.height = dir.y;
  t.toward = level * over_across;
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

// Tilts of the facets that the eye sees, in deviations of all tilts: mean (x) and deviation (y); and the projected area
// of the visible facets, divided by that deviation and the horizontal part of the direction (z). `low` is the tilt,
// counted from the mean, below which facets are turned away from the eye. Gaussian slopes, weighted by projected area.
fn water_visible_tilts(low: f32) -> vec3f {
  // Farther in the tail, the moments would lose their precision.
  let near = min(low, 3.0);
  let a = -near;
  let density = 0.39894228 * exp(-0.5 * min(a * a, 80.0));
  // Upper tail of the normal distribution at |a|, divided by its density (Abramowitz and Stegun 26.2.17).
  let t = 1.0 / (1.0 + 0.2316419 * abs(a));
  let tail = t * (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  let share = select(density * tail, 1.0 - density * tail, a > 0.0);
  let area = max(a * share + density, 1e-7);
  let mean = share / area;
  let square = 1.0 + density / area - mean * mean;
  return vec3f(mean + (low - near), sqrt(max(square, 0.01)), area);
}

// Numbers of nodes of the quadrature over slopes. GGX has more, because its tails are long.
const WATER_GAUSSIAN_NODES = 6;
const WATER_GGX_NODES = 8;
// Width of the first node's interval, relative to the mean width: nodes lie closer where facets are seen at grazing
// angles, which reflect most.
const WATER_FIRST_NODE_WIDTH = 0.7;

// Quadrature over the slopes that are visible from a direction, weighted by projected area.
struct WaterQuadrature {
  // Tilts are counted in deviations from the mean tilt. `low` is the tilt below which facets are turned away from the
  // eye; the nodes begin at `from_t` and cover `range`. GGX uses the three otherwise: `low` is the cosine of the mean
  // facet towards the eye (unscaled, divided by alpha and the eye's horizontal part), `from_t` is sqrt(1 + low^2), and
  // `range` is atan(1 / low), from 0 to pi.
  low: f32,
  from_t: f32,
  range: f32,
  // `from_t` less and plus the tilt whose density is the unit of the weights, so that they do not underflow in the far
  // tail. Differences come first, to keep their precision there.
  past_scale: vec2f,
  // `from_t` less `low`.
  past_low: f32,
  // Number of nodes, and the fraction of the range that each represents on average.
  nodes: i32,
  part: f32,
  // Slope at tilt 0, and its change with the tilt.
  slope: vec2f,
  slope_per_tilt: vec2f,
  // Square of the slope, as a polynomial of the tilt.
  square: vec3f,
  // Variance of the slope across the direction, given the slope along it.
  side_variance: f32,
  // Layer of the mirrored sky for all nodes; with GGX, each node has its own.
  sky_layer: f32,
}

struct WaterQuadratureNode {
  // Tilt of the facets, counted in deviations from the mean tilt.
  tilt: f32,
  // Tilt less the one below which facets are turned away from the eye.
  past_low: f32,
  side_variance: f32,
  weight: f32,
  // Width of the node's interval, relative to the mean width.
  width: f32,
}

// Layer of the mirrored sky for an interval of slopes: an even distribution over the interval has a deviation of
// interval / sqrt(12), and a slope turns the mirrored ray by twice its angle. That makes 0.58; less blur is nearer to
// reference pictures.
fn water_sky_layer(interval: f32) -> f32 {
  return mirrored_sky_layer(0.4 * interval);
}

fn water_quadrature(f: WaterFacets) -> WaterQuadrature {
  var q: WaterQuadrature;
  if WATER_GGX {
    let alpha = 1.41421356 * f.tilt.sigma;
    q.low = (f.tilt.height / f.tilt.across + f.tilt.mean) / alpha;
    q.from_t = sqrt(1.0 + q.low * q.low);
    q.range = 0.5 * ATM_PI - atan(q.low);
  } else {
    // Slopes that are turned away from the eye are invisible.
    q.low = -(f.tilt.height + f.tilt.across * f.tilt.mean) / (f.tilt.across * f.tilt.sigma);
    q.from_t = max(q.low, -2.8);
    // Nodes cover the density up to 2.6 deviations, or a length of about 6.5 / t in its far tail.
    q.range = max(2.6 - q.from_t, 6.5 / max(q.from_t, 2.5));
    q.past_scale = q.from_t + vec2f(-1.0, 1.0) * max(q.low, 0.0);
    q.past_low = q.from_t - q.low;
  }
  q.slope = f.side * f.side_mean - f.tilt.toward * f.tilt.mean;
  q.slope_per_tilt = -(f.tilt.toward * f.tilt.sigma + f.side * f.tilt_side_shear);
  q.square = vec3f(
    dot(q.slope, q.slope), 2.0 * dot(q.slope, q.slope_per_tilt), dot(q.slope_per_tilt, q.slope_per_tilt));
  q.nodes = select(WATER_GAUSSIAN_NODES, WATER_GGX_NODES, WATER_GGX);
  q.part = select(1.0 / f32(WATER_GAUSSIAN_NODES), 1.0 / f32(WATER_GGX_NODES), WATER_GGX);
  q.sky_layer = water_sky_layer(q.range * f.tilt.sigma * q.part);
  q.side_variance = max(f.side_sigma * f.side_sigma - f.tilt_side_shear * f.tilt_side_shear, 0.0);
  return q;
}

// The node that lies at the fraction `at` of a quadrature.
fn water_quadrature_node(q: WaterQuadrature, at: f32) -> WaterQuadratureNode {
  var node: WaterQuadratureNode;
  if WATER_GGX {
    // The visible area beyond the slope alpha tan(a) is (r cos(a + phi) + c) / 2. Nodes are steps of this area, finer
    // towards facets seen at grazing angles, which reflect most.
    let area = at * (1.4 - 0.4 * at);
    let a = q.range - atm_asin((area * (q.from_t + q.low) - q.low) / q.from_t);
    node.tilt = 1.41421356 * tan(clamp(a, -1.5, 1.5));
    node.past_low = node.tilt + 1.41421356 * q.low;
    node.width = 1.4 - 0.8 * at;
    node.weight = node.width;
    // With GGX, a large slope along the direction makes a large slope across it more likely.
    node.side_variance = q.side_variance * (1.0 + 0.5 * node.tilt * node.tilt);
    return node;
  }
  node.width = WATER_FIRST_NODE_WIDTH + (2.0 - 2.0 * WATER_FIRST_NODE_WIDTH) * at;
  let off = at * (0.5 * WATER_FIRST_NODE_WIDTH + 0.5 * node.width) * q.range;
  node.tilt = q.from_t + off;
  node.past_low = q.past_low + off;
  node.weight = node.width * node.past_low * exp(-0.5 * (q.past_scale.x + off) * (q.past_scale.y + off));
  node.side_variance = q.side_variance;
  return node;
}

// Fresnel reflectance of a facet with the slope `slope`, towards the direction `dir`.
fn water_facet_fresnel(dir: vec3f, slope: vec2f) -> f32 {
  return water_fresnel(dot(dir, water_normal(material.fresnel_slope_factor * slope)));
}
