// Texel of a map in a storage buffer, as four 32-bit floats.

alias MapTexel = vec4f;

fn map_texel(value: vec4f) -> MapTexel {
  return value;
}
