// Where the water ends: sand under thin water, and the lace of foam at its edge.

// The albedo of the ground near the shore goes over into that of the land, which has neither seagrass nor reefs, where
// the water is this deep, m: all land (x), and all bed (y).
const BED_SHORE_M = vec2f(0.8, 3.5);
// Width, m, of the line of foam at the edge of the swash, and the least difference between the slopes of the water and
// of the ground from which the distance of that edge is computed.
const SHORE_LACE_M = 0.9;
const SHORE_LEAST_FALL = 0.03;
// Part of that line that foam covers.
const SHORE_LACE_COVER = 0.75;
// Part of the rim, the first third of the line, that foam covers, and how much of it is as thick as that of a breaker.
const SHORE_RIM_COVER = 0.93;
const SHORE_RIM_FRONT = 0.7;
// The sheet of water that runs up sand bears old foam behind that line: its part, and the depth up to which it does,
// relative to the height of the run-up.
const SHORE_SHEET_COVER = 0.30;
const SHORE_SHEET_DEPTH = 0.30;
// Height of the run-up, m, below which the edge of the water bears no foam (x), and from which it bears all (y).
const SHORE_LACE_RUN_UP_M = vec2f(0.1, 0.6);
// Height of the run-up, m, below which no collar of foam lies around rock and walls (x), and from which the collar is full
// (y): waves of some decimetres only splash there.
const SHORE_COLLAR_RUN_UP_M = vec2f(0.2, 0.9);
// Part of the collar that foam covers at the waterline. Depth of the still water in which the collar ends while the
// level is the mean one, relative to the height of the run-up. And the change of this depth, relative to itself, while
// a crest as high as the run-up passes.
const SHORE_COLLAR_COVER = 0.95;
const SHORE_COLLAR_DEPTH = 4.5;
const SHORE_COLLAR_SWING = 0.6;
// Part of the collar at the foot of the stone that is as thick as a breaker's front.
const SHORE_COLLAR_CHURNED = 0.9;
// Depth of the water, m, in which the foam of breakers goes over into that of the film on the sand, and the part of it
// that is left at the edge of the water.
const SHORE_THIN_FOAM_M = 0.8;
const SHORE_THIN_FOAM = 0.15;
// Behind the front of a bore, the surface of the water falls towards the sea relative to the ground. Slope of that fall
// from which the water counts as behind the front, depth of the water, m, from which on none of it does, and the part of
// the foam that is left there.
const SHORE_BACK_FALL = 0.06;
const SHORE_BACK_M = 1.2;
const SHORE_BACK_FOAM = 0.4;
// Slopes between which the front of a bore becomes all foam: how steeply the water falls towards the land, relative to
// the ground. And the part of such a front that foam covers.
const SHORE_FACE_FALLS = vec2f(0.1, 0.4);
const SHORE_FACE_COVER = 0.98;
// Jacobians of the displacement up to which (x) the surface counts as folded, and from which (y) it does not.
const SHORE_FOLDED_JACOBIANS = vec2f(0.1, 0.45);
// Part of a front that is a thick heap where the surface is not folded.
const SHORE_LOW_FRONT = 0.35;
// The slope of a folded surface has no meaning. Foam there is lit as if this part of the slope were missing.
const SHORE_FOLDED_SLOPE_LOSS = 0.7;
// Share of foam on a wall of concrete, which throws waves back without breaking them.
const SHORE_WALL_SHARE = 0.3;
// Depth of the water, m, up to which it is too thin for a cloud of bubbles: the sand shows through.
const SHORE_CLEAR_M = 0.35;
// Depth of the water, m, from which waves keep their slopes: thinner water lies on the sand like the film beside it.
const SHORE_THIN_M = 0.45;
// Light that comes from behind through the foam of a breaker's front, relative to that which falls on a plane towards the
// sun, and stops of it between the thickest and the thinnest foam.
const SHORE_FRONT_GLOW = 3.4;
const SHORE_FRONT_GLOW_STOPS = 3.4;
// Light of the sky that comes through with that of the sun, relative to the irradiance by the whole sky. It is bluer than
// a low sun, and makes the foam white.
const SHORE_FRONT_SKY = 3.0;
// Part of that light that comes out of foam that lies level.
const SHORE_FRONT_LEVEL = 0.4;
// Shares of fronts in the foam of a pixel between which its pattern goes over to that of a front.
const SHORE_FRONT_SHARES = vec2f(0.4, 0.6);
// Length of a pixel's footprint on a front, relative to its width: fronts face the eye or the sky.
const SHORE_FRONT_LENGTH = 2.0;
// How far the pattern of a front advances with the height of its surface, m a metre: otherwise a steep front would draw
// it out. A front that overhangs by just this much would, too, so this is more than fronts usually overhang.
const SHORE_FRONT_DROP = 3.0;
// Part of what shines through a front that its thickness hides.
const SHORE_FRONT_OPAQUE = 0.75;
// Share of a pixel that a front covers, from which the edges of its billows are smoothed.
const SHORE_EDGED_FRONT = 0.3;
// Part of the water below the foam of the shore that bubbles fill, relative to the foam's cover.
const SHORE_PLUME = 0.6;

