// Colour and relief of the land's surface: sand, dune grass, heath, rock, blocks of breakwaters, concrete of a quay.

// Sides of the tiles of noise over hundreds of metres, and over kilometres, m.
const LAND_WIDE_M = 437.0;
const LAND_REGION_M = 2230.0;

// Heights up to which waves splash stone, and up to which it is weedy, relative to that which they run up a beach.
const LAND_SPLASH = 1.3;
const LAND_WEED_ZONE = 0.5;
// Heights above the still water, m, that the tide keeps wet (x) and weedy (y) also where there are no waves.
const LAND_TIDE_M = vec2f(0.40, 0.28);
// Fraction of its albedo that wet stone keeps.
const LAND_WET_STONE = 0.45;

struct LandGround {
  albedo: vec3f,
  // Slope of the fine relief, to be added to that of the land, in the frame of the coast.
  relief: vec2f,
  // Share of the pixel under a film of water, 0 to 1.
  film: f32,
}

// Colour of dry driftweed, and heights above the run-up, m, at which the swash of two tides has left it.
const LAND_WRACK = vec3f(0.105, 0.080, 0.050);
const LAND_WRACK_LINES_M = vec2f(0.10, 0.42);

// Share of the sand under driftweed: broken strands along two lines. `above` is the height above the run-up.
fn land_wrack(above: f32, middle: vec4f, fine: vec4f, size: f32) -> f32 {
  // Swash ends in curves, and each line is a few strands. A pixel averages what is narrower than it.
  let bent = above + 0.10 * middle.z + 0.030 * fine.z + 0.012 * fine.w;
  let off = abs(vec2f(bent) - LAND_WRACK_LINES_M);
  let strand = abs(off - vec2f(0.035, 0.025));
  let least = vec2f(0.007, 0.005);
  let width = least + 0.08 * size;
  let lines = saturate(1.2 - strand / width) * (least / width);
  let scraps = saturate(1.0 - off * vec2f(7.0, 12.0)) * saturate(0.9 * fine.w + 0.8 * fine.z - 1.1);
  let left = saturate(vec2f(0.75, 0.45) + vec2f(0.6 * middle.w, 0.55 * middle.z) + 0.35 * fine.w);
  return saturate(0.85 * dot(lines, left) + 0.22 * dot(scraps, left));
}

// Bare sand, from dry to wet, with what the sea has left at its upper line.
fn land_sand(height: f32, run_up: f32, middle: vec4f, fine: vec4f, wide: vec4f, size: f32) -> LandGround {
  let wet = land_wetness(height, middle.z + 0.5 * fine.w, run_up + 0.04);
  // The last waves have left it darker, up to a line of lobes.
  let fresh = land_wetness(height, 1.5 * middle.w + 0.6 * middle.z, 0.72 * run_up + 0.02);
  // Wind ripples on dry sand, in places; footless sand below the run-up is smooth.
  let rippled = saturate(0.35 + 0.5 * wide.z + 0.3 * middle.z) * (1.0 - wet);
  var out: LandGround;
  out.albedo = land_sand_albedo(middle, fine) * (1.0 + 0.07 * rippled * fine.y);
  let above = height - run_up;
  if above > -0.3 && above < 0.9 {
    out.albedo = mix(out.albedo, LAND_WRACK, land_wrack(above, middle, fine, size));
  }
  out.albedo *= mix(vec3f(1.0), LAND_DAMP, 0.6 * wet + 0.4 * fresh);
  out.relief = vec2f(0.30 * rippled * fine.x, 0.0);
  // The film drains through the sand: its edge has lobes, which are smaller where the sea is calm.
  let lively = 0.1 + 0.9 * min(run_up, 1.0);
  let lobes = lively * (0.10 * middle.z + 0.06 * fine.w + 0.04 * fine.z);
  out.film = 1.0 - maths_smooth((height + lobes - LAND_FILM_SHARE * run_up) * 5.0 / lively + 0.5);
  return out;
}

