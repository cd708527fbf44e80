// Spray: puffs of drops that breaking crests throw up and the wind tears off and carries away. A puff is a quad that
// follows from the number of its place and of its period (src/render/drops/spray.rs) and from the maps at the present
// time, so nothing is stored between frames.

@group(0) @binding(9) var<uniform> material: Material;
@group(2) @binding(0) var<uniform> spray: Spray;
@group(2) @binding(1) var depth_map: texture_depth_2d;

// Number of places along a side of a grid (`SIDE` in src/render/drops/spray.rs).
const SPRAY_SIDE = 96u;
// Height of a puff of mist, relative to its radius: the wind drives mist low over the water.
const SPRAY_MIST_HEIGHT = 0.42;
// Least part of the speed of mist that counts as motion across the view.
const SPRAY_LEAST_SIDEWAYS = 0.5;
// Exposure time over which a puff moves in the picture, s.
const SPRAY_EXPOSURE_S = 0.02;
// Distances from the eye over which puffs appear, m.
const SPRAY_NEAR_M = vec2f(4.0, 18.0);
// How much brighter the sunlit side of a puff is.
const SPRAY_ROUNDNESS = 0.3;
// Drifts in which puffs lie are noise of the layer of the foam's billows: how much faster they change upwards than
// across, and the number of parts of its tile in which their way is counted, a power of two.
const SPRAY_DRIFT_SLOPE = 2.0;
const SPRAY_DRIFT_PARTS = 256.0;
// Contrast, in stops, of the noise of mist (x) and of coarse drops (y).
const SPRAY_CONTRAST = vec2f(7.0, 2.5);
// Contrast, in stops, of single drops in coarse puffs, which the noise of bubbles shows where it is low.
const SPRAY_DROPS = 12.0;
// By how much low noise shortens the radius of a puff, relative to its square.
const SPRAY_TORN_EDGE = 1.6;
// Tiles of noise in the radius of a puff, which are the most that fit into it without a repeat.
const SPRAY_NOISE_TILES = 0.5;
// Texels of the noise of drops in a pixel, and the mip level that shows them as dots of some pixels: drops are smaller
// than pixels, and those that one sees are the largest.
const SPRAY_DROP_TEXELS = 8.0;
const SPRAY_DROP_LOD = 2.6;
// Fraction of the contrast of that noise which is left at that level.
const SPRAY_DROP_LEFT = 0.7;

