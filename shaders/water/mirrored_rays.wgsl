// The rays that the eye sees reflected by a piece of rough water.

struct WaterMirroredRays {
  // Mean direction; it points upwards.
  ray: vec3f,
  // Standard deviations of the rays across and in height, as tangents.
  blur: vec2f,
}

// The reflected rays of the facets of `slope` that are seen from the direction `v`.
fn water_mirrored_rays(v: vec3f, slope: WaterSlope) -> WaterMirroredRays {
  let eye = water_facets_towards(v, slope);
  let low = -(eye.tilt.height / eye.tilt.across + eye.tilt.mean) / eye.tilt.sigma;
  let tilts = water_visible_tilts(low);
  let per_tilt = -(eye.tilt.toward * eye.tilt.sigma + eye.side * eye.tilt_side_shear);
  let n = water_normal(slope.mean + tilts.x * per_tilt);
  let cosine = max(dot(v, n), 0.01);
  var ray = 2.0 * cosine * n - v;
  ray.y = max(ray.y, 0.003);
  let over_level = inverseSqrt(max(dot(ray.xz, ray.xz), 1e-4));
  let rise = ray.y * over_level;
  let side_variance = max(eye.side_sigma * eye.side_sigma - eye.tilt_side_shear * eye.tilt_side_shear, 1e-8);
  let blur = 2.0 * vec2f(
    cosine * over_level * sqrt(side_variance), (1.0 + rise * rise) * tilts.y * eye.tilt.sigma);
  return WaterMirroredRays(ray, blur);
}
