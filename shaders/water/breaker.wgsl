// Breaking crests. The top of a crest that breaks is pushed along the wind, with which it travels, so that its lee face
// is steeper than its weather face, and the roller of foam on its front lies on the water as a layer. At a coast the wave
// has its shape from surf.wgsl, and bears a thicker roller of billows.

// Number of foam levels that move the water; on coarser ones, what they move is smaller than a pixel.
const BREAKER_LEVELS = 2u;
// Largest push, relative to the height of the crest above the mean. Lee faces become 1.2 to 1.4 times as steep as
// weather faces, as those of measured spilling breakers (tests/breaking.rs).
const BREAKER_PUSH_PER_HEIGHT = 0.22;
// Excess at which the push is half of the largest, squared.
const BREAKER_HALF_EXCESS_SQUARE = 2.0;
// Thickness of a roller, relative to the height of its crest above the mean.
const BREAKER_ROLLER_PER_HEIGHT = 0.1;
// Thickness of a roller at a coast: the first number between billows, and both together on their tops.
const BREAKER_SURF_ROLLER = vec2f(0.19, 0.11);
// How far that roller also swells forward, relative to its thickness, because it lies on a steep front.
const BREAKER_SURF_FORWARD = 0.75;
// Reciprocal of the coast's factor on short waves from which waves are surf. On the beach, where only a sheet of water
// runs up, the factor is 0.
const BREAKER_SURF_RISE = 2.5;

// State of the foam at a position, from the maps of foam/foam.wgsl, with its derivatives along x and z, 1/m.
struct BreakerState {
  // Excess over the breaking criterion (x), 0 where no crest breaks, and front of the foam (y).
  value: vec2f,
  along_x: vec2f,
  along_z: vec2f,
}

// State of the foam at a position relative to the point below the eye, m.
fn breaker_state(at: vec2f) -> BreakerState {
  var out: BreakerState;
  var left = 1.0;
  for (var level = 0u; level < min(frame.foam_level_count, BREAKER_LEVELS) && left > 0.0; level++) {
    let map = frame.foam_levels[level];
    let off = abs(at - map.centre);
    let share = left * saturate(5.0 - 5.0 * max(off.x, off.y) * map.inverse_half_side);
    if share <= 0.0 {
      continue;
    }
    left -= share;
    // Means and differences over two cells, because bilinear interpolation bends at every cell.
    let uv = map.uv_below_eye + at * map.inverse_side;
    let step = vec2f(map.inverse_side / map.inverse_cell, 0.0);
    let east = textureSampleLevel(foam_map, nearest_mip_sampler, uv + step, level, 0.0).yz;
    let west = textureSampleLevel(foam_map, nearest_mip_sampler, uv - step, level, 0.0).yz;
    let south = textureSampleLevel(foam_map, nearest_mip_sampler, uv + step.yx, level, 0.0).yz;
    let north = textureSampleLevel(foam_map, nearest_mip_sampler, uv - step.yx, level, 0.0).yz;
    out.value += (0.25 * share) * (east + west + south + north);
    let per_m = 0.5 * share * map.inverse_cell;
    out.along_x += per_m * (east - west);
    out.along_z += per_m * (south - north);
  }
  return out;
}

// Lengths of the billows of a roller at a coast, m, in two pairs of directions; lengths, m, over which their rows bend;
// and spacings of the mesh, m, between which billows fade, because coarser meshes cannot show them.
const BREAKER_BILLOWS_M = vec4f(1.3, 1.0, 0.5, 0.41);
const BREAKER_BENDS_M = vec4f(3.7, 4.3, 1.9, 2.3);
const BREAKER_BILLOW_SPACINGS_M = vec2f(0.25, 0.7);
// Mean height of billows, relative to the highest one, and its derivatives: coarse meshes have it in their place.
const BREAKER_MEAN_BILLOWS = vec3f(0.44, 0.0, 0.0);

