// The water mesh: a log-polar lattice around the eye (`MeshLattice` in src/render/water/mesh.rs), displaced once per
// frame by displace.wgsl into vertices (`MeshVertex` in src/render/water/displace.rs).

// Distance between neighbouring vertices at a radius from the eye, m: the larger of those along rows and columns.
fn mesh_spacing(radius: f32) -> f32 {
  return max((radius + frame.mesh_lattice.linear_radius_m) * frame.mesh_lattice.row_step, radius * frame.mesh_lattice.azimuth_step);
}
