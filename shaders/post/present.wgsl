// From linear light to the screen: exposure, tone curve, gamma, dither.

struct Present {
  size: vec2f,
  exposure_gain: f32,
  dither: f32,
}

@group(0) @binding(0) var<uniform> present: Present;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var hdr_map: texture_2d<f32>;

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
  c = 1.06 * pow(max(c, vec3f(0.0)), vec3f(1.25));
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

@fragment
fn fragment(in: PresentVertex) -> @location(0) vec4f {
  let at = vec2u(clamp(in.uv * present.size, vec2f(0.0), present.size - 1.0));
  let hdr = textureLoad(hdr_map, at, 0);
  let bits = bitcast<vec4u>(hdr) & vec4u(0x7f800000u);
  if any(bits == vec4u(0x7f800000u)) || hdr.a < 0.99 {
    return vec4f(1.0, 0.0, 1.0, 1.0);
  }
  let encoded = present_agx(hdr.rgb * (light.exposure * present.exposure_gain));
  // Triangular noise of one step hides the banding of eight bits.
  let noise = present_hash(at) + present_hash(at + vec2u(7919u, 104729u)) - 1.0;
  return vec4f(encoded + noise * present.dither / 255.0, 1.0);
}
