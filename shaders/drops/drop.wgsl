// What the quads of spray and rain have in common.

// Position in clip space, outside of the picture, of all corners of a quad that is not seen.
const DROP_UNSEEN = vec4f(2.0, 2.0, 2.0, 1.0);
// Binary logarithm of the size, m, over which the shadows of clouds on drops are averaged.
const DROP_LOG_SHADOW_M = 5.0;

// Position in a quad, -1 to 1, of the corner with the number `corner`, 0 to 3, of its strip of two triangles.
fn drop_corner(corner: u32) -> vec2f {
  return vec2f(vec2u(corner & 1u, corner >> 1u)) * 2.0 - 1.0;
}

// Irradiance by the sun on drops above `place` (x, z), relative to the eye, m; none after sunset.
fn drop_sunlight(place: vec2f) -> vec3f {
  return cloud_sun_irradiance_at(place, DROP_LOG_SHADOW_M) * step(-0.02, frame.sun_direction.y);
}
