// Buoys, boats, yachts and seamarks: painted hulls, towers and sails in the light of sun, sky and sea. Their triangles
// come from src/render/water/hulls.rs.

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
  // Linear RGB of the paint; alpha is the fraction of the sunlight that shines through a sail, or 1 for a lamp.
  @location(2) colour: vec4f,
  // Place on a sail, along the chord and up, or 0; then the fraction of the sunlight that a sail takes away, or the
  // fraction of its full light that a lamp gives.
  @location(3) cloth: vec3f,
}

// A square approximates the sRGB curve well enough for paint.
fn hull_paint(packed: u32) -> vec4f {
  let encoded = unpack4x8unorm(packed);
  return vec4f(encoded.rgb * encoded.rgb, encoded.a);
}

// A position relative to the point of the still water below the eye, relative to the eye.
fn hull_place(position: vec3f) -> vec3f {
  let drop = dot(position.xz, position.xz) / (2.0 * FRAME_EARTH_RADIUS_M);
  return position - vec3f(0.0, drop + frame.eye_height_m, 0.0);
}

@vertex
fn vertex(@builtin(vertex_index) i: u32) -> HullFragment {
  let hull = hull_vertices[i];
  let place = hull_place(hull.position);
  return HullFragment(
    frame.clip_from_relative * vec4f(place, 1.0), place, hull.normal, hull_paint(hull.colour),
    hull_cloth(hull.detail));
}

// Place on a sail, and shade, as hull_shapes.rs packs them.
fn hull_cloth(detail: u32) -> vec3f {
  return vec3f(vec3u(detail & 4095u, (detail >> 12u) & 4095u, detail >> 24u)) / vec3f(4095.0, 4095.0, 255.0);
}

// Whether the ray to a point relative to the eye leaves the lens under water.
fn hull_seen_from_below(place: vec3f) -> bool {
  let lens = place * (frame.clip_from_relative[3].z / dot(place, frame.forward));
  return frame.water_at_eye.x + dot(frame.water_at_eye.yz, lens.xz) > lens.y;
}

// Radiance of a hull that is seen through `distance_m` metres of water.
fn hull_radiance_below(in: HullFragment, n: vec3f, dir: vec3f, distance_m: f32) -> vec3f {
  let eye_m = max(frame.water_at_eye.x, 0.02);
  if SKY_CLOUD_SHADOWS {
    cloud_sun_fraction = cloud_sun_transmittance(in.position.xz, 0.0);
  }
  let daylight = medium_downwelling(max(eye_m - in.position.y, 0.0));
  // Light comes from all sides, most of it from above.
  let surface = in.colour.rgb * daylight * ((0.55 + 0.45 * n.y) / ATM_PI);
  return surface * medium_transmittance(distance_m) + medium_radiance(dir, eye_m, distance_m, 1.0);
}

// Number of seams between the panels of a sail, from foot to head.
const HULL_SEAMS = 11.0;
// Half the width of a seam relative to the distance of two, and of the tape along the edges relative to the chord.
const HULL_SEAM_HALF = 0.014;
const HULL_TAPE = 0.02;
// Fractions of light that a doubled cloth takes from what shines through it, and from what it reflects.
const HULL_DOUBLED = vec2f(0.35, 0.05);
// Fraction of the skylight that is hidden from a sail at its leading edge.
const HULL_LUFF_SHADE = 0.3;
// How much more light a sail lets through straight than to the side.
const HULL_SAIL_GLOW = 1.2;

// Radiance of a lighthouse's lens in its flash: 1 million candela from a square metre or so, in units of which white in
// the midday sun has about a quarter. Seen from the side, a lens is darker.
const HULL_LAMP_RADIANCE = 8.0;

// Reflectance of a lens of glass, relative to paint of its colour.
const HULL_LENS_PAINT = 0.2;

// Fraction of a pixel of the width `pixel` that a line of half the width `half` covers, at the distance `off`.
fn hull_line_cover(off: f32, half: f32, pixel: f32) -> f32 {
  return clamp((half - off) / pixel + 0.5, 0.0, min(2.0 * half / pixel, 1.0));
}

