// Whitecaps: how much foam a pixel holds and what it looks like.

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

fn water_foam(at: vec2f, dx: vec2f, dy: vec2f) -> WaterFoam {
  let footprint = sqrt(length(dx) * length(dy)) + 0.15 * max(length(dx), length(dy));
  let foam = clamp(water_foam_level(at, footprint) * frame.foam_gain, vec2f(0.0), vec2f(1.0));
  var out: WaterFoam;
  out.plume = foam.x;
  out.grain = 0.5;
  out.cover = foam.x;
  if foam.x < 0.002 {
    out.cover = 0.0;
    return out;
  }
  // Grain in coordinates along and across the wind, drawn out along it in a gale: streaks.
  let w = frame.downwind;
  let long = 1.0 + 2.2 * smoothstep(8.0, 24.0, frame.wind_m_s);
  let scale = 1.0 / 42.0;
  let turn = mat2x2f(w.x * scale / long, -w.y * scale, w.y * scale / long, w.x * scale);
  // Whole multiples of one tile, so that the eye's foot can be taken modulo the tile.
  let uv = frame.grain + turn * at;
  let gx = turn * dx;
  let gy = turn * dy;
  let lace = textureSampleGrad(noise_map, noise_sampler, uv * 6.0, gx * 6.0, gy * 6.0);
  let fine = textureSampleGrad(noise_map, noise_sampler, uv.yx * 22.0, gx.yx * 22.0, gy.yx * 22.0);
  let wide = textureSampleGrad(noise_map, noise_sampler, uv, gx, gy);
  // Old foam is a net of thin strands, fresh foam is a closed mass of bubbles.
  let fresh = smoothstep(0.0, 0.5, foam.y);
  let height = mix(0.52 * lace.r + 0.22 * fine.r + 0.26 * wide.b, 0.45 * lace.r + 0.3 * wide.b + 0.25 * fine.g, fresh);
  // A sum of three uniform variables: near-normal around 0.5; this makes the covered share equal the foam.
  let z = (height - 0.5) / 0.178;
  let level = 1.0 / (1.0 + exp(-1.702 * z));
  let texel = 6.0 * (length(gx) + length(gy));
  let blur = clamp(0.10 + 14.0 * texel, 0.10, 1.0);
  let wanted = clamp(foam.x * 1.05, 0.0, 1.0);
  let cut = smoothstep(1.0 - wanted - blur * 0.5, 1.0 - wanted + blur * 0.5, level + 0.02 * (fine.g - 0.5));
  out.cover = mix(cut * mix(0.78, 1.0, fresh), wanted, smoothstep(0.4, 1.0, blur));
  out.grain = mix(fine.g, 0.5, smoothstep(0.2, 0.8, blur));
  return out;
}
