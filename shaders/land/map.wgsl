// The map of the land (src/render/land/map.rs): height, m, slopes along the axes of the coast's frame, and kind of the
// ground. The uniform `Land` tells where it lies.

// Whether there is land, so that the water has a depth of its own at each place.
override WATER_LAND: bool = false;
// Undisplaced position from which a pixel of the G-buffer shows no water (`NO_WATER_M` in src/render/targets.rs), m.
const LAND_NO_WATER_M = 5e8;

// Standard deviation of the slopes of a film of water on sand, and its mean slope relative to that of the sand: a sheet
// that drains is thickest at its foot.
const LAND_FILM_ROUGHNESS = 0.055;
const LAND_FILM_TILT = 0.5;
// Standard deviation of the slope by which a film of water wavers, and the side of the tile of its noise, m. This slope
// frays the edges of what the film mirrors.
const LAND_FILM_WAVER = 0.01;
const LAND_FILM_WAVER_M = 3.7;

// Share of a film of water that ground of the slope `steep` keeps: all of it lies on sand, none on rock.
fn land_film_share(steep: f32) -> f32 {
  return maths_smooth(2.0 - 5.5 * steep);
}

// Position in the frame of the coast, m, of a point (x, z) relative to the one below the eye, m.
fn land_place(at: vec2f) -> vec2f {
  return land.eye_place + land_from_world(at);
}

// Components in the frame of the coast of a vector (x, z) of the world.
fn land_from_world(v: vec2f) -> vec2f {
  return vec2f(dot(v, land.shoreward), v.y * land.shoreward.x - v.x * land.shoreward.y);
}

// A vector (x, z) of the world from its components in the frame of the coast.
fn land_to_world(v: vec2f) -> vec2f {
  return vec2f(v.x * land.shoreward.x - v.y * land.shoreward.y, v.x * land.shoreward.y + v.y * land.shoreward.x);
}

// Mip level of the map whose texels are `size` metres wide.
fn land_lod(size: f32) -> f32 {
  return max(log2(max(size, 1e-6)) + land.log_texels_per_m, 0.0);
}

// Height, slopes and kind of the ground at a place in the frame of the coast, at a mip level. Beyond the coast's rectangle
// those of its edge hold.
fn land_at(place: vec2f, lod: f32) -> vec4f {
  let border = min(land.uv_start * exp2(ceil(lod)), vec2f(0.5));
  let uv = clamp(place * land.uv_per_m + land.uv_start, border, 1.0 - border);
  return textureSampleLevel(land_map, noise_sampler, uv, lod);
}

// Depth of the still water, m, at a point (x, z) relative to the one below the eye, over texels of `size` metres.
fn land_depth_m(at: vec2f, size: f32) -> f32 {
  return -land_at(land_place(at), land_lod(size)).x;
}

// Length, m, of the vertical through the water where a ray that goes down from the surface meets the bed. `at`: where it
// starts (x, z), `run`: how far it goes for each metre down, `height`: that of the surface, m.
fn land_column_m(at: vec2f, run: vec2f, height: f32, size: f32) -> f32 {
  let below = max(land_depth_m(at, size) + height, 0.0);
  let first = max(land_depth_m(at + run * below, size) + height, 0.0);
  // Over a slope the ray meets the bed between both.
  let half = 0.5 * (below + first);
  return max(land_depth_m(at + run * half, size) + height, 0.0);
}

// Sides of the tiles of noise, m: over tens of metres, and over metres.
const LAND_MIDDLE_M = 53.0;
const LAND_FINE_M = 7.9;

// Axes of the finer noise, so that no two layers repeat in the same direction.
fn land_turned(place: vec2f) -> vec2f {
  return vec2f(0.96 * place.x + 0.28 * place.y, 0.96 * place.y - 0.28 * place.x);
}

// Noise of the ground: slope and height of ripples (x, y), normal noises, fractal (z) and of blocks (w), of a tile of
// `tile_m` metres, over texels of `size` metres. They are those of the bed (src/render/water/bed.rs).
fn land_noise(place: vec2f, tile_m: f32, size: f32) -> vec4f {
  let lod = max(log2(max(size, 1e-6) * (512.0 / tile_m)), 0.0);
  let texel = textureSampleLevel(noise_map, noise_sampler, place * (1.0 / tile_m), 1, lod);
  return (texel - 0.5) * vec4f(2.0, 3.2, 6.4, 6.4);
}

// Slope (x, z) of the film of water on ground with the slope `slope` (x, z), at a place in the frame of the coast, over
// texels of `size` metres.
fn land_film_slope(place: vec2f, slope: vec2f, size: f32) -> vec2f {
  return LAND_FILM_TILT * slope + LAND_FILM_WAVER * land_noise(place, LAND_FILM_WAVER_M, size).zw;
}

// Slopes of the beds of rock in the frame of the coast, and height of their bends, m for each deviation of their noise.
const LAND_DIP = vec2f(0.17, -0.09);
const LAND_BENDS_M = 1.3;
// Thickness of two hard beds of rock and the soft ones between, m; the part of it where the ledge is steep, and how
// much of the height is cut into ledges. There are none below these heights above the still water, m.
const LAND_LEDGE_M = 5.5;
const LAND_LEDGE_STEEP = vec2f(0.20, 0.80);
const LAND_LEDGE_SHARE = 0.65;
const LAND_LEDGE_FROM_M = vec2f(2.5, 6.0);

// Height of a place over the lowest bed, m. `bend` is the noise over hundreds of metres.
fn land_layer(place: vec2f, height: f32, bend: f32) -> f32 {
  return height + dot(LAND_DIP, place) + LAND_BENDS_M * bend;
}

// How much the ledges of rock raise the land of the map, m (x), and the factor on its slope (y). `map` is that of
// land_at.
fn land_ledge(place: vec2f, map: vec4f, bend: f32) -> vec2f {
  let share = LAND_LEDGE_SHARE * land_rock_share(length(map.yz)) * maths_rise(map.x, LAND_LEDGE_FROM_M);
  // Thick beds follow thin ones.
  let layer = land_layer(place, map.x, bend) * (1.0 / LAND_LEDGE_M);
  let turn = 2.3 * layer;
  let bed = layer + 0.27 * sin(turn);
  let part = fract(bed);
  let width = LAND_LEDGE_STEEP.y - LAND_LEDGE_STEEP.x;
  let t = saturate((part - LAND_LEDGE_STEEP.x) / width);
  let raised = maths_smooth(t) - part;
  let steeper = (6.0 * t * (1.0 - t) / width - 1.0) * (1.0 + 0.62 * cos(turn));
  return share * vec2f(LAND_LEDGE_M * raised, steeper) + vec2f(0.0, 1.0);
}
