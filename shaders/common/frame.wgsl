// Output of a pass that draws the picture. The uniform `Frame` (view, sea and maps) is declared in src/render/frame.rs.

const FRAME_EARTH_RADIUS_M = 6371000.0;

// HDR colour, with 1 + 1e4 * nearness in alpha, from which the tone pass finds edges. Nearness is 1 / distance, 1/m,
// which is linear along a plane, and 0 for the sky; see also frame_edged_nearness. A colour that is not finite gets alpha -6e4, so low that even the
// mean of four samples tells the tone pass to mark the pixel. Samples of a reference picture (footprint 0) keep
// their colour.
fn frame_hdr_output(c: vec3f, nearness: f32) -> vec4f {
  if frame.footprint_scale == 0.0 {
    return vec4f(c, 0.0);
  }
  let bits = bitcast<vec3u>(c) & vec3u(0x7f800000u);
  if any(bits == vec3u(0x7f800000u)) {
    return vec4f(0.0, 0.0, 0.0, -6e4);
  }
  return vec4f(clamp(c, vec3f(0.0), vec3f(6e4)), 1.0 + min(1e4 * nearness, 1.9e4));
}

// Share by which the nearness of frame_edged_nearness alternates. It bends by 0.26 to 0.3 of itself, and a bend of 0.2
// (TONE_SURE_EDGE_RATIO) counts as an edge at any distance.
const FRAME_EDGED_SHARE = 0.15;

// Nearness for frame_hdr_output, in a pixel of the picture, of something with edges of paint or between facets, which are
// no steps in distance. It differs between neighbouring pixels, so that the tone pass looks for such edges.
fn frame_edged_nearness(nearness: f32, pixel: vec2u) -> f32 {
  return nearness * (1.0 + FRAME_EDGED_SHARE * f32((pixel.x ^ pixel.y) & 1u));
}
