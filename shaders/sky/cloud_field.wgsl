// Density of the clouds at a point. Positions are in km in the frame of the field: x along the wind, y above the sea, z
// across the wind. Needs the module variables cloud_field, weather_map, cloud_noise_map and cloud_sampler.

// How far a point lies inside the clouds before noise roughens them, as a fraction of the layer's thickness; negative
// outside. The layer is that between the base and the base plus the thickness.
fn cloud_depth(p: vec3f) -> f32 {
  let high = textureSampleLevel(weather_map, cloud_sampler, p.xz * cloud_field.tiles_per_km, 0.0).r;
  let rise = (p.y - cloud_field.base_km) * cloud_field.layers_per_km;
  if cloud_field.kind == CLOUD_CIRRUS {
    return high - 2.0 * abs(rise - 0.5);
  }
  return high - rise;
}

// The same with the noise. `depth` is cloud_depth; `detail` is the share of the fine noise that is resolved, 0 to 1.
fn cloud_rough_depth(p: vec3f, depth: f32, detail: f32) -> f32 {
  if cloud_field.kind == CLOUD_CIRRUS {
    // Fibres are drawn out along the wind, and bent by the wind's shear.
    let bend = textureSampleLevel(cloud_noise_map, cloud_sampler, p * (0.25 * cloud_field.shapes_per_km), 0.0).b - 0.5;
    let q = vec3f(p.x * 0.125, p.y, p.z + 2.4 * bend) * cloud_field.shapes_per_km;
    let wide = textureSampleLevel(cloud_noise_map, cloud_sampler, q, 0.0).b;
    let r = vec3f(p.x * 0.0625, p.y, p.z + 1.2 * bend) * cloud_field.details_per_km;
    let fine = textureSampleLevel(cloud_noise_map, cloud_sampler, r, 0.0).b;
    return depth + 2.4 * (wide - 0.62) + detail * 1.3 * (fine - 0.5);
  }
  let shape = textureSampleLevel(cloud_noise_map, cloud_sampler, p * cloud_field.shapes_per_km, 0.0).r;
  var inside = depth + cloud_field.shape_amplitude * (shape - 0.5);
  if detail > 0.0 && inside > -0.5 * cloud_field.detail_amplitude && inside < 2.5 * cloud_field.detail_amplitude {
    let fine = textureSampleLevel(cloud_noise_map, cloud_sampler, p * cloud_field.details_per_km, 0.0).g;
    // Heads above, wisps at the base.
    let rise = (p.y - cloud_field.base_km) * cloud_field.layers_per_km;
    let heads = mix(0.9 - fine, fine, saturate(0.25 + 6.0 * rise));
    inside += detail * cloud_field.detail_amplitude * (heads - 0.45);
  }
  return inside;
}

// Fraction of the extinction inside dense cloud, 0 to 1. `inside` is cloud_rough_depth.
fn cloud_density_at(p: vec3f, inside: f32) -> f32 {
  let rise_km = p.y - cloud_field.base_km;
  return saturate(inside * cloud_field.sharpness) * saturate(rise_km * cloud_field.base_sharpness);
}

// Density without fine noise, for the light that reaches a point through the cloud.
fn cloud_coarse_density(p: vec3f) -> f32 {
  let depth = cloud_depth(p);
  if depth < -0.5 * cloud_field.shape_amplitude {
    return 0.0;
  }
  return cloud_density_at(p, cloud_rough_depth(p, depth, 0.0));
}

// Direction in the frame of the field, from one in the axes of the world.
fn cloud_turned(v: vec3f) -> vec3f {
  let w = cloud_field.downwind;
  return vec3f(dot(v.xz, w), v.y, dot(v.xz, vec2f(-w.y, w.x)));
}

// Distance, km, along a ray from the sea to the height `h` above it; `mu` is the sine of the ray's elevation.
fn cloud_distance_to(h: f32, mu: f32) -> f32 {
  let b = ATM_EARTH_RADIUS_KM * mu;
  let c = h * (2.0 * ATM_EARTH_RADIUS_KM + h);
  return c / (b + sqrt(b * b + c));
}
