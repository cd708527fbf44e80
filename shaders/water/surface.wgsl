// The displaced surface: the sum of all cascades, each blended from shifted copies of its patch (tiles.wgsl).

// Sums over the cascades of derivatives of elevation and displacement (Dx, Dz), without choppiness.
struct WaterDerivatives {
  // Slope of the elevation along x and z.
  slope: vec2f,
  // Derivatives dDx/dx and dDz/dz.
  stretch: vec2f,
  // Derivatives dDx/dz and dDz/dx.
  shear: vec2f,
}

// Adds one copy of a patch with its gradients `g` and displacement `d`. `weight`: its weight, and d/dx and d/dz of it.
fn water_add_patch_copy(sums: WaterDerivatives, g: vec4f, d: vec4f, weight: vec3f) -> WaterDerivatives {
  return WaterDerivatives(
    sums.slope + weight.x * g.xy + weight.yz * d.y,
    sums.stretch + weight.x * g.zw + weight.yz * d.xz,
    sums.shear + weight.x * d.ww + weight.zy * d.xz);
}

// Texel size at which a sample is read, relative to the length it covers: 1 / sqrt(3), because interpolation between
// the texels of a mip level (a box and a tent) blurs as much as a box of sqrt(3) texels.
const WATER_TAP_TEXEL_RATIO = 0.58;
// Weight of a copy of a patch up to which it is left out, because it is not seen.
const WATER_LEAST_COPY_WEIGHT = 0.008;

// Shortest wavelength of a cascade, in spacings of the mesh, from which vertices carry all of its slopes (x), and below
// which they carry none (y). Vertices read slopes only where maps are magnified (water_displacement): waves count as at
// most WATER_CARRIED_SPACINGS.y texels long (`shortest_carried_wave_m` in src/render/frame.rs).
const WATER_CARRIED_SPACINGS = vec2f(12.0, 7.0);
const WATER_INVERSE_CARRIED_RANGE = 1.0 / (WATER_CARRIED_SPACINGS.x - WATER_CARRIED_SPACINGS.y);

// Length of a pixel on the level sea, m, at a position relative to the point below the eye, m.
fn water_pixel_length_m(at: vec2f) -> f32 {
  let eye_m = frame.eye_height_m;
  return frame.pixel_angle * (dot(at, at) + eye_m * eye_m) / max(eye_m, 0.1);
}

// Reciprocal of the length, 1/m, with which the waves must be compared at a position relative to the point below the
// eye, m, to tell whether vertices carry their slopes: the mesh spacing, or two pixels if they are longer.
fn water_inverse_carrying_step(at: vec2f) -> f32 {
  return 1.0 / max(mesh_spacing(length(at)), 2.0 * water_pixel_length_m(at));
}

// Fraction of a cascade's slopes that the vertices carry, 0 to 1. Vertices carry the slopes of a cascade whose shortest
// waves are long compared with the mesh spacing and the pixel.
fn water_carried_fraction(map: FrameCascade, inverse_step: f32) -> f32 {
  let spacings = map.shortest_carried_wave_m * inverse_step;
  return maths_smooth((spacings - WATER_CARRIED_SPACINGS.y) * WATER_INVERSE_CARRIED_RANGE);
}

struct WaterDisplacement {
  displacement: vec3f,
  // Slopes that the mesh carries from its vertices to the pixels.
  carried: WaterDerivatives,
}

// Displacement of a position relative to the point below the eye, m, filtered over `spacing` metres. If `carries`, also
// the slopes that a vertex carries there.
fn water_displacement(at: vec2f, spacing: f32, carries: bool) -> WaterDisplacement {
  var sum = vec3f(0.0);
  // Height of the bound waves, and what a shorter wave is multiplied with in it (src/waves/second_order.rs).
  var bound_m = 0.0;
  var longer = vec3f(0.0, frame.bound_elevation_gain, 0.0);
  var out: WaterDisplacement;
  var gains: vec3f;
  // Offshore waves, which belong to the first cascade, until its others are added to them.
  var offshore = vec3f(0.0);
  if WATER_COAST {
    gains = coast_gains(at);
  }
  let log_spacing = log2(max(spacing, 1e-6));
  let inverse_step = water_inverse_carrying_step(at);
  for (var c = 0u; c < frame.cascade_count; c++) {
    let map = frame.cascades[c];
    let lod = log_spacing + map.log_texels_per_m;
    // Fades a cascade out, as its waves become shorter than two spacings of the mesh.
    let share = saturate(log2(frame.n) - 2.0 - lod);
    if share <= 0.0 {
      continue;
    }
    // The two seas of a cross-fade have no bound waves in common.
    longer = select(longer, vec3f(0.0, frame.bound_elevation_gain, 0.0), c == frame.fading_cascade_count);
    var own = vec3f(0.0);
    let smoothness = saturate(-2.0 * lod);
    var carried = select(0.0, water_carried_fraction(map, inverse_step), carries);
    if WATER_COAST {
      carried *= coast_slope_gain(map, gains);
    }
    var next = tile_blend(map.tile_position, at, carried > 0.0);
    for (var i = 0u; i < TILE_COPIES; i++) {
      let blend = next;
      next = tile_next_copy(blend);
      if blend.weight.x <= 0.0 {
        continue;
      }
      let uv = map.uv_below_eye + at * map.inverse_patch + tile_copy_shift(map.tile_position, blend);
      var d = vec4f(0.0);
      // `carried` can exceed 0 where a map is not magnified: water below an eye among waves lies off the mesh's centre.
      if smoothness > 0.0 || carried > 0.0 {
        let spline = water_spline_taps(uv, frame.n, smoothness);
        d = water_sample_spline(displacement_map, spline, map.layer);
        if carried > 0.0 {
          // A map without short waves needs no spline for slopes.
          var g: vec4f;
          if map.spline_smoothness > 0.0 {
            g = water_sample_spline(gradients_map, spline, map.layer);
          } else {
            g = textureSampleLevel(gradients_map, nearest_mip_sampler, uv, map.layer, 0.0);
          }
          let weight = vec3f(blend.weight.x, tile_weight_gradient(map.tile_position, blend));
          out.carried = water_add_patch_copy(out.carried, g, d, carried * weight);
        }
      } else {
        d = share * textureSampleLevel(displacement_map, trilinear_sampler, uv, map.layer, lod);
      }
      own += blend.weight.x * d.xyz;
    }
    var level = share * share;
    if WATER_COAST {
      let gain = coast_gain(map, gains);
      own *= gain;
      level *= gain * gain;
      // The layers of a coast come first. Waves at the coast have no bound waves.
      if map.coast_gains.x == 0.0 {
        sum += own;
        bound_m += level * map.bound_level_m;
        offshore += map.coast_gains.y * own;
        continue;
      }
    }
    sum += own;
    if WATER_COAST {
      own += offshore;
      offshore = vec3f(0.0);
    }
    bound_m += dot(own, 0.5 * map.bound_own.yxy * own + longer) + level * map.bound_level_m;
    longer += map.bound_with_shorter.yxy * own;
  }
  sum.y += bound_m;
  out.displacement = sum * vec3f(frame.choppiness.x, 1.0, frame.choppiness.y);
  return out;
}
