// Tone curves: exposed light to code values of the screen.

// Primaries in which the tone curves of film and AgX act on each channel: less saturated ones (AgX by Troy Sobotka), so
// that bright colours fade towards white; and the way back.
const TONE_INTO = mat3x3f(
  vec3f(0.842479062253094, 0.0423282422610123, 0.0423756549057051),
  vec3f(0.0784335999999992, 0.878468636469772, 0.0784336),
  vec3f(0.0792237451477643, 0.0791661274605434, 0.879142973793104));
const TONE_OUT = mat3x3f(
  vec3f(1.19687900512017, -0.0528968517574562, -0.0529716355144438),
  vec3f(-0.0980208811401368, 1.15190312990417, -0.0980434501171241),
  vec3f(-0.0990297440797205, -0.0989611768448433, 1.15107367264116));

// Film curve: code value (x^n / (x^n + s))^m of light x. It is as steep as AgX at middle grey, and so long above white
// that the light around the sun still differs. `log_light` is the binary logarithm of the light.
const TONE_FILM_CONTRAST = 1.25;
const TONE_FILM_MIDDLE = 0.3585;
const TONE_FILM_GAMMA = 0.55;
const TONE_FILM_SATURATION = 1.1;
// Share of the difference between blue and green that is added to green. It turns blues by about 8 degrees of hue
// towards cyan, as films and cameras show them, where the primaries of a display make skies look purple. Greys and
// warm colours stay as they are.
const TONE_FILM_BLUE_TURN = 0.14;
// Binary logarithm of the light of the brightest channel from which highlights fade no further.
const TONE_FILM_WHITEST = 5.0;
// Shoulder: from this binary logarithm of the light on, light is held back, in the end by this share of its doublings.
// So the glow around the sun falls off over more decades and keeps its hue, and the sun burns out in a white core.
const TONE_FILM_SHOULDER = -0.5;
const TONE_FILM_HELD = 0.28;

fn tone_film_response(log_light: vec4f) -> vec4f {
  let light = exp2(TONE_FILM_CONTRAST * log_light);
  return exp2(TONE_FILM_GAMMA * log2(light / (light + TONE_FILM_MIDDLE)));
}

// Film curve of this program: half the light with its hue, and half with each channel on its own, which fades towards
// white as on film.
fn tone_film(linear: vec3f) -> vec3f {
  let light = clamp(linear, vec3f(1e-6), vec3f(1e6));
  let logs = log2(light);
  let most = max(logs.r, max(logs.g, logs.b));
  let over = max(most - TONE_FILM_SHOULDER, 0.0);
  let hold = TONE_FILM_HELD * over * over / (over + 1.0);
  let held = most - hold;
  // Light brighter than TONE_FILM_WHITEST, such as the low sun, keeps the tint that light of that brightness has.
  let tinted = light * exp2(min(TONE_FILM_WHITEST, held) - most);
  let response = tone_film_response(vec4f(log2(TONE_INTO * tinted), held));
  let white = response.w;
  let own = TONE_OUT * response.rgb;
  let hue = white * exp2((TONE_FILM_CONTRAST * TONE_FILM_GAMMA) * (logs - most));
  let bleach = saturate(4.0 * white - 3.0);
  let kept = mix(hue, own, 0.8 * bleach * bleach);
  let both = 0.5 * (own + kept);
  let grey = sky_luminance(both);
  var vivid = grey + TONE_FILM_SATURATION * (both - grey);
  vivid.g += TONE_FILM_BLUE_TURN * max(vivid.b - vivid.g, 0.0);
  return clamp(vivid, vec3f(0.0), vec3f(1.0));
}

