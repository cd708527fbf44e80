// The table of the mirrored sky (mirrored.wgsl): its layers, and how it maps directions to texture coordinates.

// Standard deviation, rad, of the elevations of the mirrored rays in the first layer of the table. It doubles from each
// layer to the next.
const MIRRORED_FIRST_SPREAD = 0.02;
const MIRRORED_LOG_FIRST_SPREAD = log2(MIRRORED_FIRST_SPREAD);
const MIRRORED_LAYERS = 6.0;

// Scale of the stereographic projection from the nadir, by which the table maps directions to texture coordinates:
// 0.5 + MIRRORED_SCALE * (x, z) / (1 + y). The sides of the table lie MIRRORED_SIDE from its middle, which is about 26
// degrees below the horizon.
const MIRRORED_SIDE = 1.6;
const MIRRORED_SCALE = 0.5 / MIRRORED_SIDE;

// Direction with the texture coordinates `uv`.
fn mirrored_sky_direction(uv: vec2f) -> vec3f {
  let p = (uv - 0.5) / MIRRORED_SCALE;
  let square = dot(p, p);
  return vec3f(2.0 * p, 1.0 - square).xzy / (1.0 + square);
}

// Third texture coordinate of rays whose elevations have the standard deviation `spread`, rad.
fn mirrored_sky_layer(spread: f32) -> f32 {
  return (log2(max(spread, 1e-6)) - MIRRORED_LOG_FIRST_SPREAD + 0.5) * (1.0 / MIRRORED_LAYERS);
}
