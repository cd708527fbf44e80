// Lights the water once per pixel, after its mesh was drawn into a G-buffer. Triangles about as small as pixels would
// have each pixel lit several times, because GPUs shade quads of pixels.

@group(2) @binding(0) var<storage, read> mesh_vertices: array<MeshVertex>;

struct MeshFragment {
  @builtin(position) clip: vec4f,
  @location(0) position: vec3f,
  // Undisplaced position (x, z) relative to the point below the eye, m, and height of the wave, m.
  @location(1) undisplaced: vec3f,
  // Slope and stretch, interpolated between the vertices.
  @location(2) carried: vec4f,
  @location(3) shear: vec2f,
}

@vertex
fn mesh_vertex(@builtin(vertex_index) i: u32) -> MeshFragment {
  let v = mesh_vertices[i];
  let clip = frame.clip_from_relative * vec4f(v.position, 1.0);
  return MeshFragment(clip, v.position, vec3f(v.undisplaced, v.height), vec4f(v.slope, v.stretch), v.shear);
}

// The water that a pixel shows, in 32 bytes: the most that WebGPU guarantees a pass to write per pixel.
struct GBuffer {
  // The undisplaced position (x, z) and the distance from the eye, m, as floats; the height of the wave and the mean of
  // the two interpolated shears as half floats.
  @location(0) point: vec4u,
  // As half floats: sides of the pixel on the undisplaced sea, m; interpolated slope and stretch.
  @location(1) slopes: vec4u,
}

@fragment
fn mesh_fragment(in: MeshFragment) -> GBuffer {
  let sides = clamp(vec4f(dpdx(in.undisplaced.xy), dpdy(in.undisplaced.xy)), vec4f(-6e4), vec4f(6e4));
  let height = pack2x16float(vec2f(in.undisplaced.z, 0.5 * (in.shear.x + in.shear.y)));
  return GBuffer(
    vec4u(bitcast<vec3u>(vec3f(in.undisplaced.xy, length(in.position))), height),
    vec4u(
      pack2x16float(sides.xy), pack2x16float(sides.zw),
      pack2x16float(in.carried.xy), pack2x16float(in.carried.zw)));
}

@group(2) @binding(0) var point_map: texture_2d<u32>;
@group(2) @binding(1) var slopes_map: texture_2d<u32>;

// Whether the adapter is a software rasterizer.
override SOFTWARE_ADAPTER: bool = false;

fn water_unpack_pixel_sides(packed: vec4u) -> vec4f {
  return vec4f(unpack2x16float(packed.x), unpack2x16float(packed.y));
}

// Footprint sides of the first pixel of a 2 x 2 quad, if they are close to the pixel's own. A software rasterizer
// samples a map for a whole quad at once if all its pixels use the same mip level.
fn water_quad_pixel_sides(pixel: vec2i, own: vec4f) -> vec4f {
  let first = water_unpack_pixel_sides(textureLoad(slopes_map, pixel & vec2i(-2), 0));
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
  // The depth lies behind all water and before the sky, so that the depth test leaves the pixels that show water.
  return LightFragment(vec4f(at, 1e-30, 1.0), frame.forward + frame.right * at.x + frame.up * at.y);
}

@fragment
fn light_fragment(in: LightFragment) -> @location(0) vec4f {
  let pixel = vec2i(in.clip.xy);
  let point = textureLoad(point_map, pixel, 0);
  let packed = textureLoad(slopes_map, pixel, 0);
  var sides = water_unpack_pixel_sides(packed);
  if SOFTWARE_ADAPTER {
    sides = water_quad_pixel_sides(pixel, sides);
  }
  let dx = frame.footprint_scale * sides.xy;
  let dy = frame.footprint_scale * sides.zw;
  let at = bitcast<vec2f>(point.xy);
  let height = unpack2x16float(point.w);
  let foot = water_footprint(dx, dy);
  var slope: WaterSlope;
  if WATER_POINT_SAMPLES {
    // Slopes interpolated between the vertices are linear there; a sample needs the slope at its point.
    slope = water_slope(at, foot);
  } else {
    let carried = WaterDerivatives(unpack2x16float(packed.z), unpack2x16float(packed.w), height.yy);
    slope = water_slope_with_carried(at, foot, foot, carried, true);
  }
  // If a neighbouring pixel shows another wave, the difference is not a change of slope within this pixel.
  let off_x = abs(dpdx(at) - dx);
  let off_y = abs(dpdy(at) - dy);
  let bend_x = select(vec2f(0.0), dpdx(slope.mean), off_x.x + off_x.y < 0.5 * length(dx));
  let bend_y = select(vec2f(0.0), dpdy(slope.mean), off_y.x + off_y.y < 0.5 * length(dy));
  let bent = water_add_slope_change(slope, bend_x, bend_y, dot(dx, dx) > dot(dy, dy));
  let place = normalize(in.ray) * bitcast<f32>(point.z);
  return water_radiance(WaterPoint(place, at, height.x), foot, bent);
}
