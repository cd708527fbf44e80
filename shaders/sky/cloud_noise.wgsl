// Fills the repeating 3D noise of the clouds: billows, like heads of cauliflower (red), finer billows (green), and
// smooth wisps (blue). Values lie in 0 to 1.

@group(0) @binding(0) var noise_out: texture_storage_3d<rgba8unorm, write>;

// Three random numbers, 0 to 1, for a lattice cell. `period` repeats the lattice.
fn noise_random(cell: vec3i, period: i32, key: u32) -> vec3f {
  let wrapped = ((cell % period) + period) % period;
  return noise_pcg3d_unit(vec3u(wrapped) + key);
}

// Falls with the square of the distance to the nearest of random points, one in each cell (Worley 1996): round heads
// with sharp creases between them. The distance itself would make cones, whose tips fray the outline of a cloud.
fn noise_billows(at: vec3f, period: i32) -> f32 {
  let p = at * f32(period);
  let cell = vec3i(floor(p));
  var nearest = 4.0;
  for (var i = 0; i < 27; i++) {
    let off = vec3i(i % 3, (i / 3) % 3, i / 9) - 1;
    let point = vec3f(cell + off) + noise_random(cell + off, period, 7u) - p;
    nearest = min(nearest, dot(point, point));
  }
  return saturate(0.8 - nearest);
}

fn noise_gradient_at(cell: vec3i, off: vec3f, period: i32) -> f32 {
  return dot(2.0 * noise_random(cell, period, 91u) - 1.0, off);
}

// Perlin's gradient noise, about -0.7 to 0.7.
fn noise_smooth(at: vec3f, period: i32) -> f32 {
  let p = at * f32(period);
  let cell = vec3i(floor(p));
  let f = p - floor(p);
  let u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  var corner: array<f32, 8>;
  for (var i = 0; i < 8; i++) {
    let off = vec3i(i & 1, (i >> 1) & 1, i >> 2);
    corner[i] = noise_gradient_at(cell + off, f - vec3f(off), period);
  }
  let x = vec4f(
    mix(corner[0], corner[1], u.x), mix(corner[2], corner[3], u.x), mix(corner[4], corner[5], u.x),
    mix(corner[6], corner[7], u.x));
  return mix(mix(x.x, x.y, u.y), mix(x.z, x.w, u.y), u.z);
}

@compute @workgroup_size(4, 4, 4)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let at = (vec3f(id) + 0.5) / vec3f(textureDimensions(noise_out));
  let wide = noise_billows(at, 4);
  let middle = noise_billows(at, 9);
  let narrow = noise_billows(at, 18);
  let smooth_noise = noise_smooth(at, 4) + 0.5 * noise_smooth(at, 9) + 0.25 * noise_smooth(at, 18);
  let heads = 0.40 * wide + 0.33 * middle + 0.27 * narrow;
  let fine = 0.42 * wide + 0.32 * middle + 0.26 * narrow;
  let shape = saturate(0.8 * heads + 0.42 * smooth_noise + 0.1);
  textureStore(noise_out, id, vec4f(shape, fine, saturate(0.5 + 0.6 * smooth_noise), 1.0));
}
