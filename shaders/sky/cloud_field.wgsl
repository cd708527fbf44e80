// Density of the clouds at a point. Positions are in km in the frame of the field: x along the wind, y above the sea, z
// across the wind. Needs the module variables cloud_field, weather_map, cloud_noise_map and cloud_sampler.

// Share of the noise's cuts that is left where a heap of cloud is thin.
const CLOUD_THIN_CUT = 0.3;
// Averaged over more than this share of its side, the fine noise is nearly even, and is not read.
const CLOUD_FINE_SHARE = 0.25;
// Mip levels by which the fine noise is sharper than the footprint: heaps of cloud that are smooth look like clay.
const CLOUD_FINE_SHARPER = 1.0;

// How far a point lies inside the clouds before noise roughens them, km (x), negative outside; how far it lies below
// their top, km (y); and the shift of the noise there, km (zw).
fn cloud_depth(p: vec3f) -> vec4f {
  let map = textureSampleLevel(weather_map, cloud_sampler, p.xz * cloud_field.tiles_per_km, 0.0);
  let rise = (p.y - cloud_field.base_km) * cloud_field.layers_per_km;
  let along = map.g * cloud_field.tiles_per_km;
  let room = map.r - rise;
  // Height above the surface over its steepness is the distance from the surface.
  let slope = sqrt(along * along + cloud_field.layers_per_km * cloud_field.layers_per_km);
  return vec4f(room / slope, room / cloud_field.layers_per_km, map.ba / cloud_field.shapes_per_km);
}

// The depth with the noise, averaged over `footprint_km`. `place` is cloud_depth.
fn cloud_rough_depth(at: vec3f, place: vec4f, footprint_km: f32) -> f32 {
  let depth = place.x;
  // Shifts hide that the noise repeats.
  let p = at + vec3f(place.z, 0.0, place.w);
  let lods = log2(footprint_km * vec2f(cloud_field.shapes_per_km, cloud_field.details_per_km))
    + log2(f32(textureDimensions(cloud_noise_map).x));
  let noise = textureSampleLevel(cloud_noise_map, cloud_sampler, p * cloud_field.shapes_per_km, lods.x).rgb;
  let shape = noise.r;
  // Few heads stand free of the cloud.
  let amplitude = cloud_field.shape_amplitude;
  let rise_km = p.y - cloud_field.base_km;
  // The edge of a heap bulges, but is not cut through: that would leave crumbs around it.
  let whole = mix(CLOUD_THIN_CUT, 1.0, saturate(2.0 * (place.y + rise_km) / amplitude));
  let bump = max(shape - 0.5, 0.0) + whole * min(shape - 0.5, 0.0);
  var inside = depth + amplitude * saturate(0.85 + 5.0 * depth / amplitude) * bump;
  var bump_km = cloud_field.base_bump_km * (2.0 * shape - 0.3);
  let is_near_edge = abs(min(inside, rise_km - bump_km)) < 2.0 * cloud_field.detail_amplitude;
  if is_near_edge && footprint_km * cloud_field.details_per_km < CLOUD_FINE_SHARE {
    // The wide noise bends the fine one, which tears its round heads.
    let bent = p * cloud_field.details_per_km + 0.7 * (noise.bgg - vec3f(0.5, 0.45, 0.45));
    let fine = textureSampleLevel(cloud_noise_map, cloud_sampler, bent, max(lods.y - CLOUD_FINE_SHARPER, 0.0)).g;
    // Heads above, wisps at the base.
    let heads = mix(0.9 - fine, fine, saturate(0.25 + 6.0 * rise_km * cloud_field.layers_per_km));
    inside += cloud_field.detail_amplitude * (heads - 0.45);
    bump_km += 0.4 * cloud_field.detail_amplitude * (fine - 0.45);
  }
  // The base is nearly flat. Tops of high heaps are crisp, low heaps and rims are thin.
  let deep = min(inside, (rise_km - bump_km) * (cloud_field.base_sharpness / cloud_field.sharpness));
  let heap = (place.y + rise_km) * cloud_field.layers_per_km;
  return select(deep, deep * mix(0.35, 1.8, smoothstep(0.03, 0.25, heap)), deep > 0.0);
}

// Density of a cloud, 0 to 1, at a depth that is counted in depths in which the cloud becomes dense. It rises slowly at
// first, because droplets evaporate at the edge.
fn cloud_edge(depth: f32) -> f32 {
  let x = saturate(depth);
  return x * x * (3.0 - 2.0 * x);
}

// Density at a point, with noise that is averaged over `footprint_km`, averaged over about `blur_km` in all.
fn cloud_density(p: vec3f, footprint_km: f32, blur_km: f32) -> f32 {
  let place = cloud_depth(p);
  let blur = 0.5 * blur_km;
  if place.x < -0.5 * cloud_field.shape_amplitude - blur {
    return 0.0;
  }
  let inside = cloud_rough_depth(p, place, footprint_km);
  return cloud_edge((inside + blur) / (2.0 * blur + 1.0 / cloud_field.sharpness));
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
