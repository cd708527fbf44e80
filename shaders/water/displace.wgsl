// Displaces the vertices of the water mesh.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> mesh_vertices: array<MeshVertex>;

// One thread per vertex: columns along x, rows along y. A software GPU samples faster if neighbours use one mip level.
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let vertex = id.x * frame.mesh_lattice.rows + id.y;
  if id.y >= frame.mesh_lattice.rows || vertex >= arrayLength(&mesh_vertices) {
    return;
  }
  let azimuth = frame.mesh_lattice.first_azimuth + f32(id.x) * frame.mesh_lattice.azimuth_step;
  let t = frame.mesh_lattice.first_log_radius + f32(id.y) * frame.mesh_lattice.log_radius_step;
  let radius = frame.mesh_lattice.linear_radius_m * (exp(t) - 1.0);
  // Near the eye, the lattice is centred on the undisplaced position of the water below the eye.
  let foot = frame.undisplaced_below_eye * exp(-radius / (4.0 * frame.max_displacement_m));
  let at = foot + radius * vec2f(sin(azimuth), -cos(azimuth));
  let water = water_displacement(at, mesh_spacing(radius), true);
  let breaker = breaker_motion(at, water.displacement.y, water.carried.slope);
  let moved = water.displacement + breaker.moved;
  let flat = at + moved.xz;
  let drop = dot(flat, flat) / (2.0 * FRAME_EARTH_RADIUS_M);
  let place = vec3f(flat.x, moved.y - drop - frame.eye_height_m, flat.y);
  let waves = water.carried;
  let slope = waves.slope + breaker.derivatives.slope;
  let stretch = waves.stretch + breaker.derivatives.stretch;
  let shear = waves.shear + breaker.derivatives.shear;
  mesh_vertices[vertex] = MeshVertex(
    place, 0.5 * (shear.x + shear.y), at, pack2x16float(slope), pack2x16float(stretch));
}
