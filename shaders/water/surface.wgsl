// The displaced surface: the sum of the cascades, each blended from shifted copies (tiles.wgsl).

// Sums over the cascades, without the displacement factors.
struct WaterSums {
  // Slope of the height.
  slope: vec2f,
  // dDx/dx and dDz/dz.
  stretch: vec2f,
  // dDx/dz and dDz/dx.
  shear: vec2f,
}

// Adds a copy with values of the gradients and displacement maps. `weight` is its weight with its derivatives along x and z.
fn water_sum(sums: WaterSums, g: vec4f, d: vec4f, weight: vec3f) -> WaterSums {
  return WaterSums(
    sums.slope + weight.x * g.xy + weight.yz * d.y,
    sums.stretch + weight.x * g.zw + weight.yz * d.xz,
    sums.shear + weight.x * d.ww + weight.zy * d.xz);
}

// Steps of the mesh to the shortest wave of a cascade from which on the vertices carry all of its slopes, and below which they
// carry none. Vertices read slopes only where maps are magnified (water_moved): waves count as of at most WATER_CARRIED.y texels.
const WATER_CARRIED = vec2f(12.0, 7.0);

// Share of a cascade's slopes that the vertices carry at a point beside the eye's foot, 0 to 1: the waves must be long beside
// the steps of the mesh and the pixels.
fn water_carried(cascade: u32, at: vec2f) -> f32 {
  let map = frame.cascades[cascade];
  let shortest_m = min(map.wave_texels, WATER_CARRIED.y) / (map.inverse_patch * frame.n);
  let pixel_m = frame.pixel * (dot(at, at) + frame.eye_m * frame.eye_m) / max(frame.eye_m, 0.1);
  let step_m = max(mesh_spacing(length(at)), 2.0 * pixel_m);
  return smoothstep(WATER_CARRIED.y, WATER_CARRIED.x, shortest_m / step_m);
}

struct WaterMoved {
  displacement: vec3f,
  // Slopes of the waves that the mesh carries from vertex to pixel.
  carried: WaterSums,
}

// The displacement of a point beside the eye's foot, filtered over `spacing` metres; with the slopes that a vertex carries
// there, if `carries`.
fn water_moved(at: vec2f, spacing: f32, carries: bool) -> WaterMoved {
  var sum = vec3f(0.0);
  var out: WaterMoved;
  for (var c = 0u; c < frame.count; c++) {
    let map = frame.cascades[c];
    let lod = log2(max(spacing * map.inverse_patch * frame.n, 1e-3));
    // Nothing is left of waves that are shorter than two steps of the mesh.
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
      // `carried` can exceed 0 where the map is not magnified: the foot of an eye among waves lies off the lattice's middle.
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
