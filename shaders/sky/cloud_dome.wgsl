// Fills rows of a dome with clouds as seen from the sea: the light that they and the air before them add (rgb), and the
// fraction of the light behind them that they let through (a). Distances are in km.

@group(0) @binding(0) var<uniform> cloud_field: CloudField;
@group(0) @binding(1) var<uniform> sky: Sky;
@group(0) @binding(2) var<storage, read> light: Light;
@group(0) @binding(3) var sky_view_map: texture_2d<f32>;
@group(0) @binding(4) var transmittance_map: texture_2d<f32>;
@group(0) @binding(5) var sky_sampler: sampler;
@group(0) @binding(6) var weather_map: texture_2d<f32>;
@group(0) @binding(7) var cloud_noise_map: texture_3d<f32>;
@group(0) @binding(8) var cloud_sampler: sampler;
@group(0) @binding(9) var cloud_shadow_map: texture_2d<f32>;
@group(0) @binding(10) var dome_out: texture_storage_2d_array<rgba16float, write>;

const DOME_MOST_STEPS = 270;
// Clouds beyond this distance are lost in the haze.
const DOME_FAR_KM = 140.0;
// Transmittance below which a ray ends.
const DOME_LEAST_TRANSMITTANCE = 0.01;

struct DomeLight {
  // Factors on the light of sun, sky and sea.
  sun: f32,
  sky: f32,
  sea: f32,
  transmittance: f32,
  // Mean distance of what is seen, km.
  distance_km: f32,
}

fn dome_march(dir: vec3f, near: f32, far: f32, texel_rad: f32) -> DomeLight {
  let ray = cloud_turned(dir);
  let sun = cloud_turned(sky.sun_direction);
  let phase = dome_phase(dot(dir, sky.sun_direction));
  var out = DomeLight(0.0, 0.0, 0.0, 1.0, near);
  var seen = 1e-6;
  var distance_sum = near * seen;
  var t = near;
  // Depth in the cloud at the last point of the ray, distance between that point and this one, and the light of the
  // cloud at the last point inside it.
  var last_inside = -1.0;
  var way = 0.0;
  var lit = vec3f(0.0);
  for (var i = 0; i < DOME_MOST_STEPS; i++) {
    if t >= far || out.transmittance < DOME_LEAST_TRANSMITTANCE {
      break;
    }
    let p = ray_point(dir, t);
    let finest = max(cloud_field.step_km, 0.0024 * t);
    let place = cloud_depth(p);
    let depth = place.x;
    // Noise that is finer than the dome's texels or a step fades to its mean: else it would leave grain.
    let footprint_km = max(texel_rad * t, finest);
    var inside = depth;
    if depth > -0.5 * cloud_field.shape_amplitude {
      inside = cloud_rough_depth(p, place, footprint_km);
    } else {
      inside += 0.45 * cloud_field.shape_amplitude;
    }
    // The depth is taken to change evenly on the way from the last point. So a ray meets the same amount of cloud
    // wherever its points happen to lie: else thin edges would look like fur.
    let deeper = max(inside, last_inside);
    let lower = min(inside, last_inside);
    let in_cloud = way * (deeper / max(deeper - min(lower, 0.0), 1e-6));
    if inside > 0.0 && last_inside <= 0.0 && in_cloud > 1.2 * finest {
      // A long step has led deep into a cloud: back to its surface.
      t -= in_cloud;
      way -= in_cloud;
      continue;
    }
    if deeper > 0.0 && way > 0.0 {
      let middle = 0.5 * (deeper + max(lower, 0.0));
      let density = cloud_edge(middle * cloud_field.sharpness);
      if density > 0.002 {
        if inside > 0.0 {
          lit = dome_lit(p - (0.5 * in_cloud) * ray, place, middle, footprint_km, sun, phase);
        }
        let passed = exp(-density * cloud_field.extinction_per_km * in_cloud);
        let share = out.transmittance * (1.0 - passed);
        out.sun += share * lit.x;
        out.sky += share * lit.y;
        out.sea += share * lit.z;
        seen += share;
        distance_sum += share * t;
        out.transmittance *= passed;
      }
    }
    last_inside = inside;
    let hidden = 1.0 - out.transmittance;
    way = finest * (1.0 + 4.0 * hidden * hidden);
    if inside <= 0.0 {
      // Nothing lies much nearer than the depth.
      way = clamp(-inside * cloud_field.stride, 0.7 * finest, 20.0 * finest + 0.02 * t);
    }
    t += way;
  }
  if out.transmittance < DOME_LEAST_TRANSMITTANCE {
    out.transmittance = 0.0;
  }
  out.distance_km = distance_sum / seen;
  return out;
}

// Transmittance of the air from the sea up along a ray to the distance t, linear sRGB.
fn dome_air_transmittance(mu: f32, t: f32) -> vec3f {
  let h = atm_altitude_along_ray(0.0, mu, t);
  let there = (ATM_EARTH_RADIUS_KM * mu + t) / (ATM_EARTH_RADIUS_KM + h);
  let whole = atm_transmittance(transmittance_map, sky_sampler, 0.0, mu, 1e-4);
  let beyond = atm_transmittance(transmittance_map, sky_sampler, h, there, 1e-4);
  return atm_linear_srgb(whole / max(beyond, vec4f(1e-6))) * ATM_INVERSE_SUN;
}

