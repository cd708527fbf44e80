// Bind group 0 of every pass that draws the picture: frame, sky and light. It is created in src/render/scene_group.rs.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> sky: Sky;
@group(0) @binding(2) var<uniform> light: Light;
@group(0) @binding(3) var sky_view_map: texture_2d<f32>;
@group(0) @binding(4) var environment_map: texture_2d<f32>;
@group(0) @binding(5) var sky_sampler: sampler;
@group(0) @binding(6) var noise_map: texture_2d_array<f32>;
@group(0) @binding(7) var noise_sampler: sampler;
@group(0) @binding(8) var transmittance_map: texture_2d<f32>;
@group(0) @binding(10) var mirrored_sky_map: texture_3d<f32>;
@group(0) @binding(11) var<uniform> clouds: Clouds;
@group(0) @binding(12) var cloud_shadow_map: texture_2d<f32>;
@group(0) @binding(13) var land_map: texture_2d<f32>;
@group(0) @binding(15) var<uniform> land: Land;

// Whether the sun is so low that land shades land and water.
override LAND_SHADOWS: bool = false;

// How much brighter than its mean the sky is on the side of a low (x) and of a high sun (y), and darker on the other, as a
// steep surface sees it; and the sine of the sun's elevation from which it counts as high.
const SCENE_SKY_CONTRAST = vec2f(0.85, 0.5);
const SCENE_HIGH_SUN = 0.5;
// Sines of the sun's elevation, 12 and 6 degrees below the horizon, between which its side of the sky becomes brighter.
const SCENE_NIGHT_AND_DUSK = vec2f(-0.208, -0.105);
// Least horizontal part of the direction to the sun, so that a sun in the zenith has no side.
const SCENE_LEAST_SIDE = 0.3;

// Change of the skylight, relative to its mean, on a surface with the normal `n` that faces the sun or looks away from it.
// A deck of clouds and a sky from a file have no brighter side.
fn scene_skylight_change(n: vec3f) -> f32 {
  let l = frame.sun_direction;
  let most = mix(SCENE_SKY_CONTRAST.x, SCENE_SKY_CONTRAST.y, saturate(l.y / SCENE_HIGH_SUN));
  let clear = (1.0 - sky.overcast) * light.cloud_sun_transmittance * (1.0 - sky.has_image);
  let side = dot(n.xz, l.xz) / max(length(l.xz), SCENE_LEAST_SIDE);
  let day = saturate((l.y - SCENE_NIGHT_AND_DUSK.x) / (SCENE_NIGHT_AND_DUSK.y - SCENE_NIGHT_AND_DUSK.x));
  return most * clear * day * side;
}
