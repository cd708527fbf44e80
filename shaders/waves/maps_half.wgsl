// A texel of a map in a buffer: half floats.

alias MapsTexel = vec2u;

fn maps_texel(value: vec4f) -> MapsTexel {
  return vec2u(pack2x16float(value.xy), pack2x16float(value.zw));
}
