// Colour and relief of the land's surface: sand, dune grass and heath, and where rock (rock.wgsl) and what is built
// (cover.wgsl) take their place.

// Sides of the tiles of noise over hundreds of metres, and over kilometres, m.
const LAND_WIDE_M = 437.0;
const LAND_REGION_M = 2230.0;

struct LandGround {
  albedo: vec3f,
  // Slope of the fine relief, to be added to that of the land, in the frame of the coast.
  relief: vec2f,
  // Share of the pixel under a film of water that mirrors, 0 to 1.
  film: f32,
  // Share of the foam of the last waves that stays here, 0 to 1: a film of water on sand keeps all of it.
  foamy: f32,
}

// The grounds `a` and `b`, with the share of `b`.
fn land_mix(a: LandGround, b: LandGround, share: f32) -> LandGround {
  let wet = mix(vec2f(a.film, a.foamy), vec2f(b.film, b.foamy), share);
  return LandGround(mix(a.albedo, b.albedo, share), mix(a.relief, b.relief, share), wet.x, wet.y);
}

// Share of a film of water in the look of sand that the last waves have left. And how wet that sand must be to begin to
// shine, and to shine fully. This range is narrower than the edge of the wet sand, so the shine ends in lobes and not in
// a haze.
const LAND_SHEEN = 0.9;
const LAND_SHEEN_WETNESS = vec2f(0.6, 0.95);
// Side of the tile of the grain of sand, m, and the width of a pixel, m, from which it is not seen.
const LAND_GRAIN_M = 0.83;
const LAND_GRAIN_SEEN_M = 0.02;

// Height above one and a half run-ups, m, from which sand is dry: the edges of damp sand and of the film of water end
// lower, with all of their lobes.
const LAND_DRY_FROM_M = 0.4;

// Heights of the dents in trodden sand, m for each deviation of the fractal noise and of that of blocks, which become
// pits; and the step over which their slope is taken, m.
const LAND_TRODDEN_M = vec2f(0.0012, -0.003);
const LAND_TRODDEN_STEP_M = 0.04;

// Bare sand, from dry to wet, with what the sea has left at its upper line.
fn land_sand(
  place: vec2f, height: f32, run_up: f32, middle: vec4f, fine: vec4f, wide: vec4f, size: f32,
) -> LandGround {
  // Swash leaves lobes along the shore. No wave wets the sand above this height.
  var wet = 0.0;
  var fresh = 0.0;
  var film = 0.0;
  if height < 1.5 * run_up + LAND_DRY_FROM_M {
    let tongues = swash_tongues(place, size);
    wet = land_wetness(height, 0.5 * tongues.z + 0.12 * fine.w, run_up + 0.04);
    // The last waves have left it darker, up to a line of lobes.
    fresh = min(wet, land_wetness(height, 0.6 * tongues.w + 0.1 * middle.z, 0.9 * run_up + 0.02));
    // The film drains through the sand: its edge has tongues, which are smaller where the sea is calm.
    let lively = 0.1 + 0.9 * min(run_up, 1.0);
    let over = height - LAND_FILM_SHARE * run_up;
    let lobes = lively * (0.08 * tongues.z + 0.05 * tongues.w + 0.014 * fine.z + 0.008 * fine.w);
    film = 1.0 - maths_smooth((over + lobes) * 30.0 / lively + 0.5);
  }
  // Wind ripples on dry sand, in places; footless sand below the run-up is smooth.
  let rippled = saturate(0.35 + 0.5 * wide.z + 0.3 * middle.z) * (1.0 - wet);
  var out: LandGround;
  out.albedo = land_sand_albedo(middle, fine) * (1.0 + 0.10 * rippled * fine.y);
  if size < LAND_GRAIN_SEEN_M {
    let grain = land_noise(place, LAND_GRAIN_M, size);
    out.albedo *= max(1.0 + (1.0 - size / LAND_GRAIN_SEEN_M) * dot(vec2f(0.11, 0.06), grain.zw), 0.3);
  }
  let above = height - run_up;
  if above > -0.3 && above < 0.9 {
    out.albedo = mix(out.albedo, LAND_WRACK, land_wrack(above, middle, fine, size));
  }
  if wet > 0.0 {
    out.albedo *= mix(vec3f(1.0), LAND_DAMP, 0.75 * wet + 0.25 * fresh);
    if size < LAND_MARKS_SEEN_M {
      out.albedo *= 1.0 - 0.45 * wet * land_swash_marks(height, run_up, middle, fine, size);
    }
  }
  let left = saturate(0.6 * middle.w - 0.2 * middle.z - 0.25) * wet;
  out.relief = vec2f((0.30 * rippled + 0.10 * left) * fine.x, 0.0);
  // Dry sand is trodden in places. Far away the pattern would repeat.
  let trodden = (1.0 - wet) * saturate(1.2 - 6.0 * size) * saturate(0.5 + 0.6 * middle.w + 0.5 * middle.z);
  if trodden > 0.0 {
    // Only the slope towards the sun decides how bright the sand is.
    let step_m = max(LAND_TRODDEN_STEP_M, size);
    let sunward = land_noise(land_turned(place + step_m * land.toward_sun), LAND_FINE_M, size);
    out.relief += (trodden / step_m) * dot(LAND_TRODDEN_M, sunward.zw - fine.zw) * land.toward_sun;
  }
  // Sand that is full of water shines, too.
  out.film = max(film, LAND_SHEEN * maths_rise(fresh, LAND_SHEEN_WETNESS));
  out.foamy = out.film;
  return out;
}

