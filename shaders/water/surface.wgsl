// The displaced surface: the sum of all cascades, each blended from shifted copies of its patch (tiles.wgsl).

// Sums over the cascades of derivatives of elevation and displacement (Dx, Dz), without choppiness.
struct WaterSums {
  // Slope of the elevation along x and z.
  slope: vec2f,
  // Derivatives dDx/dx and dDz/dz.
  stretch: vec2f,
  // Derivatives dDx/dz and dDz/dx.
  shear: vec2f,
}

// Adds one copy of a patch with its gradients `g` and displacement `d`. `weight`: its weight, and d/dx and d/dz of it.
fn water_sum(sums: WaterSums, g: vec4f, d: vec4f, weight: vec3f) -> WaterSums {
  return WaterSums(
    sums.slope + weight.x * g.xy + weight.yz * d.y,
    sums.stretch + weight.x * g.zw + weight.yz * d.xz,
    sums.shear + weight.x * d.ww + weight.zy * d.xz);
}

// Shortest wavelength of a cascade, in spacings of the mesh, from which vertices carry all of its slopes (x), and below
// which they carry none (y). Vertices read slopes only where maps are magnified (water_moved): waves count as at most
// WATER_CARRIED.y texels long.
const WATER_CARRIED = vec2f(12.0, 7.0);

// Fraction of a cascade's slopes that the vertices carry, 0 to 1, at a position relative to the point below the eye, m.
// Its shortest waves must be long compared with the spacing of the mesh and with the pixel.
fn water_carried(cascade: u32, at: vec2f) -> f32 {
  let map = frame.cascades[cascade];
  let shortest_m = min(map.wave_texels, WATER_CARRIED.y) / (map.inverse_patch * frame.n);
  let pixel_m = frame.pixel * (dot(at, at) + frame.eye_m * frame.eye_m) / max(frame.eye_m, 0.1);
  let step_m = max(mesh_spacing(length(at)), 2.0 * pixel_m);
  return smoothstep(WATER_CARRIED.y, WATER_CARRIED.x, shortest_m / step_m);
}

struct WaterMoved {
  displacement: vec3f,
  // Slopes that the mesh carries from its vertices to the pixels.
  carried: WaterSums,
}

// Displacement of a position relative to the point below the eye, m, filtered over `spacing` metres. If `carries`, also
// the slopes that a vertex carries there.
fn water_moved(at: vec2f, spacing: f32, carries: bool) -> WaterMoved {
  var sum = vec3f(0.0);
  var out: WaterMoved;
  for (var c = 0u; c < frame.count; c++) {
    let map = frame.cascades[c];
    let lod = log2(max(spacing * map.inverse_patch * frame.n, 1e-3));
    // Fades a cascade out, as its waves become shorter than two spacings of the mesh.
    let share = clamp(log2(frame.n) - 2.0 - lod, 0.0, 1.0);
    if share <= 0.0 {
      continue;
    }
    let smoothness = clamp(-2.0 * lod, 0.0, 1.0);
    let carried = select(0.0, water_carried(c, at), carries);
    var blend = tile_blend(map.tile, at);
    for (var i = 0u; i < blend.count; i++) {
      let uv = map.uv + at * map.inverse_patch + tile_shift(map.tile, blend);
      var d = vec4f(0.0);
      var g = vec4f(0.0);
      // `carried` can exceed 0 where a map is not magnified: water below an eye among waves lies off the mesh's centre.
      if smoothness > 0.0 || carried > 0.0 {
        let spline = water_spline(uv, frame.n, smoothness);
        d = water_splined(displacement_map, spline, map.layer);
        if carries {
          g = carried * water_splined(gradients_map, spline, map.layer);
        }
      } else {
        d = share * textureSampleLevel(displacement_map, wave_sampler, uv, map.layer, lod);
      }
      let weight = tile_weight(blend);
      sum += weight.x * d.xyz;
      out.carried = water_sum(out.carried, g, carried * d, weight);
      blend = tile_next(blend);
    }
  }
  out.displacement = sum * vec3f(frame.chop.x, 1.0, frame.chop.y);
  return out;
}
