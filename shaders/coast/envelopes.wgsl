// Sums the waves of each group at each point of a coast's grid, as envelopes against the group's carrier: of the
// elevation, and of the potential whose gradient is the horizontal displacement. A thread has one point and one group.

@group(0) @binding(0) var<uniform> coast: Coast;
@group(0) @binding(1) var<storage, read> phasors: array<vec4f>; // amplitude (xy), orbit ratio / |k| (z)
@group(0) @binding(2) var<storage, read> transfer: array<u32>; // [wave][row][column], two half floats
@group(0) @binding(3) var<storage, read> groups: array<vec4u>; // first wave, number of waves
@group(0) @binding(4) var envelopes: texture_storage_2d_array<rgba16float, write>; // layer: group

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let points = coast.columns * coast.rows;
  if id.x >= points {
    return;
  }
  let of_group = groups[id.z];
  var elevation = vec2f(0.0);
  var potential = vec2f(0.0);
  for (var i = 0u; i < of_group.y; i++) {
    let wave = of_group.x + i;
    let phasor = phasors[wave];
    let here = maths_complex_mul(phasor.xy, unpack2x16float(transfer[wave * points + id.x]));
    elevation += here;
    potential += phasor.z * here;
  }
  textureStore(
    envelopes, vec2u(id.x % coast.columns, id.x / coast.columns), id.z, vec4f(elevation, potential));
}
