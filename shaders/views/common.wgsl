// False colours of the views that replace the picture. The structs are declared in src/render/views.rs.

// Position of a value in the colour scale of a tile, 0 to 1.
fn view_scale_position(value: f32, tile: ViewTile) -> f32 {
  let even = (value - tile.scale_low) / (tile.scale_high - tile.scale_low);
  let log_low = log2(max(tile.scale_low, 1e-30));
  let decades = (log2(max(value, 1e-30)) - log_low) / (log2(max(tile.scale_high, 1e-30)) - log_low);
  return saturate(select(even, decades, view.logarithmic != 0u));
}

// Colour of a value in the scale of a tile. Alpha is 0 for NaN and infinity, which show.wgsl then paints magenta.
fn view_colour(value: f32, tile: ViewTile) -> vec4f {
  if (bitcast<u32>(value) & 0x7f800000u) == 0x7f800000u {
    return vec4f(0.0);
  }
  let at = view_scale_position(value, tile) * 10.0;
  let below = min(u32(at), 9u);
  return vec4f(mix(view.colour_stops[below].rgb, view.colour_stops[below + 1u].rgb, at - f32(below)), 1.0);
}