struct SprayFragment {
  @builtin(position) clip: vec4f,
  // Position in the quad, -1 to 1 along and across the motion.
  @location(0) at: vec2f,
  // Texture coordinates of the drifts, which neighbouring puffs share.
  @location(1) drift: vec2f,
  // Texture coordinates of the puff's own noise in its middle.
  @location(2) @interpolate(flat) noise: vec2f,
  // Mip levels of drifts (x) and of the puff's own noise (y), contrast of the latter (z), and its inverse mean (w).
  @location(3) @interpolate(flat) sharp: vec4f,
  // Radiance behind the air, and the optical depth in the middle.
  @location(4) @interpolate(flat) light: vec4f,
  // Distance along the viewing direction, and over which the puff fades into what it touches, m. Direction to the sun
  // along and across the quad.
  @location(5) @interpolate(flat) depth: vec4f,
  // Contrasts, in stops, of drifts (x) and of single drops (y), and tiles of the latter's noise over half the quad (z).
  @location(6) @interpolate(flat) contrast: vec3f,
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

// Texture coordinates of the drifts at a point relative to the point below the eye, m. Drifts are noise in space that
// does not change along lines which sink downwind, and that the wind carries along. Their way in a period is rounded to
// a whole number of parts of the tile, so that whole numbers count it however late it is.
fn spray_drift(point: vec3f) -> vec2f {
  let layer = material.noise_layers[FOAM_BILLOW_LAYER];
  let way = layer.uv_from_position * spray.downwind;
  let parts = vec2i(round((SPRAY_DRIFT_PARTS * spray.wind_m_s * spray.puff_s) * way));
  let whole = (parts * bitcast<i32>(spray.moment)) & vec2i(i32(SPRAY_DRIFT_PARTS) - 1);
  let passed = (vec2f(whole) + vec2f(parts) * spray.moment_fraction) / SPRAY_DRIFT_PARTS;
  return layer.uv_below_eye + layer.uv_from_position * point.xz + (SPRAY_DRIFT_SLOPE * point.y) * way - fract(passed);
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
  let place = grid.corner + (vec2f(step) + random.xy) * grid.cell_m;
  let age = fract(time);
  let birth = spray_birth(level, place, age * spray.puff_s, random, noise_pcg4d_unit(key + 2u).x);
  if birth.torn <= SPRAY_LEAST_TORN {
    return out;
  }
  let puff = spray_puff(birth, place, grid.cell_m, age, random, more);
  let centre = vec3f(puff.position.x, puff.position.y - frame.eye_height_m, puff.position.z);
  let distance_m = length(centre);
  let near = smoothstep(SPRAY_NEAR_M.x, SPRAY_NEAR_M.y, distance_m);
  let optical_depth = puff.optical_depth * near * spray_level_share(level, distance_m);
  let ahead_m = dot(centre, frame.forward);
  if optical_depth < 0.004 || ahead_m < 0.5 {
    return out;
  }
  let dir = centre / distance_m;
  // The quad faces the eye. It is drawn out by as much of the motion as the eye sees. A puff that comes towards the eye
  // lies along the crest that it was torn from, so that it stays low over the water.
  let level_axis = normalize(vec3f(-dir.z, 0.0, dir.x));
  let speed = max(length(puff.velocity), 1e-3);
  let sideways = dot(puff.velocity, level_axis);
  let most = max(abs(sideways), select(SPRAY_LEAST_SIDEWAYS * speed, 0.0, puff.is_coarse));
  let up_axis = cross(level_axis, dir);
  let moved = select(-most, most, sideways >= 0.0) * level_axis + dot(puff.velocity, up_axis) * up_axis;
  let seen = length(moved) + 1e-3;
  let along = moved / seen;
  let drawn_out = 1.0 + (puff.stretch - 1.0) * min(seen / speed, 1.0);
  let long_m = puff.radius_m * drawn_out + 0.5 * SPRAY_EXPOSURE_S * seen;
  let high_m = puff.radius_m * select(SPRAY_MIST_HEIGHT, 1.0, puff.is_coarse);
  let at = drop_corner(corner);
  let side = cross(dir, along);
  let point = centre + along * (at.x * long_m) + side * (at.y * high_m);
  let drop = dot(point.xz, point.xz) / (2.0 * FRAME_EARTH_RADIUS_M);
  out.clip = frame.clip_from_relative * vec4f(point.x, point.y - drop, point.z, 1.0);
  out.at = at;
  out.drift = spray_drift(vec3f(point.x, point.y + frame.eye_height_m, point.z));
  let pixel_m = distance_m * frame.pixel_angle;
  out.noise = random.wx;
  let lod = max(log2(512.0 * SPRAY_NOISE_TILES * pixel_m / high_m), 0.0);
  let drift_lod = max(log2(pixel_m) + material.noise_layers[FOAM_BILLOW_LAYER].log_texels_per_m, 0.0);
  let contrast = select(SPRAY_CONTRAST.x, SPRAY_CONTRAST.y, puff.is_coarse);
  // Means of the exponentials of even noise fall to 1 as pixels grow and the mip levels of the noise become even.
  let own = mix(spray_mean(contrast), 1.0, saturate(0.22 * lod));
  let even = mix(spray_mean(puff.drifts), 1.0, saturate(0.16 * drift_lod));
  let dots = max(SPRAY_DROPS * puff.drops, 0.01);
  out.contrast = vec3f(puff.drifts, dots, SPRAY_DROP_TEXELS * high_m / (512.0 * pixel_m));
  let dotted = spray_mean(SPRAY_DROP_LEFT * dots);
  out.sharp = vec4f(drift_lod, lod, contrast, 1.0 / (own * even * dotted));
  let air = air_to_point(dir, distance_m);
  out.light = vec4f(spray_radiance(dir, centre.xz, puff.open) * air[1] + air[0], optical_depth);
  let towards_sun = vec2f(dot(along, frame.sun_direction), dot(side, frame.sun_direction));
  out.depth = vec4f(ahead_m, 0.7 * high_m, towards_sun);
  return out;
}

// Mean of 2^(contrast (x - 1/2)) for x even over 0 to 1.
fn spray_mean(contrast: f32) -> f32 {
  return sinh(0.34657359 * contrast) / (0.34657359 * contrast);
}

@fragment
fn fragment(in: SprayFragment) -> @location(0) vec4f {
  let drift = textureSampleLevel(noise_map, noise_sampler, in.drift, 0, in.sharp.x).b - 0.5;
  // The noise is drawn out as the puff is: the wind tears mist to threads.
  let own_at = in.noise + SPRAY_NOISE_TILES * in.at;
  let own = textureSampleLevel(noise_map, noise_sampler, own_at, 0, in.sharp.y).b - 0.5;
  let drops_at = in.noise.yx + in.at * in.contrast.z;
  let drops = 0.5 - textureSampleLevel(noise_map, noise_sampler, drops_at, 0, SPRAY_DROP_LOD).g;
  // Where the noise is low, the puff reaches less far, so that its edge is torn and not a circle.
  let inside = saturate(1.0 - dot(in.at, in.at) * (1.0 + SPRAY_TORN_EDGE * (0.5 - own)));
  let scene_m = frame.clip_from_relative[3].z / max(textureLoad(depth_map, vec2i(in.clip.xy), 0), 1e-9);
  let free = saturate((scene_m - in.depth.x) / in.depth.y);
  let clumped = exp2(in.contrast.x * drift + in.sharp.z * own + in.contrast.y * drops) * in.sharp.w;
  let opacity = 1.0 - exp(-in.light.w * inside * inside * clumped * free);
  // The side of a puff that faces the sun is brighter than the other one.
  let shade = 1.0 + SPRAY_ROUNDNESS * dot(in.at, in.depth.zw);
  return vec4f(min(in.light.rgb * shade, vec3f(6e4)) * opacity, opacity);
}
