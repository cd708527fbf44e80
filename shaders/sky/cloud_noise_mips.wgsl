// Computes the next mip level of the 3D noise of the clouds.

@group(0) @binding(0) var finer_map: texture_3d<f32>;
@group(0) @binding(1) var noise_out: texture_storage_3d<rgba8unorm, write>;

@compute @workgroup_size(4, 4, 4)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if any(id >= textureDimensions(noise_out)) {
    return;
  }
  var sum = vec4f(0.0);
  for (var i = 0u; i < 8u; i++) {
    sum += textureLoad(finer_map, 2u * id + vec3u(i & 1u, (i >> 1u) & 1u, i >> 2u), 0);
  }
  textureStore(noise_out, id, 0.125 * sum);
}
