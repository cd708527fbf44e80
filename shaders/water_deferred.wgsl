// The sea lit once a pixel, after its mesh was drawn: triangles about as small as a pixel would have each pixel lit several
// times. Joined to all of the water's parts.

@group(2) @binding(0) var<storage, read> mesh_vertices: array<MeshVertex>;

struct MeshFragment {
  @builtin(position) clip: vec4f,
  @location(0) place: vec3f,
  @location(1) rest: vec3f,
}

@vertex
fn mesh_vertex(@builtin(vertex_index) i: u32) -> MeshFragment {
  let v = mesh_vertices[i];
  return MeshFragment(frame.clip_from_relative * vec4f(v.place, 1.0), v.place, vec3f(v.rest.x, v.height, v.rest.y));
}

// What of the water a pixel shows.
struct MeshShown {
  // The undisplaced point, the height of the wave, the distance from the eye.
  @location(0) point: vec4f,
  // Sides of the pixel on the undisplaced sea.
  @location(1) sides: vec4f,
}

@fragment
fn mesh_fragment(in: MeshFragment) -> MeshShown {
  let sides = vec4f(dpdx(in.rest.xz), dpdy(in.rest.xz));
  return MeshShown(vec4f(in.rest.xz, in.rest.y, length(in.place)), clamp(sides, vec4f(-6e4), vec4f(6e4)));
}

@group(2) @binding(0) var point_map: texture_2d<f32>;
@group(2) @binding(1) var sides_map: texture_2d<f32>;

// Sides of a pixel as the first of its quad has them, unless that one is much another's: pixels that read their maps at one
// level read them together on a software GPU, which takes a quarter of the time.
fn water_shared_sides(pixel: vec2i) -> vec4f {
  let own = textureLoad(sides_map, pixel, 0);
  let first = textureLoad(sides_map, pixel & vec2i(-2), 0);
  let off = first - own;
  let is_like = dot(off.xy, off.xy) < 0.1 * dot(own.xy, own.xy) && dot(off.zw, off.zw) < 0.1 * dot(own.zw, own.zw);
  return select(own, first, is_like);
}

struct LightFragment {
  @builtin(position) clip: vec4f,
  @location(0) ray: vec3f,
}

@vertex
fn light_vertex(@builtin(vertex_index) i: u32) -> LightFragment {
  let at = vec2f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
  // Farther than any water, nearer than the sky: the depth test leaves the pixels that show water.
  return LightFragment(vec4f(at, 1e-30, 1.0), frame.forward + frame.right * at.x + frame.up * at.y);
}

@fragment
fn light_fragment(in: LightFragment) -> @location(0) vec4f {
  let pixel = vec2i(in.clip.xy);
  let shown = textureLoad(point_map, pixel, 0);
  let sides = water_shared_sides(pixel);
  let at = shown.xy;
  let foot = water_footprint(sides.xy, sides.zw);
  let slope = water_slope(at, foot);
  // A neighbour that shows other water says nothing of how the slope changes here.
  let off_x = abs(dpdx(at) - sides.xy);
  let off_y = abs(dpdy(at) - sides.zw);
  let bend_x = select(vec2f(0.0), dpdx(slope.mean), off_x.x + off_x.y < 0.5 * length(sides.xy));
  let bend_y = select(vec2f(0.0), dpdy(slope.mean), off_y.x + off_y.y < 0.5 * length(sides.zw));
  let bent = water_bent(slope, bend_x, bend_y, dot(sides.xy, sides.xy) > dot(sides.zw, sides.zw));
  let place = normalize(in.ray) * shown.w;
  return water_light(WaterPoint(place, vec3f(at.x, shown.z, at.y), sides.xy, sides.zw), foot, bent);
}
