// Fills the repeating map of the clouds' height above their base, as a fraction of the layer's thickness: positive
// where there is cloud, and falling below 0 away from it (red); of the steepness of that height, 1/tile (green); and
// of shifts of the noise in two directions, in sides of the noise (blue and alpha).

@group(0) @binding(0) var<uniform> cloud_field: CloudField;
@group(0) @binding(1) var weather_out: texture_storage_2d<rgba16float, write>;

// Number of streets of heaps in a tile.
const WEATHER_STREETS = 9.0;

// Place of the field of heaps, tiles, over the sea's origin, where most views begin: the sun shines there between
// clouds of many sizes.
const WEATHER_HEAPS_START = vec2f(0.867, 0.055);

// Towering cumulus: factors on the heights of wide heaps (x) and of narrower ones (y), and factors by which the lower
// of two heaps that overlap stands on the higher one, for wide and middle heaps (z) and for narrow ones on both (w).
const WEATHER_TOWERS = vec4f(0.35, 0.45, 2.2, 0.9);
// Height, as a fraction of the layer, from which towers are held below the top of the layer.
const WEATHER_LID = 0.7;

// Broken deck: value of its pattern at which the height is half of the highest, and the step, tiles, for differences.
const WEATHER_DECK_EDGE = 0.35;
const WEATHER_DECK_STEP = 0.002;

fn weather_random(cell: vec2i, period: i32, key: u32) -> vec4f {
  let wrapped = ((cell % period) + period) % period;
  return noise_pcg4d_unit(vec4u(vec2u(wrapped), key, u32(period)));
}

// Gradient noise of mean 0 and standard deviation of about 0.25; `at` counts tiles.
fn weather_smooth(at: vec2f, period: i32, key: u32) -> f32 {
  let p = at * f32(period);
  let cell = vec2i(floor(p));
  let f = p - floor(p);
  let u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  var corner: array<f32, 4>;
  for (var i = 0; i < 4; i++) {
    let off = vec2i(i & 1, i >> 1);
    let turn = 2.0 * ATM_PI * weather_random(cell + off, period, key).x;
    corner[i] = dot(vec2f(cos(turn), sin(turn)), f - vec2f(off));
  }
  return mix(mix(corner[0], corner[1], u.x), mix(corner[2], corner[3], u.x), u.y);
}

fn weather_fractal(at: vec2f, period: i32, key: u32) -> f32 {
  return weather_smooth(at, period, key) + 0.5 * weather_smooth(at, 2 * period, key + 1u)
    + 0.25 * weather_smooth(at, 4 * period, key + 2u);
}

// Factor on the area of the heaps of cloud around a place, of mean 1: they gather in groups of 8 and of 3 km, and in
// streets along the wind, which rise where rolls of air meet, 3.5 km apart in a field of cumulus; between lie lanes
// of clear sky. `gather` is the strength of that, 0 to 1.
fn weather_group(at: vec2f, gather: f32) -> f32 {
  let street = cos(2.0 * ATM_PI * (WEATHER_STREETS * at.y + 0.9 * weather_smooth(at, 3, 71u)));
  let crowd = 4.0 * (weather_smooth(at, 4, 75u) + weather_smooth(at, 11, 79u)) + street;
  return exp(gather * crowd - 0.92 * gather * gather);
}

// Heaps of cloud: the highest of round ones at random points, one in each of `cells` x `cells` cells of the tile.
// `area` is the sum of their areas divided by that of the tile, `steepness` the height of a heap divided by its radius,
// both as fractions of tile and layer.
fn weather_heaps(at: vec2f, cells: i32, area: f32, steepness: f32, gather: f32, key: u32) -> vec2f {
  let p = at * f32(cells);
  let cell = vec2i(floor(p));
  var high = vec2f(-1.0, 0.0);
  for (var i = 0; i < 25; i++) {
    let off = vec2i(i % 5, i / 5) - 2;
    let random = weather_random(cell + off, cells, key);
    let middle = vec2f(cell + off) + random.xy;
    let d = middle - p;
    // Heaps whose edge is more than a cell away do not matter here.
    if dot(d, d) > 4.0 {
      continue;
    }
    // Areas follow a power law of mean 1: many small heaps, few large ones.
    let share = inverseSqrt(max(random.z, 0.03)) / 1.83;
    let radius = min(sqrt(area * weather_group(middle / f32(cells), gather) * share / ATM_PI), 0.95);
    let size = min(steepness * radius * (0.6 + 0.8 * random.w * random.w), 1.0);
    let square = radius * radius + 1e-4;
    // The smallest heaps have dissolved.
    let x = dot(d, d) / square;
    // Steep sides down to the base, and a round top.
    let here = size * (1.0 - x * min(x, 1.0)) - 0.09;
    if here > high.x {
      let steep = select(2.0, 4.0 * x, x < 1.0) * size * min(length(d), radius) / square;
      high = vec2f(here, steep * f32(cells));
    }
  }
  return high;
}

// Two layers of heaps as one: where both have cloud, the lower one, times `turret`, is a turret on the higher one.
fn weather_piled(a: vec2f, b: vec2f, turret: f32) -> vec2f {
  let high = select(b, a, a.x > b.x);
  let low = select(a, b, a.x > b.x);
  return high + select(vec2f(0.0), turret * low, low.x > 0.0);
}

