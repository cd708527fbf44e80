// Column pass for GPUs: the inverse FFT along z, and the maps with a layer for each cascade, in one dispatch.
//   displacement: Dx, height eta, Dz, dDx/dz     gradients: d eta/dx, d eta/dz, dDx/dx, dDz/dz     (without choppiness)

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<storage, read> twiddle_factors: array<vec2f>; // twiddle factors e^(2 pi i j / 1024)
@group(0) @binding(2) var<storage, read_write> row_transforms: array<vec4f>; // [cascade][pair][z][x]
@group(0) @binding(3) var maps: texture_storage_2d_array<rgba16float, write>; // a third of the layers for each kind

// Stores a texel of the displacement map. The components of v are Dx, Dz, eta, dDx/dz.
fn columns_store_displacement(c: u32, x: u32, z: u32, v: vec4f) {
  textureStore(maps, vec2u(x, z), sea.first_layer + c, v.xzyw);
  if sea.keeps_f32_maps != 0u {
    row_transforms[(2u * c * N + z) * N + x] = v.xzyw;
  }
}

// Stores a texel of the gradient map.
fn columns_store_gradients(c: u32, x: u32, z: u32, v: vec4f) {
  textureStore(maps, vec2u(x, z), textureNumLayers(maps) / 3u + sea.first_layer + c, v);
  if sea.keeps_f32_maps != 0u {
    row_transforms[((2u * c + 1u) * N + z) * N + x] = v;
  }
}

// local.x is the column, so that neighbouring threads read neighbouring points; local.y is the thread of a column.
@compute @workgroup_size(LINES_PER_WORKGROUP, RADIX_2)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
  let t = local.y;
  let x = group.x * LINES_PER_WORKGROUP + local.x;
  let c = group.z;
  let exchange = local.x * N;
  for (var pair = 0u; pair < 2u; pair++) {
    let base = (c * 2u + pair) * N * N;
    for (var i = 0u; i < RADIX_1; i++) {
      fft_points[i] = row_transforms[base + (i * RADIX_2 + t) * N + x];
    }
    fft_in_registers(RADIX_1);
    workgroupBarrier();
    for (var k1 = 0u; k1 < RADIX_1; k1++) {
      let w = twiddle_factors[t * k1 * (1024u / N)];
      let point = fft_points[fft_result_index(k1, RADIX_1)];
      fft_exchange[exchange + fft_exchange_index(k1, t)] = fft_complex_mul(point, w);
    }
    workgroupBarrier();
    for (var k1 = t; k1 < RADIX_1; k1 += RADIX_2) {
      for (var n2 = 0u; n2 < RADIX_2; n2++) {
        fft_points[n2] = fft_exchange[exchange + fft_exchange_index(k1, n2)];
      }
      fft_in_registers(RADIX_2);
      for (var k2 = 0u; k2 < RADIX_2; k2++) {
        let v = fft_points[fft_result_index(k2, RADIX_2)];
        if pair == 0u {
          columns_store_displacement(c, x, k1 + RADIX_1 * k2, v);
        } else {
          columns_store_gradients(c, x, k1 + RADIX_1 * k2, v);
        }
      }
    }
  }
}
