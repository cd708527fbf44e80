// Look-up table of the transmittance from an altitude to the top of the air: elevation above the horizon by altitude.

@group(0) @binding(0) var<uniform> sky: Sky;
@group(0) @binding(1) var transmittance_out: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let at = vec2f(id.xy) / (ATM_TRANSMITTANCE_TABLE_SIZE - 1.0);
  let h = ATM_TOP_KM * at.y * at.y;
  let dip = atm_horizon_dip(h);
  let mu = sin(at.x * at.x * (0.5 * ATM_PI + dip) - dip);
  let far = atm_distance_to_top(h, mu);
  var depth = vec4f(0.0);
  const STEPS = 48;
  for (var i = 0; i < STEPS; i++) {
    // Steps grow with the distance, because the dense air is near.
    let a = f32(i) / f32(STEPS);
    let b = f32(i + 1) / f32(STEPS);
    let t = far * 0.5 * (a * a + b * b);
    depth += atm_medium(atm_altitude_along_ray(h, mu, t), sky.haze).extinction * (far * (b * b - a * a));
  }
  textureStore(transmittance_out, id.xy, exp(-depth));
}
