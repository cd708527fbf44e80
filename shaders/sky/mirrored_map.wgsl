// The table of the mirrored sky (mirrored.wgsl): its layers, and how it maps directions to texture coordinates.

// Standard deviation, rad, of the elevations of the mirrored rays in the first layer of the table. It doubles from each
// layer to the next.
const MIRRORED_FIRST_SPREAD = 0.02;
const MIRRORED_LAYERS = 6.0;

// Texture coordinates (azimuth, elevation) of a direction. The azimuth is counted along the sides of a square, and the
// elevation by the tangent of its half: neither needs an inverse trigonometric function.
fn mirrored_sky_uv(dir: vec3f) -> vec2f {
  let across = 0.25 * dir.x / max(abs(dir.x) + abs(dir.z), 1e-6);
  let half_tangent = dir.y / (1.0 + sqrt(dir.x * dir.x + dir.z * dir.z));
  return vec2f(select(across, 0.5 - across, dir.z > 0.0), 0.5 + 0.5 * half_tangent);
}

// Direction with the texture coordinates `uv`, the inverse of mirrored_sky_uv.
fn mirrored_sky_direction(uv: vec2f) -> vec3f {
  let turn = 4.0 * fract(uv.x + 0.25);
  let is_south = turn >= 2.0;
  let x = select(turn - 1.0, 3.0 - turn, is_south);
  let level = normalize(vec2f(x, select(abs(x) - 1.0, 1.0 - abs(x), is_south)));
  let half_tangent = 2.0 * uv.y - 1.0;
  let square = half_tangent * half_tangent;
  return vec3f(level * (1.0 - square), 2.0 * half_tangent).xzy / (1.0 + square);
}

// Third texture coordinate of rays whose elevations have the standard deviation `spread`, rad.
fn mirrored_sky_layer(spread: f32) -> f32 {
  return (log2(max(spread, 1e-6) / MIRRORED_FIRST_SPREAD) + 0.5) / MIRRORED_LAYERS;
}
