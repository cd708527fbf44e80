// The bed below shallow water: banks and channels, rippled sand, meadows of seagrass and reefs where the refracted ray
// hits it, and the sunlight that waves focus.

// Layers of the bed's texture (src/render/water/bed.rs): banks and channels, meadows, heads of coral, ripples.
const BED_BANK_LAYER = 4u;
const BED_MEADOW_LAYER = 5u;
const BED_HEAD_LAYER = 6u;
const BED_RIPPLE_LAYER = 7u;
// Decoding of the texture: slope of ripples up to 1 in red, their height up to 1.6 amplitudes in green, normal noise up
// to 3.2 deviations in blue and alpha.
const BED_RANGE = vec4f(2.0, 3.2, 6.4, 6.4);
// Side of the tile of the ripples, m.
const BED_RIPPLE_TILE_M = 15.1;
// Noise of the bed: mip level at which half the variance is left, of the fractal noise (x) and of the coral (y), and
// steepness of the decrease. Fitted to the mip levels as the sampler interpolates them.
const BED_HALF_VARIANCE_LOD = vec2f(5.45, 3.45);
const BED_VARIANCE_STEEPNESS = vec2f(1.65, 1.35);
// The water's depth varies by these standard deviations over hundreds and over tens of metres, relative to its mean.
const BED_BANKS = vec2f(0.14, 0.09);
// Finest mip levels at which the two are read: banks are smooth.
const BED_BANK_LODS = vec2f(1.5, 3.5);
// Widths of the edges of meadows (x) and reefs (y), standard deviations of their noise.
const BED_SOFTNESS = vec2f(0.3, 0.14);
// Weights of the noise of banks, meadows and heads, whose squares add up to 1.
const BED_MEADOW_WEIGHTS = vec3f(0.58, 0.63, 0.5164);
const BED_REEF_WEIGHTS = vec3f(0.35, 0.65, 0.6745);
// Albedos of seagrass and of a reef (Hochberg and Atkinson 2003: 3 to 10 %, and brown).
const BED_SEAGRASS_ALBEDO = vec3f(0.056, 0.080, 0.034);
const BED_REEF_ALBEDO = vec3f(0.135, 0.105, 0.062);
// Optical depth of the way to the bed and back from which the bed is not seen.
const BED_HIDDEN = 7.0;
// Limits the brightness of a caustic, which the sun's disc and scattering in the water blur.
const BED_CAUSTIC_BLUR = 0.08;

// Slope and height of ripples (xy) and noises (zw) of a layer at a position relative to the point below the eye, m, at
// a mip level.
fn bed_noise(layer: u32, at: vec2f, lod: f32) -> vec4f {
  let texel = textureSampleLevel(noise_map, noise_sampler, material_uv(layer, at), 1, max(lod, 0.0));
  return (texel - 0.5) * BED_RANGE;
}

// Fractions of the variances of both noises that are left at a mip level, 0 to 1.
fn bed_variance_left(lod: f32) -> vec2f {
  return 1.0 / (1.0 + exp2(BED_VARIANCE_STEEPNESS * (vec2f(lod) - BED_HALF_VARIANCE_LOD)));
}

// Noise of banks and channels, over hundreds and over tens of metres, filtered over texels of `size` metres.
fn bed_banks(at: vec2f, size: f32) -> vec2f {
  let wide = max(material_lod(BED_BANK_LAYER, size), BED_BANK_LODS.x);
  let narrow = max(material_lod(BED_MEADOW_LAYER, size), BED_BANK_LODS.y);
  return vec2f(bed_noise(BED_BANK_LAYER, at, wide).z, bed_noise(BED_MEADOW_LAYER, at, narrow).z);
}

// The ground of the bed in a pixel.
struct BedGround {
  albedo: vec3f,
  // Slope of its sand ripples along the first side of their tile.
  slope: f32,
}

