// False colours of the views. The structs are declared in src/render/views.rs.

// Place of a value in its scale, 0 to 1.
fn view_share(value: f32, tile: ViewTile) -> f32 {
  let even = (value - tile.low) / (tile.high - tile.low);
  let log_low = log2(max(tile.low, 1e-30));
  let decades = (log2(max(value, 1e-30)) - log_low) / (log2(max(tile.high, 1e-30)) - log_low);
  return clamp(select(even, decades, view.logarithmic != 0u), 0.0, 1.0);
}

// Alpha 0 marks what is not a number, for the last pass to paint.
fn view_colour(value: f32, tile: ViewTile) -> vec4f {
  if (bitcast<u32>(value) & 0x7f800000u) == 0x7f800000u {
    return vec4f(0.0);
  }
  let at = view_share(value, tile) * 10.0;
  let below = min(u32(at), 9u);
  return vec4f(mix(view.stops[below].rgb, view.stops[below + 1u].rgb, at - f32(below)), 1.0);
}
