// Whitecaps: how much foam a pixel holds and what it looks like.

// Layers of noise: windrows of tens of metres, patches of metres, strands of decimetres, bubbles of centimetres.
const FOAM_WINDROWS = 0u;
const FOAM_PATCHES = 1u;
const FOAM_STRANDS = 2u;
const FOAM_BUBBLES = 3u;
// Height of foam's relief, m: of its lumps and of its bubbles.
const FOAM_LUMPS_M = 0.035;
const FOAM_BUBBLES_M = 0.006;
// Reflectance of thick fresh foam (Whitlock, Bartlett and Gurganus 1982; Koepke 1984).
const FOAM_ALBEDO = 0.72;
// Share of its white that is left when a patch has aged to a film: whitecaps reflect 0.22 over their life (Koepke 1984).
const FOAM_AGED = 0.42;

struct WaterFoam {
  // Share of the pixel's light that comes from foam: its area, less where it is thin.
  cover: f32,
  // Bubbles under the surface, 0..1.
  plume: f32,
  // Height of the fine relief, 0..1.
  grain: f32,
  // Slope of its own relief.
  relief: vec2f,
}

// Foam and fresh breaking from the finest level that is valid here and no finer than the pixel; the mean beyond.
fn water_foam_level(at: vec2f, footprint: f32) -> vec2f {
  var foam = vec2f(frame.mean_foam, 0.1 * frame.mean_foam);
  for (var i = frame.foam_count; i > 0u; i--) {
    let level = i - 1u;
    let place = frame.foam_place[level];
    let off = abs(at - place.xy);
    let inside = 1.0 - smoothstep(0.8, 1.0, max(off.x, off.y) / place.z);
    let coarse = clamp(2.0 - 0.5 * footprint * place.w, 0.0, 1.0);
    let share = inside * coarse;
    if share > 0.0 {
      let uv = frame.foam_uv[level];
      foam = mix(foam, textureSampleLevel(foam_map, wave_sampler, uv.xy + at * uv.z, level, 0.0).xy, share);
    }
  }
  return foam;
}

// Slope of a channel of a layer, per metre, over a step that the pixel resolves.
fn water_foam_slope(layer: u32, channel: u32, at: vec2f, size: f32, here: f32) -> vec2f {
  let lod = max(material_lod(layer, size), 0.0);
  let step = max(size, 0.5 * exp2(lod) / exp2(material_lod(layer, 1.0)));
  let x = textureSampleLevel(noise_map, noise_sampler, material_uv(layer, at + vec2f(step, 0.0)), lod)[channel];
  let z = textureSampleLevel(noise_map, noise_sampler, material_uv(layer, at + vec2f(0.0, step)), lod)[channel];
  return vec2f(x - here, z - here) / step;
}

