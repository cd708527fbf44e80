// The sky as a piece of rough water mirrors it: the environment, averaged over the mirrored rays around a direction.
// Slopes along the view spread the elevation of the rays. Slopes across it turn the rays sideways, the less the flatter
// the view: near the horizon, the sky is blurred along the elevation only.

@group(0) @binding(0) var environment_map: texture_2d<f32>;
@group(0) @binding(1) var sky_sampler: sampler;
@group(0) @binding(2) var mirrored_out: texture_storage_3d<rgba16float, write>;

const MIRRORED_PI = 3.14159265359;
// Steps between the samples, in standard deviations, and their numbers on each side of the middle.
const MIRRORED_STEPS = vec2f(0.75, 0.9);
const MIRRORED_SAMPLES = vec2i(2, 4);
// Standard deviation of the sideways turn, relative to that of the elevation, of level rays, and its growth with the
// sine of their elevation. Fitted to reference pictures.
const MIRRORED_SIDE_RATIO = vec2f(0.3, 2.5);

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = vec2f(textureDimensions(mirrored_out).xy);
  let middle = mirrored_sky_direction((vec2f(id.xy) + 0.5) / size);
  let east = normalize(vec2f(-middle.z, middle.x));
  let side = vec3f(east.x, 0.0, east.y);
  let above = cross(side, middle);
  let spread = MIRRORED_FIRST_SPREAD * exp2(f32(id.z));
  let side_ratio = MIRRORED_SIDE_RATIO.x + MIRRORED_SIDE_RATIO.y * max(middle.y, 0.0);
  let steps = spread * MIRRORED_STEPS * vec2f(side_ratio, 1.0);
  // Texels of the environment map some steps long, which fits reference pictures better than shorter ones.
  let lod = max(log2(steps.y * f32(textureDimensions(environment_map).y) / MIRRORED_PI) + 1.5, 0.0);
  var sum = vec4f(0.0);
  for (var y = -MIRRORED_SAMPLES.y; y <= MIRRORED_SAMPLES.y; y++) {
    for (var x = -MIRRORED_SAMPLES.x; x <= MIRRORED_SAMPLES.x; x++) {
      let off = vec2f(f32(x), f32(y));
      let weighed = off * MIRRORED_STEPS;
      let turn = off * steps;
      let raised = middle * cos(turn.y) + above * sin(turn.y);
      let dir = raised * cos(turn.x) + side * sin(turn.x);
      let uv = vec2f(sky_azimuth_turns(dir.xz), asin(clamp(dir.y, -1.0, 1.0)) / MIRRORED_PI + 0.5);
      let weight = exp(-0.5 * dot(weighed, weighed));
      sum += weight * vec4f(textureSampleLevel(environment_map, sky_sampler, uv, lod).rgb, 1.0);
    }
  }
  textureStore(mirrored_out, id, vec4f(sum.rgb / sum.w, 1.0));
}
