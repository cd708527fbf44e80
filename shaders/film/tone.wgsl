// Turns the linear light of a picture into the colours of the screen, at the picture's size: smoothed edges, bloom,
// exposure, local exposure, tone curve, encoding, dither.

// Whether edges are smoothed. A reference picture averages samples instead.
override TONE_SMOOTH: bool = true;

@group(0) @binding(0) var<uniform> tone: Tone;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var hdr_map: texture_2d<f32>;
@group(0) @binding(3) var hdr_sampler: sampler;
@group(0) @binding(4) var bloom_map: texture_2d<f32>;
@group(0) @binding(5) var local_map: texture_2d<f32>;

// Noise of a pixel for dithering, -0.5 to 0.5: Jimenez's interleaved gradient noise, which is even among neighbours.
fn tone_noise(pixel: vec2f) -> f32 {
  return fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715)))) - 0.5;
}

fn tone_exposure() -> f32 {
  return tone.exposure_gain * select(light.exposure, tone.fixed_exposure, tone.fixed_exposure > 0.0);
}

// Binary logarithm of the exposed luminance above which an area of the picture is bright, and the width of the transition.
const TONE_BRIGHT = -1.0;
const TONE_BRIGHT_SOFT = 0.6;

// Mean binary logarithm of the luminance around a place, from a cubic B-spline over the cells of the picture, as four
// linear samples (Sigg and Hadwiger, GPU Gems 2, chapter 20).
fn tone_brightness_around(uv: vec2f) -> f32 {
  let size = vec2f(textureDimensions(local_map));
  let p = uv * size - 0.5;
  let f = fract(p);
  let g = 1.0 - f;
  // Weights of the B-spline: of the cell before the place, and of both cells before it; the rest is of both after it.
  let nearer = (4.0 + 3.0 * f * f * (f - 2.0)) / 6.0;
  let low = nearer + g * g * g / 6.0;
  let high = 1.0 - low;
  let before = (p - f - 0.5 + nearer / low) / size;
  let after = (p - f + 1.5 + f * f * f / (6.0 * high)) / size;
  let upper = low.x * textureSampleLevel(local_map, hdr_sampler, before, 0.0).r
    + high.x * textureSampleLevel(local_map, hdr_sampler, vec2f(after.x, before.y), 0.0).r;
  let lower = low.x * textureSampleLevel(local_map, hdr_sampler, vec2f(before.x, after.y), 0.0).r
    + high.x * textureSampleLevel(local_map, hdr_sampler, after, 0.0).r;
  return low.y * upper + high.y * lower;
}

// Factor on the exposure at a place of the picture: bright areas are exposed less.
fn tone_local_gain(uv: vec2f, exposure: f32) -> f32 {
  let over = tone_brightness_around(uv) + log2(exposure) - TONE_BRIGHT;
  let bright = 0.5 * (over + sqrt(over * over + TONE_BRIGHT_SOFT * TONE_BRIGHT_SOFT));
  return exp2(-tone.local_exposure * bright);
}

// Exposed light, compressed below 1 so that a glint does not outshine an edge that it is averaged with.
fn tone_compress(exposed: vec3f) -> vec3f {
  return exposed / (1.0 + sky_luminance(exposed));
}

// Luminance of a pixel's compressed light.
fn tone_compressed_luminance(hdr: vec4f, exposure: f32) -> f32 {
  let luminance = exposure * sky_luminance(hdr.rgb);
  return luminance / (1.0 + luminance);
}

fn tone_compressed_sample(uv: vec2f, exposure: f32) -> vec3f {
  return tone_compress(exposure * textureSampleLevel(hdr_map, hdr_sampler, uv, 0.0).rgb);
}

// Smallest step in distance that counts as an edge, m; less is one surface, whatever its slope.
const TONE_MIN_EDGE_M = 1.5;
// Smallest step in distance that counts as an edge, divided by the distance.
const TONE_MIN_EDGE_RATIO = 0.05;
// Step in distance, divided by the distance, that always counts as an edge, however near the eye.
const TONE_SURE_EDGE_RATIO = 0.2;

