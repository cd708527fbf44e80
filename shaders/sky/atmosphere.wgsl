// Clear air after Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", 2020. Lengths are
// in km. Functions take altitudes h above the sea instead of radii, because a float holds 6371 km only to half a metre.
// The sine of a ray's elevation is mu.

const ATM_PI = 3.14159265359;
const ATM_EARTH_RADIUS_KM = 6371.0;
const ATM_TOP_KM = 100.0;
// Light is a fraction of sunlight above the air, at the four wavelengths 630, 575, 510 and 440 nm. This matrix turns it
// into linear sRGB. It is a least-squares fit to 5 nm spectra of skies and suns through all air masses, with an rms
// error of 0.2 %. Three wavelengths, one per primary, would err by 16 % and turn dusk violet, because ozone absorbs
// most at 600 nm, between them. Colour matching functions: Wyman, Sloan and Shirley 2013; the sun: ASTM E-490. The
// columns add up to the sun above the air with a daylight white balance, in a scale that keeps noon and dusk in half
// floats.
const ATM_SRGB_FROM_WAVELENGTHS = mat4x3f(
  vec3f(15.0685, -1.0614, 0.0503),
  vec3f(11.6403, 10.0893, -3.1980),
  vec3f(-8.8026, 13.3056, 5.7608),
  vec3f(1.4938, -2.3335, 18.1869));
// Rayleigh scattering coefficient at sea level, 1/km (Bucholtz 1995), and its scale height, km.
const ATM_RAYLEIGH_SCATTERING = vec4f(6.665e-3, 9.662e-3, 15.763e-3, 28.900e-3);
const ATM_RAYLEIGH_SCALE_HEIGHT_KM = 8.4;
// Extinction coefficient of sea salt at sea level, 1/km: an optical depth of about 0.06 over the open ocean. Then
// albedo, scale height (km), and asymmetry of the phase functions of large, middle and small particles.
const ATM_AEROSOL_EXTINCTION = vec4f(0.0485, 0.0493, 0.0508, 0.0530);
const ATM_AEROSOL_ALBEDO = 0.97;
const ATM_AEROSOL_SCALE_HEIGHT_KM = 1.2;
const ATM_AEROSOL_ASYMMETRIES = vec3f(0.97, 0.88, 0.6);
// Shares of these sizes in the scattered light, chosen by us: the mean cosine is 0.78, and the light around the sun
// falls off steadily.
const ATM_AEROSOL_SHARES = vec3f(0.2, 0.4, 0.4);
// Absorption coefficient of ozone where it is densest, 1/km; 300 Dobson units in all (Gorshelev et al. 2014).
const ATM_OZONE_ABSORPTION = vec4f(1.854e-3, 2.590e-3, 0.871e-3, 0.070e-3);
const ATM_SEA_ALBEDO = 0.06;
// Reciprocal of the linear sRGB of sunlight above the air, to which the columns of ATM_SRGB_FROM_WAVELENGTHS add up.
const ATM_INVERSE_SUN = vec3f(1.0 / 19.4, 1.0 / 20.0, 1.0 / 20.8);

// Linear sRGB of light that is a fraction of sunlight at the four wavelengths.
fn atm_linear_srgb(share: vec4f) -> vec3f {
  return max(ATM_SRGB_FROM_WAVELENGTHS * share, vec3f(0.0));
}

// Scattering and extinction coefficients of air at the four wavelengths, 1/km.
struct AtmMedium {
  rayleigh: vec4f,
  mie: vec4f,
  extinction: vec4f,
}

fn atm_medium(h: f32, haze: f32) -> AtmMedium {
  var m: AtmMedium;
  m.rayleigh = ATM_RAYLEIGH_SCATTERING * exp(-h / ATM_RAYLEIGH_SCALE_HEIGHT_KM);
  let mie = ATM_AEROSOL_EXTINCTION * (haze * exp(-h / ATM_AEROSOL_SCALE_HEIGHT_KM));
  m.mie = ATM_AEROSOL_ALBEDO * mie;
  m.extinction = m.rayleigh + mie + ATM_OZONE_ABSORPTION * max(0.0, 1.0 - abs(h - 25.0) / 15.0);
  return m;
}

// Rayleigh phase function, 1/sr; c is the cosine of the scattering angle.
fn atm_rayleigh_phase(c: f32) -> f32 {
  return 3.0 / (16.0 * ATM_PI) * (1.0 + c * c);
}

// Henyey-Greenstein phase function, 1/sr; c is the cosine of the scattering angle.
fn atm_henyey_greenstein(c: f32, g: f32) -> f32 {
  let square = max(1.0 + g * g - 2.0 * g * c, 1e-4);
  return (1.0 - g * g) / (4.0 * ATM_PI * square * sqrt(square));
}

