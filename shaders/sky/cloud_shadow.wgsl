// Fills the repeating map of the sunlight that passes through the clouds, by the point where a ray towards the sun
// meets the height of their base (red). Green is the share of open sky straight above that point: 0 below heaps and
// decks, 1 in gaps of their field, and the transmittance of cirrus. Only the mean of green is used.

@group(0) @binding(0) var<uniform> cloud_field: CloudField;
@group(0) @binding(1) var<uniform> sky: Sky;
@group(0) @binding(2) var weather_map: texture_2d<f32>;
@group(0) @binding(3) var cloud_noise_map: texture_3d<f32>;
@group(0) @binding(4) var cloud_sampler: sampler;
@group(0) @binding(5) var shadow_out: texture_storage_2d<rgba16float, write>;

// Steps through the layer for a high sun, and the most. A long step through a cloud and a gap would close the gap.
const SHADOW_STEPS = 24.0;
const SHADOW_MOST_STEPS = 96.0;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let at = (vec2f(id.xy) + 0.5) / (vec2f(textureDimensions(shadow_out)) * cloud_field.tiles_per_km);
  let sun = cloud_turned(sky.sun_direction);
  let steep = max(sun.y, SKY_LOWEST_BEAM);
  let slope = vec3f(sun.x, steep, sun.z) / steep;
  let steps = clamp(floor(0.33 * SHADOW_STEPS * length(slope)), SHADOW_STEPS, SHADOW_MOST_STEPS);
  let step_km = 1.0 / (cloud_field.layers_per_km * steps);
  // Width of a texel, over which the clouds are averaged.
  let side_km = 1.0 / (cloud_field.tiles_per_km * f32(textureDimensions(shadow_out).x));
  if cloud_field.kind == CLOUD_CIRRUS {
    var thin = 0.0;
    for (var i = 0u; i < 2u; i++) {
      let place = at + slope.xz * (CIRRUS_RISES[i] / cloud_field.layers_per_km);
      thin += cirrus_depth(place, i, mat2x2f(side_km, 0.0, 0.0, side_km)) * length(slope);
    }
    textureStore(shadow_out, id.xy, vec4f(exp(-thin), exp(-thin / length(slope)), 0.0, 1.0));
    return;
  }
  let way_km = step_km * length(slope);
  let footprint_km = max(side_km, 0.5 * way_km);
  var depth = 0.0;
  for (var i = 0.5; i < steps; i += 1.0) {
    let rise = i * step_km;
    let p = vec3f(at.x, cloud_field.base_km, at.y) + slope * rise;
    depth += cloud_density(p, footprint_km, way_km);
  }
  depth *= way_km * cloud_field.extinction_per_km;
  let is_gap = textureLoad(weather_map, id.xy, 0).r <= 0.0;
  textureStore(shadow_out, id.xy, vec4f(exp(-depth), select(0.0, 1.0, is_gap), 0.0, 1.0));
}
