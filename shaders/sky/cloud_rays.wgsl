// Sunlight that comes down between clouds. Distances are in km, in the frame of the clouds' field. Needs the functions
// of cloud_field.wgsl and of the sky model, and the module variables cloud_shadow_map and cloud_sampler.

// Number of places on a ray at which the sunlight on the air is read.
const RAY_AIR_SAMPLES = 8;

// Fraction of the sunlight that the clouds let through to a point below them, averaged over `size_km`. For a point among
// the clouds, it is the fraction where the sun's ray through the point meets their base.
fn ray_sunlit(p: vec3f, size_km: f32) -> f32 {
  let sun = cloud_turned(sky.sun_direction);
  let at_base = p.xz + sun.xz * ((cloud_field.base_km - p.y) / max(sun.y, SKY_LOWEST_BEAM));
  let texels_per_km = cloud_field.tiles_per_km * f32(textureDimensions(cloud_shadow_map).x);
  let lod = log2(max(size_km * texels_per_km, 1.0));
  return textureSampleLevel(cloud_shadow_map, cloud_sampler, at_base * cloud_field.tiles_per_km, lod).r;
}

// Position in the frame of the field at a distance along a ray from the sea.
fn ray_point(dir: vec3f, distance_km: f32) -> vec3f {
  let along = cloud_turned(dir) * distance_km;
  let altitude = atm_altitude_along_ray(0.0, dir.y, distance_km);
  return vec3f(cloud_field.eye_km.x + along.x, altitude, cloud_field.eye_km.y + along.z);
}

// Radiance that all the air on a ray would have, if it were lit like the part before the clouds or rain at `distance_km`.
// `opacity` is that of all the air on the ray. Shaded air has no glow around the sun, but the light of clear air beside
// it. On average, the sun lights at most the part light.cloud_gap_share.
fn ray_air_radiance(dir: vec3f, above: f32, distance_km: f32, opacity: vec3f) -> vec3f {
  var sum = 0.0;
  for (var i = 0; i < RAY_AIR_SAMPLES; i++) {
    let part = (f32(i) + 0.5) / f32(RAY_AIR_SAMPLES);
    sum += ray_sunlit(ray_point(dir, part * distance_km), 0.1 * distance_km);
  }
  let contrast = sum / (f32(RAY_AIR_SAMPLES) * max(light.cloud_sun_transmittance, 1e-6));
  let beside_sun = vec3f(-sky.sun_heading.y, dir.y, sky.sun_heading.x);
  let overcast = sky_overcast_radiance(above);
  let veil = sky.overcast * sky.overcast;
  let clear = mix(sky_clear_radiance(dir, above), overcast, veil);
  let diffuse = mix(sky_clear_radiance(beside_sun, above), overcast, veil);
  let deck = sky_overcast_horizon_radiance() * opacity;
  return sky_partly_shaded_air(clear, diffuse, deck, min(light.cloud_gap_share * contrast, 1.0));
}
