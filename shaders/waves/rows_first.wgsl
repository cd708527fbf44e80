// The first half of the transform by itself, a thread for every t of a line and of the line of the opposite waves: no exchange,
// hence no barrier, which costs a software GPU more than another way through memory. The transforms are written out by
// gpu/fft.rs.

@group(0) @binding(4) var<storage, read_write> halves: array<vec4f>; // [cascade][pair][iz][k1][t]

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if id.y <= N / 2u {
    rows_first(id.z, id.x, id.y);
  }
}
