// Indices of waves in the lattice and in the wave table. The uniform `Sea` is declared in src/sim/uniforms.rs.

// Signed wave-vector index of lattice position i: 0 to n/2 - 1, then -n/2 to -1.
fn sea_signed_index(i: u32, n: u32) -> i32 {
  return select(i32(i), i32(i) - i32(n), i >= n / 2u);
}

// Entry of the wave (ix, iz) in the wave table. Its values depend only on |k|, so the table covers only the triangle 0
// <= b <= a <= n/2 (src/waves/table.rs).
fn sea_wave_table_entry(ix: i32, iz: i32) -> u32 {
  let a = u32(max(abs(ix), abs(iz)));
  let b = u32(min(abs(ix), abs(iz)));
  return a * (a + 1u) / 2u + b;
}

// Number of entries of the wave table of one cascade with n x n waves.
fn sea_wave_table_len(n: u32) -> u32 {
  return (n / 2u + 1u) * (n / 2u + 2u) / 2u;
}
