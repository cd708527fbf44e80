// The inverse FFT of lines of N = RADIX_1 x RADIX_2 points, two complex signals at a time (xy and zw of a vec4f). First
// half: transforms over n1 of the points n1 RADIX_2 + n2, times the twiddle factor e^(2 pi i n2 k1 / N). Second half:
// transforms over n2, which give the result X[k1 + RADIX_1 k2]. 64 = 8 x 8, 128 = 16 x 8, 256 = 16 x 16, 512 = 32 x 16,
// 1024 = 32 x 32.

override N: u32 = 256u;

// Multiplies both complex numbers in v by the complex number w.
fn fft_complex_mul(v: vec4f, w: vec2f) -> vec4f {
  return v * w.x + vec4f(-v.y, v.x, -v.w, v.z) * w.y;
}
