// Radiance of the sky in a direction: clear air from the look-up table, and clouds. Needs the module variables sky,
// light, sky_view_map, sky_sampler, noise_map and noise_sampler.

// Height of the cloud base, km, and side of the repeating noise tile on it, km.
const SKY_CLOUD_BASE_KM = 1.1;
const SKY_CLOUD_TILE_KM = 34.0;

// Whether clouds are compiled in.
override SKY_CLOUDS = true;

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

// Radiance of an overcast sky at the elevation `above`, rad (Moon and Spencer 1942, CIE standard overcast sky).
fn sky_overcast_radiance(above: f32) -> vec3f {
  return light.overcast_zenith_radiance * (1.0 + 2.0 * sin(max(above, 0.0))) / 3.0;
}

// Fractal noise of the clouds, 0 to 1, at the point p of the cloud base, km. `lod` is the mip level of the noise map.
fn sky_cloud_noise(p: vec2f, lod: f32) -> f32 {
  let turned = vec2f(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y);
  let a = textureSampleLevel(noise_map, noise_sampler, p / SKY_CLOUD_TILE_KM, lod).b;
  let uv_b = turned / (0.27 * SKY_CLOUD_TILE_KM) + vec2f(0.37, 0.11);
  let b = textureSampleLevel(noise_map, noise_sampler, uv_b, lod + 1.89).b;
  let c = textureSampleLevel(noise_map, noise_sampler, p.yx / (0.083 * SKY_CLOUD_TILE_KM), lod + 3.6).b;
  return a * 0.54 + b * 0.29 + c * 0.17;
}

// Radiance of the sky with clouds, seen from near the sea (rgb), and the visible fraction of the sun's disc (w).
// `pixel` is the angle that is filtered over, rad; `drift` is the distance that the clouds have drifted, km.
fn sky_radiance(dir: vec3f, above: f32, pixel: f32, drift: vec2f) -> vec4f {
  let clear = sky_clear_radiance(dir, above);
  let o = sky.overcast;
  if !SKY_CLOUDS || o <= 0.0 || above < 0.0 {
    let air = mix(clear, sky_overcast_radiance(above), o * o);
    return vec4f(select(air, clear, o <= 0.0), 1.0);
  }
  let s = sin(above);
  let r = ATM_EARTH_RADIUS_KM;
  let t = sqrt(r * r * s * s + 2.0 * r * SKY_CLOUD_BASE_KM) - r * s;
  let p = normalize(dir.xz + vec2f(1e-9, 0.0)) * (t * cos(above)) - drift;
  // A pixel's footprint is foreshortened. The geometric mean of its sides avoids both blur and shimmer.
  let footprint = t * pixel / sqrt(max(s, SKY_CLOUD_BASE_KM / t));
  let lod = log2(max(footprint * 512.0 / SKY_CLOUD_TILE_KM, 1e-3));
  let n = sky_cloud_noise(p, lod);
  // Few clouds are only the peaks of the noise; a full deck is all of it.
  let low = mix(0.82, -0.05, o);
  let cover = smoothstep(low, low + 0.22, n);
  let thick = saturate((n - low) / 0.75);
  // Sunlight through the thin edge of a cloud, and an underside that fades from lit to grey as the cloud thickens.
  let nu = dot(dir, sky.sun_direction);
  let glow = light.sun_irradiance * (0.35 * atm_aerosol_phase(nu)) * (1.0 - thick) * (1.0 - thick) * (1.0 - o);
  let lit = (light.sky_irradiance + light.sun_irradiance * max(sky.sun_direction.y, 0.05)) * (0.85 / ATM_PI);
  let deck = sky_overcast_radiance(above) * mix(1.6, 0.42, smoothstep(0.28, 0.72, n));
  let body = mix(mix(lit, deck, smoothstep(0.0, 0.7, thick)), deck, o * o) + glow;
  let base = mix(clear, sky_overcast_radiance(above), o * o);
  let shown = cover * exp(-t / 38.0);
  let air = mix(base, mix(clear, sky_overcast_radiance(above), o), cover);
  return vec4f(mix(air, body, shown), pow(1.0 - cover, 6.0));
}

// Texture coordinates of a direction in a sky from a file. The image centre is the horizon at the heading
// `image_heading_turns`.
fn sky_image_uv(dir: vec3f) -> vec2f {
  let azimuth = atan2(dir.x, -dir.z) / (2.0 * ATM_PI);
  return vec2f(0.5 + azimuth - sky.image_heading_turns, 0.5 - atm_asin(dir.y) / ATM_PI);
}
