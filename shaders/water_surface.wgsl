// The surface from the maps of the simulation.

// Displacement of all cascades at a point beside the eye, filtered to `spacing` metres, chop applied.
fn water_displacement(at: vec2f, spacing: f32) -> vec3f {
  var sum = vec3f(0.0);
  for (var c = 0u; c < frame.count; c++) {
    let place = frame.cascades[c];
    let lod = log2(max(spacing * place.z * frame.n, 1e-3));
    // Waves shorter than two vertices are left to the normals.
    let share = clamp(log2(frame.n) - 1.0 - lod, 0.0, 1.0);
    if share > 0.0 {
      sum += share * textureSampleLevel(displacement_map, wave_sampler, place.xy + at * place.z, c, lod).xyz;
    }
  }
  return sum * vec3f(frame.chop_x, 1.0, frame.chop_z);
}

struct WaterSlope {
  // Mean slope of the displaced surface over the pixel.
  mean: vec2f,
  // Variances of the slope within it: xx, zz, xz.
  variance: vec3f,
  jacobian: f32,
}

// Unit normal of a surface of this slope.
fn water_normal(slope: vec2f) -> vec3f {
  return normalize(vec3f(-slope.x, 1.0, -slope.y));
}

// Footprint of a pixel on the undisplaced sea: its length along the longer side, filtered by several taps so that it is
// not blurred across. Hardware anisotropy is not used: it differs between GPUs and takes minutes in software.
struct WaterFootprint {
  axis: vec2f,
  // Size of one tap, m.
  size: f32,
  taps: i32,
}

const WATER_TAPS = 5;

fn water_footprint(dx: vec2f, dy: vec2f) -> WaterFootprint {
  let x = length(dx);
  let y = length(dy);
  let large = max(x, y);
  // Area over length: also right where the two sides are nearly parallel.
  let small = max(abs(dx.x * dy.y - dx.y * dy.x) / max(large, 1e-9), 1e-6);
  let taps = clamp(i32(ceil(large / small - 0.3)), 1, WATER_TAPS);
  return WaterFootprint(select(dy, dx, x > y), max(small, large / f32(taps)), taps);
}

// Mean and variance of the slope within a footprint.
fn water_slope(at: vec2f, foot: WaterFootprint) -> WaterSlope {
  var slope = vec2f(0.0);
  var stretch = vec2f(0.0);
  var shear = 0.0;
  // Cox and Munk 1954: waves shorter than the finest cascade.
  var variance = frame.residual.xyz;
  for (var c = 0u; c < frame.count; c++) {
    let place = frame.cascades[c];
    let texels = foot.size * place.z * frame.n;
    // Beyond this the patch is within the pixel: nothing but variance, one tap.
    let coarse = foot.size * place.z > 0.3;
    let taps = select(foot.taps, 1, coarse);
    let lod = select(log2(max(texels, 1e-6)), 16.0, coarse);
    var g = vec4f(0.0);
    var second = vec3f(0.0);
    for (var i = 0; i < taps; i++) {
      let uv = place.xy + (at + foot.axis * ((f32(i) + 0.5) / f32(taps) - 0.5)) * place.z;
      g += textureSampleLevel(gradients_map, wave_sampler, uv, c, lod);
      second += textureSampleLevel(moments_map, wave_sampler, uv, c, lod - 1.0).xyz;
      if lod < 4.0 {
        shear += textureSampleLevel(displacement_map, wave_sampler, uv, c, lod).w / f32(taps);
      }
    }
    g /= f32(taps);
    second *= place.w / f32(taps);
    slope += g.xy;
    stretch += g.zw;
    // The moments know nothing finer than two texels; closer up they would count resolved waves twice.
    let spread = max(second - vec3f(g.x * g.x, g.y * g.y, g.x * g.y), vec3f(0.0, 0.0, -1.0));
    variance += spread * clamp(lod, 0.0, 1.0);
  }
  // Ripples below the finest cascade, as a shrunk copy of it: slopes of short gravity waves are nearly scale-free.
  let scale = frame.ripples.w * frame.ripples.w;
  if scale > 0.0 {
    let c = frame.count - 1u;
    let unit = frame.cascades[c].w * scale;
    if foot.size * frame.ripples.z > 0.2 {
      variance += unit * textureSampleLevel(moments_map, wave_sampler, frame.ripples.xy, c, 16.0).xyz;
    } else {
      let lod = log2(max(foot.size * frame.ripples.z * frame.n, 1e-6));
      var g = vec2f(0.0);
      var second = vec3f(0.0);
      for (var i = 0; i < foot.taps; i++) {
        let uv = frame.ripples.xy + (at + foot.axis * ((f32(i) + 0.5) / f32(foot.taps) - 0.5)) * frame.ripples.z;
        g += textureSampleLevel(gradients_map, wave_sampler, uv, c, lod).xy;
        second += textureSampleLevel(moments_map, wave_sampler, uv, c, lod - 1.0).xyz;
      }
      g *= frame.ripples.w / f32(foot.taps);
      second *= unit / f32(foot.taps);
      slope += g;
      let spread = max(second - vec3f(g.x * g.x, g.y * g.y, g.x * g.y), vec3f(0.0, 0.0, -1.0));
      variance += spread * clamp(lod, 0.0, 1.0);
    }
  }
  let l = vec2f(frame.chop_x, frame.chop_z);
  let sx = 1.0 + l.x * stretch.x;
  let sz = 1.0 + l.y * stretch.y;
  let jacobian = sx * sz - l.x * l.y * shear * shear;
  // Where the surface folds the slope has no meaning: it stays finite under the foam.
  let over = 1.0 / max(jacobian, 0.25);
  var out: WaterSlope;
  out.mean = vec2f(slope.x * sz - slope.y * l.y * shear, slope.y * sx - slope.x * l.x * shear) * over;
  let steep = length(out.mean);
  out.mean *= min(1.0, 1.6 / max(steep, 1e-6));
  out.variance = variance;
  out.jacobian = jacobian;
  return out;
}
