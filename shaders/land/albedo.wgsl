// Albedos of the kinds of ground, and where each kind lies.

// Slopes between which land becomes rock.
const LAND_ROCK_SLOPES = vec2f(0.45, 0.85);
// Height above the still water, m, at which the first dune grass grows.
const LAND_GRASS_M = 3.2;
// Fractions of its albedo, RGB, that wet sand keeps.
const LAND_DAMP = vec3f(0.48, 0.44, 0.40);
// Albedos.
const LAND_MARRAM = vec3f(0.112, 0.122, 0.056);
const LAND_STRAW = vec3f(0.235, 0.200, 0.112);
const LAND_HEATH = vec3f(0.072, 0.068, 0.036);
const LAND_TURF = vec3f(0.074, 0.085, 0.035);
const LAND_SCRUB = vec3f(0.036, 0.045, 0.020);
const LAND_ROCK = vec3f(0.310, 0.276, 0.234);
const LAND_DARK_ROCK = vec3f(0.120, 0.108, 0.095);
const LAND_WEED = vec3f(0.030, 0.034, 0.016);
const LAND_BLOCK = vec3f(0.175, 0.168, 0.155);
const LAND_CONCRETE = vec3f(0.400, 0.385, 0.355);

// Albedo of dry sand relative to that of sand whose pores are full of water, as on the bed: water between the grains
// turns light less, so that it goes deeper (Twomey, Bohren and Mergenthaler 1986).
const LAND_DRY = 1.1;

// Albedo of dry sand, from its noises over tens of metres and over metres.
fn land_sand_albedo(middle: vec4f, fine: vec4f) -> vec3f {
  return material.bed_colour * LAND_DRY * max(1.0 + 0.05 * middle.z + 0.06 * fine.z, 0.5);
}

// Height up to which a film of water covers the sand, relative to that which the waves run up: by Stockdon's formula the
// set-up and an eighth of the swash are 0.45 to 0.52 of the run-up, on slopes of 4 to 10 %.
const LAND_FILM_SHARE = 0.5;

// Share of ground that is wet at a height above the still water, m, where the waves run up to the height `run_up`, m. A
// normal noise bends the line. The calmer the sea, the narrower is the edge.
fn land_wetness(height: f32, bend: f32, run_up: f32) -> f32 {
  let over = height - run_up * (1.0 + 0.13 * bend);
  return 1.0 - maths_smooth(over / (0.06 + 0.3 * run_up) + 0.5);
}

// Share of heath and turf, which grow behind the dunes. `wide` is normal noise over hundreds of metres.
fn land_back_share(place: vec2f, height: f32, wide: f32) -> f32 {
  return maths_smooth((place.x - land.side_m.x) * 0.004 + 0.25 * (height - 5.5) + 0.55 * wide);
}

// Share of rock in ground of a slope.
fn land_rock_share(steep: f32) -> f32 {
  return maths_rise(steep, LAND_ROCK_SLOPES);
}

// Width of the texels of the map, m, whose height and slope tell hollows, and the foot of a cliff from a beach. The
// factor on that slope: half of this ground is level bed. And by how much, m, that height must exceed the height of a
// place to make it the foot of a cliff, however gently it slopes itself: on built-in beaches it is less than 1.8 m,
// below dunes too.
const LAND_AROUND_M = 40.0;
const LAND_CLIFF_FOOT_SLOPES = 2.0;
const LAND_CLIFF_FOOT_HEIGHTS_M = vec2f(1.8, 3.0);
// Heights above the still water, m, between which level ground below a cliff ceases to be bare rock.
const LAND_FOOT_M = vec2f(2.0, 4.0);
// Distance before stone, m, at which the waves that wash it are read: nearer, the map's texels average their run-up with
// that of the land.
const LAND_BEFORE_STONE_M = 12.0;

