// The sandy bed below shallow water: its albedo where the refracted ray hits it, and the sunlight that waves focus.

// Noise layer of sand patches and ripple marks.
const BED_PATCH_LAYER = 4u;
// Noise layer of sand grains.
const BED_GRAIN_LAYER = 5u;
// Number of periods of the ripple marks in the sand along both sides of the noise tile (src/render/water/material.rs).
const BED_RIPPLES_PER_TILE = vec2f(37.0, 11.0);
// Wavelength of the ripple marks in the sand, m.
const BED_RIPPLE_WAVELENGTH_M = 0.32;
// Limits the brightness of a caustic, which the sun's disc and scattering in the water blur.
const BED_CAUSTIC_BLUR = 0.15;

// Albedo of the sand at a position relative to the point below the eye, m, filtered over `size` metres.
fn bed_albedo(at: vec2f, size: f32) -> vec3f {
  let wide = material_noise(BED_PATCH_LAYER, at, material_lod(BED_PATCH_LAYER, size));
  let fine = material_noise(BED_GRAIN_LAYER, at, material_lod(BED_GRAIN_LAYER, size));
  // Curved ripple marks, with whole periods per tile so that they stay in place when the eye moves.
  let uv = material_uv(BED_PATCH_LAYER, at);
  let bend = 2.5 * textureSampleLevel(noise_map, noise_sampler, uv, 4.0).b;
  let phase = 2.0 * ATM_PI * (dot(uv, BED_RIPPLES_PER_TILE) + bend);
  let shown = exp(-pow(1.6 * size / BED_RIPPLE_WAVELENGTH_M, 2.0));
  let ripple = 0.10 * shown * (sin(phase) + 0.25 * sin(2.0 * phase + 0.7));
  let patches = wide.b - 0.5;
  let grains = fine.g - 0.5;
  return material.bed_colour * clamp(1.0 + 0.35 * patches + 0.22 * grains + ripple, 0.3, 1.5);
}

// Mean slope of the waves that focus light, at an undisplaced position relative to the point below the eye, m. It is
// that of water_slope without shears and ripples, and no variance is read.
fn bed_focusing_slope(at: vec2f, foot: WaterFootprint) -> vec2f {
  var waves: WaterSlopeSums;
  for (var c = 0u; c < frame.cascade_count; c++) {
    let map = frame.cascades[c];
    if water_is_distant(map, foot) {
      continue;
    }
    let sampling = water_sampling(map, foot);
    let first_uv = map.uv_below_eye + at * map.inverse_patch;
    var next = tile_blend(map.tile_position, at, false);
    for (var i = 0u; i < TILE_COPIES; i++) {
      let blend = next;
      next = tile_next_copy(blend);
      if blend.weight.x > 0.0 {
        let uv = first_uv + tile_copy_shift(map.tile_position, blend);
        let weight = sampling.slope_weight * blend.weight.x;
        let gradients = textureSampleLevel(gradients_map, trilinear_sampler, uv, map.layer, sampling.slope_lod);
        waves.sums.slope += weight * gradients.xy;
        waves.sums.stretch += weight * gradients.zw;
      }
    }
  }
  return water_displaced_slope(waves).mean;
}

// Irradiance by the sun at a point of the bed, relative to its mean. A ray that enters the water at s meets the bed at
// s + reach grad(eta)(s), with the elevation eta and its Hessian H. So light is focused by 1 / |det(I + reach H)|.
fn bed_caustic_gain(entry: vec2f, depth_m: f32) -> f32 {
  let reach = depth_m * (1.0 - material.inverse_relative_index);
  let foot = water_round_footprint(material.caustic_filter_m);
  // Two fixed-point steps find where the ray that arrives at the given point enters the water. Loops, because compilers
  // copy a called function to each call.
  var at = entry;
  for (var step = 0; step < 2; step++) {
    at = entry - reach * bed_focusing_slope(at, foot);
  }
  // The Hessian from differences over two steps along x and along z: the step turns by a quarter in each round.
  let h = 0.5 * material.caustic_filter_m;
  var side = vec2f(h, 0.0);
  var x = vec2f(0.0);
  var z = vec2f(0.0);
  for (var turn = 0; turn < 4; turn++) {
    let slope = bed_focusing_slope(at + side, foot);
    x += slope * side.x;
    z += slope * side.y;
    side = vec2f(-side.y, side.x);
  }
  let scale = reach / (2.0 * h * h);
  x *= scale;
  z *= scale;
  let det = (1.0 + x.x) * (1.0 + z.y) - x.y * z.x;
  return sqrt((1.0 + BED_CAUSTIC_BLUR * BED_CAUSTIC_BLUR) / (det * det + BED_CAUSTIC_BLUR * BED_CAUSTIC_BLUR));
}

// Radiance inside the water towards the surface where the bed is visible. `deep`: radiance of bottomless water;
// `place`: surface point (x, z) relative to the eye, m; `ray`: direction down into the water; `blur`: standard
// deviation of the ray's slope within the pixel.
fn water_bed_radiance(deep: vec3f, place: vec2f, height: f32, ray: vec3f, size: f32, blur: f32) -> vec3f {
  let column = max(frame.depth_m + height, 0.05);
  let down = max(-ray.y, 0.12);
  let length_m = column / down;
  let hit = place + ray.xz * length_m;
  let filtered = size / down + 0.5 * blur * length_m;
  let k = material.absorption + material.backscatter;
  let beam = water_refract(-frame.sun_direction, vec3f(0.0, 1.0, 0.0));
  let sun_height = max(frame.sun_direction.y, 0.0);
  var sun = cloud_sun_irradiance() * (sun_height * (1.0 - water_fresnel(sun_height)));
  if WATER_CAUSTICS && frame.sun_direction.y > 0.0 {
    let entry = hit + beam.xz * (column / min(beam.y, -0.3));
    // Light that is scattered on its way down is not focused.
    let straight = exp(-0.25 * (material.scattering.g - material.backscatter.g) * column / max(-beam.y, 0.3));
    let resolved = 1.0 - smoothstep(0.5, 2.0, filtered / material.caustic_filter_m);
    let sharp = material.caustic_strength * straight * resolved;
    if sharp > 0.01 {
      sun *= mix(1.0, bed_caustic_gain(entry, column), sharp);
    }
  }
  let sun_down = sun * exp(-k * (column / max(-beam.y, 0.3)));
  let sky_down = light.sky_irradiance * (WATER_SKYLIGHT_TRANSMITTANCE * exp(-1.2 * k * column));
  let up = exp(-k * length_m);
  let sand = (sun_down + sky_down) * bed_albedo(hit, filtered) / ATM_PI;
  return sand * up + deep * (1.0 - up * exp(-1.1 * k * column));
}
