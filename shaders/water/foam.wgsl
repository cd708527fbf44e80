// Whitecaps: how much foam a pixel holds and what it looks like.

// Layers of noise: windrows of tens of metres, patches of metres, strands of decimetres, bubbles of centimetres.
const FOAM_WINDROWS = 0u;
const FOAM_PATCHES = 1u;
const FOAM_STRANDS = 2u;
const FOAM_BUBBLES = 3u;
// Height of the relief of foam, m: of its lumps and of its bubbles.
const FOAM_LUMPS_M = 0.035;
const FOAM_BUBBLES_M = 0.006;
// Standard deviation of the slope of its bubbles.
const FOAM_BUBBLES_SLOPE = 0.2;
// Reflectance of thick fresh foam (Whitlock, Bartlett and Gurganus 1982; Koepke 1984).
const FOAM_ALBEDO = 0.72;
// Share of its white that is left when a patch has aged to a film: whitecaps reflect 0.22 over their life (Koepke 1984).
const FOAM_AGED = 0.42;
// Foam below this level is not seen.
const FOAM_LEAST = 0.002;
// Most taps along a pixel of the level of foam, and of the noise.
const FOAM_LEVEL_TAPS = 3;
const FOAM_TAPS = 4;
// Length in which the finest of the noise changes, m.
const FOAM_FINEST_M = 0.02;

// A pixel on the undisplaced sea, for foam.
struct FoamPixel {
  // The longer and the shorter side, and their lengths, m.
  along: vec2f,
  across: vec2f,
  large: f32,
  small: f32,
}

// What foam looks like in a pixel.
struct WaterFoam {
  // Share of the pixel's light that comes from foam: its area, less where it is thin.
  cover: f32,
  // Height of the fine relief, around 0.5.
  grain: f32,
  // Slope of its own relief, and the variance of the slope that the pixel does not resolve.
  relief: vec2f,
  rough: f32,
}

fn foam_pixel(dx: vec2f, dy: vec2f) -> FoamPixel {
  let swap = dot(dx, dx) > dot(dy, dy);
  let along = select(dy, dx, swap);
  let large = length(along);
  let small = max(abs(dx.x * dy.y - dx.y * dy.x) / max(large, 1e-9), 1e-6);
  return FoamPixel(along, select(dx, dy, swap), large, small);
}

// Foam and fresh breaking from the finest level that is valid at a point and no finer than the pixel; the mean beyond.
fn foam_at(at: vec2f, footprint: f32) -> vec2f {
  var foam = vec2f(0.0);
  var left = 1.0;
  for (var level = 0u; level < frame.foam_count && left > 0.0; level++) {
    let map = frame.foam_levels[level];
    let off = abs(at - map.centre);
    let inside = 1.0 - smoothstep(0.8, 1.0, max(off.x, off.y) / map.half_side_m);
    let coarse = clamp(2.0 - 0.5 * footprint * map.inverse_cell, 0.0, 1.0);
    let share = inside * coarse;
    let uv = map.uv + at * map.inverse_side;
    foam += (left * share) * textureSampleLevel(foam_map, level_sampler, uv, level, 0.0).xy;
    left *= 1.0 - share;
  }
  return foam + (left * frame.mean_foam) * vec2f(1.0, 0.1);
}

// Foam and fresh breaking in a pixel, 0 to 1.
fn foam_level(at: vec2f, pixel: FoamPixel) -> vec2f {
  let whole_m = WATER_TAP * sqrt(pixel.small * pixel.large);
  // As many taps as there are cells of the finest level along the pixel.
  let taps = clamp(i32(ceil(pixel.large * frame.foam_levels[0].inverse_cell)), 1, FOAM_LEVEL_TAPS);
  var level = vec2f(0.0);
  for (var i = 0; i < taps; i++) {
    level += foam_at(at + pixel.along * ((f32(i) + 0.5) / f32(taps) - 0.5), whole_m);
  }
  return clamp(level * (frame.foam_gain / f32(taps)), vec2f(0.0), vec2f(1.0));
}

// Slope of a channel of a layer, per metre, over a step that the pixel resolves. `here` is the channel's value.
fn foam_slope(layer: u32, channel: u32, at: vec2f, size: f32, lod: f32, here: f32) -> vec2f {
  let fine = max(lod, 0.0);
  let step = max(size, 0.5 * exp2(fine) / exp2(material_lod(layer, 1.0)));
  let x = material_noise(layer, at + vec2f(step, 0.0), fine)[channel];
  let z = material_noise(layer, at + vec2f(0.0, step), fine)[channel];
  return vec2f(x - here, z - here) / step;
}

// The normal distribution (Bowling and others 2009, to 2e-4).
fn foam_share(x: f32) -> f32 {
  return 1.0 / (1.0 + exp(clamp(-x * (1.5976 + 0.07056 * x * x), -40.0, 40.0)));
}

// Its inverse (Abramowitz and Stegun 26.2.22, to 3e-3).
fn foam_quantile(share: f32) -> f32 {
  let t = sqrt(-2.0 * log(min(share, 1.0 - share)));
  return sign(share - 0.5) * (t - (2.30753 + 0.27061 * t) / (1.0 + t * (0.99229 + 0.04481 * t)));
}

