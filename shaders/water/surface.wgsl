// The displaced surface: every cascade blended from shifted copies (tiles.wgsl).

// Sums over the cascades, before chop.
struct WaterSums {
  // Slope of the height.
  slope: vec2f,
  // dDx/dx and dDz/dz, dDx/dz and dDz/dx.
  stretch: vec2f,
  shear: vec2f,
}

// With a copy of this weight, whose derivatives along x and z stand behind it.
fn water_sum(sums: WaterSums, g: vec4f, d: vec4f, weight: vec3f) -> WaterSums {
  return WaterSums(
    sums.slope + weight.x * g.xy + weight.yz * d.y,
    sums.stretch + weight.x * g.zw + weight.yz * d.xz,
    sums.shear + weight.x * d.ww + weight.zy * d.xz);
}

// Steps of the mesh to the shortest wave of a cascade from where on its vertices carry all of the slopes, and below which none.
// The vertices read slopes only where maps are magnified (water_moved): such a wave counts as one of at most so many texels.
const WATER_CARRIED = vec2f(12.0, 7.0);

// Share of a cascade's slopes that the vertices of the mesh carry at a point beside the eye: those of waves that are long there beside
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

// A point beside the eye, filtered to `spacing` metres, with chop; and what of the slopes it carries, if that is asked for.
fn water_moved(at: vec2f, spacing: f32, carries: bool) -> WaterMoved {
  var sum = vec3f(0.0);
  var out: WaterMoved;
  for (var c = 0u; c < frame.count; c++) {
    let map = frame.cascades[c];
    let lod = log2(max(spacing * map.inverse_patch * frame.n, 1e-3));
    // Nothing is left of waves that are shorter than two vertices.
    let share = clamp(log2(frame.n) - 2.0 - lod, 0.0, 1.0);
    let smoothness = clamp(-2.0 * lod, 0.0, 1.0);
    let carried = select(0.0, water_carried(c, at), carries);
    // Near the foot of an eye among waves a vertex is farther from its row than the share that it carries knows.
    let is_fine = smoothness > 0.0 || carried > 0.0;
    let blend = tile_blend(map.tile, at);
    let copies = select(0u, blend.count, share > 0.0);
    for (var i = 0u; i < copies; i++) {
      let uv = map.uv + at * map.inverse_patch + tile_shift(map.tile, blend, i);
      var d = vec4f(0.0);
      var g = vec4f(0.0);
      // Loops, not a branch, of which a software GPU computes both sides.
      for (var plain = !is_fine; plain; plain = false) {
        d = share * textureSampleLevel(displacement_map, wave_sampler, uv, map.layer, lod);
      }
      for (var fine = is_fine; fine; fine = false) {
        let spline = water_spline(uv, frame.n, smoothness);
        d = water_splined(displacement_map, spline, map.layer);
        if carries {
          g = carried * water_splined(gradients_map, spline, map.layer);
        }
      }
      sum += blend.weight[i] * d.xyz;
      let weight = vec3f(blend.weight[i], blend.along_x[i], blend.along_z[i]);
      out.carried = water_sum(out.carried, g, carried * d, weight);
    }
  }
  out.displacement = sum * vec3f(frame.chop.x, 1.0, frame.chop.y);
  return out;
}
