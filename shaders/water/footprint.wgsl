// The footprint of a pixel on the undisplaced sea, and how the maps are filtered over it.

// An anisotropic footprint, sampled several times along its longer side, so that it is not blurred across. Hardware
// anisotropy differs between GPUs and takes minutes on a software adapter.
struct WaterFootprint {
  // Longer side as a vector, m.
  axis: vec2f,
  // Width that one sample filters over, m.
  size: f32,
  taps: i32,
}

// Largest number of samples along a footprint.
const WATER_MAX_TAPS = 3;
// Texel size at which a sample is read, relative to the length it covers: 1 / sqrt(3), because interpolation between
// the texels of a mip level (a box and a tent) blurs as much as a box of sqrt(3) texels.
const WATER_TAP_TEXEL_RATIO = 0.58;

// Mean width, m, of a footprint of the length `length_m` with the sides `dx` and `dy`, m: area divided by length, which
// is right even where the two sides are nearly parallel.
fn water_footprint_width_m(dx: vec2f, dy: vec2f, length_m: f32) -> f32 {
  return max(abs(dx.x * dy.y - dx.y * dy.x) / max(length_m, 1e-9), 1e-6);
}

// Footprint of a pixel with the sides `dx` and `dy`, m.
fn water_footprint(dx: vec2f, dy: vec2f) -> WaterFootprint {
  let x = length(dx);
  let y = length(dy);
  let large = max(x, y);
  let small = water_footprint_width_m(dx, dy, large);
  let taps = clamp(i32(ceil(large / small - 0.3)), 1, WATER_MAX_TAPS);
  return WaterFootprint(select(dy, dx, x > y), WATER_TAP_TEXEL_RATIO * max(small, large / f32(taps)), taps);
}

// Footprint size, relative to the patch of a cascade, at which its slopes begin to fade into variance.
const WATER_FADE_START = 0.08;
// Relative footprint size at which no slopes are left: a mean over it would keep 2 % of those of the longest waves.
const WATER_FADE_END = 0.16;
// Maps whose shortest wave is longer than this number of texels are smooth enough without a spline.
const WATER_SMOOTH_WAVE_TEXELS = 6.0;
// A mip level no finer than the coarsest of any map.
const WATER_COARSEST_LOD = 16.0;

// How the maps of a cascade are sampled within a footprint.
struct WaterSampling {
  // Weight of the mean slope, 0 to 1; 0 for a cascade so distant that only its variance is left.
  slope_weight: f32,
  // Smoothness of the spline where the maps are magnified, 0 to 1; 0 elsewhere.
  spline_smoothness: f32,
  // Number of samples of the gradients map along the footprint.
  taps: i32,
  // Number of samples of the moments map along the footprint.
  moment_taps: i32,
  // Longer side of the footprint in texture coordinates.
  along: vec2f,
  // Mip levels of the gradients, of the displacement and of the moments map.
  slope_lod: f32,
  displacement_lod: f32,
  moment_lod: f32,
  // Fraction of the slope moments that counts as unresolved variance, 0 to 1.
  variance_weight: f32,
}

fn water_sampling(map: FrameCascade, foot: WaterFootprint) -> WaterSampling {
  let scale = map.inverse_patch * frame.n;
  let texels = foot.size * scale;
  let wide = texels / WATER_TAP_TEXEL_RATIO;
  let long = max(length(foot.axis) * scale, texels);
  let lod = log2(max(texels, 1e-6));
  var out: WaterSampling;
  out.slope_weight = 1.0 - smoothstep(WATER_FADE_START, WATER_FADE_END, sqrt(wide * long) / frame.n);
  out.along = foot.axis * map.inverse_patch;
  if out.slope_weight <= 0.0 {
    out.moment_taps = 1;
    out.moment_lod = WATER_COARSEST_LOD;
    out.variance_weight = 1.0;
    return out;
  }
  let needs_spline = map.shortest_wave_texels < WATER_SMOOTH_WAVE_TEXELS;
  out.spline_smoothness = select(0.0, 1.0 - smoothstep(0.8, 1.25, long), needs_spline);
  // No more samples than are useful: interpolation between texels blurs as much as a box of 1.4 texels. The smoother
  // moments take half as many, and the displacement takes one, as its effect on the slope is of second order.
  out.taps = clamp(i32(ceil(long / max(wide, 1.4) - 0.3)), 1, foot.taps);
  out.slope_lod = lod;
  out.displacement_lod = log2(max(WATER_TAP_TEXEL_RATIO * long, 1e-6));
  // The moments hold nothing finer than two texels; for smaller footprints they would count resolved waves twice. The
  // mip level from which they count is fitted to the sum of resolved and unresolved variance.
  out.variance_weight = (1.0 - out.spline_smoothness * out.spline_smoothness) * clamp(lod + 0.5, 0.0, 1.0);
  out.moment_taps = select((out.taps + 1) / 2, 0, out.variance_weight <= 0.0);
  let moment_tap = lod + log2(f32(out.taps) / f32(max(out.moment_taps, 1)));
  out.moment_lod = min(moment_tap, out.displacement_lod) - 1.0;
  return out;
}