// AgX tone curve by Troy Sobotka in the polynomial form of Benjamin Wrensch, with a look that keeps the sea's blues.
fn tone_agx(linear: vec3f) -> vec3f {
  // Range of the curve in stops, and its ends as light: 2 to the power of LOW and of HIGH.
  const LOW = -12.47393;
  const HIGH = 4.026069;
  const DARKEST = vec3f(1.7578e-4);
  const BRIGHTEST = vec3f(16.2917);
  const PER_STOP = 1.0 / (HIGH - LOW);
  let x = log2(clamp(TONE_INTO * linear, DARKEST, BRIGHTEST)) * PER_STOP - LOW * PER_STOP;
  // Wrensch's polynomial followed by the look's contrast, 1.09 c^1.25, as one polynomial within 0.0002 of both.
  var c = -14.97623 * x + 73.74662;
  c = c * x - 120.5589;
  c = c * x + 77.13313;
  c = c * x - 14.95861;
  c = c * x + 0.434734;
  c = c * x + 0.2552457;
  c = c * x + 0.01241218;
  c = max(c * x - 1.646112e-4, vec3f(0.0));
  // The look's saturation, 1.18.
  let grey = dot(c, 0.18 * vec3f(0.2126, 0.7152, 0.0722));
  c = max(1.18 * c - grey, vec3f(0.0));
  // The result is already encoded with a gamma of 2.2.
  return clamp(TONE_OUT * c, vec3f(0.0), vec3f(1.0));
}

// ACES tone curve: reference rendering transform and output transform for sRGB, as fitted by Stephen Hill (2016).
fn tone_aces(linear: vec3f) -> vec3f {
  const INTO = mat3x3f(
    vec3f(0.59719, 0.07600, 0.02840), vec3f(0.35458, 0.90834, 0.13383), vec3f(0.04823, 0.01566, 0.83777));
  const OUT = mat3x3f(
    vec3f(1.60475, -0.10208, -0.00327), vec3f(-0.53108, 1.10813, -0.07276), vec3f(-0.07367, -0.00605, 1.07602));
  let v = INTO * linear;
  let fitted = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  return OUT * fitted;
}

// Tone curve of Reinhard et al. (2002), equation 3, applied to each channel.
fn tone_reinhard(linear: vec3f) -> vec3f {
  return linear / (1.0 + linear);
}

// Khronos PBR Neutral tone curve (2024): true colours below 0.8, compressed and desaturated highlights above.
fn tone_neutral(linear: vec3f) -> vec3f {
  const START = 0.8 - 0.04;
  const DESATURATION = 0.15;
  let low = min(linear.r, min(linear.g, linear.b));
  let offset = select(0.04, low - 6.25 * low * low, low < 0.08);
  let c = linear - offset;
  let peak = max(c.r, max(c.g, c.b));
  if peak < START {
    return c;
  }
  let d = 1.0 - START;
  let squeezed = 1.0 - d * d / (peak + d - START);
  let g = 1.0 - 1.0 / (DESATURATION * (peak - squeezed) + 1.0);
  return mix(c * (squeezed / peak), vec3f(squeezed), g);
}

// Linear light to sRGB code values, 0 to 1 (IEC 61966-2-1).
fn tone_srgb(linear: vec3f) -> vec3f {
  let c = clamp(linear, vec3f(0.0), vec3f(1.0));
  return select(1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055, 12.92 * c, c <= vec3f(0.0031308));
}

// Light below a limit above which every curve is white, so that squares stay finite.
fn tone_limited(exposed: vec3f) -> vec3f {
  return clamp(exposed, vec3f(0.0), vec3f(1e6));
}

// Exposed light to code values of the screen, 0 to 1. `curve` is the discriminant of `ToneMapping` in
// src/state/look/mod.rs.
fn tone_encoded(curve: u32, exposed: vec3f) -> vec3f {
  switch curve {
    case 0u: { return tone_film(exposed); }
    case 1u: { return tone_agx(exposed); }
    case 2u: { return tone_srgb(tone_aces(tone_limited(exposed))); }
    case 3u: { return tone_srgb(tone_reinhard(tone_limited(exposed))); }
    case 4u: { return tone_srgb(tone_neutral(tone_limited(exposed))); }
    default: { return tone_srgb(exposed); }
  }
}