// The ground at a position relative to the point below the eye, m. It is filtered over texels of `size` metres, in two
// samples `step` before and behind. `banks` is the noise of the banks.
fn bed_ground(at: vec2f, step: vec2f, size: f32, banks: vec2f) -> BedGround {
  let lods = vec3f(
    material_lod(BED_MEADOW_LAYER, size), material_lod(BED_HEAD_LAYER, size), material_lod(BED_RIPPLE_LAYER, size));
  let bank_left = bed_variance_left(max(material_lod(BED_BANK_LAYER, size), BED_BANK_LODS.x)).x;
  let meadow_left = bed_variance_left(lods.x);
  let head_left = bed_variance_left(lods.y);
  let resolved = vec2f(
    dot(BED_MEADOW_WEIGHTS * BED_MEADOW_WEIGHTS, vec3f(bank_left, meadow_left.x, head_left.x)),
    dot(BED_REEF_WEIGHTS * BED_REEF_WEIGHTS, vec3f(bank_left, meadow_left.y, head_left.y)));
  let sharp = inverseSqrt(max(BED_SOFTNESS * BED_SOFTNESS + 1.0 - resolved, vec2f(1e-3)));
  let wide = bed_noise(BED_MEADOW_LAYER, at, lods.x).zw;
  var out: BedGround;
  var tap = at - step;
  for (var i = 0; i < 2; i++) {
    let heads = bed_noise(BED_HEAD_LAYER, tap, lods.y).zw;
    let fine = bed_noise(BED_RIPPLE_LAYER, tap, lods.z);
    tap += 2.0 * step;
    let meadow = maths_normal_cdf(
      (dot(BED_MEADOW_WEIGHTS, vec3f(banks.x, wide.x, heads.x)) + material.bed_cover_edges.x) * sharp.x);
    let reef = maths_normal_cdf(
      (dot(BED_REEF_WEIGHTS, vec3f(-banks.x, wide.y, heads.y)) + material.bed_cover_edges.y) * sharp.y);
    // Sand is rippled in places.
    let rippled = saturate(0.65 + 0.3 * heads.x);
    out.slope += (0.5 * (1.0 - meadow) * (1.0 - reef)) * rippled * fine.x;
    // Their troughs gather dark grains.
    let sand = material.bed_colour * max(1.0 + 0.06 * heads.x + 0.035 * fine.z + 0.08 * rippled * fine.y, 0.3);
    let seagrass = BED_SEAGRASS_ALBEDO * max(1.0 + 0.22 * heads.x + 0.3 * fine.z, 0.2);
    let coral = BED_REEF_ALBEDO * max(1.0 + 0.3 * heads.y + 0.33 * fine.w, 0.15);
    out.albedo += 0.5 * mix(mix(sand, seagrass, meadow), coral, reef);
  }
  return out;
}

