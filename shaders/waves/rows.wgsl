// Row pass for GPUs: the waves at a time and their inverse FFT along x, in one dispatch.

@group(0) @binding(4) var<storage, read_write> row_transforms: array<vec4f>; // [cascade][pair][iz][x]

// local.x is the thread of a line; local.y is the line.
@compute @workgroup_size(THREADS_PER_LINE, LINES_PER_WORKGROUP)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
  let z = group.x * LINES_PER_WORKGROUP + local.y;
  let c = group.z;
  let line = evolve_line(c, z);
  let xa = local.x;
  let xb = xa + N / 4u;
  let xc = xa + N / 2u;
  let xd = xc + N / 4u;
  let wave_a = evolve_wave(line, xa);
  let wave_b = evolve_wave(line, xb);
  let wave_c = evolve_wave(line, xc);
  let wave_d = evolve_wave(line, xd);
  for (var pair = 0u; pair < 2u; pair++) {
    let waves = FftPoints(
      evolve_packed_fields(pair, line, xa, wave_a),
      evolve_packed_fields(pair, line, xb, wave_b),
      evolve_packed_fields(pair, line, xc, wave_c),
      evolve_packed_fields(pair, line, xd, wave_d));
    let points = fft_line(waves, local.x, local.y * N, 1u);
    let out = ((c * 2u + pair) * N + z) * N;
    row_transforms[out + xa] = points.a;
    row_transforms[out + xb] = points.b;
    row_transforms[out + xc] = points.c;
    row_transforms[out + xd] = points.d;
  }
}
