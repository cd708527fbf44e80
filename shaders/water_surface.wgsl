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
  return sum * vec3f(frame.chop, 1.0, frame.chop);
}

struct WaterSlope {
  // Mean slope of the displaced surface over the pixel.
  mean: vec2f,
  // Variances of the slope within it: xx, zz, xz.
  variance: vec3f,
  jacobian: f32,
}

// Samples along a footprint. The samplers' own anisotropic filter is not used: Mesa's software driver loops for ever in it.
const WATER_TAPS = 4.0;

// Mean and variance of the slope over the footprint (dx, dy) of a pixel on the undisplaced sea.
fn water_slope(at: vec2f, dx: vec2f, dy: vec2f) -> WaterSlope {
  // The footprint is cut into pieces along its longer side; each is read at its own width.
  let longer = select(dy, dx, dot(dx, dx) > dot(dy, dy));
  let large = length(longer);
  let little = min(length(dx), length(dy));
  let taps = clamp(ceil(0.6 * large / max(little, 1e-9)), 1.0, WATER_TAPS);
  let width = max(little, large / taps);
  var slope = vec2f(0.0);
  var stretch = vec2f(0.0);
  var shear = 0.0;
  // Cox and Munk 1954: waves shorter than the finest cascade, somewhat steeper along the wind.
  let w = frame.downwind;
  var variance = frame.residual_mss * (vec3f(0.42) * vec3f(1.0, 1.0, 0.0) + 0.16 * vec3f(w.x * w.x, w.y * w.y, w.x * w.y));
  for (var c = 0u; c < frame.count; c++) {
    let place = frame.cascades[c];
    let uv = place.xy + at * place.z;
    if width * place.z > 0.5 {
      // The whole patch is in the pixel: nothing but variance.
      variance += textureSampleLevel(moments_map, wave_sampler, uv, c, 16.0).xyz * place.w;
      continue;
    }
    let lod = log2(max(width * place.z * frame.n, 1e-6));
    var g = vec4f(0.0);
    var second = vec3f(0.0);
    for (var k = 0.0; k < taps; k += 1.0) {
      let off = longer * (((k + 0.5) / taps - 0.5) * place.z);
      g += textureSampleLevel(gradients_map, wave_sampler, uv + off, c, lod);
      second += textureSampleLevel(moments_map, wave_sampler, uv + off, c, lod - 1.0).xyz;
    }
    g /= taps;
    second *= place.w / taps;
    slope += g.xy;
    stretch += g.zw;
    if lod < 5.0 {
      shear += textureSampleLevel(displacement_map, wave_sampler, uv, c, lod).w;
    }
    // The moments know nothing finer than two texels; closer up they would count resolved waves twice.
    let spread = max(second - vec3f(g.x * g.x, g.y * g.y, g.x * g.y), vec3f(0.0, 0.0, -1.0));
    variance += spread * clamp(lod, 0.0, 1.0);
  }
  // Ripples below the finest cascade, as a shrunk copy of it: slopes of short gravity waves are nearly scale-free.
  let scale = frame.ripples.w * frame.ripples.w;
  if scale > 0.0 {
    let c = frame.count - 1u;
    let unit = frame.cascades[c].w * scale;
    if width * frame.ripples.z > 0.25 {
      variance += unit * vec3f(1.0, 1.0, 0.0);
    } else {
      let lod = log2(max(width * frame.ripples.z * frame.n, 1e-6));
      let uv = frame.ripples.xy + at * frame.ripples.z;
      let g = textureSampleLevel(gradients_map, wave_sampler, uv, c, lod).xy;
      let second = textureSampleLevel(moments_map, wave_sampler, uv, c, lod - 1.0).xyz * unit;
      slope += g * frame.ripples.w;
      let spread = max(second - scale * vec3f(g.x * g.x, g.y * g.y, g.x * g.y), vec3f(0.0, 0.0, -1.0));
      variance += spread * clamp(lod, 0.0, 1.0);
    }
  }
  let l = frame.chop;
  let sx = 1.0 + l * stretch.x;
  let sz = 1.0 + l * stretch.y;
  let jacobian = sx * sz - l * l * shear * shear;
  // Where the surface folds the slope has no meaning: it stays finite under the foam.
  let over = 1.0 / max(jacobian, 0.25);
  var out: WaterSlope;
  out.mean = vec2f(slope.x * sz - slope.y * l * shear, slope.y * sx - slope.x * l * shear) * over;
  let steep = length(out.mean);
  out.mean *= min(1.0, 1.6 / max(steep, 1e-6));
  out.variance = variance;
  out.jacobian = jacobian;
  return out;
}
