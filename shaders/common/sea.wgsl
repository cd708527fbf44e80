// The uniform of one evaluation of a sea. Rust twin: SeaUniform in src/sim/uniforms.rs.

struct SeaCascade {
  patch_m: f32,
  dk: f32, // 2 pi / patch_m
  key: u32, // noise key
  moment_scale: f32, // unit of the slope moments in the maps
}

// A term of the directional spectrum.
struct SeaTerm {
  travel: vec2f, // unit vector that angles are measured from
  kind: u32, // 0 lobe, 1 lobe with cos^2, 2 lobe with forward cos^2, 3 measured
  slot: u32, // first quadruple within an entry of the table
}

struct Sea {
  cascades: array<SeaCascade, 4>,
  terms: array<SeaTerm, 6>,
  weights: vec4f, // amplitude of each cascade: 1 except during a cross-fade
  chop: vec2f, // horizontal displacement factor along x and z
  n: u32,
  count: u32, // cascades in use
  seed: u32,
  phase_time: u32, // t / period in units of 2^-32
  keep_f32: u32, // not 0: the column pass also leaves the maps in the intermediate buffer
  term_count: u32, // terms in use
  stride: u32, // quadruples per entry of the table
  first_layer: u32, // map layer of the first cascade
  blend: f32, // weight of the tabulated amplitudes in the spectrum pass; 1 replaces the current h0
  unused: u32, // pads the size to a multiple of 16 bytes
}

// Signed wave-vector index of lattice position i: 0 .. n/2 - 1, then -n/2 .. -1.
fn sea_signed(i: u32, n: u32) -> i32 {
  return select(i32(i), i32(i) - i32(n), i >= n / 2u);
}

// Index of a wave in the triangle 0 <= b <= a <= n/2 of quantities that depend on |k| alone (src/waves/table.rs).
fn sea_triangle(ix: i32, iz: i32) -> u32 {
  let a = u32(max(abs(ix), abs(iz)));
  let b = u32(min(abs(ix), abs(iz)));
  return a * (a + 1u) / 2u + b;
}

fn sea_triangle_len(n: u32) -> u32 {
  return (n / 2u + 1u) * (n / 2u + 2u) / 2u;
}
