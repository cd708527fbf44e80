// Mip pass for software adapters: one mip level in one dispatch, without a barrier.

@group(0) @binding(2) var below: texture_storage_2d_array<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(below);
  if id.x >= size.x || id.y >= size.y {
    return;
  }
  let mean = mips_mean(id.xy, id.z);
  let room = mips_room();
  let layer = sea.first_layer + id.z;
  textureStore(below, id.xy, layer, mean.displacement);
  textureStore(below, id.xy, room + layer, mean.gradients);
  textureStore(below, id.xy, 2u * room + layer, mean.moments);
}
