// Computes the next mip level of the environment map.

@group(0) @binding(0) var source_map: texture_2d<f32>;
@group(0) @binding(1) var filtered_out: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(filtered_out);
  if id.x >= size.x || id.y >= size.y {
    return;
  }
  let at = 2u * id.xy;
  let sum = textureLoad(source_map, at, 0) + textureLoad(source_map, at + vec2u(1u, 0u), 0)
    + textureLoad(source_map, at + vec2u(0u, 1u), 0) + textureLoad(source_map, at + vec2u(1u, 1u), 0);
  textureStore(filtered_out, id.xy, 0.25 * sum);
}
