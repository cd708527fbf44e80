// Distributions of slopes: Gaussian, as Cox and Munk 1954 found it on the sea (Beckmann's), or Trowbridge and Reitz's (GGX)
// with alpha^2 = 2 sigma^2; both with a mean and any covariance. Or Blinn and Phong's lobe. Parts of the pipeline: a software
// GPU computes both sides of a branch.

override WATER_GGX: bool = false;
override WATER_PHONG: bool = false;

// Area seen from a direction over horizontal area: cosine with Smith's masking, for slopes towards that direction with
// this mean and deviation.
fn water_seen(height: f32, across: f32, mean: f32, sigma: f32) -> f32 {
  let facing = height + across * mean;
  let scale = max(across * sigma, 1e-6);
  if WATER_GGX {
    return 0.5 * (facing + sqrt(facing * facing + 2.0 * scale * scale));
  }
  let a = facing / scale;
  let density = 0.39894228 * exp(-0.5 * min(a * a, 80.0));
  // Integral of the density beyond |a|, Abramowitz and Stegun 26.2.17.
  let t = 1.0 / (1.0 + 0.2316419 * abs(a));
  let tail = t * (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  return scale * max(density * (1.0 - abs(a) * tail) + max(a, 0.0), 1e-7);
}

// Density of slopes, `off` from their mean, with this variance (xx, zz, xz).
fn water_slope_density(off: vec2f, variance: vec3f) -> f32 {
  // The sun's disc spreads the slopes that mirror it.
  let xx = variance.x + frame.sun_blur;
  let zz = variance.y + frame.sun_blur;
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

// The slopes as seen along one direction: towards it, beside it, and both together.
struct WaterFacets {
  toward: vec2f,
  side: vec2f,
  height: f32,
  across: f32,
  // Of the slope towards the direction: mean, deviation, and covariance with the side's over it.
  tilt: f32,
  sigma: f32,
  shear: f32,
  side_mean: f32,
  side_sigma: f32,
}

fn water_facets(dir: vec3f, slope: WaterSlope) -> WaterFacets {
  // Straight above any direction will do.
  let level = select(vec2f(1e-4, 0.0), dir.xz, dot(dir.xz, dir.xz) > 1e-8);
  var f: WaterFacets;
  f.across = length(level);
  f.height = dir.y;
  f.toward = level / f.across;
  f.side = vec2f(-f.toward.y, f.toward.x);
  let cov = mat2x2f(slope.variance.x, slope.variance.z, slope.variance.z, slope.variance.y);
  f.sigma = sqrt(max(dot(f.toward, cov * f.toward), 1e-6));
  f.side_sigma = sqrt(max(dot(f.side, cov * f.side), 1e-6));
  f.shear = dot(f.toward, cov * f.side) / f.sigma;
  // Tilt towards the eye is minus the slope in its direction.
  f.tilt = -dot(slope.mean, f.toward);
  f.side_mean = dot(slope.mean, f.side);
  return f;
}

// Area seen, and the cosine to the mean facet.
fn water_facets_seen(f: WaterFacets) -> vec2f {
  return vec2f(water_seen(f.height, f.across, f.tilt, f.sigma), f.height + f.across * f.tilt);
}

const WATER_NODES = 8;

struct WaterNode {
  slope: vec2f,
  // Variance of the slope beside the direction, for this slope along it.
  side: f32,
  weight: f32,
  // Slopes that the node stands for.
  width: f32,
}

// A quadrature over the slopes that are seen, each by its projected area: even steps, because the sky that they mirror has
// an edge.
fn water_node(f: WaterFacets, i: i32) -> WaterNode {
  let at = (f32(i) + 0.5) / f32(WATER_NODES);
  var t: f32;
  var node: WaterNode;
  var spread = 1.0;
  if WATER_GGX {
    // The visible area beyond a slope alpha tan(a) is (R cos(a + phi) + c) / 2: steps of it, finer towards facets seen from
    // their side, which mirror most.
    let area = at * (1.4 - 0.4 * at);
    let alpha = 1.41421356 * f.sigma;
    let c = f.height / f.across + f.tilt;
    let r = sqrt(alpha * alpha + c * c);
    let a = 0.5 * ATM_PI - atm_asin((area * (r + c) - c) / r) - atan2(c, alpha);
    t = 1.41421356 * tan(clamp(a, -1.5, 1.5));
    node.weight = 1.4 - 0.8 * at;
    node.width = 1.3 * node.weight * f.sigma * (1.0 + 0.5 * t * t) / f32(WATER_NODES);
    // A wide slope along is likely a wide one beside, too.
    spread = 0.5 * (2.0 + t * t);
  } else {
    // Slopes turned away from the eye are not seen.
    let low = -(f.height / f.across + f.tilt) / f.sigma;
    let from_t = max(low, -2.8);
    // As far as the density reaches: over 1 / t in the far tail.
    let range = max(3.0 - from_t, 8.0 / max(from_t, 2.9));
    t = from_t + at * range;
    // Scaled so that not all underflow when only the far tail is seen; differences first, that none is lost there.
    let scale = max(low, 0.0);
    let past = from_t - scale + at * range;
    node.weight = exp(-0.5 * past * (t + scale)) * (from_t - low + at * range);
    node.width = range * f.sigma / f32(WATER_NODES);
  }
  node.slope = f.toward * -(f.tilt + f.sigma * t) + f.side * (f.side_mean - f.shear * t);
  node.side = spread * max(f.side_sigma * f.side_sigma - f.shear * f.shear, 0.0);
  return node;
}
