// The light of the water: reflection, light from below, foam, and the air in front of it.

@group(0) @binding(9) var<uniform> material: Material;

// Parts of the water that the pipeline contains; set from `WaterLightVariant` in src/render/water/light.rs.
override WATER_BED: bool = false;
override WATER_CAUSTICS: bool = false;
override WATER_FOAM: bool = true;
// Whether the picture holds unfiltered samples of a reference.
override WATER_POINT_SAMPLES: bool = false;

// Weight of a sample of a reference in its pixel's mean. Samples lie evenly on the mesh, but the eye sees each by its
// projected area. `mesh` has the waves that the mesh cannot show as roughness; over them, the mean weight is 1.
fn water_sample_weight(v: vec3f, slope: WaterSlope, mesh: WaterSlope) -> f32 {
  let shown = water_tilt_projected_area(water_tilt_towards(v, mesh)).x * max(mesh.jacobian, 0.1);
  let own = water_tilt_projected_area(water_tilt_towards(v, slope)).x * max(slope.jacobian, 0.0);
  return clamp(own / max(shown, 1e-6), 1e-5, 1e3);
}

// The point of the water surface that a pixel shows.
struct WaterPoint {
  // Position relative to the eye, m.
  position: vec3f,
  // Undisplaced position (x, z) relative to the point below the eye, m.
  undisplaced: vec2f,
  // Height of the wave, m.
  height: f32,
}

// Height of the wave at a position relative to the eye, m, on the spherical Earth.
fn water_height_m(place: vec3f) -> f32 {
  return place.y + frame.eye_height_m + dot(place.xz, place.xz) / (2.0 * FRAME_EARTH_RADIUS_M);
}

// Distance, m, by which the waves have moved the water at a point.
fn water_moved(point: WaterPoint) -> vec3f {
  let sideways = point.position.xz - point.undisplaced;
  return vec3f(sideways.x, point.height, sideways.y);
}

// Slope statistics whose mean is that of what the eye sees: the half of a footprint that shows it more of its area counts
// more. The share by which both areas differ is an approximation for Gaussian slopes that is right at grazing angles,
// with the mean of the variances along and across the view.
fn water_seen(v: vec3f, slope: WaterSlope) -> WaterSlope {
  let facing = v.y - dot(slope.mean, v.xz);
  let half = dot(slope.half_slope_difference, v.xz);
  let square = (1.0 / ATM_PI) * (slope.variance.x + slope.variance.y);
  var out = slope;
  out.moved_by_halves = half * inverseSqrt(facing * facing + half * half + square);
  out.mean -= out.moved_by_halves * slope.half_slope_difference;
  return out;
}

