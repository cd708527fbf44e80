// Vertex shader of the passes that fill their target: a triangle that covers it, without a vertex buffer.

struct ScreenVertex {
  @builtin(position) clip: vec4f,
  // Position in the target, from the top left corner to the bottom right one.
  @location(0) uv: vec2f,
}

@vertex
fn vertex(@builtin(vertex_index) i: u32) -> ScreenVertex {
  let at = vec2f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
  return ScreenVertex(vec4f(at, 0.0, 1.0), vec2f(0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y));
}
