// Sums the groups of waves at each texel of a coast's square: elevation, potential of the horizontal displacement, and what
// the rollers and the shape of breaking waves follow from.

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<uniform> coast: Coast;
@group(0) @binding(2) var<storage, read> groups: array<vec4u>; // z: bits of the carrier's turns per metre along y
@group(0) @binding(3) var<storage, read> carriers: array<vec2u>; // [group][column]: turns in 2^-32, bits of those to the next
@group(0) @binding(4) var envelopes: texture_2d_array<f32>; // elevation (xy) and potential (zw); layer: group
@group(0) @binding(5) var points_map: texture_2d<f32>; // set-up, m, reciprocal of breaking height, 1/m, depth, m
@group(0) @binding(6) var clamping_sampler: sampler;
@group(0) @binding(7) var<storage, read_write> fields: array<vec2f>; // [z][x]: elevation, m, and potential, m^2
@group(0) @binding(8) var maps: texture_storage_2d_array<rgba16float, write>;

// The position of a texel in the frame of the coast, m.
fn coast_place(texel: vec2u) -> vec2f {
  let steps = (texel - coast.corner_texel) & vec2u(coast.n - 1u);
  let p = coast.corner + vec2f(steps) * coast.texel_m;
  return vec2f(dot(p, coast.turn), dot(p, vec2f(-coast.turn.y, coast.turn.x)));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let grid = coast_place(id.xy) * coast.inverse_cell;
  let size = vec2f(f32(coast.columns), f32(coast.rows));
  let uv = (clamp(grid, vec2f(0.0), size - 1.0) + 0.5) / size;
  // Beyond the grid, the last envelopes and carriers go on.
  let column = u32(clamp(grid.x, 0.0, size.x - 2.0));
  let beyond = grid.x - f32(column);
  let y_m = grid.y / coast.inverse_cell;
  var z = vec2f(0.0);
  var potential = 0.0;
  for (var g = 0u; g < coast.group_count; g++) {
    let carrier = carriers[g * coast.columns + column];
    let turns = beyond * bitcast<f32>(carrier.y) + y_m * bitcast<f32>(groups[g].z);
    let cs = maths_cos_sin(carrier.x + u32(fract(turns) * 4294967296.0));
    let envelope = textureSampleLevel(envelopes, clamping_sampler, uv, g, 0.0);
    z += maths_complex_mul(envelope.xy, cs);
    potential += envelope.z * cs.x - envelope.w * cs.y;
  }
  let known = textureSampleLevel(points_map, clamping_sampler, uv, 0.0);
  fields[id.y * coast.n + id.x] = vec2f(2.0 * z.x + known.x, 2.0 * potential);
  // The layer behind that of these waves: half of their complex amplitude, m (xy); their height, relative to that from
  // which they break (z); and the depth, m (w). The phase of z falls with time, and is 0 on the crest.
  let layer = sea.first_layer + sea.cascade_count + 2u;
  textureStore(maps, id.xy, layer, vec4f(z, 4.0 * length(z) * known.y, known.z));
}
