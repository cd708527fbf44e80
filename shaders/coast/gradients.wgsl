// The maps of the waves at a coast, from their elevation and potential: differences of fourth order between texels.
//   displacement: Dx, height eta, Dz, dDx/dz     gradients: d eta/dx, d eta/dz, dDx/dx, dDz/dz     (without choppiness)

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<uniform> coast: Coast;
@group(0) @binding(2) var<storage, read> fields: array<vec2f>; // [z][x]: elevation, m, and potential, m^2
@group(0) @binding(3) var maps: texture_storage_2d_array<rgba16float, write>; // a third of the layers for each kind

// Weights of the values two and one texels before and one and two behind, in the first and in the second derivative. The
// value between them has the weight COAST_SECOND_HERE in the second.
const COAST_FIRST = vec4f(1.0, -8.0, 8.0, -1.0) / 12.0;
const COAST_SECOND = vec4f(-1.0, 16.0, 16.0, -1.0) / 12.0;
const COAST_SECOND_HERE = -2.5;

// Derivative along x of the potential in the row of texels that begins at `row`, per texel.
fn coast_potential_along_x(row: u32, columns: vec4u) -> f32 {
  return dot(COAST_FIRST, vec4f(
    fields[row + columns.x].y, fields[row + columns.y].y, fields[row + columns.z].y, fields[row + columns.w].y));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let steps = vec4u(coast.n - 2u, coast.n - 1u, 1u, 2u);
  let columns = (id.x + steps) & vec4u(coast.n - 1u);
  let rows = ((id.y + steps) & vec4u(coast.n - 1u)) * coast.n;
  let row = id.y * coast.n;
  let here = fields[row + id.x];
  let along_x = mat4x2f(
    fields[row + columns.x], fields[row + columns.y], fields[row + columns.z], fields[row + columns.w]);
  let along_z = mat4x2f(
    fields[rows.x + id.x], fields[rows.y + id.x], fields[rows.z + id.x], fields[rows.w + id.x]);
  let per_m = 1.0 / coast.texel_m;
  let dx = per_m * (along_x * COAST_FIRST);
  let dz = per_m * (along_z * COAST_FIRST);
  let own = COAST_SECOND_HERE * here.y;
  let mixed = dot(COAST_FIRST, vec4f(
    coast_potential_along_x(rows.x, columns), coast_potential_along_x(rows.y, columns),
    coast_potential_along_x(rows.z, columns), coast_potential_along_x(rows.w, columns)));
  let second = (per_m * per_m)
    * vec3f((along_x * COAST_SECOND).y + own, (along_z * COAST_SECOND).y + own, mixed);
  let layer = sea.first_layer + sea.cascade_count + 1u;
  textureStore(maps, id.xy, layer, vec4f(dx.y, here.x, dz.y, second.z));
  textureStore(maps, id.xy, textureNumLayers(maps) / 3u + layer, vec4f(dx.x, dz.x, second.xy));
}