// Fraction of a pixel in which the cloth of a sail is doubled by seams and tapes. `pixel` is the pixel's size on the sail.
fn hull_doubled_cloth(cloth: vec2f, pixel: vec2f) -> f32 {
  let seam = abs(fract(cloth.y * HULL_SEAMS) - 0.5);
  let seams = hull_line_cover(seam, HULL_SEAM_HALF, max(pixel.y * HULL_SEAMS, 1e-4));
  let edge = min(cloth.x, 1.0 - cloth.x);
  // Patches of several cloths strengthen the corners.
  let corners = min(length(cloth * vec2f(1.0, 2.8)), min(
    length(vec2f(1.0 - cloth.x, 2.8 * cloth.y)), 3.0 - 3.0 * cloth.y));
  let patches = 0.5 * (1.0 - smoothstep(0.2, 0.24, corners)) + 0.3 * (1.0 - smoothstep(0.32, 0.36, corners));
  return max(max(seams, patches), hull_line_cover(edge, HULL_TAPE, max(pixel.x, 1e-4)));
}

@fragment
fn fragment(in: HullFragment) -> @location(0) vec4f {
  let distance_m = length(in.position);
  let dir = in.position / distance_m;
  let nearness = frame_edged_nearness(1.0 / distance_m, vec2u(in.clip.xy));
  let pixel = fwidth(in.cloth.xy);
  var paint = in.colour;
  if in.cloth.y > 0.0 {
    let doubled = hull_doubled_cloth(in.cloth.xy, pixel);
    paint *= 1.0 - doubled * vec4f(vec3f(HULL_DOUBLED.y), HULL_DOUBLED.x);
  }
  let is_lamp = in.colour.a > 0.99;
  if is_lamp {
    paint.a = 0.0;
  }
  let through = select(in.colour.a, 0.0, is_lamp);
  // The eye sees both sides of a sail.
  let n = normalize(in.normal) * select(1.0, -1.0, through > 0.0 && dot(in.normal, dir) > 0.0);
  if HULL_DIVES {
    if hull_seen_from_below(in.position) {
      return frame_hdr_output(hull_radiance_below(in, n, dir, distance_m), nearness);
    }
  }
  let up = 0.5 + 0.5 * n.y;
  if SKY_CLOUD_SHADOWS {
    cloud_sun_fraction = cloud_sun_transmittance(in.position.xz, 0.0);
  }
  let all_sunlight = cloud_sun_irradiance();
  let sunlight = all_sunlight * select(1.0 - in.cloth.z, 1.0, is_lamp);
  let sun_cosine = dot(n, frame.sun_direction);
  let sun = sunlight * max(sun_cosine, 0.0);
  let on_sea = light.sky_irradiance + all_sunlight * max(frame.sun_direction.y, 0.0);
  // A sail also glows with the sky behind it, which lowers the contrast between its sides. Near its leading edge, mast
  // and sails hide a part of the sky.
  let contrast = scene_skylight_change(n) * (1.0 - 2.0 * paint.a);
  let hidden = select(0.0, HULL_LUFF_SHADE * exp(-5.0 * in.cloth.x), in.cloth.y > 0.0);
  let from_sky = light.sky_irradiance * (up * (1.0 + contrast) * (1.0 - hidden));
  let around = from_sky + on_sea * HULL_SEA_REFLECTANCE * (1.0 - up);
  let straight = pow(max(dot(dir, frame.sun_direction), 0.0), 12.0);
  let glow = 0.85 + HULL_SAIL_GLOW * straight;
  let diffuse = sun * (1.0 - through) + sunlight * (max(-sun_cosine, 0.0) * (0.6 - 0.4 * sun_cosine) * paint.a * glow);
  // A coat of clear lacquer reflects a little of the sky.
  let mirror = reflect(dir, n);
  let sheen = 0.04 + 0.96 * pow(saturate(1.0 + dot(dir, n)), 5.0);
  let sky_there = light.sky_irradiance * (0.32 * (0.5 + 0.5 * mirror.y));
  let half = normalize(frame.sun_direction - dir);
  let glint = 0.04 * 20.0 * pow(max(dot(n, half), 0.0), 160.0) * sun;
  let lacquer = select(0.5 * sheen * sky_there + glint / ATM_PI, vec3f(0.0), through > 0.0);
  var surface = paint.rgb * (diffuse + around) / ATM_PI + lacquer;
  if is_lamp {
    let facing = dot(n, dir);
    surface = HULL_LENS_PAINT * surface + paint.rgb * (HULL_LAMP_RADIANCE * in.cloth.z * pow(abs(facing), 4.0));
  }
  let air = air_to_point(dir, distance_m);
  return frame_hdr_output(surface * air[1] + air[0], nearness);
}

