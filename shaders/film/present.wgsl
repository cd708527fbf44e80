// Shows linear light on the screen: smoothed edges, bloom, exposure, tone curve, gamma, dither.

// Whether edges are smoothed. A reference picture averages samples instead.
override PRESENT_SMOOTH: bool = true;

@group(0) @binding(0) var<uniform> present: Present;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var hdr_map: texture_2d<f32>;
@group(0) @binding(3) var hdr_sampler: sampler;
@group(0) @binding(4) var bloom_map: texture_2d<f32>;

// AgX tone curve by Troy Sobotka in the polynomial form of Benjamin Wrensch, with a look that keeps the sea's blues.
fn present_agx(linear: vec3f) -> vec3f {
  const INTO = mat3x3f(
    vec3f(0.842479062253094, 0.0423282422610123, 0.0423756549057051),
    vec3f(0.0784335999999992, 0.878468636469772, 0.0784336),
    vec3f(0.0792237451477643, 0.0791661274605434, 0.879142973793104));
  const OUT = mat3x3f(
    vec3f(1.19687900512017, -0.0528968517574562, -0.0529716355144438),
    vec3f(-0.0980208811401368, 1.15190312990417, -0.0980434501171241),
    vec3f(-0.0990297440797205, -0.0989611768448433, 1.15107367264116));
  const LOW = -12.47393;
  const HIGH = 4.026069;
  let log_light = clamp((log2(max(INTO * linear, vec3f(1e-10))) - LOW) / (HIGH - LOW), vec3f(0.0), vec3f(1.0));
  let x = log_light;
  let x2 = x * x;
  let x4 = x2 * x2;
  var c = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
  // The look adds a little contrast and saturation.
  c = 1.09 * pow(max(c, vec3f(0.0)), vec3f(1.25));
  let grey = dot(c, vec3f(0.2126, 0.7152, 0.0722));
  c = max(grey + 1.18 * (c - grey), vec3f(0.0));
  // The result is already encoded with a gamma of 2.2.
  return clamp(OUT * c, vec3f(0.0), vec3f(1.0));
}

// ACES tone curve: reference rendering transform and output transform for sRGB, as fitted by Stephen Hill (2016).
fn present_aces(linear: vec3f) -> vec3f {
  const INTO = mat3x3f(
    vec3f(0.59719, 0.07600, 0.02840), vec3f(0.35458, 0.90834, 0.13383), vec3f(0.04823, 0.01566, 0.83777));
  const OUT = mat3x3f(
    vec3f(1.60475, -0.10208, -0.00327), vec3f(-0.53108, 1.10813, -0.07276), vec3f(-0.07367, -0.00605, 1.07602));
  let v = INTO * linear;
  let fitted = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  return OUT * fitted;
}

// Tone curve of Reinhard et al. (2002), equation 3, applied to each channel.
fn present_reinhard(linear: vec3f) -> vec3f {
  return linear / (1.0 + linear);
}

