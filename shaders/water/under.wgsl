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
// Half the width of the dark line of the meniscus, divided by the picture's height.
const UNDER_MENISCUS = 0.006;
// Whether a part of the lens may stand in the air: if not, there is no waterline to look for.
override UNDER_SEES_AIR: bool = true;
// Binary logarithm of the size of the surface, m, through which the water in the picture is lit.
const UNDER_LOG_LIT_M = 5.0;
// Number of pixels around one that tell how far it is from the line.
const UNDER_TAPS = 8;

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
  let down = i32(ceil(0.5 * UNDER_MENISCUS * f32(size.y)));
  let below = vec2i(pixel.x, min(pixel.y + down, size.y - 1));
  return under_begins_alone(below, ray - frame.up * (2.0 * f32(below.y - pixel.y) / f32(size.y)));
}

// Share of the pixels above one, up to the width of the meniscus, whose rays begin in the air, 0 to 1.
fn under_air_above(pixel: vec2i, ray: vec3f) -> f32 {
  let rows = f32(textureDimensions(depth_map).y);
  var air = 0.0;
  for (var i = 0; i < UNDER_TAPS; i++) {
    let up = round(UNDER_MENISCUS * rows * (f32(i) + 1.0) / f32(UNDER_TAPS));
    let at = vec2i(pixel.x, max(pixel.y - i32(up), 0));
    air += select(1.0, 0.0, under_begins(at, ray + frame.up * (2.0 * f32(pixel.y - at.y) / rows)));
  }
  return air / f32(UNDER_TAPS);
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
  let side_m = mesh_side_and_sun(textureLoad(shear_and_side_map, pixel, 0).y).x;
  let x = water_pixel_side(dpdxFine(at), side_m);
  let y = water_pixel_side(dpdyFine(at), side_m);
  let dx = frame.footprint_scale * x.side;
  let dy = frame.footprint_scale * y.side;
  var begins = true;
  if UNDER_SEES_AIR {
    begins = under_begins(pixel, in.ray);
  }
  // Land near the surface was drawn as such; the bed is found below.
  let is_land = WATER_LAND && is_water && at.x > LAND_NO_WATER_M;
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
  if UNDER_SEES_AIR && !begins {
    discard;
  }
  let dir = normalize(in.ray);
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
    let hit = floor_hit(dir, depth_m);
    length_m = hit.length_m;
    radiance = floor_radiance(hit, dir);
  }
  if SKY_CLOUD_SHADOWS {
    // Sunlight in the water comes from the surface around the eye.
    cloud_sun_fraction = cloud_sun_transmittance(vec2f(0.0), UNDER_LOG_LIT_M);
  }
  let gain = shafts_gain(shafts_map, dir, depth_m, length_m);
  radiance = radiance * medium_transmittance(length_m) + medium_radiance(dir, depth_m, length_m, gain);
  // The water that clings to the lens bends the rays at its rim down into the dark.
  if UNDER_SEES_AIR && abs(under_estimate_m(in.ray)) < UNDER_SURE_M {
    radiance *= 1.0 - 0.6 * maths_smooth(1.4 * under_air_above(pixel, in.ray));
  }
  return frame_hdr_output(radiance, 1.0 / length_m);
}
