// Size of the look-up table of the clear sky.
const SKY_VIEW_SIZE = vec2f(192.0, 128.0);
// Radiance of the night: 3e-4 cd/m^2, where the sun above the air gives 128 klx.
const SKY_NIGHT = vec3f(2.6e-8, 4.6e-8, 1.05e-7);

// What the sky's look-up tables are made for. Rust twin: render/sky.rs.
struct Sky {
  // Unit vector to the sun.
  sun: vec3f,
  // Aerosol relative to a clear day at sea.
  haze: f32,
  // The sun's colour and strength relative to ours from here, times `night_gain`.
  tint: vec3f,
  // Angular radius of its disc, rad.
  sun_radius: f32,
  // Irradiance of the sun that stands in the sky's file, on a plane that faces it.
  file_sun: vec3f,
  // 1 if a file stands for the sky, else 0.
  file: f32,
  // Irradiance on the horizontal of the rest of that sky.
  file_sky: vec3f,
  // From the file's numbers to radiance here.
  file_gain: f32,
  // Extinction, 1/m; where it begins, e-folding height above its top, height of its top, m.
  fog: vec4f,
  // Altitude that the sky is seen from, km, and the dip of its horizon.
  eye_km: f32,
  dip: f32,
  overcast: f32,
  // Exponent of the limb darkening.
  sun_falloff: f32,
  // Where the clouds have drifted, km along x and z; and where the mirrored ones have, in steps.
  drift: vec2f,
  mirror_drift: vec2f,
  // All light of the night is carried that many times brighter, so that half floats hold it; the exposure takes it back.
  night_gain: f32,
  // Heading of the middle of the file, turns.
  turn: f32,
}

// Light on the sea, worked out on the GPU whenever the sky changes.
struct Light {
  // Irradiance of the sun behind air, clouds and fog, on a plane that faces it.
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
  // Radiance that thick fog scatters from all around, and the sun's irradiance in it.
  fog_sky: vec3f,
  fog_sun: vec3f,
}

fn sky_luminance(c: vec3f) -> f32 {
  return dot(c, vec3f(0.2126, 0.7152, 0.0722));
}