// Radiance towards the eye of a point of the water with the slope statistics `seen`, for which `gust` is
// water_gust_gain, in the given pixel of the picture; alpha as in frame_hdr_output.
fn water_radiance(point: WaterPoint, foot: WaterFootprint, seen: WaterSlope, gust: f32, pixel: vec2u) -> vec4f {
  var slope = seen;
  let nearness = inverseSqrt(dot(point.position, point.position));
  let dir = point.position * nearness;
  // Sine of the elevation of the eye as seen from the point, over the local horizon of the spherical Earth.
  let eye_sine = -dir.y - (1.0 / FRAME_EARTH_RADIUS_M) * dot(point.position.xz, dir.xz);
  // The vertical turns by so little over the Earth's curve that `v` stays a unit vector.
  let v = vec3f(-dir.x, max(eye_sine, 1e-4), -dir.z);
  if WATER_RAIN {
    slope = ring_add(slope, point.undisplaced, foot.length_m);
  }
  var wake: Wake;
  if WATER_HULLS {
    wake = wake_at(point.position.xz, vec2f(foot.length_m, foot.width_m));
    slope.mean += wake.slope;
    slope.variance *= wake.rough;
  }
  var ground: vec4f;
  // Slope of the water's surface relative to that of the ground.
  var fall = vec2f(0.0);
  if WATER_LAND {
    let size = WATER_TAP_TEXEL_RATIO * foot.length_m;
    ground = land_at(land_place(point.position.xz), land_lod(size));
    fall = slope.mean - land_to_world(ground.yz);
    slope = shore_thin_slope(slope, ground, land_place(point.position.xz), point.height, size);
  }
  if SKY_CLOUD_SHADOWS {
    cloud_sun_fraction = cloud_sun_transmittance(point.position.xz, foot.log_whole_texel_m);
  }
  if WATER_HULLS {
    shadow_hull_fraction =
      hull_image_sunlight(hull_image_place(point.position, point.height), frame.pixel_angle / nearness);
  }
  if LAND_SHADOWS {
    shadow_sun_fraction *= land_visible_sun(land_place(point.position.xz), point.height);
  }

  slope.variance += vec3f(vec2f(material.roughness_variance), 0.0);
  if !WATER_POINT_SAMPLES {
    slope = water_seen(v, slope);
  }
  // Waves of the mesh hide and shade each other as they are drawn; finer waves do so statistically. The mesh never
  // contains ripples, however fine it is.
  var around = slope;
  if WATER_POINT_SAMPLES {
    let shown = water_round_footprint(mesh_spacing(length(point.undisplaced)));
    let no_ripples = water_round_footprint(1e6);
    around = water_slope_with_carried(
      point.undisplaced, water_moved(point), shown, no_ripples, WaterDerivatives(), false, gust);
    around.variance += vec3f(vec2f(material.roughness_variance), 0.0);
  }

  var foam: FoamAmount;
  // Share of the foam that belongs to fronts of breakers at a coast, not to wakes.
  var front = 0.0;
  if WATER_FOAM {
    foam = foam_level(point.undisplaced, foot);
    if WATER_COAST {
      foam.fresh *= shore_front_thickness(slope.jacobian);
    }
    if WATER_LAND {
      let size = WATER_TAP_TEXEL_RATIO * foot.length_m;
      foam = shore_add_lace(foam, ground, point.position.xz, point.height, fall, slope.jacobian, size);
    }
    front = foam.fresh;
    if WATER_HULLS {
      let front_cover = front * foam.cover;
      foam = wake_add_foam(foam, wake);
      front = front_cover / max(foam.cover, 1e-4);
    }
  }
  var glints: WaterGlints;
  if WATER_GLINTS {
    glints = WaterGlints(foot.length_m * foot.width_m, pixel);
  }
  var mirror = water_mirror_among(v, slope, around, glints);
  if WATER_LAND {
    let rays = water_mirrored_rays(v, slope);
    mirror = land_mirrored(mirror, land_place(point.position.xz), point.height, rays);
  }
  if WATER_HULLS {
    mirror = hull_image_mirrored(mirror, hull_image_place(point.position, point.height), v, 1.0 / nearness, slope);
  }
  // Viewing ray after refraction at the mean facet.
  let n = water_normal(slope.mean);
  let ray = water_refract(-v, n);
  var below = water_deep_radiance(n, ray, foam.plume);
  if WATER_BED {
    let size = WATER_TAP_TEXEL_RATIO * vec2f(foot.length_m, foot.width_m);
    let clear = water_bed_radiance(below, point.position.xz, point.height, ray, size, slope.variance);
    if WATER_LAND && foam.plume > WATER_MIN_PLUME {
      // Near a shore waves break over a bed that the eye would see: their bubbles veil it.
      below = mix(clear, below, water_bubble_veil(foam.plume));
    } else {
      below = clear;
    }
  }
  if material.crest_transmission > 0.0 && point.height > 0.0 {
    below += water_crest_radiance(n, ray, slope, point.height, foam.plume);
  }
  if WATER_HULLS {
    below *= wake.open;
  }
  // Radiance falls by the square of the relative refractive index, because rays spread when they leave the water.
  let spread = material.inverse_relative_index * material.inverse_relative_index;
  var surface = mirror.radiance + (1.0 - mirror.reflectance) * spread * below;
  if WATER_FOAM && foam.cover >= FOAM_MIN_AMOUNT {
    var foam_at = point.undisplaced;
    if WATER_HULLS {
      foam_at -= wake.drift_m;
    }
    var foam_foot = foot;
    var lit_slope = slope;
    if WATER_COAST {
      // Surf squeezes the undisplaced surface to streaks, so a front has its pattern on the displaced one.
      let folded = shore_folded(slope.jacobian) * maths_rise(front, SHORE_FRONT_SHARES);
      if folded > 0.0 {
        foam_at = mix(foam_at, shore_front_place(point.position, point.height), folded);
        foam_foot = shore_front_footprint(foot, point.position, folded);
        lit_slope.mean *= 1.0 - SHORE_FOLDED_SLOPE_LOSS * folded;
      }
    }
    var look = foam_appearance(foam_at, foam_foot, foam);
    if WATER_COAST {
      // A full front is thick, and hides the water that its pattern leaves open.
      look.cover = 1.0 - (1.0 - look.cover) * (1.0 - SHORE_FRONT_OPAQUE * front * foam.cover);
    }
    if look.cover > FOAM_MIN_AMOUNT {
      var white = foam_radiance(v, lit_slope, look);
      if WATER_LAND {
        // Wet bubbles mirror the sky as the water between them does, and against a low sun are as warm.
        white += FOAM_SHORE_SHEEN * (1.0 - 0.7 * front) * surface;
        white += shore_front_glow(v, slope.mean, front, look.grain);
      }
      surface = mix(surface, white, look.cover);
    }
  }

  let air = air_to_point(dir, 1.0 / nearness);
  let colour = surface * air[1] + air[0];
  if WATER_POINT_SAMPLES {
    return vec4f(colour, water_sample_weight(v, slope, around));
  }
  if WATER_COAST {
    return frame_hdr_output(colour, shore_edged_nearness(nearness, front * foam.cover, pixel));
  }
  return frame_hdr_output(colour, nearness);
}
