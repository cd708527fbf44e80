// Buoys, boats and yachts: painted hulls and sails in the light of sun, sky and sea. Their triangles come from
// src/render/water/hulls.rs.

@group(0) @binding(9) var<uniform> material: Material;
@group(1) @binding(0) var<storage, read> hull_vertices: array<HullVertex>;

// Whether the eye dives, so that it may see hulls through water.
override HULL_DIVES: bool = false;

// Fraction of the light, RGB, that the sea reflects up to a hull.
const HULL_SEA_REFLECTANCE = vec3f(0.03, 0.05, 0.06);

struct HullFragment {
  @builtin(position) clip: vec4f,
  @location(0) position: vec3f,
  @location(1) normal: vec3f,
  // Linear RGB of the paint; alpha is the fraction of the sunlight that shines through a sail.
  @location(2) colour: vec4f,
}

@vertex
fn vertex(@builtin(vertex_index) i: u32) -> HullFragment {
  let hull = hull_vertices[i];
  let drop = dot(hull.position.xz, hull.position.xz) / (2.0 * FRAME_EARTH_RADIUS_M);
  let place = hull.position - vec3f(0.0, drop + frame.eye_height_m, 0.0);
  // A square approximates the sRGB curve well enough for paint.
  let encoded = unpack4x8unorm(hull.colour);
  let colour = vec4f(encoded.rgb * encoded.rgb, encoded.a);
  return HullFragment(frame.clip_from_relative * vec4f(place, 1.0), place, hull.normal, colour);
}

// Whether the ray to a point relative to the eye leaves the lens under water.
fn hull_seen_from_below(place: vec3f) -> bool {
  let lens = place * (frame.clip_from_relative[3].z / dot(place, frame.forward));
  return frame.water_at_eye.x + dot(frame.water_at_eye.yz, lens.xz) > lens.y;
}

// Radiance of a hull that is seen through `distance_m` metres of water.
fn hull_radiance_below(in: HullFragment, n: vec3f, dir: vec3f, distance_m: f32) -> vec3f {
  let eye_m = max(frame.water_at_eye.x, 0.02);
  let daylight = medium_downwelling(max(eye_m - in.position.y, 0.0));
  // Light comes from all sides, most of it from above.
  let surface = in.colour.rgb * daylight * ((0.55 + 0.45 * n.y) / ATM_PI);
  return surface * medium_transmittance(distance_m) + medium_radiance(dir, eye_m, distance_m, 1.0);
}

// How much brighter than its mean the sky is on the side of the sun, and darker on the other, as a hull sees it.
const HULL_SKY_CONTRAST = 0.6;

@fragment
fn fragment(in: HullFragment) -> @location(0) vec4f {
  let distance_m = length(in.position);
  let dir = in.position / distance_m;
  let through = in.colour.a;
  // The eye sees both sides of a sail.
  let n = normalize(in.normal) * select(1.0, -1.0, through > 0.0 && dot(in.normal, dir) > 0.0);
  if HULL_DIVES {
    if hull_seen_from_below(in.position) {
      return frame_hdr_output(hull_radiance_below(in, n, dir, distance_m), 1.0 / distance_m);
    }
  }
  let up = 0.5 + 0.5 * n.y;
  let sunlight = cloud_sun_irradiance_at(in.position.xz, 0.0);
  let sun_cosine = dot(n, frame.sun_direction);
  let sun = sunlight * max(sun_cosine, 0.0);
  let on_sea = light.sky_irradiance + sunlight * max(frame.sun_direction.y, 0.0);
  let facing_sun = dot(n.xz, normalize(frame.sun_direction.xz + vec2f(1e-6, 0.0)));
  let from_sky = light.sky_irradiance * (up * (1.0 + HULL_SKY_CONTRAST * facing_sun));
  let around = from_sky + on_sea * HULL_SEA_REFLECTANCE * (1.0 - up);
  let diffuse = mix(sun, sunlight * max(-sun_cosine, 0.0), through);
  // A coat of clear lacquer reflects a little of the sky.
  let mirror = reflect(dir, n);
  let sheen = 0.04 + 0.96 * pow(saturate(1.0 + dot(dir, n)), 5.0);
  let sky_there = light.sky_irradiance * (0.32 * (0.5 + 0.5 * mirror.y));
  let half = normalize(frame.sun_direction - dir);
  let glint = 0.04 * 20.0 * pow(max(dot(n, half), 0.0), 160.0) * sun;
  let lacquer = select(0.5 * sheen * sky_there + glint / ATM_PI, vec3f(0.0), through > 0.0);
  let surface = in.colour.rgb * (diffuse + around) / ATM_PI + lacquer;
  let air = air_to_point(dir, distance_m);
  return frame_hdr_output(surface * air[1] + air[0], 1.0 / distance_m);
}
