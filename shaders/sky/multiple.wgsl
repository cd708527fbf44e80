// Look-up table of light scattered more than once, as if isotropically (Hillaire 2020, section 5.5): the second order
// of scattering, times the geometric series of the higher orders.

@group(0) @binding(0) var<uniform> sky: Sky;
@group(0) @binding(1) var transmittance_map: texture_2d<f32>;
@group(0) @binding(2) var sky_sampler: sampler;
@group(0) @binding(3) var multiple_out: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let at = vec2f(id.xy) / (ATM_MULTIPLE_SCATTERING_TABLE_SIZE - 1.0);
  let x = 2.0 * at.x - 1.0;
  let mu_sun = x * abs(x);
  let h = ATM_TOP_KM * at.y * at.y;
  let r = ATM_EARTH_RADIUS_KM + h;
  let sun = vec3f(sqrt(max(1.0 - mu_sun * mu_sun, 0.0)), mu_sun, 0.0);
  var second = vec4f(0.0);
  var again = vec4f(0.0);
  const SIDE = 8;
  const STEPS = 20;
  for (var i = 0; i < SIDE * SIDE; i++) {
    let mu = 1.0 - 2.0 * (f32(i % SIDE) + 0.5) / f32(SIDE);
    let phi = 2.0 * ATM_PI * (f32(i / SIDE) + 0.5) / f32(SIDE);
    let across = sqrt(1.0 - mu * mu);
    let dir = vec3f(across * cos(phi), mu, across * sin(phi));
    let ground = atm_distance_to_sea(h, mu);
    let far = select(atm_distance_to_top(h, mu), ground, ground >= 0.0);
    let nu = dot(dir, sun);
    var through = vec4f(1.0);
    for (var k = 0; k < STEPS; k++) {
      let dt = far / f32(STEPS);
      let t = (f32(k) + 0.4) * dt;
      let ht = atm_altitude_along_ray(h, mu, t);
      let mu_s = (r * mu_sun + t * nu) / (ATM_EARTH_RADIUS_KM + ht);
      let m = atm_medium(ht, sky.haze);
      let step = exp(-m.extinction * dt);
      let scattering = m.rayleigh + m.mie;
      let share = through * (scattering / max(m.extinction, vec4f(1e-9))) * (1.0 - step);
      let sunlight = atm_transmittance(transmittance_map, sky_sampler, ht, mu_s, sky.sun_radius_rad);
      second += share * sunlight / (4.0 * ATM_PI);
      again += share;
      through *= step;
    }
    if ground >= 0.0 {
      let mu_s = (r * mu_sun + ground * nu) / ATM_EARTH_RADIUS_KM;
      let lit = atm_transmittance(transmittance_map, sky_sampler, 0.0, mu_s, sky.sun_radius_rad) * max(mu_s, 0.0);
      second += through * lit * (ATM_SEA_ALBEDO / ATM_PI);
    }
  }
  let n = f32(SIDE * SIDE);
  textureStore(multiple_out, id.xy, sqrt(second / n / (1.0 - again / n)));
}
