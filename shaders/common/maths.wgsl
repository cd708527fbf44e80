// Elementary functions with known accuracy, a few units in the last place of f32. WGSL itself promises only 2^-11 for
// sin and cos and little for atan2 and log, and drivers use that freedom.

const MATHS_LN2 = 0.69314718056;

// (cos, sin) of an angle in units of 2^-32 turns, so that the reduction to one quadrant is exact integer arithmetic.
fn maths_cos_sin(turns: u32) -> vec2f {
  let quadrant = (turns + 0x20000000u) >> 30u;
  let rest = bitcast<i32>(turns - (quadrant << 30u));
  let x = f32(rest) * 1.46291807926715968e-9; // 2 pi / 2^32
  let xx = x * x;
  let s = x + x * xx * (-1.6666654611e-1 + xx * (8.3321608736e-3 - xx * 1.9515295891e-4));
  let c = 1.0 - 0.5 * xx + xx * xx * (4.166664568298827e-2 + xx * (-1.388731625493765e-3 + xx * 2.443315711809948e-5));
  // A quadrant may swap sine and cosine and change signs. No branch, because a software GPU runs all sides of it.
  let swaps = (quadrant & 1u) != 0u;
  let cosine = bitcast<u32>(select(c, s, swaps)) ^ (((quadrant + 1u) & 2u) << 30u);
  let sine = bitcast<u32>(select(s, c, swaps)) ^ ((quadrant & 2u) << 30u);
  return vec2f(bitcast<f32>(cosine), bitcast<f32>(sine));
}

// Natural logarithm of a positive normal number.
fn maths_natural_log(x: f32) -> f32 {
  let bits = bitcast<u32>(x);
  // The mantissa is in [sqrt(1/2), sqrt(2)), so that the logarithm of numbers near 1 has no cancellation.
  let shifted = bits - 0x3f3504f3u;
  let exponent = bitcast<i32>(shifted) >> 23u;
  let m = bitcast<f32>((shifted & 0x007fffffu) + 0x3f3504f3u);
  let s = (m - 1.0) / (m + 1.0);
  let ss = s * s;
  let series = 2.0 * s * (1.0 + ss * (0.333333333 + ss * (0.2 + ss * (0.142857143 + ss * 0.111111111))));
  return f32(exponent) * MATHS_LN2 + series;
}

// e^x; 0 for a result below the smallest normal number. Arguments above 88 count as 88.
fn maths_exp(x: f32) -> f32 {
  if x < -87.0 {
    return 0.0;
  }
  let n = floor(min(x, 88.0) * 1.44269504089 + 0.5);
  let r = (min(x, 88.0) - n * 0.693359375) + n * 2.12194440e-4;
  let tail = 4.1665795894e-2 + r * (8.3334519073e-3 + r * (1.3981999507e-3 + r * 1.9875691500e-4));
  let series = 1.0 + r * (1.0 + r * (0.5 + r * (1.6666665459e-1 + r * tail)));
  return series * bitcast<f32>(u32(i32(n) + 127) << 23u);
}

// Arc tangent of y / x for y >= 0, in [0, pi].
fn maths_atan2_upper(y: f32, x: f32) -> f32 {
  let a = abs(x);
  let ratio = min(y, a) / max(max(y, a), 1e-30);
  let fold = ratio > 0.41421356;
  let z = select(ratio, (ratio - 1.0) / (ratio + 1.0), fold);
  let zz = z * z;
  let tail = 1.99777106478e-1 + zz * (-1.38776856032e-1 + zz * 8.05374449538e-2);
  var angle = z + z * zz * (-3.33329491539e-1 + zz * tail);
  angle += select(0.0, 0.78539816340, fold);
  angle = select(angle, 1.57079632679 - angle, y > a);
  return select(angle, 3.14159265359 - angle, x < 0.0);
}

// Phase, rad, of a complex number, and 0 for one that a GPU may take for 0: on some, atan2(0, 0) is NaN.
fn maths_phase(z: vec2f) -> f32 {
  return atan2(z.y, select(z.x, 1.0, max(abs(z.x), abs(z.y)) < 1e-30));
}

// 0 for x <= 0, 1 for x >= 1, with a smooth step between: smoothstep without its division.
fn maths_smooth(x: f32) -> f32 {
  let t = saturate(x);
  return t * t * (3.0 - 2.0 * t);
}

// 0 for x <= range.x, 1 for x >= range.y, with a smooth step between.
fn maths_rise(x: f32, range: vec2f) -> f32 {
  return maths_smooth((x - range.x) / (range.y - range.x));
}

fn maths_complex_mul(a: vec2f, b: vec2f) -> vec2f {
  return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// Cumulative normal distribution (Bowling and others 2009, accurate to 2e-4).
fn maths_normal_cdf(x: f32) -> f32 {
  return 1.0 / (1.0 + exp(clamp(-x * (1.5976 + 0.07056 * x * x), -40.0, 40.0)));
}

// Inverse of the cumulative normal distribution (Abramowitz and Stegun 26.2.22, accurate to 3e-3).
fn maths_normal_quantile(share: f32) -> f32 {
  let t = sqrt(-2.0 * log(min(share, 1.0 - share)));
  return sign(share - 0.5) * (t - (2.30753 + 0.27061 * t) / (1.0 + t * (0.99229 + 0.04481 * t)));
}

// Products (xx, yy, xy) of a vector with itself.
fn maths_self_products(v: vec2f) -> vec3f {
  return vec3f(v * v, v.x * v.y);
}
