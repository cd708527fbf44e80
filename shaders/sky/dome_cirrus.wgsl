// Cirrus (cirrus.wgsl) as seen from the sea, for the dome of clouds. Needs the structs of cloud_dome.wgsl.

// Phase function of ice crystals, 1/sr. They diffract light by a degree or two, which makes the aureole around the sun,
// bend it through their faces by about ten degrees and by some tens of degrees, and scatter the rest widely: four lobes.
// The mean cosine of the angle is 0.73, as that of rough crystals (0.7 to 0.8). The aureole is no narrower than a texel of
// the size `texel`, rad.
fn dome_ice_phase(c: f32, texel: vec2f) -> f32 {
  let aureole = min(0.985, 1.0 - max(texel.x, texel.y));
  return 0.4 * atm_henyey_greenstein(c, aureole) + 0.25 * atm_henyey_greenstein(c, 0.88)
    + 0.2 * atm_henyey_greenstein(c, 0.6) + 0.15 * atm_henyey_greenstein(c, -0.05);
}

// Cirrus in a direction. `texel` is the size of a texel of the dome, rad, across the vertical plane of the ray and
// in it.
fn dome_cirrus(dir: vec3f, texel: vec2f) -> DomeLight {
  let ray = cloud_turned(dir);
  let heading = normalize(ray.xz + vec2f(1e-9, 0.0));
  let phase = dome_ice_phase(dot(dir, sky.sun_direction), texel);
  var out = DomeLight(0.0, 0.0, 0.0, 1.0, CIRRUS_FAR_KM.y);
  var seen = 1e-6;
  var distance_sum = 0.0;
  for (var i = 0u; i < 2u; i++) {
    let height = cloud_field.base_km + CIRRUS_RISES[i] / cloud_field.layers_per_km;
    let t = cloud_distance_to(height, dir.y);
    // Sine of the ray's elevation where it meets the sheet.
    let mu = (ATM_EARTH_RADIUS_KM * dir.y + t) / (ATM_EARTH_RADIUS_KM + height);
    let size = t * texel * vec2f(length(ray.xz), 1.0 / mu);
    let texel_km = mat2x2f(size.x * vec2f(-heading.y, heading.x), size.y * heading);
    let place = cloud_field.eye_km + ray.xz * t;
    let fade = 1.0 - smoothstep(CIRRUS_FAR_KM.x, CIRRUS_FAR_KM.y, t);
    let depth = fade * cirrus_depth(place, i, texel_km);
    let passed = exp(-depth / mu);
    let share = out.transmittance * (1.0 - passed);
    // Half of the sheet lies before what is seen, on the way of the sunlight and on that of the view.
    let sunlit = exp(-0.5 * depth / max(sky.sun_direction.y, 0.2));
    // Light that is scattered more than once comes from all sides.
    let again = 0.5 * (1.0 - sunlit) / ATM_PI;
    out.sun += share * (phase * sunlit + again);
    out.sky += share * 0.5;
    out.sea += share * 0.5;
    seen += share;
    distance_sum += share * t;
    out.transmittance *= passed;
  }
  out.distance_km = distance_sum / seen;
  return out;
}
