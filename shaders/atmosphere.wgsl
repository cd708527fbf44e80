// Clear air after Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", 2020. Lengths in km.
// Altitudes h above the sea are carried instead of radii: a float holds 6371 km only to half a metre.

const ATM_PI = 3.14159265359;
const ATM_GROUND = 6371.0;
const ATM_TOP = 100.0;
// Irradiance of the sun above the air: a scale that keeps noon and dusk inside half floats, in linear sRGB under the
// white balance of daylight film.
const ATM_SUN = vec3f(19.4, 20.0, 20.8);
const ATM_SUN_RADIUS = 0.00465;
const ATM_RAYLEIGH = vec3f(5.802e-3, 13.558e-3, 33.1e-3);
const ATM_RAYLEIGH_HEIGHT = 8.0;
// Sea salt over the open ocean: optical depth of about 0.06 in a boundary layer.
const ATM_MIE = vec3f(0.048, 0.050, 0.053);
const ATM_MIE_ALBEDO = 0.97;
const ATM_MIE_HEIGHT = 1.2;
const ATM_MIE_G = 0.78;
const ATM_OZONE = vec3f(0.650e-3, 1.881e-3, 0.085e-3);
const ATM_SEA_ALBEDO = 0.06;

struct AtmMedium {
  rayleigh: vec3f,
  mie: vec3f,
  extinction: vec3f,
}

fn atm_medium(h: f32, haze: f32) -> AtmMedium {
  var m: AtmMedium;
  m.rayleigh = ATM_RAYLEIGH * exp(-h / ATM_RAYLEIGH_HEIGHT);
  let mie = ATM_MIE * (haze * exp(-h / ATM_MIE_HEIGHT));
  m.mie = ATM_MIE_ALBEDO * mie;
  m.extinction = m.rayleigh + mie + ATM_OZONE * max(0.0, 1.0 - abs(h - 25.0) / 15.0);
  return m;
}

fn atm_rayleigh_phase(c: f32) -> f32 {
  return 3.0 / (16.0 * ATM_PI) * (1.0 + c * c);
}

// Cornette and Shanks 1992.
fn atm_mie_phase(c: f32) -> f32 {
  let g = ATM_MIE_G;
  let k = 3.0 / (8.0 * ATM_PI) * (1.0 - g * g) / (2.0 + g * g);
  return k * (1.0 + c * c) / pow(max(1.0 + g * g - 2.0 * g * c, 1e-4), 1.5);
}

// Angle from the horizontal down to the horizon.
fn atm_dip(h: f32) -> f32 {
  return asin(clamp(sqrt(max(h, 0.0) * (2.0 * ATM_GROUND + h)) / (ATM_GROUND + h), 0.0, 1.0));
}

fn atm_to_top(h: f32, mu: f32) -> f32 {
  let b = (ATM_GROUND + h) * mu;
  return -b + sqrt(max(b * b + (ATM_TOP - h) * (2.0 * ATM_GROUND + ATM_TOP + h), 0.0));
}

// Distance to the sea, or -1.
fn atm_to_ground(h: f32, mu: f32) -> f32 {
  let b = (ATM_GROUND + h) * mu;
  let c = h * (2.0 * ATM_GROUND + h);
  let disc = b * b - c;
  if mu >= 0.0 || disc < 0.0 {
    return -1.0;
  }
  return c / (-b + sqrt(disc));
}

// Altitude after a distance t along a ray.
fn atm_altitude(h: f32, mu: f32, t: f32) -> f32 {
  let r = ATM_GROUND + h;
  let more = t * (2.0 * r * mu + t);
  return max((h * (2.0 * ATM_GROUND + h) + more) / (sqrt(max(r * r + more, 0.0)) + ATM_GROUND), 0.0);
}

// [0, 1] to the centres of the first and last texel.
fn atm_to_texels(x: f32, n: f32) -> f32 {
  return (clamp(x, 0.0, 1.0) * (n - 1.0) + 0.5) / n;
}

const ATM_T_SIZE = vec2f(256.0, 64.0);

// Share of sunlight that arrives at altitude h from the elevation whose sine is mu.
fn atm_transmittance(map: texture_2d<f32>, s: sampler, h: f32, mu: f32) -> vec3f {
  let dip = atm_dip(h);
  let above = asin(clamp(mu, -1.0, 1.0)) + dip;
  let u = sqrt(max(above, 0.0) / (0.5 * ATM_PI + dip));
  let v = sqrt(clamp(h / ATM_TOP, 0.0, 1.0));
  let uv = vec2f(atm_to_texels(u, ATM_T_SIZE.x), atm_to_texels(v, ATM_T_SIZE.y));
  // The disc sets gradually.
  let disc = smoothstep(-ATM_SUN_RADIUS, ATM_SUN_RADIUS, above);
  return disc * textureSampleLevel(map, s, uv, 0.0).rgb;
}

const ATM_M_SIZE = 32.0;

// Light scattered more than once, per unit of scattering, with the sun's irradiance as unit.
fn atm_multiple(map: texture_2d<f32>, s: sampler, h: f32, mu_sun: f32) -> vec3f {
  let uv = vec2f(atm_to_texels(0.5 + 0.5 * mu_sun, ATM_M_SIZE), atm_to_texels(sqrt(h / ATM_TOP), ATM_M_SIZE));
  return textureSampleLevel(map, s, uv, 0.0).rgb;
}
