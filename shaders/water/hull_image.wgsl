// Mirror images of floating objects in the water, and their shadows on it. Each object is replaced by a stack of ellipses
// (src/render/water/hull_images.rs); from any side the stack looks like trapezoids on each other.

@group(0) @binding(14) var<uniform> hull_images: HullImages;

// Fraction of the light that the sea reflects up to the side of a hull.
const HULL_IMAGE_SEA_REFLECTANCE = vec3f(0.03, 0.05, 0.06);
// Blur of the edges of a shadow: the radius of the sun's disc, as a tangent.
const HULL_IMAGE_SUN_BLUR = 0.0047;

// Distance, m, over which a section is faded out as it comes to lie behind the place from which the rays start.
const HULL_IMAGE_BEHIND_M = 0.5;

// Light that reaches the two paints of a side: straight, and through a sail from behind.
struct HullImageLight {
  front: vec3f,
  behind: vec3f,
}

fn hull_image_light(hull: u32, toward: vec2f) -> HullImageLight {
  let ahead = hull_images.hulls[hull].ahead;
  let starboard = vec2f(-ahead.y, ahead.x);
  let side = starboard * select(1.0, -1.0, dot(starboard, toward) > 0.0);
  let normal = mix(side, -toward, hull_images.hulls[hull].roundness);
  let cosine = dot(normal, frame.sun_direction.xz);
  let sun = cloud_sun_irradiance();
  let from_sea = HULL_IMAGE_SEA_REFLECTANCE * (light.sky_irradiance + sun * max(frame.sun_direction.y, 0.0));
  let change = scene_skylight_change(vec3f(normal.x, 0.0, normal.y));
  let front = 0.5 * ((1.0 + change) * light.sky_irradiance + from_sea);
  let behind = 0.5 * ((1.0 - change) * light.sky_irradiance + from_sea);
  return HullImageLight(sun * max(cosine, 0.0) + front, sun * max(-cosine, 0.0) + behind);
}

// The fraction of a bundle of rays from the point `place` that a hull stops (w), and that fraction times the hull's
// radiance (xyz). `place` has x and z relative to the point below the eye, and the height above the still
// water. `blur` is the standard deviation of the rays across and in height, as tangents; `pixel_m` is the size of a
// pixel there. A sail lets light through if `through` is 1.
fn hull_image_met(
  hull: u32, place: vec3f, ray: vec3f, blur: vec2f, pixel_m: f32, through: f32,
) -> vec4f {
  let over_level = inverseSqrt(max(dot(ray.xz, ray.xz), 1e-6));
  let toward = ray.xz * over_level;
  let across = vec2f(-toward.y, toward.x);
  let rise = ray.y * over_level;
  let ahead = hull_images.hulls[hull].ahead;
  let starboard = vec2f(-ahead.y, ahead.x);
  let seen = vec2f(dot(ahead, across), dot(starboard, across));
  let deep = vec2f(dot(ahead, toward), dot(starboard, toward));
  let irradiance = hull_image_light(hull, toward);
  let pixel = 0.5 * pixel_m / max(dot(hull_images.hulls[hull].origin.xz - place.xz, toward), 1.0);
  let sharp = inverseSqrt(blur * blur + pixel * pixel);
  var sum = vec4f(0.0);
  // Middle (x) and half width (y) of the lower section as seen from `place`, its height (z), and the share of the rays
  // that pass below it (w).
  var low = vec4f(0.0);
  // Distance to the far end of the lower section, m.
  var low_far_m = 0.0;
  var colour = vec4f(0.0);
  for (var i = 0u; i < hull_images.hulls[hull].section_count; i++) {
    let section = hull_images.hulls[hull].sections[i];
    let half = vec2f(section.half_length_m, section.half_width_m);
    let off = section.middle - vec3f(place);
    let middle_m = dot(off.xz, toward);
    let half_depth_m = length(deep * half);
    // The outline of a section that is long in the direction of view is nearer than the section's middle.
    let near = 1.0 / max(max(middle_m - 0.6 * half_depth_m, 0.25 * middle_m), 0.2);
    var high = vec4f(dot(off.xz, across), length(seen * half), off.y, 0.0) * near;
    high.w = maths_normal_cdf((high.z - rise) * sharp.y);
    let share = high.w - low.w;
    if i > 0u && share > 1e-3 {
      // Most rays pass the band at the height that is nearest to the middle ray's.
      let part = saturate((rise - low.z) / max(high.z - low.z, 1e-4));
      let at = mix(low.xy, high.xy, part);
      // A section whose far end lies behind `place`, seen along the ray, stops no ray.
      let far_m = mix(low_far_m, middle_m + half_depth_m, part);
      let ahead_share = maths_smooth(0.5 + far_m / HULL_IMAGE_BEHIND_M);
      let stopped = ahead_share * share
        * (maths_normal_cdf((at.x + at.y) * sharp.x) - maths_normal_cdf((at.x - at.y) * sharp.x));
      let lit = mix(irradiance.front, irradiance.behind, colour.a);
      sum += stopped * vec4f(colour.rgb * lit, 1.0 - through * colour.a);
    }
    let encoded = unpack4x8unorm(section.colour);
    colour = vec4f(encoded.rgb * encoded.rgb * (1.0 / ATM_PI), encoded.a);
    low = high;
    low_far_m = middle_m + half_depth_m;
  }
  // Bands that overlap, as those of a hull that heels do, stop a ray once.
  return sum / max(sum.w, 1.0);
}

