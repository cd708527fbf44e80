// Moves the amplitudes h0 of the waves that a coast transforms from the first cascade to a lattice of their own. Before,
// the target of the former holds all amplitudes, and that of the latter holds zeros.

@group(0) @binding(0) var<uniform> coast: Coast;
@group(0) @binding(1) var<storage, read> waves: array<u32>;
@group(0) @binding(2) var<storage, read> h0: array<vec2f>; // [cascade][iz][ix]
@group(0) @binding(3) var<storage, read_write> other_h0: array<vec2f>; // [cascade][iz][ix]
@group(0) @binding(4) var<storage, read_write> offshore_h0: array<vec2f>; // [iz][ix]

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if id.x < coast.wave_count {
    let place = coast_lattice_place(coast_lattice_index(waves[id.x]), coast.n);
    offshore_h0[place] = h0[place];
    other_h0[place] = vec2f(0.0);
  }
}
