// The picture of a camera under water: lights each pixel whose ray starts in the water, and draws the line where the
// surface of the water crosses the lens.

// The map of the light shafts has the binding of slope_and_stretch_map (light.wgsl), which no entry point here reads.
@group(2) @binding(2) var shafts_map: texture_2d<f32>;

// Height of the surface at the lens, m, as estimated from its slope, below which the sides of the mesh decide what a
// pixel shows.
const UNDER_SURE_M = 0.05;
// Distance, m. A ray that begins within millimetres of the surface leaves the water before it gets so far, so a farther
// surface does not tell on which side the ray began.
const UNDER_FAR_M = 2.0;
// Height, divided by the picture's, down to which a pixel under water must have more water below it in the picture.
const UNDER_RIM = 0.003;
// Steps by halves in which the waterline below a pixel is found.
const UNDER_LINE_STEPS = 8;
// Factor on the size of the bed that a pixel shows through the climbing water, which bends rays strongly, less 1.
const UNDER_SQUEEZE = 150.0;
// Whether a part of the lens may stand in the air: if not, there is no waterline to look for.
override UNDER_SEES_AIR: bool = true;
// Binary logarithm of the size of the surface, m, through which the water in the picture is lit.
const UNDER_LOG_LIT_M = 5.0;

// As mesh_fragment, but with a negative side where the pixel shows the water from below.
@fragment
fn under_mesh_fragment(in: MeshFragment, @builtin(front_facing) is_front: bool) -> GBuffer {
  var out = mesh_g_buffer(in);
  out.shear_and_side.y *= select(-1.0, 1.0, is_front);
  return out;
}

// Height of the surface above the point where a ray leaves the lens, m, from the slope of the surface at the eye. The
// ray's component along the viewing direction is 1.
fn under_estimate_m(ray: vec3f) -> f32 {
  let lens = ray * frame.clip_from_relative[3].z;
  return frame.water_at_eye.x + dot(frame.water_at_eye.yz, lens.xz) - lens.y;
}

// Whether the ray of a pixel begins under water: then the first surface that it meets is the lower side of the mesh, or,
// if it goes down, there is none. The estimate decides where the surface at the lens is far away, and about a far surface,
// because a wave that folds over shows its lower side in the air.
fn under_begins_alone(pixel: vec2i, ray: vec3f) -> bool {
  let estimate_m = under_estimate_m(ray);
  let depth = textureLoad(depth_map, pixel, 0);
  let near_m = frame.clip_from_relative[3].z;
  let is_far = depth > 0.0 && near_m > UNDER_FAR_M * depth;
  if is_far || abs(estimate_m) > UNDER_SURE_M {
    return estimate_m > 0.0;
  }
  if depth == 0.0 {
    return ray.y < 0.0;
  }
  return textureLoad(shear_and_side_map, pixel, 0).y < 0.0;
}

// As under_begins_alone, but the rim of a near crest, whose lower side can show through in single pixels, has air below
// itself in the picture.
fn under_begins(pixel: vec2i, ray: vec3f) -> bool {
  if !under_begins_alone(pixel, ray) {
    return false;
  }
  let size = vec2i(textureDimensions(depth_map));
  let down = i32(ceil(UNDER_RIM * f32(size.y)));
  let below = vec2i(pixel.x, min(pixel.y + down, size.y - 1));
  return under_begins_alone(below, ray - frame.up * (2.0 * f32(below.y - pixel.y) / f32(size.y)));
}

// Whether a pixel that seems to show air lies between two rows that show water: the edge of a fold of the surface seen
// from below, where a pixel may catch its upper side.
fn under_is_fold(pixel: vec2i, ray: vec3f) -> bool {
  let rows = 2;
  let size_y = i32(textureDimensions(depth_map).y);
  if pixel.y < rows || pixel.y + rows >= size_y {
    return false;
  }
  let step = frame.up * (2.0 * f32(rows) / f32(size_y));
  return under_begins_alone(pixel + vec2i(0, rows), ray - step)
    && under_begins_alone(pixel - vec2i(0, rows), ray + step);
}

// Tiles of noise in a metre of the glass, in two layers; their mip level; and the mean height of the line relative to the
// highest one, and the weights of both layers in it.
const UNDER_GLASS_TILES_PER_M = vec2f(1.7, 4.3);
const UNDER_GLASS_LOD = 4.0;
const UNDER_GLASS = vec3f(0.6, 2.4, 1.0);
// Least height of the line, relative to the highest one.
const UNDER_GLASS_LEAST = 0.2;

