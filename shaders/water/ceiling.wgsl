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
      let uv = 0.5 + MIRRORED_SCALE * lifted.xz / (1.0 + max(lifted.y, -0.9));
      let sky_there = textureSampleLevel(mirrored_sky_map, sky_sampler, vec3f(saturate(uv), layer), 0.0).rgb;
      // Rays that leave the water spread, so that the radiance inside is larger by the square of the index.
      radiance += (1.0 - facet.reflectance) * index * index * sky_there;
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