// Ropes and wires: quads at least as wide as a pixel, with the opacity of the fraction that the line covers.

struct HullLineFragment {
  @builtin(position) clip: vec4f,
  @location(0) position: vec3f,
  @location(1) along: vec3f,
  @location(2) colour: vec3f,
  // Distance from the middle, half the line's width, and the width of a pixel there, m; -1 for white water.
  @location(3) across: vec3f,
}

// Whether a vertex of the lines belongs to white water (FOAM_COLOUR in hulls.rs).
fn hull_is_foam(colour: u32) -> bool {
  return colour >= 0xff000000u;
}

@vertex
fn line_vertex(@builtin(vertex_index) i: u32) -> HullLineFragment {
  let hull = hull_vertices[i];
  let place = hull_place(hull.position);
  if hull_is_foam(hull.colour) {
    return HullLineFragment(
      frame.clip_from_relative * vec4f(place, 1.0), place, hull.normal, hull_paint(hull.colour).rgb, vec3f(-1.0));
  }
  let signed_half = bitcast<f32>(hull.detail);
  let half = abs(signed_half);
  let pixel_m = frame.pixel_angle * max(dot(place, frame.forward), 0.1);
  let reach_m = half + 0.5 * pixel_m;
  let turned = cross(hull.normal, place);
  let side = turned * inverseSqrt(max(dot(turned, turned), 1e-9));
  let at = place + side * (sign(signed_half) * reach_m);
  return HullLineFragment(
    frame.clip_from_relative * vec4f(at, 1.0), at, hull.normal, hull_paint(hull.colour).rgb,
    vec3f(sign(signed_half) * reach_m, half, pixel_m));
}

@fragment
fn line_fragment(in: HullLineFragment) -> @location(0) vec4f {
  if HULL_DIVES {
    if hull_seen_from_below(in.position) {
      return vec4f(0.0);
    }
  }
  if SKY_CLOUD_SHADOWS {
    cloud_sun_fraction = cloud_sun_transmittance(in.position.xz, 0.0);
  }
  if in.across.z < 0.0 {
    return hull_foam(in.position, in.along, in.colour);
  }
  // A thin cylinder shows its lit and its dark side at once; a wide one, like a near mast, shows them side by side.
  let l = frame.sun_direction;
  let cosine = dot(l, in.along);
  let distance_m = length(in.position);
  let dir = in.position / distance_m;
  let lit_side = 0.5 - 0.5 * dot(l - in.along * cosine, dir);
  let mean = sqrt(max(1.0 - cosine * cosine, 0.0)) * 0.64 * saturate(lit_side);
  let aside = clamp(in.across.x / in.across.y, -1.0, 1.0);
  let side = normalize(cross(in.along, in.position));
  let n = aside * side - sqrt(1.0 - aside * aside) * cross(side, in.along);
  let wide = saturate(in.across.y / in.across.z - 0.5);
  let sun = cloud_sun_irradiance() * mix(mean, max(dot(n, l), 0.0), wide);
  let surface = in.colour * (sun + 0.5 * light.sky_irradiance) / ATM_PI;
  let air = air_to_point(dir, distance_m);
  let opacity = hull_line_cover(abs(in.across.x), in.across.y, in.across.z);
  return vec4f(min(surface * air[1] + air[0], vec3f(6e4)) * opacity, opacity);
}
