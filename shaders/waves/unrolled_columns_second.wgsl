// Column pass for software adapters, second dispatch: the second half of the inverse FFT along z, and the maps. Thread
// (x, k1) computes one pair of a cascade. The maps go to a buffer that is copied to the textures, because a software
// adapter takes longer to store a texel than to compute it. src/shaders/unrolled.rs generates the function
// columns_second; map_texel_half.wgsl or map_texel_float.wgsl defines MapTexel.

override KEEPS_F32_MAPS: bool = false; // whether the maps are also kept in `row_transforms`, in f32

@group(0) @binding(0) var<storage, read> half_transforms: array<vec4f>; // [cascade][pair][k1][n2][x]
@group(0) @binding(1) var<storage, read_write> maps: array<MapTexel>; // [pair][cascade][z][x]
@group(0) @binding(2) var<storage, read_write> row_transforms: array<vec4f>; // [cascade][pair][z][x]

// Stores a texel of a map: of displacement in even layers, of gradients in odd ones.
fn columns_store(layer: u32, layers: u32, x: u32, z: u32, packed: vec4f) {
  let pair = layer & 1u;
  // The components of pair 0 are Dx, Dz, eta, dDx/dz; the map has Dx, eta, Dz, dDx/dz.
  let value = select(packed.xzyw, packed, pair == 1u);
  maps[(((pair * layers + layer) >> 1u) * N + z) * N + x] = map_texel(value);
  if KEEPS_F32_MAPS {
    row_transforms[(layer * N + z) * N + x] = value;
  }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
  columns_second(id.z, groups.z, id.x, id.y);
}
