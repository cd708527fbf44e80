// Maps of the simulation, texel by texel: x (east) to the right, -z (north) up. Spectra have k = 0 in the middle.

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var displacement_map: texture_2d_array<f32>;
@group(0) @binding(2) var gradients_map: texture_2d_array<f32>;
@group(0) @binding(3) var moments_map: texture_2d_array<f32>;
@group(0) @binding(4) var foam_map: texture_2d_array<f32>;
@group(0) @binding(5) var<storage, read> h0: array<vec2f>; // h0(k), [cascade][iz][ix]
@group(0) @binding(6) var<storage, read> wave_table: array<vec2u>; // x: cycles of a wave per repeat period

fn view_initial_amplitude(at: vec2u, layer: u32, n: u32) -> vec2f {
  return h0[(layer * n + at.y) * n + at.x];
}

// Amplitude h(k, t) of a wave at the time of the maps; the same formula as in evolve.wgsl.
fn view_amplitude(at: vec2u, layer: u32, n: u32) -> vec2f {
  let a = view_initial_amplitude(at, layer, n);
  let b = view_initial_amplitude((vec2u(n) - at) & vec2u(n - 1u), layer, n);
  let own = sea_wave_table_entry(sea_signed_index(at.x, n), sea_signed_index(at.y, n));
  let entry = layer * sea_wave_table_len(n) + own;
  let cs = maths_cos_sin(wave_table[entry].x * view.period_fraction_u32);
  let forward = vec2f(a.x * cs.x + a.y * cs.y, a.y * cs.x - a.x * cs.y);
  let backward = vec2f(b.x * cs.x + b.y * cs.y, b.x * cs.y - b.y * cs.x);
  return forward + backward;
}

// Number of texels along a side of the map that is shown.
fn view_map_side() -> u32 {
  switch view.view_kind {
    case 11u, 12u, 13u: { return textureDimensions(moments_map).x; }
    case 15u, 16u: { return textureDimensions(foam_map).x; }
    default: { return textureDimensions(gradients_map).x; }
  }
}

fn view_value(at: vec2u, layer: u32) -> f32 {
  let d = textureLoad(displacement_map, at, layer, 0);
  let g = textureLoad(gradients_map, at, layer, 0);
  switch view.view_kind {
    case 1u: { return length(view_initial_amplitude(at, layer, textureDimensions(gradients_map).x)); }
    case 3u: { return d.x; }
    case 4u: { return d.y; }
    case 5u: { return d.z; }
    case 6u: { return d.w; }
    case 7u: { return g.x; }
    case 8u: { return g.y; }
    case 9u: { return g.z; }
    case 10u: { return g.w; }
    case 11u: { return textureLoad(moments_map, at, layer, 0).x; }
    case 12u: { return textureLoad(moments_map, at, layer, 0).y; }
    case 13u: { return textureLoad(moments_map, at, layer, 0).z; }
    case 14u: {
      let l = view.choppiness;
      return (1.0 + l.x * g.z) * (1.0 + l.y * g.w) - l.x * l.y * d.w * d.w;
    }
    case 15u: { return textureLoad(foam_map, at, layer, 0).x; }
    default: { return saturate(textureLoad(foam_map, at, layer, 0).y - 1.0); }
  }
}

@fragment
fn fragment(in: ScreenVertex) -> @location(0) vec4f {
  let pixel = in.uv * view.size;
  let texels = view_map_side();
  for (var i = 0u; i < view.tile_count; i++) {
    let tile = view.tiles[i];
    let place = (pixel - tile.corner) / tile.side;
    if all(place >= vec2f(0.0)) && all(place < vec2f(1.0)) {
      let at = (vec2u(place * f32(texels)) + tile.first_texel) % texels;
      if view.view_kind != 2u {
        return view_colour(view_value(at, tile.layer), tile);
      }
      let h = view_amplitude(at, tile.layer, texels);
      let grey = view_colour(length(h), tile);
      let phase = maths_phase(h);
      return vec4f(grey.rgb * min(0.6 + 0.6 * cos(phase - vec3f(0.0, 2.0943951, 4.1887902)), vec3f(1.0)), grey.a);
    }
  }
  return vec4f(0.06, 0.07, 0.08, 1.0);
}
