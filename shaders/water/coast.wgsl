// How a coast weighs the layers of the wave maps: the cascades of the open sea end at the land, and some of their waves
// are replaced by those that the coast has made of them.

// Whether the sea runs up to a coast.
override WATER_COAST: bool = false;

// Factors of ordinary cascades, of offshore waves, and of waves at the coast (x, y, z) at an undisplaced position relative
// to the point below the eye, m. Outside the square, those of its edge hold.
fn coast_gains(at: vec2f) -> vec3f {
  return coast_at(at).xyz;
}

// Sides of the patches of cascades, m, from which the slopes of their waves are those of the coast (x), and up to which
// they are those of the open sea (y): within some ten metres of lee the wind has made waves shorter than a metre anew.
const COAST_LOCAL_PATCH_M = vec2f(32.0, 12.0);
// Reciprocal of the coast's factor from which the slopes of the open sea hold in full. Behind the waterline, where there is
// no water, the factor is 0.
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
