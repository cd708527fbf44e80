// White water that a yacht throws up: its opacity and its light.

// Smooth noise, 0 to 1, of one cell a unit.
fn hull_foam_noise(at: vec2f) -> f32 {
  let cell = floor(at);
  let part = at - cell;
  let share = part * part * (3.0 - 2.0 * part);
  let i = vec2i(cell);
  var corners: vec4f;
  for (var k = 0; k < 4; k++) {
    corners[k] = noise_pcg3d_unit(bitcast<vec3u>(vec3i(i + vec2i(k & 1, k >> 1u), 7))).x;
  }
  let rows = mix(corners.xz, corners.yw, share.x);
  return mix(rows.x, rows.y, share.y);
}

// White water that a yacht throws up (yacht_foam.rs), whose crest is torn. `pattern` is FoamCorner::pattern.
fn hull_foam(position: vec3f, pattern: vec3f, colour: vec3f) -> vec4f {
  let distance_m = length(position);
  let dir = position / distance_m;
  let at = vec2f(pattern.x, pattern.y * 0.6);
  let lumps = hull_foam_noise(at * 2.4);
  // A pixel averages drops that are smaller.
  let seen = saturate(1.5 - 21.0 * frame.pixel_angle * distance_m);
  let drops = mix(0.5, hull_foam_noise(at * 21.0 + 57.0), seen);
  let torn = 0.4 * lumps + 0.35 * hull_foam_noise(at * vec2f(7.0, 9.0) + 31.0) + 0.25 * drops;
  let thick = 1.25 * min(pattern.z, 1.0) - pattern.y * (0.4 + 0.6 * pattern.y);
  // The foot is foam, and the crest is torn to drops. One sees through between them.
  let left = thick - (0.45 + 0.75 * pattern.y) * torn;
  let opacity = smoothstep(-0.1, 0.4, left) * saturate(3.0 * pattern.z) * (1.0 - 0.45 * pattern.y);
  // Thick foam is lit from all sides, from above most, and its hollows are darker.
  let n = normalize(vec3f(-dir.x, 1.0, -dir.z));
  let sun = cloud_sun_irradiance() * (0.35 + 0.55 * max(dot(n, frame.sun_direction), 0.0));
  let surface = colour * (0.55 + 0.6 * lumps + 0.3 * torn) * (sun + 0.8 * light.sky_irradiance) / ATM_PI;
  let air = air_to_point(dir, distance_m);
  return vec4f(min(surface * air[1] + air[0], vec3f(6e4)) * opacity, opacity);
}
