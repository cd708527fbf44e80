// Height fog over a round sea: full density up to its top, exponential decrease above. Needs the module variables sky
// and light. Lengths are in metres, altitudes above the water; the sine of a ray's elevation at the eye is mu.

const FOG_EARTH_RADIUS_M = 6371000.0;
// Distance that is farther than any fog, m.
const FOG_FAR_M = 1e7;

// e^{x^2} erfc(x) for x >= 0, to 0.4 % (Ren and MacKenzie 2007).
fn fog_erfcx(x: f32) -> f32 {
  return 2.911 / (1.911 * 1.7724539 * x + sqrt(ATM_PI * x * x + 8.473921));
}

// Altitude after the distance t along a ray from the eye, m.
fn fog_altitude_along_ray(eye_m: f32, mu: f32, t: f32) -> f32 {
  return eye_m + mu * t + t * t / (2.0 * FOG_EARTH_RADIUS_M);
}

// Path length in fog of full density that equals the fog above its top, m: from the distance t along the ray to
// infinity, away from the lowest point of the ray (a Chapman function).
fn fog_length_to_infinity(eye_m: f32, mu: f32, t: f32) -> f32 {
  let width = sqrt(2.0 * FOG_EARTH_RADIUS_M * sky.fog.scale_height_m);
  let over = max(fog_altitude_along_ray(eye_m, mu, t) - sky.fog.top_m, 0.0) / sky.fog.scale_height_m;
  return 0.8862269 * width * exp(-min(over, 80.0)) * fog_erfcx(abs(t + mu * FOG_EARTH_RADIUS_M) / width);
}

// Path length in fog of full density that equals a piece of the ray above the fog's top, m.
fn fog_length_above_top(eye_m: f32, mu: f32, start: f32, end: f32) -> f32 {
  if end <= start {
    return 0.0;
  }
  let lowest = -mu * FOG_EARTH_RADIUS_M;
  let a = fog_length_to_infinity(eye_m, mu, start);
  let b = fog_length_to_infinity(eye_m, mu, end);
  if lowest <= start || lowest >= end {
    return abs(a - b);
  }
  return max(2.0 * fog_length_to_infinity(eye_m, mu, lowest) - a - b, 0.0);
}

// Path length in fog of full density that equals the fog on a ray between two distances, m.
fn fog_length(eye_m: f32, mu: f32, start: f32, end: f32) -> f32 {
  let over = eye_m - sky.fog.top_m;
  let disc = mu * mu - 2.0 * over / FOG_EARTH_RADIUS_M;
  // Distances at which the ray enters and leaves the fog of full density: roots of a parabola, without cancellation.
  var enters = FOG_FAR_M;
  var leaves = FOG_FAR_M;
  if disc > 0.0 {
    let root = sqrt(disc);
    if over <= 0.0 {
      enters = 0.0;
      leaves = select((root - mu) * FOG_EARTH_RADIUS_M, -2.0 * over / (mu + root), mu > 0.0);
    } else if mu < 0.0 {
      enters = 2.0 * over / (root - mu);
      leaves = (root - mu) * FOG_EARTH_RADIUS_M;
    }
  }
  let first = clamp(enters, start, end);
  let second = clamp(leaves, start, end);
  return second - first + fog_length_above_top(eye_m, mu, start, first) + fog_length_above_top(eye_m, mu, second, end);
}

// Transmittance of the fog on a ray between two distances, 0 to 1.
fn fog_transmittance(eye_m: f32, mu: f32, start: f32, end: f32) -> f32 {
  if end <= start {
    return 1.0;
  }
  return exp(-min(sky.fog.extinction_per_m * fog_length(eye_m, mu, start, end), 80.0));
}

// Radiance of infinitely thick fog, to which clouds let through the fraction `sunlit` of the sunlight. Its droplets
// scatter the sun mostly forwards, and a little backwards.
fn fog_radiance(dir: vec3f, sunlit: f32) -> vec3f {
  let c = dot(dir, sky.sun_direction);
  let phase = 0.88 * atm_henyey_greenstein(c, 0.78) + 0.12 * atm_henyey_greenstein(c, -0.3);
  return light.fog_sky_radiance + light.fog_sun_irradiance * (sunlit * phase);
}
