// Light of the land that the water before it mirrors.

// Tangent of the elevation above which no land is looked for.
const LAND_MIRROR_HIGHEST = 0.5;

// Replaces what the water mirrors by the land, where its rays meet land. `place` is that of the water in the frame of the
// coast, `height` its height, m. All rays that meet the land see the colour of the land that the middle one meets, or of the
// highest if that one passes over it.
fn land_mirrored(mirror: WaterMirror, place: vec2f, height: f32, rays: WaterMirroredRays) -> WaterMirror {
  let past = max(-place, place - land.side_m);
  let over_level = inverseSqrt(max(dot(rays.ray.xz, rays.ray.xz), 1e-4));
  let rise = rays.ray.y * over_level;
  let lowest = rise - 2.0 * rays.blur.y;
  if max(past.x, past.y) > LAND_LONGEST_RAY_M || lowest > LAND_MIRROR_HIGHEST {
    return mirror;
  }
  let toward = land_from_world(rays.ray.xz) * over_level;
  let horizon = land_horizon(place, height, toward, lowest, rise);
  var out = mirror;
  if horizon.rise > 0.0 {
    let sharp = inverseSqrt(rays.blur.y * rays.blur.y + 1e-6);
    let low = -rise * sharp;
    // Rays below the level, less than half of them, meet other waves. These are taken to mirror the land as often as the
    // rays above the level meet it.
    let below = maths_normal_cdf(low);
    let met = (maths_normal_cdf(low + horizon.rise * sharp) - below) / (1.0 - below);
    let at = place + toward * horizon.far_m;
    let size = 0.25 * horizon.far_m;
    let radiance = land_far_radiance(at, land_at(at, land_lod(size)), size);
    out.radiance = mix(mirror.radiance, (mirror.reflectance * material.sky_reflection) * radiance, met);
  }
  return out;
}
