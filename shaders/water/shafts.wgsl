// Light shafts: how waves focus the sun's beam around a diving eye. All points on a viewing ray that are followed up the
// refracted beam meet the surface on one straight line from the point from which the eye itself is lit. So a map in polar
// coordinates around that point holds each ray in one column, sharp from column to column, and smooth along it.

// Columns and rows of the map (`SHAFTS_SIZE` in src/render/water/under.rs).
const SHAFTS_MAP_SIZE = vec2f(512.0, 32.0);
// Distances of the first row, m, and of the last one.
const SHAFTS_NEAR_M = 0.15;
const SHAFTS_FAR_M = 60.0;
const SHAFTS_LOG_RANGE = log2(1.0 + SHAFTS_FAR_M / SHAFTS_NEAR_M);
// Depths of the four channels of the map: the first, m, and the ratio of each to the one before.
const SHAFTS_FIRST_DEPTH_M = 0.7;
const SHAFTS_DEPTH_RATIO = 3.0;
// Half the shortest wavelength that focuses light at a depth, divided by the depth: in the equilibrium range of wind waves
// shorter ones have lost their focus (slopes::shortest_caustic_half_wavelength_m).
const SHAFTS_FILTER = 0.12;
// Contrast of the shafts relative to that of the irradiance: they are brightest where several waves focus light one
// behind the other, of which the map keeps only a mean.
const SHAFTS_STRENGTH = 3.0;
// Samples along a row.
const SHAFTS_ROW_SAMPLES = 3;
// Number of points at which a viewing ray reads the map.
const SHAFTS_STEPS = 10;

// Point of the surface, relative to the point above the eye, m, from which the mean beam lights a point at `offset`
// (x, z) from the eye and at a depth.
fn shafts_entry(offset: vec2f, depth_m: f32) -> vec2f {
  let beam = medium_beam();
  return offset + beam.xz * (depth_m / beam.y);
}

fn shafts_eye_depth_m() -> f32 {
  return max(frame.water_at_eye.x, 0.02);
}

// Irradiance by the sun relative to its mean, at four depths, in one direction (column) and at one distance (row).
@fragment
fn shafts_fragment(in: LightFragment) -> @location(0) vec4f {
  let size = SHAFTS_MAP_SIZE;
  let azimuth = 2.0 * ATM_PI * in.clip.x / size.x;
  let centre = shafts_entry(vec2f(0.0), shafts_eye_depth_m());
  var sum = vec4f(0.0);
  for (var i = 0; i < SHAFTS_ROW_SAMPLES; i++) {
    let v = (floor(in.clip.y) + (f32(i) + 0.5) / f32(SHAFTS_ROW_SAMPLES)) / size.y;
    let distance_m = SHAFTS_NEAR_M * (exp2(v * SHAFTS_LOG_RANGE) - 1.0);
    let at = centre + distance_m * vec2f(cos(azimuth), sin(azimuth));
    var depth_m = SHAFTS_FIRST_DEPTH_M;
    for (var channel = 0; channel < 4; channel++) {
      let filter_m = max(SHAFTS_FILTER * depth_m, 0.015 * distance_m);
      let gain = bed_caustic_gain(at, depth_m, filter_m);
      sum += select(vec4f(0.0), vec4f(gain), vec4i(channel) == vec4i(0, 1, 2, 3));
      depth_m *= SHAFTS_DEPTH_RATIO;
    }
  }
  return sum / f32(SHAFTS_ROW_SAMPLES);
}

// Mean over a viewing ray of what waves make of the sun's beam, relative to its mean, weighted by what reaches the eye.
fn shafts_gain(map: texture_2d<f32>, dir: vec3f, depth_m: f32, length_m: f32) -> f32 {
  if frame.sun_direction.y <= 0.02 {
    return 1.0;
  }
  let beam = medium_beam();
  // The ray's velocity on the surface, as points on it are followed up the beam.
  let along = dir.xz - beam.xz * (dir.y / beam.y);
  let speed = length(along) / SHAFTS_NEAR_M;
  let turns = maths_phase(along) / (2.0 * ATM_PI);
  let end_m = min(length_m, 3.5 / max(medium_extinction().g, 0.02));
  // Binary logarithms of what reaches the eye, per metre, and of the focused light, some of which is scattered on its
  // way, for each length SHAFTS_FIRST_DEPTH_M.
  let rate = 1.442695 * medium_rates(dir)[1].g;
  let blur = SHAFTS_FIRST_DEPTH_M * 1.442695 * 0.25 * (material.scattering.g - material.backscatter.g) / beam.y;
  let channels_per_octave = 1.0 / log2(SHAFTS_DEPTH_RATIO);
  const CHANNELS = vec4f(0.0, 1.0, 2.0, 3.0);
  var sum = 0.0;
  var total = 1e-6;
  var from_m = 0.0;
  for (var i = 0; i < SHAFTS_STEPS; i++) {
    let part = f32(i + 1) / f32(SHAFTS_STEPS);
    let to_m = end_m * part * (0.25 + 0.75 * part);
    let t = 0.5 * (from_m + to_m);
    let weight = (to_m - from_m) * exp2(-rate * t);
    from_m = to_m;
    let depths = max((depth_m - dir.y * t) / SHAFTS_FIRST_DEPTH_M, 1e-3);
    let v = log2(1.0 + speed * t) / SHAFTS_LOG_RANGE;
    let gains = textureSampleLevel(map, sky_sampler, vec2f(turns, v), 0.0);
    let channel = clamp(channels_per_octave * log2(depths), 0.0, 3.0);
    let gain = dot(gains, saturate(1.0 - abs(channel - CHANNELS)));
    sum += weight * min(depths, 1.0) * exp2(blur * depths) * (gain - 1.0);
    total += weight;
  }
  return max(1.0 + SHAFTS_STRENGTH * sum / total, 0.0);
}
