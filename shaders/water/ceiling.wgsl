// The surface seen from below: the sky, refracted into Snell's window, and the water, totally reflected outside of it.

// Nodes of the quadrature over the slopes that a pixel does not resolve: their number, and the distance between two, in
// standard deviations.
const CEILING_NODES = 7;
const CEILING_NODE_STEP = 0.8;
// Widening of the range of slopes that refract the sun to the eye by the size of its disc, relative to a mirror's: facets
// turn refracted rays by about a third of their angle, mirrored ones by twice.
const CEILING_DISC_WIDENING = 17.0;
// Fraction of the daylight above a layer of foam that comes out below.
const CEILING_FOAM_TRANSMITTANCE = 0.4;
// Capillary length of water, m, and how high water climbs glass that it wets: the square root of two times as high. At
// the upper edge its surface stands upright.
const CEILING_CAPILLARY_M = 0.0027;
const CEILING_CLIMB_M = 0.0038;
// Factor on the height of the climbing water in the picture. The rays of the picture begin 10 cm before the eye, but the
// glass before a camera's lens is only 7 cm before it, so that the water on the glass looks higher.
const CEILING_NEARER = 1.4;
// Height of the bright band of the climbing water and half its width, relative to the whole height.
const CEILING_BAND = vec2f(0.55, 0.3);
// Height from which the climbing water goes over into what lies behind it, relative to the whole height. The lens does not
// focus on its own glass.
const CEILING_BLUR = 0.25;
// Share of the light that is left where the climbing water mirrors the dark rim of the lens.
const CEILING_RIM_LIGHT = 0.65;

// Where the light comes from that an eye under water sees in a facet of the surface: refracted from above, or reflected
// from below.
struct CeilingFacet {
  // Direction above the surface from which refracted light comes, and whether there is one.
  above: vec3f,
  is_window: bool,
  reflectance: f32,
}

// Refraction and reflection at a facet with the normal `n`, for a ray from the eye that goes up in the direction `dir`.
fn ceiling_facet(dir: vec3f, n: vec3f) -> CeilingFacet {
  let index = material.relative_index;
  let cosine = dot(dir, n);
  let square = 1.0 - index * index * (1.0 - cosine * cosine);
  if square <= 0.0 {
    return CeilingFacet(n, false, 1.0);
  }
  let cosine_above = sqrt(square);
  // The reflectance is the same from both sides.
  return CeilingFacet(index * dir + (cosine_above - index * cosine) * n, true, water_fresnel(cosine_above));
}

// Radiance in the water of the sun, refracted by the slopes of a pixel (the transmission of Walter and others 2007).
fn ceiling_sun(dir: vec3f, slope: WaterSlope) -> vec3f {
  let l = frame.sun_direction;
  let index = material.relative_index;
  let between = index * dir - l;
  if l.y <= 0.0 || between.y <= 0.02 {
    return vec3f(0.0);
  }
  let n = normalize(between);
  let cosines = vec2f(dot(l, n), dot(dir, n));
  if cosines.x <= 0.0 || cosines.y <= 0.0 {
    return vec3f(0.0);
  }
  let wide = slope.variance + vec3f(vec2f(CEILING_DISC_WIDENING * frame.sun_slope_variance), 0.0);
  let density = water_slope_density(wide);
  let square = water_slope_distance(density, -n.xz / n.y - slope.mean);
  if square >= WATER_NO_GLITTER_SQUARE {
    return vec3f(0.0);
  }
  let area = max(water_tilt_projected_area(water_tilt_towards(dir, slope)).x, 1e-3);
  let jacobian = index * index * cosines.x * cosines.y / max(dot(between, between), 1e-4);
  let n2 = n.y * n.y;
  let facets = water_slope_density_at(density, square) * jacobian / (n2 * n2 * area);
  let most = index * index * frame.sun_radiance_per_irradiance;
  return cloud_sun_irradiance() * ((1.0 - water_fresnel(cosines.x)) * min(facets, most));
}

// Radiance of the sky in a direction, from a layer of the table of the mirrored sky.
fn ceiling_sky(dir: vec3f, layer: f32) -> vec3f {
  let uv = 0.5 + MIRRORED_SCALE * dir.xz / (1.0 + max(dir.y, -0.9));
  return textureSampleLevel(mirrored_sky_map, sky_sampler, vec3f(saturate(uv), layer), 0.0).rgb;
}

// Radiance of the surface, without foam, towards an eye below that looks along `dir`. `below` is the radiance of the water
// from which total reflection takes its light.
fn ceiling_radiance(dir: vec3f, slope: WaterSlope, below: vec3f) -> vec3f {
  let tilt = water_tilt_towards(dir, slope);
  // A change of the slope against the direction of view by one deviation.
  let step = -CEILING_NODE_STEP * tilt.sigma * tilt.toward;
  var sum = vec3f(0.0);
  var weights = 1e-6;
  for (var i = 0; i < CEILING_NODES; i++) {
    let off = f32(i) - 0.5 * f32(CEILING_NODES - 1);
    let deviations = CEILING_NODE_STEP * off;
    let n = water_normal(slope.mean + off * step);
    // Facets count by the area that they turn to the eye.
    let facing = dot(dir, n) / n.y;
    if facing <= 0.0 {
      continue;
    }
    let weight = facing * exp(-0.5 * deviations * deviations);
    let facet = ceiling_facet(dir, n);
    var radiance = below * facet.reflectance;
    if facet.is_window {
      let index = material.relative_index;
      let lifted = facet.above;
      let turn = index * dot(dir, n) / max(dot(lifted, n), 0.1) - 1.0;
      let layer = mirrored_sky_layer(0.5 * turn * tilt.sigma + index * frame.pixel_angle);
      // Rays that leave the water spread, so that the radiance inside is larger by the square of the index.
      radiance += (1.0 - facet.reflectance) * index * index * ceiling_sky(lifted, layer);
    }
    sum += weight * radiance;
    weights += weight;
  }
  return sum / weights + ceiling_sun(dir, slope);
}

