// Light that comes out of the water: scattered back by it and by bubbles, and through thin crests.

// Backscattering of a dense plume of bubbles under a breaker, 1/m: a void fraction of about 1e-3 (Deane and Stokes 2002;
// backscattering ratio of Zhang, Lewis and Johnson 1998), and its depth, m.
const WATER_PLUME = 0.16;
const WATER_PLUME_M = 0.8;
// Mean cosine of what a crest scatters: light that is scattered several times spreads wider than by the particles' 0.9.
const WATER_FORWARD = 0.6;

// Light inside the water that travels from a surface of this normal when it came along `dir`, and the reverse for the eye.
fn water_refract(dir: vec3f, n: vec3f) -> vec3f {
  let bent = refract(dir, n, material.index_air / material.index_water);
  // Total reflection leaves no ray; along the surface is its limit.
  return select(normalize(dir - n * dot(dir, n) - 0.05 * n), bent, dot(bent, bent) > 0.5);
}

// Backscattering of the bubbles where `plume` of the surface has lately been white, 1/m.
fn water_bubbles(plume: f32) -> f32 {
  return WATER_PLUME * material.bubbles * plume * plume;
}

// Irradiance reflectance just below the surface: of deep water 0.33 bb / a where little is scattered (Morel and Prieur
// 1977), 1 where nothing is absorbed; below a layer of bubbles.
fn water_reflectance(plume: f32) -> vec3f {
  let up = 0.33 * material.backscatter;
  let deep = up / (material.absorption + up);
  if plume <= 0.0 {
    return deep;
  }
  let past = exp(-2.0 * WATER_PLUME_M * water_bubbles(plume));
  return (1.0 - past) * material.bubble_colour * exp(-3.5 * WATER_PLUME_M * material.absorption) + past * deep;
}

// Irradiance that enters the water from the sun, on a surface whose normal is `n` on the scale of waves.
fn water_enters(n: vec3f) -> vec3f {
  let l = frame.sun;
  let facing = max(0.5 * dot(n, l) + 0.5 * l.y, 0.0);
  return light.sun * (facing * (1.0 - water_fresnel(max(dot(n, l), 0.0))));
}

// Share of the sky's light that enters.
const WATER_SKY_ENTERS = 0.934;

// Radiance inside the water towards the surface, from far below. `ray` goes from the eye down into the water.
fn water_deep(n: vec3f, ray: vec3f, plume: f32) -> vec3f {
  let r = water_reflectance(plume);
  let sun_in = -water_refract(-frame.sun, vec3f(0.0, 1.0, 0.0)).y;
  // Light scattered once: the flatter the eye's ray, the more lit water lies along it.
  let view = (sun_in + 0.85) / (sun_in + clamp(-ray.y, 0.3, 1.0));
  let sun = water_enters(n) * (material.diffuse * max(mix(1.0, view, material.view_scatter), 0.0));
  let sky = light.sky * (material.ambient * WATER_SKY_ENTERS * (0.5 + 0.5 * n.y));
  // Upwelling light is not quite even over the hemisphere: Q = 4 sr; half of it is mirrored down again at the surface.
  return (sun + sky) * r / (4.0 * (1.0 - 0.48 * r));
}

// Sunlight through the back of a crest. `rise` is its height over the mean level in significant heights.
fn water_crest(n: vec3f, ray: vec3f, rise: f32, jacobian: f32, plume: f32) -> vec3f {
  let squeezed = clamp(1.6 - jacobian, 0.0, 1.0);
  let thin = smoothstep(-0.05, 0.55, rise) * squeezed;
  if thin <= 0.0 || frame.sun.y <= -0.02 {
    return vec3f(0.0);
  }
  // The far side leans the other way.
  let back = normalize(vec3f(-n.x, n.y, -n.z));
  let entry = max(dot(back, frame.sun), 0.0);
  let beam = water_refract(-frame.sun, back);
  let g = WATER_FORWARD;
  let cosine = dot(beam, -ray);
  let phase = (1.0 - g * g) / (4.0 * ATM_PI * pow(max(1.0 + g * g - 2.0 * g * cosine, 1e-3), 1.5));
  // A crest is some decimetres thick at its edge, and metres below it.
  let path_m = 0.8 + 1.2 * frame.hs_m * max(0.75 - rise, 0.0);
  // A crest about to break draws in air.
  let air = clamp(0.9 - jacobian, 0.0, 0.7);
  let bubbles = water_bubbles(plume) + WATER_PLUME * material.bubbles * air;
  let extinction = material.absorption + material.backscatter + bubbles;
  // Bubbles, too, scatter mostly forward; light scattered twice is still on its way.
  let forward = material.scatter + 12.0 * bubbles * material.bubble_colour;
  let scattered = 1.0 - exp(-forward * path_m);
  let through = exp(-extinction * path_m) * scattered;
  let sun = light.sun * (entry * (1.0 - water_fresnel(entry)) * phase);
  // The bright sky behind the crest comes through it, too.
  let sky = light.sky * (0.25 * clamp(1.0 + ray.y, 0.0, 1.0) / ATM_PI);
  return (sun + sky) * through * (material.height_scatter * thin);
}
