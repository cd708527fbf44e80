// Whitecaps: how much foam a pixel holds and what it looks like.

// Side of the grain's tile across the wind, m; frame.rs has the same number.
const WATER_GRAIN_M = 290.0;

struct WaterFoam {
  // Share of the pixel that is white.
  cover: f32,
  // Bubbles under the surface, 0..1.
  plume: f32,
  // Fine relief, 0..1.
  grain: f32,
}

// Foam and fresh breaking from the finest level that is valid here and no finer than the pixel; the mean beyond.
fn water_foam_level(at: vec2f, footprint: f32) -> vec2f {
  var foam = vec2f(frame.mean_foam, 0.1 * frame.mean_foam);
  for (var i = frame.foam_count; i > 0u; i--) {
    let level = i - 1u;
    let place = frame.foam_place[level];
    let off = abs(at - place.xy);
    let inside = 1.0 - smoothstep(0.8, 1.0, max(off.x, off.y) / place.z);
    let coarse = clamp(2.0 - 0.5 * footprint * place.w, 0.0, 1.0);
    let share = inside * coarse;
    if share > 0.0 {
      let uv = frame.foam_uv[level];
      foam = mix(foam, textureSampleLevel(foam_map, wave_sampler, uv.xy + at * uv.z, level, 0.0).xy, share);
    }
  }
  return foam;
}

fn water_foam(at: vec2f, foot: WaterFootprint) -> WaterFoam {
  let foam = clamp(water_foam_level(at, foot.size) * frame.foam_gain, vec2f(0.0), vec2f(1.0));
  var out: WaterFoam;
  out.plume = foam.x;
  out.grain = 0.5;
  out.cover = 0.0;
  if foam.x < 0.002 {
    return out;
  }
  // Grain in coordinates along and across the wind, drawn out along it in a gale: streaks. Each scale is a whole multiple
  // of the coarsest, so that the eye's foot can be taken modulo one tile.
  let w = frame.downwind;
  let long = 1.0 + 2.5 * smoothstep(8.0, 24.0, frame.wind_m_s);
  let turn = mat2x2f(w.x / long, -w.y, w.y / long, w.x) * (1.0 / WATER_GRAIN_M);
  let uv = frame.grain + turn * at;
  let size = foot.size * pow(f32(foot.taps), 0.8);
  let lod = log2(max(size * 512.0 / WATER_GRAIN_M, 1e-4));
  // Windrows of tens of metres, patches of metres, strands of decimetres.
  let vast = textureSampleLevel(noise_map, noise_sampler, uv, lod);
  let wide = textureSampleLevel(noise_map, noise_sampler, uv * 7.0, lod + 2.81);
  let lace = textureSampleLevel(noise_map, noise_sampler, uv * 43.0, lod + 5.43);
  let fine = textureSampleLevel(noise_map, noise_sampler, uv.yx * 160.0, lod + 7.32);
  // Fresh foam is a closed mass of bubbles, old foam a net of thin strands.
  let fresh = smoothstep(0.0, 0.45, foam.y);
  // Only what the pixel can resolve counts; a sum of uniform variables is nearly normal.
  let near = 1.0 - smoothstep(vec4f(3.4), vec4f(5.4), lod + vec4f(0.0, 2.81, 5.43, 7.32));
  let weight = near * vec4f(0.9, 1.0, mix(1.0, 0.7, fresh), 0.55);
  let sigma = 0.2887 * sqrt(max(dot(weight, weight), 1e-6));
  let z = dot(vec4f(vast.r, wide.r, lace.r, fine.g) - 0.5, weight) / sigma;
  let level = 1.0 / (1.0 + exp(-1.702 * z));
  let wanted = foam.x;
  // A soft edge of constant width in the noise; the mean over the noise stays what is wanted.
  let soft = mix(0.30, 0.16, fresh);
  let cut = smoothstep(1.0 - wanted - soft, 1.0 - wanted + soft, level);
  let kept = min(wanted / max(water_soft_mean(wanted, soft), 1e-3), 1.0);
  let seen = smoothstep(0.0, 0.25, sigma);
  out.cover = clamp(mix(wanted, cut * kept, seen), 0.0, 1.0);
  out.grain = mix(0.5, fine.g, near.w);
  return out;
}

// Mean of smoothstep(1 - c - e, 1 - c + e, x) over x in 0..1.
fn water_soft_mean(c: f32, e: f32) -> f32 {
  // The integral of smoothstep from its start over t in 0..1 is t^3 - t^4 / 2.
  let a = clamp((c + e) / (2.0 * e), 0.0, 1.0);
  let b = clamp((c - 1.0 + e) / (2.0 * e), 0.0, 1.0);
  let ramp = a * a * a * (1.0 - 0.5 * a) - b * b * b * (1.0 - 0.5 * b);
  return 2.0 * e * ramp + max(c - e, 0.0) - max(c - 1.0 - e, 0.0);
}