// Radiance of foam seen from below: daylight that comes through it, most where it is thin, and the light of the water
// that it sends back. `grain` is the height of its relief, around 0.5.
fn ceiling_foam_radiance(below: vec3f, grain: f32) -> vec3f {
  let above = cloud_sun_irradiance() * max(frame.sun_direction.y, 0.0) + light.sky_irradiance;
  let through = CEILING_FOAM_TRANSMITTANCE * max(1.5 - grain, 0.0);
  return (through / ATM_PI) * material.foam_colour * above + FOAM_ALBEDO * below;
}

// How the water that climbs the lens bends a ray: a cylinder of water whose surface is level at its foot and upright at
// its upper edge.
struct CeilingMeniscus {
  // Direction in the water whose light the pixel shows, and the share of it.
  dir: vec3f,
  share: f32,
  // Radiance of the sky that the meniscus adds to the pixel.
  sky: vec3f,
}

// Radiance of the sky in a direction through the meniscus, on which the lens is not focused.
fn ceiling_blurred_sky(dir: vec3f) -> vec3f {
  return ceiling_sky(dir, mirrored_sky_layer(0.05));
}

// How the meniscus bends the ray `dir` at the fraction `edge` of its height. The height of a surface that hangs on a wall
// and its slope angle t obey height^2 = 2 capillary length^2 (1 - cos t).
fn ceiling_meniscus(dir: vec3f, edge: f32) -> CeilingMeniscus {
  let relative = edge * (CEILING_CLIMB_M / CEILING_CAPILLARY_M);
  let level = max(1.0 - 0.5 * relative * relative, 0.0);
  let ahead = dir.xz * inverseSqrt(max(dot(dir.xz, dir.xz), 1e-6));
  let upright = sqrt(1.0 - level * level);
  let n = vec3f(ahead.x * upright, level, ahead.y * upright);
  let cosine = dot(dir, n);
  if cosine <= 0.0 {
    return ceiling_blurred_edge(CeilingMeniscus(dir, 1.0, vec3f(0.0)), dir, edge);
  }
  let facet = ceiling_facet(dir, n);
  let mirrored = reflect(dir, n);
  var out = CeilingMeniscus(mirrored, 1.0, vec3f(0.0));
  out.share = mix(1.0, CEILING_RIM_LIGHT, maths_smooth(-1.2 * mirrored.y));
  if facet.is_window {
    // A ray that is bent down meets the level water before the lens, which mirrors the sky and lets the rest through.
    let down = vec3f(facet.above.x, -abs(facet.above.y), facet.above.z);
    let reflectance = select(water_fresnel(-down.y), 1.0, facet.above.y > 0.0);
    // The lens does not focus on its own glass, so that the border of total reflection is soft.
    let soft = max(1.0 - 1.7 * dot(facet.above, n), 0.0);
    let turned_back = max(facet.reflectance, soft * soft);
    let through = 1.0 - turned_back;
    out.sky = through * reflectance * ceiling_blurred_sky(vec3f(down.x, -down.y, down.z));
    let spread = material.inverse_relative_index * material.inverse_relative_index;
    out.share = mix((1.0 - reflectance) * spread, out.share, turned_back);
    // The edge on the glass is round and turns rays up into the sky.
    let bright = maths_smooth(1.0 - abs(edge - CEILING_BAND.x) / CEILING_BAND.y);
    let lifted = normalize(vec3f(dir.x, dir.y + 0.4, dir.z));
    out.sky += 0.35 * bright * ceiling_blurred_sky(lifted);
    out.dir = normalize(mix(water_refract(down, vec3f(0.0, 1.0, 0.0)), mirrored, turned_back));
  }
  return ceiling_blurred_edge(out, dir, edge);
}

// The climbing water `lens` at the fraction `edge` of its height, blurred over what the ray `dir` sees above it: the sky,
// or the water's surface, as smooth as it is at the lens.
fn ceiling_blurred_edge(lens: CeilingMeniscus, dir: vec3f, edge: f32) -> CeilingMeniscus {
  let behind = maths_smooth((edge - CEILING_BLUR) / (1.0 - CEILING_BLUR));
  let n = water_normal(frame.water_at_eye.yz);
  let cosine = -dot(dir, n);
  var out = lens;
  if cosine <= 0.0 {
    out.share *= 1.0 - behind;
    out.sky = mix(lens.sky, ceiling_blurred_sky(dir), behind);
    return out;
  }
  let reflectance = water_fresnel(cosine);
  let spread = material.inverse_relative_index * material.inverse_relative_index;
  let up = reflect(dir, n);
  out.dir = normalize(mix(lens.dir, water_refract(dir, n), behind));
  out.share = mix(lens.share, (1.0 - reflectance) * spread, behind);
  out.sky = mix(lens.sky, reflectance * ceiling_blurred_sky(vec3f(up.x, max(up.y, 0.02), up.z)), behind);
  return out;
}
