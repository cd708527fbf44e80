// Spectrum pass: the amplitudes h0(k) = 1/2 (xr + i xi) sqrt(S(k) dkx dkz) with normal random numbers xr and xi, once
// per sea. During an interpolation between two seas of the same waves, it makes one step from the current h0 towards
// this value. The spectrum S(k) is a sum of terms: spreading lobes around the direction of a wave system, and
// directional distributions measured by a buoy or given as densities over frequency and direction.

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<storage, read> spectrum_table: array<vec4f>; // see src/waves/table.rs
@group(0) @binding(2) var<storage, read_write> h0: array<vec2f>; // [cascade][iz][ix]

// Shape of a spreading lobe at the angle theta from its direction: sech^2(beta theta) cos^{2s}(theta/2), times cos^2
// over the whole circle (kind 1) or over its forward half (kind 2).
fn spectrum_spreading_lobe(term: SpectrumTerm, beta: f32, s: f32, k: vec2f) -> f32 {
  let along = dot(term.reference_direction, k);
  let across = abs(term.reference_direction.x * k.y - term.reference_direction.y * k.x);
  let x = beta * maths_atan2_upper(across, along);
  let e = maths_exp(-x);
  let sech = 2.0 * e / (1.0 + e * e);
  // cos^2(theta/2) = (1 + cos) / 2; in the backward half as sin^2 / (2 (1 - cos)), which does not cancel.
  let unit = vec2f(along, across) / length(k);
  let half_cos2 = select(0.5 + 0.5 * unit.x, 0.5 * unit.y * unit.y / (1.0 - unit.x), unit.x < 0.0);
  var shape = sech * sech * select(maths_exp(s * maths_natural_log(max(half_cos2, 1e-30))), 1.0, s == 0.0);
  if term.kind == 1u || term.kind == 2u {
    shape *= select(unit.x * unit.x, 0.0, term.kind == 2u && unit.x < 0.0);
  }
  return shape;
}

// Shape of a directional distribution measured by a buoy, from the maximum-entropy method (Lygre and Krogstad 1986): 1
// / |1 - phi1 e^{-i theta} - phi2 e^{-2 i theta}|^2.
fn spectrum_buoy_distribution(phi1: vec2f, phi2: vec2f, k: vec2f) -> f32 {
  let unit = k / length(k);
  let back = vec2f(unit.x, -unit.y);
  let z = vec2f(1.0, 0.0) - maths_complex_mul(phi1, back) - maths_complex_mul(phi2, maths_complex_mul(back, back));
  return 1.0 / max(dot(z, z), 1e-12);
}

// Density of one band of the measured spectrum in one direction, per rad: see `tabulated_directions` in
// src/waves/table.rs.
fn spectrum_tabulated_density(band: u32, direction: u32, directions: u32) -> f32 {
  let i = band * directions + direction;
  return spectrum_table[sea.direction_table_start + 1u + i / 4u][i % 4u];
}

// Densities over frequency and direction: the sum of two bands with the variances row.xy and the indices row.zw, linear
// between directions, as a mean over the angle 1 / |k| of the lattice cell by a four-point Gauss-Legendre rule.
fn spectrum_tabulated_variance(row: vec4f, k: vec2f) -> f32 {
  let head = spectrum_table[sea.direction_table_start];
  let directions = u32(head.x);
  let count = i32(directions);
  // The angle as an eighth of the circle and a rest of at most pi/4, which keeps small rounding errors small.
  let size = abs(k);
  let rest = maths_atan2_upper(min(size.x, size.y), max(size.x, size.y));
  let steep = size.y > size.x;
  let left = k.x < 0.0;
  let down = k.y < 0.0;
  var eighths = select(0, 2, steep);
  var turned = select(rest, -rest, steep);
  eighths = select(eighths, 4 - eighths, left);
  turned = select(turned, -turned, left);
  eighths = select(eighths, 8 - eighths, down);
  turned = select(turned, -turned, down);
  // Whole steps of the table apart from the fraction.
  let scaled = eighths * count;
  let first = floor(head.y);
  let fraction = f32(scaled % 8) * 0.125 + turned * (head.x * 0.15915494309) - (head.y - first);
  let whole = scaled / 8 - i32(first) + 4 * count;
  let width = head.x * 0.15915494309 / length(k);
  let nodes = vec4f(-0.43056815580, -0.16999052179, 0.16999052179, 0.43056815580);
  let weights = vec4f(0.17392742257, 0.32607257743, 0.32607257743, 0.17392742257);
  let bands = vec2u(row.zw);
  var sum = 0.0;
  for (var i = 0u; i < 4u; i++) {
    let x = fraction + nodes[i] * width;
    let near = u32(whole + i32(floor(x))) % directions;
    let next = (near + 1u) % directions;
    let t = x - floor(x);
    for (var b = 0u; b < 2u; b++) {
      let a = spectrum_tabulated_density(bands[b], near, directions);
      sum += weights[i] * row[b] * (a + t * (spectrum_tabulated_density(bands[b], next, directions) - a));
    }
  }
  return sum;
}

// Variance of the real and of the imaginary part of h0, m^2, for a table entry and a wave vector's direction.
fn spectrum_variance(entry: u32, k: vec2f) -> f32 {
  var sum = 0.0;
  for (var i = 0u; i < sea.term_count; i++) {
    let term = sea.terms[i];
    let first = entry * sea.vectors_per_entry + term.first_vector;
    let row = spectrum_table[first];
    if term.kind == 4u {
      sum += spectrum_tabulated_variance(row, k);
    } else if term.kind == 3u {
      sum += row.x * spectrum_buoy_distribution(row.yz, vec2f(row.w, spectrum_table[first + 1u].x), k);
    } else {
      sum += row.x * spectrum_spreading_lobe(term, row.y, row.z, k) + row.w;
    }
  }
  return sum;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let n = sea.n;
  if id.x >= n {
    return;
  }
  let cascade = sea.cascades[id.z];
  let ix = sea_signed_index(id.x, n);
  let iz = sea_signed_index(id.y, n);
  // Waves at the Nyquist wavenumber have no opposite wave in the lattice, so i k h would not be Hermitian. They stay 0.
  let nyquist = -i32(n / 2u);
  var h = vec2f(0.0);
  if (ix != 0 || iz != 0) && ix != nyquist && iz != nyquist {
    let entry = id.z * sea_wave_table_len(n) + sea_wave_table_entry(ix, iz);
    let variance = spectrum_variance(entry, vec2f(f32(ix), f32(iz)));
    let gauss = noise_normal_pair(noise_random_words(sea.seed, cascade.noise_key, ix, iz));
    h = gauss * sqrt(variance);
  }
  let at = (id.z * n + id.y) * n + id.x;
  // The last step of an interpolation selects h, because mix would not end exactly on h.
  h0[at] = select(mix(h0[at], h, sea.spectrum_blend), h, sea.spectrum_blend >= 1.0);
}
