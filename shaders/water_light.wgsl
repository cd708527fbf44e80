// Light that comes from the water towards the eye: mirrored sky and sun over the distribution of slopes that the eye sees,
// and light from below. After Bruneton, Neyret and Holzschuch 2010, with the sum over the visible slopes carried out.

const WATER_INDEX = 1.333;

// Unpolarised dielectric reflectance.
fn water_fresnel(cosine: f32) -> f32 {
  let c = clamp(cosine, 0.0, 1.0);
  let g = sqrt(WATER_INDEX * WATER_INDEX - 1.0 + c * c);
  let a = (g - c) / (g + c);
  let b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * a * a * (1.0 + b * b);
}

// Integral of the standard normal density up to x (Bowling et al. 2009, error below 1.5e-4).
fn water_normal_cdf(x: f32) -> f32 {
  return 1.0 / (1.0 + exp(-clamp(x * (1.5976 + 0.07056 * x * x), -40.0, 40.0)));
}

// Area seen from a direction over horizontal area: cosine with Smith's masking, for slopes towards that direction with
// this mean and deviation.
fn water_seen(height: f32, across: f32, mean: f32, sigma: f32) -> f32 {
  let scale = max(across * sigma, 1e-6);
  let a = (height + across * mean) / scale;
  return scale * (a * water_normal_cdf(a) + 0.39894228 * exp(-0.5 * min(a * a, 80.0)));
}

struct WaterMirror {
  radiance: vec3f,
  // Mean Fresnel reflectance over the slopes that are seen.
  reflectance: f32,
}

fn water_environment(dir: vec3f, lod: f32) -> vec3f {
  let uv = vec2f(atan2(dir.x, -dir.z) / (2.0 * ATM_PI), asin(clamp(dir.y, -1.0, 1.0)) / ATM_PI + 0.5);
  return textureSampleLevel(environment_map, sky_sampler, uv, lod).rgb;
}

// Mirrored sky and sun; `v` points to the eye, in the frame of the local vertical.
fn water_mirror(v: vec3f, slope: WaterSlope) -> WaterMirror {
  // Straight below the eye any direction will do.
  let level = select(vec2f(1e-4, 0.0), v.xz, dot(v.xz, v.xz) > 1e-8);
  let across = length(level);
  let toward = level / across;
  let side = vec2f(-toward.y, toward.x);
  let cov = mat2x2f(slope.variance.x, slope.variance.z, slope.variance.z, slope.variance.y);
  let var_t = max(dot(toward, cov * toward), 1e-6);
  let var_s = max(dot(side, cov * side), 1e-6);
  let cov_ts = dot(toward, cov * side);
  let sigma = sqrt(var_t);
  // Tilt towards the eye is minus the slope in its direction.
  let tilt = -dot(slope.mean, toward);
  let side_mean = dot(slope.mean, side);
  // Slopes turned away from the eye are not seen; the others by their projected area.
  let low = -(v.y / across + tilt) / sigma;
  let from_t = max(low, -2.4);
  let to_t = max(3.0, from_t + 2.2);
  const NODES = 5;
  let width = (to_t - from_t) / f32(NODES);
  let lod = clamp(log2(1.4 * width * sigma * 128.0 / ATM_PI + 0.6 * sqrt(var_s) * 128.0 / ATM_PI + 1e-3), 0.0, 5.0);
  var sum = vec3f(0.0);
  var sum_f = 0.0;
  var weights = 0.0;
  for (var i = 0; i < NODES; i++) {
    let t = from_t + (f32(i) + 0.5) * width;
    // Scaled so that not all underflow when only the far tail is seen.
    let weight = exp(-0.5 * (t * t - max(from_t, 0.0) * max(from_t, 0.0))) * (t - low);
    let s_t = -(tilt + sigma * t);
    let s_s = side_mean - cov_ts / sigma * t;
    let s = toward * s_t + side * s_s;
    let n = water_normal(s);
    let f = water_fresnel(dot(v, n));
    sum += weight * f * water_environment(reflect(-v, n), lod);
    sum_f += weight * f;
    weights += weight;
  }
  var out: WaterMirror;
  out.radiance = sum / weights;
  out.reflectance = sum_f / weights;

  // The sun: density of the slope that mirrors it into the eye.
  let l = frame.sun;
  let h = normalize(l + v);
  if l.y > -0.02 && h.y > 0.05 {
    let off = -h.xz / h.y - slope.mean;
    let xx = slope.variance.x + 1.5e-5;
    let zz = slope.variance.y + 1.5e-5;
    let xz = slope.variance.z;
    let det = max(xx * zz - xz * xz, 0.02 * xx * zz);
    let exponent = 0.5 * (zz * off.x * off.x - 2.0 * xz * off.x * off.y + xx * off.y * off.y) / det;
    let density = exp(-min(exponent, 80.0)) / (2.0 * ATM_PI * sqrt(det));
    let sun_across = max(length(l.xz), 1e-4);
    let sun_toward = l.xz / sun_across;
    let sun_sigma = sqrt(max(dot(sun_toward, cov * sun_toward), 1e-6));
    let sun_tilt = -dot(slope.mean, sun_toward);
    let lit = max(l.y + sun_across * sun_tilt, 0.0) / max(water_seen(l.y, sun_across, sun_tilt, sun_sigma), 1e-5);
    let seen = max(water_seen(v.y, across, tilt, sigma), 1e-4);
    let h2 = h.y * h.y;
    let f = water_fresnel(dot(v, h));
    // A mirror image is not brighter than the sun's disc; half floats hold less.
    let most = select(3000.0, 14700.0, frame.footprint == 0.0);
    out.radiance += light.sun * min(f * density * clamp(lit, 0.0, 1.0) / (4.0 * h2 * h2 * seen), most);
  }
  return out;
}

