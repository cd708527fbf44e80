// Breaking crests. The top of a crest that breaks is pushed along the wind, with which it travels, so that its lee face
// is steeper than its weather face, and the roller of foam on its front lies on the water as a layer of billows. At a
// coast the wave has its shape from surf.wgsl, and bears a thicker roller.

// Largest push, relative to the height of the crest above the mean. Lee faces become 1.2 to 1.4 times as steep as
// weather faces, as those of measured spilling breakers (tests/breaking.rs).
const BREAKER_PUSH_PER_HEIGHT = 0.22;
// Excess at which the push is half of the largest, squared.
const BREAKER_HALF_EXCESS_SQUARE = 2.0;
// Thickness of a roller in the open sea and at a coast, relative to the height of its crest above the mean: the first
// number between billows, and both together on their tops.
const BREAKER_ROLLER = vec2f(0.035, 0.15);
const BREAKER_SURF_ROLLER = vec2f(0.17, 0.14);
// How far a roller at a coast also swells forward, relative to its thickness, because it lies on a steep front.
const BREAKER_SURF_FORWARD = 0.75;
// Reciprocal of the coast's factor on short waves from which waves are surf. On the beach, where only a sheet of water
// runs up, the factor is 0.
const BREAKER_SURF_RISE = 2.5;

