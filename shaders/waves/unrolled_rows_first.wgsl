// Row pass for software adapters, first dispatch: the waves at a time, and the first half of their inverse FFT along x.
// Thread (t, z) computes both pairs of line z and of line N - z, which has the opposite wave vectors.
// src/shaders/unrolled.rs generates the function rows_first.

@group(0) @binding(4) var<storage, read_write> half_transforms: array<vec4f>; // [cascade][pair][iz][k1][t]

// A wave of line z, or, for the opposite line, the complex conjugate of the opposite wave, because h(-k) = conj(h(k)).
fn rows_wave_or_opposite(wave: vec3f, opposite: vec3f, is_opposite: bool) -> vec3f {
  return select(wave, vec3f(opposite.x, -opposite.y, opposite.z), is_opposite);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if id.y <= N / 2u {
    rows_first(id.z, id.x, id.y);
  }
}