// Share of the land's look in the bed under a column of water.
fn bed_shore_share(column: f32) -> f32 {
  return 1.0 - maths_rise(column, BED_SHORE_M);
}

// The ground of the bed near the shore, at `at` relative to the point below the eye: the sand of the beach, under water.
fn bed_shore_ground(ground: BedGround, at: vec2f, column: f32, size: f32) -> BedGround {
  let share = bed_shore_share(column);
  let place = land_place(at);
  let middle = land_noise(place.yx, LAND_MIDDLE_M, size);
  let sand = (1.0 / LAND_DRY) * land_sand_albedo(middle, land_noise(land_turned(place), LAND_FINE_M, size));
  return BedGround(mix(ground.albedo, sand, share), ground.slope * (1.0 - share * share));
}

// Slopes of the water at a place with the ground of land_at below it, where its surface has the height `height`, m. `size`
// is the width of the pixel's texels, m.
fn shore_thin_slope(slope: WaterSlope, ground: vec4f, place: vec2f, height: f32, size: f32) -> WaterSlope {
  // Water that washes rock is no film.
  let sand = land_film_share(length(ground.yz));
  let share = sand * (1.0 - maths_smooth((height - ground.x) / SHORE_THIN_M));
  if share <= 0.0 {
    return slope;
  }
  var out = slope;
  out.mean = mix(slope.mean, land_film_slope(place, land_to_world(ground.yz), size), share);
  out.variance = mix(slope.variance, vec3f(vec2f(LAND_FILM_ROUGHNESS * LAND_FILM_ROUGHNESS), 0.0), share);
  out.half_slope_difference *= 1.0 - share;
  return out;
}

// Height that the waves run up the land, m, at a point (x, z) relative to the one below the eye.
fn shore_run_up_m(at: vec2f) -> f32 {
  if WATER_COAST {
    return coast_at(at).w;
  }
  return land.run_up_m;
}

// How much of the ground breaks the waves at once, 0 to 1: rock and rubble do. `ground` is that of land_at.
fn shore_hardness(ground: vec4f, place: vec2f, size: f32) -> f32 {
  let built = land_built_share(ground);
  if built == 1.0 {
    return select(1.0, SHORE_WALL_SHARE, ground.w > 0.0);
  }
  // The foot of a cliff counts down to the depth of one run-up.
  let run_up = max(land.run_up_m, 0.1);
  if -ground.x > run_up {
    return built;
  }
  let shallow = 1.0 - maths_rise(-ground.x, vec2f(0.5, 1.0) * run_up);
  return max(built, shallow * land_cliff_share(place, ground.x, size));
}

// Foam of a pixel with `cover` more of it, whose youth is `young` and of which the part `fresh` is a front. It lies
// beside that of breakers as often as on it.
fn shore_more_foam(foam: FoamAmount, cover: f32, young: f32, fresh: f32) -> FoamAmount {
  let all = foam.cover + (1.0 - foam.cover) * cover;
  let old = foam.cover / max(all, 1e-4);
  let plume = max(foam.plume, SHORE_PLUME * cover);
  return FoamAmount(all, mix(fresh, foam.fresh, old), plume, mix(young, foam.young, old));
}

