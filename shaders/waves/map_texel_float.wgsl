// A map's texel in a buffer: four floats.

alias MapTexel = vec4f;

fn map_texel(value: vec4f) -> MapTexel {
  return value;
}
