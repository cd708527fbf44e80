// Light of whitecaps: a white diffuse body with relief.

// Reflectance of thick fresh foam (Whitlock, Bartlett and Gurganus 1982; Koepke 1984).
const FOAM_ALBEDO = 0.6;
// Sunlight that comes through heaps of foam from behind, relative to that which falls on a plane towards the sun. It
// enters through their tops, so that the shadow of the wave that carries them does not hold it back. The film of old
// foam is too thin to glow.
const FOAM_GLOW = 0.4;
// Stops of sunlight (x) and of skylight (y) between hollows, where the grain is 0, and lumps, where it is 1.
const FOAM_HOLLOW_STOPS = vec2f(2.8, 1.1);
// Share of the sunlight that shades foam by its slope; light that spreads inside foam evens out the rest.
const FOAM_FACING = 0.55;
// Sunlight that spreads to foam whose slope is turned away from the sun, relative to that on a plane towards the sun:
// without it, foam in grazing light would be cut into white and dark spots.
const FOAM_SPREAD = 0.05;

// Colour of a thin film of foam: light that it scatters down comes back through the water between its bubbles.
const FOAM_FILM_COLOUR = vec3f(0.86, 0.95, 0.97);

// Radiance of foam towards `v`: a white diffuse body lit by sun and sky, with the gloss of its wet bubbles.
fn foam_radiance(v: vec3f, slope: WaterSlope, foam: FoamAppearance) -> vec3f {
  let n = water_normal(slope.mean + foam.relief);
  let l = frame.sun_direction;
  // Light spreads inside foam, which softens its shading. Unresolved slopes brighten the mean, because facets that are
  // turned away from the sun are not darker than black.
  let cosine = dot(n, l);
  let mean = mix(l.y, cosine, FOAM_FACING);
  let across = slope.variance.x * l.x * l.x + slope.variance.y * l.z * l.z + 2.0 * slope.variance.z * l.x * l.z;
  let deviation = FOAM_FACING * n.y * sqrt(max(across + foam.rough * dot(l.xz, l.xz), 1e-6));
  let off = mean / deviation;
  var wrapped = max(mean * maths_normal_cdf(off) + deviation * 0.39894228 * exp(-0.5 * min(off * off, 80.0)), 0.0);
  if WATER_SHADOWS {
    // The waves within the pixel shade each other (Smith).
    let lit = water_tilt_projected_area(water_tilt_towards(l, slope));
    wrapped *= (max(lit.y, 0.0) + FOAM_SPREAD) / (max(lit.x, 0.0) + FOAM_SPREAD);
  }
  // Hollows see less of the sky, and light is lost between their walls. Scattered light reaches the deepest ones, too,
  // so they are limited smoothly.
  let hollow = min(0.5 * (foam.grain + sqrt(foam.grain * foam.grain + 0.05)) - 0.02, 1.4);
  let soft = exp2(FOAM_HOLLOW_STOPS.y * (hollow - 0.5));
  let open = (0.55 + 0.45 * n.y) * soft;
  let thin = mix(vec3f(1.0), FOAM_FILM_COLOUR, foam.film);
  let albedo = material.foam_colour * thin * FOAM_ALBEDO;
  let glow = FOAM_GLOW * saturate(1.0 - 4.0 * foam.film) * soft * saturate(-dot(v, l)) * saturate(8.0 * l.y);
  let direct = foam.lit * wrapped * exp2(FOAM_HOLLOW_STOPS.x * (hollow - 0.5));
  let sunlight = shadow_sun_irradiance() * direct + cloud_sun_irradiance() * glow;
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
  return body + shadow_sun_irradiance() * min(gloss, 50.0);
}
