// Rain near the eye: streaks of the largest drops in a box before the eye, and splashes on the water. Drops of a class
// fall with one velocity. Their pattern repeats with the box and moves with them, so a drop is at a place that follows
// from its number and the time (src/render/drops/rain.rs).

@group(2) @binding(0) var<uniform> rain: Rain;

const RAIN_CLASSES = 8u;
// Exposure time in which a drop draws its streak, s.
const RAIN_EXPOSURE_S = 0.016;
// Share of sunlight that a drop refracts forwards, and the asymmetry of that lobe; share of the skylight, 1/sr.
const RAIN_FORWARD_SHARE = 0.5;
const RAIN_ASYMMETRY = 0.7;
const RAIN_SKY_SHARE = 0.32;
// Distances from the eye over which drops appear, m.
const RAIN_NEAR_M = vec2f(1.0, 2.5);
// Diameter of the lens's opening, m. A lens that is focused far away spreads a near point over a disc that is as wide, at
// the distance of the point, as the opening.
const RAIN_LENS_M = 0.005;
// Number of cells along a side of the square of splashes (`SPLASH_SIDE` in src/render/drops/rain.rs).
const RAIN_SPLASH_SIDE = 64u;
// Height and half width of the column of water that a drop throws up, m.
const RAIN_SPLASH_HEIGHT_M = 0.022;
const RAIN_SPLASH_HALF_WIDTH_M = 0.0035;

struct RainFragment {
  @builtin(position) clip: vec4f,
  // Position in the quad, -1 to 1.
  @location(0) at: vec2f,
  // Radiance, and opacity.
  @location(1) @interpolate(flat) light: vec4f,
}

// A quad around `middle`, relative to the eye, with the half sides `along` and `across`, m.
struct RainQuad {
  middle: vec3f,
  along: vec3f,
  across: vec3f,
  opacity: f32,
}

// Direction across a line that the eye sees, times a half width that is at least half a pixel.
fn rain_across(middle: vec3f, along: vec3f, half_m: f32, pixel_m: f32) -> vec3f {
  return normalize(cross(middle, along)) * max(half_m, 0.5 * pixel_m);
}

fn rain_drop(i: u32) -> RainQuad {
  let random = noise_pcg4d_unit(vec4u(i, 3u, 5u, 7u));
  let group = rain.classes[i % RAIN_CLASSES];
  let moving = rain.velocities[i % RAIN_CLASSES];
  let velocity = moving.xyz;
  let in_box = fract(random.xyz - group.xyz) - 0.5;
  let middle = rain.middle + rain.box_m * in_box;
  let distance_m = length(middle);
  let pixel_m = frame.pixel_angle * distance_m;
  let blurred_m = group.w + RAIN_LENS_M;
  let streak_m = RAIN_EXPOSURE_S * length(velocity) + blurred_m;
  let width_m = max(blurred_m, pixel_m);
  let edge = abs(in_box);
  let faded = smoothstep(0.5, 0.4, max(edge.x, max(edge.y, edge.z)));
  let near = smoothstep(RAIN_NEAR_M.x, RAIN_NEAR_M.y, distance_m);
  let along = (0.5 * streak_m) * normalize(velocity);
  // The drop covers a place of its streak for a part of the exposure, and a part of the streak's width.
  let opacity = moving.w * faded * near * group.w * group.w / (streak_m * width_m);
  return RainQuad(middle, along, rain_across(middle, along, 0.5 * blurred_m, pixel_m), opacity);
}

fn rain_splash(i: u32) -> RainQuad {
  let step = vec2i(i32(i % RAIN_SPLASH_SIDE), i32(i / RAIN_SPLASH_SIDE));
  let cell = bitcast<vec2u>(rain.first_cell + step);
  let time = rain.moment_fraction + noise_pcg4d_unit(vec4u(cell, 11u, 0u)).x;
  let random = noise_pcg4d_unit(vec4u(cell, 13u, rain.moment + u32(time)));
  var out: RainQuad;
  if random.w >= rain.splash_share {
    return out;
  }
  let at = rain.corner + (vec2f(step) + random.xy) * rain.cell_m;
  let moved = water_displacement(at, 0.1, false).displacement;
  let foot = vec3f(at.x + moved.x, moved.y - frame.eye_height_m, at.y + moved.z);
  let distance_m = length(foot);
  let pixel_m = frame.pixel_angle * distance_m;
  let age = fract(time);
  // The column rises and falls back.
  let height_m = RAIN_SPLASH_HEIGHT_M * (0.4 + random.z) * 4.0 * age * (1.0 - age);
  let half_m = RAIN_SPLASH_HALF_WIDTH_M * (0.6 + 0.8 * random.z);
  let along = vec3f(0.0, 0.5 * max(height_m, half_m), 0.0);
  let side = 0.5 * rain.cell_m * f32(RAIN_SPLASH_SIDE);
  let far = 1.0 - smoothstep(0.6 * side, side, distance_m);
  let share = min(2.0 * half_m / pixel_m, 1.0) * min(height_m / pixel_m, 1.0);
  let opacity = 0.35 * far * share * saturate(8.0 - 8.0 * age);
  return RainQuad(foot + along, along, rain_across(foot, along, half_m, pixel_m), opacity);
}

@vertex
fn vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) i: u32) -> RainFragment {
  var out: RainFragment;
  out.clip = DROP_UNSEEN;
  var quad: RainQuad;
  if i < rain.drops {
    quad = rain_drop(i);
  } else {
    quad = rain_splash(i - rain.drops);
  }
  if quad.opacity < 0.003 || dot(quad.middle, frame.forward) < 0.2 {
    return out;
  }
  let at = drop_corner(corner);
  let point = quad.middle + quad.along * at.x + quad.across * at.y;
  out.clip = frame.clip_from_relative * vec4f(point, 1.0);
  out.at = at;
  let dir = normalize(quad.middle);
  let sun = drop_sunlight(quad.middle.xz);
  let forwards = RAIN_FORWARD_SHARE * atm_henyey_greenstein(dot(dir, frame.sun_direction), RAIN_ASYMMETRY);
  out.light = vec4f(min(sun * forwards + light.sky_irradiance * RAIN_SKY_SHARE, vec3f(6e4)), quad.opacity);
  return out;
}

@fragment
fn fragment(in: RainFragment) -> @location(0) vec4f {
  // The ends of a streak are faint, and its middle has the mean opacity times a factor that keeps the sum.
  let inside = saturate(1.0 - in.at * in.at);
  let opacity = saturate(in.light.w * 2.25 * inside.x * inside.y);
  return vec4f(in.light.rgb * opacity, opacity);
}
