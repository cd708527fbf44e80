// What the passes share that light the pixels of the G-buffer (water/light.wgsl, land/light.wgsl): a triangle over the
// whole picture with the viewing ray of each pixel, and the position that a pixel shows.

@group(2) @binding(0) var depth_map: texture_depth_2d;

struct LightFragment {
  @builtin(position) clip: vec4f,
  @location(0) ray: vec3f,
}

@vertex
fn light_vertex(@builtin(vertex_index) i: u32) -> LightFragment {
  let at = vec2f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
  // The depth lies behind water and land and before the sky, so that the depth test leaves the pixels that show them.
  return LightFragment(vec4f(at, 1e-30, 1.0), frame.forward + frame.right * at.x + frame.up * at.y);
}

// Position relative to the eye, m, of the water or land that a pixel shows. The ray's component along the viewing
// direction is 1, and depth is near-plane distance / distance along it.
fn lit_position(ray: vec3f, pixel: vec2i) -> vec3f {
  return ray * (frame.clip_from_relative[3].z / textureLoad(depth_map, pixel, 0));
}
