// The light of the water in the lean tier, for GPUs that are too slow for the full one (water.wgsl): the same physics
// with one sample of each map, one copy of each patch, and three nodes instead of a fine quadrature over the slopes.

// Distance between two nodes, in deviations of the visible tilts. Three equal parts of a Gaussian are 1.09 apart.
const LEAN_NODE_STEP = 1.04;
// Deviation of the rays mirrored by a node's slopes, divided by the deviation of the visible tilts.
const LEAN_NODE_SPREAD = 0.62;
// Square of the distance from the mean slope, in standard deviations, beyond which the lean tier draws no glitter.
const LEAN_NO_GLITTER_SQUARE = 25.0;
// Optical depth of the air and fog before the water, from which they are drawn.
const LEAN_LEAST_OPTICAL_DEPTH = 0.0075;
// Largest ratio of the facets in shadow to those that are lit.
const LEAN_MOST_SHADOW = 5.0;
// Amount of foam, 0 to 1, below which the lean tier draws none.
const LEAN_MIN_FOAM = 0.02;
// Part of the light of old foam that comes from its film.
const LEAN_FILM = 0.45;
// Softness of the edge of foam, deviations of its pattern.
const LEAN_SOFTNESS = 0.5;
// Distance over which the slope of a front's billows is measured, m; their height for one unit of the noise, m; and how
// much hollows and lumps differ in light.
const LEAN_RELIEF_STEP_M = 0.5;
const LEAN_BILLOW_M = 0.85;
const LEAN_GRAIN = 1.3;
// Opacity of the oldest foam, film and body together, and what youth adds.
const LEAN_OLD_FOAM_OPACITY = vec2f(0.2, 0.36);

// Radiance of the sky in the direction to the eye, mirrored by a facet of the slope `slope`.
fn lean_mirrored_sky(v: vec3f, slope: vec2f, layer: f32) -> vec3f {
  return water_mirrored_sky(v, slope, v.y - dot(v.xz, slope), 1.0 + dot(slope, slope), layer);
}

// Fresnel reflectance of facets of the slope `slope`, which varies across the viewing direction.
fn lean_reflectance(v: vec3f, slope: vec2f, side_variance: f32) -> f32 {
  let factor = material.fresnel_slope_factor;
  let steepness = factor * factor * (dot(slope, slope) + side_variance);
  return water_fresnel((v.y - factor * dot(v.xz, slope)) * inverseSqrt(1.0 + steepness));
}

// Radiance of the reflected sun (as water_glitter). `seen` is the projected area of the visible facets.
fn lean_glitter(v: vec3f, slope: WaterSlope, seen: vec2f) -> vec3f {
  let l = frame.sun_direction;
  let between = l + v;
  let off = -between.xz / max(between.y, 0.01) - slope.mean;
  // No slope is more likely than if its direction had the variance of both together.
  let most = slope.variance.x + slope.variance.y + 2.0 * frame.sun_slope_variance;
  if l.y <= -0.02 || dot(off, off) >= LEAN_NO_GLITTER_SQUARE * most {
    return vec3f(0.0);
  }
  let density = water_slope_density(water_limit_covariance(slope.variance));
  let square = water_slope_distance(density, off);
  if square >= LEAN_NO_GLITTER_SQUARE {
    return vec3f(0.0);
  }
  let h = normalize(between);
  let lit = water_tilt_projected_area(water_tilt_towards(l, slope));
  let h2 = h.y * h.y;
  let f = material.glitter_strength * saturate(material.glitter_fresnel_scale * water_fresnel(dot(v, h)));
  // As water_masking_shadowing, but limited: without the slopes of both halves of the pixel, a mean facet that is
  // turned away from the sun does not tell that all are.
  let shadow = clamp(lit.x / max(lit.y, 1e-6) - 1.0, 0.0, LEAN_MOST_SHADOW);
  let area = max(seen.x, 1e-5) + max(seen.y, 0.0) * shadow;
  let facets = water_slope_density_at(density, square) / (4.0 * h2 * h2 * area);
  return shadow_sun_irradiance() * min(f * facets, frame.sun_radiance_per_irradiance);
}

