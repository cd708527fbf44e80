// Size and complex product of the inverse FFT, for GPUs and for software adapters. A vec4f holds two complex numbers, xy
// and zw, so a line of N vec4f is transformed as two signals of N points at a time.

override N: u32 = 256u;

// Multiplies both complex numbers in v by the complex number w.
fn fft_complex_mul(v: vec4f, w: vec2f) -> vec4f {
  return v * w.x + vec4f(-v.y, v.x, -v.w, v.z) * w.y;
}
