// Radiance of the sky with clouds: a flat layer of noise, or the dome of volumetric clouds (cloud_dome.wgsl). Needs the
// module variables of the sky model, clouds, dome_map, noise_map and noise_sampler.

// Height of the cloud base, km, and side of the repeating noise tile on it, km.
const SKY_CLOUD_BASE_KM = 1.1;
const SKY_CLOUD_TILE_KM = 34.0;

// Whether the flat layer of noise and the dome of volumetric clouds are compiled in.
override SKY_CLOUDS = true;
override SKY_CLOUD_DOME = true;

// Clouds of the dome in one of its layers, whose columns are narrowest at `ahead`. They have moved by `shift`, km, since
// it was filled; the height of the clouds stands for all of their parts.
fn sky_shifted_dome(dir: vec3f, above: f32, shift: vec2f, ahead: vec2f, layer: u32) -> vec4f {
  let s = sin(above);
  let r = ATM_EARTH_RADIUS_KM;
  let h = clouds.height_km;
  let t = sqrt(r * r * s * s + h * (2.0 * r + h)) - r * s;
  let now = normalize(dir.xz + vec2f(1e-9, 0.0)) * (t * cos(above));
  let then = now - shift;
  let square = dot(then, then);
  let rise = t * s - (square - dot(now, now)) / (2.0 * r);
  let uv = cloud_map_uv(then, atan2(rise, sqrt(square)), vec2f(textureDimensions(dome_map)), ahead);
  return textureSampleLevel(dome_map, sky_sampler, uv, layer, 0.0);
}

// The light that the volumetric clouds add (rgb) and the fraction of the light behind them that they let through (a).
fn sky_cloud_dome(dir: vec3f, above: f32) -> vec4f {
  let newest = sky_shifted_dome(dir, above, clouds.new_shift_km, clouds.new_ahead, clouds.new_layer);
  if clouds.old_share <= 0.0 {
    return newest;
  }
  let old = sky_shifted_dome(dir, above, clouds.old_shift_km, clouds.old_ahead, clouds.old_layer);
  return mix(newest, old, clouds.old_share);
}

// Fractal noise of the clouds, 0 to 1, at the point p of the cloud base, km. `lod` is the mip level of the noise map.
fn sky_cloud_noise(p: vec2f, lod: f32) -> f32 {
  let turned = vec2f(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y);
  let a = textureSampleLevel(noise_map, noise_sampler, p / SKY_CLOUD_TILE_KM, 0, lod).b;
  let uv_b = turned / (0.27 * SKY_CLOUD_TILE_KM) + vec2f(0.37, 0.11);
  let b = textureSampleLevel(noise_map, noise_sampler, uv_b, 0, lod + 1.89).b;
  let c = textureSampleLevel(noise_map, noise_sampler, p.yx / (0.083 * SKY_CLOUD_TILE_KM), 0, lod + 3.6).b;
  return a * 0.54 + b * 0.29 + c * 0.17;
}

// Radiance of the sky with clouds, seen from near the sea (rgb), and the visible fraction of the sun's disc (w).
// `pixel` is the angle that is filtered over, rad; `drift` is the distance that the clouds have drifted, km.
fn sky_radiance(dir: vec3f, above: f32, pixel: f32, drift: vec2f) -> vec4f {
  let clear = sky_clear_radiance(dir, above);
  let o = sky.overcast;
  if SKY_CLOUD_DOME && sky.has_cloud_dome > 0.0 {
    let dome = sky_cloud_dome(dir, above);
    return vec4f(mix(clear, sky_overcast_radiance(above), o * o) * dome.a + dome.rgb, dome.a);
  }
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
