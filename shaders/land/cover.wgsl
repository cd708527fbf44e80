// Draws stones and blades of dune grass into the G-buffer, after the mesh of the land (src/render/land/cover.rs).
// Positions and directions are in the frame of the coast: x, up, y.

@group(1) @binding(1) var<storage, read> land_stones: array<LandStone>;
@group(1) @binding(2) var<storage, read> land_corners: array<vec4f>;
@group(1) @binding(3) var<uniform> cover: LandCover;

// As the G-buffer of the water (shaders/water/light.wgsl), at a place where there is none.
struct LandGBuffer {
  // The position of no water; and what covers the ground: 0 nothing, 1 to 2 a block of a breakwater, 2 to 3 a rock, -1 to
  // -2 a blade of grass. The fraction is its tone.
  @location(0) undisplaced: vec2f,
  // Slope in the frame of the coast, height along a blade (0 to 1), and share of the light that what is beside it leaves.
  @location(1) slope: vec4f,
  @location(2) nothing: vec2f,
}

// Smallest vertical component of a normal: the G-buffer holds slopes.
const COVER_LEAST_UP = 0.11;

fn cover_g_buffer(look: f32, n: vec3f, along: f32, shade: f32) -> LandGBuffer {
  let slope = -n.xz / max(n.y, COVER_LEAST_UP);
  return LandGBuffer(vec2f(2.0 * LAND_NO_WATER_M, look), vec4f(slope, along, shade), vec2f(0.0));
}

struct StoneFragment {
  @builtin(position) clip: vec4f,
  @location(0) at: vec3f,
  // From the middle of the stone.
  @location(1) outward: vec3f,
  @location(2) shade: f32,
  @location(3) @interpolate(flat) look: f32,
}

@vertex
fn stone_vertex(@builtin(vertex_index) i: u32, @builtin(instance_index) n: u32) -> StoneFragment {
  let stone = land_stones[n];
  // Each stone has proportions and corners of its own.
  let sides = vec3f(1.0) + vec3f(0.1, 0.35, 0.35) * (noise_pcg4d_unit(vec4u(stone.seed, 7u, 8u, 9u)).xyz - 0.5);
  let corner = land_corners[i].xyz * sides + 0.09 * (noise_pcg4d_unit(vec4u(stone.seed, i, 3u, 5u)).xyz - 0.5);
  let turn = normalize(unpack4x8snorm(stone.turn));
  let turned = corner + 2.0 * cross(turn.xyz, cross(turn.xyz, corner) + turn.w * corner);
  let at = land_from_eye(stone.place, stone.height_m) + stone.size_m * turned;
  // Less light reaches the gaps between stones: the share falls towards the ground.
  let above = 0.1 + turned.y - dot(unpack2x16float(stone.slope), turned.xz);
  return StoneFragment(land_clip(at), at, turned, clamp(0.28 + 1.7 * above, 0.12, 1.0), stone.look);
}

// How round blocks of breakwaters (x) and rocks (y) look: weight of the direction from the middle of the stone in the
// normal of a face. The sea wears rocks round.
const COVER_ROUND = vec2f(0.45, 0.8);

@fragment
fn stone_fragment(in: StoneFragment) -> LandGBuffer {
  // Flat faces, rounded towards their edges.
  let across = cross(dpdx(in.at), dpdy(in.at));
  let flat_normal = across * (-sign(dot(across, in.at)) * inverseSqrt(max(dot(across, across), 1e-30)));
  let n = normalize(flat_normal + select(COVER_ROUND.x, COVER_ROUND.y, in.look >= 2.0) * normalize(in.outward));
  return cover_g_buffer(in.look, n, 0.0, in.shade);
}

