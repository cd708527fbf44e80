// The mesh of the water: a log-polar lattice around the eye (`MeshLattice` of src/render/water/mesh.rs), displaced once a frame
// (displace.wgsl) into vertices (`MeshVertex` of src/render/water/displace.rs).

// Length over which the mesh is filtered at a distance: that between rows; columns are never farther apart than matters.
fn mesh_spacing(radius: f32) -> f32 {
  return max((radius + frame.mesh.radius_m) * frame.mesh.row_step, radius * frame.mesh.azimuth_step);
}
