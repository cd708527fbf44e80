// Displaces the vertices of the water mesh.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> mesh_vertices: array<MeshVertex>;

// Whether waves shade each other; `waves_cast_shadows` in src/render/water/light.rs tells when they do.
override WATER_SHADOWS: bool = false;
// Width of a pixel's footprint over which shadows are averaged, relative to its length on the sea.
const DISPLACE_SHADOW_WIDTH = 0.7;

// Height of the lobes in which water runs up the land, relative to the run-up, and the highest run-up that counts, m.
const DISPLACE_LOBES = 0.08;
const DISPLACE_LOBES_RUN_UP_M = 0.8;
// Lengths of the lobes along the edge of the water, m, their shares, and how much longer they are across it.
const DISPLACE_LOBES_M = vec3f(12.7, 5.3, 2.1);
const DISPLACE_LOBE_SHARES = vec3f(0.28, 0.42, 0.3);
const DISPLACE_LOBE_STRETCH = 2.2;

// Rows of arcs, 0 to 1 high, that meet in cusps at whole numbers.
fn displace_arcs(x: vec3f) -> vec3f {
  let off = 2.0 * fract(x) - 1.0;
  return 1.0 - off * off;
}

// Height, m, that the lobes of the swash add to the water at a position relative to the point below the eye, m, where
// vertices are `spacing` metres apart. The edge of water that runs up a beach is a row of tongues, which are round
// ahead and meet in cusps; the waves of the maps are too long to shape them. Lobes lie where the water is so shallow
// that short waves have ended.
fn displace_lobes_m(at: vec2f, spacing: f32) -> f32 {
  let gains = coast_at(at);
  let share = gains.z * maths_smooth(1.1 - 2.6 * gains.x) * maths_smooth(2.0 - spacing);
  if share * gains.w <= 0.0 {
    return 0.0;
  }
  // Lobes are fixed to the world, so that the edge changes its shape as it runs over them.
  let place = coast_place(at);
  let onshore = unpack2x16snorm(frame.breaker_direction);
  let side = dot(place, vec2f(-onshore.y, onshore.x));
  let across = dot(place, onshore) * (1.0 / DISPLACE_LOBE_STRETCH);
  let bent = displace_arcs(vec3f(0.031, 0.047, 0.083) * side + vec3f(0.11, -0.07, 0.19) * across);
  let arcs = displace_arcs((side + vec3f(6.0, 4.0, 1.7) * bent + 0.6 * across) / DISPLACE_LOBES_M);
  let height = dot(DISPLACE_LOBE_SHARES, arcs) * (0.4 + 0.9 * bent.y) - 0.66;
  return DISPLACE_LOBES * min(gains.w, DISPLACE_LOBES_RUN_UP_M) * share * height;
}

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
  let spacing = mesh_spacing(radius);
  let water = water_displacement(at, spacing, true);
  let surf = surf_motion(at);
  let breaker = breaker_motion(
    at, water.displacement.y + surf.moved.y, water.carried.slope + surf.derivatives.slope, surf);
  var moved = water.displacement + breaker.moved;
  if WATER_COAST {
    moved.y += displace_lobes_m(at, spacing);
  }
  let flat = at + moved.xz;
  let drop = dot(flat, flat) / (2.0 * FRAME_EARTH_RADIUS_M);
  let place = vec3f(flat.x, moved.y - drop - frame.eye_height_m, flat.y);
  let waves = water.carried;
  let slope = waves.slope + breaker.derivatives.slope;
  let stretch = waves.stretch + breaker.derivatives.stretch;
  let shear = waves.shear + breaker.derivatives.shear;
  var sun = 1.0;
  if WATER_SHADOWS {
    sun = shadow_visible_sun(at, max(spacing, DISPLACE_SHADOW_WIDTH * water_pixel_length_m(at)));
  }
  let shear_and_sun = vec2f(0.5 * (shear.x + shear.y), sun);
  mesh_vertices[vertex] = MeshVertex(
    place, pack2x16float(shear_and_sun), at, pack2x16float(slope), pack2x16float(stretch));
}
