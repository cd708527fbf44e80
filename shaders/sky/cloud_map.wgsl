// The dome of clouds (cloud_dome.wgsl): how it maps directions to texture coordinates.

// Coordinate from the horizon (0) to the zenith (1). Rows are dense near the horizon.
fn cloud_map_rise(above: f32) -> f32 {
  return sqrt(saturate(above / (0.5 * ATM_PI)));
}

// The inverse: elevation above the horizon, rad.
fn cloud_map_elevation(rise: f32) -> f32 {
  return rise * rise * (0.5 * ATM_PI);
}

// Change of the elevation, rad, with the coordinate.
fn cloud_map_step(above: f32) -> f32 {
  return ATM_PI * cloud_map_rise(above);
}

// Width of the columns ahead, divided by the width of even columns. Those behind are wider by as much.
const CLOUD_MAP_FOCUS = 0.35;

// Horizontal part of the directions at the coordinate `u` (xy), and the change of their heading with the coordinate, rad
// (z). `ahead` is the horizontal unit vector at which the columns are narrowest.
fn cloud_map_heading(u: f32, ahead: vec2f) -> vec3f {
  // The tangent of half the angle from `ahead` is CLOUD_MAP_FOCUS times that of `turn`.
  let turn = ATM_PI * (u - 0.5);
  let c = cos(turn);
  let s = CLOUD_MAP_FOCUS * sin(turn);
  let square = c * c + s * s;
  let along = (c * c - s * s) / square;
  let across = 2.0 * s * c / square;
  return vec3f(along * ahead + across * vec2f(-ahead.y, ahead.x), 2.0 * ATM_PI * CLOUD_MAP_FOCUS / square);
}

// Texture coordinates of a direction whose horizontal part is `heading`. `size` is that of the dome, texels.
fn cloud_map_uv(heading: vec2f, above: f32, size: vec2f, ahead: vec2f) -> vec2f {
  let across = dot(heading, vec2f(-ahead.y, ahead.x));
  let along = dot(heading, ahead);
  let reach = length(heading);
  // Two quotients for the tangent of half the angle from `ahead`: the first is accurate behind, the second ahead. There
  // the other one's numerator or denominator is a difference of nearly equal numbers. The tiny summand keeps directions
  // straight behind and straight up finite.
  let half = select((reach - along) / (across + 1e-20), across / (reach + along), along > 0.0);
  let turn = atan(half / CLOUD_MAP_FOCUS);
  return vec2f(turn / ATM_PI + 0.5, atm_table_coordinate(cloud_map_rise(above), size.y));
}
