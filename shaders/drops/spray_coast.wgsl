// Spray at a coast: surf throws it off its lip in any wind, and waves that meet stone burst. Few places lie on a lip or
// at the foot of stone, both of which are narrow. So puffs of the places around are gathered there.

// Least height of waves, relative to that from which they break, near which a breaker may be.
const SPRAY_SURF_NEAR = 0.4;
// Phase before the crest, rad, of the lip (x), and the width of what throws up spray before it (y).
const SPRAY_LIP = vec2f(-0.35, 0.3);
// Phases around the lip, rad, from which puffs are gathered there, number of steps in which it is searched, and by how
// much the last one may miss it, rad.
const SPRAY_LIP_REACH = 2.0;
const SPRAY_LIP_STEPS = 3u;
const SPRAY_LIP_MISSED = vec2f(0.45, 0.15);
// Speed of the lip, relative to that of the wave: least, and how much more it is at most.
const SPRAY_LIP_SPEED = vec2f(0.63, 0.36);
// Speeds of drops thrown up, relative to that of water that falls as deep as the wave is high.
const SPRAY_SURF_JET = vec2f(0.05, 0.5);
const SPRAY_OF_SURF = SprayKind(SPRAY_DROPS_RELAXATION_S, 1.0, 0.14, 0.9, 2.2, 1.0);

// The lip of a wave.
struct SprayLip {
  // Undisplaced position now, and where it was at the birth of the puff.
  now: vec2f,
  then: vec2f,
  // Velocity of the wave, m/s, and the way, m, from the lip to the middle of the front.
  velocity: vec2f,
  to_front: vec2f,
  // Height of the wave, m, before the coast's factor.
  height_m: f32,
  // Whether the lip was found, 0 to 1.
  found: f32,
}

// The lip nearest to the undisplaced place `place` of a wave that has moved on for `t` seconds and has kept its form.
// `phase`: phase before the crest, rad, of the lip.
fn spray_lip(map: FrameCascade, place: vec2f, t: f32, phase: f32) -> SprayLip {
  var out: SprayLip;
  let wave = surf_wave(map, place);
  let wave_number = wave.wave_number;
  let onshore = wave.turn / wave_number;
  out.velocity = sqrt(spray.gravity_m_s2 / wave_number * tanh(wave_number * wave.depth_m)) * onshore;
  out.to_front = (SURF_FRONT_PHASE / wave_number) * onshore;
  out.now = place + t * out.velocity;
  for (var step = 0u; step < SPRAY_LIP_STEPS; step++) {
    let half_amplitude = surf_sample(map, out.now).xy;
    let off = maths_phase(half_amplitude) - phase;
    if abs(off) > SPRAY_LIP_REACH {
      out.found = 0.0;
      return out;
    }
    out.height_m = 4.0 * length(half_amplitude);
    out.found = wave.known * maths_rise(abs(off), SPRAY_LIP_MISSED);
    if step + 1u < SPRAY_LIP_STEPS {
      out.now -= (off / wave_number) * onshore;
    }
  }
  out.then = out.now - t * out.velocity;
  return out;
}

// The birth, `t` seconds ago, of a puff of surf at the undisplaced place `place`, where the coast's waves have the
// factor `gain`.
fn spray_birth_of_surf(map: FrameCascade, gain: f32, place: vec2f, t: f32, random: vec4f) -> SprayBirth {
  var out: SprayBirth;
  let uv = map.uv_below_eye + place * map.inverse_patch;
  let over = gain * surf_at(map.layer, uv).z;
  if over < SPRAY_SURF_NEAR {
    return out;
  }
  let lip = spray_lip(map, place, t, SPRAY_LIP.x + SPRAY_LIP.y * (random.x * random.x));
  if lip.found <= 0.0 {
    return out;
  }
  // The white water of the front tells that the wave breaks. The sheet that runs up the beach throws up nothing.
  out.torn = lip.found * breaker_surf_share(lip.now) * spray_front_share(lip.now + lip.to_front);
  if out.torn <= SPRAY_LEAST_TORN {
    return out;
  }
  let gathered = lip.then - place;
  out.moved = spray_moved(lip.now, SPRAY_LEAST_SPACING_M) + vec3f(gathered.x, 0.0, gathered.y);
  out.velocity = (SPRAY_LIP_SPEED.x + SPRAY_LIP_SPEED.y * random.w) * lip.velocity;
  out.jet_m_s = sqrt(2.0 * spray.gravity_m_s2 * gain * lip.height_m) * SPRAY_SURF_JET;
  out.kind = SPRAY_OF_SURF;
  return out;
}

