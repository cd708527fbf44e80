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
  let size = foot.size * pow(f32(foot.taps), 0.85);
  let windrows = material_noise(FOAM_WINDROWS, at, size);
  let patches = material_noise(FOAM_PATCHES, at, size);
  let strands = material_noise(FOAM_STRANDS, at, size);
  let bubbles = material_noise(FOAM_BUBBLES, at, size);
  // Fresh foam is a closed mass of bubbles, old foam a net of thin strands.
  let fresh = smoothstep(0.0, 0.45, foam.y);
  // A sum of uniform variables is nearly normal; what of it the pixel cannot resolve softens the edge, so that the mean
  // over the noise is what is wanted at every distance. The normal distribution is taken as logistic.
  let weight = mix(vec4f(0.7, 0.9, 1.1, 0.45), vec4f(0.4, 0.9, 0.8, 0.4), fresh);
  let kept = vec4f(windrows.kept, patches.kept, strands.kept, bubbles.kept);
  let whole = dot(weight, weight);
  let resolved = dot(weight * weight, kept) / whole;
  let noise = vec4f(windrows.value.b, patches.value.r, strands.value.r, bubbles.value.g);
  let z = dot(noise - 0.5, weight) / (0.2887 * sqrt(whole));
  let soft = mix(0.34, 0.20, fresh);
  let wanted = clamp(foam.x, 1e-4, 1.0 - 1e-4);
  let edge = 1.702 * z + sqrt(1.0 + soft * soft) * log(wanted / (1.0 - wanted));
  let cut = 1.0 / (1.0 + exp(clamp(-edge / sqrt(soft * soft + 1.0 - resolved), -40.0, 40.0)));
  // An old patch is a film that thickens along its strands; over a patch it keeps its mean.
  let strand = 2.0 * smoothstep(0.35, 0.95, 0.65 * strands.value.r + 0.35 * patches.value.r);
  let white = mix(FOAM_AGED * mix(1.0, strand, strands.kept), 1.0, fresh);
  out.cover = clamp(cut * white, 0.0, 1.0);
  out.grain = mix(0.5, 0.6 * strands.value.r + 0.4 * bubbles.value.g, kept.w);
  if material.foam_relief > 0.0 && kept.z > 0.05 && out.cover > 0.002 {
    let lumps = water_foam_slope(FOAM_STRANDS, 0u, at, size, strands.value.r) * (kept.z * FOAM_LUMPS_M);
    let fizz = water_foam_slope(FOAM_BUBBLES, 1u, at, size, bubbles.value.g) * (kept.w * FOAM_BUBBLES_M);
    let relief = (lumps + fizz) * (material.foam_relief * cut);
    out.relief = relief * min(1.0, 1.2 / max(length(relief), 1e-6));
  }
  return out;
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