// Height of a row of pixels on the lens, m.
fn under_row_m() -> f32 {
  return frame.clip_from_relative[3].z * length(frame.up) * (2.0 / f32(textureDimensions(depth_map).y));
}

// Noise along the glass. Three samples half a texel apart round off the kinks of linear interpolation.
fn under_glass_noise(at: f32, row: f32) -> f32 {
  let step = 0.5 * exp2(UNDER_GLASS_LOD) / f32(textureDimensions(noise_map).x);
  var sum = 0.0;
  for (var i = -1; i <= 1; i++) {
    let weight = select(0.25, 0.5, i == 0);
    sum += weight * textureSampleLevel(noise_map, noise_sampler, vec2f(at + f32(i) * step, row), 0, UNDER_GLASS_LOD).a;
  }
  return sum - 0.5;
}

// Height to which water climbs the lens in a column of pixels, m: it climbs clean glass higher than greasy glass.
fn under_climb_m(column: i32) -> f32 {
  let at = (f32(column) * under_row_m()) * UNDER_GLASS_TILES_PER_M;
  let wide = under_glass_noise(at.x, 0.37);
  let fine = under_glass_noise(at.y, 0.81);
  let share = UNDER_GLASS.x + UNDER_GLASS.y * wide + UNDER_GLASS.z * fine;
  return (CEILING_NEARER * CEILING_CLIMB_M) * clamp(share, UNDER_GLASS_LEAST, 1.0);
}

// Height of a pixel in the air above the waterline on the lens, m; a large number where the line is not close below.
fn under_height_above_line_m(pixel: vec2i, ray: vec3f) -> f32 {
  let rows = i32(textureDimensions(depth_map).y);
  let row = frame.up * (2.0 / f32(rows));
  let row_m = under_row_m();
  // The last row known to show air, and the first one known to show water, counted down from the pixel.
  var air = 0;
  var water = min(i32(ceil(CEILING_NEARER * CEILING_CLIMB_M / row_m)) + 1, rows - 2 - pixel.y);
  if water <= 0 || !under_begins(pixel + vec2i(0, water), ray - row * f32(water)) {
    return 1.0;
  }
  for (var i = 0; i < UNDER_LINE_STEPS && water > air + 1; i++) {
    let middle = (air + water) / 2;
    if under_begins(pixel + vec2i(0, middle), ray - row * f32(middle)) {
      water = middle;
    } else {
      air = middle;
    }
  }
  // The surface leaves the lens at depth 1. Where between two rows it does so follows from the change of depth on the
  // side on which the surface is seen.
  let over = textureLoad(depth_map, pixel + vec2i(0, air), 0);
  let under = textureLoad(depth_map, pixel + vec2i(0, water), 0);
  let is_seen_from_below = under > over;
  let near = max(under, over);
  let next_y = max(pixel.y + select(air - 1, water + 1, is_seen_from_below), 0);
  let next = textureLoad(depth_map, vec2i(pixel.x, next_y), 0);
  let rest = saturate((1.0 - near) / max(near - next, 1e-5));
  return select(f32(air) + rest, f32(water) - rest, is_seen_from_below) * row_m;
}

// Radiance of the water's surface at `place`, relative to the eye, seen along `dir` from below.
fn under_surface(dir: vec3f, place: vec3f, at: vec2f, foot: WaterFootprint, slope: WaterSlope) -> vec3f {
  var rough = slope;
  rough.variance += vec3f(vec2f(material.roughness_variance), 0.0);
  if SKY_CLOUD_SHADOWS {
    cloud_sun_fraction = cloud_sun_transmittance(place.xz, foot.log_whole_texel_m);
  }
  let down = reflect(dir, water_normal(slope.mean));
  let back = vec3f(down.x, min(down.y, -0.03), down.z);
  var below = medium_deep_radiance(back);
  if WATER_BED {
    let hit = floor_hit(back, 0.0);
    let seen = medium_downwelling(hit.column_m) * (0.5 / ATM_PI) * material.bed_colour;
    below = medium_radiance(back, 0.0, hit.length_m, 1.0) + seen * medium_transmittance(hit.length_m);
  }
  var radiance = ceiling_radiance(dir, rough, below);
  if WATER_FOAM {
    let foam = foam_level(at, foot);
    if foam.cover >= FOAM_MIN_AMOUNT {
      let look = foam_appearance(at, foot, foam);
      radiance = mix(radiance, ceiling_foam_radiance(below, look.grain), look.cover);
    }
  }
  return radiance;
}

