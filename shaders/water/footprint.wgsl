// The part of the undisplaced sea that a pixel shows, and how it is filtered.

// A footprint is read by several taps along its longer side, so that it is not blurred across. Hardware anisotropy would
// differ between GPUs, and takes minutes on a software adapter.
struct WaterFootprint {
  // The longer side, m.
  axis: vec2f,
  // Size of a tap, m.
  size: f32,
  taps: i32,
}

const WATER_TAPS = 3;
// Size of a tap over the length that it stands for: 1 / sqrt(3), because a mip level that is read with interpolation between
// its texels (a box and a tent) blurs as much as a box of sqrt(3) times the texel.
const WATER_TAP = 0.58;

// The footprint of a pixel with these sides, m.
fn water_footprint(dx: vec2f, dy: vec2f) -> WaterFootprint {
  let x = length(dx);
  let y = length(dy);
  let large = max(x, y);
  // Area over length is right even where the two sides are nearly parallel.
  let small = max(abs(dx.x * dy.y - dx.y * dy.x) / max(large, 1e-9), 1e-6);
  let taps = clamp(i32(ceil(large / small - 0.3)), 1, WATER_TAPS);
  return WaterFootprint(select(dy, dx, x > y), WATER_TAP * max(small, large / f32(taps)), taps);
}

// Mean side of a footprint over the patch at which the slopes of a cascade begin to fade into variance, and at which all of
// them have: its longest waves are as short as the footprint, whose mean would keep 2 % of their slopes.
const WATER_FADE = 0.08;
const WATER_FAR = 0.16;
// Slopes of waves of more texels than this are smooth enough between texels without a spline.
const WATER_SMOOTH = 6.0;
// The coarsest mip level.
const WATER_COARSEST = 16.0;

// How the maps of a cascade are read within a footprint.
struct WaterReading {
  // Share of the slopes that stays in their mean; 0 for a map so distant that only its variance is left.
  share: f32,
  // Smoothness of the spline where the maps are magnified, else 0.
  near: f32,
  // Taps of the slopes and of their moments.
  taps: i32,
  moment_taps: i32,
  // The longer side of the footprint in texture coordinates.
  along: vec2f,
  // Mip levels of the slopes, of the displacement and of the moments.
  slope_lod: f32,
  displacement_lod: f32,
  moment_lod: f32,
  // Share of the moments that counts as variance.
  unresolved: f32,
}

fn water_reading(map: FrameCascade, foot: WaterFootprint) -> WaterReading {
  let scale = map.inverse_patch * frame.n;
  let texels = foot.size * scale;
  let wide = texels / WATER_TAP;
  let long = max(length(foot.axis) * scale, texels);
  let lod = log2(max(texels, 1e-6));
  var out: WaterReading;
  out.share = 1.0 - smoothstep(WATER_FADE, WATER_FAR, sqrt(wide * long) / frame.n);
  out.along = foot.axis * map.inverse_patch;
  if out.share <= 0.0 {
    out.moment_taps = 1;
    out.moment_lod = WATER_COARSEST;
    out.unresolved = 1.0;
    return out;
  }
  out.near = select(0.0, 1.0 - smoothstep(0.8, 1.25, long), map.wave_texels < WATER_SMOOTH);
  // As many taps as are worth it: interpolation between texels blurs as much as a box of 1.4 texels. Half as many for the
  // smoother moments, and one for the displacement, whose part in the slope is of second order.
  out.taps = clamp(i32(ceil(long / max(wide, 1.4) - 0.3)), 1, foot.taps);
  out.slope_lod = lod;
  out.displacement_lod = log2(max(WATER_TAP * long, 1e-6));
  // The moments hold nothing finer than two texels; closer up they would count resolved waves twice. The level from which
  // they count is fitted to the sum of resolved and unresolved variance.
  out.unresolved = (1.0 - out.near * out.near) * clamp(lod + 0.5, 0.0, 1.0);
  out.moment_taps = select((out.taps + 1) / 2, 0, out.unresolved <= 0.0);
  let moment_tap = lod + log2(f32(out.taps) / f32(max(out.moment_taps, 1)));
  out.moment_lod = min(moment_tap, out.displacement_lod) - 1.0;
  return out;
}
