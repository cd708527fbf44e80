// What the inverse FFTs for GPUs and for software adapters share: lines of N points, two complex signals at a time (xy
// and zw of a vec4f).

override N: u32 = 256u;

// Multiplies both complex numbers in v by the complex number w.
fn fft_complex_mul(v: vec4f, w: vec2f) -> vec4f {
  return v * w.x + vec4f(-v.y, v.x, -v.w, v.z) * w.y;
}
