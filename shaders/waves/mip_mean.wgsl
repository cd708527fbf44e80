// Computes a texel of the next mip level of all maps: displacement and gradients averaged over 2 x 2 texels, and the
// second moments of the slopes, from which the renderer derives the roughness that a pixel cannot resolve. Moments
// start at mip level 1, with products of the slopes of level 0.

override READS_LEVEL_0: bool = false; // whether `source_level` is mip level 0, which has no stored moments

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var source_level: texture_2d_array<f32>; // layers in thirds: displacement, gradients, moments

struct MipTexels {
  displacement: vec4f,
  gradients: vec4f,
  moments: vec4f,
}

// Number of layers of each kind of map, including those of another sea.
fn mips_layers_per_kind() -> u32 {
  return textureNumLayers(source_level) / 3u;
}

// Second moments (xx, zz, xz, 0) of the slopes at a texel of the level `source_level`, in units of `moment_unit`.
fn mips_moment(at: vec2u, cascade: u32, layers_per_kind: u32, slopes: vec2f) -> vec4f {
  if READS_LEVEL_0 {
    let products = vec3f(slopes.x * slopes.x, slopes.y * slopes.y, slopes.x * slopes.y);
    return vec4f(products / sea.cascades[cascade].moment_unit, 0.0);
  }
  return textureLoad(source_level, at, 2u * layers_per_kind + sea.first_layer + cascade, 0);
}

// Mean of the 2 x 2 texels of the level `source_level` that the texel `at` of the next level covers.
fn mips_mean_of_four(at: vec2u, cascade: u32) -> MipTexels {
  let layers_per_kind = mips_layers_per_kind();
  let layer = sea.first_layer + cascade;
  var sum: MipTexels;
  for (var i = 0u; i < 4u; i++) {
    let source = 2u * at + vec2u(i & 1u, i >> 1u);
    let slopes = textureLoad(source_level, source, layers_per_kind + layer, 0);
    sum.displacement += textureLoad(source_level, source, layer, 0);
    sum.gradients += slopes;
    sum.moments += mips_moment(source, cascade, layers_per_kind, slopes.xy);
  }
  return MipTexels(0.25 * sum.displacement, 0.25 * sum.gradients, 0.25 * sum.moments);
}
