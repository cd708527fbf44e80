// h0(k) = 1/2 (xr + i xi) sqrt(S(k) dkx dkz), once per sea.

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<storage, read> radial: array<vec4f>; // amplitude, beta, s, 0 per triangle entry
@group(0) @binding(2) var<storage, read_write> h0: array<vec2f>; // [cascade][iz][ix]

// sqrt of sech^2(beta theta) cos^{2s}(theta/2).
fn spectrum_lobe(beta: f32, s: f32, k: vec2f) -> f32 {
  let along = dot(sea.downwind, k);
  let across = abs(sea.downwind.x * k.y - sea.downwind.y * k.x);
  let x = beta * maths_atan2_upper(across, along);
  let e = maths_exp(-x);
  let sech = 2.0 * e / (1.0 + e * e);
  // cos^2(theta/2) = (1 + cos) / 2; against the waves as sin^2 / (2 (1 - cos)), which does not cancel.
  let unit = vec2f(along, across) / length(k);
  let half_cos2 = select(0.5 + 0.5 * unit.x, 0.5 * unit.y * unit.y / (1.0 - unit.x), unit.x < 0.0);
  let cosine = select(maths_exp(0.5 * s * maths_ln(max(half_cos2, 1e-30))), 1.0, s == 0.0);
  return sech * cosine;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let n = sea.n;
  if id.x >= n {
    return;
  }
  let cascade = sea.cascades[id.z];
  let ix = sea_signed(id.x, n);
  let iz = sea_signed(id.y, n);
  let row = radial[id.z * sea_triangle_len(n) + sea_triangle(ix, iz)];
  // The Nyquist row and column have no partner: i k h would not be Hermitian there.
  let nyquist = -i32(n / 2u);
  var h = vec2f(0.0);
  if row.x > 0.0 && ix != nyquist && iz != nyquist {
    let gauss = noise_gauss(noise_words(sea.seed, cascade.key, ix, iz));
    h = gauss * (row.x * spectrum_lobe(row.y, row.z, vec2f(f32(ix), f32(iz))));
  }
  h0[(id.z * n + id.y) * n + id.x] = h;
}
