// Baseline of `seastate bench`: computes the Fourier amplitudes of one cascade at a time. Each output texture holds a
// complex field that packs two real fields, in the same pairs as the program's row pass.

struct EvolveUniform {
  cascade: u32,
  dk: f32, // spacing of the wave vectors, 2 pi / patch, rad/m
  period_fraction_u32: u32, // time as a fraction of the sea's period, in units of 2^-32
  unused: u32,
}

@group(0) @binding(0) var<uniform> evolve: EvolveUniform;
@group(0) @binding(1) var<storage, read> h0: array<vec2f>; // [cascade][iz][ix]
@group(0) @binding(2) var<storage, read> wave_table: array<vec2u>; // cycles per period, bits of orbit ratio / |k|
@group(0) @binding(3) var field_0: texture_storage_2d<rg32float, write>;
@group(0) @binding(4) var field_1: texture_storage_2d<rg32float, write>;
@group(0) @binding(5) var field_2: texture_storage_2d<rg32float, write>;
@group(0) @binding(6) var field_3: texture_storage_2d<rg32float, write>;

fn complex_mul(a: vec2f, b: vec2f) -> vec2f {
  return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let n = textureDimensions(field_0).x;
  let ix = select(i32(id.x), i32(id.x) - i32(n), id.x >= n / 2u);
  let iz = select(i32(id.y), i32(id.y) - i32(n), id.y >= n / 2u);
  let a = u32(max(abs(ix), abs(iz)));
  let entries = (n / 2u + 1u) * (n / 2u + 2u) / 2u;
  let row = wave_table[evolve.cascade * entries + a * (a + 1u) / 2u + u32(min(abs(ix), abs(iz)))];
  let base = evolve.cascade * n * n;
  let here = h0[base + id.y * n + id.x];
  let there = h0[base + ((n - id.y) % n) * n + (n - id.x) % n];
  let phase = f32(bitcast<i32>(row.x * evolve.period_fraction_u32)) * 1.46291807926715968e-9;
  let turn = vec2f(cos(phase), -sin(phase));
  let h = complex_mul(here, turn) + complex_mul(vec2f(there.x, -there.y), vec2f(turn.x, -turn.y));
  let k = vec2f(f32(ix), f32(iz)) * evolve.dk;
  let unit = k * bitcast<f32>(row.y);
  textureStore(field_0, id.xy, vec4f(complex_mul(vec2f(-unit.y, unit.x), h), 0.0, 0.0));
  textureStore(field_1, id.xy, vec4f(complex_mul(vec2f(1.0, -k.x * unit.y), h), 0.0, 0.0));
  textureStore(field_2, id.xy, vec4f(complex_mul(vec2f(-k.y, k.x), h), 0.0, 0.0));
  textureStore(field_3, id.xy, vec4f(complex_mul(vec2f(-k.x * unit.x, -k.y * unit.y), h), 0.0, 0.0));
}