// Whether rays from `place` in the horizontal direction `toward`, which spread by the tangent `spread`, may meet a hull.
fn hull_image_may_meet(hull: u32, place: vec2f, toward: vec2f, spread: f32) -> bool {
  let off = hull_images.hulls[hull].origin.xz - place;
  let radius_m = hull_images.hulls[hull].radius_m;
  let far_m = dot(off, toward);
  let aside_m = abs(toward.x * off.y - toward.y * off.x);
  return far_m > -0.7 * radius_m && aside_m < radius_m + spread * max(far_m, 0.0);
}

// The position of a point of the water in the axes of the hulls.
fn hull_image_place(position: vec3f, height_m: f32) -> vec3f {
  return vec3f(position.x, height_m, position.z);
}

// Replaces what the water mirrors in the direction `v` to the eye by the hulls, where it sees them. `distance_m` is the
// distance to the eye.
fn hull_image_mirrored(mirror: WaterMirror, place: vec3f, v: vec3f, distance_m: f32, slope: WaterSlope) -> WaterMirror {
  var out = mirror;
  let away = -v.xz * inverseSqrt(max(dot(v.xz, v.xz), 1e-6));
  // Slopes to the side turn the ray by twice their angle times the sine of the view. Hardly any is farther than 2.5
  // deviations from the mean.
  let side = abs(v.x * slope.mean.y - v.z * slope.mean.x) + 2.5 * sqrt(max(slope.variance.x, slope.variance.y));
  let spread = 0.02 + 2.0 * v.y * side;
  for (var i = 0u; i < hull_images.count; i++) {
    if hull_image_may_meet(i, place.xz, away, spread) {
      let rays = water_mirrored_rays(v, slope);
      let met = hull_image_met(i, place, rays.ray, rays.blur, frame.pixel_angle * distance_m, 0.0);
      out.radiance = (1.0 - met.w) * out.radiance + (out.reflectance * material.sky_reflection) * met.rgb;
    }
  }
  return out;
}

// Fraction of the sunlight that the hulls let through to a point of the water.
fn hull_image_sunlight(place: vec3f, pixel_m: f32) -> f32 {
  let l = frame.sun_direction;
  var fraction = 1.0;
  if l.y > 0.0 {
    let toward = l.xz * inverseSqrt(max(dot(l.xz, l.xz), 1e-6));
    for (var i = 0u; i < hull_images.count; i++) {
      if hull_image_may_meet(i, place.xz, toward, 0.02) {
        fraction *= max(1.0 - hull_image_met(i, place, l, vec2f(HULL_IMAGE_SUN_BLUR), pixel_m, 1.0).w, 0.0);
      }
    }
  }
  return fraction;
}
