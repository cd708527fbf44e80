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

// Stores a texel of the displacement map (pair 0) or of the gradient map (pair 1).
fn columns_store(c: u32, pair: u32, x: u32, z: u32, v: vec4f) {
  if pair == 0u {
    columns_store_displacement(c, x, z, v);
  } else {
    columns_store_gradients(c, x, z, v);
  }
}

// local.x is the column, so that neighbouring threads read neighbouring points; local.y is the thread of a column.
@compute @workgroup_size(LINES_PER_WORKGROUP, THREADS_PER_LINE)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
  let x = group.x * LINES_PER_WORKGROUP + local.x;
  let c = group.z;
  let za = local.y;
  let zb = za + N / 4u;
  let zc = za + N / 2u;
  let zd = zc + N / 4u;
  for (var pair = 0u; pair < 2u; pair++) {
    let column = (c * 2u + pair) * N * N + x;
    let lines = FftPoints(
      row_transforms[column + za * N],
      row_transforms[column + zb * N],
      row_transforms[column + zc * N],
      row_transforms[column + zd * N]);
    let points = fft_line(lines, za, local.x, LINES_PER_WORKGROUP);
    columns_store(c, pair, x, za, points.a);
    columns_store(c, pair, x, zb, points.b);
    columns_store(c, pair, x, zc, points.c);
    columns_store(c, pair, x, zd, points.d);
  }
}
