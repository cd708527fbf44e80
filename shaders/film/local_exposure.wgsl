// How bright the picture is in each of a few cells: mean of the binary logarithms of the luminances of samples.

@group(0) @binding(0) var source_map: texture_2d<f32>;
@group(0) @binding(1) var cells_out: texture_storage_2d<rgba16float, write>;

// Threads in each direction of a workgroup, which fills one cell, and samples in each direction of a thread.
const LOCAL_THREADS = 16u;
const LOCAL_SAMPLES = 2u;
// Least luminance that counts, so that the logarithm of black is finite.
const LOCAL_DARKEST = 1e-8;

var<workgroup> local_sums: array<f32, 256>;

@compute @workgroup_size(16, 16)
fn main(
  @builtin(workgroup_id) cell: vec3u, @builtin(local_invocation_id) thread: vec3u,
  @builtin(local_invocation_index) index: u32,
) {
  let size = vec2f(textureDimensions(source_map));
  let cell_size = size / vec2f(textureDimensions(cells_out));
  var sum = 0.0;
  for (var i = 0u; i < LOCAL_SAMPLES * LOCAL_SAMPLES; i++) {
    let place = thread.xy * LOCAL_SAMPLES + vec2u(i % LOCAL_SAMPLES, i / LOCAL_SAMPLES);
    let share = (vec2f(place) + 0.5) / f32(LOCAL_THREADS * LOCAL_SAMPLES);
    let at = min((vec2f(cell.xy) + share) * cell_size, size - 1.0);
    sum += log2(max(sky_luminance(textureLoad(source_map, vec2u(at), 0).rgb), LOCAL_DARKEST));
  }
  local_sums[index] = sum;
  for (var half = 128u; half > 0u; half /= 2u) {
    workgroupBarrier();
    if index < half {
      local_sums[index] += local_sums[index + half];
    }
  }
  if index == 0u {
    let mean = local_sums[0] / f32(256u * LOCAL_SAMPLES * LOCAL_SAMPLES);
    textureStore(cells_out, cell.xy, vec4f(mean, 0.0, 0.0, 1.0));
  }
}
