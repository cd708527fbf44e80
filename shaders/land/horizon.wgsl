// The land that rises before a point: it shades land and water, and the water mirrors it.

// Number of steps of a level ray over the map. Their lengths grow with the distance, like odd numbers.
const LAND_RAY_STEPS = 11;
// Height, m, above which no land is looked for, and the length of the longest ray, m.
const LAND_HIGHEST_M = 40.0;
const LAND_LONGEST_RAY_M = 500.0;
// Half the width of the penumbra as a tangent: that of the sun, softened, and what the steps do not resolve.
const LAND_PENUMBRA = 0.022;

// The highest land in one direction.
struct LandHorizon {
  // Tangent of its elevation; 0 if no land rises there.
  rise: f32,
  // Distance, m, of the first land that rises as high as the ray, or else of the highest.
  far_m: f32,
}

// The highest land before a place in the frame of the coast, at the height `height`, in the direction `toward`. Rays whose
// elevation has the tangent `rise` and more are to be compared with it; the ray itself has the tangent `aim`. Beyond the map
// its edge goes on.
fn land_horizon(place: vec2f, height: f32, toward: vec2f, rise: f32, aim: f32) -> LandHorizon {
  let reach_m = min(LAND_HIGHEST_M / max(rise, 1e-3), LAND_LONGEST_RAY_M);
  let part_m = reach_m * (1.0 / f32(LAND_RAY_STEPS * LAND_RAY_STEPS));
  let start = place * land.uv_per_m + land.uv_start;
  let along = toward * land.uv_per_m;
  let longer_m = 2.0 * part_m;
  // Texels are as wide as a quarter of a step.
  let lod_from_step = land.log_texels_per_m - 2.0;
  var far_m = 0.0;
  var step_m = part_m;
  var before = 0.0;
  var here = 0.0;
  var out = LandHorizon(0.0, 1.0);
  for (var i = 0; i < LAND_RAY_STEPS; i++) {
    far_m += step_m;
    let lod = max(log2(step_m) + lod_from_step, 0.0);
    let ground = textureSampleLevel(land_map, noise_sampler, saturate(start + along * far_m), lod).x;
    let after = max(ground - height, 0.0) / far_m;
    // A peak between three steps is that of a parabola.
    let fall = before - after;
    let bend = max(2.0 * here - before - after, 1e-6);
    let top = max(after, select(0.0, here + fall * fall / (8.0 * bend), here > max(before, after)));
    if top > out.rise {
      out = LandHorizon(top, select(far_m, out.far_m, out.rise > aim));
    }
    before = here;
    here = after;
    step_m += longer_m;
  }
  return out;
}

// Fraction of the sun's disc that the land leaves visible from a place in the frame of the coast.
fn land_visible_sun(place: vec2f, height: f32) -> f32 {
  let l = frame.sun_direction;
  let over_across = inverseSqrt(max(dot(l.xz, l.xz), 1e-6));
  let rise = max(l.y, 0.0) * over_across;
  let horizon = land_horizon(place, height, land_from_world(l.xz) * over_across, rise - LAND_PENUMBRA, rise);
  return maths_smooth(0.5 + (rise - horizon.rise) * (0.5 / LAND_PENUMBRA));
}

// Radiance of the ground at a place in the frame of the coast, as seen from far away. `map` is that of
// land_at over texels of `size` metres.
fn land_far_radiance(place: vec2f, map: vec4f, size: f32) -> vec3f {
  let tilt = land_to_world(map.yz);
  let up = inverseSqrt(1.0 + dot(tilt, tilt));
  let cosine = max(dot(vec3f(-tilt.x, 1.0, -tilt.y), frame.sun_direction), 0.0) * up;
  let irradiance = cloud_sun_irradiance() * cosine + (0.5 + 0.5 * up) * light.sky_irradiance;
  return land_mean_albedo(place, map, size) * irradiance * (1.0 / ATM_PI);
}
