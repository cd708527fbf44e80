// Reflected sky and sun, integrated over the slopes that the eye sees, after Bruneton, Neyret and Holzschuch (2010),
// but with a quadrature over the visible slopes.

struct WaterMirror {
  radiance: vec3f,
  // Mean Fresnel reflectance over the visible slopes.
  reflectance: f32,
}

// Reflected sky and sun. `v` points to the eye, in axes whose y is the local vertical.
fn water_mirror(v: vec3f, surface: WaterSlope) -> WaterMirror {
  return water_mirror_among(v, surface, surface, WaterGlints());
}

// Reflected sky and sun of a part of a surface. Facets of `others` hide it from eye and sun, and reflect light to it.
fn water_mirror_among(v: vec3f, surface: WaterSlope, others: WaterSlope, glints: WaterGlints) -> WaterMirror {
  var slope = surface;
  var around = others;
  if WATER_PHONG {
    // A Blinn-Phong lobe of the given shininess replaces the slopes that the pixel does not resolve.
    slope.variance = vec3f(vec2f(1.0 / (material.shininess + 2.0)), 0.0);
    around.variance = slope.variance;
  }
  let eye = water_facets_towards(v, slope);
  let quadrature = water_quadrature(eye);
  // Cosine between the direction to the eye and a facet's unscaled normal, per deviation of tilt past the lowest one.
  let facing = eye.tilt.across * eye.tilt.sigma;
  let factor = material.fresnel_slope_factor;
  let factor_square = factor * factor;
  let unscaled = v.y * (1.0 - factor);
  // The binary logarithm of a node's width, which is close to 1, shifts the layer of the mirrored sky.
  let layers_per_width = 1.442695 / MIRRORED_LAYERS;
  let layer_of_no_width = quadrature.sky_layer - layers_per_width;
  var sum = vec3f(0.0);
  var sum_f = 0.0;
  var weights = 0.0;
  var at = 0.5 * quadrature.part;
  for (var i = 0; i < quadrature.nodes; i++) {
    let node = water_quadrature_node(quadrature, at);
    at += quadrature.part;
    let square = quadrature.square.x + node.tilt * (quadrature.square.y + node.tilt * quadrature.square.z);
    // Slopes across the viewing direction lengthen the facet's unscaled normal, but not its part towards the eye.
    let scaled_square = 1.0 + factor_square * (square + node.side_variance);
    let towards_eye = facing * node.past_low;
    let cosine = (unscaled + factor * towards_eye) * inverseSqrt(scaled_square);
    let reflected = node.weight * water_fresnel(cosine);
    var layer = 0.0;
    if WATER_GGX {
      let interval = 1.3 * node.width * eye.tilt.sigma * (1.0 + 0.5 * node.tilt * node.tilt) * quadrature.part;
      layer = water_sky_layer(interval);
    } else {
      layer = layer_of_no_width + layers_per_width * node.width;
    }
    let slope_at = quadrature.slope + node.tilt * quadrature.slope_per_tilt;
    sum += reflected * water_mirrored_sky(v, slope_at, towards_eye, 1.0 + square, layer);
    sum_f += reflected;
    weights += node.weight;
  }
  var out: WaterMirror;
  let over = 1.0 / weights;
  out.radiance = sum * (material.sky_reflection * over);
  out.reflectance = sum_f * over;
  out.radiance += water_glitter(v, slope, around, out.reflectance, glints);
  return out;
}

// Radiance of the sky mirrored by a facet of slope `slope`, averaged over rays of the spread that has the given layer.
// The facet's unscaled normal n = (-slope.x, 1, -slope.y) has the part `facing` towards the eye and the square
// `length_square` of its length.
fn water_mirrored_sky(v: vec3f, slope: vec2f, facing: f32, length_square: f32, layer: f32) -> vec3f {
  // The mirrored ray is 2 (v n) n / n^2 - v. The table needs its horizontal part over 1 and its vertical part.
  let twice = 2.0 * facing;
  let over = MIRRORED_SCALE / (length_square * (1.0 - v.y) + twice);
  let uv = 0.5 - over * (twice * slope + length_square * v.xz);
  return textureSampleLevel(mirrored_sky_map, sky_sampler, vec3f(saturate(uv), layer), 0.0).rgb;
}

