// Size of the look-up table of the clear sky, texels: azimuth by elevation.
const SKY_VIEW_SIZE = vec2f(192.0, 128.0);
// Night sky at the zenith, linear sRGB radiance: 3e-4 cd/m^2, where the sun above the air gives 128 klx.
const SKY_NIGHT_RADIANCE = vec3f(2.6e-8, 4.6e-8, 1.05e-7);

// The structs `Sky` and `Light` are declared in src/render/sky/uniform.rs.

fn sky_luminance(c: vec3f) -> f32 {
  return dot(c, vec3f(0.2126, 0.7152, 0.0722));
}
