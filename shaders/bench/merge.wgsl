// Baseline of `seastate bench`: merges the transformed fields of a cascade into displacement and gradient maps.

@group(0) @binding(0) var field_0: texture_2d<f32>;
@group(0) @binding(1) var field_1: texture_2d<f32>;
@group(0) @binding(2) var field_2: texture_2d<f32>;
@group(0) @binding(3) var field_3: texture_2d<f32>;
@group(0) @binding(4) var displacement: texture_storage_2d<rgba16float, write>;
@group(0) @binding(5) var gradients: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let a = textureLoad(field_0, id.xy, 0).xy;
  let b = textureLoad(field_1, id.xy, 0).xy;
  let c = textureLoad(field_2, id.xy, 0).xy;
  let d = textureLoad(field_3, id.xy, 0).xy;
  textureStore(displacement, id.xy, vec4f(a.x, b.x, a.y, b.y));
  textureStore(gradients, id.xy, vec4f(c, d));
}
