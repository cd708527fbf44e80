// The bed as a diving eye sees it, through water only.

// A ray's way from the eye to the bed.
struct FloorHit {
  length_m: f32,
  // Place (x, z) on the bed relative to the point below the eye, m, and the water's depth there, m.
  place: vec2f,
  column_m: f32,
  banks: vec2f,
}

// As floor_hit, over the bed of a coast. `run`: how far the ray goes for each metre down.
fn floor_hit_land(run: vec2f, down: f32, depth_m: f32) -> FloorHit {
  // Each step goes as far as the bed found before is below the eye, so that a bed that rises is not missed by much.
  var way_m = 0.0;
  for (var i = 0; i < 5; i++) {
    let clear_m = max(land_depth_m(run * way_m, 0.02 * way_m / down) - depth_m, 0.1);
    way_m = select(0.5 * (way_m + clear_m), clear_m, i == 0);
  }
  let at = run * way_m;
  return FloorHit(way_m / down, at, way_m + depth_m, bed_banks(at, frame.pixel_angle * way_m / (down * down)));
}

// Where a ray from an eye at the depth `depth_m` that goes down meets the bed.
fn floor_hit(dir: vec3f, depth_m: f32) -> FloorHit {
  let down = max(-dir.y, 0.02);
  let run = dir.xz / down;
  if WATER_LAND {
    return floor_hit_land(run, down, depth_m);
  }
  let clear_m = max(frame.depth_m - depth_m, 0.2);
  let size = frame.pixel_angle * clear_m / (down * down);
  // Banks and channels, where the ray would meet an even bed.
  let banks = bed_banks(run * clear_m, size);
  let column_m = max(frame.depth_m * max(1.0 + dot(BED_BANKS, banks), 0.4), depth_m + 0.25 * clear_m);
  let way_m = column_m - depth_m;
  return FloorHit(way_m / down, run * way_m, column_m, banks);
}

// Radiance of the bed where a ray meets it.
fn floor_radiance(hit: FloorHit, dir: vec3f) -> vec3f {
  let across = frame.pixel_angle * hit.length_m;
  let along = across / max(-dir.y, 0.05);
  let ahead = dir.xz * inverseSqrt(max(dot(dir.xz, dir.xz), 1e-6));
  let part = 0.71 * along;
  let texel = sqrt(part * max(part, across));
  var ground = bed_ground(hit.place, ahead * (0.354 * along), texel, hit.banks);
  if WATER_LAND && hit.column_m < BED_SHORE_M.y {
    ground = bed_shore_ground(ground, hit.place, hit.column_m, texel);
  }
  let beam = medium_beam();
  let beam_down = -beam.y;
  var sun = medium_sun_irradiance();
  if frame.sun_direction.y > 0.0 {
    let entry = hit.place - beam.xz * (hit.column_m / beam_down);
    let straight = exp(-0.25 * (material.scattering.g - material.backscatter.g) * hit.column_m / beam_down);
    let resolved = 1.0 - smoothstep(0.8, 3.0, texel / material.caustic_filter_m);
    let sharp = straight * resolved;
    if sharp > 0.01 {
      sun *= mix(1.0, bed_caustic_gain(entry, hit.column_m, material.caustic_filter_m), sharp);
    }
  }
  let axes = material.noise_layers[BED_RIPPLE_LAYER].uv_from_position;
  let tilt = BED_RIPPLE_TILE_M * dot(beam.xz, vec2f(axes[0].x, axes[1].x));
  sun *= max(1.0 + ground.slope * tilt / beam_down, 0.0);
  let daylight = sun + WATER_SKYLIGHT_TRANSMITTANCE * light.sky_irradiance;
  return daylight * exp(-material.diffuse_attenuation * hit.column_m) * ground.albedo / ATM_PI;
}
