// The wave and foam maps, and smooth interpolation between their texels.

@group(1) @binding(0) var displacement_map: texture_2d_array<f32>;
@group(1) @binding(1) var gradients_map: texture_2d_array<f32>;
@group(1) @binding(2) var moments_map: texture_2d_array<f32>;
@group(1) @binding(3) var foam_map: texture_2d_array<f32>;
// The first sampler interpolates between mip levels, the second takes the nearest one.
@group(1) @binding(4) var trilinear_sampler: sampler;
@group(1) @binding(5) var nearest_mip_sampler: sampler;

// Interpolation between texels by five bilinear samples, from linear (smoothness 0) to a Catmull-Rom spline over 4 x 4
// texels (1). The corners of the spline, at most 1.6 % of its weight, are left out.
struct WaterSplineTaps {
  before: vec2f,
  middle: vec2f,
  after: vec2f,
  // Weights of the samples: in the middle, before and after it along x, before and after it along z.
  at_middle: f32,
  along_x: vec2f,
  along_z: vec2f,
}

// Positions and weights of the samples at texture coordinates of a map with n texels along a side.
fn water_spline_taps(uv: vec2f, n: f32, smoothness: f32) -> WaterSplineTaps {
  let p = uv * n - 0.5;
  let base = floor(p);
  let f = p - base;
  let w0 = smoothness * (f * (f * (1.0 - 0.5 * f) - 0.5));
  let w2 = mix(f, f * (f * (2.0 - 1.5 * f) + 0.5), smoothness);
  let w3 = smoothness * (f * f * (0.5 * f - 0.5));
  let w12 = 1.0 - w0 - w3;
  let texel = 1.0 / n;
  let over = 1.0 / (1.0 - (w0.x + w3.x) * (w0.y + w3.y));
  return WaterSplineTaps(
    (base - 0.5) * texel, (base + 0.5 + w2 / w12) * texel, (base + 2.5) * texel,
    over * w12.x * w12.y, (over * w12.y) * vec2f(w0.x, w3.x), (over * w12.x) * vec2f(w0.y, w3.y));
}

// Value of mip level 0 of a map, from the five samples of a spline.
fn water_sample_spline(map: texture_2d_array<f32>, s: WaterSplineTaps, layer: u32) -> vec4f {
  return s.at_middle * textureSampleLevel(map, nearest_mip_sampler, s.middle, layer, 0.0)
    + s.along_x.x * textureSampleLevel(map, nearest_mip_sampler, vec2f(s.before.x, s.middle.y), layer, 0.0)
    + s.along_x.y * textureSampleLevel(map, nearest_mip_sampler, vec2f(s.after.x, s.middle.y), layer, 0.0)
    + s.along_z.x * textureSampleLevel(map, nearest_mip_sampler, vec2f(s.middle.x, s.before.y), layer, 0.0)
    + s.along_z.y * textureSampleLevel(map, nearest_mip_sampler, vec2f(s.middle.x, s.after.y), layer, 0.0);
}
