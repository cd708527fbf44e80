// Lights the water once per pixel, after its mesh was drawn into a G-buffer. Triangles about as small as pixels would
// have each pixel lit several times, because GPUs shade quads of pixels.

@group(2) @binding(0) var<storage, read> mesh_vertices: array<MeshVertex>;

struct MeshFragment {
  @builtin(position) clip: vec4f,
  // Undisplaced position (x, z) relative to the point below the eye, m, and shear.
  @location(0) undisplaced_and_shear: vec3f,
  // Slope and stretch. They and the shear are interpolated between the vertices.
  @location(1) slope_and_stretch: vec4f,
}

@vertex
fn mesh_vertex(@builtin(vertex_index) i: u32) -> MeshFragment {
  let v = mesh_vertices[i];
  let clip = frame.clip_from_relative * vec4f(v.position, 1.0);
  let carried = vec4f(unpack2x16float(v.slope), unpack2x16float(v.stretch));
  return MeshFragment(clip, vec3f(v.undisplaced, v.shear), carried);
}

// The water that a pixel shows, in 20 bytes (`G_BUFFER_FORMATS` in src/render/targets.rs); its distance is in the depth
// texture.
struct GBuffer {
  // Undisplaced position (x, z) relative to the point below the eye, m.
  @location(0) undisplaced: vec2f,
  // Slope and stretch that the mesh carries.
  @location(1) slope_and_stretch: vec4f,
  // Mean of the two shears that the mesh carries, and the longer side of the pixel on the undisplaced sea, m.
  @location(2) shear_and_side: vec2f,
}

fn mesh_g_buffer(in: MeshFragment) -> GBuffer {
  let at = in.undisplaced_and_shear.xy;
  let dx = dpdx(at);
  let dy = dpdy(at);
  let side_m = min(sqrt(max(dot(dx, dx), dot(dy, dy))), 6e4);
  return GBuffer(at, in.slope_and_stretch, vec2f(in.undisplaced_and_shear.z, side_m));
}

@fragment
fn mesh_fragment(in: MeshFragment) -> GBuffer {
  return mesh_g_buffer(in);
}

@group(2) @binding(1) var undisplaced_map: texture_2d<f32>;
@group(2) @binding(2) var slope_and_stretch_map: texture_2d<f32>;
@group(2) @binding(3) var shear_and_side_map: texture_2d<f32>;

// Difference of the undisplaced position between neighbouring pixels, relative to the longer side of the pixel, above
// which they show different waves.
const WATER_PIXEL_JUMP = 1.5;

// Side of a pixel on the undisplaced sea, m, and whether the neighbour in the pixel's quad shows the same wave.
struct WaterPixelSide {
  side: vec2f,
  is_smooth: bool,
}

// The side of a pixel to the neighbour whose undisplaced position differs by `across`, m. At the edge of a wave the
// neighbour shows another wave or the sky, so that the difference says little. No side is longer than `longest_m`.
fn water_pixel_side(across: vec2f, longest_m: f32) -> WaterPixelSide {
  let square = dot(across, across);
  let most_m = WATER_PIXEL_JUMP * longest_m;
  return WaterPixelSide(across * min(longest_m * inverseSqrt(max(square, 1e-18)), 1.0), square < most_m * most_m);
}

// Whether the eye dives: the G-buffer then has a negative side where it shows the water from below (under.wgsl).
override WATER_DIVES: bool = false;

@fragment
fn light_fragment(in: LightFragment) -> @location(0) vec4f {
  let pixel = vec2i(in.clip.xy);
  let place = lit_position(in.ray, pixel);
  let at = textureLoad(undisplaced_map, pixel, 0).xy;
  if WATER_LAND && at.x > LAND_NO_WATER_M {
    discard;
  }
  let shear_and_side = textureLoad(shear_and_side_map, pixel, 0).xy;
  let side_m = abs(shear_and_side.y);
  // Fine derivatives, because coarse ones may come from the other row of a quad of pixels, which may show the sky.
  let x = water_pixel_side(dpdxFine(at), side_m);
  let y = water_pixel_side(dpdyFine(at), side_m);
  let dx = frame.footprint_scale * x.side;
  let dy = frame.footprint_scale * y.side;
  let foot = water_footprint(dx, dy);
  let point = WaterPoint(place, at, water_height_m(place));
  let gust = water_gust_gain(at, foot.length_m);
  var slope: WaterSlope;
  if WATER_POINT_SAMPLES {
    // Slopes interpolated between the vertices are linear there; a sample needs the slope at its point.
    let breaker = breaker_motion(at, point.height, textureLoad(slope_and_stretch_map, pixel, 0).xy);
    slope = water_slope_with_carried(at, water_moved(point), foot, foot, breaker.derivatives, false, gust);
  } else {
    let mesh = textureLoad(slope_and_stretch_map, pixel, 0);
    let carried = WaterDerivatives(mesh.xy, mesh.zw, shear_and_side.xx);
    slope = water_slope_with_carried(at, water_moved(point), foot, foot, carried, true, gust);
  }
  // If a neighbouring pixel shows another wave or the sky, the difference is not a change of slope within this pixel.
  let bend_x = select(vec2f(0.0), dpdxFine(slope.mean), x.is_smooth);
  let bend_y = select(vec2f(0.0), dpdyFine(slope.mean), y.is_smooth);
  var bent = water_add_slope_change(slope, bend_x, bend_y, dot(dx, dx) > dot(dy, dy));
  if WATER_DIVES {
    // Between vertices, the rim of a crest right before the lens may be turned away from the eye.
    let facing = dot(bent.mean, place.xz) - place.y - 0.02 * length(place);
    bent.mean -= place.xz * (min(facing, 0.0) / max(dot(place.xz, place.xz), 1e-6));
  }
  return water_radiance(point, foot, bent, gust, vec2u(pixel));
}

@fragment
fn lean_fragment(in: LightFragment) -> @location(0) vec4f {
  let pixel = vec2i(in.clip.xy);
  let place = lit_position(in.ray, pixel);
  let at = textureLoad(undisplaced_map, pixel, 0).xy;
  if WATER_LAND && at.x > LAND_NO_WATER_M {
    discard;
  }
  let shear_and_side = textureLoad(shear_and_side_map, pixel, 0).xy;
  let mesh = textureLoad(slope_and_stretch_map, pixel, 0);
  let carried = WaterDerivatives(mesh.xy, mesh.zw, shear_and_side.xx);
  return lean_radiance(WaterPoint(place, at, water_height_m(place)), abs(shear_and_side.y), carried);
}
