// Gaussian random numbers from a hash, as in src/waves/noise.rs. The hash is equal bit for bit.

// The hash pcg4d of four words to four words (Jarzynski and Olano 2020).
fn noise_pcg4d(seed: vec4u) -> vec4u {
  var v = seed * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v = v ^ (v >> vec4u(16u));
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

// Three random numbers, 0 to 1, from three words (the hash pcg3d; Jarzynski and Olano 2020).
fn noise_pcg3d_unit(seed: vec3u) -> vec3f {
  var v = seed * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v = v ^ (v >> vec3u(16u));
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return vec3f(v >> vec3u(8u)) / 16777216.0;
}

fn noise_random_words(seed: u32, key: u32, ix: i32, iz: i32) -> vec2u {
  return noise_pcg4d(vec4u(bitcast<u32>(ix), bitcast<u32>(iz), key, seed)).xy;
}

// The hash pcg4d as four uniform numbers from 0 to below 1.
fn noise_pcg4d_unit(seed: vec4u) -> vec4f {
  return vec4f(noise_pcg4d(seed) >> vec4u(8u)) / 16777216.0;
}

// Two independent normal random numbers (mean 0, variance 1) by the Box-Muller transform, from two random words. The
// first word becomes a uniform number in the open interval (0, 1), so that the result is finite.
fn noise_normal_pair(words: vec2u) -> vec2f {
  let u = (f32(words.x >> 9u) + 0.5) * 1.1920928955078125e-7; // 2^-23
  return sqrt(-2.0 * maths_natural_log(u)) * maths_cos_sin(words.y);
}
