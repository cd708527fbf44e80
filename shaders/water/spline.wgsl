// The wave maps, and smooth interpolation between their texels.

@group(1) @binding(0) var displacement_map: texture_2d_array<f32>;
@group(1) @binding(1) var gradients_map: texture_2d_array<f32>;
@group(1) @binding(2) var moments_map: texture_2d_array<f32>;
// Interpolates between mip levels. The sampler that takes the nearest one is in shaders/water/coast_map.wgsl.
@group(1) @binding(4) var trilinear_sampler: sampler;

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
  // The outer two of the four texels along an axis have the weights outer * (1 - f) and outer * f, and the inner two
  // the rest, in which the second has f + outer * (1 - 3 * f).
  let outer = (-0.5 * smoothness) * (f - f * f);
  let inner = 1.0 - outer;
  let texel = 1.0 / n;
  let before = (base - 0.5) * texel;
  let middle = before + ((f + outer * (1.0 - 3.0 * f)) / inner + 1.0) * texel;
  let over = 1.0 / (1.0 - outer.x * outer.y);
  let sides = (over * inner.yx) * outer;
  let last = sides * f;
  return WaterSplineTaps(
    before, middle, before + 3.0 * texel,
    over * inner.x * inner.y, vec2f(sides.x - last.x, last.x), vec2f(sides.y - last.y, last.y));
}

// Value of mip level 0 of a map, from the five samples of a spline.
fn water_sample_spline(map: texture_2d_array<f32>, s: WaterSplineTaps, layer: u32) -> vec4f {
  return s.at_middle * textureSampleLevel(map, nearest_mip_sampler, s.middle, layer, 0.0)
    + s.along_x.x * textureSampleLevel(map, nearest_mip_sampler, vec2f(s.before.x, s.middle.y), layer, 0.0)
    + s.along_x.y * textureSampleLevel(map, nearest_mip_sampler, vec2f(s.after.x, s.middle.y), layer, 0.0)
    + s.along_z.x * textureSampleLevel(map, nearest_mip_sampler, vec2f(s.middle.x, s.before.y), layer, 0.0)
    + s.along_z.y * textureSampleLevel(map, nearest_mip_sampler, vec2f(s.middle.x, s.after.y), layer, 0.0);
}
