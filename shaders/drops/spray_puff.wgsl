// Puffs of spray: where, when and how fast breaking crests of the open sea throw them up, and how they fly. Those of a
// coast are born in spray_coast.wgsl.
//
// A puff of the age a was born at the undisplaced place X. A crest that moves at the speed c and keeps its form has
// moved from X to X + c a since. So the height of X at the birth is that of X + c a now, and X had a breaking front if
// X + c a has one now and bubbles have been left at X.

// Least part of the full spray that is drawn.
const SPRAY_LEAST_TORN = 0.001;
// Least length over which the waves that throw up spray are filtered, m.
const SPRAY_LEAST_SPACING_M = 0.5;
// Optical depths of the middle of a young puff: mist (x) and coarse drops (y).
const SPRAY_OPTICAL_DEPTH = vec2f(1.6, 1.3);
// Range of the front of a breaker over which it throws up spray.
const SPRAY_FRONT_RANGE = vec2f(0.3, 0.8);
// Speeds of coarse drops that a crest of the open sea throws up, m/s, relative to the root of the significant wave
// height, m.
const SPRAY_JET = vec2f(0.4, 1.7);
// Highest speed at which eddies behind the crest lift mist, relative to that of the wind.
const SPRAY_LIFT = 0.02;
// Fraction of the light that reaches a puff at the root of the spray.
const SPRAY_ROOT_LIGHT = 0.5;

// Properties that all puffs of spray of one origin share: of the open sea, of surf, or of waves that burst on stone.
struct SprayKind {
  // Time in which coarse drops take on the speed of the air, s.
  relaxation_s: f32,
  // Share of puffs of coarse drops, which fly in an arc; the others are mist that the wind takes along.
  coarse_share: f32,
  // Optical depth and size of a puff, relative to those in the open sea.
  thickness: f32,
  size: f32,
  // Length of a puff of coarse drops, relative to its width.
  stretch: f32,
  // Contrast, in stops, of the drifts in which puffs lie.
  drifts: f32,
}

// Time in which single drops take on the speed of the air, s.
const SPRAY_DROPS_RELAXATION_S = 0.45;
const SPRAY_OF_SEA = SprayKind(SPRAY_DROPS_RELAXATION_S, 0.45, 1.0, 1.0, 1.3, 4.0);

// Values of the foam map at an undisplaced position: foam, source, front and plume. The finest level is left out: its
// smallest fronts move more slowly than the large ones that throw up spray.
fn spray_foam(at: vec2f) -> vec4f {
  let level = foam_finest_level(1u, at, 0.0);
  if level == frame.foam_level_count {
    return vec4f(0.0);
  }
  return foam_cell(level, at);
}

// How much spray the front of a breaker at an undisplaced position throws up, 0 to 1.
fn spray_front_share(at: vec2f) -> f32 {
  return maths_rise(spray_foam(at).z, SPRAY_FRONT_RANGE);
}

// Displacement of the water at an undisplaced position, m, filtered over `spacing` metres, with breaking crests and
// their rollers, off whose tops spray flies.
fn spray_moved(at: vec2f, spacing: f32) -> vec3f {
  let waves = water_displacement(at, spacing, false).displacement;
  let surf = surf_motion(at);
  return waves + breaker_motion(at, waves.y + surf.moved.y, vec2f(0.0), surf).moved;
}

// Where and how a puff is thrown up.
struct SprayBirth {
  // Displacement of the water there, m.
  moved: vec3f,
  // Horizontal velocity (x, z) of the water, m/s.
  velocity: vec2f,
  // Lowest and highest speed at which coarse drops are thrown upwards, m/s.
  jet_m_s: vec2f,
  // Part of the full spray, 0 to 1.
  torn: f32,
  kind: SprayKind,
}

struct SprayPuff {
  position: vec3f,
  velocity: vec3f,
  radius_m: f32,
  optical_depth: f32,
  // Length divided by width, as seen from the side.
  stretch: f32,
  // Fraction of the light that other spray lets through to it.
  open: f32,
  // Contrast, in stops, of the drifts in which it lies.
  drifts: f32,
  // How far its drops are told apart, 0 to 1.
  drops: f32,
  is_coarse: bool,
}

