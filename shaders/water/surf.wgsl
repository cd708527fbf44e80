// Waves that come ashore, as the picture shows them. The map of the waves at a coast holds linear waves on texels of
// metres. In shallow water waves have narrow, high crests between long, flat troughs, then a steep front, and the top of a
// front that breaks falls over. This shape follows from the phase of the wave, its height and the depth, which the layer
// behind that of the map holds (shaders/coast/sum.wgsl), by the skewness and asymmetry of measured waves.

// Least Ursell number of a wave that is no sine.
const SURF_LEAST_URSELL = 0.02;
// Ursell number from which half of the squeeze of the front is there, the power with which it grows, and all of it.
const SURF_SQUEEZED = vec3f(1.3, 1.3, 1.75);
// Ursell number at which crests are narrowest, the power with which they become so, and by how much the exponent of their
// shape then exceeds that of a sine, 1.
const SURF_PEAKED = vec3f(0.6, 1.2, 0.3);
// Heights of waves, relative to that from which they break, between which the front becomes upright, and the top falls.
const SURF_UPRIGHT = vec2f(0.75, 1.05);
const SURF_FALLING = vec2f(0.85, 1.1);
// Squeeze of a front that stands upright; what the top that falls over adds to it, relative to the wave's height times its
// wave number; and by how much its crest is narrower.
const SURF_UPRIGHT_SQUEEZE = 1.71;
const SURF_OVERHANG = 0.6;
const SURF_UPRIGHT_PEAK = 0.6;
// Phase before the crest, rad, of the middle of the steep front.
const SURF_FRONT_PHASE = 0.75;
// Lengths, m, of two sizes of lobes in which a front that falls over runs ahead.
const SURF_LOBES_M = vec2f(12.0, 2.6);
// How far the tops of lobes lie before the creases between them, relative to the height of the wave; and the largest
// height that counts, m: longer lobes would turn the phase of the wave around.
const SURF_LOBES_AHEAD = vec2f(1.8, 0.22);
const SURF_LOBES_MOST_HEIGHT_M = 1.5;
// Share of the squeeze at the eye, and distances from it, m, over which the squeeze grows to all of it: the mesh is finest
// around the water below the eye, which must not lie far from where the waves have moved it from.
const SURF_AT_EYE = 0.45;
const SURF_BESIDE_EYE_M = vec2f(3.0, 16.0);
// Least depth, m, from which the Ursell number is computed.
const SURF_LEAST_DEPTH_M = 0.3;
// Least wave number, rad/m, times the root of the depth, m: that of long waves of 16 s. Where waves from opposite directions
// meet, as before a wall, the phase of their sum changes more slowly, and less of this shape is left.
const SURF_LEAST_WAVE_NUMBER = 0.125;
// Changes of the phase between texels, rad, over which this shape fades out: on coarser maps the phase is not known.
const SURF_COARSE = vec2f(1.4, 2.2);
// Coefficients of the sines of once to four times the phase in the motion that squeezes the front: the integral of the
// fourth power of (1 + cos) / 2, without its mean.
const SURF_SINES = vec4f(0.4375, 0.109375, 0.0208333, 0.001953);
// Depths of the still water, m, between which waves lose this shape: they become swash, which rises and falls on the
// beach as a whole and has no steep front.
const SURF_SWASH_M = vec2f(0.1, 0.9);
// Step of the phase, rad, over which the shape is differentiated.
const SURF_PHASE_STEP = 0.03;

// How far the form of a wave is from a sine: squeeze of its front (x), and exponent of the shape of its crest (y). `over` is
// the height of the wave, relative to that from which it breaks; `steepness` is its height times its wave number.
fn surf_form(ursell: f32, over: f32, steepness: f32) -> vec2f {
  let squeezed = pow(ursell / SURF_SQUEEZED.x, SURF_SQUEEZED.y);
  let peaked = pow(ursell / SURF_PEAKED.x, SURF_PEAKED.y);
  let squeeze = SURF_SQUEEZED.z * squeezed / (1.0 + squeezed);
  let peak = 1.0 + 4.0 * SURF_PEAKED.z * peaked / ((1.0 + peaked) * (1.0 + peaked));
  let falling = SURF_OVERHANG * steepness * maths_rise(over, SURF_FALLING);
  let upright = vec2f(max(squeeze, SURF_UPRIGHT_SQUEEZE) + falling, peak + SURF_UPRIGHT_PEAK);
  return mix(vec2f(squeeze, peak), upright, maths_rise(over, SURF_UPRIGHT));
}

