// Appended to the module of the water's light by shading.rs: calls its functions. The constant PART, which shading.rs
// puts before this text, says which questions a kernel knows.

fn ask_mirror(v: vec3f, sun: vec3f, mean: vec2f, variance: vec3f) -> vec4f {
  frame.sun_direction = sun;
  // The mirrored sky is red and blue, the sun green.
  light.sun_irradiance = vec3f(0.0, 1.0, 0.0);
  var slope: WaterSlope;
  slope.mean = mean;
  slope.variance = variance;
  let mirror = water_mirror(v, slope);
  return vec4f(mirror.radiance, mirror.reflectance);
}

fn ask_fresnel(cosine: f32, kind: vec4f, indices: vec4f) -> f32 {
  WATER_SCHLICK = kind.x > 0.0;
  material.schlick_exponent = kind.y;
  material.fresnel_scale = kind.z;
  material.relative_index = indices.y / indices.z;
  let contrast = material.relative_index * material.relative_index - 1.0;
  material.index_contrast = vec2f(contrast, 1.0 / contrast);
  return water_fresnel(cosine);
}

fn ask_slope(at: vec2f, size: f32) -> vec4f {
  let slope = water_slope(at, water_displacement(at, size, false).displacement, water_round_footprint(size));
  return vec4f(slope.mean, slope.jacobian, 0.0);
}

fn answer_on_light(a: vec4f, b: vec4f, c: vec4f, d: vec4f) -> vec4f {
  switch u32(a.w) {
    case 0u: { return vec4f(ask_fresnel(a.x, b, d)); }
    case 1u: { return vec4f(water_projected_area(a.x, a.y, a.z, b.x)); }
    case 2u: { return ask_mirror(a.xyz, b.xyz, c.xy, vec3f(c.zw, b.w)); }
    default: {
      let slope = WaterSlope(c.xy, vec3f(c.zw, b.w), 1.0, vec2f(0.0), 0.0);
      return vec4f(water_second_bounce(water_tilt_towards(a.xyz, slope), b.x));
    }
  }
}

fn answer_on_surface(a: vec4f) -> vec4f {
  switch u32(a.w) {
    case 3u: { return ask_slope(a.xy, a.z); }
    case 4u: { return vec4f(water_displacement(a.xy, a.z, false).displacement, 0.0); }
    default: { return vec4f(water_normal(a.xy), 0.0); }
  }
}

fn answer_on_bed(a: vec4f, b: vec4f) -> vec4f {
  switch u32(a.w) {
    case 7u: { return vec4f(bed_caustic_gain(a.xy, b.x, a.z)); }
    case 8u: { return vec4f(bed_ground(a.xy, vec2f(0.0), a.z, bed_banks(a.xy, a.z)).albedo, 0.0); }
    case 9u: {
      frame.depth_m = 4.0;
      frame.sun_direction = normalize(vec3f(0.3, 0.9, 0.2));
      light.sun_irradiance = vec3f(1.0);
      light.sky_irradiance = vec3f(0.3);
      let ray = normalize(vec3f(0.5, -0.8, 0.2));
      return vec4f(water_bed_radiance(vec3f(0.0), a.xy, 0.0, ray, vec2f(a.z), vec3f(b.x, b.x, 0.0)), 0.0);
    }
    default: { return vec4f(select(BED_SEAGRASS_ALBEDO, BED_REEF_ALBEDO, a.x > 0.0), 0.0); }
  }
}

fn answer(question: Question) -> Answer {
  frame = picture_frame;
  material = picture_material;
  let a = question[0];
  let b = question[1];
  let c = question[2];
  let d = question[3];
  WATER_GGX = d.x == 1.0;
  WATER_PHONG = d.x == 2.0;
  material.shininess = 120.0;
  // A mirror image as bright as it comes.
  frame.sun_radiance_per_irradiance = 1e9;
  switch PART {
    case 0u: { return Answer(answer_on_light(a, b, c, d)); }
    case 1u: { return Answer(answer_on_surface(a)); }
    case 2u: { return Answer(answer_on_bed(a, b)); }
    default: { return Answer(vec4f(water_glint_cell(vec2u(a.xy), a.z))); }
  }
}
