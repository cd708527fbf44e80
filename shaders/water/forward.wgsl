// The sea lit while its mesh is drawn: where a pixel has several samples, and for the samples of a reference.

struct WaterVertex {
  @builtin(position) clip: vec4f,
  // Relative to the eye.
  @location(0) place: vec3f,
  // The undisplaced point, and the height of the wave.
  @location(1) rest: vec3f,
}

@group(2) @binding(0) var<storage, read> mesh_vertices: array<MeshVertex>;

fn water_vertex(i: u32) -> WaterVertex {
  let v = mesh_vertices[i];
  return WaterVertex(frame.clip_from_relative * vec4f(v.place, 1.0), v.place, vec3f(v.rest.x, v.height, v.rest.y));
}

@vertex
fn vertex(@builtin(vertex_index) i: u32) -> WaterVertex {
  return water_vertex(i);
}

@fragment
fn fragment(in: WaterVertex) -> @location(0) vec4f {
  let at = in.rest.xz;
  let dx = dpdx(at) * frame.footprint;
  let dy = dpdy(at) * frame.footprint;
  let foot = water_footprint(dx, dy);
  let slope = water_slope(at, foot);
  let bent = water_bent(slope, dpdx(slope.mean), dpdy(slope.mean), dot(dx, dx) > dot(dy, dy));
  return water_light(WaterPoint(in.place, in.rest, dx, dy), foot, bent);
}