// Irradiance reflectance of the water body just below the surface: clear ocean (Morel and Maritorena 2001, chlorophyll
// 0.05 mg/m^3) to turbid coast, at the wavelengths of the display's primaries.
fn water_body() -> vec3f {
  let clear = vec3f(0.0020, 0.0125, 0.070);
  let coast = vec3f(0.013, 0.042, 0.027);
  return exp(mix(log(clear), log(coast), frame.turbidity));
}

// Radiance that leaves the water. `n` is the mean normal, `rise` the height over the mean level in significant heights.
fn water_below(v: vec3f, n: vec3f, rise: f32, plume: f32) -> vec3f {
  let l = frame.sun;
  let sun = light.sun * max(dot(n, l) * 0.5 + 0.5 * l.y, 0.0) * (1.0 - water_fresnel(max(dot(n, l), 0.0)));
  let sky = light.sky * (0.93 * (0.5 + 0.5 * n.y));
  var body = water_body();
  // Sand below shallow water.
  let k = mix(vec3f(0.36, 0.075, 0.032), vec3f(0.65, 0.17, 0.30), frame.turbidity);
  body += vec3f(0.30, 0.27, 0.20) * exp(-2.2 * k * frame.depth_m);
  // Bubbles that breaking has beaten under scatter all colours; the water takes the red back.
  body += plume * plume * vec3f(0.045, 0.17, 0.18);
  let down = (sun + sky) * body;
  // Sunlight through the back of a thin crest: forward scattering over a metre or so of water.
  let behind = max(-dot(v.xz, l.xz), 0.0);
  let thin = clamp(rise + 0.12, 0.0, 1.0);
  let facing = clamp(1.0 - n.y + 0.25, 0.0, 1.0);
  let path = exp(-k * 1.8) * mix(vec3f(0.25, 0.75, 0.85), vec3f(0.45, 0.9, 0.6), frame.turbidity);
  let crest = light.sun * path * (0.22 * pow(behind, 3.0) * thin * thin * facing * (0.3 + frame.turbidity));
  let around = light.sky * path * (0.012 * thin * (0.5 + frame.turbidity));
  // Upwelling light over Q = 4 sr, through the surface: t / n^2.
  return 0.54 * (down / 4.0 + (crest + around) / ATM_PI);
}