// Share of the ground that marram covers. The front of a dune has single tufts, its back is green.
fn land_marram_share(height: f32, middle: vec4f, fine: vec4f, wide: vec4f) -> f32 {
  let cover = saturate(0.36 * (height - LAND_GRASS_M + 0.45 * middle.z + 0.5 * wide.z));
  return maths_smooth(1.6 * (0.62 * middle.w + 0.78 * fine.z) - 1.2 + 3.2 * cover) * saturate(1.5 * cover);
}

// Plants on sand and soil: tufts of marram on the dunes, heath, turf and scrub behind them. `ground` is what they grow
// on, `most` the largest share that they cover.
fn land_plants(
  ground: LandGround, most: f32, place: vec2f, height: f32, size: f32, middle: vec4f, fine: vec4f, wide: vec4f,
) -> LandGround {
  let back = land_back_share(place, height, wide.z);
  let tips = saturate(0.5 + 0.32 * fine.z + 0.2 * middle.z);
  var green = mix(LAND_MARRAM, LAND_STRAW, 0.75 * tips);
  if back > 0.0 {
    let region = land_noise(land_turned(place), LAND_REGION_M, size);
    let soil = mix(LAND_HEATH, LAND_TURF, saturate(0.5 + 0.45 * wide.w + 0.3 * region.w + 0.35 * middle.z));
    // Round crowns and tussocks, bright towards the sun and dark between each other.
    let sunward = land_noise((place + 0.7 * land.toward_sun).yx, LAND_MIDDLE_M, size);
    let bright = middle.zw - sunward.zw;
    let tussocks = 1.0 + 0.24 * fine.z + 0.1 * fine.w + 0.22 * middle.w + 0.45 * bright.x + 0.35 * bright.y;
    green = mix(green, soil * max(tussocks, 0.25), back);
    let thicket = 0.75 * region.z + 0.45 * wide.z + 0.45 * middle.w;
    let scrub = maths_smooth(1.2 * thicket - 0.1) * back;
    let lit = max(1.0 + 0.4 * middle.w + 0.7 * bright.y + 0.15 * fine.w, 0.15);
    green = mix(green, LAND_SCRUB * lit, scrub);
  }
  let share = most * max(land_marram_share(height, middle, fine, wide), back);
  var out = ground;
  out.albedo = mix(ground.albedo, max(green, vec3f(0.008)), share);
  // Tufts stand up: their sides face all directions.
  out.relief = mix(ground.relief, 0.28 * vec2f(fine.w, middle.w), share);
  out.film = ground.film * (1.0 - share);
  out.foamy = ground.foamy * (1.0 - share);
  return out;
}

// By how much the slope of the ground around that bares rock is smaller below LAND_FOOT_M: the foot of a cliff is a
// platform of rock.
const LAND_FOOT_SLOPE = 0.06;

// The ground at a place in the frame of the coast. `map` is that of land_at, `slope` the slope of the land there,
// `size` the width of the texels that are averaged over the pixel, m, and `around` the map's mean over LAND_AROUND_M.
// Waves run up to the height `run_up`, m.
fn land_ground(
  place: vec2f, height: f32, run_up: f32, map: vec4f, slope: vec2f, size: f32, around: vec4f,
) -> LandGround {
  let wide = land_noise(place, LAND_WIDE_M, size);
  let middle = land_noise(place.yx, LAND_MIDDLE_M, size);
  let fine = land_noise(land_turned(place), LAND_FINE_M, size);
  let ledge = land_ledge(place, map, wide.z).y;
  let cut = ledge * slope;
  let foot = LAND_FOOT_SLOPE * (1.0 - maths_rise(height, LAND_FOOT_M));
  let hill = max(length(around.yz), LAND_CLIFF_LOCAL * length(slope));
  let steep = maths_rise(hill + foot + 0.02 * middle.z, LAND_CLIFF_SLOPES);
  var cliff = steep;
  if height < LAND_FOOT_M.y {
    cliff = max(steep, land_level_rock(around, height));
  }
  // Plants hold in ragged patches on cliffs.
  let ragged = (0.06 + 0.10 * cliff) * middle.z + 0.05 * fine.z + cliff * (0.16 + 0.13 * fine.z + 0.08 * fine.w);
  let upright = land_rock_share(length(cut) + ragged);
  let rock = max(upright, cliff);
  let built = land_built_share(map);
  var out: LandGround;
  // Rock and what is built hide all of the sand.
  if max(rock, built) < 1.0 {
    out = land_sand(place, height, run_up, middle, fine, wide, size);
  }
  if rock * (1.0 - built) > 0.0 {
    let stone = land_rock(place, height, run_up, cut, around, size, middle, wide);
    out = land_mix(out, stone, rock);
  }
  if height > LAND_GRASS_M - 2.0 && upright < 1.0 {
    out = land_plants(out, 1.0 - upright, place, height, size, middle, fine, wide);
  }
  if built > 0.0 {
    var made = cover_concrete(place, height, size, middle, fine);
    if map.w < 0.0 {
      made = cover_rubble(place, height, run_up, size, middle, fine);
    }
    out = land_mix(out, made, built);
  }
  out.relief += (ledge - 1.0) * slope;
  return out;
}