// The clouds `behind` in a direction, behind shafts of rain in the shade below the clouds.
fn dome_behind_squalls(behind: vec4f, dir: vec3f, above: f32, near: f32) -> vec4f {
  let shafts = squall_march(dir, near);
  if shafts.transmittance > 0.999 {
    return behind;
  }
  let veil = sky.overcast * sky.overcast;
  let deck = sky_deck_radiance();
  let clear = mix(light.clear_sky_irradiance / ATM_PI, deck, veil);
  // Drops turn sunlight forwards and into the rainbow, where it falls on them between the clouds.
  let turned = dot(dir, sky.sun_direction);
  // The share of the bow is half of what the shaft hides, as in air_rainbow.
  let phase = atm_henyey_greenstein(turned, 0.7) + 0.5 * rainbow_phase(turned);
  let shade = mix(0.07, 0.3, light.cloud_gap_share);
  let lit = atm_transmittance(transmittance_map, sky_sampler, 0.0, sky.sun_direction.y, sky.sun_radius_rad);
  let between = shafts.sunlit * pow(1.0 - sky.overcast, 1.5);
  let sun = atm_linear_srgb(lit) * sky.sun_tint * (between * phase);
  let grey = mix(clear, vec3f(sky_luminance(clear)), 0.6);
  let air = dome_air_transmittance(dir.y, shafts.distance_km);
  let whole = dome_air_transmittance(dir.y, 1e3);
  let hazed = saturate((1.0 - air) / max(1.0 - whole, vec3f(1e-3)));
  let before = ray_air_radiance(dir, above, shafts.distance_km, 1.0 - whole) * (0.5 * hazed);
  let own = (grey * shade + sun) * air + before;
  let through = shafts.transmittance;
  return vec4f(behind.rgb * through + own * (1.0 - through), behind.a * through);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(dome_out);
  let row = cloud_field.first_row + id.y * cloud_field.row_step;
  if id.x >= size.x || row >= size.y {
    return;
  }
  let above = max(cloud_map_elevation(f32(row) / f32(size.y - 1u)), 5e-4);
  let heading = cloud_map_heading((f32(id.x) + 0.5) / f32(size.x), cloud_field.ahead);
  let dir = vec3f(heading.x * cos(above), sin(above), heading.y * cos(above));
  let near = cloud_distance_to(cloud_field.base_km, dir.y);
  let far = min(cloud_distance_to(cloud_field.base_km + 1.0 / cloud_field.layers_per_km, dir.y), DOME_FAR_KM);
  var out = vec4f(0.0, 0.0, 0.0, 1.0);
  let is_ice = cloud_field.kind == CLOUD_CIRRUS;
  if near < far || is_ice {
    let column = heading.z / f32(size.x);
    let texel = vec2f(column, cloud_map_step(above) / f32(size.y));
    var seen: DomeLight;
    if is_ice {
      seen = dome_cirrus(dir, texel);
    } else {
      seen = dome_march(dir, near, far, sqrt(texel.x * max(cos(above), 0.0) * texel.y));
    }
    if seen.transmittance < 0.999 {
      let h = atm_altitude_along_ray(0.0, dir.y, seen.distance_km);
      let nu = dot(dir, sky.sun_direction);
      let mu_sun = (ATM_EARTH_RADIUS_KM * sky.sun_direction.y + seen.distance_km * nu) / (ATM_EARTH_RADIUS_KM + h);
      let lit = atm_transmittance(transmittance_map, sky_sampler, h, mu_sun, sky.sun_radius_rad);
      let veil = sky.overcast * sky.overcast;
      let sun = atm_linear_srgb(lit) * sky.sun_tint * pow(1.0 - sky.overcast, 1.5);
      let deck = sky_deck_radiance();
      let from_sky = mix(light.clear_sky_irradiance / ATM_PI, deck, veil);
      // The sea and the low air return little of the light that falls on them between the clouds.
      let on_sea = ATM_PI * from_sky + sun * max(sky.sun_direction.y, 0.0);
      let lit_sea = on_sea * (ATM_SEA_ALBEDO / ATM_PI) + 0.35 * from_sky;
      let from_sea = mix(sky_broken_shade(lit_sea), lit_sea, light.cloud_gap_share);
      // Deep in a cloud, the light from above is that of sky and sun together. All of it enters a storm deck, which
      // makes it grey, as an overcast sky does; a heap of cloud loses most of the sunlight through its sides.
      var from_above = from_sky + sun * (DOME_SUN_IN_DEPTH * max(sky.sun_direction.y, 0.0) / ATM_PI);
      if cloud_field.kind == CLOUD_STORM {
        from_above = deck / mix(SKY_OVERCAST_TRANSMITTANCE, 1.0, veil);
      }
      let radiance = seen.sun * sun + seen.sky * from_above + seen.sea * from_sea;
      let air = dome_air_transmittance(dir.y, seen.distance_km);
      let whole = dome_air_transmittance(dir.y, 1e3);
      let hazed = (1.0 - air) / max(1.0 - whole, vec3f(1e-3));
      let whole_air = ray_air_radiance(dir, above, seen.distance_km, 1.0 - whole);
      let before = whole_air * saturate(hazed) * (1.0 - seen.transmittance);
      out = vec4f(radiance * air + before, seen.transmittance);
    }
  }
  if CLOUD_SQUALLS {
    out = dome_behind_squalls(out, dir, above, near);
  }
  textureStore(dome_out, vec2u(id.x, row), cloud_field.layer, vec4f(min(out.rgb, vec3f(6e4)), out.a));
}