fn water_foam(at: vec2f, foot: WaterFootprint) -> WaterFoam {
  let foam = clamp(water_foam_level(at, foot.size) * frame.foam_gain, vec2f(0.0), vec2f(1.0));
  var out: WaterFoam;
  out.plume = foam.x;
  out.grain = 0.5;
  if foam.x < 0.002 {
    return out;
  }
  let size = foot.size * pow(f32(foot.taps), 0.6);
  let windrows = material_noise(FOAM_WINDROWS, at, size);
  let patches = material_noise(FOAM_PATCHES, at, size);
  let strands = material_noise(FOAM_STRANDS, at, size);
  let bubbles = material_noise(FOAM_BUBBLES, at, size);
  // Fresh foam is a closed mass of bubbles, old foam a net of thin strands.
  let fresh = smoothstep(0.0, 0.45, foam.y);
  // Only what the pixel can resolve counts; a sum of uniform variables is nearly normal.
  let near = vec4f(windrows.near, patches.near, strands.near, bubbles.near);
  let weight = near * mix(vec4f(0.7, 0.9, 1.1, 0.45), vec4f(0.4, 0.9, 0.8, 0.4), fresh);
  let sigma = 0.2887 * sqrt(max(dot(weight, weight), 1e-6));
  let noise = vec4f(windrows.value.b, patches.value.r, strands.value.r, bubbles.value.g);
  let z = dot(noise - 0.5, weight) / sigma;
  let level = 1.0 / (1.0 + exp(-1.702 * z));
  let wanted = foam.x;
  // A soft edge of constant width in the noise; the mean over the noise stays what is wanted.
  let soft = mix(0.2, 0.12, fresh);
  let cut = smoothstep(1.0 - wanted - soft, 1.0 - wanted + soft, level);
  let kept = min(wanted / max(water_soft_mean(wanted, soft), 1e-3), 1.0);
  let seen = smoothstep(0.0, 0.25, sigma);
  // An old patch is a film that thickens along its strands; over a patch it keeps its mean.
  let strand = 2.0 * strands.near * smoothstep(0.35, 0.95, 0.65 * strands.value.r + 0.35 * patches.value.r);
  let white = mix(FOAM_AGED * mix(1.0, strand, strands.near), 1.0, fresh);
  out.cover = clamp(mix(wanted, cut * kept, seen) * white, 0.0, 1.0);
  out.grain = mix(0.5, 0.6 * strands.value.r + 0.4 * bubbles.value.g, near.w);
  if material.foam_relief > 0.0 && near.z > 0.0 && out.cover > 0.0 {
    let lumps = water_foam_slope(FOAM_STRANDS, 0u, at, size, strands.value.r) * (near.z * FOAM_LUMPS_M);
    let fizz = water_foam_slope(FOAM_BUBBLES, 1u, at, size, bubbles.value.g) * (near.w * FOAM_BUBBLES_M);
    let relief = (lumps + fizz) * (material.foam_relief * cut);
    out.relief = relief * min(1.0, 1.2 / max(length(relief), 1e-6));
  }
  return out;
}

// Mean of smoothstep(1 - c - e, 1 - c + e, x) over x in 0..1.
fn water_soft_mean(c: f32, e: f32) -> f32 {
  // The integral of smoothstep from its start over t in 0..1 is t^3 - t^4 / 2.
  let a = clamp((c + e) / (2.0 * e), 0.0, 1.0);
  let b = clamp((c - 1.0 + e) / (2.0 * e), 0.0, 1.0);
  let ramp = a * a * a * (1.0 - 0.5 * a) - b * b * b * (1.0 - 0.5 * b);
  return 2.0 * e * ramp + max(c - e, 0.0) - max(c - 1.0 - e, 0.0);
}

// Radiance of foam: a white body, lit by sun and sky, with the gloss of its wet bubbles.
fn water_foam_light(v: vec3f, slope: vec2f, foam: WaterFoam) -> vec3f {
  let n = water_normal(slope + foam.relief);
  let l = frame.sun;
  // Light spreads inside the foam: the shade at its edge is soft.
  let cosine = dot(n, l);
  let wrapped = max(0.8 * cosine + 0.2 * l.y, 0.0);
  // Hollows see less of the sky.
  let open = (0.55 + 0.45 * n.y) * (0.7 + 0.6 * foam.grain);
  let albedo = material.foam_colour * (FOAM_ALBEDO * (0.85 + 0.3 * foam.grain));
  let body = (light.sun * (wrapped * (0.8 + 0.4 * foam.grain)) + light.sky * open) * (albedo / ATM_PI);
  if l.y <= 0.0 || cosine <= 0.0 {
    return body;
  }
  // Isotropic GGX; Smith's masking for both in Hammon's form of 2017.
  let alpha = max(material.foam_roughness * material.foam_roughness, 0.02);
  let h = normalize(v + l);
  let facing = dot(n, h);
  let a2 = alpha * alpha;
  let d = facing * facing * (a2 - 1.0) + 1.0;
  let seen = max(dot(n, v), 1e-3);
  let masked = 0.5 / mix(2.0 * cosine * seen, cosine + seen, alpha);
  let gloss = material.specular_scale * water_fresnel(dot(v, h)) * a2 / (ATM_PI * d * d) * masked * cosine;
  return body + light.sun * min(gloss, 50.0);
}