// Forward motion, relative to the reciprocal of the wave number (x), and upward motion, relative to the wave's height (y),
// that give a sine wave the form of surf_form, at a phase, which is 0 on the crest and positive before it. Both motions
// have a mean of 0 over a wave, and the wave keeps its variance within a few per cent.
fn surf_shape(phase: f32, form: vec2f) -> vec2f {
  let off = phase - SURF_FRONT_PHASE;
  let forward = -form.x * dot(SURF_SINES, sin(off * vec4f(1.0, 2.0, 3.0, 4.0)));
  let sine = 0.5 + 0.5 * cos(phase);
  // The mean of a power of (1 + cos) / 2 falls with the exponent.
  let up = pow(max(sine, 1e-4), form.y) - 0.5 * pow(form.y, -0.43) - (sine - 0.5);
  return vec2f(forward, up);
}

// The layer behind that of a coast's waves, as `here` of SurfWave holds it, in the texel at texture coordinates.
fn surf_at(layer: u32, uv: vec2f) -> vec4f {
  return textureSampleLevel(displacement_map, nearest_mip_sampler, uv, layer + 1u, 0.0);
}

// Change of the phase, rad/m (x), of the amplitude, relative to it (y), and of the depth, m/m (z), where half the complex
// amplitude is `here`, and `before` and `after` are values of surf_at a texel to each side. Steps of one texel are
// shorter than half a wave.
fn surf_change(before: vec4f, here: vec2f, after: vec4f, texels_per_m: f32) -> vec3f {
  let step =
    maths_complex_mul(after.xy, vec2f(here.x, -here.y)) + maths_complex_mul(here, vec2f(before.x, -before.y));
  let growth = 0.5 * (length(after.xy) - length(before.xy)) / max(length(here), 1e-5);
  return texels_per_m * vec3f(maths_phase(step), growth, 0.5 * (after.w - before.w));
}

// A coast's wave at an undisplaced position.
struct SurfWave {
  // Half the complex amplitude, m (xy); height relative to that from which the wave breaks (z); depth, m (w).
  here: vec4f,
  // Changes along x and z of the phase, rad/m, of the amplitude, relative to it, 1/m, and of the depth, m/m.
  turn: vec2f,
  growth: vec2f,
  deepening: vec2f,
  // Depth, m, and wave number, rad/m, within the bounds of the formulas.
  depth_m: f32,
  wave_number: f32,
  // Whether the map is fine enough to tell the phase, 0 to 1.
  known: f32,
}

// The layer behind that of a coast's waves at an undisplaced position relative to the point below the eye, m.
fn surf_sample(map: FrameCascade, at: vec2f) -> vec4f {
  let uv = map.uv_below_eye + at * map.inverse_patch;
  return water_sample_spline(displacement_map, water_spline_taps(uv, frame.n, 1.0), map.layer + 1u);
}

// The wave of a coast's layer at an undisplaced position relative to the point below the eye, m.
fn surf_wave(map: FrameCascade, at: vec2f) -> SurfWave {
  let here = surf_sample(map, at);
  let uv = map.uv_below_eye + at * map.inverse_patch;
  let texel = vec2f(1.0 / frame.n, 0.0);
  let texels_per_m = frame.n * map.inverse_patch;
  let along_x =
    surf_change(surf_at(map.layer, uv - texel), here.xy, surf_at(map.layer, uv + texel), texels_per_m);
  let along_z = surf_change(
    surf_at(map.layer, uv - texel.yx), here.xy, surf_at(map.layer, uv + texel.yx), texels_per_m);
  let turn = vec2f(along_x.x, along_z.x);
  let depth_m = max(here.w, SURF_LEAST_DEPTH_M);
  let wave_number = max(length(turn), SURF_LEAST_WAVE_NUMBER * inverseSqrt(depth_m));
  let known = 1.0 - maths_rise(wave_number / texels_per_m, SURF_COARSE);
  let deepening = vec2f(along_x.z, along_z.z);
  return SurfWave(here, turn, vec2f(along_x.y, along_z.y), deepening, depth_m, wave_number, known);
}

