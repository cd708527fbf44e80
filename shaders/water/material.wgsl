// What the water, its foam and the bed are made of. Rust twin: render/material.rs.

struct Material {
  // Absorption of the water at the display's primaries, 1/m.
  absorption: vec3f,
  ambient: f32,
  // Backscattering, 1/m.
  backscatter: vec3f,
  index_air: f32,
  // Scattering in all, 1/m.
  scatter: vec3f,
  bubbles: f32,
  bubble_colour: vec3f,
  height_scatter: f32,
  foam_colour: vec3f,
  view_scatter: f32,
  bed_colour: vec3f,
  diffuse: f32,
  // Texture coordinates of a layer of noise: matrix columns (xy, zw) for metres beside the eye's foot, and of the foot.
  layers: array<vec4f, 6>,
  layer_feet: array<vec4f, 3>,
  index_water: f32,
  fresnel_shine: f32,
  fresnel_scale: f32,
  fresnel_normals: f32,
  shininess: f32,
  specular_scale: f32,
  specular_fresnel: f32,
  specular_cut: f32,
  // Variance of the slope that is added along each axis.
  rough_variance: f32,
  foam_roughness: f32,
  foam_relief: f32,
  reflection: f32,
  // 0 none; share of the light's focusing.
  caustics: f32,
  // Waves shorter than this focus too close below the surface to be told apart on the bed, m.
  caustic_m: f32,
}

// Texels over which the channel of a layer (cloud, net, net, bubbles; cloud, bubbles) keeps half its variance, and how
// steeply that falls: fitted to the mips of noise.rs as the sampler reads them, between texels and between levels.
const MATERIAL_HALF_KEPT = array<vec2f, 6>(
  vec2f(42.0, 1.8), vec2f(10.9, 1.5), vec2f(10.9, 1.5), vec2f(2.7, 1.65), vec2f(42.0, 1.8), vec2f(2.7, 1.65));

fn material_uv(layer: u32, at: vec2f) -> vec2f {
  let turn = material.layers[layer];
  let feet = material.layer_feet[layer / 2u];
  return select(feet.zw, feet.xy, (layer & 1u) == 0u) + turn.xy * at.x + turn.zw * at.y;
}

// Texels of a layer in a length, as a level of detail.
fn material_lod(layer: u32, size: f32) -> f32 {
  let turn = material.layers[layer];
  let det = abs(turn.x * turn.w - turn.y * turn.z);
  return log2(max(size * sqrt(det) * 512.0, 1e-4));
}

// Noise of a layer at a point beside the eye, at a level of detail.
fn material_noise(layer: u32, at: vec2f, lod: f32) -> vec4f {
  return textureSampleLevel(noise_map, noise_sampler, material_uv(layer, at), max(lod, 0.0));
}

// Share of the variance of the layer's channel that a level of detail keeps.
fn material_kept(layer: u32, lod: f32) -> f32 {
  let half_kept = MATERIAL_HALF_KEPT[layer];
  return 1.0 / (1.0 + exp2(half_kept.y * (lod - log2(half_kept.x))));
}
