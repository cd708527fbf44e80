// Computes a texel of the next mip level of all maps: displacement and gradients averaged over 2 x 2 texels, and the
// second moments of the slopes, from which the renderer derives the roughness that a pixel cannot resolve. Moments
// start at mip level 1, with products of the slopes of level 0.

override FIRST: bool = false; // whether `above` is mip level 0, which has no stored moments

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var above: texture_2d_array<f32>; // layers in thirds: displacement, gradients, moments

struct MipsTexel {
  displacement: vec4f,
  gradients: vec4f,
  moments: vec4f,
}

// Number of layers of each kind of map, including those of another sea.
fn mips_room() -> u32 {
  return textureNumLayers(above) / 3u;
}

// Second moments (xx, zz, xz, 0) of the slopes at a texel of the level `above`, in units of `moment_scale`.
fn mips_moment(at: vec2u, cascade: u32, room: u32, slopes: vec2f) -> vec4f {
  if FIRST {
    let products = vec3f(slopes.x * slopes.x, slopes.y * slopes.y, slopes.x * slopes.y);
    return vec4f(products / sea.cascades[cascade].moment_scale, 0.0);
  }
  return textureLoad(above, at, 2u * room + sea.first_layer + cascade, 0);
}

// Mean of the 2 x 2 texels of the level `above` that the texel `at` of the next level covers.
fn mips_mean(at: vec2u, cascade: u32) -> MipsTexel {
  let room = mips_room();
  let layer = sea.first_layer + cascade;
  var sum: MipsTexel;
  for (var i = 0u; i < 4u; i++) {
    let source = 2u * at + vec2u(i & 1u, i >> 1u);
    let slopes = textureLoad(above, source, room + layer, 0);
    sum.displacement += textureLoad(above, source, layer, 0);
    sum.gradients += slopes;
    sum.moments += mips_moment(source, cascade, room, slopes.xy);
  }
  return MipsTexel(0.25 * sum.displacement, 0.25 * sum.gradients, 0.25 * sum.moments);
}
