// Foam of whitecaps: how much of it a pixel holds, and what it looks like.

// Noise layers: windrows of tens of metres, patches of metres, strands of decimetres, bubbles of centimetres.
const FOAM_WINDROW_LAYER = 0u;
const FOAM_PATCH_LAYER = 1u;
const FOAM_STRAND_LAYER = 2u;
const FOAM_BUBBLE_LAYER = 3u;
// Height of the lumps in the foam's relief, m.
const FOAM_LUMP_HEIGHT_M = 0.035;
// Height of the bubbles in the foam's relief, m.
const FOAM_BUBBLE_HEIGHT_M = 0.006;
// Standard deviation of the slope of the bubbles' relief.
const FOAM_BUBBLE_SLOPE_SIGMA = 0.2;
// Reflectance of thick fresh foam (Whitlock, Bartlett and Gurganus 1982; Koepke 1984).
const FOAM_ALBEDO = 0.72;
// Reflectance of foam aged to a film, relative to fresh foam: whitecaps average 0.22 over their life (Koepke 1984).
const FOAM_AGED_ALBEDO_RATIO = 0.42;
// Amount of foam, 0 to 1, below which none is drawn.
const FOAM_MIN_AMOUNT = 0.002;
// Sum of the resolved fractions of the variance of patches and strands, below which one sample of them is enough.
const FOAM_MIN_RESOLVED = 0.05;
// Fraction of a noise layer's variance below which the layer counts as even, at its mean of 0.5.
const FOAM_MIN_LAYER_VARIANCE = 0.02;
// Fraction of a pixel's light from foam, below which its relief is not seen.
const FOAM_MIN_RELIEF_COVER = 0.02;
// Length over which the finest noise changes, m. Longer pixels have two samples.
const FOAM_FINEST_DETAIL_M = 0.02;

// Appearance of the foam in a pixel.
struct FoamAppearance {
  // Fraction of the pixel's light that comes from foam: the covered area, less where foam is thin.
  cover: f32,
  // Height of the fine relief, around 0.5.
  grain: f32,
  // Slope of the foam's relief.
  relief: vec2f,
  // Variance of the slope of the foam's relief that the pixel does not resolve.
  rough: f32,
}

// Foam (x) and its current source (y) in a pixel, 0 to 1, from the finest levels that hold the pixel and are no finer
// than it; beyond all levels, their means.
fn foam_level(at: vec2f, pixel: WaterFootprint) -> vec2f {
  let whole_m = WATER_TAP_TEXEL_RATIO * sqrt(pixel.width_m * pixel.length_m);
  let half_axis = 0.5 * abs(pixel.axis);
  // Two samples if the pixel is longer than a cell of the finest level.
  let has_halves = pixel.length_m * frame.foam_levels[0].inverse_cell > 1.0;
  var foam = vec2f(0.0);
  var left = 1.0;
  for (var level = 0u; level < frame.foam_level_count && left > 0.0; level++) {
    let map = frame.foam_levels[level];
    let off = abs(at - map.centre) + half_axis;
    let inside = saturate(5.0 - 5.0 * max(off.x, off.y) * map.inverse_half_side);
    let coarse = saturate(2.0 - 0.5 * whole_m * map.inverse_cell);
    let share = left * inside * coarse;
    if share <= 0.0 {
      continue;
    }
    let uv = map.uv_below_eye + at * map.inverse_side;
    if has_halves {
      let half = (0.25 * map.inverse_side) * pixel.axis;
      let first = textureSampleLevel(foam_map, nearest_mip_sampler, uv - half, level, 0.0).xy;
      let last = textureSampleLevel(foam_map, nearest_mip_sampler, uv + half, level, 0.0).xy;
      foam += (0.5 * share) * (first + last);
    } else {
      foam += share * textureSampleLevel(foam_map, nearest_mip_sampler, uv, level, 0.0).xy;
    }
    left -= share;
  }
  foam += (left * frame.mean_foam) * vec2f(1.0, 0.1);
  return min(foam * frame.foam_amount, vec2f(1.0));
}

// Gradient of one channel of a noise layer, 1/m, over a step that the pixel resolves. `here` is the value at `at`.
fn foam_noise_gradient(layer: u32, channel: u32, at: vec2f, size: f32, lod: f32, here: f32) -> vec2f {
  let fine = max(lod, 0.0);
  let step = max(size, 0.5 * exp2(fine - material.noise_layers[layer].log_texels_per_m));
  let x = material_noise(layer, at + vec2f(step, 0.0), fine)[channel];
  let z = material_noise(layer, at + vec2f(0.0, step), fine)[channel];
  return vec2f(x - here, z - here) / step;
}