// Khronos PBR Neutral tone curve (2024): true colours below 0.8, compressed and desaturated highlights above.
fn present_neutral(linear: vec3f) -> vec3f {
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
fn present_srgb(linear: vec3f) -> vec3f {
  let c = clamp(linear, vec3f(0.0), vec3f(1.0));
  return select(1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055, 12.92 * c, c <= vec3f(0.0031308));
}

// Exposed light to code values of the screen, 0 to 1. `tone` is the discriminant of `ToneMapping` in
// src/state/look/mod.rs.
fn present_tone(tone: u32, exposed: vec3f) -> vec3f {
  // Above this limit every curve is white; the limit keeps squares finite.
  let c = clamp(exposed, vec3f(0.0), vec3f(1e6));
  switch tone {
    case 0u: { return present_agx(c); }
    case 1u: { return present_srgb(present_aces(c)); }
    case 2u: { return present_srgb(present_reinhard(c)); }
    case 3u: { return present_srgb(present_neutral(c)); }
    default: { return present_srgb(c); }
  }
}

fn present_random(p: vec2u) -> f32 {
  var h = p.x * 1664525u + p.y * 22695477u + 1013904223u;
  h = (h ^ (h >> 16u)) * 0x7feb352du;
  h = (h ^ (h >> 15u)) * 0x846ca68bu;
  return f32((h ^ (h >> 16u)) >> 8u) / 16777216.0;
}

fn present_exposure() -> f32 {
  return present.exposure_gain * select(light.exposure, present.fixed_exposure, present.fixed_exposure > 0.0);
}

// Exposed light, compressed below 1 so that a glint does not outshine an edge that it is averaged with.
fn present_compress(c: vec3f) -> vec3f {
  let exposed = c * present_exposure();
  return exposed / (1.0 + sky_luminance(exposed));
}

fn present_compressed_sample(uv: vec2f) -> vec3f {
  return present_compress(textureSampleLevel(hdr_map, hdr_sampler, uv, 0.0).rgb);
}

// Luminance of a pixel's compressed light, and nearness of the pixel (alpha, see frame_hdr_output).
fn present_luminance_and_nearness(at: vec2i) -> vec2f {
  let last = vec2i(present.size) - 1;
  let corner = textureLoad(hdr_map, clamp(at, vec2i(0), last), 0);
  return vec2f(sky_luminance(present_compress(corner.rgb)), corner.a);
}

// Smallest step in distance that counts as an edge, m; less is one surface, whatever its slope.
const PRESENT_MIN_EDGE_M = 1.5;

// Exposed light of a pixel, with edges smoothed along their direction after FXAA by Timothy Lottes (2009). Crests and
// the horizon need it, at one sample per pixel. Foam and glitter lie on one surface and are filtered already.
fn present_edges_smoothed(hdr: vec4f, at: vec2i, uv: vec2f) -> vec3f {
  let middle = present_compress(hdr.rgb);
  let nw = present_luminance_and_nearness(at + vec2i(-1, -1));
  let ne = present_luminance_and_nearness(at + vec2i(1, -1));
  let sw = present_luminance_and_nearness(at + vec2i(-1, 1));
  let se = present_luminance_and_nearness(at + vec2i(1, 1));
  let here = sky_luminance(middle);
  let low = min(here, min(min(nw.x, ne.x), min(sw.x, se.x)));
  let high = max(here, max(max(nw.x, ne.x), max(sw.x, se.x)));
  let bend = max(abs(nw.y + se.y - 2.0 * hdr.a), abs(ne.y + sw.y - 2.0 * hdr.a));
  var smoothed = middle;
  // Change of the nearness 1e4 / distance (frame.wgsl) over a step of PRESENT_MIN_EDGE_M.
  let edge = 1e-4 * PRESENT_MIN_EDGE_M * (hdr.a - 1.0) * (hdr.a - 1.0);
  if bend >= edge && high - low > max(0.03, 0.16 * high) {
    let across = vec2f(sw.x + se.x - nw.x - ne.x, nw.x + sw.x - ne.x - se.x);
    let reduce = max((nw.x + ne.x + sw.x + se.x) * 0.03, 0.008);
    let pixels = clamp(across / (min(abs(across.x), abs(across.y)) + reduce), vec2f(-6.0), vec2f(6.0));
    let along = pixels / present.size;
    let inner = 0.5 * (present_compressed_sample(uv - along / 6.0) + present_compressed_sample(uv + along / 6.0));
    let ends = present_compressed_sample(uv - 0.5 * along) + present_compressed_sample(uv + 0.5 * along);
    let outer = 0.5 * inner + 0.25 * ends;
    let l = sky_luminance(outer);
    smoothed = select(outer, inner, l < low || l > high);
  }
  return smoothed / max(1.0 - sky_luminance(smoothed), 1e-5);
}

// Exposed light interpolated between the picture's pixels, for a screen that has more or fewer pixels.
fn present_interpolated(uv: vec2f) -> vec3f {
  let p = uv * present.size - 0.5;
  let base = floor(p);
  let f = p - base;
  let last = vec2i(present.size) - 1;
  var sum = vec3f(0.0);
  for (var k = 0; k < 4; k++) {
    let corner = vec2i(k & 1, k >> 1u);
    let weight = select(1.0 - f.x, f.x, corner.x == 1) * select(1.0 - f.y, f.y, corner.y == 1);
    let light = textureLoad(hdr_map, clamp(vec2i(base) + corner, vec2i(0), last), 0).rgb;
    sum += weight * present_compress(light);
  }
  return sum / max(1.0 - sky_luminance(sum), 1e-5);
}

@fragment
fn fragment(in: ScreenVertex) -> @location(0) vec4f {
  // Number of pixels of the picture per pixel of the screen, along x.
  let ratio = abs(dpdx(in.uv.x)) * present.size.x;
  let at = vec2u(clamp(in.uv * present.size, vec2f(0.0), present.size - 1.0));
  let hdr = textureLoad(hdr_map, at, 0);
  let bits = bitcast<vec4u>(hdr) & vec4u(0x7f800000u);
  if any(bits == vec4u(0x7f800000u)) || hdr.a < 0.99 {
    return vec4f(1.0, 0.0, 1.0, 1.0);
  }
  let uv = (vec2f(at) + 0.5) / present.size;
  var exposed = hdr.rgb * present_exposure();
  if abs(ratio - 1.0) > 1e-3 {
    exposed = present_interpolated(in.uv);
  } else if PRESENT_SMOOTH {
    exposed = present_edges_smoothed(hdr, vec2i(at), uv);
  }
  if present.bloom_fraction > 0.0 {
    let bloom = textureSampleLevel(bloom_map, hdr_sampler, uv, 0.0).rgb * present_exposure();
    exposed = mix(exposed, bloom, present.bloom_fraction);
  }
  let encoded = present_tone(present.tone_curve, exposed);
  // Triangular noise of one code value hides the bands of eight-bit colours.
  let noise = present_random(at) + present_random(at + vec2u(7919u, 104729u)) - 1.0;
  return vec4f(encoded + noise * present.dither / 255.0, 1.0);
}
