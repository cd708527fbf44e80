// The second half of the transform along x and the first half along z at once: a thread has the points of one k1 in several
// lines. Its halves lie in tiles of eight columns, which the last step reads from end to end.

@group(0) @binding(0) var<storage, read> twiddle: array<vec2f>; // e^(2 pi i j / 1024)
@group(0) @binding(1) var<storage, read> lines: array<vec2<u64>>; // [cascade][pair][iz][k1][n2]
@group(0) @binding(2) var<storage, read_write> halves: array<vec2<u64>>; // [cascade][pair][k1][x / 8][t][x % 8]

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  middle(id.z, id.x, id.y);
}
