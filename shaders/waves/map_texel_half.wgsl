// Texel of a map in a storage buffer, as four half floats.

alias MapTexel = vec2u;

fn map_texel(value: vec4f) -> MapTexel {
  return vec2u(pack2x16float(value.xy), pack2x16float(value.zw));
}