// Radiance reflected twice divided by that reflected once, by facets of the given mean reflectance. The fraction of
// reflected rays that meet other waves is fitted to the integral of the masking in water_masking_shadowing over the
// visible slopes, to 0.01 for deviations up to 0.2. If elevation and deviation are small, it depends on their ratio
// alone.
fn water_second_bounce(t: WaterTilt, reflectance: f32) -> f32 {
  let a = clamp((t.height / t.across + t.mean) / t.sigma, 0.0, 1e3);
  var lost = 0.16 * a / (1.0 + 0.7 * a) * exp(-min(a * a / 8.41, 80.0));
  if WATER_GGX {
    lost = 0.17 * a / ((1.0 + 0.62 * a) * (1.0 + a * a / 9.0));
  }
  return reflectance * lost / (1.0 - lost);
}

// 1 / (projected area, enlarged by its part in shadow): Smith's masking and shadowing of one height field (Ross, Dion
// and Potvin 2005). `seen` and `lit` hold projected area and mean cosine for the eye and for the sun. A facet that is
// hidden from one is often hidden from the other.
fn water_masking_shadowing(seen: vec2f, lit: vec2f) -> f32 {
  let shadow = max(lit.x / max(lit.y, 1e-6), 1.0) - 1.0;
  return step(1e-6, lit.y) / (max(seen.x, 1e-5) + max(seen.y, 0.0) * shadow);
}

// Square of the distance from the mean slope, in standard deviations, from which a Gaussian has too few facets to show
// the sun: their density is 1e-7 of that at the mean.
const WATER_NO_GLITTER_SQUARE = 32.0;

// Radiance of the reflected sun. `surface` and `others` are as in water_mirror_among; `reflectance` is the mean of the
// facets.
fn water_glitter(
  v: vec3f, surface: WaterSlope, others: WaterSlope, reflectance: f32, glints: WaterGlints,
) -> vec3f {
  let l = frame.sun_direction;
  let between = l + v;
  if l.y <= -0.02 || between.y <= 0.01 {
    return vec3f(0.0);
  }
  let mirror_slope = -between.xz / between.y;
  let half = surface.half_slope_difference;
  let from_mean = mirror_slope - surface.mean;
  // No slope is more likely than if its direction had the variance of both together.
  let most_variance = surface.variance.x + surface.variance.y + 2.0 * frame.sun_slope_variance;
  // The square of a sum is at most twice the sum of the squares. The farther half lies at most two halves away.
  let farthest_square = 2.0 * WATER_NO_GLITTER_SQUARE * most_variance + 8.0 * dot(half, half);
  if !WATER_GGX && !WATER_PHONG && dot(from_mean, from_mean) >= farthest_square {
    return vec3f(0.0);
  }
  // Both halves of an elongated footprint glitter by their own slopes: neither has the mean of a wave's face and back.
  // Halves that are nearly alike count as one.
  let is_split = !WATER_POINT_SAMPLES && dot(half, half) > 0.01 * min(surface.variance.x, surface.variance.y);
  var part = surface;
  // A variable, because Mesa's software adapter crashes if a select between uniform values limits a loop.
  var halves = 1;
  if is_split {
    halves = 2;
    let rest = surface.variance - maths_self_products(half);
    part.variance = water_limit_covariance(max(rest, vec3f(0.3 * surface.variance.xy, -1.0)));
    part.mean = surface.mean + (surface.moved_by_halves - 1.0) * half;
  }
  let density = water_slope_density(part.variance);
  let off = mirror_slope - part.mean;
  var squares = vec2f(water_slope_distance(density, off), WATER_NO_GLITTER_SQUARE);
  if is_split {
    squares.y = water_slope_distance(density, off - 2.0 * half);
  }
  if !WATER_GGX && !WATER_PHONG && min(squares.x, squares.y) >= WATER_NO_GLITTER_SQUARE {
    return vec3f(0.0);
  }
  let h = normalize(between);
  var f = water_fresnel(dot(v, h));
  if material.fresnel_slope_factor != 1.0 {
    f = water_facet_fresnel(v, mirror_slope);
  }
  var strength = material.glitter_strength * saturate(material.glitter_fresnel_scale * f);
  if WATER_POINT_SAMPLES {
    let eye = water_tilt_towards(v, others);
    let lit = water_tilt_towards(l, others);
    // Projected area of the surface around, divided by that of this part.
    let own = water_tilt_projected_area(water_tilt_towards(v, surface)).x;
    let share = max(water_tilt_projected_area(eye).x, 1e-5) / max(own, 1e-5);
    let facets = water_slope_density_at(density, squares.x);
    let brightness = water_glitter_brightness(v, h, facets, surface, eye, lit, share, reflectance);
    return shadow_sun_irradiance() * min(strength * brightness.x, frame.sun_radiance_per_irradiance);
  }
  var eye = water_tilt_towards(v, part);
  var lit = water_tilt_towards(l, part);
  var sum = 0.0;
  var seen = 0.0;
  if WATER_GLINTS {
    var mean = water_slope_density_at(density, squares.x);
    if is_split {
      mean = 0.5 * (mean + water_slope_density_at(density, squares.y));
    }
    strength *= water_glint_gain(glints, mean);
  }
  for (var i = 0; i < halves; i++) {
    let facets = water_slope_density_at(density, squares.x);
    let brightness = water_glitter_brightness(v, h, facets, part, eye, lit, 1.0, reflectance);
    // A reflection is not brighter than the sun's disc.
    sum += brightness.y * min(strength * brightness.x, frame.sun_radiance_per_irradiance);
    seen += brightness.y;
    // The second half.
    squares = squares.yx;
    part.mean += 2.0 * half;
    eye.mean -= 2.0 * dot(half, eye.toward);
    lit.mean -= 2.0 * dot(half, lit.toward);
  }
  return shadow_sun_irradiance() * (sum / seen);
}

