// Lights the water once per pixel, after its mesh was drawn into a G-buffer. Triangles about as small as pixels would
// have each pixel lit several times, because GPUs shade quads of pixels.

@group(2) @binding(0) var<storage, read> mesh_vertices: array<MeshVertex>;

struct MeshFragment {
  @builtin(position) clip: vec4f,
  // Undisplaced position (x, z) relative to the point below the eye, m.
  @location(0) undisplaced: vec2f,
  // Shear, and the fraction of the sun's disc that waves leave visible.
  @location(1) shear_and_sun: vec2f,
  // Slope and stretch. They, the shear and the sun are interpolated between the vertices.
  @location(2) slope_and_stretch: vec4f,
}

@vertex
fn mesh_vertex(@builtin(vertex_index) i: u32) -> MeshFragment {
  let v = mesh_vertices[i];
  let clip = frame.clip_from_relative * vec4f(v.position, 1.0);
  let carried = vec4f(unpack2x16float(v.slope), unpack2x16float(v.stretch));
  return MeshFragment(clip, v.undisplaced, unpack2x16float(v.shear_and_sun), carried);
}

// The water that a pixel shows, in 20 bytes (`G_BUFFER_FORMATS` in src/render/targets.rs); its distance is in the depth
// texture.
struct GBuffer {
  // Undisplaced position (x, z) relative to the point below the eye, m.
  @location(0) undisplaced: vec2f,
  // Slope and stretch that the mesh carries.
  @location(1) slope_and_stretch: vec4f,
  // Mean of the two shears that the mesh carries; the longer side of the pixel on the undisplaced sea, m, with the
  // hidden fraction of the sun's disc in its lowest bits (mesh_side_with_sun).
  @location(2) shear_and_side: vec2f,
}

// The lowest bits of a half float that hold the hidden fraction of the sun's disc, as a mask and as the largest value.
// Three bits of the number are left, so that it is rounded up by at most an eighth.
const MESH_SUN_BITS = 127u;
// Mean ratio of a side to its rounded value.
const MESH_SIDE_ROUNDING = 0.95;
// Range of the sides that a G-buffer holds, m: above the smallest normal half float.
const MESH_SIDES_M = vec2f(1.3e-4, 6e4);

// The longer side of a pixel, m, rounded up to a half float whose lowest bits hold the hidden fraction of the sun's
// disc. The side limits the derivatives of the position, so that one that is too large changes nothing within a wave.
fn mesh_side_with_sun(side_m: f32, sun: f32) -> f32 {
  let bits = pack2x16float(vec2f(clamp(side_m, MESH_SIDES_M.x, MESH_SIDES_M.y), 0.0)) + MESH_SUN_BITS;
  return unpack2x16float((bits & ~MESH_SUN_BITS) | u32(f32(MESH_SUN_BITS) * (1.0 - sun) + 0.5)).x;
}

// The longer side of a pixel, m, and the visible fraction of the sun's disc, from mesh_side_with_sun of any sign.
fn mesh_side_and_sun(packed: f32) -> vec2f {
  let bits = pack2x16float(vec2f(abs(packed), 0.0));
  return vec2f(unpack2x16float(bits & ~MESH_SUN_BITS).x, 1.0 - f32(bits & MESH_SUN_BITS) / f32(MESH_SUN_BITS));
}

fn mesh_g_buffer(in: MeshFragment) -> GBuffer {
  let at = in.undisplaced;
  let dx = dpdx(at);
  let dy = dpdy(at);
  let side_m = sqrt(max(dot(dx, dx), dot(dy, dy)));
  let side = mesh_side_with_sun(side_m, in.shear_and_sun.y);
  return GBuffer(at, in.slope_and_stretch, vec2f(in.shear_and_sun.x, side));
}

@fragment
fn mesh_fragment(in: MeshFragment) -> GBuffer {
  return mesh_g_buffer(in);
}

@group(2) @binding(1) var undisplaced_map: texture_2d<f32>;
@group(2) @binding(2) var slope_and_stretch_map: texture_2d<f32>;
@group(2) @binding(3) var shear_and_side_map: texture_2d<f32>;

// One side of a pixel on the undisplaced sea, m: `across`, the way from this pixel's position there to a neighbour's.
// At the edge of a wave the neighbour shows another wave or the sky, so that the way says little. No side is longer
// than `longest_m`.
fn water_pixel_side(across: vec2f, longest_m: f32) -> vec2f {
  return across * min(longest_m * inverseSqrt(max(dot(across, across), 1e-18)), 1.0);
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
  let side_and_sun = mesh_side_and_sun(shear_and_side.y);
  let side_m = side_and_sun.x;
  // Fine derivatives, because coarse ones may come from the other row of a quad of pixels, which may show the sky.
  let dx = frame.footprint_scale * water_pixel_side(dpdxFine(at), side_m);
  let dy = frame.footprint_scale * water_pixel_side(dpdyFine(at), side_m);
  let foot = water_footprint(dx, dy);
  let point = WaterPoint(place, at, water_height_m(place));
  let gust = water_gust_gain(at, foot.length_m);
  var slope: WaterSlope;
  if WATER_SHADOWS && WATER_POINT_SAMPLES {
    shadow_sun_fraction = shadow_visible_sun(at, foot.mean_m);
  } else if WATER_SHADOWS {
    shadow_sun_fraction = side_and_sun.y;
  }
  if WATER_POINT_SAMPLES {
    // Slopes interpolated between the vertices are linear there; a sample needs the slope at its point.
    let mesh_slope = textureLoad(slope_and_stretch_map, pixel, 0).xy;
    let breaker = breaker_motion(at, point.height, mesh_slope, surf_motion(at));
    slope = water_slope_with_carried(at, water_moved(point), foot, foot, breaker.derivatives, false, gust);
  } else {
    let mesh = textureLoad(slope_and_stretch_map, pixel, 0);
    let carried = WaterDerivatives(mesh.xy, mesh.zw, shear_and_side.xx);
    slope = water_slope_with_carried(at, water_moved(point), foot, foot, carried, true, gust);
  }
  if WATER_DIVES {
    // Between vertices, the rim of a crest right before the lens may be turned away from the eye.
    let facing = dot(slope.mean, place.xz) - place.y - 0.02 * length(place);
    slope.mean -= place.xz * (min(facing, 0.0) / max(dot(place.xz, place.xz), 1e-6));
  }
  return water_radiance(point, foot, slope, gust, vec2u(pixel));
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
  // Waves cast no shadows in the lean tier.
  let side_m = MESH_SIDE_ROUNDING * abs(shear_and_side.y);
  return lean_radiance(WaterPoint(place, at, water_height_m(place)), side_m, carried);
}
