// The mesh of the sea: a log-polar lattice around the eye. Vertices are displaced once (mesh.wgsl), for all that draws them.

struct MeshVertex {
  // Relative to the eye.
  place: vec3f,
  // Of the wave over the still sea, m.
  height: f32,
  // The undisplaced point beside the eye's foot.
  rest: vec2f,
  // What it carries of the slopes (WaterSums).
  slope: vec2f,
  stretch: vec2f,
  shear: vec2f,
}

// Length over which the mesh is filtered at a distance: that between rows; columns are never farther apart than matters.
fn mesh_spacing(radius: f32) -> f32 {
  return max((radius + frame.mesh_radius) * frame.mesh.w, radius * frame.mesh.y);
}
