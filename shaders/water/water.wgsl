// The light of the sea.

@group(0) @binding(9) var<uniform> material: Material;

// What the picture's water consists of; twin of Parts in render/water.rs.
override WATER_BED: bool = false;
override WATER_CAUSTICS: bool = false;
override WATER_FOAM: bool = true;
// Samples of a reference.
override WATER_SAMPLES: bool = false;

// Weight of a sample of a reference: its slope came from a place of the mesh, but it is seen by the area that it turns to
// the eye. The mean over what the mesh cannot show is 1.
fn water_weight(v: vec3f, slope: WaterSlope, mesh: WaterSlope) -> f32 {
  let shown = water_facets_seen(water_facets(v, mesh)).x * max(mesh.jacobian, 0.1);
  let own = water_facets_seen(water_facets(v, slope)).x * max(slope.jacobian, 0.0);
  return clamp(own / max(shown, 1e-6), 1e-5, 1e3);
}

// A point of the surface that a pixel shows.
struct WaterPoint {
  // Relative to the eye.
  place: vec3f,
  // The undisplaced point, and the height of the wave.
  rest: vec3f,
  // Sides of the pixel on the undisplaced sea.
  dx: vec2f,
  dy: vec2f,
}

// Slopes that change within the pixel glitter as one (Tokuyoshi and Kaplanyan 2019), spread evenly over it: the slope with
// its change over the pixel's sides, of which that along x is the longer if `along_x`.
fn water_bent(slope: WaterSlope, bend_x: vec2f, bend_y: vec2f, along_x: bool) -> WaterSlope {
  let bend = (1.0 / 12.0) * (vec3f(bend_x * bend_x, bend_x.x * bend_x.y) + vec3f(bend_y * bend_y, bend_y.x * bend_y.y));
  let most_bend = frame.footprint * min(1.0, 0.08 / max(max(bend.x, bend.y), 1e-6));
  var out = slope;
  out.variance = water_covariance(slope.variance + bend * most_bend);
  out.lean += 0.25 * sqrt(most_bend) * select(bend_y, bend_x, along_x);
  return out;
}

// What the eye sees of a point whose slope within the pixel is `seen`.
fn water_light(point: WaterPoint, foot: WaterFootprint, seen: WaterSlope) -> vec4f {
  let at = point.rest.xz;
  var slope = seen;
  let distance_m = length(point.place);
  let dir = point.place / distance_m;
  // Frame of the vertical there.
  let up = normalize(vec3f(point.place.x / FRAME_EARTH_M, 1.0, point.place.z / FRAME_EARTH_M));
  let v = normalize(vec3f(-dir.x, max(dot(-dir, up), 1e-4), -dir.z));
  let n = water_normal(slope.mean);

  slope.variance += vec3f(vec2f(material.rough_variance), 0.0);
  // The waves that the mesh shows hide and shade by themselves, where they are seen; those between, by their statistics. The
  // mesh shows no ripples, however fine it is.
  var around = slope;
  if WATER_SAMPLES {
    let shown = WaterFootprint(vec2f(0.0), mesh_spacing(length(at)), 1);
    around = water_slope_beyond(at, shown, WaterFootprint(vec2f(0.0), 1e6, 1), WaterSums(), false);
    around.variance += vec3f(vec2f(material.rough_variance), 0.0);
  }

  var foam: WaterFoam;
  if WATER_FOAM {
    foam = water_foam(at, point.dx, point.dy);
  }
  let mirror = water_mirror_among(v, slope, around);
  // A facet that leans away from the eye is not what the eye sees.
  let ray = water_refract(-v, n);
  let rise = point.rest.y / max(frame.hs_m, 0.05);
  var below = water_deep(n, ray, foam.plume);
  if WATER_BED {
    let blur = 0.25 * sqrt(slope.variance.x + slope.variance.y);
    below = water_bed(below, point.place.xz, point.rest.y, ray, foot.size, blur);
  }
  if material.height_scatter > 0.0 {
    below += water_crest(n, ray, rise, slope.jacobian, foam.plume);
  }
  // Radiance thins as its rays spread: over the square of the relative index.
  let index = material.index_water / material.index_air;
  let water = mirror.radiance + (1.0 - mirror.reflectance) / (index * index) * below;
  var surface = water;
  for (var is_foamy = WATER_FOAM && foam.cover > 0.0; is_foamy; is_foamy = false) {
    surface = mix(water, water_foam_light(v, slope, foam), foam.cover);
  }

  let air = air_between(dir, distance_m);
  let colour = surface * air[1] + air[0];
  if WATER_SAMPLES {
    return vec4f(colour, water_weight(v, slope, around));
  }
  return frame_colour(colour, 1.0 / distance_m);
}
