// Radiance of the sky without clouds: clear air from the look-up table, and a uniform overcast. Needs the module
// variables sky, light, sky_view_map and sky_sampler.

// Radiance of clear air in a direction. `above` is the elevation above the visible horizon, rad.
fn sky_clear_radiance(dir: vec3f, above: f32) -> vec3f {
  let cos_azimuth = dot(normalize(dir.xz + vec2f(1e-9, 0.0)), sky.sun_heading);
  let half_rows = SKY_VIEW_SIZE.y / 2.0;
  let span = select(0.5 * ATM_PI - sky.horizon_dip, 0.5 * ATM_PI + sky.horizon_dip, above >= 0.0);
  let s = sqrt(min(abs(above) / span, 1.0)) * (half_rows - 1.0);
  let row = select(half_rows - 1.0 - s, half_rows + s, above >= 0.0);
  let column = atm_table_coordinate(sky_view_azimuth_coordinate(cos_azimuth), SKY_VIEW_SIZE.x);
  let uv = vec2f(column, (row + 0.5) / SKY_VIEW_SIZE.y);
  return textureSampleLevel(sky_view_map, sky_sampler, uv, 0.0).rgb;
}

// Fraction of the irradiance of sun and sky that a closed cloud deck transmits.
const SKY_OVERCAST_TRANSMITTANCE = 0.28;

// Radiance of an overcast sky at the elevation `above`, rad (Moon and Spencer 1942, CIE standard overcast sky).
fn sky_overcast_radiance(above: f32) -> vec3f {
  return light.overcast_zenith_radiance * (1.0 + 2.0 * sin(max(above, 0.0))) / 3.0;
}

// Radiance of an overcast sky at the horizon, and so of much air below it.
fn sky_overcast_horizon_radiance() -> vec3f {
  return light.overcast_zenith_radiance * (1.0 / 3.0);
}

// Irradiance of a horizontal plane by an overcast sky, divided by pi.
fn sky_deck_radiance() -> vec3f {
  return light.overcast_zenith_radiance * (7.0 / 9.0);
}

// Share of the sky that lights fog like an overcast one: where volumetric clouds close it, and the overcast.
fn sky_closed_share() -> f32 {
  let veil = sky.overcast * sky.overcast;
  if sky.has_cloud_dome > 0.0 {
    return mix(1.0, veil, light.cloud_gap_share);
  }
  return veil;
}

// Light that is left to air and sea in the shade of broken clouds, relative to clear air, and how grey it is: from 0, the
// colour of clear air, to 1.
const SKY_SHADED_AIR = 0.2;
const SKY_SHADED_GREY = 0.75;

// Light in the shade of broken clouds, where `clear` is the light between them: from clouds comes no blue of the sky.
fn sky_broken_shade(clear: vec3f) -> vec3f {
  return SKY_SHADED_AIR * mix(clear, vec3f(sky_luminance(clear)), SKY_SHADED_GREY);
}

// Radiance of air that the sun lights between clouds on the fraction `open` of its length. `clear` is that of clear air
// in the sun, `diffuse` that of air that only scattered light reaches, and `deck` that of air below a closed deck, which
// has no glow around the sun.
fn sky_partly_shaded_air(clear: vec3f, diffuse: vec3f, deck: vec3f, open: f32) -> vec3f {
  return mix(mix(deck, sky_broken_shade(diffuse), light.cloud_gap_share), clear, open);
}

// Mean radiance of the air below volumetric clouds, where clear air has the radiance `clear`, and air below a closed deck
// the radiance `deck`.
fn sky_shaded_air(clear: vec3f, deck: vec3f) -> vec3f {
  return sky_partly_shaded_air(clear, clear, deck, light.cloud_gap_share);
}

// Texture coordinates of a direction in a sky from a file. The image centre is the horizon at the heading
// `image_heading_turns`.
fn sky_image_uv(dir: vec3f) -> vec2f {
  let azimuth = sky_azimuth_turns(dir.xz);
  return vec2f(0.5 + azimuth - sky.image_heading_turns, 0.5 - atm_asin(dir.y) / ATM_PI);
}
