// Where the water ends: sand under thin water, and the lace of foam at its edge.

// The albedo of the ground near the shore goes over into that of the land, which has neither seagrass nor reefs, where
// the water is this deep, m: all land (x), and all bed (y).
const BED_SHORE_M = vec2f(0.8, 3.5);
// Depth of the water, m, below which the edge of the swash is a line of foam, and the part of it that foam covers.
const SHORE_LACE_M = 0.045;
const SHORE_LACE_COVER = 0.62;
// Height of the run-up of the sea, m, below which its edge bears no foam (x), and from which it bears all (y).
const SHORE_LACE_RUN_UP_M = vec2f(0.1, 0.6);

// Share of the land's look in the bed under a column of water.
fn bed_shore_share(column: f32) -> f32 {
  return 1.0 - maths_smooth((column - BED_SHORE_M.x) / (BED_SHORE_M.y - BED_SHORE_M.x));
}

// The ground of the bed near the shore, at `at` relative to the point below the eye: the sand of the beach, under water.
fn bed_shore_ground(ground: BedGround, at: vec2f, column: f32, size: f32) -> BedGround {
  let share = bed_shore_share(column);
  let place = land_place(at);
  let middle = land_noise(place.yx, LAND_MIDDLE_M, size);
  let sand = (1.0 / LAND_DRY) * land_sand_albedo(middle, land_noise(land_turned(place), LAND_FINE_M, size));
  return BedGround(mix(ground.albedo, sand, share), ground.slope * (1.0 - share * share));
}

// The foam of a pixel, with that of the swash, which carries it at its edge. `at` is the pixel's place relative to the
// point below the eye, `height` the height of the water there, m, and `size` the width of the pixel's texels, m.
fn shore_add_lace(foam: FoamAmount, at: vec2f, height: f32, size: f32) -> FoamAmount {
  let column = land_depth_m(at, size) + height;
  if column >= SHORE_LACE_M {
    return foam;
  }
  let range = SHORE_LACE_RUN_UP_M;
  let lively = saturate((land.run_up_m - range.x) / (range.y - range.x));
  let line = maths_smooth(2.0 - 2.0 * max(column, 0.0) / SHORE_LACE_M);
  let cover = SHORE_LACE_COVER * min(frame.foam_amount, 1.0) * lively * line;
  var out = foam;
  out.young = mix(foam.young, 1.0, cover / max(cover + foam.cover, 1e-4));
  out.cover = max(foam.cover, cover);
  return out;
}