// What a level of foam and fresh breaking looks like in a pixel.
fn foam_seen(at: vec2f, pixel: FoamPixel, level: vec2f) -> WaterFoam {
  let whole_m = WATER_TAP * sqrt(pixel.small * pixel.large);
  let taps = clamp(i32(ceil(pixel.large / FOAM_FINEST_M)), 1, FOAM_TAPS);
  let share = 1.0 / f32(taps);
  // A tap stands for its part of the pixel. Windrows are longer than most pixels and bubbles shorter: one tap is enough.
  let size = WATER_TAP * max(sqrt(pixel.small * pixel.large * share), pixel.large * share);
  let lods = vec4f(material_lod(FOAM_WINDROWS, WATER_TAP * pixel.large), material_lod(FOAM_PATCHES, size),
    material_lod(FOAM_STRANDS, size), material_lod(FOAM_BUBBLES, whole_m));
  let kept = vec4f(material_kept(FOAM_WINDROWS, lods.x), material_kept(FOAM_PATCHES, lods.y),
    material_kept(FOAM_STRANDS, lods.z), material_kept(FOAM_BUBBLES, lods.w));
  let windrows = material_noise(FOAM_WINDROWS, at, lods.x).b;
  let bubbles = material_noise(FOAM_BUBBLES, at, lods.w).g;
  // Fresh foam is a closed mass of bubbles, old foam a net of thin strands.
  let fresh = smoothstep(0.0, 0.45, level.y);
  // A sum of uniform variables is nearly normal. The part of it that the pixel does not resolve softens the edge, so that
  // the mean over the noise is the level at every distance.
  let weight = mix(vec4f(0.7, 0.9, 1.1, 0.45), vec4f(0.4, 0.9, 0.8, 0.4), fresh);
  let total = dot(weight, weight);
  let resolved = dot(weight * weight, kept) / total;
  let soft = mix(0.2, 0.12, fresh);
  let wanted = clamp(level.x, 1e-4, 1.0 - 1e-4);
  let edge = sqrt(1.0 + soft * soft) * foam_quantile(wanted);
  let sharp = inverseSqrt(soft * soft + 1.0 - resolved);
  // An old patch is a film that thickens along its strands, the less steeply the less of them is resolved. Strands and grain
  // are higher where foam covers than elsewhere: both count relative to their means there, fitted to 400,000 draws.
  let bare = 1.0 - sqrt(wanted);
  let shown = 0.775 * kept.z + 0.225 * kept.y;
  let thickens = inverseSqrt(0.018 + 0.045 * (1.0 - shown));
  let thick = mix(0.55, 0.58 + 1.4 * bare, shown);
  let usual = mix(0.66 + 0.19 * bare * bare, 0.5 + 0.36 * bare, fresh);
  var out: WaterFoam;
  var covered = 0.0;
  for (var i = 0; i < taps; i++) {
    // Even along the pixel, and by the golden ratio across it.
    let k = f32(i) - 0.5 * f32(taps - 1);
    let tap = at + pixel.along * (k * share) + pixel.across * (fract(0.5 + 0.618034 * k) - 0.5);
    let patches = material_noise(FOAM_PATCHES, tap, lods.y).r;
    let strands = material_noise(FOAM_STRANDS, tap, lods.z).r;
    let z = dot(vec4f(windrows, patches, strands, bubbles) - 0.5, weight) / (0.2887 * sqrt(total));
    let cut = foam_share((z + edge) * sharp);
    let strand = 2.0 * foam_share((0.65 * strands + 0.35 * patches - 0.65) * thickens) / thick;
    out.cover += clamp(cut * mix(FOAM_AGED * strand, 1.0, fresh), 0.0, 1.0);
    out.grain += 0.6 * strands + 0.4 * bubbles - usual;
    covered += cut;
  }
  out.rough = FOAM_BUBBLES_SLOPE * FOAM_BUBBLES_SLOPE * material.foam_relief * material.foam_relief * (1.0 - kept.w);
  out.cover *= share;
  out.grain = 0.5 + kept.w * out.grain * share;
  let lumps_lod = material_lod(FOAM_STRANDS, whole_m);
  let lumps_kept = material_kept(FOAM_STRANDS, lumps_lod);
  if material.foam_relief > 0.0 && lumps_kept > 0.05 && out.cover > 0.002 {
    let strands = material_noise(FOAM_STRANDS, at, lumps_lod).r;
    let lumps = foam_slope(FOAM_STRANDS, 0u, at, whole_m, lumps_lod, strands) * (lumps_kept * FOAM_LUMPS_M);
    let fizz = foam_slope(FOAM_BUBBLES, 1u, at, whole_m, lods.w, bubbles) * (kept.w * FOAM_BUBBLES_M);
    let relief = (lumps + fizz) * (material.foam_relief * covered * share);
    out.relief = relief * min(1.0, 1.2 / max(length(relief), 1e-6));
  }
  return out;
}

// Radiance of foam: a white body, lit by sun and sky, with the gloss of its wet bubbles.
fn foam_light(v: vec3f, slope: WaterSlope, foam: WaterFoam) -> vec3f {
  let n = water_normal(slope.mean + foam.relief);
  let l = frame.sun;
  // Light spreads inside the foam: the shade at its edge is soft. The mean brightness over the slopes that the pixel does not
  // resolve is more than the brightness of their mean, because what faces away is not darker than dark.
  let cosine = dot(n, l);
  let mean = 0.8 * cosine + 0.2 * l.y;
  let across = slope.variance.x * l.x * l.x + slope.variance.y * l.z * l.z + 2.0 * slope.variance.z * l.x * l.z;
  let deviation = 0.8 * n.y * sqrt(max(across + foam.rough * dot(l.xz, l.xz), 1e-6));
  let off = mean / deviation;
  let wrapped = max(mean * foam_share(off) + deviation * 0.39894228 * exp(-0.5 * min(off * off, 80.0)), 0.0);
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
