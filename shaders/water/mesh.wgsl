// The water mesh: a log-polar lattice around the eye (`MeshLattice` in src/render/water/mesh.rs), displaced once per
// frame by displace.wgsl into vertices (`MeshVertex` in src/render/water/displace.rs).

// Distance between neighbouring vertices at a radius from the eye, m: the larger of those along rows and columns.
fn mesh_spacing(radius: f32) -> f32 {
  let lattice = frame.mesh_lattice;
  return max((radius + lattice.linear_radius_m) * lattice.log_radius_step, radius * lattice.azimuth_step);
}
