// h(k, t) of every wave, eight real fields packed in four complex ones, and their inverse transform along x.
// Packing: F + i G -> f + i g for real f, g. Two packed pairs:
//   0: (Dx, Dz), (eta, dDx/dz)     1: (eta_x, eta_z), (dDx/dx, dDz/dz)

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<storage, read> h0: array<vec2f>; // [cascade][iz][ix]
@group(0) @binding(2) var<storage, read> wave: array<vec2u>; // turns, bits of the orbit, per triangle entry
@group(0) @binding(3) var<storage, read> twiddle: array<vec2f>; // e^(2 pi i j / 1024)
@group(0) @binding(4) var<storage, read_write> lines: array<vec4f>; // [cascade][pair][iz][x]

var<private> rows_h: array<vec2f, 32>;

// h(k, t) = h0(k) e^(-i w t) + conj(h0(-k)) e^(+i w t), and the packing factor's orbit.
fn rows_evolve(c: u32, x: u32, z: u32) -> vec2f {
  let base = c * N * N;
  let a = h0[base + z * N + x];
  let b = h0[base + ((N - z) & (N - 1u)) * N + ((N - x) & (N - 1u))];
  let entry = sea_triangle(sea_signed(x, N), sea_signed(z, N));
  let cs = maths_cos_sin(wave[c * sea_triangle_len(N) + entry].x * sea.phase_time);
  let forward = vec2f(a.x * cs.x + a.y * cs.y, a.y * cs.x - a.x * cs.y);
  let backward = vec2f(b.x * cs.x + b.y * cs.y, b.x * cs.y - b.y * cs.x);
  return forward + backward;
}

fn rows_pack(pair: u32, c: u32, x: u32, z: u32, h: vec2f) -> vec4f {
  let ix = sea_signed(x, N);
  let iz = sea_signed(z, N);
  let k = vec2f(f32(ix), f32(iz)) * sea.cascades[c].dk;
  let orbit = bitcast<f32>(wave[c * sea_triangle_len(N) + sea_triangle(ix, iz)].y);
  let unit = k * select(orbit / length(k), 0.0, ix == 0 && iz == 0);
  if pair == 0u {
    return vec4f(maths_complex_mul(vec2f(-unit.y, unit.x), h), maths_complex_mul(vec2f(1.0, -k.x * unit.y), h));
  }
  return vec4f(maths_complex_mul(vec2f(-k.y, k.x), h), maths_complex_mul(vec2f(-k.x * unit.x, -k.y * unit.y), h));
}

// x of the workgroup: thread of a line; y: line.
@compute @workgroup_size(R2, LINES)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
  let t = local.x;
  let z = group.x * LINES + local.y;
  let c = group.z;
  let exchange = local.y * N;
  for (var i = 0u; i < R1; i++) {
    rows_h[i] = sea.weights[c] * rows_evolve(c, i * R2 + t, z);
  }
  for (var pair = 0u; pair < 2u; pair++) {
    for (var i = 0u; i < R1; i++) {
      fft_v[i] = rows_pack(pair, c, i * R2 + t, z, rows_h[i]);
    }
    fft_registers(R1);
    workgroupBarrier();
    for (var k1 = 0u; k1 < R1; k1++) {
      let w = twiddle[t * k1 * (1024u / N)];
      fft_shared[exchange + fft_place(k1, t)] = fft_mul(fft_v[fft_slot(k1, R1)], w);
    }
    workgroupBarrier();
    let out = ((c * 2u + pair) * N + z) * N;
    for (var k1 = t; k1 < R1; k1 += R2) {
      for (var n2 = 0u; n2 < R2; n2++) {
        fft_v[n2] = fft_shared[exchange + fft_place(k1, n2)];
      }
      fft_registers(R2);
      for (var k2 = 0u; k2 < R2; k2++) {
        lines[out + k1 + R1 * k2] = fft_v[fft_slot(k2, R2)];
      }
    }
  }
}
