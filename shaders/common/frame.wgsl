// What every picture pass knows of the view, the sea and its maps. Rust twin: render/frame.rs.

struct Frame {
  // From positions relative to the eye, reverse-Z.
  clip_from_relative: mat4x4f,
  // Right, up and forward; the first two scaled by the tangent of half the field of view.
  right: vec3f,
  eye_m: f32,
  up: vec3f,
  // Dip of the true horizon below the horizontal, rad.
  dip: f32,
  forward: vec3f,
  // Angle of a pixel in the middle of the picture, rad.
  pixel: f32,
  sun: vec3f,
  chop_x: f32,
  // Texture coordinates of the eye's foot, 1 / patch, unit of the moments. Of the cascades of one sea, or of two while one fades
  // into the other; and after them of the ripples that no cascade holds: a copy of the finest cascade of each sea, shrunk.
  cascades: array<vec4f, 10>,
  // Texels to the shortest wave of each, layer of its maps, what its variance is short of while it fades, scale of its slopes.
  layers: array<vec4f, 10>,
  // Lattices of their copies, at the eye's foot: TilePlace's turn and rest; cell, key, on.
  tile_lattice: array<vec4f, 10>,
  tile_cell: array<vec4i, 10>,
  // Covariance of the slopes that neither the maps nor the ripples hold: xx, zz, xz.
  residual: vec4f,
  // Foam levels: centre relative to the eye, half the valid side, 1 / texel; and texture coordinates of the eye's foot.
  foam_place: array<vec4f, 4>,
  foam_uv: array<vec4f, 4>,
  // Lattice of the mesh: first azimuth and step, first row and step.
  mesh: vec4f,
  // Scale of its radii, m; rows; columns.
  mesh_radius: f32,
  mesh_rows: u32,
  count: u32,
  foam_count: u32,
  // Of those of `cascades` that are ripples; `count` is without them.
  ripple_count: u32,
  unused_0: u32,
  unused_1: u32,
  unused_2: u32,
  // Where the water below the eye would lie in a still sea (x, z), how far waves may carry water, m, and whether (1) the
  // eye rides on it.
  foot: vec4f,
  downwind: vec2f,
  n: f32,
  wind_m_s: f32,
  hs_m: f32,
  depth_m: f32,
  mean_foam: f32,
  foam_gain: f32,
  // Variance of the slopes by which the sun's disc spreads its mirror image: such that it is as bright as the disc itself.
  sun_blur: f32,
  // Radiance of the disc over the sun's irradiance, 1/sr.
  sun_peak: f32,
  chop_z: f32,
  // Share of a pixel that is filtered over: 1, or 0 for the samples of a reference.
  footprint: f32,
}

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