@fragment
fn under_fragment(in: LightFragment) -> @location(0) vec4f {
  let pixel = vec2i(in.clip.xy);
  let is_water = textureLoad(depth_map, pixel, 0) > 0.0;
  let at = textureLoad(undisplaced_map, pixel, 0).xy;
  let side_m = mesh_side_and_sun(textureLoad(shear_and_side_map, pixel, 0).y).x;
  let dx = frame.footprint_scale * water_pixel_side(dpdxFine(at), side_m);
  let dy = frame.footprint_scale * water_pixel_side(dpdyFine(at), side_m);
  var begins = true;
  if UNDER_SEES_AIR {
    begins = under_begins(pixel, in.ray) || under_is_fold(pixel, in.ray);
  }
  let dir_ahead = normalize(in.ray);
  var lens = CeilingMeniscus(dir_ahead, 1.0, vec3f(0.0));
  var is_climbing = false;
  // How strongly the climbing water squeezes what lies behind it, 0 to 1.
  var squeeze = 0.0;
  if UNDER_SEES_AIR && !begins && abs(under_estimate_m(in.ray)) < UNDER_SURE_M {
    let height_m = under_height_above_line_m(pixel, in.ray);
    let climb_m = under_climb_m(pixel.x);
    is_climbing = height_m < climb_m;
    if is_climbing {
      lens = ceiling_meniscus(dir_ahead, height_m / climb_m);
      squeeze = maths_smooth(8.0 * distance(lens.dir, dir_ahead));
    }
  }
  // Land near the surface was drawn as such; the bed is found below.
  let is_land = WATER_LAND && is_water && !is_climbing && at.x > LAND_NO_WATER_M;
  let shows_ceiling = begins && is_water && !is_land;
  let foot = water_footprint(dx, dy);
  if UNDER_SEES_AIR && !begins && !is_climbing {
    discard;
  }
  let dir = lens.dir;
  let depth_m = shafts_eye_depth_m();
  var length_m = 1e4;
  var radiance = vec3f(0.0);
  if shows_ceiling {
    let place = lit_position(in.ray, pixel);
    let point = WaterPoint(place, at, water_height_m(place));
    let gust = water_gust_gain(at, foot.length_m);
    let breaker = breaker_motion(at, point.height, vec2f(0.0), surf_motion(at));
    var slope = water_slope_with_carried(at, water_moved(point), foot, foot, breaker.derivatives, false, gust);
    // At the edge of a fold the surface between vertices may be turned away from the eye.
    let away = dot(slope.mean, dir.xz) - dir.y + 0.02;
    slope.mean -= dir.xz * (max(away, 0.0) / max(dot(dir.xz, dir.xz), 1e-6));
    length_m = length(place);
    radiance = under_surface(dir, place, at, foot, slope);
  } else if is_land {
    let spot = lit_position(in.ray, pixel);
    length_m = length(spot);
    let column_m = max(depth_m - spot.y, 0.0);
    radiance = floor_radiance(FloorHit(length_m, spot.xz, column_m, vec2f(0.0)), dir);
  } else if dir.y > 1e-3 {
    length_m = depth_m / dir.y;
  } else if WATER_BED {
    var hit = floor_hit(dir, depth_m);
    length_m = hit.length_m;
    hit.length_m *= 1.0 + UNDER_SQUEEZE * squeeze;
    radiance = floor_radiance(hit, dir);
  }
  if SKY_CLOUD_SHADOWS {
    // Sunlight in the water comes from the surface around the eye.
    cloud_sun_fraction = cloud_sun_transmittance(vec2f(0.0), UNDER_LOG_LIT_M);
  }
  let gain = mix(shafts_gain(shafts_map, dir, depth_m, length_m), 1.0, squeeze);
  radiance = radiance * medium_transmittance(length_m) + medium_radiance(dir, depth_m, length_m, gain);
  radiance = lens.share * radiance + lens.sky;
  return frame_hdr_output(radiance, 1.0 / length_m);
}