// How far the displacement has squeezed or folded the surface, 0 to 1, where it has the Jacobian `jacobian`.
fn shore_folded(jacobian: f32) -> f32 {
  return 1.0 - maths_rise(jacobian, SHORE_FOLDED_JACOBIANS);
}

// Part of a front that is a thick heap, where the displacement has the Jacobian `jacobian`: all of an upright front is,
// and a low bore is mostly lace.
fn shore_front_thickness(jacobian: f32) -> f32 {
  return mix(SHORE_LOW_FRONT, 1.0, shore_folded(jacobian));
}

// Footprint with which a pixel at `position` relative to the eye reads the pattern of foam: `foot`, which lies on the
// undisplaced surface, where `folded` is 0, the pixel's footprint on the displaced surface where it is 1, and a mean of
// both between.
fn shore_front_footprint(foot: WaterFootprint, position: vec3f, folded: f32) -> WaterFootprint {
  let away = (frame.footprint_scale * frame.pixel_angle * length(position)) * normalize(position.xz);
  let aside = vec2f(-away.y, away.x);
  // A side of a footprint may point either way. Both are turned towards each other, or their mean could be 0.
  let along = select(away, -away, dot(away, foot.axis) < 0.0);
  let across = select(aside, -aside, dot(aside, foot.across) < 0.0);
  return water_footprint(mix(foot.across, across, folded), mix(foot.axis, SHORE_FRONT_LENGTH * along, folded));
}

// Place from which a point of the water of the height `height`, m, takes the pattern of a front. Waves are taken to come
// ashore before the wind, as for the roller (breaker.wgsl).
fn shore_front_place(position: vec3f, height: f32) -> vec2f {
  return position.xz - (SHORE_FRONT_DROP * height) * unpack2x16snorm(frame.breaker_direction);
}

// Nearness for frame_hdr_output of a pixel whose share `front` a front covers. Billows hide each other without a large
// step in the distance, so the tone pass is told to look for their edges.
fn shore_edged_nearness(nearness: f32, front: f32, pixel: vec2u) -> f32 {
  return select(nearness, frame_edged_nearness(nearness, pixel), front > SHORE_EDGED_FRONT);
}

// Radiance of the sunlight that comes towards `v` through the front of a breaker with the slope `slope`: `fresh` is the
// part of the foam that belongs to fronts, and `grain` the height of its relief, around 0.5. Most comes through a front
// that stands between the eye and the sun.
fn shore_front_glow(v: vec3f, slope: vec2f, fresh: f32, grain: f32) -> vec3f {
  let l = frame.sun_direction;
  let behind = max(-dot(v, l), 0.0);
  let stands = mix(SHORE_FRONT_LEVEL, 1.0, maths_smooth(5.0 * dot(slope, l.xz)));
  let through = SHORE_FRONT_GLOW * stands * fresh * behind * behind * saturate(8.0 * l.y);
  let relief = exp2(SHORE_FRONT_GLOW_STOPS * (clamp(grain, -0.4, 1.4) - 0.5));
  // The bright sky around the sun shines through it, too, which makes it whiter.
  let light_behind = cloud_sun_irradiance() + SHORE_FRONT_SKY * light.sky_irradiance;
  return light_behind * material.foam_colour * (FOAM_ALBEDO / ATM_PI * through * relief);
}

