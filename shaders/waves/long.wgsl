// Two floats as one long number. llvmpipe reads and writes the numbers of each thread one by one, short or long.

fn long_pack2(v: vec2u) -> u64 {
  return u64(v.x) | (u64(v.y) << 32u);
}

fn long_pack(v: vec4f) -> vec2<u64> {
  let bits = bitcast<vec4u>(v);
  return vec2<u64>(long_pack2(bits.xy), long_pack2(bits.zw));
}

fn long_unpack(v: vec2<u64>) -> vec4f {
  return bitcast<vec4f>(vec4u(u32(v.x), u32(v.x >> 32u), u32(v.y), u32(v.y >> 32u)));
}
