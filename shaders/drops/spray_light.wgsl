// The light of a puff of spray: sunlight and skylight that its drops scatter.

// Share of the sunlight that drops scatter forwards, and the asymmetry of that lobe; sunlight and skylight that leave a
// cloud of drops evenly, 1/sr; and the share of the light of the sky behind it that it scatters forwards.
const SPRAY_FORWARD_SHARE = 0.6;
const SPRAY_ASYMMETRY = 0.74;
const SPRAY_EVEN_SUN = 0.06;
const SPRAY_EVEN_SKY = 0.12;
const SPRAY_FORWARD_SKY = 0.7;
// Share of that lobe above the horizon, along a level ray (x), and its growth with the sine of the ray's elevation (y).
// The rest of the lobe holds the dark sea.
const SPRAY_LOBE_ABOVE = vec2f(0.5, 1.5);
// Mip level of the environment map at which its texels are as wide as that lobe, and the lowest row of it that is read,
// as a fraction of its height: rows below show the sea.
const SPRAY_SKY_LOD = 3.0;
const SPRAY_LOWEST_SKY = 0.05;

// Radiance of spray that the optical depth makes opaque, before the air in front of it. Drops scatter most of the light
// forwards, so spray takes on the light of the sky behind it, as far as that lobe lies above the horizon. The fraction
// `open` of the other light reaches it.
fn spray_radiance(dir: vec3f, place: vec2f, open: f32) -> vec3f {
  let sun = drop_sunlight(place);
  let forwards = SPRAY_FORWARD_SHARE * atm_henyey_greenstein(dot(dir, frame.sun_direction), SPRAY_ASYMMETRY);
  let behind_at = vec2f(sky_azimuth_turns(dir.xz), 0.5 + max(dir.y / ATM_PI, SPRAY_LOWEST_SKY));
  let behind = textureSampleLevel(environment_map, sky_sampler, behind_at, SPRAY_SKY_LOD).rgb;
  let even = sun * SPRAY_EVEN_SUN + light.sky_irradiance * SPRAY_EVEN_SKY;
  let above = saturate(SPRAY_LOBE_ABOVE.x + SPRAY_LOBE_ABOVE.y * dir.y);
  return open * even + sun * forwards + behind * (SPRAY_FORWARD_SKY * above);
}
