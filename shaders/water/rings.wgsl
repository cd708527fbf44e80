// Rings of waves around the places where raindrops fall. Their mean square slope is part of the slopes that no map
// holds (src/render/frame.rs). Where pixels are short enough to show rings, this part moves from the variance to the
// slope.

// Whether there is rain.
override WATER_RAIN: bool = false;

// Layers of rings: side of a cell with one ring at a time, m; wave number, rad/m; half width of the packet of waves, m;
// and share of the mean square slope. A ring reaches from its middle to half a cell at most.
const RING_LAYERS = array<vec4f, 2>(vec4f(0.273, 121.0, 0.024, 0.55), vec4f(0.182, 190.0, 0.016, 0.45));
// Number of cells in the period of 5.46 m by which positions are counted (`RING_PERIOD_M` in
// src/render/water/material.rs).
const RING_CELLS_PER_PERIOD = array<i32, 2>(20, 30);
// Growth of the radius during the life of a ring, in cells, so that with its width it stays within half a cell.
const RING_REACH = 0.36;
// The mean square slope of rings with amplitude 1 in every cell is RING_SQUARE * RING_REACH * half width / cell: the
// integral of 2 pi r cos^2 exp(-2 (r - r0)^2 / w^2) over r, with the fading over the life of a ring.
const RING_SQUARE = 0.34;
// Large drops make higher and longer waves: amplitude of a ring from that of the smallest (x) by an increase (y), with a
// mean square of 1, and wave number, relative to the layer's, from that of the smallest to that of the largest drops.
const RING_AMPLITUDES = vec2f(0.45, 1.0127);
const RING_WAVE_NUMBERS = vec2f(1.4, 0.7);
// Amplitude of the slope of the steepest rings.
const RING_HIGHEST_SLOPE = 0.8;

// Slope by the rings of a layer at an undisplaced position, for rings of amplitude 1.
fn ring_layer_slope(layer: u32, at: vec2f) -> vec2f {
  let shape = RING_LAYERS[layer];
  let place = (at + material.ring_origin) / shape.x;
  // A ring that reaches `at` has its middle in one of the four nearest cells.
  let first = floor(place - 0.5);
  var slope = vec2f(0.0);
  for (var i = 0; i < 4; i++) {
    let cell = first + vec2f(f32(i & 1), f32(i >> 1));
    let key = bitcast<vec2u>(vec2i(cell) + material.ring_period * RING_CELLS_PER_PERIOD[layer]);
    let time = material.ring_moment_fraction + noise_pcg4d_unit(vec4u(key, layer, 0u)).x;
    let random = noise_pcg4d_unit(vec4u(key, layer + 8u, material.ring_moment + u32(time)));
    let age = fract(time);
    let off = (place - cell - random.xy) * shape.x;
    let r = length(off);
    let from_crest = r - RING_REACH * age * shape.x;
    let packet = exp(-min(from_crest * from_crest / (shape.z * shape.z), 40.0));
    let alive = select(0.0, 1.0 - age, random.z < material.ring_share);
    let amplitude = alive * (RING_AMPLITUDES.x + RING_AMPLITUDES.y * random.w);
    let k = shape.y * mix(RING_WAVE_NUMBERS.x, RING_WAVE_NUMBERS.y, random.w);
    slope += (amplitude * packet * cos(k * from_crest) / max(r, 1e-4)) * off;
  }
  return slope;
}

// Adds the rings that a pixel of the length `length_m` resolves to its slope, and takes their share from its variance.
fn ring_add(seen: WaterSlope, at: vec2f, length_m: f32) -> WaterSlope {
  var out = seen;
  for (var layer = 0u; layer < 2u; layer++) {
    let shape = RING_LAYERS[layer];
    let phase = shape.y * length_m;
    // The mean of a wave over a pixel.
    let kept = exp(-phase * phase / 24.0);
    if kept > 0.05 {
      let square = material.ring_slope_variance * shape.w;
      let cell_square = RING_SQUARE * RING_REACH * shape.z / shape.x;
      // Few drops of a light rain are large enough for a ring; the others stay roughness.
      let ring_square = cell_square * material.ring_share;
      let amplitude = min(sqrt(square / max(ring_square, 1e-9)), RING_HIGHEST_SLOPE);
      out.mean += ring_layer_slope(layer, at) * (kept * amplitude);
      let drawn = 0.5 * ring_square * amplitude * amplitude * kept * kept;
      out.variance = max(out.variance - vec3f(vec2f(drawn), 0.0), vec3f(1e-5, 1e-5, -1.0));
    }
  }
  return out;
}