// Heights of the run-up, m, from which waves burst on stone, and from which all of them do; and heights of a crest,
// relative to the run-up, over which its burst grows.
const SPRAY_BURST_RUN_UP_M = vec2f(0.3, 1.0);
const SPRAY_BURST_CREST = vec2f(0.1, 0.6);
// Greatest height of stone and depth of water, m, and least slope from which puffs are gathered, and the depths of the
// still water, m, in which they are born: stones stand out of the slope of the map by a metre or two.
const SPRAY_BURST_HIGHEST_M = 0.3;
const SPRAY_BURST_DEEPEST_M = 6.0;
const SPRAY_BURST_STEEP = 0.2;
const SPRAY_BURST_DEPTH_M = vec2f(0.6, 2.4);
// Greatest error of that depth, m.
const SPRAY_BURST_MISSED_M = vec2f(2.0, 1.0);
// Part of a period before and after the arrival of a crest in which it bursts.
const SPRAY_BURST_TURNS = 0.12;
// Speeds of water thrown up, relative to that of water that falls as deep as the crest is high.
const SPRAY_BURST_JET = vec2f(0.73, 3.2);
// Speed away from the stone, m/s: least, and how much more it is at most.
const SPRAY_BURST_BACK_M_S = vec2f(0.4, 1.2);
// Sheets of water keep their speed longer than drops.
const SPRAY_OF_BURST = SprayKind(0.9, 1.0, 3.1, 1.6, 2.0, 1.0);

// The birth, `t` seconds ago, of a puff at the undisplaced place `place`, where a crest meets stone.
fn spray_birth_at_stone(map: FrameCascade, place: vec2f, t: f32, random: vec4f) -> SprayBirth {
  var out: SprayBirth;
  let below = land_at(land_place(place), 0.0);
  let steep = length(below.yz);
  if below.x > SPRAY_BURST_HIGHEST_M || -below.x > SPRAY_BURST_DEEPEST_M || steep < SPRAY_BURST_STEEP {
    return out;
  }
  let up = land_to_world(below.yz) / steep;
  let depth_m = mix(SPRAY_BURST_DEPTH_M.x, SPRAY_BURST_DEPTH_M.y, random.x);
  let gathered = -((depth_m + below.x) / steep) * up;
  let foot = place + gathered;
  let foot_place = land_place(foot);
  let ground = land_at(foot_place, 0.0);
  let hard = max(land_built_share(ground), land_cliff_share(foot_place, ground.x, 0.0));
  out.torn = hard * maths_rise(abs(ground.x + depth_m), SPRAY_BURST_MISSED_M);
  if out.torn <= SPRAY_LEAST_TORN {
    return out;
  }
  let before = foot - LAND_BEFORE_STONE_M * up;
  let gains = coast_at(before);
  let half_amplitude = surf_sample(map, before).xy;
  let crest_m = 2.0 * gains.z * length(half_amplitude);
  let lively = maths_rise(gains.w, SPRAY_BURST_RUN_UP_M) * maths_rise(crest_m / max(gains.w, 0.1), SPRAY_BURST_CREST);
  // The phase falls with time.
  let turns_then = maths_phase(half_amplitude) / (2.0 * ATM_PI) + t * spray.peak_hz;
  let off = abs(fract(turns_then + 0.5) - 0.5);
  out.torn *= lively * maths_smooth(1.0 - off / SPRAY_BURST_TURNS);
  // Between blocks, more is thrown up in some places than in others.
  let throat = saturate(0.7 + 0.3 * land_noise(foot_place, LAND_FINE_M, 0.5).z);
  out.moved = vec3f(gathered.x, crest_m, gathered.y);
  out.velocity = -(SPRAY_BURST_BACK_M_S.x + SPRAY_BURST_BACK_M_S.y * random.w) * up;
  out.jet_m_s = (throat * sqrt(2.0 * spray.gravity_m_s2 * crest_m)) * SPRAY_BURST_JET;
  out.kind = SPRAY_OF_BURST;
  return out;
}

// The birth, `t` seconds ago, of a puff at the undisplaced place `place`, by what throws up spray there: surf, stone,
// or the wind. `chance`, 0 to 1, decides whether that is torn off at all.
fn spray_birth(level: u32, place: vec2f, t: f32, random: vec4f, chance: f32) -> SprayBirth {
  if WATER_COAST {
    let gain = coast_at(place).z;
    for (var c = 0u; c < frame.cascade_count && gain > 0.0 && chance < spray.coast_share; c++) {
      let map = frame.cascades[c];
      if map.coast_gains.z == 0.0 {
        continue;
      }
      let surf = spray_birth_of_surf(map, gain, place, t, random);
      if surf.torn > SPRAY_LEAST_TORN {
        return surf;
      }
      let burst = spray_birth_at_stone(map, place, t, random);
      if burst.torn > SPRAY_LEAST_TORN {
        return burst;
      }
    }
  }
  return spray_birth_at_sea(level, place, t, random, chance);
}
