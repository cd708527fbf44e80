// One level of the mip chains: displacement and gradients averaged over 2 x 2, and the second moments of the slopes,
// from which the renderer makes the roughness that a pixel cannot resolve. Moments start one level down: those of
// level 0 are the squares of the slopes themselves.

override FIRST: bool = false; // the moments come from slopes instead of moments

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var displacement_in: texture_2d_array<f32>;
@group(0) @binding(2) var gradients_in: texture_2d_array<f32>;
@group(0) @binding(3) var moments_in: texture_2d_array<f32>;
@group(0) @binding(4) var displacement_out: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(5) var gradients_out: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(6) var moments_out: texture_storage_2d_array<rgba16float, write>;

fn mips_moment(at: vec2u, cascade: u32, slopes: vec2f) -> vec4f {
  if FIRST {
    let products = vec3f(slopes.x * slopes.x, slopes.y * slopes.y, slopes.x * slopes.y);
    return vec4f(products / sea.cascades[cascade].moment_scale, 0.0);
  }
  return textureLoad(moments_in, at, sea.first_layer + cascade, 0);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(displacement_out);
  if id.x >= size.x || id.y >= size.y {
    return;
  }
  let layer = sea.first_layer + id.z;
  var d = vec4f(0.0);
  var g = vec4f(0.0);
  var m = vec4f(0.0);
  for (var i = 0u; i < 4u; i++) {
    let at = 2u * id.xy + vec2u(i & 1u, i >> 1u);
    let slopes = textureLoad(gradients_in, at, layer, 0);
    d += textureLoad(displacement_in, at, layer, 0);
    g += slopes;
    m += mips_moment(at, id.z, slopes.xy);
  }
  textureStore(displacement_out, id.xy, layer, 0.25 * d);
  textureStore(gradients_out, id.xy, layer, 0.25 * g);
  textureStore(moments_out, id.xy, layer, 0.25 * m);
}
