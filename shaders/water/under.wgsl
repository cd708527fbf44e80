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
// Capillary length of sea water, m. Water climbs the lens by twice its root above the surface, in the profile of a wall
// that water wets (Landau and Lifshitz, Fluid Mechanics, section 61).
const UNDER_CAPILLARY_M = 0.0027;
const UNDER_CLIMB_M = 1.41421 * UNDER_CAPILLARY_M;
// Half the width of a rim below which a near crest shows its lower side, divided by the picture's height.
const UNDER_RIM = 0.003;
// Share of the climb over which its upper edge is dark, and how dark it is; the same for the waterline, on both sides.
const UNDER_EDGE = vec2f(0.35, 0.6);
const UNDER_LINE = vec2f(0.45, 0.55);
// Share of its light that is left in the water on the lens, which the housing of the camera shades.
const UNDER_SHADE = 0.6;
const UNDER_EDGE_DISTANCE_M = 50.0;
// The curved water magnifies and blurs: size of a pixel on the bed that it shows, relative to one without it.
const UNDER_BLUR = 24.0;
// Whether a part of the lens may stand in the air: if not, there is no waterline to look for.
override UNDER_SEES_AIR: bool = true;
// Binary logarithm of the size of the surface, m, through which the water in the picture is lit.
const UNDER_LOG_LIT_M = 5.0;
// The search for the waterline in a column of pixels: its reach up and down, in climbs, and the number of halvings.
// Number of columns, and the distance of two, in pixels: their mean smooths the steps of a line that is found pixel by
// pixel.
const UNDER_REACH = 1.3;
const UNDER_HALVINGS = 6;
const UNDER_COLUMNS = 5;
const UNDER_COLUMN_STEP = 3;

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

// Whether a pixel begins under water that lies `rows` below one with the ray `ray` and `columns` to its right.
fn under_begins_beside(pixel: vec2i, ray: vec3f, columns: i32, rows: i32) -> bool {
  let size = vec2i(textureDimensions(depth_map));
  let at = clamp(pixel + vec2i(columns, rows), vec2i(0), size - 1);
  let step = 2.0 * vec2f(at - pixel) / vec2f(size);
  return under_begins(at, ray + frame.right * step.x - frame.up * step.y);
}

// How far a pixel lies above the waterline on the lens, in climbs of the meniscus; 2 and -2 stand for far above and
// below.
fn under_rise(pixel: vec2i, ray: vec3f, begins: bool) -> f32 {
  let far = select(2.0, -2.0, begins);
  if abs(under_estimate_m(ray)) > UNDER_SURE_M {
    return far;
  }
  let rows_per_m = 0.5 * f32(textureDimensions(depth_map).y) / (frame.clip_from_relative[3].z * length(frame.up));
  let climb = max(UNDER_CLIMB_M * rows_per_m, 1.0);
  let reach = select(1.0, -1.0, begins) * UNDER_REACH * climb;
  if under_begins_beside(pixel, ray, 0, i32(round(reach))) == begins {
    return far;
  }
  var sum = 0.0;
  for (var c = 0; c < UNDER_COLUMNS; c++) {
    // The waterline lies between these rows, counted down from the pixel.
    var rows = vec2f(-UNDER_REACH, UNDER_REACH) * climb;
    for (var i = 0; i < UNDER_HALVINGS; i++) {
      let middle = 0.5 * (rows.x + rows.y);
      let is_water = under_begins_beside(pixel, ray, (c - UNDER_COLUMNS / 2) * UNDER_COLUMN_STEP, i32(round(middle)));
      rows = select(vec2f(middle, rows.y), vec2f(rows.x, middle), is_water);
    }
    sum += 0.5 * (rows.x + rows.y);
  }
  return sum / (f32(UNDER_COLUMNS) * climb);
}

// What the meniscus makes of a ray.
struct UnderMeniscus {
  // Direction in which it goes on, and the fractions of its light that come from the sky, seen or mirrored, and from below.
  dir: vec3f,
  sky: f32,
  water: f32,
}