// Exposed light of the pixel around `uv`, with edges smoothed along their direction after FXAA by Timothy Lottes
// (2009). Crests and the horizon need it, at one sample per pixel. Foam and glitter lie on one surface and are filtered
// already: only where the distance has an edge, or frame_edged_nearness says so, are the diagonal neighbours looked at.
fn tone_edges_smoothed(hdr: vec4f, at: vec2i, uv: vec2f, exposure: f32) -> vec3f {
  let exposed = hdr.rgb * exposure;
  // Each gather returns the distances of four neighbours: west, here, north, north-west, and south, south-east, east,
  // here. Alpha is 1 + 1e4 / distance (frame.wgsl).
  let half_pixel = 0.5 / tone.size;
  let before = textureGather(3, hdr_map, hdr_sampler, uv - half_pixel);
  let after = textureGather(3, hdr_map, hdr_sampler, uv + half_pixel);
  let bends = abs(before.xzw + after.zxy - 2.0 * hdr.a);
  // The bend is compared with the change of alpha over the smallest step in distance that counts.
  let nearness = hdr.a - 1.0;
  let least = clamp(1e-4 * TONE_MIN_EDGE_M * nearness, TONE_MIN_EDGE_RATIO, TONE_SURE_EDGE_RATIO);
  if max(bends.x, max(bends.y, bends.z)) <= nearness * least {
    return exposed;
  }
  let low_at = max(at - 1, vec2i(0));
  let high_at = min(at + 1, vec2i(tone.size) - 1);
  let nw = textureLoad(hdr_map, low_at, 0);
  let ne = textureLoad(hdr_map, vec2i(high_at.x, low_at.y), 0);
  let sw = textureLoad(hdr_map, vec2i(low_at.x, high_at.y), 0);
  let se = textureLoad(hdr_map, high_at, 0);
  let here = tone_compressed_luminance(hdr, exposure);
  // Luminances of the diagonal neighbours: nw, ne, sw, se.
  let l = vec4f(
    tone_compressed_luminance(nw, exposure), tone_compressed_luminance(ne, exposure),
    tone_compressed_luminance(sw, exposure), tone_compressed_luminance(se, exposure));
  let low = min(here, min(min(l.x, l.y), min(l.z, l.w)));
  let high = max(here, max(max(l.x, l.y), max(l.z, l.w)));
  if high - low <= max(0.03, 0.16 * high) {
    return exposed;
  }
  let across = vec2f(l.z + l.w - l.x - l.y, l.x + l.z - l.y - l.w);
  let reduce = max((l.x + l.y + l.z + l.w) * 0.03, 0.008);
  let pixels = clamp(across / (min(abs(across.x), abs(across.y)) + reduce), vec2f(-6.0), vec2f(6.0));
  let along = pixels / tone.size;
  let inner =
    0.5 * (tone_compressed_sample(uv - along / 6.0, exposure) + tone_compressed_sample(uv + along / 6.0, exposure));
  let ends = tone_compressed_sample(uv - 0.5 * along, exposure) + tone_compressed_sample(uv + 0.5 * along, exposure);
  let outer = 0.5 * inner + 0.25 * ends;
  let luminance = sky_luminance(outer);
  let smoothed = select(outer, inner, luminance < low || luminance > high);
  return smoothed / max(1.0 - sky_luminance(smoothed), 1e-5);
}

// The colour of a pixel with its luma in alpha, by which the present pass finds edges.
fn tone_with_luma(colour: vec3f) -> vec4f {
  return vec4f(colour, sky_luminance(colour));
}

@fragment
fn fragment(in: ScreenVertex) -> @location(0) vec4f {
  let at = vec2i(in.clip.xy);
  let hdr = textureLoad(hdr_map, at, 0);
  // Light or values of a view that are not finite; see frame_hdr_output.
  if hdr.a < 0.99 {
    return tone_with_luma(vec3f(1.0, 0.0, 1.0));
  }
  if tone.is_encoded != 0u {
    return tone_with_luma(hdr.rgb);
  }
  var exposure = tone_exposure();
  if tone.local_exposure > 0.0 {
    exposure *= tone_local_gain(in.uv, exposure);
  }
  var exposed = hdr.rgb * exposure;
  if TONE_SMOOTH {
    exposed = tone_edges_smoothed(hdr, at, in.uv, exposure);
  }
  if tone.bloom_fraction > 0.0 {
    let bloom = textureSampleLevel(bloom_map, hdr_sampler, in.uv, 0.0).rgb * exposure;
    exposed = mix(exposed, bloom, tone.bloom_fraction);
  }
  return tone_with_luma(tone_encoded(tone.curve, exposed) + tone_noise(in.clip.xy) * tone.dither);
}
