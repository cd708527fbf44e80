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
// Capillary length of water, m. Water climbs glass that it wets by its square root of two, and there stands upright.
const UNDER_CAPILLARY_M = 0.0027;
const UNDER_CLIMB_M = 0.0038;
// Steps by halves in which the waterline below a pixel is found.
const UNDER_LINE_STEPS = 5;
// How much more of the bed a pixel shows through the climbing water.
const UNDER_SQUEEZE = 150.0;
// Share of the light that is left where the climbing water mirrors the dark rim of the lens.
const UNDER_RIM_LIGHT = 0.35;
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

// Height of a pixel in the air above the waterline on the lens, m; a large number where the line is not close below.
fn under_height_above_line_m(pixel: vec2i, ray: vec3f) -> f32 {
  let rows = f32(textureDimensions(depth_map).y);
  let row = frame.up * (2.0 / rows);
  let row_m = frame.clip_from_relative[3].z * length(row);
  // The last row known to show air, and the first one known to show water, counted down from the pixel.
  var air = 0;
  var water = i32(ceil(UNDER_CLIMB_M / row_m)) + 1;
  if !under_begins(pixel + vec2i(0, water), ray - row * f32(water)) {
    return 1.0;
  }
  for (var i = 0; i < UNDER_LINE_STEPS; i++) {
    let middle = (air + water) / 2;
    if under_begins(pixel + vec2i(0, middle), ray - row * f32(middle)) {
      water = middle;
    } else {
      air = middle;
    }
  }
  // The surface leaves the lens at depth 1, which between two rows follows from the change of depth above them.
  let last = textureLoad(depth_map, pixel + vec2i(0, air), 0);
  let before = textureLoad(depth_map, pixel + vec2i(0, air - 1), 0);
  let rest = saturate((1.0 - last) / max(last - before, 1e-5));
  return (f32(air) + rest) * row_m;
}

// How the water that climbs the lens bends a ray: a cylinder of water whose surface is level at its foot and upright at
// its upper edge.
struct UnderMeniscus {
  // Direction in the water whose light the pixel shows, and the share of it.
  dir: vec3f,
  share: f32,
  // What the pixel shows besides: light of the sky.
  sky: vec3f,
}

// Radiance of the sky in a direction, blurred as by a lens that is focused on what is far away.
fn under_blurred_sky(dir: vec3f) -> vec3f {
  let uv = 0.5 + MIRRORED_SCALE * dir.xz / (1.0 + max(dir.y, -0.9));
  return textureSampleLevel(mirrored_sky_map, sky_sampler, vec3f(saturate(uv), mirrored_sky_layer(0.05)), 0.0).rgb;
}

// The bending at a height above the waterline, m. The height of a surface that hangs on a wall and its slope angle t
// obey height^2 = 2 capillary length^2 (1 - cos t).
fn under_meniscus(dir: vec3f, height_m: f32) -> UnderMeniscus {
  let relative = height_m / UNDER_CAPILLARY_M;
  let level = max(1.0 - 0.5 * relative * relative, 0.0);
  let ahead = dir.xz * inverseSqrt(max(dot(dir.xz, dir.xz), 1e-6));
  let upright = sqrt(1.0 - level * level);
  let n = vec3f(ahead.x * upright, level, ahead.y * upright);
  let cosine = dot(dir, n);
  if cosine <= 0.0 {
    return UnderMeniscus(dir, 1.0, vec3f(0.0));
  }
  let facet = ceiling_facet(dir, n);
  let mirrored = reflect(dir, n);
  var out = UnderMeniscus(mirrored, 1.0, vec3f(0.0));
  out.share = mix(1.0, UNDER_RIM_LIGHT, maths_smooth(-1.2 * mirrored.y));
  if facet.is_window {
    // The bent ray meets the level water before the lens, which mirrors the sky and lets the rest through.
    let down = vec3f(facet.above.x, -abs(facet.above.y), facet.above.z);
    let reflectance = water_fresnel(-down.y);
    let through = 1.0 - facet.reflectance;
    out.sky = through * reflectance * under_blurred_sky(vec3f(down.x, -down.y, down.z));
    let spread = material.inverse_relative_index * material.inverse_relative_index;
    out.share = mix(through * (1.0 - reflectance) * spread, out.share, facet.reflectance);
    // The edge on the glass is round and turns the rays of a narrow line up into the sky.
    let edge = relative * (UNDER_CAPILLARY_M / UNDER_CLIMB_M);
    let bright = maths_smooth(1.0 - abs(edge - 0.93) / 0.07);
    let lifted = normalize(vec3f(dir.x, dir.y + 0.4, dir.z));
    out.sky += 0.7 * bright * under_blurred_sky(lifted);
    out.dir = select(water_refract(down, vec3f(0.0, 1.0, 0.0)), mirrored, facet.reflectance > 0.5);
  }
  return out;
}

