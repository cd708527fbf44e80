// Amplitudes h(k, t) of all waves at a time, and their eight real fields, packed in four complex ones. Packing: the
// complex field F + i G transforms to f + i g with real f and g. There are two pairs of complex fields:
//   0: (Dx, Dz), (height eta, dDx/dz)     1: (d eta/dx, d eta/dz), (dDx/dx, dDz/dz)

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<storage, read> h0: array<vec2f>; // [cascade][iz][ix]
@group(0) @binding(2) var<storage, read> wave_table: array<vec2u>; // cycles per period, bits of orbit ratio / |k|
@group(0) @binding(3) var<storage, read> twiddle_factors: array<vec2f>; // twiddle factors e^(2 pi i j / 1024)

// Values that all waves of a line with the same kz share.
struct EvolveLine {
  first_point: u32, // index in h0 of the line's first point
  opposite_first_point: u32, // index in h0 of the first point of the line with the opposite wave vectors
  first_entry: u32, // first entry of the cascade in the table of waves
  z: i32, // signed wave-vector index along z
  dk: f32, // spacing of the wave vectors, rad/m
  weight: f32, // amplitude factor of the cascade
}

fn evolve_line(c: u32, z: u32) -> EvolveLine {
  let base = c * N * N;
  let opposite = base + ((N - z) & (N - 1u)) * N;
  let entries = c * sea_wave_table_len(N);
  let kz = sea_signed_index(z, N);
  return EvolveLine(base + z * N, opposite, entries, kz, sea.cascades[c].dk, sea.amplitude_factors[c]);
}

// One wave of a line. xy: h(k, t) = h0(k) e^(-i w t) + conj(h0(-k)) e^(+i w t) with the angular frequency w; z: axis
// ratio of the particle orbits / |k|, m.
fn evolve_wave(line: EvolveLine, x: u32) -> vec3f {
  let a = h0[line.first_point + x];
  let b = h0[line.opposite_first_point + ((N - x) & (N - 1u))];
  let entry = wave_table[line.first_entry + sea_wave_table_entry(sea_signed_index(x, N), line.z)];
  let cs = maths_cos_sin(entry.x * sea.period_fraction_u32);
  let forward = vec2f(a.x * cs.x + a.y * cs.y, a.y * cs.x - a.x * cs.y);
  let backward = vec2f(b.x * cs.x + b.y * cs.y, b.x * cs.y - b.y * cs.x);
  return vec3f(line.weight * (forward + backward), bitcast<f32>(entry.y));
}

// Wave vector (kx, kz) of a wave, rad/m.
fn evolve_wave_vector(line: EvolveLine, x: u32) -> vec2f {
  return vec2f(f32(sea_signed_index(x, N)), f32(line.z)) * line.dk;
}

// Fourier amplitudes of two complex fields of a wave; `pair` is 0 or 1.
fn evolve_packed_fields(pair: u32, line: EvolveLine, x: u32, wave: vec3f) -> vec4f {
  let k = evolve_wave_vector(line, x);
  let unit = k * wave.z;
  let first = select(vec2f(-unit.y, unit.x), vec2f(-k.y, k.x), pair == 1u);
  let second = select(vec2f(1.0, -k.x * unit.y), vec2f(-k.x * unit.x, -k.y * unit.y), pair == 1u);
  return vec4f(maths_complex_mul(first, wave.xy), maths_complex_mul(second, wave.xy));
}
