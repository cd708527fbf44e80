// The map of a coast: factors of the layers of the wave maps, and the height that the waves run up the land.

// Position (x, z) relative to a corner of the square around the coast, m. `at` is relative to the point below the eye.
fn coast_place(at: vec2f) -> vec2f {
  return frame.coast_uv_below_eye / frame.coast_inverse_side + at;
}

// The map covers the square of the world that encloses the coast. The sampler takes the nearest mip level.
@group(1) @binding(5) var nearest_mip_sampler: sampler;
@group(1) @binding(6) var coast_gains_map: texture_2d<f32>;

// Factors of ordinary cascades, of offshore waves, and of waves at the coast (x, y, z), and the height above the still
// water that the waves run up the land, m (w), at an undisplaced position relative to the point below the eye, m. Outside
// the square, the values of its edge hold.
fn coast_at(at: vec2f) -> vec4f {
  let half_texel = 0.5 / vec2f(textureDimensions(coast_gains_map));
  let uv = clamp(frame.coast_uv_below_eye + at * frame.coast_inverse_side, half_texel, 1.0 - half_texel);
  return textureSampleLevel(coast_gains_map, nearest_mip_sampler, uv, 0.0);
}