// Sides of the squares of the ground with one tuft each, m: dense near the eye, and sparse around.
const COVER_TUFT_M = vec2f(0.45, 0.85);
// Numbers of corners of a blade of a dense and of a sparse tuft.
const COVER_BLADE_CORNERS = vec2u(5u, 3u);
// Height of the longest blades, m, how far from the middle of a dense and of a sparse tuft they stand, m, and their
// width, m.
const COVER_BLADE_M = 0.95;
const COVER_ROOTS_M = vec2f(0.17, 0.34);
const COVER_BLADE_WIDTH_M = 0.007;
// Smallest width of a blade in pixels.
const COVER_BLADE_PIXELS = 1.2;
// Position in clip space, outside of the picture, of blades that are not seen.
const COVER_UNSEEN = vec4f(2.0, 2.0, 2.0, 1.0);

struct GrassFragment {
  @builtin(position) clip: vec4f,
  @location(0) normal: vec3f,
  @location(1) along: f32,
  @location(2) @interpolate(flat) look: f32,
}

// Density of the grass of heath and turf relative to that of marram.
const COVER_BACK_SHARE = 0.36;

// Height of the ground at a place (x), and how well grass grows there, 0 to 1 (y).
fn cover_grass(place: vec2f) -> vec2f {
  let map = land_at(place, 0.0);
  let inside = min(place, land.side_m - place);
  if map.x < LAND_GRASS_M - 1.2 || min(inside.x, inside.y) < 0.0 {
    return vec2f(map.x, 0.0);
  }
  let wide = land_noise(place, LAND_WIDE_M, 0.5);
  let ledge = land_ledge(place, map, wide.z);
  let middle = land_noise(place.yx, LAND_MIDDLE_M, 0.2);
  let fine = land_noise(land_turned(place), LAND_FINE_M, 0.2);
  let bare = max(land_rock_share(ledge.y * length(map.yz)), land_built_share(map));
  let back = land_back_share(place, map.x, wide.z);
  let share = mix(land_marram_share(map.x, middle, fine, wide), COVER_BACK_SHARE, back);
  return vec2f(map.x + ledge.x, share * (1.0 - bare));
}

@vertex
fn grass_vertex(@builtin(vertex_index) i: u32, @builtin(instance_index) n: u32) -> GrassFragment {
  var out: GrassFragment;
  out.clip = COVER_UNSEEN;
  let is_near = n < cover.near_tufts;
  let number = select(n - cover.near_tufts, n, is_near);
  let columns = select(cover.columns.y, cover.columns.x, is_near);
  let cell = select(cover.first_far, cover.first_near, is_near) + vec2i(i32(number % columns), i32(number / columns));
  let seed = vec3u(bitcast<vec2u>(cell), select(0u, 1u, is_near));
  let random = noise_pcg4d_unit(vec4u(seed, 91u));
  let place = (vec2f(cell) + random.xy) * select(COVER_TUFT_M.y, COVER_TUFT_M.x, is_near);
  let off = place - land.eye_place;
  let far = length(vec3f(off.x, 0.7 * frame.eye_height_m, off.y)) / select(cover.reach_m.y, cover.reach_m.x, is_near);
  // With the distance from the eye, tufts become fewer and lower.
  let left = saturate(3.0 * (1.0 - far) - 1.6 * random.z);
  if left <= 0.0 {
    return out;
  }
  let ground = cover_grass(place);
  let grown = saturate(2.6 * ground.y - 0.1 - 0.4 * random.w);
  if grown <= 0.0 {
    return out;
  }
  let corners = select(COVER_BLADE_CORNERS.y, COVER_BLADE_CORNERS.x, is_near);
  let blade = noise_pcg4d_unit(vec4u(seed, 128u + i / corners));
  let corner = i % corners;
  let is_tip = corner == corners - 1u;
  let along = select(0.5 * f32(corner / 2u), 1.0, is_tip);
  let turn = 2.0 * ATM_PI * blade.x;
  let outward = vec2f(cos(turn), sin(turn));
  let length_m = COVER_BLADE_M * (0.45 + 0.55 * blade.y) * (0.45 + 0.55 * grown) * mix(0.5, 1.0, left);
  // The wind bends all blades, and they sway with gusts that run over the dunes.
  let downwind = normalize(cover.lean + vec2f(1e-6, 0.0));
  let phase = 2.0 * ATM_PI * (cover.sway - vec2f(0.11, 0.23) * dot(place, downwind) + 0.4 * random.w);
  let gust = sin(phase.x) + 0.6 * sin(phase.y + 6.0 * blade.w);
  let wind = cover.lean + downwind * (cover.sway_gain * gust);
  let lean = outward * (0.12 + 0.5 * blade.z * blade.z) + wind;
  let bent = lean * (length_m * along * along);
  let upward = length_m * along * (1.0 - 0.22 * along * dot(lean, lean));
  let root = outward * (select(COVER_ROOTS_M.y, COVER_ROOTS_M.x, is_near) * sqrt(blade.w));
  let from_eye = land_from_eye(place, ground.x - 0.06);
  let middle = from_eye + vec3f(root.x + bent.x, upward, root.y + bent.y);
  // A blade is round: marram rolls its leaves. It turns its width to the eye.
  let tangent = normalize(vec3f(2.0 * along * lean.x, 1.0, 2.0 * along * lean.y));
  let across = normalize(cross(tangent, middle));
  let facing = cross(across, tangent);
  let width_m = max(COVER_BLADE_WIDTH_M, COVER_BLADE_PIXELS * frame.pixel_angle * length(middle));
  let side = select(1.0, -1.0, (corner & 1u) == 0u) * select(1.0, 0.0, is_tip);
  let at = middle + across * (0.5 * side * width_m * (1.0 - 0.35 * along));
  out.clip = land_clip(at);
  // The normal is raised, because a blade sees the light that others scatter.
  out.normal = facing * -sign(dot(facing, middle)) + 0.8 * side * across + vec3f(0.0, 0.6, 0.0);
  out.along = along;
  out.look = -1.0 - 0.99 * fract(7.0 * blade.y + random.w);
  return out;
}

