// The amplitude h0 e^(-i w t) of each wave that a coast transforms, at the time of the maps.

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<uniform> coast: Coast;
@group(0) @binding(2) var<storage, read> waves: array<u32>;
@group(0) @binding(3) var<storage, read> h0: array<vec2f>; // [cascade][iz][ix]
@group(0) @binding(4) var<storage, read> wave_table: array<vec2u>; // cycles per period, bits of orbit ratio / |k|
@group(0) @binding(5) var<storage, read_write> phasors: array<vec4f>; // amplitude (xy), orbit ratio / |k| (z)

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if id.x >= coast.wave_count {
    return;
  }
  let index = coast_lattice_index(waves[id.x]);
  let a = sea.amplitude_factors[0] * h0[coast_lattice_place(index, coast.n)];
  let entry = wave_table[sea_wave_table_entry(index.x, index.y)];
  let cs = maths_cos_sin(entry.x * sea.period_fraction_u32);
  phasors[id.x] = vec4f(a.x * cs.x + a.y * cs.y, a.y * cs.x - a.x * cs.y, bitcast<f32>(entry.y), 0.0);
}
