// Light that leaves the water, scattered back by water and bubbles.

// Backscattering coefficient of a dense bubble plume under a breaker, 1/m, for a void fraction of 1e-3 (Deane and
// Stokes 2002; backscattering ratio of Zhang, Lewis and Johnson 1998).
const WATER_PLUME_BACKSCATTER = 0.4;
// Depth of a bubble plume under a breaker, m.
const WATER_PLUME_DEPTH_M = 0.8;

// Direction in the water of light that arrives along `dir` at a surface of normal `n`; reversed, the path to the eye.
// Total reflection leaves no refracted ray; the limit is a ray that is nearly along the surface.
fn water_refract(dir: vec3f, n: vec3f) -> vec3f {
  let ratio = material.inverse_relative_index;
  let cosine = dot(dir, n);
  let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
  return ratio * dir - (ratio * cosine + sqrt(max(square, 2.5e-3))) * n;
}

// Backscattering coefficient of the bubbles, 1/m, where foam has lately covered the fraction `plume` of the surface.
fn water_bubble_backscatter(plume: f32) -> f32 {
  return WATER_PLUME_BACKSCATTER * material.bubble_density * plume * sqrt(plume);
}

// Irradiance reflectance just below the surface, of deep water under a layer of bubbles.
fn water_reflectance(plume: f32) -> vec3f {
  // Fewer bubbles reflect less than a hundredth of what the water does.
  if plume < WATER_MIN_PLUME {
    return material.deep_reflectance;
  }
  let past = exp(-2.0 * WATER_PLUME_DEPTH_M * water_bubble_backscatter(plume));
  return (1.0 - past) * material.bubble_colour * exp(-3.5 * WATER_PLUME_DEPTH_M * material.absorption)
    + past * material.deep_reflectance;
}

// Share of the light from below a layer of bubbles that they hide by their own.
fn water_bubble_veil(plume: f32) -> f32 {
  return 1.0 - exp(-2.0 * WATER_PLUME_DEPTH_M * water_bubble_backscatter(plume));
}

// Irradiance by the sun that enters the water where the waves, without their ripples, have the normal `n`.
fn water_entering_sunlight(n: vec3f) -> vec3f {
  let l = frame.sun_direction;
  let cosine = dot(n, l);
  let facing = max(0.5 * (cosine + l.y), 0.0);
  return shadow_entering_sun_irradiance() * (facing * (1.0 - water_fresnel(max(cosine, 0.0))));
}

// Fraction of the surface lately covered by foam, below which the bubbles do not count.
const WATER_MIN_PLUME = 0.01;
// Fraction of the skylight that enters the water.
const WATER_SKYLIGHT_TRANSMITTANCE = 0.934;

// Radiance inside the water that travels up to the surface from deep water. `ray` points from the eye into the water.
fn water_deep_radiance(n: vec3f, ray: vec3f, plume: f32) -> vec3f {
  let r = water_reflectance(plume);
  let sun_in = material.refracted_sun_sine;
  // Light scattered once: the flatter the viewing ray, the more sunlit water lies along it.
  let view = (sun_in + 0.85) / (sun_in + clamp(-ray.y, 0.3, 1.0));
  let view_factor = max(mix(1.0, view, material.scatter_view_dependence), 0.0);
  let sun = water_entering_sunlight(n) * (material.sunlight_scatter_factor * view_factor);
  let sky_factor = 0.5 * WATER_SKYLIGHT_TRANSMITTANCE * material.skylight_scatter_factor * (1.0 + n.y);
  let sky = light.sky_irradiance * sky_factor;
  // Upwelling light is uneven over the hemisphere: irradiance / radiance is Q = 4 sr. Half of it is reflected back.
  return (sun + sky) * (r / (4.0 - 1.92 * r));
}
