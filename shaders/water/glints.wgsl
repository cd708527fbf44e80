// Separate glints of the sun, whose number in a pixel is random.

// Whether the sun's glitter consists of separate glints.
override WATER_GLINTS: bool = false;
// Number of glints per m2 where the density of slopes is 1: the mean of the surface's absolute Gaussian curvature
// (Longuet-Higgins 1960), here of waves of some centimetres.
const WATER_GLINTS_PER_DENSITY = 150.0;
// Expected number of glints from which their light is drawn as a whole.
const WATER_MANY_GLINTS = 4.0;

// The pixel whose glints are counted. Without separate glints it is not used.
struct WaterGlints {
  // Area of the pixel on the undisplaced sea, m2.
  area_m2: f32,
  // Column and row of the pixel in the picture.
  pixel: vec2u,
}

// Number with a gamma distribution of the given shape and a mean of 1, from a uniform one (Wilson and Hilferty 1931).
fn water_gamma_deviate(shape: f32, random: f32) -> f32 {
  let variance = 1.0 / (9.0 * shape);
  let root = max(1.0 - variance + maths_normal_quantile(random) * sqrt(variance), 0.0);
  return root * root * root;
}

// Light of the glints that lie in a cell as large as a pixel, divided by the expected light; its mean is 1 and its
// variance 2 / expected number. The number of glints has Poisson's distribution, because they lie at random, and the
// brightness of each is exponential. Of many glints, the sum is nearly a gamma distribution.
fn water_glint_cell(cell: vec2u, expected: f32) -> f32 {
  let words = noise_pcg4d(vec4u(cell, material.glint_moment, 0u));
  let random = (vec2f(words.xy >> vec2u(9u)) + 0.5) * 1.1920928955078125e-7; // 2^-23
  if expected > WATER_MANY_GLINTS {
    return water_gamma_deviate(0.5 * expected, random.x);
  }
  var share = exp(-expected);
  var sum = share;
  var count = 0.0;
  for (var i = 0; i < 14 && random.x > sum; i++) {
    count += 1.0;
    share *= expected / count;
    sum += share;
  }
  if count == 0.0 {
    return 0.0;
  }
  return water_gamma_deviate(count, random.y) * count / expected;
}

// Light of the glints in a pixel, divided by the expected light; its mean is 1. `density` is that of the slopes that
// mirror the sun. A glint is a dash of four pixels that is brightest in its middle: the crests of ripples are long, and
// seen from low above they are longest across the view.
fn water_glint_gain(glints: WaterGlints, density: f32) -> f32 {
  let expected = max(WATER_GLINTS_PER_DENSITY * glints.area_m2 * density, 1e-4);
  var sum = 0.0;
  for (var i = 0u; i < 4u; i++) {
    let weight = select(1.0, 2.0, i == 1u || i == 2u);
    sum += weight * water_glint_cell(glints.pixel + vec2u(i, 0u), expected);
  }
  return (1.0 / 6.0) * sum;
}
