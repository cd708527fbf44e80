// The uniform of one frame: view, sea and maps. The struct `Frame` is declared in src/render/frame.rs.

const FRAME_EARTH_M = 6371000.0;

// Colour, and 1 and more for how near it is, by which the present pass finds edges: 1 / distance is even along a plane, and 0
// for the sky. Marks a colour that is not a number, for that pass to paint: so far below 1 that the mean of four samples still
// says so. A sample of a reference stays as it is.
fn frame_colour(c: vec3f, nearness: f32) -> vec4f {
  if frame.footprint == 0.0 {
    return vec4f(c, 0.0);
  }
  let bits = bitcast<vec3u>(c) & vec3u(0x7f800000u);
  if any(bits == vec3u(0x7f800000u)) {
    return vec4f(0.0, 0.0, 0.0, -6e4);
  }
  return vec4f(clamp(c, vec3f(0.0), vec3f(6e4)), 1.0 + min(1e4 * nearness, 1.9e4));
}
