// Runs on software adapters: the waves at a time, and the first half of their transform along x. Thread (t, z) computes
// both pairs of the line z and of the line N - z, which has the opposite wave vectors. src/shaders/unrolled.rs
// generates rows_first.

@group(0) @binding(4) var<storage, read_write> halves: array<vec4f>; // [cascade][pair][iz][k1][t]

// A wave of the line z; on the opposite line, the conjugate of its opposite wave, because h(-k) = conj(h(k)).
fn rows_choose(wave: vec3f, opposite: vec3f, is_opposite: bool) -> vec3f {
  return select(wave, vec3f(opposite.x, -opposite.y, opposite.z), is_opposite);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if id.y <= N / 2u {
    rows_first(id.z, id.x, id.y);
  }
}
