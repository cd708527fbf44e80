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

// Share of a pixel that is white, and fine relief, at one size of the grain: the tile measures 7 m x 2^octave. The noise is
// equalised, so that a threshold of 1 - c covers the share c. Old foam is a net of thin strands, fresh foam a closed mass.
fn water_foam_grain(uv: vec2f, octave: f32, footprint: f32, wanted: f32, fresh: f32) -> vec2f {
  let shrink = exp2(octave);
  let lod = log2(max(footprint * 512.0 / (7.0 * shrink), 1e-3));
  let noise = textureSampleLevel(noise_map, noise_sampler, uv * (48.0 / shrink), lod);
  // Filtering draws the noise together around its mean; the threshold softens with it.
  let soft = clamp(0.22 + 0.12 * max(lod - 3.0, 0.0), 0.22, 1.0);
  let height = mix(noise.r, noise.b, 0.6 * fresh) + 0.22 * (noise.g - 0.5);
  let cover = smoothstep(1.0 - wanted - 0.5 * soft, 1.0 - wanted + 0.5 * soft, height);
  // Thin foam lets the water through; only a fresh crest is closed.
  return vec2f(cover * mix(0.55 + 0.3 * noise.g, 1.0, max(fresh, wanted * wanted)), noise.g);
}

fn water_foam(at: vec2f, dx: vec2f, dy: vec2f) -> WaterFoam {
  let major = max(length(dx), length(dy));
  let minor = min(length(dx), length(dy));
  let footprint = sqrt(major * minor) + 0.1 * major;
  let foam = clamp(water_foam_level(at, footprint) * frame.foam_gain, vec2f(0.0), vec2f(1.0));
  var out: WaterFoam;
  out.plume = foam.x;
  out.grain = 0.5;
  out.cover = 0.0;
  if foam.x < 0.002 {
    return out;
  }
  // Grain in coordinates along and across the wind, drawn out along it in a gale: streaks. Its tile is a divisor of 336 m,
  // modulo which the CPU takes the eye's foot.
  let w = frame.downwind;
  let long = 1.0 + 2.2 * smoothstep(8.0, 24.0, frame.wind_m_s);
  let scale = 1.0 / 336.0;
  let uv = frame.grain + mat2x2f(w.x * scale / long, -w.y * scale, w.y * scale / long, w.x * scale) * at;
  let wanted = clamp(foam.x * 1.05, 0.0, 1.0);
  let fresh = smoothstep(0.0, 0.5, foam.y);
  // Grain as fine as the picture shows, so that whitecaps keep edges at any distance instead of fading to grey.
  let octave = clamp(log2(max(footprint * 45.0 / 7.0, 1e-3)), 0.0, 4.0);
  let low = min(floor(octave), 3.0);
  let a = water_foam_grain(uv, low, footprint, wanted, fresh);
  let b = water_foam_grain(uv, low + 1.0, footprint, wanted, fresh);
  let mixed = mix(a, b, octave - low);
  let far = smoothstep(1.5, 6.0, footprint / 7.0);
  out.cover = mix(mixed.x, wanted, far);
  out.grain = mix(mixed.y, 0.5, far);
  return out;
}
