// Column pass for software adapters, first dispatch: the first half of the inverse FFT along z. Thread (x, t) computes
// one pair of a cascade. A workgroup reads and writes 64 neighbouring columns, so that the CPU's cache prefetches them.
// src/shaders/unrolled.rs generates the function columns_first.

@group(0) @binding(0) var<storage, read> twiddle_factors: array<vec2f>; // twiddle factors e^(2 pi i j / 1024)
@group(0) @binding(1) var<storage, read> row_transforms: array<vec4f>; // [cascade][pair][z][x]
@group(0) @binding(2) var<storage, read_write> half_transforms: array<vec4f>; // [cascade][pair][k1][t][x]

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  columns_first(id.z * N * N + id.x, id.y);
}
