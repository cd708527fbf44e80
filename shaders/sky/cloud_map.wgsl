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

// Texture coordinates of a direction. `size` is that of the dome, texels.
fn cloud_map_uv(heading: vec2f, above: f32, size: vec2f) -> vec2f {
  return vec2f(sky_azimuth_turns(heading), atm_table_coordinate(cloud_map_rise(above), size.y));
}