// Share of rock at a place near the water that has the height `height`, m. `around` is land_at over LAND_AROUND_M.
fn land_foot_share(around: vec4f, height: f32) -> f32 {
  // Beside a breakwater lies sand.
  let natural = 1.0 - saturate(4.0 * abs(around.w));
  let high = natural * maths_rise(around.x - height, LAND_CLIFF_FOOT_HEIGHTS_M);
  return max(high, land_rock_share(LAND_CLIFF_FOOT_SLOPES * length(around.yz)));
}

// Share of land that is level and yet bare rock, because a cliff stands on it. The parameters are those of
// land_foot_share.
fn land_level_rock(around: vec4f, height: f32) -> f32 {
  return (1.0 - maths_rise(height, LAND_FOOT_M)) * land_foot_share(around, height);
}

// Share of rock at a place that may be the foot of a cliff, where the ground has the height `height`, m, over texels of
// `size` metres. The ground around is read over wider texels than that height, or both would be the same.
fn land_cliff_share(place: vec2f, height: f32, size: f32) -> f32 {
  return land_foot_share(land_at(place, land_lod(max(LAND_AROUND_M, 2.0 * size))), height);
}

// Share of blocks or concrete in the ground. `map` is that of land_at.
fn land_built_share(map: vec4f) -> f32 {
  return saturate(4.0 * abs(map.w) - 1.0);
}

// Mean slopes of the ground around between which rock lies bare also where it is level, and the part of the slope of
// the land itself that counts as much.
const LAND_CLIFF_SLOPES = vec2f(0.22, 0.32);
const LAND_CLIFF_LOCAL = 0.6;

// Mean albedo of the ground over texels of `size` metres, without the patterns of shaders/land/ground.wgsl. `map` is
// that of land_at over these texels.
fn land_mean_albedo(place: vec2f, map: vec4f, size: f32) -> vec3f {
  let height = map.x;
  var albedo = material.bed_colour * LAND_DRY * mix(vec3f(1.0), LAND_DAMP, land_wetness(height, 0.0, land.run_up_m));
  let back = land_back_share(place, height, 0.0);
  let green = mix(mix(LAND_MARRAM, LAND_STRAW, 0.37), 0.5 * (LAND_HEATH + LAND_TURF), back);
  albedo = mix(albedo, green, max(saturate(0.54 * (height - LAND_GRASS_M)), back));
  // As in land_ground, a mean slope bares more rock than the slope of a single place.
  let counted = mix(LAND_CLIFF_LOCAL, 1.0, saturate(size / LAND_AROUND_M));
  let rock = maths_rise(counted * length(map.yz), LAND_CLIFF_SLOPES);
  albedo = mix(albedo, mix(LAND_DARK_ROCK, LAND_ROCK, 0.5), rock);
  return mix(albedo, select(LAND_CONCRETE, LAND_BLOCK, map.w < 0.0), land_built_share(map));
}

// Heights up to which waves splash stone, and up to which it is weedy, relative to that which they run up a beach.
const LAND_SPLASH = 1.9;
const LAND_WEED_ZONE = 0.7;
// Heights above the still water, m, that the tide keeps wet (x) and weedy (y) also where there are no waves.
const LAND_TIDE_M = vec2f(1.1, 0.6);
// Fraction of its albedo that wet stone keeps.
const LAND_WET_STONE = 0.52;

// Share of wet stone under a film of water that mirrors: stone is rough, so it is small. And the share of the foam of
// the last waves that stays on wet stone.
const LAND_STONE_FILM = 0.06;
const LAND_STONE_FOAMY = 0.3;

// Stone of an albedo where the sea washes it: dark as high as the waves splash, and weedy as high as they cover it
// often. The last component is the share of stone that is wet.
fn land_washed(albedo: vec3f, height: f32, run_up: f32, bend: f32) -> vec4f {
  let wet = land_wetness(height, bend, LAND_SPLASH * run_up + LAND_TIDE_M.x);
  let weedy = land_wetness(height, 1.6 * bend, LAND_WEED_ZONE * run_up + LAND_TIDE_M.y);
  let dark = mix(albedo, LAND_WET_STONE * albedo, wet);
  return vec4f(mix(dark, LAND_WEED + 0.18 * albedo, 0.85 * weedy), wet);
}
