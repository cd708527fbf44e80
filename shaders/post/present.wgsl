// From linear light to the screen: smooth edges, exposure, tone curve, gamma, dither.

struct Present {
  size: vec2f,
  exposure_gain: f32,
  dither: f32,
}

// Whether edges are smoothed: a reference averages samples instead.
override PRESENT_SMOOTH: bool = true;

@group(0) @binding(0) var<uniform> present: Present;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var hdr_map: texture_2d<f32>;
@group(0) @binding(3) var hdr_sampler: sampler;

struct PresentVertex {
  @builtin(position) clip: vec4f,
  @location(0) uv: vec2f,
}

@vertex
fn vertex(@builtin(vertex_index) i: u32) -> PresentVertex {
  let at = vec2f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
  return PresentVertex(vec4f(at, 0.0, 1.0), vec2f(0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y));
}

// AgX by Troy Sobotka, in the polynomial form of Benjamin Wrensch, with a look that keeps the sea's blues.
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
  // The look: a little contrast and saturation.
  c = 1.09 * pow(max(c, vec3f(0.0)), vec3f(1.25));
  let grey = dot(c, vec3f(0.2126, 0.7152, 0.0722));
  c = max(grey + 1.30 * (c - grey), vec3f(0.0));
  // Already encoded with a gamma of 2.2.
  return clamp(OUT * c, vec3f(0.0), vec3f(1.0));
}

fn present_hash(p: vec2u) -> f32 {
  var h = p.x * 1664525u + p.y * 22695477u + 1013904223u;
  h = (h ^ (h >> 16u)) * 0x7feb352du;
  h = (h ^ (h >> 15u)) * 0x846ca68bu;
  return f32((h ^ (h >> 16u)) >> 8u) / 16777216.0;
}

// Exposed light squeezed below 1, so that a glint does not outshine the edge that it is averaged with.
fn present_squeeze(c: vec3f) -> vec3f {
  let exposed = c * (light.exposure * present.exposure_gain);
  return exposed / (1.0 + sky_luminance(exposed));
}

fn present_at(uv: vec2f) -> vec3f {
  return present_squeeze(textureSampleLevel(hdr_map, hdr_sampler, uv, 0.0).rgb);
}

fn present_corner(at: vec2i) -> f32 {
  let last = vec2i(present.size) - 1;
  return sky_luminance(present_squeeze(textureLoad(hdr_map, clamp(at, vec2i(0), last), 0).rgb));
}

// Edges smoothed along their direction, after FXAA by Timothy Lottes (2009): crests and the horizon have no other
// smoothing where there is one sample a pixel. Exposed light in and out.
fn present_smooth(hdr: vec3f, at: vec2i, uv: vec2f) -> vec3f {
  let middle = present_squeeze(hdr);
  let nw = present_corner(at + vec2i(-1, -1));
  let ne = present_corner(at + vec2i(1, -1));
  let sw = present_corner(at + vec2i(-1, 1));
  let se = present_corner(at + vec2i(1, 1));
  let here = sky_luminance(middle);
  let low = min(here, min(min(nw, ne), min(sw, se)));
  let high = max(here, max(max(nw, ne), max(sw, se)));
  var smoothed = middle;
  if high - low > max(0.03, 0.16 * high) {
    let across = vec2f(sw + se - nw - ne, nw + sw - ne - se);
    let reduce = max((nw + ne + sw + se) * 0.03, 0.008);
    let pixels = clamp(across / (min(abs(across.x), abs(across.y)) + reduce), vec2f(-6.0), vec2f(6.0));
    let along = pixels / present.size;
    let inner = 0.5 * (present_at(uv - along / 6.0) + present_at(uv + along / 6.0));
    let outer = 0.5 * inner + 0.25 * (present_at(uv - 0.5 * along) + present_at(uv + 0.5 * along));
    let l = sky_luminance(outer);
    smoothed = select(outer, inner, l < low || l > high);
  }
  return smoothed / max(1.0 - sky_luminance(smoothed), 1e-5);
}

@fragment
fn fragment(in: PresentVertex) -> @location(0) vec4f {
  let at = vec2u(clamp(in.uv * present.size, vec2f(0.0), present.size - 1.0));
  let hdr = textureLoad(hdr_map, at, 0);
  let bits = bitcast<vec4u>(hdr) & vec4u(0x7f800000u);
  if any(bits == vec4u(0x7f800000u)) || hdr.a < 0.99 {
    return vec4f(1.0, 0.0, 1.0, 1.0);
  }
  var exposed = hdr.rgb * (light.exposure * present.exposure_gain);
  if PRESENT_SMOOTH {
    exposed = present_smooth(hdr.rgb, vec2i(at), (vec2f(at) + 0.5) / present.size);
  }
  let encoded = present_agx(exposed);
  // Triangular noise of one step hides the banding of eight bits.
  let noise = present_hash(at) + present_hash(at + vec2u(7919u, 104729u)) - 1.0;
  return vec4f(encoded + noise * present.dither / 255.0, 1.0);
}