// Share of the ground that marram covers. The front of a dune has single tufts, its back is green.
fn land_marram_share(height: f32, middle: vec4f, fine: vec4f, wide: vec4f) -> f32 {
  let cover = saturate(0.36 * (height - LAND_GRASS_M + 0.45 * middle.z + 0.5 * wide.z));
  return maths_smooth(1.6 * (0.62 * middle.w + 0.78 * fine.z) - 1.2 + 3.2 * cover) * saturate(1.5 * cover);
}

// Plants on sand and soil: tufts of marram on the dunes, heath, turf and scrub behind them. `ground` is what they grow on.
fn land_plants(
  ground: LandGround, place: vec2f, height: f32, size: f32, middle: vec4f, fine: vec4f, wide: vec4f,
) -> LandGround {
  let back = land_back_share(place, height, wide.z);
  let tips = saturate(0.5 + 0.32 * fine.z + 0.2 * middle.z);
  var green = mix(LAND_MARRAM, LAND_STRAW, 0.75 * tips);
  if back > 0.0 {
    let region = land_noise(land_turned(place), LAND_REGION_M, size);
    let soil = mix(LAND_HEATH, LAND_TURF, saturate(0.5 + 0.35 * wide.w + 0.4 * region.w));
    green = mix(green, soil * max(1.0 + 0.2 * fine.z + 0.16 * middle.z + 0.1 * region.z, 0.4), back);
    let thicket = 0.75 * region.z + 0.45 * wide.z + 0.3 * middle.w;
    let scrub = maths_smooth(0.8 * thicket - 0.05) * back;
    // Round crowns, bright towards the sun.
    let toward = land_from_world(frame.sun_direction.xz);
    let sunward = land_noise((place + 0.9 * toward).yx, LAND_MIDDLE_M, size);
    let lit = max(1.0 + 0.3 * middle.w + 0.55 * (middle.w - sunward.w), 0.15);
    green = mix(green, LAND_SCRUB * lit, scrub);
  }
  let share = max(land_marram_share(height, middle, fine, wide), back);
  var out = ground;
  out.albedo = mix(ground.albedo, max(green, vec3f(0.008)), share);
  // Tufts stand up: their sides face all directions.
  out.relief = mix(ground.relief, 0.28 * vec2f(fine.w, middle.w), share);
  out.film = ground.film * (1.0 - share);
  return out;
}

// Stone of an albedo where the sea washes it: dark as high as the waves splash, and weedy as high as they cover it often.
// The last component is the share of stone that is wet.
fn land_washed(albedo: vec3f, height: f32, run_up: f32, bend: f32) -> vec4f {
  let wet = land_wetness(height, bend, LAND_SPLASH * run_up + LAND_TIDE_M.x);
  let weedy = land_wetness(height, 1.6 * bend, LAND_WEED_ZONE * run_up + LAND_TIDE_M.y);
  let dark = mix(albedo, LAND_WET_STONE * albedo, wet);
  return vec4f(mix(dark, LAND_WEED + 0.18 * albedo, 0.85 * weedy), wet);
}

// Bedrock in layers, dark and weedy where waves keep it wet.
fn land_rock(place: vec2f, height: f32, run_up: f32, size: f32, middle: vec4f, fine: vec4f, wide: vec4f) -> LandGround {
  // Layers dip gently; cracks cross them.
  let layer = height + 0.11 * place.x - 0.05 * place.y + 1.1 * wide.z;
  let strata = land_noise(vec2f(0.045 * (place.x - place.y), layer), 11.0, 0.25 * size);
  let face = land_noise(vec2f(place.x + 0.6 * place.y, height), 19.0, size);
  let tone = saturate(0.5 + 0.30 * strata.z + 0.10 * strata.w + 0.12 * middle.z);
  var out: LandGround;
  out.albedo = mix(LAND_DARK_ROCK, LAND_ROCK, tone) * max(1.0 + 0.16 * face.w + 0.10 * fine.z, 0.3);
  // Lichen and iron colour what the spray no longer reaches.
  out.albedo *= mix(vec3f(1.0), vec3f(1.16, 1.0, 0.80), saturate(0.4 * wide.w + 0.3 * middle.w));
  let washed = land_washed(out.albedo, height, run_up, 1.4 * middle.z + 0.5 * fine.z);
  out.albedo = washed.rgb;
  out.relief = vec2f(0.35 * face.z + 0.25 * strata.z, 0.32 * face.w);
  out.film = 0.35 * washed.w;
  return out;
}

