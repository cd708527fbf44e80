// Light of a point in the clouds, for the dome of clouds. Distances are in km. Needs the functions of cloud_field.wgsl
// and cloud_rays.wgsl, the numbers of cloud_kinds.wgsl, and atm_henyey_greenstein.

// Shares of single, less often and often scattered sunlight, with the factors on extinction and asymmetry for each
// (Wrenninge et al. 2013). The shares are chosen for the look.
const DOME_OCTAVE_WEIGHT = vec3f(1.0, 1.1, 2.2);
const DOME_OCTAVE_EXTINCTION = vec3f(1.0, 0.3, 0.1);
const DOME_OCTAVE_ASYMMETRY = vec3f(1.0, 0.6, 0.2);
// Factor on the optical depth towards the sun, for the look: with 1, clouds before the sun would glow all through, but
// photographs show dark clouds with bright rims.
const DOME_SUN_DEPTH = 1.7;
// Share of the light that droplets diffract, as theory gives it, and the asymmetry of its lobe.
const DOME_DIFFRACTION_SHARE = 0.5;
const DOME_DIFFRACTION_ASYMMETRY = 0.955;
// Diffuse light that falls on cloud of the optical depth x passes with the fraction 1 / (1 + DOME_DIFFUSE * x).
const DOME_DIFFUSE = 0.14;
// Share of the sunlight on the top of a cloud, other than a storm deck, that diffuses down beyond the reach of the
// octaves.
const DOME_SUN_IN_DEPTH = 0.22;
// Share of the diffuse light that reaches the bottom of a crease between two heads.
const DOME_CREASE = 0.35;

// Phase function of droplets, 1/sr: forward and backward lobes. The three components are for the octaves. Light that is
// scattered once has a narrower lobe besides, by diffraction: it gives thin edges before the sun their bright rims.
fn dome_phase(c: f32) -> vec3f {
  let g = DOME_OCTAVE_ASYMMETRY;
  var out: vec3f;
  for (var i = 0; i < 3; i++) {
    out[i] = 0.72 * atm_henyey_greenstein(c, 0.82 * g[i]) + 0.28 * atm_henyey_greenstein(c, -0.25 * g[i]);
  }
  let diffracted = atm_henyey_greenstein(c, DOME_DIFFRACTION_ASYMMETRY);
  out.x = mix(out.x, diffracted, DOME_DIFFRACTION_SHARE);
  return out * DOME_OCTAVE_WEIGHT;
}

// Optical depth from p towards the sun: samples at growing distances, with noise that is averaged over half of their
// steps, but over `footprint_km` at least. `first_km` is the length of the first step.
fn dome_sun_depth(p: vec3f, sun: vec3f, first_km: f32, footprint_km: f32) -> f32 {
  var depth = 0.0;
  var step_km = first_km;
  var at = p;
  for (var i = 0; i < 6; i++) {
    let noise_km = max(footprint_km, 0.5 * step_km);
    depth += step_km * cloud_density(at + (0.5 * step_km) * sun, noise_km, 1.4 * step_km);
    at += step_km * sun;
    step_km *= 1.8;
  }
  return depth * DOME_SUN_DEPTH * cloud_field.extinction_per_km;
}

// A storm deck is thicker than the samples towards the sun reach. Below the first of these heights, as fractions of its
// thickness, the map of shadows dims what the samples leave of the sunlight; above the second one, it does not.
const DOME_STORM_HEIGHTS = vec2f(0.25, 0.75);
// Least width over which the map of shadows is averaged in a storm deck, km.
const DOME_STORM_BLUR_KM = 0.3;
// A smooth noise says how much water a storm deck holds: its repeats in the tile of the clouds, and the growth of the
// natural logarithm of the water as the noise goes from 0 to 1.
const DOME_STORM_WATER_REPEATS = 6.0;
const DOME_STORM_WATER_CONTRAST = 4.0;

// Factors in a storm deck on the sunlight that the samples leave (x) and on the thickness of the cloud above (y).
fn dome_storm_factors(p: vec3f, rise_km: f32, footprint_km: f32) -> vec2f {
  let open = smoothstep(DOME_STORM_HEIGHTS.x, DOME_STORM_HEIGHTS.y, rise_km * cloud_field.layers_per_km);
  let repeats_per_km = DOME_STORM_WATER_REPEATS * cloud_field.tiles_per_km;
  let lod = max(log2(footprint_km * repeats_per_km * f32(textureDimensions(cloud_noise_map).x)), 0.0);
  let water = textureSampleLevel(cloud_noise_map, cloud_sampler, vec3f(p.x, 0.0, p.z) * repeats_per_km, lod).b;
  let sunlit = ray_sunlit(p, max(DOME_STORM_BLUR_KM, footprint_km));
  return vec2f(mix(sunlit, 1.0, open), exp(DOME_STORM_WATER_CONTRAST * (water - 0.5)));
}

// Factors on the light of sun, sky and sea, of cloud at the point p.
fn dome_lit(p: vec3f, place: vec4f, inside: f32, footprint_km: f32, sun: vec3f, phase: vec3f) -> vec3f {
  let tau = dome_sun_depth(p, sun, 2.0 * cloud_field.step_km, footprint_km);
  let rise = max(p.y - cloud_field.base_km, 0.0);
  var storm = vec2f(1.0);
  if cloud_field.kind == CLOUD_STORM {
    storm = dome_storm_factors(p, rise, footprint_km);
  }
  let over_km = storm.y * max(place.y, 0.0);
  let above = 1.0 / (1.0 + DOME_DIFFUSE * cloud_field.extinction_per_km * over_km);
  let below = 1.0 / (1.0 + DOME_DIFFUSE * cloud_field.extinction_per_km * rise);
  // Light that has been scattered often is weaker at the very surface, from which it escapes.
  let buried = 1.0 - 0.7 * exp(-0.35 * (tau + cloud_field.extinction_per_km * 0.1 * inside));
  let shine = phase * exp(-tau * DOME_OCTAVE_EXTINCTION) * storm.x;
  // Creases between heads, which the noise has cut into the cloud, see less of the light from all sides.
  let open = DOME_CREASE + (1.0 - DOME_CREASE) * saturate(0.6 - 2.0 * place.x / cloud_field.shape_amplitude);
  return vec3f(shine.x + open * (shine.y + shine.z * buried), 0.5 * above * open, 0.5 * below);
}