// How far waves at a position near a coast are surf: 1 at sea, 0 where only a sheet of water runs up the beach.
fn breaker_surf_share(at: vec2f) -> f32 {
  return maths_smooth(BREAKER_SURF_RISE * coast_at(at).x);
}

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
  for (var level = 0u; level < frame.breaker_level_count && left > 0.0; level++) {
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

// Shape of the billows of a roller, in lengths of the longest: reciprocals of the lengths of two pairs of rows, along x
// and along z, and of the lengths over which they bend.
const BREAKER_ROWS_X = vec4f(0.8, -0.78, 2.55, 0.63);
const BREAKER_ROWS_Z = vec4f(0.6, 1.04, -0.52, 3.1);
const BREAKER_BENDS_X = vec4f(-0.21, 0.24, 0.14, 0.55);
const BREAKER_BENDS_Z = vec4f(0.28, 0.18, 0.67, -0.11);
// How far rows bend, relative to their length.
const BREAKER_BEND = 0.55;
// Length of the longest billows: near a coast, m, and elsewhere relative to the significant wave height.
const BREAKER_SURF_BILLOW_M = 0.9;
const BREAKER_BILLOW_PER_HS = 0.22;
// Spacings of the mesh, in lengths of billows, between which these fade, because coarser meshes cannot show them.
const BREAKER_BILLOW_SPACINGS = vec2f(0.2, 0.54);
// Distance from the eye, in lengths of the longest billows, nearer than which billows of the open sea are shorter: half
// as long at half of it, and so on. Otherwise those of a storm would stand before the eye as smooth hills.
const BREAKER_BILLOW_DISTANCE = 16.0;
// Largest height of shortened billows, relative to their length.
const BREAKER_SHORT_BILLOW_STEEPNESS = 0.33;
// Mean height of billows, relative to the highest one: coarse meshes have it in their place.
const BREAKER_MEAN_BILLOWS = 0.44;

// Height of the billows of a roller, 0 to 1 (x), and its derivatives along x and z, 1/m (yz): round heaps with creases
// between. They stay where they are while the front runs over them, so that it churns.
fn breaker_billows(at: vec2f, length_m: f32) -> vec3f {
  let map = frame.foam_levels[0];
  let place = map.uv_below_eye + at * map.inverse_side;
  // Whole numbers of rows lie in the side of the foam's map, whose coordinates begin anew there.
  let count = 1.0 / (length_m * map.inverse_side);
  let rows_x = round(count * BREAKER_ROWS_X);
  let rows_z = round(count * BREAKER_ROWS_Z);
  let bends_x = round(count * BREAKER_BENDS_X);
  let bends_z = round(count * BREAKER_BENDS_Z);
  let bend = 2.0 * fract(place.x * bends_x + place.y * bends_z) - 1.0;
  let off = 2.0 * fract(place.x * rows_x + place.y * rows_z - BREAKER_BEND * bend * bend) - 1.0;
  let arcs = 1.0 - off * off;
  let change = (-4.0 * map.inverse_side) * vec4f(0.6, 0.6, 0.4, 0.4) * arcs.yxwz * off;
  let bent = 4.0 * BREAKER_BEND * bend;
  return vec3f(
    0.6 * arcs.x * arcs.y + 0.4 * arcs.z * arcs.w,
    dot(change, rows_x - bent * bends_x), dot(change, rows_z - bent * bends_z));
}

// Height of billows of a length, m, above their mean, m (x), and its derivatives along x and z (yz), where vertices of
// the mesh are `spacing` metres apart. From the creases to the highest tops they are `rise.x` metres high, which has the
// derivatives `rise.yz`. How billows change with the distance from the eye is left out of the derivatives: it is small.
fn breaker_shown_billows(at: vec2f, length_m: f32, spacing: f32, rise: vec3f) -> vec3f {
  let shown = 1.0 - maths_rise(spacing / length_m, BREAKER_BILLOW_SPACINGS);
  if shown <= 0.0 {
    return vec3f(0.0);
  }
  let billows = breaker_billows(at, length_m);
  let over = billows.x - BREAKER_MEAN_BILLOWS;
  return shown * vec3f(rise.x * over, rise.x * billows.yz + rise.yz * over);
}

// `rise` of shortened billows of a length, m, limited so that they are not too steep.
fn breaker_limited_rise(rise: vec3f, length_m: f32) -> vec3f {
  let most_m = BREAKER_SHORT_BILLOW_STEEPNESS * length_m;
  return select(rise, vec3f(most_m, 0.0, 0.0), rise.x > most_m);
}

// Height of the billows at a place above their mean, and its derivatives, in the form of breaker_shown_billows.
fn breaker_relief(at: vec2f, rise: vec3f) -> vec3f {
  let spacing = mesh_spacing(length(at));
  if WATER_COAST {
    return breaker_shown_billows(at, BREAKER_SURF_BILLOW_M, spacing, rise);
  }
  // The length has steps of half an octave, so that billows do not move while the sea glides to another one.
  let longest_m = exp2(0.5 * round(2.0 * log2(max(BREAKER_BILLOW_PER_HS * frame.hs_m, 1e-3))));
  let distance_m = length(vec3f(at.x, frame.eye_height_m, at.y));
  let octave = max(log2(BREAKER_BILLOW_DISTANCE * longest_m / max(distance_m, 1e-3)), 0.0);
  let length_m = longest_m * exp2(-floor(octave));
  let longer = select(rise, breaker_limited_rise(rise, length_m), octave >= 1.0);
  let shorter_share = maths_smooth(fract(octave));
  var out = (1.0 - shorter_share) * breaker_shown_billows(at, length_m, spacing, longer);
  if shorter_share > 0.0 {
    let shorter = breaker_limited_rise(rise, 0.5 * length_m);
    out += shorter_share * breaker_shown_billows(at, 0.5 * length_m, spacing, shorter);
  }
  return out;
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
  let direction = unpack2x16snorm(frame.breaker_direction);
  // The roller's thickness is proportional to the square of the front, so that its edge rises without a kink.
  let square = foam.value.y * foam.value.y;
  let square_change = (2.0 * foam.value.y) * vec2f(foam.along_x.y, foam.along_z.y);
  var thickness = BREAKER_ROLLER;
  var forward_m = 0.0;
  var forward_change = vec2f(0.0);
  if WATER_COAST {
    // surf_motion makes waves lean that come ashore, and no others do. Where only a sheet of water runs up the beach,
    // nothing rolls. All of a roller swells forward alike: billows that did so one by one would fold the surface.
    thickness = BREAKER_SURF_ROLLER * breaker_surf_share(at);
    let swell = BREAKER_SURF_FORWARD * (thickness.x + thickness.y * BREAKER_MEAN_BILLOWS);
    forward_m = swell * square * height_m;
    forward_change = swell * (square * slope + height_m * square_change);
  } else {
    let excess_square = foam.value.x * foam.value.x;
    let over = 1.0 / (excess_square + BREAKER_HALF_EXCESS_SQUARE);
    let share = BREAKER_PUSH_PER_HEIGHT * excess_square * over;
    let share_change = (2.0 * BREAKER_PUSH_PER_HEIGHT * BREAKER_HALF_EXCESS_SQUARE) * foam.value.x * over * over;
    forward_m = share * height_m;
    forward_change = share * slope + (share_change * height_m) * vec2f(foam.along_x.x, foam.along_z.x);
  }
  out = breaker_pushed(out, direction, forward_m, forward_change);
  if square > 0.0 {
    let crest = vec3f(height_m, slope);
    let roller = (thickness.x + thickness.y * BREAKER_MEAN_BILLOWS) * crest + breaker_relief(at, thickness.y * crest);
    out.moved.y += roller.x * square;
    out.derivatives.slope += roller.yz * square + roller.x * square_change;
  }
  return out;
}