// Height of the billows of a roller, 0 to 1 (x), and its derivatives along x and z, 1/m (yz): round heaps with creases
// between. They stay where they are while the front runs over them, so that it churns.
fn breaker_billows(at: vec2f) -> vec3f {
  let p = coast_place(at);
  let along = p.x * vec4f(0.8, -0.6, 0.98, 0.2) + p.y * vec4f(0.6, 0.8, -0.2, 0.98);
  let bend = 2.0 * fract(along.yxwz / BREAKER_BENDS_M) - 1.0;
  let off = 2.0 * fract((along - 0.6 * bend * bend) / BREAKER_BILLOWS_M) - 1.0;
  let arcs = 1.0 - off * off;
  let fall = -4.0 * off / BREAKER_BILLOWS_M;
  let change = vec4f(0.6, 0.6, 0.4, 0.4) * arcs.yxwz * fall;
  return vec3f(
    0.6 * arcs.x * arcs.y + 0.4 * arcs.z * arcs.w,
    dot(change, vec4f(0.8, -0.6, 0.98, 0.2)), dot(change, vec4f(0.6, 0.8, -0.2, 0.98)));
}

// How breaking waves move the water.
struct BreakerMotion {
  // Displacement along x, y and z, m.
  moved: vec3f,
  // Derivatives of it, those along x and z divided by the choppiness as those of the waves are.
  derivatives: WaterDerivatives,
}

// A motion with `forward_m` metres more along the direction (x, z) `direction`, which change by `change` along x and z.
fn breaker_pushed(motion: BreakerMotion, direction: vec2f, forward_m: f32, change: vec2f) -> BreakerMotion {
  let along = direction / max(frame.choppiness, vec2f(0.05));
  var out = motion;
  out.moved += forward_m * vec3f(direction.x, 0.0, direction.y);
  out.derivatives.stretch += along * change;
  out.derivatives.shear += along * change.yx;
  return out;
}

// Motion of the water at a position relative to the point below the eye, m, where waves have the height `height_m` and
// the undisplaced slope `slope`. `surf` is surf_motion there: the height and the slope contain it, and the motion, too.
fn breaker_motion(at: vec2f, height_m: f32, slope: vec2f, surf: BreakerMotion) -> BreakerMotion {
  var out = surf;
  if height_m <= 0.0 {
    return out;
  }
  let foam = breaker_state(at);
  if foam.value.x + foam.value.y <= 0.0 {
    return out;
  }
  // Where only a sheet of water runs up the beach, short waves have ended, and nothing leans or rolls.
  var open_sea = 1.0;
  if WATER_COAST {
    open_sea = 1.0 - maths_smooth(BREAKER_SURF_RISE * coast_at(at).x);
  }
  let push = open_sea * BREAKER_PUSH_PER_HEIGHT;
  let excess_square = foam.value.x * foam.value.x;
  let over = 1.0 / (excess_square + BREAKER_HALF_EXCESS_SQUARE);
  let share = push * excess_square * over;
  let share_change = (2.0 * push * BREAKER_HALF_EXCESS_SQUARE) * foam.value.x * over * over;
  var forward_change = share * slope + (share_change * height_m) * vec2f(foam.along_x.x, foam.along_z.x);
  var forward_m = share * height_m;
  let direction = unpack2x16snorm(frame.breaker_direction);
  // The roller's thickness is proportional to the square of the front, so that its edge rises without a kink.
  let square = foam.value.y * foam.value.y;
  var roller = BREAKER_ROLLER_PER_HEIGHT;
  var roller_change = (2.0 * foam.value.y) * vec2f(foam.along_x.y, foam.along_z.y);
  if WATER_COAST {
    let share_of_surf = 1.0 - open_sea;
    var billows = BREAKER_MEAN_BILLOWS;
    if share_of_surf * foam.value.y > 0.0 {
      let shown = 1.0 - maths_rise(mesh_spacing(length(at)), BREAKER_BILLOW_SPACINGS_M);
      billows = mix(billows, breaker_billows(at), shown);
    }
    roller = mix(roller, BREAKER_SURF_ROLLER.x + BREAKER_SURF_ROLLER.y * billows.x, share_of_surf);
    roller_change = roller * roller_change + (square * share_of_surf * BREAKER_SURF_ROLLER.y) * billows.yz;
    let swells = BREAKER_SURF_FORWARD * share_of_surf;
    forward_m += swells * roller * square * height_m;
    forward_change += swells * (roller * square * slope + height_m * roller_change);
  } else {
    roller_change *= roller;
  }
  out = breaker_pushed(out, direction, forward_m, forward_change);
  out.moved.y += roller * square * height_m;
  out.derivatives.slope += roller * square * slope + height_m * roller_change;
  return out;
}
