// Breaking crests. The top of a crest that breaks is pushed along the wind, with which it travels, so that its lee face
// is steeper than its weather face, and the roller of foam on its front lies on the water as a layer.

// Number of foam levels that move the water; on coarser ones, what they move is smaller than a pixel.
const BREAKER_LEVELS = 2u;
// Largest push, relative to the height of the crest above the mean. Lee faces become 1.2 to 1.4 times as steep as
// weather faces, as those of measured spilling breakers (tests/breaking.rs).
const BREAKER_PUSH_PER_HEIGHT = 0.22;
const BREAKER_SURF_PUSH = 6.0;
const BREAKER_SURF_ROLLER = 0.35;
// Excess at which the push is half of the largest, squared.
const BREAKER_HALF_EXCESS_SQUARE = 2.0;
// Thickness of a roller, relative to the height of its crest above the mean.
const BREAKER_ROLLER_PER_HEIGHT = 0.1;

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

// How a breaking crest moves the water.
struct BreakerMotion {
  // Displacement along x, y and z, m.
  moved: vec3f,
  // Derivatives of it, those along x and z divided by the choppiness as those of the waves are.
  derivatives: WaterDerivatives,
}

// Motion of the water at a position relative to the point below the eye, m, where waves have the height `height_m` and
// the undisplaced slope `slope`.
fn breaker_motion(at: vec2f, height_m: f32, slope: vec2f) -> BreakerMotion {
  var out: BreakerMotion;
  if height_m <= 0.0 {
    return out;
  }
  let foam = breaker_state(at);
  if foam.value.x + foam.value.y <= 0.0 {
    return out;
  }
  let square = foam.value.x * foam.value.x;
  let over = 1.0 / (square + BREAKER_HALF_EXCESS_SQUARE);
  let push = select(BREAKER_PUSH_PER_HEIGHT, BREAKER_SURF_PUSH, WATER_COAST);
  let share = push * square * over;
  let share_change = (2.0 * push * BREAKER_HALF_EXCESS_SQUARE) * foam.value.x * over * over;
  let change = share * slope + (share_change * height_m) * vec2f(foam.along_x.x, foam.along_z.x);
  let direction = unpack2x16snorm(frame.breaker_direction);
  let along = direction / max(frame.choppiness, vec2f(0.05));
  out.derivatives.stretch = along * change;
  out.derivatives.shear = along * change.yx;
  // The roller's thickness is proportional to the square of the front, so that its edge rises without a kink.
  let roller = select(BREAKER_ROLLER_PER_HEIGHT, BREAKER_SURF_ROLLER, WATER_COAST) * foam.value.y;
  out.derivatives.slope =
    (roller * foam.value.y) * slope + (2.0 * roller * height_m) * vec2f(foam.along_x.y, foam.along_z.y);
  out.moved = vec3f(share * height_m * direction.x, roller * foam.value.y * height_m, share * height_m * direction.y);
  return out;
}