// Phase function of aerosol, 1/sr; c is the cosine of the scattering angle. Large particles scatter close to the sun,
// small ones widely. One lobe for all would paint a flat disc of 10 degrees around the sun.
fn atm_aerosol_phase(c: f32) -> f32 {
  var sum = 0.0;
  for (var i = 0; i < 3; i++) {
    sum += ATM_AEROSOL_SHARES[i] * atm_henyey_greenstein(c, ATM_AEROSOL_ASYMMETRIES[i]);
  }
  return sum;
}

// Arc sine with an error of at most 3e-7 (Moshier's Cephes). It replaces WGSL's function, for which SwiftShader calls
// the C library once for each pixel.
fn atm_asin(x: f32) -> f32 {
  let a = min(abs(x), 1.0);
  let is_steep = a > 0.5;
  let z = select(a * a, 0.5 - 0.5 * a, is_steep);
  let r = select(a, sqrt(z), is_steep);
  let tail = 4.5470025998e-2 + z * (2.4181311049e-2 + z * 4.2163199048e-2);
  let angle = r + r * z * (1.6666752422e-1 + z * (7.4953002686e-2 + z * tail));
  return sign(x) * select(angle, 0.5 * ATM_PI - 2.0 * angle, is_steep);
}

// Angle from the horizontal down to the horizon, rad, at the altitude h.
fn atm_horizon_dip(h: f32) -> f32 {
  return atm_asin(sqrt(max(h, 0.0) * (2.0 * ATM_EARTH_RADIUS_KM + h)) / (ATM_EARTH_RADIUS_KM + h));
}

// Distance along a ray to the top of the air, km.
fn atm_distance_to_top(h: f32, mu: f32) -> f32 {
  let b = (ATM_EARTH_RADIUS_KM + h) * mu;
  return -b + sqrt(max(b * b + (ATM_TOP_KM - h) * (2.0 * ATM_EARTH_RADIUS_KM + ATM_TOP_KM + h), 0.0));
}

// Distance along a ray to the sea, km; -1 if the ray misses the sea.
fn atm_distance_to_sea(h: f32, mu: f32) -> f32 {
  let b = (ATM_EARTH_RADIUS_KM + h) * mu;
  let c = h * (2.0 * ATM_EARTH_RADIUS_KM + h);
  let disc = b * b - c;
  if mu >= 0.0 || disc < 0.0 {
    return -1.0;
  }
  return c / (-b + sqrt(disc));
}

// Altitude after the distance t along a ray that starts at altitude h, km.
fn atm_altitude_along_ray(h: f32, mu: f32, t: f32) -> f32 {
  let r = ATM_EARTH_RADIUS_KM + h;
  let more = t * (2.0 * r * mu + t);
  return max((h * (2.0 * ATM_EARTH_RADIUS_KM + h) + more) / (sqrt(max(r * r + more, 0.0)) + ATM_EARTH_RADIUS_KM), 0.0);
}

// Texture coordinate for x in [0, 1] in a table of n texels: from the centre of the first texel to that of the last.
fn atm_table_coordinate(x: f32, n: f32) -> f32 {
  return (saturate(x) * (n - 1.0) + 0.5) / n;
}

// Size of the transmittance table, texels.
const ATM_TRANSMITTANCE_TABLE_SIZE = vec2f(256.0, 64.0);

// Fraction of sunlight at altitude h from the elevation with sine mu; `radius` is that of the sun's disc, rad.
fn atm_transmittance(map: texture_2d<f32>, s: sampler, h: f32, mu: f32, radius: f32) -> vec4f {
  let dip = atm_horizon_dip(h);
  let above = atm_asin(mu) + dip;
  let u = sqrt(max(above, 0.0) / (0.5 * ATM_PI + dip));
  let v = sqrt(saturate(h / ATM_TOP_KM));
  let size = ATM_TRANSMITTANCE_TABLE_SIZE;
  let uv = vec2f(atm_table_coordinate(u, size.x), atm_table_coordinate(v, size.y));
  // The sun's disc sets gradually.
  let disc = smoothstep(-radius, radius, above);
  return disc * textureSampleLevel(map, s, uv, 0.0);
}

// Size of the table of multiple scattering, texels.
const ATM_MULTIPLE_SCATTERING_TABLE_SIZE = vec2f(64.0, 32.0);

// Light scattered more than once, per unit of scattering coefficient, relative to the sun's irradiance. The table is
// dense for a low sun and holds square roots, because twilight falls through more decades than a half float has.
fn atm_multiple_scattering(map: texture_2d<f32>, s: sampler, h: f32, mu_sun: f32) -> vec4f {
  let x = 0.5 + 0.5 * sign(mu_sun) * sqrt(abs(mu_sun));
  let size = ATM_MULTIPLE_SCATTERING_TABLE_SIZE;
  let uv = vec2f(atm_table_coordinate(x, size.x), atm_table_coordinate(sqrt(h / ATM_TOP_KM), size.y));
  let root = textureSampleLevel(map, s, uv, 0.0);
  return root * root;
}
