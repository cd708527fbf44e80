// Cirrus: ice so thin that two sheets stand for it, which a ray meets at one point each. The upper sheet is a veil with
// long fibres, the lower one holds heads from which ice falls in streaks. Positions are in km in the frame of the
// clouds' field. Needs the module variables of cloud_field.wgsl.

// Heights of the lower and the upper sheet above the base of the layer, in thicknesses.
const CIRRUS_RISES = vec2f(0.15, 0.85);
// Sheets beyond the second distance, km, are lost in the haze; they fade from the first one on.
const CIRRUS_FAR_KM = vec2f(170.0, 300.0);
// Optical depth of the streaks of the lower sheet and of the upper sheet, straight up, where the weather map is full,
// divided by that of dense cloud through the whole layer.
const CIRRUS_DEPTHS = vec2f(0.3, 0.24);
// Value of the weather map at which the sheets begin, and the reciprocal of the range in which they become full. Their
// optical depth rises with the square, so most of what is seen is faint.
const CIRRUS_EDGE = 0.3;
const CIRRUS_PER_RISE = 1.1;
// Fibres: octaves of noise, by the number of the noise's sides along and across a tile. All numbers are whole, so that
// the tile repeats without a seam. The logarithm of the optical depth is the sum of these, of tufts and of ripples:
// measured cirrus has such a distribution, with many faint places and few dense ones.
const CIRRUS_OCTAVES = 4;
const CIRRUS_ALONG = vec4f(1.0, 3.0, 5.0, 16.0);
const CIRRUS_ACROSS = vec4f(6.0, 17.0, 47.0, 113.0);
const CIRRUS_OCTAVE_GAIN = vec4f(4.0, 2.4, 1.2, 1.0);
// Turn of each octave against the first one: fibres that were all parallel would look combed.
const CIRRUS_OCTAVE_TURN = vec4f(0.0, 0.09, -0.11, 0.17);
// Tufts break the fibres up, which would look combed without them: sides of their noise, and gain.
const CIRRUS_TUFTS = vec2f(19.0, 23.0);
const CIRRUS_TUFT_GAIN = 2.2;
// Ripples of cirrocumulus: sides of their noise, and gain among fibres (x) and in even places (y).
const CIRRUS_RIPPLES = vec2f(47.0, 61.0);
const CIRRUS_RIPPLE_GAIN = vec2f(1.6, 2.4);
// Fraction of the sides across by which the third coordinate moves on, so that fibres side by side differ: near the
// golden section.
const CIRRUS_SKEW = 0.382;
// Turn of the fibres of the lower and the upper sheet against the wind, in sides across for one side along the tile.
const CIRRUS_TURN = vec2f(-0.13, 0.1);
// Winds turn over tens of km, and eddies of 10 km bend and spread what they carry. Two times three waves shift the
// fibres across the wind: the numbers of the waves along and across a tile, their phases (turns) and their heights
// (tiles).
const CIRRUS_WINDS_ALONG = vec3f(1.0, 1.0, 2.0);
const CIRRUS_WINDS_ACROSS = vec3f(1.0, -2.0, 1.0);
const CIRRUS_WINDS_PHASE = vec3f(0.0, 0.3, 0.6);
const CIRRUS_WINDS_HEIGHT = vec3f(0.028, 0.02, 0.013);
const CIRRUS_EDDIES_ALONG = vec3f(2.0, 4.0, 5.0);
const CIRRUS_EDDIES_ACROSS = vec3f(5.0, -3.0, 7.0);
const CIRRUS_EDDIES_PHASE = vec3f(0.1, 0.8, 0.45);
const CIRRUS_EDDIES_HEIGHT = vec3f(0.008, 0.005, 0.003);
// Streaks: number of samples between the end of a streak and its head, distance between them, tiles; share of ice that
// is left from one to the next; sideways bend of a streak, tiles per tile squared; sides of the noise along and across
// a tile for the heads, and the values of the noise between which they become dense.
const CIRRUS_FALL_STEPS = 10;
const CIRRUS_FALL_STEP = 0.0095;
const CIRRUS_FALL_LEFT = 0.88;
const CIRRUS_HOOK = 2.0;
const CIRRUS_HEADS = vec2f(8.0, 27.0);
const CIRRUS_HEAD_EDGE = vec2f(0.40, 1.05);
// Ice between the streaks, and factor on that of the streaks: their mean is 0.46.
const CIRRUS_STREAKS = vec2f(0.14, 1.9);
// Standard deviation of the noise, and length of its longest waves, sides.
const CIRRUS_NOISE_DEVIATION = 0.16;
const CIRRUS_NOISE_LENGTH = 0.25;

// Smooth noise around 0 at `u` in tiles, with the given sides along and across a tile; `turn` turns it, and `key`
// chooses another part of it.
fn cirrus_noise(u: vec2f, sides: vec2f, turn: f32, key: f32) -> f32 {
  let across = sides.y * u.y + round(turn * sides.y) * u.x;
  let slice = key + round(CIRRUS_SKEW * sides.y) * u.y + u.x;
  let at = vec3f(sides.x * u.x, slice, across);
  return textureSampleLevel(cloud_noise_map, cloud_sampler, at, 0.0).b - 0.5;
}

// Share of waves of `length_km` that is left when the sheet is averaged over `size_km`.
fn cirrus_left(length_km: f32, size_km: f32) -> f32 {
  let ratio = 3.5 * size_km / length_km;
  return 1.0 / (1.0 + ratio * ratio);
}

