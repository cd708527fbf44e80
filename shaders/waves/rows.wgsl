// Row pass for GPUs: the waves at a time and their inverse FFT along x, in one dispatch.

@group(0) @binding(4) var<storage, read_write> lines: array<vec4f>; // [cascade][pair][iz][x]

var<private> rows_h: array<vec3f, 32>;

// local.x is the thread of a line; local.y is the line.
@compute @workgroup_size(R2, LINES)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
  let t = local.x;
  let z = group.x * LINES + local.y;
  let c = group.z;
  let exchange = local.y * N;
  let line = evolve_line(c, z);
  for (var i = 0u; i < R1; i++) {
    rows_h[i] = evolve_wave(line, i * R2 + t);
  }
  for (var pair = 0u; pair < 2u; pair++) {
    for (var i = 0u; i < R1; i++) {
      let x = i * R2 + t;
      fft_v[i] = evolve_pack(pair, line, x, rows_h[i]);
    }
    fft_first(t, exchange);
    let out = ((c * 2u + pair) * N + z) * N;
    for (var k1 = t; k1 < R1; k1 += R2) {
      fft_second(k1, exchange);
      for (var k2 = 0u; k2 < R2; k2++) {
        lines[out + k1 + R1 * k2] = fft_v[fft_slot(k2, R2)];
      }
    }
  }
}