// Radiance of the water's surface at `place`, relative to the eye, seen along `dir` from below.
fn under_surface(dir: vec3f, place: vec3f, at: vec2f, foot: WaterFootprint, slope: WaterSlope) -> vec3f {
  var rough = slope;
  rough.variance += vec3f(vec2f(material.roughness_variance), 0.0);
  if SKY_CLOUD_SHADOWS {
    cloud_sun_fraction = cloud_sun_transmittance(place.xz, foot.log_texel_m);
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
  let side_m = abs(textureLoad(shear_and_side_map, pixel, 0).y);
  let x = water_pixel_side(dpdxFine(at), side_m);
  let y = water_pixel_side(dpdyFine(at), side_m);
  let dx = frame.footprint_scale * x.side;
  let dy = frame.footprint_scale * y.side;
  var begins = true;
  if UNDER_SEES_AIR {
    begins = under_begins(pixel, in.ray);
  }
  let dir_ahead = normalize(in.ray);
  var lens = UnderMeniscus(dir_ahead, 1.0, vec3f(0.0));
  var is_climbing = false;
  if UNDER_SEES_AIR && !begins && abs(under_estimate_m(in.ray)) < UNDER_SURE_M {
    let height_m = under_height_above_line_m(pixel, in.ray);
    is_climbing = height_m < UNDER_CLIMB_M;
    if is_climbing {
      lens = under_meniscus(dir_ahead, height_m);
    }
  }
  // Land near the surface was drawn as such; the bed is found below.
  let is_land = WATER_LAND && is_water && !is_climbing && at.x > LAND_NO_WATER_M;
  let shows_ceiling = begins && is_water && !is_land;
  let foot = water_footprint(dx, dy);
  var place = vec3f(0.0);
  var slope: WaterSlope;
  if shows_ceiling {
    place = lit_position(in.ray, pixel);
    let point = WaterPoint(place, at, water_height_m(place));
    let gust = water_gust_gain(at, foot.length_m);
    let breaker = breaker_motion(at, point.height, vec2f(0.0));
    slope = water_slope_with_carried(at, water_moved(point), foot, foot, breaker.derivatives, false, gust);
  }
  let bend_x = select(vec2f(0.0), dpdxFine(slope.mean), x.is_smooth && shows_ceiling);
  let bend_y = select(vec2f(0.0), dpdyFine(slope.mean), y.is_smooth && shows_ceiling);
  if UNDER_SEES_AIR && !begins && !is_climbing {
    discard;
  }
  let dir = lens.dir;
  let depth_m = shafts_eye_depth_m();
  var length_m = 1e4;
  var radiance = vec3f(0.0);
  if shows_ceiling {
    let bent = water_add_slope_change(slope, bend_x, bend_y, dot(dx, dx) > dot(dy, dy));
    length_m = length(place);
    radiance = under_surface(dir, place, at, foot, bent);
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
    // The climbing water squeezes much of the bed into a pixel.
    hit.length_m *= select(1.0, UNDER_SQUEEZE, is_climbing);
    radiance = floor_radiance(hit, dir);
  }
  if SKY_CLOUD_SHADOWS {
    // Sunlight in the water comes from the surface around the eye.
    cloud_sun_fraction = cloud_sun_transmittance(vec2f(0.0), UNDER_LOG_LIT_M);
  }
  let gain = select(shafts_gain(shafts_map, dir, depth_m, length_m), 1.0, is_climbing);
  radiance = radiance * medium_transmittance(length_m) + medium_radiance(dir, depth_m, length_m, gain);
  radiance = lens.share * radiance + lens.sky;
  return frame_hdr_output(radiance, 1.0 / length_m);
}
