// Quantities of the drawn surface as false colours. They are drawn with the mesh, not afterwards per pixel as the light
// is: the wireframe needs the columns and rows of the vertices, which the G-buffer does not hold.

@group(2) @binding(0) var<storage, read> mesh_vertices: array<MeshVertex>;
@group(3) @binding(0) var<uniform> view: View;

struct SurfaceFragment {
  @builtin(position) clip: vec4f,
  // Position relative to the eye, m.
  @location(0) position: vec3f,
  // Undisplaced position (x, z) relative to the point below the eye, m.
  @location(1) undisplaced: vec2f,
  // Column and row of the vertex in the mesh.
  @location(2) lattice: vec2f,
  // Slope that the mesh carries.
  @location(3) slope: vec2f,
}

@vertex
fn vertex(@builtin(vertex_index) i: u32) -> SurfaceFragment {
  let v = mesh_vertices[i];
  let lattice = vec2f(f32(i / frame.mesh_lattice.rows), f32(i % frame.mesh_lattice.rows));
  let clip = frame.clip_from_relative * vec4f(v.position, 1.0);
  return SurfaceFragment(clip, v.position, v.undisplaced, lattice, unpack2x16float(v.slope));
}

// Coverage of a pixel, 0 to 1, by lines one pixel wide at the integers of `at`, which changes by `width` over it.
fn view_line_coverage(at: vec3f, width: vec3f) -> f32 {
  let pixels = abs(fract(at - 0.5) - 0.5) / max(width, vec3f(1e-6));
  // Lines closer than two pixels blend into a tint.
  let line = mix(
    clamp(1.0 - pixels, vec3f(0.0), vec3f(1.0)), min(width, vec3f(1.0)), smoothstep(vec3f(0.3), vec3f(0.6), width));
  return max(line.x, max(line.y, line.z));
}

// Fraction of a pixel's light that comes from foam, 0 to 1.
fn view_foam_cover(at: vec2f, foot: WaterFootprint) -> f32 {
  let level = foam_level(at, foot);
  return select(0.0, foam_appearance(at, foot, level).cover, level.cover >= FOAM_MIN_AMOUNT);
}

@fragment
fn fragment(in: SurfaceFragment) -> @location(0) vec4f {
  let at = in.undisplaced;
  let foot = water_footprint(dpdx(at), dpdy(at));
  let facet = normalize(cross(dpdy(in.position), dpdx(in.position)));
  // Edges of triangles lie at integer columns, rows, and sums of both, which are the diagonals.
  let edges = vec3f(in.lattice, in.lattice.x + in.lattice.y);
  let width = fwidth(edges);
  let tile = view.tiles[0];
  let point = WaterPoint(in.position, at, water_height_m(in.position));
  let breaker = breaker_motion(at, point.height, in.slope, surf_motion(at));
  let slope = water_slope_with_carried(at, water_moved(point), foot, foot, breaker.derivatives, false, 1.0);
  switch view.view_kind {
    case 1u: {
      let n = water_normal(slope.mean);
      return vec4f(0.5 + 0.5 * vec3f(n.x, -n.z, n.y), 1.0);
    }
    case 2u: { return view_colour(slope.jacobian, tile); }
    case 3u: { return view_colour(slope.variance.x + slope.variance.y, tile); }
    case 4u: {
      return view_colour(foot.log_texel_m + frame.cascades[tile.layer].log_texels_per_m, tile);
    }
    case 5u: { return view_colour(view_foam_cover(at, foot), tile); }
    default: {
      let fill = vec3f(0.05, 0.12, 0.17) * (0.4 + 0.6 * abs(dot(facet, vec3f(0.48, 0.8, 0.36))));
      return vec4f(mix(fill, vec3f(0.62, 0.88, 0.94), 0.8 * view_line_coverage(edges, width)), 1.0);
    }
  }
}
