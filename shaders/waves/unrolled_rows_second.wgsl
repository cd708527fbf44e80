// Row pass for software adapters, second dispatch: the second half of the inverse FFT along x. Thread (k1, z) computes
// one pair of a cascade. src/shaders/unrolled.rs generates the function rows_second.

@group(0) @binding(0) var<storage, read> half_transforms: array<vec4f>; // [cascade][pair][iz][k1][n2]
@group(0) @binding(1) var<storage, read_write> row_transforms: array<vec4f>; // [cascade][pair][iz][x]

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  rows_second((id.z * N + id.y) * N, id.x);
}
