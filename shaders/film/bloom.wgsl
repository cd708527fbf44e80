// Bloom, light that the lens scatters (Jimenez, "Next generation post processing in Call of Duty: Advanced Warfare",
// 2014): the picture is halved step by step with a wide filter, then added up from the coarsest level.

@group(0) @binding(0) var source_map: texture_2d<f32>;
@group(0) @binding(1) var source_sampler: sampler;
@group(0) @binding(2) var bloom_out: texture_storage_2d<rgba16float, write>;
// In `upsample`, the level of the downward chain that has the size of the output.
@group(0) @binding(3) var finer_map: texture_2d<f32>;

// Weight of the coarser levels when a level is added to them.
const BLOOM_COARSER_WEIGHT = 0.72;

fn bloom_source_sample(uv: vec2f) -> vec3f {
  return textureSampleLevel(source_map, source_sampler, uv, 0.0).rgb;
}

// Downsamples by two with 13 bilinear samples, which are five overlapping squares.
@compute @workgroup_size(8, 8)
fn downsample(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(bloom_out);
  if id.x >= size.x || id.y >= size.y {
    return;
  }
  let uv = (vec2f(id.xy) + 0.5) / vec2f(size);
  let t = 1.0 / vec2f(textureDimensions(source_map));
  var inner = vec3f(0.0);
  var corners = vec3f(0.0);
  var sides = vec3f(0.0);
  for (var i = 0; i < 4; i++) {
    let s = vec2f(select(-1.0, 1.0, (i & 1) == 1), select(-1.0, 1.0, i >= 2));
    inner += bloom_source_sample(uv + s * t);
    corners += bloom_source_sample(uv + 2.0 * s * t);
    sides += bloom_source_sample(uv + select(vec2f(2.0 * s.x, 0.0), vec2f(0.0, 2.0 * s.x), i >= 2) * t);
  }
  let sum = 0.125 * inner + 0.125 * bloom_source_sample(uv) + 0.0625 * sides + 0.03125 * corners;
  textureStore(bloom_out, id.xy, vec4f(sum, 1.0));
}

// Upsamples the coarser level with a tent of nine samples, and mixes it with the level of the output's size.
@compute @workgroup_size(8, 8)
fn upsample(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(bloom_out);
  if id.x >= size.x || id.y >= size.y {
    return;
  }
  let uv = (vec2f(id.xy) + 0.5) / vec2f(size);
  let t = 1.0 / vec2f(textureDimensions(source_map));
  var sum = vec3f(0.0);
  for (var y = -1; y <= 1; y++) {
    for (var x = -1; x <= 1; x++) {
      let weight = f32((2 - abs(x)) * (2 - abs(y))) / 16.0;
      sum += weight * bloom_source_sample(uv + vec2f(vec2i(x, y)) * t);
    }
  }
  let own = textureLoad(finer_map, id.xy, 0).rgb;
  textureStore(bloom_out, id.xy, vec4f(mix(own, sum, BLOOM_COARSER_WEIGHT), 1.0));
}
