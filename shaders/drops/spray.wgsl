// Spray: puffs of drops that breaking crests throw up and the wind tears off and carries away. A puff is a quad that
// follows from the number of its place and of its period (src/render/drops/spray.rs) and from the maps at the present
// time, so nothing is stored between frames.
//
// A puff of the age a was born at the undisplaced place X. A crest that moves at the speed c and keeps its form has
// moved from X to X + c a since. So the height of X at the birth is that of X + c a now, and X had a breaking front if
// X + c a has one now and bubbles have been left at X.

@group(2) @binding(0) var<uniform> spray: Spray;
@group(2) @binding(1) var depth_map: texture_depth_2d;

// Number of places along a side of a grid (`SIDE` in src/render/drops/spray.rs).
const SPRAY_SIDE = 96u;
// Share of puffs of coarse drops, which fly in an arc; the others are mist that the wind takes along.
const SPRAY_COARSE_SHARE = 0.35;
// Optical depths of the middle of a young puff: mist (x) and coarse drops (y).
const SPRAY_OPTICAL_DEPTH = vec2f(0.6, 0.8);
// Exposure time over which a puff moves in the picture, s.
const SPRAY_EXPOSURE_S = 0.02;
// Range of the front of a breaker over which it throws up spray.
const SPRAY_FRONT_RANGE = vec2f(0.3, 0.8);
// Distances from the eye over which puffs appear, m.
const SPRAY_NEAR_M = vec2f(1.5, 5.0);
// Share of the sunlight that drops scatter forwards, and the asymmetry of that lobe; and the share of sunlight and
// skylight that leaves a cloud of drops evenly, 1/sr.
const SPRAY_FORWARD_SHARE = 0.6;
const SPRAY_ASYMMETRY = 0.74;
const SPRAY_EVEN_SUN = 0.06;
const SPRAY_EVEN_SKY = 0.24;

struct SprayFragment {
  @builtin(position) clip: vec4f,
  // Position in the quad, -1 to 1 along and across the motion.
  @location(0) at: vec2f,
  // Texture coordinates of the noise, and its mip level.
  @location(1) @interpolate(flat) noise: vec4f,
  @location(2) noise_lod: f32,
  // Radiance behind the air, and the optical depth in the middle.
  @location(3) @interpolate(flat) light: vec4f,
  // Distance along the viewing direction, and over which the puff fades into what it touches, m.
  @location(4) @interpolate(flat) depth: vec2f,
}

// Values of the foam map at an undisplaced position: foam, source, front and plume. The finest level is left out: its
// smallest fronts move more slowly than the large ones that throw up spray.
fn spray_foam(at: vec2f) -> vec4f {
  for (var level = 1u; level < frame.foam_level_count; level++) {
    let map = frame.foam_levels[level];
    let off = abs(at - map.centre);
    if max(off.x, off.y) * map.inverse_half_side < 1.0 {
      return textureSampleLevel(foam_map, nearest_mip_sampler, map.uv_below_eye + at * map.inverse_side, level, 0.0);
    }
  }
  return vec4f(0.0);
}

// Share of a grid's puffs that are seen at a distance from the eye, so that grids take turns gradually.
fn spray_level_share(level: u32, distance_m: f32) -> f32 {
  let reach = spray.levels[level].reach_m;
  var share = 1.0 - smoothstep(0.6 * reach, reach, distance_m);
  if level > 0u {
    let finer = spray.levels[level - 1u].reach_m;
    share *= smoothstep(0.6 * finer, finer, distance_m);
  }
  return share;
}

struct SprayPuff {
  position: vec3f,
  velocity: vec3f,
  radius_m: f32,
  optical_depth: f32,
  // Length divided by width.
  stretch: f32,
}

// A puff at the age `age` (a fraction of its life) from the undisplaced place `place`. `random` and `more` are uniform.
fn spray_puff(level: u32, place: vec2f, age: f32, random: vec4f, more: vec4f) -> SprayPuff {
  var out: SprayPuff;
  let t = age * spray.puff_s;
  let ahead = place + (spray.breaker_speed_m_s * t) * spray.downwind;
  let front = (spray_foam(ahead).z - SPRAY_FRONT_RANGE.x) / (SPRAY_FRONT_RANGE.y - SPRAY_FRONT_RANGE.x);
  let torn = maths_smooth(front) * saturate(3.0 * spray_foam(place).w);
  if torn <= 0.001 {
    return out;
  }
  let cell_m = spray.levels[level].cell_m;
  let moved = water_displacement(ahead, max(cell_m, 0.5), false).displacement;
  let is_coarse = more.x < SPRAY_COARSE_SHARE;
  // Time in which drops take on the speed of the air, and their fall speed.
  let relaxation_s = select(0.12 + 0.25 * more.y, 0.45, is_coarse);
  let fall = select(0.3 + 0.5 * more.y, 3.0 + 2.0 * more.y, is_coarse);
  let across = vec2f(-spray.downwind.y, spray.downwind.x);
  let jet = sqrt(frame.hs_m) * select(0.4 + 0.6 * more.z, 0.4 + 0.8 * more.z, is_coarse);
  let sideways = (random.z - 0.5) * across;
  let start = (spray.breaker_speed_m_s * (0.8 + 0.5 * random.w)) * spray.downwind + 2.0 * sideways;
  let gust = spray.wind_m_s * (0.75 + 0.35 * more.w);
  let carried = gust * spray.downwind + (0.2 * gust) * sideways;
  let rest = vec3f(carried.x, -fall, carried.y);
  let change = vec3f(start.x, jet, start.y) - rest;
  let left = exp(-t / relaxation_s);
  out.position = vec3f(place.x, 0.0, place.y) + moved + rest * t + change * (relaxation_s * (1.0 - left));
  out.velocity = rest + change * left;
  // Turbulence widens a puff, which thins.
  let young_m = cell_m * select(0.4 + 0.4 * random.z, 0.3 + 0.3 * random.z, is_coarse);
  let growth = select(0.7 + 1.8 * age, 0.7 + 1.0 * age, is_coarse);
  out.radius_m = young_m * growth;
  out.stretch = select(1.8 + 3.0 * age, 1.5, is_coarse);
  let life = maths_smooth(age * 8.0) * pow(1.0 - age, select(3.0, 2.0, is_coarse));
  let depths = select(SPRAY_OPTICAL_DEPTH.x, SPRAY_OPTICAL_DEPTH.y, is_coarse);
  out.optical_depth = depths * torn * life / (growth * growth);
  return out;
}

