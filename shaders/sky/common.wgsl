// Size of the look-up table of the clear sky, texels: azimuth by elevation.
const SKY_VIEW_SIZE = vec2f(192.0, 128.0);

// Coordinate along the rows of that table, 0 to 1, of an azimuth from the sun with the given cosine: the root of the
// sine of half the azimuth. Columns lie closest at the sun.
fn sky_view_azimuth_coordinate(cosine: f32) -> f32 {
  return sqrt(sqrt(max(0.5 - 0.5 * cosine, 0.0)));
}

// Azimuth of a direction, clockwise from north, in turns of 360 degrees, and 0 for the zenith: on some GPUs, atan2(0, 0)
// is NaN. `heading` is the direction's horizontal part, east (x) and south (y).
fn sky_azimuth_turns(heading: vec2f) -> f32 {
  return atan2(heading.x, select(-heading.y, 1.0, max(abs(heading.x), abs(heading.y)) < 1e-30)) * 0.15915494309;
}

// The inverse: cosine of the azimuth from the sun at a coordinate.
fn sky_view_azimuth_cosine(u: f32) -> f32 {
  let sine = u * u;
  return 1.0 - 2.0 * sine * sine;
}

// Night sky at the zenith, linear sRGB radiance: 3e-4 cd/m^2, where the sun above the air gives 128 klx.
const SKY_NIGHT_RADIANCE = vec3f(2.6e-8, 4.6e-8, 1.05e-7);

// The structs `Sky` and `Light` are declared in src/render/sky/uniform.rs.

fn sky_luminance(c: vec3f) -> f32 {
  return dot(c, vec3f(0.2126, 0.7152, 0.0722));
}

// Sine of the sun's elevation below which its beams pass between clouds as from this one: the reciprocal of
// `LONGEST_SHADOW` in src/render/sky/cloud_field.rs.
const SKY_LOWEST_BEAM = 1.0 / 12.0;
