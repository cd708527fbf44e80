// Look-up table of the radiance of clear air as seen from the eye: azimuth from the sun by elevation above the horizon.
// Below the horizon it is the light of the air in front of the sea.

@group(0) @binding(0) var<uniform> sky: Sky;
@group(0) @binding(1) var transmittance_map: texture_2d<f32>;
@group(0) @binding(2) var multiple_map: texture_2d<f32>;
@group(0) @binding(3) var sky_sampler: sampler;
@group(0) @binding(4) var view_out: texture_storage_2d<rgba16float, write>;

// Brightness of the night sky relative to the zenith, at the elevation with sine `mu`. Airglow is brighter low in the
// sky, where the view passes through more of it. Rounding can make `mu` exceed 1.
fn view_night_sky_brightness(mu: f32) -> f32 {
  let low = saturate(1.0 - mu);
  return 1.0 + 1.2 * low * low * low;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let half_rows = SKY_VIEW_SIZE.y / 2.0;
  let y = f32(id.y);
  let upper = y >= half_rows;
  let s = select(half_rows - 1.0 - y, y - half_rows, upper) / (half_rows - 1.0);
  let h = sky.eye_height_km;
  let cos_azimuth = sky_view_azimuth_cosine(f32(id.x) / (SKY_VIEW_SIZE.x - 1.0));
  let above = select(-s * s * (0.5 * ATM_PI - sky.horizon_dip), s * s * (0.5 * ATM_PI + sky.horizon_dip), upper);
  let elevation = above - sky.horizon_dip;
  let mu = sin(elevation);
  let flat_sun = sqrt(max(1.0 - sky.sun_direction.y * sky.sun_direction.y, 0.0));
  let nu = cos(elevation) * cos_azimuth * flat_sun + mu * sky.sun_direction.y;
  var far = atm_distance_to_top(h, mu);
  if !upper {
    // Close to the horizon, rounding may make the ray miss the sea. Its lowest point is taken then.
    let ground = atm_distance_to_sea(h, mu);
    far = select((ATM_EARTH_RADIUS_KM + h) * max(-mu, 0.0), ground, ground >= 0.0);
  }
  let r = ATM_EARTH_RADIUS_KM + h;
  let rayleigh = atm_rayleigh_phase(nu);
  let mie = atm_aerosol_phase(nu);
  var through = vec4f(1.0);
  var radiance = vec4f(0.0);
  const STEPS = 40;
  for (var i = 0; i < STEPS; i++) {
    let a = f32(i) / f32(STEPS);
    let b = f32(i + 1) / f32(STEPS);
    let dt = far * (b * b - a * a);
    let t = far * (a * a + 0.4 * (b * b - a * a));
    let ht = atm_altitude_along_ray(h, mu, t);
    let mu_s = (r * sky.sun_direction.y + t * nu) / (ATM_EARTH_RADIUS_KM + ht);
    let m = atm_medium(ht, sky.haze);
    let lit = atm_transmittance(transmittance_map, sky_sampler, ht, mu_s, sky.sun_radius_rad);
    let more = atm_multiple_scattering(multiple_map, sky_sampler, ht, mu_s);
    let source = lit * (m.rayleigh * rayleigh + m.mie * mie) + more * (m.rayleigh + m.mie);
    let step = exp(-m.extinction * dt);
    radiance += through * source * (1.0 - step) / max(m.extinction, vec4f(1e-9));
    through *= step;
  }
  // Starlight and airglow of a moonless night, as blue as the dark-adapted eye sees them; darker below the horizon.
  let glow = SKY_NIGHT_RADIANCE * sky.night_gain * view_night_sky_brightness(mu) * select(0.3, 1.0, upper);
  textureStore(view_out, id.xy, vec4f(min(atm_linear_srgb(radiance) * sky.sun_tint + glow, vec3f(6e4)), 1.0));
}
