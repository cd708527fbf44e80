// Mip pass for software adapters: one mip level in one dispatch, without a barrier.

@group(0) @binding(2) var target_level: texture_storage_2d_array<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(target_level);
  if id.x >= size.x || id.y >= size.y {
    return;
  }
  let mean = mips_mean_of_four(id.xy, id.z);
  let layers_per_kind = mips_layers_per_kind();
  let layer = sea.first_layer + id.z;
  textureStore(target_level, id.xy, layer, mean.displacement);
  textureStore(target_level, id.xy, layers_per_kind + layer, mean.gradients);
  textureStore(target_level, id.xy, 2u * layers_per_kind + layer, mean.moments);
}