@fragment
fn grass_fragment(in: GrassFragment) -> LandGBuffer {
  return cover_g_buffer(in.look, normalize(in.normal), in.along, 0.4 + 0.6 * maths_smooth(1.4 * in.along + 0.1));
}

// Albedos of blocks, dark and light, and of a blade from its base to its tip.
const COVER_BLOCK_DARK = vec3f(0.165, 0.162, 0.160);
const COVER_BLOCK_LIGHT = vec3f(0.345, 0.318, 0.272);
const COVER_BLADE_BASE = vec3f(0.085, 0.094, 0.040);
const COVER_BLADE_GREEN = vec3f(0.165, 0.182, 0.082);
const COVER_BLADE_TIP = vec3f(0.400, 0.345, 0.205);

// Share of the sunlight on the far side of a blade that passes through it.
const COVER_BLADE_THROUGH = 0.55;

// Side of the tile of the finest noise of stones, m, and the width of a pixel, m, from which it is not seen.
const COVER_PITS_TILE_M = 0.57;
const COVER_PITS_SEEN_M = 0.06;

// The surface of a stone. `look` is that of LandGBuffer.
fn cover_stone(look: f32, place: vec2f, height: f32, run_up: f32, size: f32) -> LandGround {
  let tone = fract(look);
  // Noises over metres, decimetres and centimetres, of the place and the height, so that steep sides have them, too.
  let at = vec2f(place.x + 0.6 * place.y, 1.2 * height + 9.0 * tone);
  let face = land_noise(at, 6.1, size);
  let grain = land_noise(vec2f(1.3 * height + 0.4 * place.x, place.y - 0.7 * place.x + 5.0 * tone), 1.7, size);
  var pits = vec4f(0.0);
  if size < COVER_PITS_SEEN_M {
    pits = (1.0 - size / COVER_PITS_SEEN_M) * land_noise(at.yx + place, COVER_PITS_TILE_M, size);
  }
  let stone = mix(COVER_BLOCK_DARK, COVER_BLOCK_LIGHT, tone);
  let rock = mix(LAND_DARK_ROCK, LAND_ROCK, 0.35 + 0.65 * tone);
  var out: LandGround;
  let stain = max(1.0 + 0.2 * face.z + 0.16 * face.w + 0.2 * grain.z + 0.1 * pits.z, 0.3);
  // Little light reaches cracks.
  let cracks = saturate(vec2f(-0.8, -0.7) * vec2f(face.w, grain.w) - vec2f(0.5, 0.55));
  out.albedo = select(stone, rock, look >= 2.0) * stain;
  let washed = land_washed(out.albedo, height, run_up, 0.8 * face.z + 3.0 * tone - 1.5);
  out.albedo = washed.rgb * ((1.0 - 0.6 * cracks.x) * (1.0 - 0.4 * cracks.y));
  out.relief = vec2f(0.28, 0.26) * face.zw + vec2f(0.4, 0.36) * grain.zw + vec2f(0.16, 0.2) * pits.zw;
  out.film = LAND_STONE_FILM * washed.w;
  out.foamy = LAND_STONE_FOAMY * washed.w;
  return out;
}