// Cumulative normal distribution (Bowling and others 2009, accurate to 2e-4).
fn foam_normal_cdf(x: f32) -> f32 {
  return 1.0 / (1.0 + exp(clamp(-x * (1.5976 + 0.07056 * x * x), -40.0, 40.0)));
}

// Inverse of the cumulative normal distribution (Abramowitz and Stegun 26.2.22, accurate to 3e-3).
fn foam_normal_quantile(share: f32) -> f32 {
  let t = sqrt(-2.0 * log(min(share, 1.0 - share)));
  return sign(share - 0.5) * (t - (2.30753 + 0.27061 * t) / (1.0 + t * (0.99229 + 0.04481 * t)));
}

// Appearance of foam in a pixel. `level` holds the amount of foam (x) and of its current source (y), 0 to 1.
fn foam_appearance(at: vec2f, pixel: WaterFootprint, level: vec2f) -> FoamAppearance {
  let whole_m = WATER_TAP_TEXEL_RATIO * sqrt(pixel.width_m * pixel.length_m);
  var has_halves = pixel.length_m > FOAM_FINEST_DETAIL_M;
  // Each sample covers its part of the pixel. Windrows are longer than most pixels and bubbles shorter: one is enough.
  let part_m = pixel.length_m * select(1.0, 0.5, has_halves);
  let size = WATER_TAP_TEXEL_RATIO * sqrt(part_m * max(pixel.width_m, part_m));
  let logs = log2(max(vec3f(WATER_TAP_TEXEL_RATIO * pixel.length_m, size, whole_m), vec3f(1e-6)));
  let densities = vec4f(
    material.noise_layers[FOAM_WINDROW_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_PATCH_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_STRAND_LAYER].log_texels_per_m,
    material.noise_layers[FOAM_BUBBLE_LAYER].log_texels_per_m);
  let lods = logs.xyyz + densities;
  let kept = material_variance_left(lods);
  // Where the pixel resolves neither patches nor strands, all samples are alike.
  let is_resolved = kept.y + kept.z >= FOAM_MIN_RESOLVED;
  has_halves = has_halves && is_resolved;
  var windrows = 0.5;
  if kept.x > FOAM_MIN_LAYER_VARIANCE {
    windrows = material_noise(FOAM_WINDROW_LAYER, at, lods.x).b;
  }
  var bubbles = 0.5;
  if kept.w > FOAM_MIN_LAYER_VARIANCE {
    bubbles = material_noise(FOAM_BUBBLE_LAYER, at, lods.w).g;
  }
  // Fresh foam is a closed mass of bubbles, old foam a net of thin strands.
  let fresh = maths_smooth(level.y * (1.0 / 0.45));
  // A sum of uniform variables is nearly normal. Its part that the pixel does not resolve softens the edge, so that the
  // mean over the noise is the amount of foam at every distance.
  let weight = mix(vec4f(0.7, 0.9, 1.1, 0.45), vec4f(0.4, 0.9, 0.8, 0.4), fresh);
  let total = dot(weight, weight);
  let resolved = dot(weight * weight, kept) / total;
  let weight_of_deviation = weight * (3.4642 * inverseSqrt(total));
  let soft = mix(0.2, 0.12, fresh);
  let wanted = clamp(level.x, 1e-4, 1.0 - 1e-4);
  let edge = sqrt(1.0 + soft * soft) * foam_normal_quantile(wanted);
  let sharp = inverseSqrt(soft * soft + 1.0 - resolved);
  // An old patch is a film that is thicker along its strands, less so if they are not resolved. Strands and grain are
  // higher where foam covers: both are relative to their means there, which are fitted to 400,000 draws.
  let bare = 1.0 - sqrt(wanted);
  let shown = 0.775 * kept.z + 0.225 * kept.y;
  let thickens = inverseSqrt(0.018 + 0.045 * (1.0 - shown));
  let thick = mix(0.55, 0.58 + 1.4 * bare, shown);
  let usual = mix(0.66 + 0.19 * bare * bare, 0.5 + 0.36 * bare, fresh);
  var out: FoamAppearance;
  var covered = 0.0;
  // Two samples lie in the two halves, and on both sides of the pixel's axis.
  let step = select(vec2f(0.0), 0.25 * pixel.axis + 0.31 * pixel.across, has_halves);
  var tap = at - step;
  for (var i = 0; i < select(1, 2, has_halves); i++) {
    var patches = 0.5;
    var strands = 0.5;
    if is_resolved {
      patches = material_noise(FOAM_PATCH_LAYER, tap, lods.y).r;
      strands = material_noise(FOAM_STRAND_LAYER, tap, lods.z).r;
    }
    tap += 2.0 * step;
    let z = dot(vec4f(windrows, patches, strands, bubbles) - 0.5, weight_of_deviation);
    let cut = foam_normal_cdf((z + edge) * sharp);
    let strand = 2.0 * foam_normal_cdf((0.65 * strands + 0.35 * patches - 0.65) * thickens) / thick;
    out.cover += saturate(cut * mix(FOAM_AGED_ALBEDO_RATIO * strand, 1.0, fresh));
    out.grain += 0.6 * strands + 0.4 * bubbles - usual;
    covered += cut;
  }
  let bubble_slope = FOAM_BUBBLE_SLOPE_SIGMA * material.foam_relief;
  out.rough = bubble_slope * bubble_slope * (1.0 - kept.w);
  let share = select(1.0, 0.5, has_halves);
  out.cover *= share;
  out.grain = 0.5 + kept.w * out.grain * share;
  let lumps_lod = logs.z + densities.z;
  let lumps_kept = material_strand_variance_left(lumps_lod);
  if material.foam_relief > 0.0 && lumps_kept > 0.05 && out.cover > FOAM_MIN_RELIEF_COVER {
    let strands = material_noise(FOAM_STRAND_LAYER, at, lumps_lod).r;
    var both = foam_noise_gradient(FOAM_STRAND_LAYER, 0u, at, whole_m, lumps_lod, strands);
    both *= lumps_kept * FOAM_LUMP_HEIGHT_M;
    if kept.w > FOAM_MIN_LAYER_VARIANCE {
      let fizz = foam_noise_gradient(FOAM_BUBBLE_LAYER, 1u, at, whole_m, lods.w, bubbles);
      both += fizz * (kept.w * FOAM_BUBBLE_HEIGHT_M);
    }
    let relief = both * (material.foam_relief * covered * share);
    out.relief = relief * min(1.0, 1.2 / max(length(relief), 1e-6));
  }
  return out;
}

