// h(k, t) of every wave, eight real fields packed in four complex ones, and their inverse transform along x.
// Packing: F + i G -> f + i g for real f, g. Two packed pairs:
//   0: (Dx, Dz), (eta, dDx/dz)     1: (eta_x, eta_z), (dDx/dx, dDz/dz)

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<storage, read> h0: array<vec2f>; // [cascade][iz][ix]
@group(0) @binding(2) var<storage, read> wave: array<vec2u>; // turns, bits of orbit / |k|, per triangle entry
@group(0) @binding(3) var<storage, read> twiddle: array<vec2f>; // e^(2 pi i j / 1024)
@group(0) @binding(4) var<storage, read_write> lines: array<vec4f>; // [cascade][pair][iz][x]

// h(k, t) = h0(k) e^(-i w t) + conj(h0(-k)) e^(+i w t), and the orbit over |k|.
fn rows_wave(c: u32, x: u32, z: u32) -> vec3f {
  let base = c * N * N;
  let a = h0[base + z * N + x];
  let b = h0[base + ((N - z) & (N - 1u)) * N + ((N - x) & (N - 1u))];
  let entry = wave[c * sea_triangle_len(N) + sea_triangle(sea_signed(x, N), sea_signed(z, N))];
  let cs = maths_cos_sin(entry.x * sea.phase_time);
  let forward = vec2f(a.x * cs.x + a.y * cs.y, a.y * cs.x - a.x * cs.y);
  let backward = vec2f(b.x * cs.x + b.y * cs.y, b.x * cs.y - b.y * cs.x);
  return vec3f(sea.weights[c] * (forward + backward), bitcast<f32>(entry.y));
}

fn rows_vector(c: u32, x: u32, z: u32) -> vec2f {
  return vec2f(f32(sea_signed(x, N)), f32(sea_signed(z, N))) * sea.cascades[c].dk;
}

fn rows_pack_0(c: u32, x: u32, z: u32, wave: vec3f) -> vec4f {
  let k = rows_vector(c, x, z);
  let unit = k * wave.z;
  return vec4f(maths_complex_mul(vec2f(-unit.y, unit.x), wave.xy), maths_complex_mul(vec2f(1.0, -k.x * unit.y), wave.xy));
}

fn rows_pack_1(c: u32, x: u32, z: u32, wave: vec3f) -> vec4f {
  let k = rows_vector(c, x, z);
  let unit = k * wave.z;
  let squeeze = vec2f(-k.x * unit.x, -k.y * unit.y);
  return vec4f(maths_complex_mul(vec2f(-k.y, k.x), wave.xy), maths_complex_mul(squeeze, wave.xy));
}
