// The map of foam, and the layers of noise that shape foam.

// Layers: the levels of the map. Foam (x), its current source (y), front of a breaker (z) and plume of bubbles (w).
@group(1) @binding(3) var foam_map: texture_2d_array<f32>;

// Noise layers: windrows of tens of metres, patches of metres, strands of decimetres, threads of centimetres.
const FOAM_WINDROW_LAYER = 0u;
const FOAM_PATCH_LAYER = 1u;
const FOAM_STRAND_LAYER = 2u;
const FOAM_THREAD_LAYER = 3u;
// Reciprocals of the standard deviations of the noise of these layers: that of windrows is evenly spread, the others are
// normal.
const FOAM_PER_DEVIATION = vec4f(3.464, 6.08, 6.08, 6.08);
