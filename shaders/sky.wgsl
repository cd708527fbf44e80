// The sky behind the sea: clear air, clouds, and the sun's disc.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> sky: Sky;
@group(0) @binding(2) var<uniform> light: Light;
@group(0) @binding(3) var sky_view_map: texture_2d<f32>;
@group(0) @binding(4) var environment_map: texture_2d<f32>;
@group(0) @binding(5) var sky_sampler: sampler;
@group(0) @binding(6) var noise_map: texture_2d<f32>;
@group(0) @binding(7) var noise_sampler: sampler;
@group(0) @binding(8) var transmittance_map: texture_2d<f32>;

struct SkyVertex {
  @builtin(position) clip: vec4f,
  @location(0) ray: vec3f,
}

@vertex
fn vertex(@builtin(vertex_index) i: u32) -> SkyVertex {
  let at = vec2f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
  // Depth 0 is infinitely far.
  return SkyVertex(vec4f(at, 0.0, 1.0), frame.forward + frame.right * at.x + frame.up * at.y);
}

@fragment
fn fragment(in: SkyVertex) -> @location(0) vec4f {
  let dir = normalize(in.ray);
  let above = asin(clamp(dir.y, -1.0, 1.0)) + frame.dip;
  let air = sky_radiance(dir, max(above, 0.0), frame.pixel);
  // Limb darkening, Hestroffer and Magnan 1998 at 550 nm; the radiance is that of a disc with the sun's irradiance.
  let sine = length(cross(dir, frame.sun));
  let rim = sine / ATM_SUN_RADIUS;
  let edge = frame.pixel / ATM_SUN_RADIUS;
  let disc = select(0.0, 1.0 - smoothstep(1.0 - edge, 1.0 + edge, rim), dot(dir, frame.sun) > 0.0);
  let dark = pow(sqrt(max(1.0 - min(rim * rim, 1.0), 1e-4)), 0.45);
  let through = atm_transmittance(transmittance_map, sky_sampler, 0.001 * frame.eye_m, dir.y);
  let sun = ATM_SUN * through * (dark * 1.22 / (ATM_PI * ATM_SUN_RADIUS * ATM_SUN_RADIUS));
  return frame_colour(min(air.rgb + disc * air.w * (1.0 - frame.overcast) * sun * step(0.0, above), vec3f(6e4)));
}
