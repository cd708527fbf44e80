// Baseline of `seastate bench`: one radix-2 stage of the inverse FFT of one field along one axis, from texture to
// texture. Twiddle factors and source indices come from a texture with one row per stage.

struct Stage {
  stage: u32,
  vertical: u32,
}

@group(0) @binding(0) var<uniform> stage: Stage;
@group(0) @binding(1) var butterfly: texture_2d<f32>; // xy: twiddle factor, zw: both source indices
@group(0) @binding(2) var source: texture_2d<f32>;
@group(0) @binding(3) var sink: texture_storage_2d<rg32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let along = select(id.x, id.y, stage.vertical != 0u);
  let b = textureLoad(butterfly, vec2u(along, stage.stage), 0);
  let places = vec2u(b.zw);
  let first = select(vec2u(places.x, id.y), vec2u(id.x, places.x), stage.vertical != 0u);
  let second = select(vec2u(places.y, id.y), vec2u(id.x, places.y), stage.vertical != 0u);
  let u = textureLoad(source, first, 0).xy;
  let v = textureLoad(source, second, 0).xy;
  let sum = u + vec2f(b.x * v.x - b.y * v.y, b.x * v.y + b.y * v.x);
  textureStore(sink, id.xy, vec4f(sum, 0.0, 0.0));
}