// How far the front of a wave runs ahead of its mean at an undisplaced position relative to the point below the eye, m
// (x), and the derivatives of that along x and z (yz), for which the height and `over` count as even. White water that
// falls over is ragged: without lobes, the front would be as straight as the crest of a long swell. Lobes are fixed to the
// world, so that the edge churns while it runs over them. Foam and spray have their sources at the mean.
fn surf_lobes(at: vec2f, height_m: f32, over: f32) -> vec3f {
  let torn = maths_rise(over, SURF_FALLING);
  // Lobes lie on the map of foam, as the billows of breakers do.
  if torn <= 0.0 || frame.breaker_level_count == 0u {
    return vec3f(0.0);
  }
  let ahead_m = (torn * min(height_m, SURF_LOBES_MOST_HEIGHT_M)) * SURF_LOBES_AHEAD;
  let spacing = mesh_spacing(length(at));
  return breaker_shown_billows(at, SURF_LOBES_M.x, spacing, vec3f(ahead_m.x, 0.0, 0.0))
    + breaker_shown_billows(at, SURF_LOBES_M.y, spacing, vec3f(ahead_m.y, 0.0, 0.0));
}

// How much of this shape a wave has at a depth of the still water, m (x), and the derivative of that, 1/m (y).
fn surf_shown(depth_m: f32) -> vec2f {
  let over = 1.0 / (SURF_SWASH_M.y - SURF_SWASH_M.x);
  let t = saturate((depth_m - SURF_SWASH_M.x) * over);
  return vec2f(maths_smooth(t), 6.0 * over * t * (1.0 - t));
}

// Motion of the water at an undisplaced position relative to the point below the eye, m, where waves come ashore.
fn surf_motion(at: vec2f) -> BreakerMotion {
  var out: BreakerMotion;
  if !WATER_COAST {
    return out;
  }
  let gain = coast_at(at).z;
  for (var c = 0u; c < frame.cascade_count && gain > 0.0; c++) {
    let map = frame.cascades[c];
    if map.coast_gains.z == 0.0 {
      continue;
    }
    let wave = surf_wave(map, at);
    let height_m = 4.0 * gain * length(wave.here.xy);
    let wave_number = wave.wave_number;
    let onshore = wave.turn / wave_number;
    let ursell = 0.375 * height_m / (wave_number * wave_number * wave.depth_m * wave.depth_m * wave.depth_m);
    if ursell < SURF_LEAST_URSELL {
      continue;
    }
    let over = gain * wave.here.z;
    var form = surf_form(ursell, over, height_m * wave_number);
    let shown = wave.known * surf_shown(wave.here.w);
    let shown_change = shown.y * wave.deepening;
    form = mix(vec2f(0.0, 1.0), form, shown.x);
    form.x *= mix(SURF_AT_EYE, 1.0, maths_rise(length(at), SURF_BESIDE_EYE_M));
    let lobes = surf_lobes(at, height_m, over);
    let ahead = wave_number * (shown.x * lobes + vec3f(0.0, lobes.x * shown_change));
    // The map's sine wave stays where it is, so that a shifted shape also moves the sine.
    let map_phase = maths_phase(wave.here.xy);
    let phase = map_phase - ahead.x;
    let turn = wave.turn - ahead.yz;
    let shape = surf_shape(phase, form);
    let change = (1.0 / SURF_PHASE_STEP) * (surf_shape(phase + SURF_PHASE_STEP, form) - shape);
    // The shape grows with the share of it that is shown, nearly in proportion.
    let grown = shape / max(shown.x, 1e-3);
    let forward_m = shape.x / wave_number;
    let forward_change = (change.x / wave_number) * turn + (grown.x / wave_number) * shown_change;
    let up = shape.y + 0.5 * (cos(phase) - cos(map_phase));
    let up_change =
      (change.y - 0.5 * sin(phase)) * turn + grown.y * shown_change + 0.5 * sin(map_phase) * wave.turn;
    out = breaker_pushed(out, onshore, forward_m, forward_change);
    out.moved.y += height_m * up;
    out.derivatives.slope += height_m * (up_change + up * wave.growth);
  }
  return out;
}
