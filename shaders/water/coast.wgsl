// How a coast weighs the layers of the wave maps: the cascades of the open sea end at the land, and some of their waves
// are replaced by those that the coast has made of them.

// Factors of the layers over the square of the world that encloses the coast, and the height that the waves run up the
// land, m (w).
@group(1) @binding(6) var coast_gains_map: texture_2d<f32>;

// Whether the sea runs up to a coast.
override WATER_COAST: bool = false;

// Factors of ordinary cascades, of offshore waves, and of waves at the coast (x, y, z) at an undisplaced position relative
// to the point below the eye, m. Outside the square, those of its edge hold.
fn coast_gains(at: vec2f) -> vec3f {
  return coast_at(at).xyz;
}

// The same factors, and the height, m, that the waves run up the land there (w).
fn coast_at(at: vec2f) -> vec4f {
  let half_texel = 0.5 / vec2f(textureDimensions(coast_gains_map));
  let uv = clamp(frame.coast_uv_below_eye + at * frame.coast_inverse_side, half_texel, 1.0 - half_texel);
  return textureSampleLevel(coast_gains_map, nearest_mip_sampler, uv, 0.0);
}

// Sides of the patches of cascades, m, from which the slopes of their waves are those of the coast (x), and up to which
// they are those of the open sea (y): within some ten metres of lee the wind has made waves shorter than a metre anew.
const COAST_LOCAL_PATCH_M = vec2f(32.0, 12.0);
// Reciprocal of the factor of the coast from which it has made all of them. Behind the waterline the factor is 0, and there is no water.
const COAST_LOCAL_RISE = 30.0;

// Factor on the slopes of the waves of a layer.
fn coast_slope_gain(map: FrameCascade, gains: vec3f) -> f32 {
  let range = 1.0 / COAST_LOCAL_PATCH_M;
  let local = saturate((map.inverse_patch - range.x) / (range.y - range.x));
  let gain = coast_gain(map, gains);
  return mix(gain, saturate(COAST_LOCAL_RISE * gain), local * map.coast_gains.x);
}

// Factor on the waves of a layer.
fn coast_gain(map: FrameCascade, gains: vec3f) -> f32 {
  return dot(map.coast_gains, gains);
}