// A ray that goes through the meniscus at the height `rise`, in climbs. There the surface is inclined by the angle a: the
// height is 2 sin(a / 2) capillary lengths. The lower half of the meniscus reflects all light, the upper is a prism.
fn under_bent(dir: vec3f, rise: f32) -> UnderMeniscus {
  let half_sine = rise * (0.5 * UNDER_CLIMB_M / UNDER_CAPILLARY_M);
  let incline = 2.0 * asin(clamp(half_sine, 0.0, 0.70711));
  // Sine of the angle between the ray and the normal, for a level ray.
  let outside = material.relative_index * cos(incline);
  var out = UnderMeniscus(dir, 0.0, 1.0);
  var turn = 2.0 * incline;
  if outside < 1.0 {
    turn = asin(outside) - (0.5 * ATM_PI - incline);
  }
  let elevation = asin(clamp(dir.y, -1.0, 1.0)) - turn;
  let ahead = dir.xz * inverseSqrt(max(dot(dir.xz, dir.xz), 1e-6));
  out.dir = vec3f(ahead * cos(elevation), sin(elevation)).xzy;
  if outside < 1.0 {
    // The ray meets the water close to the lens.
    out.sky = select(water_fresnel(-out.dir.y), 1.0, elevation >= 0.0);
    out.water = (1.0 - out.sky) * material.inverse_relative_index * material.inverse_relative_index;
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
  let shows_ceiling = begins && is_water;
  let foot = water_footprint(dx, dy);
  var place = vec3f(0.0);
  var slope: WaterSlope;
  if shows_ceiling {
    place = water_position(in.ray, pixel);
    let point = WaterPoint(place, at, water_height_m(place));
    let gust = water_gust_gain(at, foot.length_m);
    let breaker = breaker_motion(at, point.height, vec2f(0.0));
    slope = water_slope_with_carried(at, water_moved(point), foot, foot, breaker.derivatives, false, gust);
  }
  let bend_x = select(vec2f(0.0), dpdxFine(slope.mean), x.is_smooth && shows_ceiling);
  let bend_y = select(vec2f(0.0), dpdyFine(slope.mean), y.is_smooth && shows_ceiling);
  var bent = UnderMeniscus(normalize(in.ray), 0.0, 1.0);
  var rise = -2.0;
  if UNDER_SEES_AIR {
    rise = under_rise(pixel, in.ray, begins);
    if !begins {
      if rise >= 1.0 {
        discard;
      }
      bent = under_bent(bent.dir, max(rise, 0.0));
    }
  }
  let dir = bent.dir;
  let depth_m = shafts_eye_depth_m();
  var length_m = 1e4;
  var radiance = vec3f(0.0);
  if shows_ceiling {
    let bent_slope = water_add_slope_change(slope, bend_x, bend_y, dot(dx, dx) > dot(dy, dy));
    length_m = length(place);
    radiance = under_surface(dir, place, at, foot, bent_slope);
  } else if dir.y > 1e-3 {
    length_m = depth_m / dir.y;
  } else if WATER_BED {
    let hit = floor_hit(dir, depth_m);
    length_m = hit.length_m;
    radiance = floor_radiance(hit, dir, select(UNDER_BLUR, 1.0, begins));
  }
  if SKY_CLOUD_SHADOWS {
    // Sunlight in the water comes from the surface around the eye.
    cloud_sun_fraction = cloud_sun_transmittance(vec2f(0.0), UNDER_LOG_LIT_M);
  }
  let gain = shafts_gain(shafts_map, dir, depth_m, length_m);
  radiance = radiance * medium_transmittance(length_m) + medium_radiance(dir, depth_m, length_m, gain);
  if UNDER_SEES_AIR && !begins {
    let lifted = vec3f(dir.x, abs(dir.y), dir.z);
    let uv = 0.5 + MIRRORED_SCALE * lifted.xz / (1.0 + lifted.y);
    let sky_there = textureSampleLevel(mirrored_sky_map, sky_sampler, vec3f(saturate(uv), 0.0), 0.0).rgb;
    radiance = (radiance * bent.water + sky_there * bent.sky) * mix(1.0, UNDER_SHADE, smoothstep(0.0, 0.4, rise));
    // The edge of the water on the lens is in shade. Its distance is unlike that of all around it, so that the film
    // smooths it.
    radiance *= 1.0 - UNDER_EDGE.y * smoothstep(1.0 - UNDER_EDGE.x, 1.0, rise);
    length_m = UNDER_EDGE_DISTANCE_M;
  }
  radiance *= 1.0 - UNDER_LINE.y * smoothstep(UNDER_LINE.x, 0.0, abs(rise));
  return frame_hdr_output(radiance, 1.0 / length_m);
}
