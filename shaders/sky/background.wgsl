// The sky behind the sea: clear air, clouds, and the sun's disc.

@group(1) @binding(0) var image_map: texture_2d<f32>;
@group(2) @binding(0) var dome_map: texture_2d_array<f32>;

// Whether stars are compiled in. Overrides for clouds are in clouds.wgsl, for a sky from a file and fog in air.wgsl.
override SKY_STARS = true;

struct SkyFragment {
  @builtin(position) clip: vec4f,
  @location(0) ray: vec3f,
}

@vertex
fn vertex(@builtin(vertex_index) i: u32) -> SkyFragment {
  let at = vec2f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
  // Depth is reversed: 0 is infinitely far.
  return SkyFragment(vec4f(at, 0.0, 1.0), frame.forward + frame.right * at.x + frame.up * at.y);
}

// Radiance of the sun's disc. Limb darkening is a power of the cosine (Hestroffer and Magnan 1998; 0.45 at 550 nm). The
// disc has the same irradiance at any size.
fn sky_sun_disc_radiance(dir: vec3f) -> vec3f {
  let rim = length(cross(dir, frame.sun_direction)) / sin(sky.sun_radius_rad);
  let edge = frame.pixel_angle / sky.sun_radius_rad;
  if dot(dir, frame.sun_direction) < 0.0 || rim > 1.0 + edge {
    return vec3f(0.0);
  }
  let disc = 1.0 - smoothstep(1.0 - edge, 1.0 + edge, rim);
  let dark = pow(max(1.0 - rim * rim, 1e-4), 0.5 * sky.limb_darkening_exponent);
  let solid = ATM_PI * sin(sky.sun_radius_rad) * sin(sky.sun_radius_rad);
  // A disc that is smaller than a pixel is dimmed, because it fills only a part of the pixel.
  let shown = min(1.0, 1.0 / (edge * edge));
  let eye_km = 0.001 * frame.eye_height_m;
  let through = atm_transmittance(transmittance_map, sky_sampler, eye_km, dir.y, 0.25 * sky.sun_radius_rad);
  let mean_to_middle = 1.0 + 0.5 * sky.limb_darkening_exponent;
  return atm_linear_srgb(through) * sky.sun_tint * (disc * dark * shown * mean_to_middle / solid);
}

// Radiance of the stars: one star in each cell of a cube map. Their number grows by half a decade per magnitude. The
// blur of the eye spreads each star over at least 3/4 of a pixel.
fn sky_star_radiance(dir: vec3f) -> vec3f {
  let a = abs(dir);
  let face = select(select(2u, 1u, a.y >= a.z), 0u, a.x >= max(a.y, a.z));
  let major = select(select(dir.z, dir.y, face == 1u), dir.x, face == 0u);
  let plane = select(select(dir.xy, dir.xz, face == 1u), dir.yz, face == 0u) / abs(major);
  const CELLS = 26.0;
  let cell = floor((0.5 + 0.5 * plane) * CELLS);
  let key = vec3u(vec2u(cell), face * 2u + select(0u, 1u, major < 0.0) + 17u);
  let place = noise_pcg3d_unit(key);
  let more = noise_pcg3d_unit(key + 1000u);
  let at = (cell + 0.1 + 0.8 * place.xy) / CELLS * 2.0 - 1.0;
  let size = max(0.75 * frame.pixel_angle, 4e-4);
  let off = length(at - plane) / (size * (1.0 + dot(plane, plane)));
  // A star of magnitude m has the illuminance 2.5e-6 lux x 10^(-0.4 m). The unit of illuminance here is 6400 lux.
  let magnitude = 6.3 + 2.0 * log2(max(place.z, 1e-3)) / 3.3219;
  let lux = 2.5e-6 * exp2(-1.3288 * magnitude) / 6400.0;
  let hue = mix(vec3f(1.15, 0.95, 0.75), vec3f(0.85, 0.97, 1.25), more.x);
  return hue * (lux * sky.night_gain * exp(-0.5 * off * off) / (2.0 * ATM_PI * size * size));
}

// Elevation above the horizon, rad, up to which sea salt veils the sky.
const SKY_SALT_REACH = 0.06;
// Vertical scale height of the layer of sea salt, km (`SALT_SCALE_HEIGHT_M` in src/render/frame.rs), and the elevation,
// rad, at which the curved Earth makes a slanted path through it as long as a level one.
const SKY_SALT_HEIGHT_KM = 0.06;
const SKY_SALT_LEVEL_ELEVATION = 0.0025;

// Low sky of the radiance `radiance` behind the layer of sea salt, which has the light of the distant air. `above` is the
// elevation above the horizon, rad.
fn sky_behind_salt(radiance: vec3f, dir: vec3f, above: f32) -> vec3f {
  let fade = 1.0 - above * (1.0 / SKY_SALT_REACH);
  if fade <= 0.0 {
    return radiance;
  }
  let slant_km = SKY_SALT_HEIGHT_KM / sqrt(above * above + SKY_SALT_LEVEL_ELEVATION * SKY_SALT_LEVEL_ELEVATION);
  let through = exp(-frame.salt_extinction_per_km * slant_km * fade);
  var clear = sky_clear_radiance(dir, 0.0);
  let grey = sky_overcast_horizon_radiance();
  if SKY_CLOUD_DOME && sky.has_cloud_dome > 0.0 {
    clear = sky_shaded_air(clear, grey);
  }
  return mix(mix(clear, grey, sky.overcast * sky.overcast), radiance, through);
}

@fragment
fn fragment(in: SkyFragment) -> @location(0) vec4f {
  let dir = normalize(in.ray);
  let above = max(atm_asin(dir.y) + frame.horizon_dip, 0.0);
  var radiance = vec3f(0.0);
  if SKY_IMAGE && sky.has_image > 0.0 {
    // The file's horizon is lowered to the visible horizon. The file's ground stays out of the texture filter.
    let lowered = above - frame.horizon_dip * (1.0 - exp(-above / (3.0 * frame.horizon_dip + 1e-6)));
    let elevation = max(lowered, 0.75 * ATM_PI / f32(textureDimensions(image_map).y));
    let lifted = vec3f(normalize(dir.xz + vec2f(1e-9, 0.0)) * cos(elevation), sin(elevation)).xzy;
    let lod = log2(frame.pixel_angle * f32(textureDimensions(image_map).y) / ATM_PI);
    radiance = sky.image_gain * textureSampleLevel(image_map, sky_sampler, sky_image_uv(lifted), lod).rgb;
  } else {
    let air = sky_radiance(dir, above, frame.pixel_angle, sky.cloud_drift_km);
    radiance = air.rgb;
    if dir.y > -frame.horizon_dip {
      var beyond = sky_sun_disc_radiance(dir);
      if SKY_STARS && sky.sun_direction.y < -0.05 {
        let through = atm_transmittance(transmittance_map, sky_sampler, 0.001 * frame.eye_height_m, dir.y, 1e-3);
        beyond += sky_star_radiance(dir) * through.y;
      }
      radiance += beyond * (air.w * (1.0 - sky.overcast));
    }
    radiance = sky_behind_salt(radiance, dir, above);
  }
  if SKY_FOG && sky.fog.extinction_per_m > 0.0 {
    let fog = air_fog_on_ray(dir, FOG_FAR_M);
    radiance = radiance * fog.w + fog.rgb;
  }
  // The hue of the sun stays where half floats end.
  let most = max(max(radiance.r, radiance.g), max(radiance.b, 1.0));
  return frame_hdr_output(radiance * min(6e4 / most, 1.0), 0.0);
}