// Square of the distance to the nearest of random points, one in each cell, in cells. Points differ by `spread` in this
// square, so that the areas that lie nearest to them have many sizes.
fn weather_cells(at: vec2f, cells: i32, spread: f32, key: u32) -> f32 {
  let p = at * f32(cells);
  let cell = vec2i(floor(p));
  var nearest = 4.0;
  for (var i = 0; i < 9; i++) {
    let off = vec2i(i % 3, i / 3) - 1;
    let random = weather_random(cell + off, cells, key);
    let d = vec2f(cell + off) + random.xy - p;
    nearest = min(nearest, dot(d, d) + spread * (random.z - 0.5));
  }
  return nearest;
}

// Height of a broken deck, as a fraction of the layer: pancakes in patches, parted by cracks. They have steep sides and
// nearly level tops.
fn weather_deck(at: vec2f, cover: f32) -> f32 {
  let pancakes = 0.4 - weather_cells(at, 19, 0.5, 5u) + 0.75 * (0.33 - weather_cells(at, 47, 0.6, 6u));
  let patches = weather_fractal(at, 5, 17u);
  let n = 1.4 * pancakes + 1.0 * patches - 0.45 - 0.41 * weather_normal_quantile(cover);
  return n * (1.0 + WEATHER_DECK_EDGE) / (abs(n) + WEATHER_DECK_EDGE);
}

// The value that a normal variable exceeds with the probability `share`, to 1 % of its deviation.
fn weather_normal_quantile(share: f32) -> f32 {
  let x = clamp(share, 0.002, 0.998);
  return 4.91 * (pow(1.0 - x, 0.14) - pow(x, 0.14));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let is_heaps = cloud_field.kind == CLOUD_CUMULUS || cloud_field.kind == CLOUD_TOWERING;
  let size = vec2f(textureDimensions(weather_out));
  let bare = (vec2f(id.xy) + 0.5) / size + select(vec2f(0.0), WEATHER_HEAPS_START, is_heaps);
  // Bent coordinates leave no round outlines.
  let bend = vec2f(weather_fractal(bare, 14, 31u), weather_fractal(bare, 14, 47u));
  let at = bare + select(0.012, 0.02, is_heaps) * bend;
  let cover = cloud_field.cover;
  // Heaps that gather overlap more than those at random, which would cover the share 1 - exp(-area).
  let area = 1.2 * (pow(max(1.0 - cover, 0.02), -0.72) - 1.0);
  var high = vec2f(-1.0, 0.0);
  if is_heaps {
    let steep = cloud_field.steepness;
    // Towers stand on low wide heaps. Narrower heaps that stand alone stay low: tall ones would be needles.
    let is_towering = cloud_field.kind == CLOUD_TOWERING;
    let broad = select(0.85, WEATHER_TOWERS.x, is_towering);
    let slim = select(1.0, WEATHER_TOWERS.y, is_towering);
    let turrets = select(vec2f(0.5), WEATHER_TOWERS.zw, is_towering);
    let wide = weather_heaps(at, 17, 0.35 * area, broad * steep / 17.0, 1.0, 1u);
    let middle = weather_heaps(at, 31, 0.3 * area, 1.1 * slim * steep / 31.0, 1.0, 11u);
    let narrow = weather_heaps(at, 61, 0.35 * area, 1.4 * slim * steep / 61.0, 0.5, 21u);
    high = weather_piled(weather_piled(wide, middle, turrets.x), narrow, turrets.y);
    if is_towering && high.x > WEATHER_LID {
      let room = 1.0 - WEATHER_LID;
      let held = exp((WEATHER_LID - high.x) / room);
      high = vec2f(1.0 - room * held, high.y * held);
    }
  } else if cloud_field.kind == CLOUD_STRATOCUMULUS {
    // Differences between neighbours give the steepness.
    let next = vec2f(WEATHER_DECK_STEP, 0.0);
    let here = weather_deck(at, cover);
    let slope = vec2f(weather_deck(at + next.xy, cover), weather_deck(at + next.yx, cover)) - here;
    high = vec2f(0.85 * here, 0.85 * length(slope) / WEATHER_DECK_STEP);
  } else if cloud_field.kind == CLOUD_CIRRUS {
    // Bands that are longer along the wind. The whole numbers keep the tile without a seam.
    let n = weather_fractal(vec2f(at.x + at.y, 2.0 * at.y), 3, 23u) + 0.35 * weather_fractal(at, 11, 29u);
    high.x = 1.6 * (n - 0.31 * weather_normal_quantile(cover));
  } else {
    // A storm deck has few gaps at any cover.
    let n = weather_fractal(at, 4, 41u) + 0.35 * weather_fractal(at, 19, 45u);
    let open = (1.0 - cover) * (1.0 - cover);
    high.x = 0.6 + 1.3 * (n - 0.29 * weather_normal_quantile(1.0 - open * (1.0 - cover)));
  }
  let shift = 1.3 * vec2f(weather_smooth(bare, 7, 61u), weather_smooth(bare, 7, 67u));
  textureStore(weather_out, id.xy, vec4f(clamp(high.x, -1.0, 1.0), high.y, shift));
}
