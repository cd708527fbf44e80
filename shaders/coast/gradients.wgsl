// The maps of the waves at a coast, from their elevation and potential: differences of fourth order between texels.
//   displacement: Dx, height eta, Dz, dDx/dz     gradients: d eta/dx, d eta/dz, dDx/dx, dDz/dz     (without choppiness)

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<uniform> coast: Coast;
@group(0) @binding(2) var<storage, read> fields: array<vec2f>; // [z][x]: elevation, m, and potential, m^2
@group(0) @binding(3) var maps: texture_storage_2d_array<rgba16float, write>; // a third of the layers for each kind

fn coast_fields(texel: vec2u, offset: vec2i) -> vec2f {
  let at = bitcast<vec2u>(bitcast<vec2i>(texel) + offset) & vec2u(coast.n - 1u);
  return fields[at.y * coast.n + at.x];
}

// Derivative along the direction `step`, in texels.
fn coast_derivative(texel: vec2u, offset: vec2i, step: vec2i) -> vec2f {
  let near = coast_fields(texel, offset + step) - coast_fields(texel, offset - step);
  let far = coast_fields(texel, offset + 2 * step) - coast_fields(texel, offset - 2 * step);
  return (8.0 * near - far) / 12.0;
}

fn coast_second_derivative(texel: vec2u, step: vec2i) -> f32 {
  let near = coast_fields(texel, step).y + coast_fields(texel, -step).y;
  let far = coast_fields(texel, 2 * step).y + coast_fields(texel, -2 * step).y;
  return (16.0 * near - far - 30.0 * coast_fields(texel, vec2i(0)).y) / 12.0;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let texel = id.xy;
  let x = vec2i(1, 0);
  let z = vec2i(0, 1);
  let per_m = 1.0 / coast.texel_m;
  let along_x = per_m * coast_derivative(texel, vec2i(0), x);
  let along_z = per_m * coast_derivative(texel, vec2i(0), z);
  let near = coast_derivative(texel, x, z).y - coast_derivative(texel, -x, z).y;
  let far = coast_derivative(texel, 2 * x, z).y - coast_derivative(texel, -2 * x, z).y;
  let second = (per_m * per_m)
    * vec3f(coast_second_derivative(texel, x), coast_second_derivative(texel, z), (8.0 * near - far) / 12.0);
  let height = coast_fields(texel, vec2i(0)).x;
  let layer = sea.first_layer + sea.cascade_count + 1u;
  textureStore(maps, texel, layer, vec4f(along_x.y, height, along_z.y, second.z));
  textureStore(maps, texel, textureNumLayers(maps) / 3u + layer, vec4f(along_x.x, along_z.x, second.xy));
}
