// Gusts and slicks, which change how rough the short waves are.

// Whether gusts and slicks are compiled in.
override WATER_GUSTS: bool = false;
// Noise layers of gusts, which the wind carries along, and of slicks, which drift slowly.
const WATER_GUST_LAYER = 8u;
const WATER_SLICK_LAYER = 9u;
// Standard deviation of the short waves' slope variance, relative to its mean, by gusts and by slicks.
const WATER_GUST_DEVIATION = 0.46;
const WATER_SLICK_DEVIATION = 0.36;
// Texels per metre from which a cascade's waves follow gusts within seconds.
const WATER_GUST_TEXELS_PER_M = 2.0;

// Factor on the slope variance of short waves at an undisplaced position, by gusts and slicks, filtered over `size`
// metres. Its mean is 1 over any area that is large against them, at every distance, because both noises are uniform,
// independent, and enter linearly.
fn water_gust_gain(at: vec2f, size: f32) -> f32 {
  if !WATER_GUSTS {
    return 1.0;
  }
  let gust = material_noise(WATER_GUST_LAYER, at, material_lod(WATER_GUST_LAYER, size)).b - 0.5;
  let slick = material_noise(WATER_SLICK_LAYER, at, material_lod(WATER_SLICK_LAYER, size)).b - 0.5;
  let strength = 3.4641 * material.gust_strength;
  return (1.0 + strength * WATER_GUST_DEVIATION * gust) * (1.0 + strength * WATER_SLICK_DEVIATION * slick);
}

// Factor by which gusts change the slope variance of a cascade or of ripples, from that of the shortest waves.
fn water_gust_share(map: FrameCascade, gain: f32) -> f32 {
  if WATER_GUSTS {
    return select(1.0, gain, map.texels_per_m > WATER_GUST_TEXELS_PER_M);
  }
  return 1.0;
}
