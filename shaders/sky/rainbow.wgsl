// The rainbow: sunlight that large raindrops reflect inside, once (the primary bow) or twice (the secondary bow).
//
// At the angle of least deviation of a colour, the light that a drop turns back is as 1 / sqrt(angle to it). The sun's
// disc and diffraction smooth this into the real part of 1 / sqrt(x - i w). Angle, width and strength for linear sRGB are
// fits to ray optics of drops over the spectrum (`src/optics/rainbow.rs`; tests/drops.rs compares both).

// Angles from the point opposite the sun, degrees, in red, green and blue; widths, degrees; and strengths, degrees^(1/2),
// where 1 is light that is equal in all directions.
const RAINBOW_PRIMARY_DEG = vec3f(42.22, 41.80, 41.05);
const RAINBOW_PRIMARY_WIDTH = vec3f(0.193, 0.222, 0.266);
const RAINBOW_PRIMARY_STRENGTH = vec3f(0.876, 0.891, 0.935);
const RAINBOW_SECONDARY_DEG = vec3f(50.78, 51.47, 52.80);
const RAINBOW_SECONDARY_WIDTH = vec3f(0.135, 0.181, 0.268);
const RAINBOW_SECONDARY_STRENGTH = vec3f(0.112, 0.119, 0.126);

// Real part of 1 / sqrt(x - i w).
fn rainbow_caustic(x: vec3f, w: vec3f) -> vec3f {
  let r = sqrt(x * x + w * w);
  return sqrt(0.5 * (r + x)) / r;
}

// Phase function of both bows, 1/sr, in linear sRGB, for light that turns by an angle with the cosine `c`.
fn rainbow_phase(c: f32) -> vec3f {
  let deg = degrees(acos(clamp(-c, -1.0, 1.0)));
  let primary = rainbow_caustic(RAINBOW_PRIMARY_DEG - deg, RAINBOW_PRIMARY_WIDTH);
  let secondary = rainbow_caustic(deg - RAINBOW_SECONDARY_DEG, RAINBOW_SECONDARY_WIDTH);
  let sum = RAINBOW_PRIMARY_STRENGTH * primary + RAINBOW_SECONDARY_STRENGTH * secondary;
  // Light that turns less than 90 degrees makes no bow.
  return sum * (smoothstep(0.0, -0.2, c) / (4.0 * ATM_PI));
}
