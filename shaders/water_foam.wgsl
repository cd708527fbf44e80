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
  let size = foot.size * pow(f32(foot.taps), 0.6);
  let lod = log2(max(size * 512.0 / WATER_GRAIN_M, 1e-4));
  // Windrows of tens of metres, patches of metres, strands of decimetres.
  let vast = textureSampleLevel(noise_map, noise_sampler, uv, lod);
  let wide = textureSampleLevel(noise_map, noise_sampler, uv * 7.0, lod + 2.81);
  let lace = textureSampleLevel(noise_map, noise_sampler, uv * 43.0, lod + 5.43);
  let fine = textureSampleLevel(noise_map, noise_sampler, uv.yx * 160.0, lod + 7.32);
  // Fresh foam is a closed mass of bubbles, old foam a net of thin strands.
  let fresh = smoothstep(0.0, 0.45, foam.y);
  let weight = vec4f(0.9, 1.0, mix(1.0, 0.7, fresh), 0.55);
  let whole = dot(weight, weight);
  let lods = lod + vec4f(0.0, 2.81, 5.43, 7.32);
  let kept = water_noise_kept(lods);
  let resolved = dot(weight * weight, kept) / whole;
  // A sum of uniform variables is nearly normal; what of it the pixel cannot resolve softens the edge, so that the mean
  // over the noise is what is wanted at every distance. The normal distribution is taken as logistic.
  let z = dot(vec4f(vast.r, wide.r, lace.r, fine.g) - 0.5, weight) / (0.2887 * sqrt(whole));
  let soft = mix(0.34, 0.20, fresh);
  let wanted = clamp(foam.x, 1e-4, 1.0 - 1e-4);
  let edge = 1.702 * z + sqrt(1.0 + soft * soft) * log(wanted / (1.0 - wanted));
  out.cover = 1.0 / (1.0 + exp(clamp(-edge / sqrt(soft * soft + 1.0 - resolved), -40.0, 40.0)));
  out.grain = mix(0.5, fine.g, kept.w);
  return out;
}

// Share of the variance of the noise that its mips keep: net, net, net and bubbles. Fitted to noise.rs.
fn water_noise_kept(lod: vec4f) -> vec4f {
  return 1.0 / (1.0 + pow(exp2(lod) / vec4f(19.0, 19.0, 19.0, 4.7), vec4f(1.5, 1.5, 1.5, 1.7)));
}