// The birth, `t` seconds ago, of a puff at the undisplaced place `place` in the open sea. Nothing is torn there if
// `chance`, 0 to 1, exceeds the part of crests that lose spray in this wind.
fn spray_birth_at_sea(level: u32, place: vec2f, t: f32, random: vec4f, chance: f32) -> SprayBirth {
  var out: SprayBirth;
  if chance >= spray.share {
    return out;
  }
  let ahead = place + (spray.breaker_speed_m_s * t) * spray.downwind;
  out.torn = spray_front_share(ahead) * saturate(3.0 * spray_foam(place).w);
  if out.torn <= SPRAY_LEAST_TORN {
    return out;
  }
  out.moved = spray_moved(ahead, max(spray.levels[level].cell_m, SPRAY_LEAST_SPACING_M));
  out.velocity = (spray.breaker_speed_m_s * (0.8 + 0.5 * random.w)) * spray.downwind;
  out.jet_m_s = SPRAY_JET * sqrt(frame.hs_m);
  out.kind = SPRAY_OF_SEA;
  return out;
}

// The puff that a birth at the undisplaced place `place` has become at the age `age` (a fraction of its life), from
// places `cell_m` metres apart. `random` and `more` are uniform.
fn spray_puff(birth: SprayBirth, place: vec2f, cell_m: f32, age: f32, random: vec4f, more: vec4f) -> SprayPuff {
  var out: SprayPuff;
  let t = age * spray.puff_s;
  let is_coarse = more.x < birth.kind.coarse_share;
  // Time in which drops take on the speed of the air, and their fall speed.
  let relaxation_s = select(0.12 + 0.25 * more.y, birth.kind.relaxation_s, is_coarse);
  let fall = select(0.3 + 0.5 * more.y, 3.0 + 2.0 * more.y, is_coarse);
  let across = vec2f(-spray.downwind.y, spray.downwind.x);
  let thrown_up = mix(birth.jet_m_s.x, birth.jet_m_s.y, more.z * more.z);
  let jet = select((0.06 + 0.31 * more.z) * birth.jet_m_s.y, thrown_up, is_coarse);
  let sideways = (random.z - 0.5) * across;
  let start = birth.velocity + 2.0 * sideways;
  let gust = spray.wind_m_s * (0.75 + 0.35 * more.w);
  let carried = gust * spray.downwind + (0.2 * gust) * sideways;
  let lift = select(SPRAY_LIFT * spray.wind_m_s * random.z * random.z, 0.0, is_coarse);
  let rest = vec3f(carried.x, lift - fall, carried.y);
  let left = exp(-t / relaxation_s);
  let change = vec3f(start.x, jet, start.y) - rest;
  out.position = vec3f(place.x, 0.0, place.y) + birth.moved + rest * t + change * (relaxation_s * (1.0 - left));
  out.velocity = rest + change * left;
  out.drifts = birth.kind.drifts;
  out.is_coarse = is_coarse;
  // Drops of all sizes are thrown up: some puffs are veils of fine ones, which are thinner.
  out.drops = select(0.0, more.w, is_coarse);
  // Turbulence widens a puff, which thins.
  let young_m = (birth.kind.size * cell_m) * select(0.35 + 0.4 * random.z, 0.25 + 0.35 * random.z, is_coarse);
  let growth = select(0.6 + 1.9 * sqrt(age), 0.7 + 1.0 * age, is_coarse);
  out.radius_m = young_m * growth;
  out.stretch = select(1.5 + 2.0 * age, birth.kind.stretch, is_coarse);
  out.open = mix(SPRAY_ROOT_LIGHT, 1.0, maths_smooth(3.0 * age));
  let life = maths_smooth(age * 8.0) * pow(1.0 - age, select(2.5, 2.0, is_coarse));
  let depths = select(SPRAY_OPTICAL_DEPTH.x, SPRAY_OPTICAL_DEPTH.y, is_coarse);
  let flight = out.position.y - birth.moved.y;
  // The higher drops are thrown, the fewer they are. Those that fall below the water from which they came are in it.
  let thrown = (1.0 - 0.75 * more.z * more.z) * (0.4 + 0.6 * more.w) * maths_smooth(1.0 + 2.0 * flight);
  let thinned = select(1.0 - 0.7 * random.z * random.z, thrown, is_coarse);
  out.optical_depth = (birth.kind.thickness * depths) * birth.torn * life * thinned / (growth * growth);
  return out;
}