// Mean slope of the waves that focus light, at an undisplaced position relative to the point below the eye, m. It is
// that of water_slope without shears and ripples, and no variance is read.
fn bed_focusing_slope(at: vec2f, foot: WaterFootprint) -> vec2f {
  var waves: WaterSlopeSums;
  var gains: vec3f;
  if WATER_COAST {
    gains = coast_gains(at);
  }
  for (var c = 0u; c < frame.cascade_count; c++) {
    let map = frame.cascades[c];
    if water_is_distant(map, foot) {
      continue;
    }
    var sampling = water_sampling(map, foot);
    if WATER_COAST {
      sampling.slope_weight *= coast_gain(map, gains);
    }
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
// Waves shorter than 2 `filter_m` metres are left out.
fn bed_caustic_gain(entry: vec2f, depth_m: f32, filter_m: f32) -> f32 {
  let reach = depth_m * (1.0 - material.inverse_relative_index);
  let foot = water_round_footprint(filter_m);
  // Two fixed-point steps find where the ray that arrives at the given point enters the water. Loops, because compilers
  // copy a called function to each call.
  var at = entry;
  for (var step = 0; step < 2; step++) {
    at = entry - reach * bed_focusing_slope(at, foot);
  }
  // The Hessian from differences over two steps along x and along z: the step turns by a quarter in each round.
  let h = 0.5 * filter_m;
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
// `place`: surface point (x, z) relative to the eye, m; `ray`: direction down into the water; `size`: length along the
// ray and width of the texels that are averaged over the pixel, m; `variance`: covariance (xx, zz, xz) of the slopes
// within the pixel.
fn water_bed_radiance(deep: vec3f, place: vec2f, height: f32, ray: vec3f, size: vec2f, variance: vec3f) -> vec3f {
  let down = max(-ray.y, 0.12);
  let run = ray.xz / down;
  let k = material.absorption + material.backscatter;
  var banks: vec2f;
  var column: f32;
  if WATER_LAND {
    column = land_column_m(place, run, height, size.x);
    if 2.0 * column * min(k.r, min(k.g, k.b)) > BED_HIDDEN {
      return deep;
    }
    banks = bed_banks(place + run * column, size.x);
  } else {
    // Water over a bank or in a channel; the ray meets it near where it would meet an even bed.
    banks = bed_banks(place + run * frame.depth_m, size.x);
    column = max(frame.depth_m * max(1.0 + dot(BED_BANKS, banks), 0.4) + height, 0.05);
  }
  let length_m = column / down;
  let hit = place + run * column;
  // Unresolved slopes turn the ray by `bend` times their angle, which spreads it over the bed, most of all along it.
  let square = max(1.0 - down * down, 1e-6);
  let along = ray.xz * inverseSqrt(max(dot(ray.xz, ray.xz), 1e-6));
  let index = material.relative_index;
  let incidence = sqrt(max(1.0 - index * index * square, 0.0));
  let bend = column * max(down - incidence / index, 0.0) / down;
  let all_along = max(along.x * along.x * variance.x + along.y * along.y * variance.y
    + 2.0 * along.x * along.y * variance.z, 1e-7);
  // At grazing view only facets that tilt to the eye are seen, whose slopes vary less. Fitted to Gaussian slopes.
  let along_variance = all_along * (1.0 - 0.57 * exp(-0.45 * incidence * inverseSqrt(all_along)));
  let across_variance = max(variance.x + variance.y - all_along, 0.0);
  let spread = (2.0 * bend) * sqrt(vec2f(along_variance, across_variance)) * vec2f(1.0 / (down * down), 1.0);
  let filtered = sqrt(size * size + spread * spread);
  // Two samples cover the longer side, each with texels between its width and half its length.
  let part = 0.71 * filtered.x;
  let texel = sqrt(part * max(part, filtered.y));
  // Before the caustics, which need most registers.
  var ground = bed_ground(hit, along * (0.354 * filtered.x), texel, banks);
  if WATER_LAND && column < BED_SHORE_M.y {
    ground = bed_shore_ground(ground, hit, column, texel);
  }
  let beam = water_refract(-frame.sun_direction, vec3f(0.0, 1.0, 0.0));
  let sun_height = max(frame.sun_direction.y, 0.0);
  let beam_down = max(-beam.y, 0.3);
  var sun = shadow_entering_sun_irradiance() * (sun_height * (1.0 - water_fresnel(sun_height)));
  if WATER_CAUSTICS && frame.sun_direction.y > 0.0 {
    let entry = hit - beam.xz * (column / beam_down);
    // Light that is scattered on its way down is not focused.
    let straight = exp(-0.25 * (material.scattering.g - material.backscatter.g) * column / beam_down);
    let resolved = 1.0 - smoothstep(0.8, 3.0, texel / material.caustic_filter_m);
    let sharp = material.caustic_strength * straight * resolved;
    if sharp > 0.01 {
      sun *= mix(1.0, bed_caustic_gain(entry, column, material.caustic_filter_m), sharp);
    }
  }
  // Sides of the ripples that face the sun are brighter.
  let axes = material.noise_layers[BED_RIPPLE_LAYER].uv_from_position;
  let tilt = BED_RIPPLE_TILE_M * dot(beam.xz, vec2f(axes[0].x, axes[1].x));
  let facing = max(1.0 + ground.slope * tilt / beam_down, 0.0);
  let sun_down = sun * facing * exp(-k * (column / beam_down));
  let sky_down = light.sky_irradiance * (WATER_SKYLIGHT_TRANSMITTANCE * exp(-1.2 * k * column));
  let up = exp(-k * length_m);
  let lit = (sun_down + sky_down) * ground.albedo / ATM_PI;
  return lit * up + deep * (1.0 - up * exp(-1.1 * k * column));
}
