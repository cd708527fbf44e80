// The waves that a coast transforms, and the frame of the coast. The uniform `Coast` is declared in src/sim/uniforms.rs.

// Signed indices of a wave vector on the lattice of the first cascade, from two 16-bit numbers.
fn coast_lattice_index(packed: u32) -> vec2i {
  let both = bitcast<vec2i>(vec2u(packed << 16u, packed));
  return both >> vec2u(16u);
}

// Place of a wave vector among the n x n amplitudes of a cascade.
fn coast_lattice_place(index: vec2i, n: u32) -> u32 {
  let at = bitcast<vec2u>(index) & vec2u(n - 1u);
  return at.y * n + at.x;
}
