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

// Mean and variance of the slope over the footprint (dx, dy) of a pixel on the undisplaced sea.
fn water_slope(at: vec2f, dx: vec2f, dy: vec2f) -> WaterSlope {
  let small = max(min(length(dx), length(dy)), max(length(dx), length(dy)) / 8.0);
  var slope = vec2f(0.0);
  var stretch = vec2f(0.0);
  var shear = 0.0;
  // Cox and Munk 1954: waves shorter than the finest cascade, somewhat steeper along the wind.
  let w = frame.downwind;
  var variance = frame.residual_mss * (vec3f(0.42) * vec3f(1.0, 1.0, 0.0) + 0.16 * vec3f(w.x * w.x, w.y * w.y, w.x * w.y));
  for (var c = 0u; c < frame.count; c++) {
    let place = frame.cascades[c];
    let uv = place.xy + at * place.z;
    let gx = dx * place.z;
    let gy = dy * place.z;
    let lod = log2(max(small * place.z * frame.n, 1e-6));
    let second = textureSampleGrad(moments_map, wave_sampler, uv, c, gx, gy).xyz * place.w;
    if small * place.z > 0.5 {
      // The whole patch is in the pixel: nothing but variance.
      variance += second;
      continue;
    }
    let g = textureSampleGrad(gradients_map, wave_sampler, uv, c, gx, gy);
    slope += g.xy;
    stretch += g.zw;
    if lod < 5.0 {
      shear += textureSampleGrad(displacement_map, wave_sampler, uv, c, gx, gy).w;
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
    let lod = log2(max(small * frame.ripples.z * frame.n, 1e-6));
    if small * frame.ripples.z > 0.25 {
      variance += unit * vec3f(1.0, 1.0, 0.0);
    } else {
      let uv = frame.ripples.xy + at * frame.ripples.z;
      let gx = dx * frame.ripples.z;
      let gy = dy * frame.ripples.z;
      let g = textureSampleGrad(gradients_map, wave_sampler, uv, c, gx, gy).xy;
      let second = textureSampleGrad(moments_map, wave_sampler, uv, c, gx, gy).xyz * unit;
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
