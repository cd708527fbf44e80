// A texel of a map in a buffer: floats.

alias MapsTexel = vec4f;

fn maps_texel(value: vec4f) -> MapsTexel {
  return value;
}