// Radiance of foam towards `v`: a white diffuse body lit by sun and sky, with the gloss of its wet bubbles.
fn foam_radiance(v: vec3f, slope: WaterSlope, foam: FoamAppearance) -> vec3f {
  let n = water_normal(slope.mean + foam.relief);
  let l = frame.sun_direction;
  // Light spreads inside foam, which softens its shading. Unresolved slopes brighten the mean, because facets that are
  // turned away from the sun are not darker than black.
  let cosine = dot(n, l);
  let mean = 0.8 * cosine + 0.2 * l.y;
  let across = slope.variance.x * l.x * l.x + slope.variance.y * l.z * l.z + 2.0 * slope.variance.z * l.x * l.z;
  let deviation = 0.8 * n.y * sqrt(max(across + foam.rough * dot(l.xz, l.xz), 1e-6));
  let off = mean / deviation;
  let wrapped = max(mean * foam_normal_cdf(off) + deviation * 0.39894228 * exp(-0.5 * min(off * off, 80.0)), 0.0);
  // Hollows see less of the sky.
  let open = (0.55 + 0.45 * n.y) * (0.7 + 0.6 * foam.grain);
  let albedo = material.foam_colour * (FOAM_ALBEDO * (0.85 + 0.3 * foam.grain));
  let sunlight = cloud_sun_irradiance() * (wrapped * (0.8 + 0.4 * foam.grain));
  let body = (sunlight + light.sky_irradiance * open) * (albedo / ATM_PI);
  if l.y <= 0.0 || cosine <= 0.0 {
    return body;
  }
  // Isotropic GGX, with Smith's masking and shadowing as approximated by Hammon (2017).
  let alpha = max(material.foam_roughness * material.foam_roughness, 0.02);
  let h = normalize(v + l);
  let facing = dot(n, h);
  let a2 = alpha * alpha;
  let d = facing * facing * (a2 - 1.0) + 1.0;
  let seen = max(dot(n, v), 1e-3);
  let masked = 0.5 / mix(2.0 * cosine * seen, cosine + seen, alpha);
  let gloss = material.glitter_strength * water_fresnel(dot(v, h)) * a2 / (ATM_PI * d * d) * masked * cosine;
  return body + cloud_sun_irradiance() * min(gloss, 50.0);
}
