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
// threads of centimetres. Patches and strands are those of foam that the wind has drawn out. Fronts of breakers, foam
// on land and, in light wind, new foam read two other layers in their place, which the wind hardly stretches: one with
// lace of metres (red) and the billows of fronts (alpha), one with strands (red) and lumps (alpha) of decimetres.
const FOAM_WINDROW_LAYER = 0u;
const FOAM_PATCH_LAYER = 1u;
const FOAM_STRAND_LAYER = 2u;
const FOAM_THREAD_LAYER = 3u;
const FOAM_BILLOW_LAYER = 10u;
const FOAM_TUMBLE_LAYER = 11u;
// Reciprocals of the standard deviations of the noise of the first four layers: that of windrows is evenly spread, the
// others are normal.
const FOAM_PER_DEVIATION = vec4f(3.464, 6.08, 6.08, 6.08);
// Part of the opacity of the body of foam that its core has. The whole body has the rest, so that it is thinner at the
// rims of its holes.
const FOAM_CORE_SHARE = 0.5;
// Deviations of the pattern by which the core begins above the edge of the body. The core is as soft as the film.
const FOAM_CORE_SHIFT = 0.35;
// Part of the light of the water, or of the film of water on land, that the foam on it keeps near a shore: its wet
// bubbles mirror the sky, too.
const FOAM_SHORE_SHEEN = 0.35;

// Opacity of the film of foam, 0 to 1, where its pattern has the value `z`. `edges` are those of film (x) and body (y) in
// deviations of the pattern, and `sharp` their sharpness.
fn foam_film(z: f32, edges: vec2f, sharp: vec2f) -> f32 {
  return maths_normal_cdf((z + edges.x) * sharp.x);
}

// Opacity of the body, as foam_film.
fn foam_body(z: f32, edges: vec2f, sharp: vec2f) -> f32 {
  let above = z + edges.y;
  let core = maths_normal_cdf((above - FOAM_CORE_SHIFT) * sharp.x);
  return mix(maths_normal_cdf(above * sharp.y), core, FOAM_CORE_SHARE);
}
