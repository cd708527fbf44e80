// Blends shifted copies of a patch, so that it does not repeat visibly. src/waves/tiling.rs explains the method.

// The struct `TileLatticePosition` (src/sim/maps.rs) is the triangle lattice of a patch relative to one point.

// Barycentric coordinate above which a copy of the patch is visible.
const TILE_VISIBLE_FROM = 0.25;
// Number of copies that a point may see, one for each corner of its triangle. A hidden copy has the weight 0.
const TILE_COPIES = 3u;

// The copies of a patch that contribute to a point: corner of the lattice, weight W, and, if wanted, derivatives of W
// along the two coordinates of the lattice. The x components belong to the current copy; `tile_next_copy` goes on to
// the next one.
struct TileBlend {
  weight: vec3f,
  along_u: vec3f,
  along_v: vec3f,
  // The copies' corners of the lattice cell `cell`, counted from the opposite corner in its upper triangle.
  corner_x: vec3i,
  corner_z: vec3i,
  cell: vec2i,
  is_upper: bool,
}

// The copies of the patch at the point that lies at the offset `at`, m, from the point of `position`. The derivatives
// of the weights are 0 unless they are wanted.
fn tile_blend(position: TileLatticePosition, at: vec2f, wants_derivatives: bool) -> TileBlend {
  let q = position.fraction + vec2f(dot(position.gradient_u, at), dot(position.gradient_v, at));
  let whole = floor(q);
  let rest = q - whole;
  // A lattice cell has two triangles. The upper one is the lower one, counted back from the opposite vertex.
  let upper = rest.x + rest.y > 1.0;
  let f = select(rest, 1.0 - rest, upper);
  let raw = max(vec3f(1.0 - f.x - f.y, f) - TILE_VISIBLE_FROM, vec3f(0.0));
  let w = raw * raw;
  let norm = inverseSqrt(dot(w, w));
  var out: TileBlend;
  out.weight = w * norm;
  out.corner_x = vec3i(0, 1, 0);
  out.corner_z = vec3i(0, 0, 1);
  out.cell = position.cell + vec2i(whole);
  out.is_upper = upper;
  if position.shift_step == 0.0 {
    out.weight = vec3f(1.0, 0.0, 0.0);
  } else if wants_derivatives {
    // Half the derivatives of w: the barycentric coordinates have the gradients (-1, -1), (1, 0) and (0, 1) in the
    // lower triangle, and the opposite ones in the upper one.
    let slope = select(raw, -raw, upper);
    let pull = (norm * norm) * vec2f(w.y * slope.y - w.x * slope.x, w.z * slope.z - w.x * slope.x);
    out.along_u = (2.0 * norm) * (vec3f(-slope.x, slope.y, 0.0) - w * pull.x);
    out.along_v = (2.0 * norm) * (vec3f(-slope.x, 0.0, slope.z) - w * pull.y);
  }
  return out;
}

// Rotates the next copy into the x components. Vectors indexed by a variable would not stay in registers.
fn tile_next_copy(blend: TileBlend) -> TileBlend {
  return TileBlend(
    blend.weight.yzx, blend.along_u.yzx, blend.along_v.yzx, blend.corner_x.yzx, blend.corner_z.yzx, blend.cell,
    blend.is_upper);
}

// Derivatives dW/dx and dW/dz of the weight of the current copy, 1/m.
fn tile_weight_gradient(position: TileLatticePosition, blend: TileBlend) -> vec2f {
  return blend.along_u.x * position.gradient_u + blend.along_v.x * position.gradient_v;
}

// Shift of the current copy in texture coordinates: a multiple of 1/64, which is a whole number of texels for every n.
fn tile_copy_shift(position: TileLatticePosition, blend: TileBlend) -> vec2f {
  let corner = vec2i(blend.corner_x.x, blend.corner_z.x);
  let cell = bitcast<vec2u>(blend.cell + select(corner, 1 - corner, blend.is_upper));
  return vec2f(noise_pcg4d(vec4u(cell, position.shift_key, 0u)).xy >> vec2u(26u)) * position.shift_step;
}
