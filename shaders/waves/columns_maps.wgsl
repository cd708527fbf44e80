// The end of a transform that is written out: the maps in a buffer (maps_half.wgsl or maps_float.wgsl), which is copied to the
// textures (a software GPU takes longer to write a texel than to transform it).

override KEEP_F32: bool = false; // also leaves the result in the intermediate buffer

@group(0) @binding(1) var<storage, read_write> maps: array<MapsTexel>; // [pair][cascade][z][x]
@group(0) @binding(2) var<storage, read_write> lines: array<vec4f>; // [cascade][pair][z][x]

fn columns_store(layer: u32, layers: u32, x: u32, z: u32, packed: vec4f) {
  let pair = layer & 1u;
  // Packed order is Dx, Dz, eta, dDx/dz.
  let value = select(packed.xzyw, packed, pair == 1u);
  maps[(((pair * layers + layer) >> 1u) * N + z) * N + x] = maps_texel(value);
  if KEEP_F32 {
    lines[(layer * N + z) * N + x] = value;
  }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
  columns_second(id.z, groups.z, id.x, id.y);
}