// Side of the tile of blocks of a breakwater, m, which holds 19 of them, and smaller ones between.
const LAND_BLOCKS_M = 31.0;

// Blocks of a breakwater: light stone above, weed below, and dark gaps between.
fn land_rubble(place: vec2f, height: f32, run_up: f32, size: f32, middle: vec4f, fine: vec4f) -> LandGround {
  let blocks = land_noise(place + 0.7 * height, LAND_BLOCKS_M, size);
  let gap = saturate(-0.55 * blocks.w - 0.1);
  var out: LandGround;
  out.albedo = LAND_BLOCK * max(1.0 + 0.16 * middle.z + 0.13 * blocks.z + 0.08 * fine.z, 0.3) * (1.0 - 0.8 * gap);
  let washed = land_washed(out.albedo, height, run_up, 1.5 * middle.z + 0.5 * blocks.z);
  out.albedo = washed.rgb;
  out.relief = vec2f(0.5 * blocks.z + 0.25 * fine.w, 0.45 * blocks.w);
  out.film = 0.3 * washed.w;
  return out;
}

// Concrete in slabs with joints, stained, and weedy at the waterline.
fn land_concrete(place: vec2f, height: f32, size: f32, middle: vec4f, fine: vec4f) -> LandGround {
  let joint = abs(fract(place.y * (1.0 / 8.0)) - 0.5) * 8.0;
  let line = clamp((0.06 - joint) / max(size, 0.02) + 0.5, 0.0, min(0.12 / max(size, 0.02), 1.0));
  var out: LandGround;
  out.albedo = LAND_CONCRETE * max(1.0 + 0.06 * middle.z + 0.05 * fine.z, 0.4) * (1.0 - 0.45 * line);
  let wet = 1.0 - maths_smooth((height + 0.1 * middle.z - 0.3) * 1.4);
  out.albedo = mix(out.albedo, LAND_WEED + 0.12 * out.albedo, 0.9 * wet);
  return out;
}

// The ground at a place in the frame of the coast. `map` is that of land_at, `slope` the slope of the land there, `size`
// the width of the texels that are averaged over the pixel, m. Waves run up to the height `run_up`, m.
fn land_ground(place: vec2f, height: f32, run_up: f32, map: vec4f, slope: vec2f, size: f32) -> LandGround {
  let wide = land_noise(place, LAND_WIDE_M, size);
  let middle = land_noise(place.yx, LAND_MIDDLE_M, size);
  let fine = land_noise(land_turned(place), LAND_FINE_M, size);
  var out = land_sand(height, run_up, middle, fine, wide, size);
  if height > LAND_GRASS_M - 2.0 {
    out = land_plants(out, place, height, size, middle, fine, wide);
  }
  let steep = length(slope) + 0.06 * middle.z + 0.05 * fine.z;
  let rock = land_rock_share(steep);
  let built = land_built_share(map);
  if rock * (1.0 - built) > 0.0 {
    let stone = land_rock(place, height, run_up, size, middle, fine, wide);
    out = LandGround(
      mix(out.albedo, stone.albedo, rock), mix(out.relief, stone.relief, rock), mix(out.film, stone.film, rock));
  }
  if built > 0.0 {
    var made = land_concrete(place, height, size, middle, fine);
    if map.w < 0.0 {
      made = land_rubble(place, height, run_up, size, middle, fine);
    }
    out = LandGround(
      mix(out.albedo, made.albedo, built), mix(out.relief, made.relief, built), mix(out.film, made.film, built));
  }
  return out;
}
