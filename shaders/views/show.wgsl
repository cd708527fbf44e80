// Copies a view to the screen, without exposure and tone curve.

@group(0) @binding(0) var view_map: texture_2d<f32>;

@fragment
fn fragment(in: ScreenVertex) -> @location(0) vec4f {
  let size = vec2f(textureDimensions(view_map));
  let colour = textureLoad(view_map, vec2u(clamp(in.uv * size, vec2f(0.0), size - 1.0)), 0);
  // NaN and infinity are magenta, as in the picture.
  return select(vec4f(1.0, 0.0, 1.0, 1.0), vec4f(colour.rgb, 1.0), colour.a > 0.99);
}
