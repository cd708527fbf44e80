// Shafts of rain between clouds and sea, seen at a distance. Distances are in km, in the frame of the clouds' field.
// Needs the functions of cloud_field.wgsl and cloud_rays.wgsl.

// Whether shafts of rain are compiled in.
override CLOUD_SQUALLS: bool = false;

const SQUALL_STEPS = 48;
// Shafts beyond this distance are lost in the haze; nearer ones than the second pair fade, because rain at the eye is
// drawn elsewhere.
const SQUALL_FAR_KM = 70.0;
const SQUALL_NEAR_KM = vec2f(1.5, 5.0);
// Extinction coefficient of the densest shafts, 1/km, as in rain of 10 mm/h.
const SQUALL_EXTINCTION_PER_KM = 2.0;
// Distance by which falling rain lags behind its cloud for each km of fall: the difference of wind speeds at the cloud
// and below, divided by the fall speed.
const SQUALL_LAG = 1.1;
// Width over which the sunlight on shafts is averaged besides, km: shafts that are lit by single gaps would look torn.
const SQUALL_BLUR_KM = 0.5;
// Width of the edge of a shaft, in values of the noise.
const SQUALL_EDGE = 0.1;

// Density of rain at a point below the clouds, 0 to 1. All drops on a line of fall come from one place of the cloud.
fn squall_density(p: vec3f) -> f32 {
  let source = p.xz + vec2f(SQUALL_LAG * (cloud_field.base_km - p.y), 0.0);
  let wide_at = vec3f(source.x, 0.0, source.y) * (2.0 * cloud_field.tiles_per_km);
  let wide = textureSampleLevel(cloud_noise_map, cloud_sampler, wide_at, 0.0).b;
  let shaft = smoothstep(0.0, SQUALL_EDGE, wide - cloud_field.squall_edge);
  if shaft <= 0.0 {
    return 0.0;
  }
  let cloud = textureSampleLevel(weather_map, cloud_sampler, source * cloud_field.tiles_per_km, 0.0).r;
  let fine_at = vec3f(source.x, 0.4, source.y) * (16.0 * cloud_field.tiles_per_km);
  let fine = textureSampleLevel(cloud_noise_map, cloud_sampler, fine_at, 0.0).b;
  // Shafts come out of the bumps of the base gradually.
  let below = 1.0 - 0.85 * smoothstep(0.45, 1.0, p.y / cloud_field.base_km);
  return below * shaft * smoothstep(0.0, 0.2, cloud) * saturate(0.35 + 2.6 * (fine - 0.45));
}

// Shafts of rain on a ray.
struct SquallLight {
  // Fraction of the light behind them that they let through.
  transmittance: f32,
  // Mean distance of what is seen, km.
  distance_km: f32,
  // Fraction of the sunlight that the clouds let through to what is seen.
  sunlit: f32,
}

// Shafts on a ray from the sea up to the distance `near`, where the ray meets the clouds' base.
fn squall_march(dir: vec3f, near: f32) -> SquallLight {
  let far = min(near, SQUALL_FAR_KM);
  var depth = 0.0;
  var seen = 1e-6;
  var distance_sum = SQUALL_NEAR_KM.x * seen;
  var sunlit_sum = 0.0;
  var before = SQUALL_NEAR_KM.x;
  for (var i = 0; i < SQUALL_STEPS && before < far; i++) {
    // Steps grow with the distance.
    let next = min(before * 1.08 + 0.02, far);
    let t = 0.5 * (before + next);
    let p = ray_point(dir, t);
    let density = squall_density(p) * smoothstep(SQUALL_NEAR_KM.x, SQUALL_NEAR_KM.y, t);
    let share = density * (next - before) * exp(-SQUALL_EXTINCTION_PER_KM * depth);
    depth += density * (next - before);
    seen += share;
    distance_sum += share * t;
    if share > 0.0 {
      sunlit_sum += share * ray_sunlit(p, 0.5 * (next - before) + SQUALL_BLUR_KM);
    }
    before = next;
  }
  return SquallLight(exp(-SQUALL_EXTINCTION_PER_KM * depth), distance_sum / seen, sunlit_sum / seen);
}