// The surface of a blade of grass at a height along it.
fn cover_blade(look: f32, along: f32) -> LandGround {
  let tone = -1.0 - look;
  let straw = saturate(1.5 * along + 1.1 * tone - 0.95);
  let green = mix(COVER_BLADE_BASE, COVER_BLADE_GREEN, saturate(2.0 * along));
  return LandGround(mix(green, COVER_BLADE_TIP, straw), vec2f(0.0), 0.0, 0.0);
}

// The surface of what covers the ground: `look` and `along` are those of LandGBuffer.
fn cover_ground(look: f32, along: f32, place: vec2f, height: f32, run_up: f32, size: f32) -> LandGround {
  if look < 0.0 {
    return cover_blade(look, along);
  }
  return cover_stone(look, place, height, run_up, size);
}

// Side of the tile of blocks of a breakwater, m, which holds 19 of them, and smaller ones between.
const COVER_BLOCKS_M = 31.0;

// Blocks of a breakwater: light stone above, weed below, and dark gaps between.
fn cover_rubble(place: vec2f, height: f32, run_up: f32, size: f32, middle: vec4f, fine: vec4f) -> LandGround {
  let blocks = land_noise(place + 0.7 * height, COVER_BLOCKS_M, size);
  let gap = saturate(-0.55 * blocks.w - 0.1);
  var out: LandGround;
  out.albedo = LAND_BLOCK * max(1.0 + 0.16 * middle.z + 0.13 * blocks.z + 0.08 * fine.z, 0.3) * (1.0 - 0.8 * gap);
  let washed = land_washed(out.albedo, height, run_up, 1.5 * middle.z + 0.5 * blocks.z);
  out.albedo = washed.rgb;
  out.relief = vec2f(0.5 * blocks.z + 0.25 * fine.w, 0.45 * blocks.w);
  out.film = LAND_STONE_FILM * washed.w;
  out.foamy = LAND_STONE_FOAMY * washed.w;
  return out;
}

// Concrete in slabs with joints, stained, and weedy at the waterline.
fn cover_concrete(place: vec2f, height: f32, size: f32, middle: vec4f, fine: vec4f) -> LandGround {
  let joint = abs(fract(place.y * (1.0 / 8.0)) - 0.5) * 8.0;
  let line = clamp((0.06 - joint) / max(size, 0.02) + 0.5, 0.0, min(0.12 / max(size, 0.02), 1.0));
  var out: LandGround;
  out.albedo = LAND_CONCRETE * max(1.0 + 0.06 * middle.z + 0.05 * fine.z, 0.4) * (1.0 - 0.45 * line);
  let wet = 1.0 - maths_smooth((height + 0.1 * middle.z - 0.3) * 1.4);
  out.albedo = mix(out.albedo, LAND_WEED + 0.12 * out.albedo, 0.9 * wet);
  return out;
}