// The foam of a pixel, with the collar around stone whose share is `hard`. `ground`, `at` and `height` have the meaning
// that they have in shore_add_lace.
fn shore_add_collar(foam: FoamAmount, ground: vec4f, hard: f32, at: vec2f, height: f32) -> FoamAmount {
  let down = ground.yz * inverseSqrt(max(dot(ground.yz, ground.yz), 1e-4));
  let run_up = max(shore_run_up_m(at - LAND_BEFORE_STONE_M * land_to_world(down)), 1e-3);
  // The collar grows with a crest that runs up the stone, and what it leaves is drawn out by the trough.
  let reach = SHORE_COLLAR_DEPTH * run_up * (1.0 + SHORE_COLLAR_SWING * clamp(height / run_up, -0.8, 1.0));
  let near = saturate(1.0 + ground.x / reach);
  let lively = min(frame.foam_amount, 1.0) * maths_rise(run_up, SHORE_COLLAR_RUN_UP_M);
  // A crest that meets the stone is thrown up as white water, nearest to the stone.
  let churned = SHORE_COLLAR_CHURNED * maths_smooth(2.4 * near - 0.9) * saturate(0.7 + height / run_up);
  return shore_more_foam(foam, SHORE_COLLAR_COVER * lively * hard * maths_smooth(1.5 * near), near, churned);
}

// The foam of a pixel, with that of the swash, which carries it at its edge, and with the collar of foam around rock and
// walls. `ground` is that of land_at, `at` the pixel's place relative to the point below the eye, `height` the height of
// the water there, m, `fall` its slope relative to that of the ground, along x and z, `jacobian` that of its displacement,
// and `size` the width of the pixel's texels, m.
fn shore_add_lace(
  foam: FoamAmount, ground: vec4f, at: vec2f, height: f32, fall: vec2f, jacobian: f32, size: f32,
) -> FoamAmount {
  // No collar reaches deeper than one of the highest waves.
  let deepest_m = (1.0 + SHORE_COLLAR_SWING) * SHORE_COLLAR_DEPTH * land.run_up_m;
  if -ground.x > max(deepest_m, 2.0 * SHORE_BACK_M) {
    return foam;
  }
  var out = foam;
  let column = max(height - ground.x, 0.0);
  let thick = mix(SHORE_THIN_FOAM, 1.0, maths_smooth(column / SHORE_THIN_FOAM_M));
  // A bore is white in front. Behind it, where the water falls towards the sea, foam is torn.
  let uphill = land_to_world(ground.yz);
  let seaward = dot(fall, uphill) * inverseSqrt(max(dot(uphill, uphill), 1e-8));
  let hard = shore_hardness(ground, land_place(at), size);
  let thin = (1.0 - hard) * land_film_share(length(ground.yz)) * (1.0 - maths_smooth(column / SHORE_BACK_M));
  let folded = shore_folded(jacobian);
  let back = thin * maths_smooth(seaward / SHORE_BACK_FALL) * (1.0 - folded);
  out.cover *= thick * mix(1.0, SHORE_BACK_FOAM, back);
  out.fresh *= thick * (1.0 - back);
  let face = thin * max(folded, maths_rise(-seaward, SHORE_FACE_FALLS));
  out = shore_more_foam(out, SHORE_FACE_COVER * min(frame.foam_amount, 1.0) * face, 1.0, face);
  if column < SHORE_SHEET_DEPTH * land.run_up_m {
    let run_up = max(shore_run_up_m(at), 1e-3);
    let lively = min(frame.foam_amount, 1.0) * maths_rise(run_up, SHORE_LACE_RUN_UP_M);
    // The foam at the edge is a thin line in places and a broad front in others.
    let fringe = land_noise(land_turned(land_place(at)), LAND_FINE_M, size);
    let lace_m = SHORE_LACE_M * exp2(0.9 * fringe.z + 0.5 * fringe.w);
    let edge_m = column / max(length(fall), SHORE_LEAST_FALL);
    let line = maths_smooth(2.0 - 2.0 * edge_m / lace_m);
    let rim = maths_smooth(1.5 - 4.0 * edge_m / lace_m) * maths_smooth(1.1 + 0.5 * fringe.w);
    let sheet = SHORE_SHEET_COVER * maths_smooth(1.0 - column / (SHORE_SHEET_DEPTH * run_up));
    let edge = max(SHORE_LACE_COVER * line, SHORE_RIM_COVER * rim);
    out = shore_more_foam(out, lively * max(edge, sheet), line, SHORE_RIM_FRONT * rim);
  }
  out.plume *= maths_smooth(column / SHORE_CLEAR_M);
  if hard > 0.0 {
    out = shore_add_collar(out, ground, hard, at, height);
  }
  return out;
}
