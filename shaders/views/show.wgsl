// Copies a view to the screen, without exposure and tone curve.

@group(0) @binding(0) var view_map: texture_2d<f32>;

struct ViewCopyFragment {
  @builtin(position) clip: vec4f,
  @location(0) uv: vec2f,
}

@vertex
fn vertex(@builtin(vertex_index) i: u32) -> ViewCopyFragment {
  let at = vec2f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
  return ViewCopyFragment(vec4f(at, 0.0, 1.0), vec2f(0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y));
}

@fragment
fn fragment(in: ViewCopyFragment) -> @location(0) vec4f {
  let size = vec2f(textureDimensions(view_map));
  let colour = textureLoad(view_map, vec2u(clamp(in.uv * size, vec2f(0.0), size - 1.0)), 0);
  // NaN and infinity are magenta, as in the picture.
  return select(vec4f(1.0, 0.0, 1.0, 1.0), vec4f(colour.rgb, 1.0), colour.a > 0.99);
}
