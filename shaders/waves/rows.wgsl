// Row pass for GPUs: the waves at a time and their inverse FFT along x, in one dispatch.

@group(0) @binding(4) var<storage, read_write> row_transforms: array<vec4f>; // [cascade][pair][iz][x]

var<private> rows_waves: array<vec3f, 32>;

// local.x is the thread of a line; local.y is the line.
@compute @workgroup_size(RADIX_2, LINES_PER_WORKGROUP)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
  let t = local.x;
  let z = group.x * LINES_PER_WORKGROUP + local.y;
  let c = group.z;
  let exchange = local.y * N;
  let line = evolve_line(c, z);
  for (var i = 0u; i < RADIX_1; i++) {
    rows_waves[i] = evolve_wave(line, i * RADIX_2 + t);
  }
  for (var pair = 0u; pair < 2u; pair++) {
    for (var i = 0u; i < RADIX_1; i++) {
      let x = i * RADIX_2 + t;
      fft_points[i] = evolve_packed_fields(pair, line, x, rows_waves[i]);
    }
    fft_in_registers(RADIX_1);
    workgroupBarrier();
    for (var k1 = 0u; k1 < RADIX_1; k1++) {
      let w = twiddle_factors[t * k1 * (1024u / N)];
      let point = fft_points[fft_result_index(k1, RADIX_1)];
      fft_exchange[exchange + fft_exchange_index(k1, t)] = fft_complex_mul(point, w);
    }
    workgroupBarrier();
    let out = ((c * 2u + pair) * N + z) * N;
    for (var k1 = t; k1 < RADIX_1; k1 += RADIX_2) {
      for (var n2 = 0u; n2 < RADIX_2; n2++) {
        fft_points[n2] = fft_exchange[exchange + fft_exchange_index(k1, n2)];
      }
      fft_in_registers(RADIX_2);
      for (var k2 = 0u; k2 < RADIX_2; k2++) {
        row_transforms[out + k1 + RADIX_1 * k2] = fft_points[fft_result_index(k2, RADIX_2)];
      }
    }
  }
}