// Sum of three waves at a place in tiles (x), and its change along and across the wind (yz).
fn cirrus_waves(place: vec2f, along: vec3f, across: vec3f, phase: vec3f, height: vec3f) -> vec3f {
  let at = 2.0 * ATM_PI * (along * place.x + across * place.y + phase);
  let slope = 2.0 * ATM_PI * height * cos(at);
  return vec3f(dot(sin(at), height), dot(slope, along), dot(slope, across));
}

// Shift of the fibres across the wind, tiles, at a place in tiles (x), and its change along and across the wind (yz).
fn cirrus_bend(place: vec2f) -> vec3f {
  return cirrus_waves(place, CIRRUS_WINDS_ALONG, CIRRUS_WINDS_ACROSS, CIRRUS_WINDS_PHASE, CIRRUS_WINDS_HEIGHT)
    + cirrus_waves(place, CIRRUS_EDDIES_ALONG, CIRRUS_EDDIES_ACROSS, CIRRUS_EDDIES_PHASE, CIRRUS_EDDIES_HEIGHT);
}

// Optical depth, straight up, of a sheet at a point: 0 is the lower one. It is averaged over an ellipse whose axes, km,
// are the columns of `texel_km`.
fn cirrus_depth(place: vec2f, sheet: u32, texel_km: mat2x2f) -> f32 {
  let bare = place * cloud_field.tiles_per_km + select(vec2f(0.0), vec2f(0.37, 0.61), sheet == 1u);
  let map = textureSampleLevel(weather_map, cloud_sampler, bare, 0.0).r;
  let full = saturate(CIRRUS_PER_RISE * (map + CIRRUS_EDGE));
  if full <= 0.0 {
    return 0.0;
  }
  let turn = CIRRUS_TURN[sheet];
  let bend = cirrus_bend(bare);
  let u = bare + vec2f(0.0, bend.x);
  let along_km = length(vec2f(1.0, 0.0) * texel_km);
  let key = 0.41 * f32(sheet);
  let broad = cirrus_noise(u, vec2f(1.0, 2.0), turn, key + 0.17);
  // Some places are an even veil, others all fibres.
  let fibrous = smoothstep(-0.2, 0.3, broad);
  var log_depth = 0.0;
  var variance = 0.0;
  // The fibres, then the tufts and the ripples.
  for (var i = 0; i < CIRRUS_OCTAVES + 2; i++) {
    var sides = CIRRUS_RIPPLES;
    var gain = mix(CIRRUS_RIPPLE_GAIN.y, CIRRUS_RIPPLE_GAIN.x, smoothstep(0.05, 0.4, fibrous));
    var octave_turn = turn;
    if i < CIRRUS_OCTAVES {
      sides = vec2f(CIRRUS_ALONG[i], CIRRUS_ACROSS[i]);
      gain = CIRRUS_OCTAVE_GAIN[i] * mix(0.25, 1.0, fibrous);
      octave_turn += CIRRUS_OCTAVE_TURN[i];
    } else if i == CIRRUS_OCTAVES {
      sides = CIRRUS_TUFTS;
      gain = CIRRUS_TUFT_GAIN;
    }
    // Fibres are bent: their width is measured across their own direction.
    let across_km = length(vec2f(octave_turn + bend.y, 1.0 + bend.z) * texel_km);
    let lengths = CIRRUS_NOISE_LENGTH / (cloud_field.tiles_per_km * sides);
    gain *= cirrus_left(lengths.x, along_km) * cirrus_left(lengths.y, across_km);
    if gain > 0.1 {
      log_depth += gain * cirrus_noise(u, sides, octave_turn, key + 0.29 * f32(i));
      variance += gain * gain * (CIRRUS_NOISE_DEVIATION * CIRRUS_NOISE_DEVIATION);
    }
  }
  let across_km = length(vec2f(turn + bend.y, 1.0 + bend.z) * texel_km);
  var depth = full * full * exp(log_depth - 0.5 * variance);
  if sheet == 0u {
    depth *= cirrus_streaks(u, turn, vec2f(along_km, across_km), broad);
  }
  return depth * CIRRUS_DEPTHS[sheet] * cloud_field.extinction_per_km / cloud_field.layers_per_km;
}

// Ice at `u`, tiles, that has fallen from heads upwind: it lags behind into wind of another direction, so that streaks
// bend, and thins out on its way. Where the slow noise `broad` is high there are more heads and longer streaks.
fn cirrus_streaks(u: vec2f, turn: f32, size_km: vec2f, broad: f32) -> f32 {
  let lengths = CIRRUS_NOISE_LENGTH / (cloud_field.tiles_per_km * CIRRUS_HEADS);
  let left = cirrus_left(lengths.x, 0.5 * size_km.x) * cirrus_left(lengths.y, size_km.y);
  let reach = CIRRUS_FALL_STEP * clamp(1.0 + 3.0 * broad, 0.4, 1.6);
  let hook = CIRRUS_HOOK * (1.0 + 4.0 * broad);
  var sum = 0.0;
  var weight = 1.0;
  var whole = 0.0;
  for (var i = 0; i < CIRRUS_FALL_STEPS; i++) {
    let fallen = reach * f32(i);
    let source = u + vec2f(fallen, hook * fallen * fallen);
    let noise = 0.5 + 0.5 * broad + left * cirrus_noise(source, CIRRUS_HEADS, turn, 0.77);
    sum += weight * smoothstep(CIRRUS_HEAD_EDGE.x, CIRRUS_HEAD_EDGE.y, noise + 0.06 * (1.0 - left));
    whole += weight;
    weight *= CIRRUS_FALL_LEFT;
  }
  return CIRRUS_STREAKS.x + CIRRUS_STREAKS.y * sum / whole;
}
