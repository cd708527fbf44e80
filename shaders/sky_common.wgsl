// Size of the look-up table of the clear sky.
const SKY_VIEW_SIZE = vec2f(192.0, 128.0);

// What the sky's look-up tables are made for.
struct Sky {
  // Unit vector to the sun.
  sun: vec3f,
  // Aerosol relative to a clear day at sea.
  haze: f32,
  // Altitude that the sky is seen from, km, and the dip of its horizon.
  eye_km: f32,
  dip: f32,
  overcast: f32,
  // Where the clouds have drifted, km along the wind; kept for animation.
  drift: f32,
}

// Light on the sea, worked out on the GPU whenever the sky changes.
struct Light {
  // Irradiance of the sun behind the air, on a plane that faces it.
  sun: vec3f,
  // Automatic exposure.
  exposure: f32,
  // Irradiance of the sky on the horizontal.
  sky: vec3f,
  // Luminance that the exposure follows.
  key: f32,
  // Radiance of an overcast deck at the zenith.
  deck: vec3f,
  // Share of the sun's light that the clouds let through.
  direct: f32,
}

fn sky_luminance(c: vec3f) -> f32 {
  return dot(c, vec3f(0.2126, 0.7152, 0.0722));
}
