// The sea as every simulation pass sees it. Rust twin: gpu/layout.rs, SeaUniform.

struct SeaCascade {
  patch_m: f32,
  dk: f32, // 2 pi / patch_m
  key: u32, // of the noise
  moment_scale: f32, // unit of the slope moments in half floats
}

// A part of the directional spectrum.
struct SeaTerm {
  travel: vec2f, // unit vector that angles are measured from
  kind: u32, // 0 lobe, 1 lobe with cos^2, 2 lobe with forward cos^2, 3 measured
  slot: u32, // first quadruple in an entry of the table
}

struct Sea {
  cascades: array<SeaCascade, 4>,
  terms: array<SeaTerm, 6>,
  weights: vec4f, // amplitude of each cascade: 1, unless one sea fades into another
  chop: vec2f, // along x and z
  n: u32,
  count: u32, // cascades in use
  seed: u32,
  phase_time: u32, // t / period in units of 2^-32
  keep_f32: u32, // not 0: the column pass leaves its result in the intermediate buffer
  term_count: u32,
  stride: u32, // quadruples in an entry of the table
  first_layer: u32, // of the maps
  ease: f32, // how far the spectrum pass takes h0 from what it is to what the table says; 1 is all the way
  // The size is a multiple of 16 bytes.
  unused: u32,
}

// Signed wave-vector index of lattice position i: 0 .. n/2 - 1, then -n/2 .. -1.
fn sea_signed(i: u32, n: u32) -> i32 {
  return select(i32(i), i32(i) - i32(n), i >= n / 2u);
}

// Entry of the triangle 0 <= b <= a <= n/2 for a wave: everything that depends on |k| alone. model/table.rs.
fn sea_triangle(ix: i32, iz: i32) -> u32 {
  let a = u32(max(abs(ix), abs(iz)));
  let b = u32(min(abs(ix), abs(iz)));
  return a * (a + 1u) / 2u + b;
}

fn sea_triangle_len(n: u32) -> u32 {
  return (n / 2u + 1u) * (n / 2u + 2u) / 2u;
}