// Radiance of spray that the optical depth makes opaque, before the air in front of it.
fn spray_radiance(dir: vec3f, place: vec2f) -> vec3f {
  let sun = drop_sunlight(place);
  let forwards = SPRAY_FORWARD_SHARE * atm_henyey_greenstein(dot(dir, frame.sun_direction), SPRAY_ASYMMETRY);
  return sun * (forwards + SPRAY_EVEN_SUN) + light.sky_irradiance * SPRAY_EVEN_SKY;
}

@vertex
fn vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) i: u32) -> SprayFragment {
  var out: SprayFragment;
  out.clip = DROP_UNSEEN;
  let level = i / (SPRAY_SIDE * SPRAY_SIDE);
  let step = vec2i(i32(i % SPRAY_SIDE), i32((i / SPRAY_SIDE) % SPRAY_SIDE));
  let grid = spray.levels[level];
  let cell = bitcast<vec2u>(grid.first_cell + step);
  let time = spray.moment_fraction + noise_pcg4d_unit(vec4u(cell, level, 77u)).x;
  let key = vec4u(cell, level, spray.moment + u32(time));
  let random = noise_pcg4d_unit(key);
  let more = noise_pcg4d_unit(key + 1u);
  if noise_pcg4d_unit(key + 2u).x >= spray.share {
    return out;
  }
  let place = grid.corner + (vec2f(step) + random.xy) * grid.cell_m;
  let puff = spray_puff(level, place, fract(time), random, more);
  let centre = vec3f(puff.position.x, puff.position.y - frame.eye_height_m, puff.position.z);
  let distance_m = length(centre);
  let shown = spray_level_share(level, distance_m) * smoothstep(SPRAY_NEAR_M.x, SPRAY_NEAR_M.y, distance_m);
  let optical_depth = puff.optical_depth * shown;
  let ahead_m = dot(centre, frame.forward);
  if optical_depth < 0.004 || ahead_m < 0.5 {
    return out;
  }
  let dir = centre / distance_m;
  // The quad faces the eye, and is drawn out along the motion that the eye sees.
  let seen = puff.velocity - dir * dot(puff.velocity, dir);
  let speed = max(length(seen), 1e-3);
  let along = seen / speed;
  let long_m = puff.radius_m * puff.stretch + 0.5 * SPRAY_EXPOSURE_S * speed;
  let at = drop_corner(corner);
  let point = centre + along * (at.x * long_m) + cross(dir, along) * (at.y * puff.radius_m);
  let drop = dot(point.xz, point.xz) / (2.0 * FRAME_EARTH_RADIUS_M);
  out.clip = frame.clip_from_relative * vec4f(point.x, point.y - drop, point.z, 1.0);
  out.at = at;
  let scale = 0.16;
  out.noise = vec4f(random.wx, 0.3 * scale * long_m / puff.radius_m, scale);
  out.noise_lod = log2(max(512.0 * scale * distance_m * frame.pixel_angle / puff.radius_m, 1.0));
  let air = air_to_point(dir, distance_m);
  out.light = vec4f(spray_radiance(dir, centre.xz) * air[1] + air[0], optical_depth);
  out.depth = vec2f(ahead_m, 0.7 * puff.radius_m);
  return out;
}

@fragment
fn fragment(in: SprayFragment) -> @location(0) vec4f {
  let inside = saturate(1.0 - dot(in.at, in.at));
  // The product of two independent noises has the mean of both, at every mip level.
  let wide_at = in.noise.xy + in.at * in.noise.zw;
  let wide = textureSampleLevel(noise_map, noise_sampler, wide_at, 0, in.noise_lod).b;
  let fine = textureSampleLevel(noise_map, noise_sampler, wide_at.yx * 2.7, 0, in.noise_lod + 1.4).g;
  let scene_m = frame.clip_from_relative[3].z / max(textureLoad(depth_map, vec2i(in.clip.xy), 0), 1e-9);
  let free = saturate((scene_m - in.depth.x) / in.depth.y);
  // The square of the noise has more contrast than the noise. It is divided by its mean, which falls to 1 as pixels grow
  // and the mip levels of the noise become even.
  let noise = 4.0 * wide * fine;
  let clumped = noise * noise / mix(1.78, 1.0, saturate(0.25 * in.noise_lod));
  let opacity = 1.0 - exp(-in.light.w * inside * inside * clumped * free);
  return vec4f(min(in.light.rgb, vec3f(6e4)) * opacity, opacity);
}