// Radiance of the reflected sun divided by its irradiance and by Fresnel's reflectance (x), and the projected area of
// the surface around towards the eye (y). `facets` is the density of the slope that reflects the sun, `h` the half
// vector.
// `eye` and `sun` are the tilts of the surface around, whose facets hide `slope` from eye and sun; in a filtered
// picture that surface is the pixel's own. `share`: its projected area, divided by that of `slope`.
fn water_glitter_brightness(
  v: vec3f, h: vec3f, facets: f32, slope: WaterSlope, eye: WaterTilt, sun: WaterTilt, share: f32,
  reflectance: f32,
) -> vec2f {
  let l = frame.sun_direction;
  let seen = water_tilt_projected_area(eye);
  let area = max(seen.x, 1e-5);
  var brightness: f32;
  if WATER_PHONG {
    // Normalised over half vectors. The larger cosine, not the product of both, keeps it below 1 (Neumann et al. 1999).
    let n = water_normal(slope.mean);
    let cosines = vec2f(dot(n, l), dot(n, v));
    let lobe = (material.shininess + 2.0) / (8.0 * ATM_PI) * pow(max(dot(n, h), 1e-6), material.shininess);
    brightness = lobe * max(cosines.x, 0.0) / max(max(cosines.x, cosines.y), 1e-4);
  } else {
    let lit = water_tilt_projected_area(sun);
    let h2 = h.y * h.y;
    brightness = share * facets / (4.0 * h2 * h2) * water_masking_shadowing(seen, lit);
    // Sunlight reflected twice spreads like that reflected once. It matters in grazing views of rough water.
    brightness *= 1.0 + water_second_bounce(eye, reflectance);
  }
  if material.glitter_min_cosine > 0.0 {
    let n = water_normal(slope.mean);
    brightness *= smoothstep(0.5 * material.glitter_min_cosine, material.glitter_min_cosine, min(dot(n, l), dot(n, v)));
  }
  return vec2f(brightness, area);
}
