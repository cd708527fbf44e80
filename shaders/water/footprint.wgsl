// The footprint of a pixel on the undisplaced sea, and how the maps are filtered over it.

// An anisotropic footprint, sampled once in each half of its longer side. Where it is very long, the samples cover only
// parts of their halves. The waves of such a pixel hide each other, so that it shows the few facets that face the eye:
// two samples have the contrast of these, and the mean of all waves would make the distant sea smooth.
struct WaterFootprint {
  // Longer and shorter side of the pixel as vectors, m.
  axis: vec2f,
  across: vec2f,
  // Width of the pixel, m: its area divided by the length of its longer side.
  width_m: f32,
  // Whether the pixel is so much longer than wide that it is sampled twice, once in each half.
  has_halves: bool,
  // Length of the longer side, m, at least the width that one sample filters over.
  length_m: f32,
  // Geometric mean of the length and of the width of one sample, m. Where samples do not touch, half of the length takes
  // the place of the width, or twice the width if that is less.
  mean_m: f32,
  // Binary logarithms of the texel sizes, m, at which one sample, and a single sample of the whole footprint, are read.
  log_texel_m: f32,
  log_whole_texel_m: f32,
}

// Length of a footprint from which it is sampled twice, relative to what one sample covers.
const WATER_HALVES_FROM = 1.3;
// Longest part of a footprint that one sample covers, relative to the footprint's width. With it, neighbouring
// pixels differ about as much as those of a reference of many samples, or less. With shorter samples, the picture would
// change too fast while one sea turns into another.
const WATER_LONGEST_SAMPLE = 5.0;

// Footprint with the longer side `axis`, m, and the shorter one `across`, m, of which each sample covers `sample_m`
// metres.
fn water_footprint_of_samples(
  axis: vec2f, across: vec2f, length_m: f32, width_m: f32, sample_m: f32, has_halves: bool,
) -> WaterFootprint {
  let texel_m = WATER_TAP_TEXEL_RATIO * sample_m;
  let long_m = max(length_m, texel_m);
  let mean_m = sqrt(long_m * clamp(0.5 * long_m, sample_m, 2.0 * sample_m));
  return WaterFootprint(
    axis, across, width_m, has_halves, long_m, mean_m, log2(max(texel_m, 1e-6)),
    log2(max(WATER_TAP_TEXEL_RATIO * long_m, 1e-6)));
}

// Footprint of a pixel with the sides `dx` and `dy`, m.
fn water_footprint(dx: vec2f, dy: vec2f) -> WaterFootprint {
  let x = length(dx);
  let y = length(dy);
  let large = max(x, y);
  // The area divided by the length is right even where the two sides are nearly parallel.
  let small = max(abs(dx.x * dy.y - dx.y * dy.x) / max(large, 1e-9), 1e-6);
  let has_halves = large > WATER_HALVES_FROM * small;
  let is_x = x > y;
  let sample_m = clamp(0.5 * large, small, WATER_LONGEST_SAMPLE * small);
  return water_footprint_of_samples(
    select(dy, dx, is_x), select(dx, dy, is_x), large, small, sample_m, has_halves);
}

// Footprint of one sample whose texels are `texel_m` metres wide.
fn water_round_footprint(texel_m: f32) -> WaterFootprint {
  let width_m = texel_m / WATER_TAP_TEXEL_RATIO;
  return water_footprint_of_samples(vec2f(0.0), vec2f(0.0), 0.0, width_m, width_m, false);
}

// Footprint size, relative to the patch of a cascade, at which its slopes begin to fade into variance.
const WATER_FADE_START = 0.08;
// Relative footprint size at which no slopes are left: a mean over it would keep 2 % of those of the longest waves.
const WATER_FADE_END = 0.16;
const WATER_INVERSE_FADE = 1.0 / (WATER_FADE_END - WATER_FADE_START);
// A mip level no finer than the coarsest of any map.
const WATER_COARSEST_LOD = 16.0;

// Whether a footprint is so large, compared with the patch of a cascade, that only the variance of its slopes is left.
fn water_is_distant(map: FrameCascade, foot: WaterFootprint) -> bool {
  return foot.mean_m * map.inverse_patch >= WATER_FADE_END;
}

// How the maps of a cascade are sampled within a footprint.
struct WaterSampling {
  // Weight of the mean slope, 0 to 1.
  slope_weight: f32,
  // Smoothness of the spline where the maps are magnified, 0 to 1; 0 elsewhere.
  spline_smoothness: f32,
  // Whether the gradients map is sampled twice along the footprint.
  has_halves: bool,
  // Mip levels of the gradients and of the displacement map. That of the moments map is one less than the latter.
  slope_lod: f32,
  displacement_lod: f32,
  // Fraction of the slope moments that counts as unresolved variance, 0 to 1.
  variance_weight: f32,
}

fn water_sampling(map: FrameCascade, foot: WaterFootprint) -> WaterSampling {
  let long = foot.length_m * map.texels_per_m;
  var out: WaterSampling;
  out.slope_weight = maths_smooth((WATER_FADE_END - foot.mean_m * map.inverse_patch) * WATER_INVERSE_FADE);
  out.spline_smoothness = map.spline_smoothness * maths_smooth((1.0 - long) * (1.0 / 0.45));
  // A second sample is of use only if the footprint is longer than one sample, which blurs as much as a box of 1.4
  // texels. The smoother moments take one, and so does the displacement, as its effect on the slope is of second order.
  out.has_halves = foot.has_halves && long > 1.4 * WATER_HALVES_FROM;
  out.slope_lod = foot.log_texel_m + map.log_texels_per_m;
  out.displacement_lod = foot.log_whole_texel_m + map.log_texels_per_m;
  // The moments hold nothing finer than two texels; for smaller footprints they would count resolved waves twice. The
  // mip level from which they count is fitted to the sum of resolved and unresolved variance.
  let from_lod = saturate(max(out.slope_lod + 0.5, out.displacement_lod));
  out.variance_weight = (1.0 - out.spline_smoothness * out.spline_smoothness) * from_lod;
  return out;
}
