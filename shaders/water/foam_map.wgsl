// The map of foam, and the layers of noise that shape foam.

// Layers: the levels of the map. Foam (x), its current source (y), front of a breaker (z) and plume of bubbles (w).
@group(1) @binding(3) var foam_map: texture_2d_array<f32>;

// The finest level of the map from `first` on that holds a point (x, z) relative to the one below the eye, m, and whose
// cells are longer than a third of `size`, m; the number of levels, if there is none.
fn foam_finest_level(first: u32, at: vec2f, size: f32) -> u32 {
  for (var level = first; level < frame.foam_level_count; level++) {
    let map = frame.foam_levels[level];
    let off = abs(at - map.centre);
    if max(off.x, off.y) * map.inverse_half_side < 1.0 && size * map.inverse_cell < 3.0 {
      return level;
    }
  }
  return frame.foam_level_count;
}

// Values of a level of the map at a point.
fn foam_cell(level: u32, at: vec2f) -> vec4f {
  let map = frame.foam_levels[level];
  return textureSampleLevel(foam_map, nearest_mip_sampler, map.uv_below_eye + at * map.inverse_side, level, 0.0);
}

// Noise layers (src/render/water/material.rs): windrows of tens of metres, patches of metres, strands of decimetres,
// threads of centimetres; and billows and strands that tumble down the front of a breaker, in the place of patches and
// of the strands that the wind has drawn out.
const FOAM_WINDROW_LAYER = 0u;
const FOAM_PATCH_LAYER = 1u;
const FOAM_STRAND_LAYER = 2u;
const FOAM_THREAD_LAYER = 3u;
const FOAM_BILLOW_LAYER = 10u;
const FOAM_TUMBLE_LAYER = 11u;
// Reciprocals of the standard deviations of the noise of the first four layers: that of windrows is evenly spread, the
// others are normal.
const FOAM_PER_DEVIATION = vec4f(3.464, 6.08, 6.08, 6.08);
// Opacity of the body of foam at its edge (x), and what its core adds (y), relative to its own: the body is thinner at
// the rims of its holes. And the deviations of the pattern by which the core begins above the edge of the body.
const FOAM_BODY_CORE = vec2f(0.5, 0.5);
const FOAM_CORE_SHIFT = 0.35;
// Part of the light of the water, or of the film of water on land, that the foam on it keeps near a shore: its wet
// bubbles mirror the sky, too.
const FOAM_SHORE_SHEEN = 0.35;
