// Light inside the water: daylight that falls with depth, and what the water scatters of it towards an eye below the
// surface. Depths, m, count from the surface straight above. Directions `dir` point from the eye into the picture.

// Fraction of scattered light that is turned by less than some 5 degrees and so stays in the image (Petzold 1972).
const MEDIUM_NARROW_SCATTERING = 0.5;
// Mean cosine of the rest, for which that of all scattering is 0.92.
const MEDIUM_MEAN_COSINE = 0.85;
// Share of the rest that particles bend least. It makes the glow around the sun.
const MEDIUM_GLOW_SHARE = 0.25;
const MEDIUM_GLOW_COSINE = 0.96;
// How much more of the diffuse daylight is scattered downwards than sideways.
const MEDIUM_DOWNWARD = 1.5;

// Scattering coefficient of the light that leaves its direction, 1/m.
fn medium_wide_scattering() -> vec3f {
  return (1.0 - MEDIUM_NARROW_SCATTERING) * material.scattering;
}

// Extinction coefficient of the image and of the sun's beam, 1/m.
fn medium_extinction() -> vec3f {
  return material.absorption + medium_wide_scattering();
}

// Direction in which sunlight travels below a level surface.
fn medium_beam() -> vec3f {
  let level = -material.inverse_relative_index * frame.sun_direction.xz;
  return vec3f(level.x, -max(material.refracted_sun_sine, 0.3), level.y);
}

// Irradiance of a level plane just below the surface by the sun.
fn medium_sun_irradiance() -> vec3f {
  let height = max(frame.sun_direction.y, 0.0);
  return cloud_sun_irradiance() * (height * (1.0 - water_fresnel(height)));
}

// Downward irradiance at a depth, by sun and sky.
fn medium_downwelling(depth_m: f32) -> vec3f {
  let surface = medium_sun_irradiance() + WATER_SKYLIGHT_TRANSMITTANCE * light.sky_irradiance;
  return surface * exp(-material.diffuse_attenuation * depth_m);
}

// Fraction of light left after the way `length_m` in the image.
fn medium_transmittance(length_m: f32) -> vec3f {
  return exp(-medium_extinction() * length_m);
}

// Integral of exp(-rate t) over t from 0 to `length_m`.
fn medium_integral(rate: vec3f, length_m: f32) -> vec3f {
  let safe = select(rate, vec3f(1e-4), abs(rate) < vec3f(1e-4));
  return (1.0 - exp(clamp(-safe * length_m, vec3f(-80.0), vec3f(30.0)))) / safe;
}

// How fast the light that the water sends to the eye falls along a ray, 1/m: diffuse daylight and the sun's beam, which
// grow or fall with the depth along the ray.
fn medium_rates(dir: vec3f) -> array<vec3f, 2> {
  let c = medium_extinction();
  return array<vec3f, 2>(c - material.diffuse_attenuation * dir.y, c * (1.0 + dir.y / medium_beam().y));
}

// Radiance that the water scatters into a ray of the length `length_m` from an eye at the depth `depth_m`. `gain`:
// what waves make of the sun's beam along the ray, relative to its mean.
fn medium_radiance(dir: vec3f, depth_m: f32, length_m: f32, gain: f32) -> vec3f {
  let rates = medium_rates(dir);
  return medium_scattered(dir, depth_m, gain, medium_integral(rates[0], length_m), medium_integral(rates[1], length_m));
}

// As medium_radiance, with the ray's effective lengths, m, for diffuse daylight (`diffuse_m`) and for the sun's beam
// (`beam_m`): lengths weighted by the share of their light that reaches the eye.
fn medium_scattered(dir: vec3f, depth_m: f32, gain: f32, diffuse_m: vec3f, beam_m: vec3f) -> vec3f {
  let c = medium_extinction();
  let kd = material.diffuse_attenuation;
  let wide = medium_wide_scattering();
  let beam = medium_beam();
  let beam_down = -beam.y;
  let sun = medium_sun_irradiance();
  let all = sun + WATER_SKYLIGHT_TRANSMITTANCE * light.sky_irradiance;
  // Light of all orders that comes back evenly, so that the water seen straight down has the brightness that it has from
  // above (water_deep_radiance); Q = 4 sr.
  let even = 0.25 * material.deep_reflectance * (c + kd) * all;
  let level = max(1.0 + MEDIUM_DOWNWARD * dir.y, 0.05) / (4.0 * ATM_PI);
  let diffuse = (even + wide * level * all) * exp(-kd * depth_m) * diffuse_m;
  let turned = dot(beam, -dir);
  let phase = mix(
    atm_henyey_greenstein(turned, MEDIUM_MEAN_COSINE), atm_henyey_greenstein(turned, MEDIUM_GLOW_COSINE),
    MEDIUM_GLOW_SHARE);
  let direct = wide * sun * (phase * gain / beam_down - level) * exp(-c * (depth_m / beam_down)) * beam_m;
  return max(diffuse + direct, vec3f(0.0));
}

// Radiance of bottomless water along a ray that goes down from the surface.
fn medium_deep_radiance(dir: vec3f) -> vec3f {
  let down = vec3f(dir.x, min(dir.y, -0.03), dir.z);
  let rates = medium_rates(down);
  return medium_scattered(down, 0.0, 1.0, 1.0 / rates[0], 1.0 / rates[1]);
}