// Reflected sky and sun. `v` points to the eye, in axes whose y is the local vertical.
fn lean_mirror(v: vec3f, slope: WaterSlope) -> WaterMirror {
  // Unit vectors towards the eye and across; the statistics of the slopes along both, as in water_facets_towards.
  let square = max(1.0 - v.y * v.y, 1e-8);
  let over_across = inverseSqrt(square);
  let across = square * over_across;
  let toward = over_across * v.xz;
  let side = vec2f(-toward.y, toward.x);
  let mean = -dot(slope.mean, toward);
  let variance = slope.variance;
  let cov = vec2f(dot(variance.xz, toward), dot(variance.zy, toward));
  let tilt_variance = max(dot(toward, cov), 1e-6);
  let over_sigma = inverseSqrt(tilt_variance);
  let sigma = tilt_variance * over_sigma;
  let shear = dot(side, cov) * over_sigma;
  let side_variance = max(variance.x + variance.y - tilt_variance - shear * shear, 0.0);
  let tilts = water_visible_tilts(-(v.y * over_across + mean) * over_sigma);
  let per_tilt = -(sigma * toward + shear * side);
  // Each node stands for a third of a Gaussian. A slope turns the mirrored ray by twice its angle.
  let layer = mirrored_sky_layer(LEAN_NODE_SPREAD * tilts.y * sigma);
  let step = (LEAN_NODE_STEP * tilts.y) * per_tilt;
  let slope_at = slope.mean + tilts.x * per_tilt;
  let steep = lean_reflectance(v, slope_at - step, side_variance);
  let flat = lean_reflectance(v, slope_at + step, side_variance);
  // The reflectance is nearly exponential between the two.
  let middle_f = sqrt(steep * flat);
  let sky_light = steep * lean_mirrored_sky(v, slope_at - step, layer)
    + middle_f * lean_mirrored_sky(v, slope_at, layer) + flat * lean_mirrored_sky(v, slope_at + step, layer);
  let seen = vec2f(tilts.z * across * sigma, v.y + across * mean);
  let over = 1.0 / 3.0;
  return WaterMirror(
    (over * material.sky_reflection) * sky_light + lean_glitter(v, slope, seen), over * (steep + middle_f + flat));
}

// Foam in a pixel, from the finest level that holds it and is no finer than it.
fn lean_foam_level(at: vec2f, foot: LeanFootprint) -> FoamAmount {
  let texel_m = WATER_TAP_TEXEL_RATIO * foot.side_m;
  let level = foam_finest_level(0u, at, texel_m);
  if level == frame.foam_level_count {
    return foam_amount(vec4f(0.0), 0.0, 1.0);
  }
  return foam_amount(foam_cell(level, at), frame.foam_levels[level].front_fill, 0.0);
}

// Appearance of foam in a pixel (as foam_appearance), without threads, and with one edge for film and body. It has the
// layers of noise of one kind of foam: that which the wind has drawn out, or the other, whichever there is more of.
fn lean_foam(at: vec2f, foot: LeanFootprint, amount: FoamAmount) -> FoamAppearance {
  let is_front = amount.fresh > 0.5;
  let is_round = foam_round_shares(amount).x > 0.5;
  let wide = select(FOAM_PATCH_LAYER, FOAM_BILLOW_LAYER, is_round);
  let narrow = select(FOAM_STRAND_LAYER, FOAM_TUMBLE_LAYER, is_round);
  let lods = foot.log_texel_m + vec3f(
    material.noise_layers[FOAM_WINDROW_LAYER].log_texels_per_m, material.noise_layers[wide].log_texels_per_m,
    material.noise_layers[narrow].log_texels_per_m);
  var kept = 1.0 / (1.0 + exp2(MATERIAL_VARIANCE_STEEPNESS.xyz * (lods - MATERIAL_HALF_VARIANCE_LOD.xyz)));
  // Lace cuts the foam; lumps are its relief.
  let heaps = material_noise(wide, at, lods.y).ra - 0.5;
  let strands = material_noise(narrow, at, lods.z).ra - 0.5;
  var noise = vec3f(0.0, heaps.x, strands.x);
  var lumps = strands.y;
  var relief = vec2f(0.0);
  if is_front {
    let sun = frame.sun_direction.xz * inverseSqrt(max(dot(frame.sun_direction.xz, frame.sun_direction.xz), 1e-6));
    let step_m = max(LEAN_RELIEF_STEP_M, WATER_TAP_TEXEL_RATIO * foot.side_m);
    let rise = (material_noise(wide, at + step_m * sun, lods.y).a - 0.5 - heaps.y) * (LEAN_BILLOW_M / step_m);
    relief = (material.foam_relief * rise * inverseSqrt(1.0 + rise * rise)) * sun;
    noise.y = heaps.y;
    lumps += FOAM_BILLOW_GRAIN * heaps.y;
    // A front has no windrows.
    kept.x = 0.0;
  } else {
    noise.x = material_noise(FOAM_WINDROW_LAYER, at, lods.x).b - 0.5;
  }
  let old_weights = vec3f(
    material.noise_layers[FOAM_WINDROW_LAYER].foam_weight,
    material.noise_layers[FOAM_PATCH_LAYER].foam_weight,
    material.noise_layers[FOAM_STRAND_LAYER].foam_weight);
  let weight = mix(old_weights, FOAM_FRONT_WEIGHTS.xyz, amount.fresh);
  let over = inverseSqrt(dot(weight, weight));
  let resolved = dot(weight * weight, kept) * (over * over);
  let edge = sqrt(1.0 + LEAN_SOFTNESS * LEAN_SOFTNESS) * maths_normal_quantile(clamp(amount.cover, 1e-4, 1.0 - 1e-4));
  let z = over * dot(noise, weight * FOAM_PER_DEVIATION.xyz);
  let cut = maths_normal_cdf((z + edge) * inverseSqrt(LEAN_SOFTNESS * LEAN_SOFTNESS + 1.0 - resolved));
  var out: FoamAppearance;
  out.cover = cut * mix(
    LEAN_OLD_FOAM_OPACITY.x + LEAN_OLD_FOAM_OPACITY.y * amount.young, FOAM_FRONT_OPACITY.x + FOAM_FRONT_OPACITY.y,
    amount.fresh);
  out.film = LEAN_FILM * (1.0 - amount.fresh);
  out.grain = 0.5 + LEAN_GRAIN * lumps - foam_grain_skew(kept.yz, select(0.0, 1.0, is_front));
  out.relief = relief;
  out.lit = 1.0;
  return out;
}

