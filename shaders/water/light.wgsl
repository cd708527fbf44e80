// The water lit once a pixel, after its mesh was drawn into a G-buffer: triangles about as small as a pixel would have each
// pixel lit several times, because GPUs shade quads of pixels.

@group(2) @binding(0) var<storage, read> mesh_vertices: array<MeshVertex>;

struct MeshFragment {
  @builtin(position) clip: vec4f,
  @location(0) place: vec3f,
  @location(1) rest: vec3f,
  @location(2) carried: vec4f,
  @location(3) shear: vec2f,
}

@vertex
fn mesh_vertex(@builtin(vertex_index) i: u32) -> MeshFragment {
  let v = mesh_vertices[i];
  let rest = vec3f(v.rest.x, v.height, v.rest.y);
  return MeshFragment(frame.clip_from_relative * vec4f(v.place, 1.0), v.place, rest, vec4f(v.slope, v.stretch), v.shear);
}

// The water that a pixel shows, in 32 bytes, which is what a pass may write: floats as bits, and pairs of half floats.
struct GBuffer {
  // The undisplaced point and the distance from the eye as floats; the height of the wave and the mean of the shears that
  // the mesh carries as half floats.
  @location(0) point: vec4u,
  // As half floats: sides of the pixel on the undisplaced sea; the slope and the stretch that the mesh carries.
  @location(1) slopes: vec4u,
}

@fragment
fn mesh_fragment(in: MeshFragment) -> GBuffer {
  let sides = clamp(vec4f(dpdx(in.rest.xz), dpdy(in.rest.xz)), vec4f(-6e4), vec4f(6e4));
  let height = pack2x16float(vec2f(in.rest.y, 0.5 * (in.shear.x + in.shear.y)));
  return GBuffer(
    vec4u(bitcast<vec3u>(vec3f(in.rest.xz, length(in.place))), height),
    vec4u(pack2x16float(sides.xy), pack2x16float(sides.zw), pack2x16float(in.carried.xy), pack2x16float(in.carried.zw)));
}

@group(2) @binding(0) var point_map: texture_2d<u32>;
@group(2) @binding(1) var slopes_map: texture_2d<u32>;

fn water_sides(packed: vec4u) -> vec4f {
  return vec4f(unpack2x16float(packed.x), unpack2x16float(packed.y));
}

// Sides of a pixel as the first of its quad has them, unless that one is much another's: pixels that read their maps at one
// level read them together on a software GPU, which takes a quarter of the time.
fn water_shared_sides(pixel: vec2i, own: vec4f) -> vec4f {
  let first = water_sides(textureLoad(slopes_map, pixel & vec2i(-2), 0));
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
  let point = textureLoad(point_map, pixel, 0);
  let packed = textureLoad(slopes_map, pixel, 0);
  let sides = frame.footprint * water_shared_sides(pixel, water_sides(packed));
  let at = bitcast<vec2f>(point.xy);
  let height = unpack2x16float(point.w);
  let carried = WaterSums(unpack2x16float(packed.z), unpack2x16float(packed.w), height.yy);
  let foot = water_footprint(sides.xy, sides.zw);
  var slope: WaterSlope;
  if WATER_SAMPLES {
    // The slopes that the mesh carries are linear between its vertices; a sample needs those of its point.
    slope = water_slope(at, foot);
  } else {
    slope = water_slope_beyond(at, foot, foot, carried, true);
  }
  // A neighbour that shows other water says nothing of how the slope changes here.
  let off_x = abs(dpdx(at) - sides.xy);
  let off_y = abs(dpdy(at) - sides.zw);
  let bend_x = select(vec2f(0.0), dpdx(slope.mean), off_x.x + off_x.y < 0.5 * length(sides.xy));
  let bend_y = select(vec2f(0.0), dpdy(slope.mean), off_y.x + off_y.y < 0.5 * length(sides.zw));
  let bent = water_bent(slope, bend_x, bend_y, dot(sides.xy, sides.xy) > dot(sides.zw, sides.zw));
  let place = normalize(in.ray) * bitcast<f32>(point.z);
  return water_light(WaterPoint(place, vec3f(at.x, height.x, at.y), sides.xy, sides.zw), foot, bent);
}
