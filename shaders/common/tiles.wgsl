// Blends shifted copies of a patch, so that it does not repeat visibly. src/waves/tiling.rs explains the method.

// The struct `TileLatticePosition` (src/sim/maps.rs) is the triangle lattice of a patch relative to one point.

// Barycentric coordinate above which a copy of the patch is visible.
const TILE_VISIBLE_FROM = 0.25;
const TILE_INV_SQRT_3 = 0.57735027;

// The copies of a patch that contribute to a point, strongest first: lattice cell, weight W and derivatives of W. The x
// components belong to the current copy; `tile_next_copy` goes on to the next one.
struct TileBlend {
  count: u32,
  weight: vec3f,
  along_x: vec3f, // dW/dx, 1/m
  along_z: vec3f, // dW/dz, 1/m
  cell_x: vec3i,
  cell_z: vec3i,
}

fn tile_larger_by_x(a: vec3f, b: vec3f) -> vec3f {
  return select(b, a, a.x >= b.x);
}

fn tile_smaller_by_x(a: vec3f, b: vec3f) -> vec3f {
  return select(a, b, a.x >= b.x);
}

// The copies of the patch at the point that lies at the offset `at`, m, from the point of `position`.
fn tile_blend(position: TileLatticePosition, at: vec2f) -> TileBlend {
  let u = position.scaled_rotation + TILE_INV_SQRT_3 * vec2f(position.scaled_rotation.y, -position.scaled_rotation.x);
  let v = 2.0 * TILE_INV_SQRT_3 * vec2f(-position.scaled_rotation.y, position.scaled_rotation.x);
  let q = position.fraction + vec2f(dot(u, at), dot(v, at));
  let whole = floor(q);
  let rest = q - whole;
  // A lattice cell has two triangles. The upper one is the lower one, counted back from the opposite vertex.
  let upper = rest.x + rest.y > 1.0;
  let f = select(rest, 1.0 - rest, upper);
  // Each vector is a barycentric coordinate (x) and its corner (y, z). They are sorted by the coordinate.
  let a = vec3f(1.0 - f.x - f.y, 0.0, 0.0);
  let b = vec3f(f.x, 1.0, 0.0);
  let c = vec3f(f.y, 0.0, 1.0);
  let high = tile_larger_by_x(b, c);
  let low = tile_smaller_by_x(b, c);
  let first = tile_larger_by_x(a, high);
  let rest_high = tile_smaller_by_x(a, high);
  let second = tile_larger_by_x(rest_high, low);
  let third = tile_smaller_by_x(rest_high, low);
  let corner_x = vec3f(first.y, second.y, third.y);
  let corner_z = vec3f(first.z, second.z, third.z);
  let raw = max(vec3f(first.x, second.x, third.x) - TILE_VISIBLE_FROM, vec3f(0.0));
  let w = raw * raw;
  let norm = inverseSqrt(dot(w, w));
  // Gradients of the barycentric coordinates: u and v for the corners (1, 0) and (0, 1), minus both for (0, 0).
  let sign = select(2.0, -2.0, upper);
  let origin = 1.0 - corner_x - corner_z;
  let dx = sign * raw * (corner_x * u.x + corner_z * v.x - origin * (u.x + v.x));
  let dz = sign * raw * (corner_x * u.y + corner_z * v.y - origin * (u.y + v.y));
  let cell = position.cell + vec2i(whole);
  var out: TileBlend;
  out.weight = w * norm;
  out.along_x = norm * dx - out.weight * (dot(w, dx) * norm * norm);
  out.along_z = norm * dz - out.weight * (dot(w, dz) * norm * norm);
  out.cell_x = cell.x + vec3i(select(corner_x, 1.0 - corner_x, upper));
  out.cell_z = cell.y + vec3i(select(corner_z, 1.0 - corner_z, upper));
  out.count = 1u + u32(raw.y > 0.0) + u32(raw.z > 0.0);
  if position.blends_copies == 0u {
    out.count = 1u;
    out.weight = vec3f(1.0, 0.0, 0.0);
    out.along_x = vec3f(0.0);
    out.along_z = vec3f(0.0);
  }
  return out;
}

// Rotates the next copy into the x components. Vectors indexed by a variable would not stay in registers.
fn tile_next_copy(blend: TileBlend) -> TileBlend {
  return TileBlend(
    blend.count, blend.weight.yzx, blend.along_x.yzx, blend.along_z.yzx, blend.cell_x.yzx, blend.cell_z.yzx);
}

// Weight W of the current copy, dW/dx and dW/dz.
fn tile_copy_weight(blend: TileBlend) -> vec3f {
  return vec3f(blend.weight.x, blend.along_x.x, blend.along_z.x);
}

// Shift of the current copy in texture coordinates: a multiple of 1/64, which is a whole number of texels for every n.
fn tile_copy_shift(position: TileLatticePosition, blend: TileBlend) -> vec2f {
  let cell = vec4u(bitcast<u32>(blend.cell_x.x), bitcast<u32>(blend.cell_z.x), position.shift_key, 0u);
  let hash = noise_pcg4d(cell).xy >> vec2u(26u);
  return select(vec2f(0.0), vec2f(hash) * 0.015625, position.blends_copies != 0u);
}