// Light through the back of a crest (as water_crest_radiance).
fn lean_crest_radiance(n: vec3f, ray: vec3f, slope: WaterSlope, height_m: f32, plume: f32) -> vec3f {
  let crest = water_crest(ray, slope.mean, height_m, slope.jacobian);
  if crest.share == 0.0 {
    return vec3f(0.0);
  }
  let l = frame.sun_direction;
  let entry = max(n.y * l.y - n.x * l.x - n.z * l.z, 0.0);
  let phase = atm_henyey_greenstein(dot(l, ray), WATER_CREST_MEAN_COSINE);
  let through = water_crest_transmittance(crest.path_m, slope.jacobian, plume);
  let sun = cloud_sun_irradiance() * (step(-0.02, l.y) * entry * phase);
  let sky = light.sky_irradiance * (0.25 / ATM_PI * saturate(1.0 + ray.y));
  return (sun + sky) * through * (material.crest_transmission * crest.share);
}

// Air and fog between the eye and a point of the sea: the radiance that they add, and their transmittance. Where they
// take too little light to be seen, they are left out.
fn lean_air(dir: vec3f, distance_m: f32) -> array<vec3f, 2> {
  let extinction = 2e-5 + 5e-5 * sky.haze + 1e-3 * frame.salt_extinction_per_km + sky.fog.extinction_per_m;
  if extinction * distance_m < LEAN_LEAST_OPTICAL_DEPTH {
    return array<vec3f, 2>(vec3f(0.0), vec3f(1.0));
  }
  return air_to_point(dir, distance_m);
}

// Radiance towards the eye of a point of the water; alpha as in frame_hdr_output. `long_m` is the longer side of the
// pixel on the undisplaced sea.
fn lean_radiance(point: WaterPoint, long_m: f32, carried: WaterDerivatives) -> vec4f {
  let distance_m = length(point.position);
  let dir = point.position / distance_m;
  let foot = lean_footprint(long_m, frame.pixel_angle * distance_m);
  var slope = lean_slope(point.undisplaced, water_moved(point), foot, carried);
  slope.variance += vec3f(vec2f(material.roughness_variance), 0.0);
  // The vertical turns by so little over the Earth's curve that `v` stays a unit vector.
  let rise = dir.y + dot(dir.xz, point.position.xz) / FRAME_EARTH_RADIUS_M;
  let v = vec3f(-dir.x, max(-rise, 1e-4), -dir.z);
  var wake: Wake;
  if WATER_HULLS {
    wake = wake_at(point.position.xz, vec2f(long_m, frame.pixel_angle * distance_m));
    slope.mean += wake.slope;
    slope.variance *= wake.rough;
  }
  let n = water_normal(slope.mean);
  if SKY_CLOUD_SHADOWS {
    cloud_sun_fraction = cloud_sun_transmittance(point.position.xz, foot.log_texel_m);
  }
  var foam: FoamAmount;
  if WATER_FOAM {
    foam = lean_foam_level(point.undisplaced, foot);
    if WATER_COAST {
      foam.fresh *= shore_front_thickness(slope.jacobian);
    }
    if WATER_HULLS {
      foam = wake_add_foam(foam, wake);
    }
  }
  if WATER_HULLS {
    shadow_hull_fraction = hull_image_sunlight(
      hull_image_place(point.position, point.height), frame.pixel_angle * distance_m);
  }
  var mirror = lean_mirror(v, slope);
  if WATER_HULLS {
    mirror = hull_image_mirrored(mirror, hull_image_place(point.position, point.height), v, distance_m, slope);
  }
  let ray = water_refract(-v, n);
  var below = water_deep_radiance(n, ray, foam.plume);
  if WATER_BED {
    let size = WATER_TAP_TEXEL_RATIO * vec2f(long_m, frame.pixel_angle * distance_m);
    below = water_bed_radiance(below, point.position.xz, point.height, ray, size, slope.variance);
  }
  if point.height > 0.0 {
    below += lean_crest_radiance(n, ray, slope, point.height, foam.plume);
  }
  if WATER_HULLS {
    below *= wake.open;
  }
  let spread = material.inverse_relative_index * material.inverse_relative_index;
  var surface = mirror.radiance + (1.0 - mirror.reflectance) * spread * below;
  if WATER_FOAM && foam.cover >= LEAN_MIN_FOAM {
    var foam_at = point.undisplaced;
    if WATER_HULLS {
      foam_at -= wake.drift_m;
    }
    let look = lean_foam(foam_at, foot, foam);
    surface = mix(surface, foam_radiance(v, slope, look), look.cover);
  }
  let air = lean_air(dir, distance_m);
  return frame_hdr_output(surface * air[1] + air[0], 1.0 / distance_m);
}
