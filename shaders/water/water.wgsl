// The light of the water.

@group(0) @binding(9) var<uniform> material: Material;

// Parts of the picture's water; twin of `Parts` in src/render/water/light.rs.
override WATER_BED: bool = false;
override WATER_CAUSTICS: bool = false;
override WATER_FOAM: bool = true;
// Samples of a reference, which are not filtered.
override WATER_SAMPLES: bool = false;

// Weight of a sample of a reference. Its slope lies at a place of the mesh, but the eye sees it by the area that it turns to
// the eye. `mesh` is the slope with the waves that the mesh cannot show as roughness, over which the mean weight is 1.
fn water_weight(v: vec3f, slope: WaterSlope, mesh: WaterSlope) -> f32 {
  let shown = water_facets_seen(water_facets(v, mesh)).x * max(mesh.jacobian, 0.1);
  let own = water_facets_seen(water_facets(v, slope)).x * max(slope.jacobian, 0.0);
  return clamp(own / max(shown, 1e-6), 1e-5, 1e3);
}

// A point of the surface that a pixel shows.
struct WaterPoint {
  // Relative to the eye.
  place: vec3f,
  // The undisplaced point beside the eye's foot.
  rest: vec2f,
  // Height of the wave, m.
  height: f32,
  // Sides of the pixel on the undisplaced sea.
  dx: vec2f,
  dy: vec2f,
}

// A slope with its change over the sides of the pixel, of which that along x is the longer if `along_x`: slopes that change
// within a pixel glitter as one rough surface (Tokuyoshi and Kaplanyan 2019).
fn water_bent(slope: WaterSlope, bend_x: vec2f, bend_y: vec2f, along_x: bool) -> WaterSlope {
  let bend = (1.0 / 12.0) * (vec3f(bend_x * bend_x, bend_x.x * bend_x.y) + vec3f(bend_y * bend_y, bend_y.x * bend_y.y));
  let most_bend = frame.footprint * min(1.0, 0.08 / max(max(bend.x, bend.y), 1e-6));
  var out = slope;
  out.variance = water_covariance(slope.variance + bend * most_bend);
  out.lean += 0.25 * sqrt(most_bend) * select(bend_y, bend_x, along_x);
  return out;
}

// The light that the eye sees of a point whose slope within the pixel is `seen`.
fn water_light(point: WaterPoint, foot: WaterFootprint, seen: WaterSlope) -> vec4f {
  var slope = seen;
  let distance_m = length(point.place);
  let dir = point.place / distance_m;
  // Frame of the vertical there.
  let up = normalize(vec3f(point.place.x / FRAME_EARTH_M, 1.0, point.place.z / FRAME_EARTH_M));
  let v = normalize(vec3f(-dir.x, max(dot(-dir, up), 1e-4), -dir.z));
  let n = water_normal(slope.mean);

  slope.variance += vec3f(vec2f(material.rough_variance), 0.0);
  // Waves that the mesh shows hide and shade each other where they are drawn; finer ones do so by their statistics. The mesh
  // shows no ripples, however fine it is.
  var around = slope;
  if WATER_SAMPLES {
    let shown = WaterFootprint(vec2f(0.0), mesh_spacing(length(point.rest)), 1);
    around = water_slope_beyond(point.rest, shown, WaterFootprint(vec2f(0.0), 1e6, 1), WaterSums(), false);
    around.variance += vec3f(vec2f(material.rough_variance), 0.0);
  }

  let pixel = foam_pixel(point.dx, point.dy);
  var foam = vec2f(0.0);
  if WATER_FOAM {
    foam = foam_level(point.rest, pixel);
  }
  let mirror = water_mirror_among(v, slope, around);
  // A facet that leans away from the eye is not what the eye sees.
  let ray = water_refract(-v, n);
  var below = water_deep(n, ray, foam.x);
  if WATER_BED {
    let blur = 0.25 * sqrt(slope.variance.x + slope.variance.y);
    below = water_bed(below, point.place.xz, point.height, ray, foot.size, blur);
  }
  if material.height_scatter > 0.0 {
    below += water_crest(n, ray, point.height / max(frame.hs_m, 0.05), slope.jacobian, foam.x);
  }
  // Radiance thins as its rays spread: over the square of the relative index.
  let index = material.index_water / material.index_air;
  var surface = mirror.radiance + (1.0 - mirror.reflectance) / (index * index) * below;
  if WATER_FOAM && foam.x >= FOAM_LEAST {
    let look = foam_seen(point.rest, pixel, foam);
    surface = mix(surface, foam_light(v, slope, look), look.cover);
  }

  let air = air_between(dir, distance_m);
  let colour = surface * air[1] + air[0];
  if WATER_SAMPLES {
    return vec4f(colour, water_weight(v, slope, around));
  }
  return frame_colour(colour, 1.0 / distance_m);
}
