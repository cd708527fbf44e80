// The water around floating objects: ripples and foam at the water line, less skylight close to a hull, and the wake of
// a yacht: foam of the bow wave and behind the stern, water that the hull has smoothed, and Kelvin's waves.

// Tangent of the angle of 19.47 degrees between the track of a ship and the edge of its wake (Kelvin 1887).
const WAKE_EDGE = 0.35355;
// Direction (astern, sideways) in which the waves at the edge travel, 35.26 degrees from the track, and their length
// relative to that of the waves that follow the ship.
const WAKE_EDGE_TRAVEL = vec2f(0.8165, 0.5774);
const WAKE_EDGE_LENGTH = 0.66667;
// Distance from a hull over which its foam and its ripples fade, m, and over which it hides much of the sky.
const WAKE_LINE_M = 0.16;
const WAKE_RIPPLE_M = 1.1;
const WAKE_DARK_M = 0.6;
// Distance beyond a hull at which it changes nothing, m.
const WAKE_REACH_M = 4.0;
// Length of the drawn wake, m; and times, s, in which these fall to 1/e: the white water that the stern churns up, the foam
// that it leaves, the bubbles below that foam, and the smoothness of the water.
const WAKE_LONGEST_M = 90.0;
const WAKE_CHURN_S = 1.2;
const WAKE_FOAM_S = 5.0;
const WAKE_BUBBLES_S = 12.0;
const WAKE_SMOOTH_S = 48.0;

// Changes of the water at a point by floating objects: waves, roughness, foam and shade.
struct Wake {
  // Slope of the waves that the hulls make, and the fraction of the unresolved slope variance that they leave.
  slope: vec2f,
  rough: f32,
  // Fraction of the surface that their foam covers, and the distance (x, z) by which it has moved, m.
  foam: f32,
  // Share of that foam that is as white as the front of a breaker, and bubbles below it: `fresh` and `plume` of FoamAmount.
  fresh: f32,
  plume: f32,
  drift_m: vec2f,
  // Fraction of the skylight that reaches the water.
  open: f32,
}

// The part of a sine wave of wave number `k`, rad/m, that is left in the mean over a pixel of the length `pixel_m`.
fn wake_kept(k: f32, pixel_m: f32) -> f32 {
  let phase = k * pixel_m;
  return exp(-min(phase * phase / 24.0, 40.0));
}

// Slope (astern, to the side) of the waves at the edge of the wake, where both systems of Kelvin's waves meet. They
// begin `start_m` beside the middle line.
fn wake_edge(k: f32, astern_m: f32, aside_m: f32, start_m: f32, pixel_m: f32) -> vec2f {
  let edge_k = k / WAKE_EDGE_LENGTH;
  let behind_m = max(astern_m, 0.0);
  let off = (aside_m - start_m - WAKE_EDGE * behind_m) * edge_k * 0.32;
  let near_edge = exp(-min(off * off, 40.0)) * inverseSqrt(1.0 + k * behind_m / 6.2832)
    * smoothstep(-0.5, 0.5, astern_m);
  let wave = cos(edge_k * dot(WAKE_EDGE_TRAVEL, vec2f(astern_m, aside_m - start_m)) - 0.6);
  return (0.4 * near_edge * wave * wake_kept(edge_k, pixel_m)) * WAKE_EDGE_TRAVEL;
}

// Kelvin's waves and the foam of a hull that makes way. `astern_m` counts from the bow, `aside_m` from the middle
// line; the hull is `length_m` long and `half_m` wide to each side. Returns a Wake whose slope is astern and to the side.
fn wake_under_way(speed_m_s: f32, astern_m: f32, aside_m: f32, length_m: f32, half_m: f32, pixel: vec2f) -> Wake {
  // Transverse waves that keep up with the hull: k = g / speed^2.
  let k = 9.81 / (speed_m_s * speed_m_s);
  let strength = min(speed_m_s * speed_m_s / 9.0, 1.0);
  let behind_m = max(astern_m, 0.0);
  let edge_m = 0.6 * half_m + WAKE_EDGE * behind_m;
  let past_m = astern_m - length_m;
  // Bow and stern each make waves that run away to the sides.
  var slope = strength * (wake_edge(k, astern_m, aside_m, 0.6 * half_m, pixel.x)
    + 0.7 * wake_edge(k, past_m, aside_m, 0.7 * half_m, pixel.x));
  // Behind the stern, between the edges.
  let within = saturate(1.5 - 1.5 * aside_m / max(edge_m, 0.1)) * smoothstep(-1.0, 1.5, past_m);
  let spread = inverseSqrt(1.0 + k * behind_m / 6.2832);
  slope.x += 0.16 * strength * within * cos(k * past_m) * spread * wake_kept(k, pixel.x);
  // Water that the hull has churned spreads slowly.
  let churned_m = 0.65 * half_m + 0.22 * sqrt(max(past_m, 0.0));
  let across = aside_m / (churned_m + pixel.y);
  let band = strength * exp(-min(across * across * across * across, 40.0)) * smoothstep(-0.4, 0.4, past_m);
  let old = max(past_m, 0.0) / speed_m_s;
  let churn = exp(-old / WAKE_CHURN_S);
  var foam = band * (0.5 * churn + 0.45 * exp(-old / WAKE_FOAM_S));
  // The bow wave breaks along the edge, beside the hull and a little behind it.
  let crest = (aside_m - edge_m - 0.1) / (0.28 + 0.05 * behind_m + pixel.y);
  let bow = 0.95 * strength * exp(-min(crest * crest + behind_m / (1.5 * speed_m_s), 40.0))
    * smoothstep(-0.6, 0.3, astern_m);
  let fresh = (foam * mix(0.25, 0.9, churn) + bow * 0.9) / max(foam + bow, 1e-4);
  foam = max(foam, bow);
  let rough = 1.0 - 0.75 * band * exp(-old / WAKE_SMOOTH_S);
  return Wake(slope, rough, foam, fresh, 0.8 * band * exp(-old / WAKE_BUBBLES_S), vec2f(0.0), 1.0);
}

// Changes of the water by floating objects at a position (x, z) relative to the point below the eye. `pixel` is the longer
// and the shorter side of the pixel there, m.
fn wake_at(place: vec2f, pixel: vec2f) -> Wake {
  var out = Wake(vec2f(0.0), 1.0, 0.0, 0.0, 0.0, vec2f(0.0), 1.0);
  for (var i = 0u; i < hull_images.count; i++) {
    // The section at the water line.
    let middle = hull_images.hulls[i].sections[1].middle;
    let half = vec2f(hull_images.hulls[i].sections[1].half_length_m, hull_images.hulls[i].sections[1].half_width_m);
    let speed_m_s = hull_images.hulls[i].speed_m_s;
    let off = place - middle.xz;
    let astern = -hull_images.hulls[i].ahead;
    let starboard = vec2f(astern.y, -astern.x);
    let at = vec2f(dot(off, astern), dot(off, starboard));
    // Most of the sea lies before the bow, beyond the end of the wake, or outside its edges.
    let longest_m = select(0.0, WAKE_LONGEST_M, speed_m_s > 0.3);
    let past_m = at.x - half.x - WAKE_REACH_M;
    let outer_m = half.y + WAKE_REACH_M + select(0.0, 1.5 * WAKE_EDGE * (at.x + half.x), longest_m > 0.0 && at.x > 0.0);
    if at.x < -half.x - WAKE_REACH_M || past_m > longest_m || abs(at.y) > outer_m {
      continue;
    }
    let side = select(-1.0, 1.0, at.y > 0.0);
    // Distance from the ellipse of the water line, to first order.
    let q = at / half;
    let r = max(length(q), 0.05);
    let gradient = q / half;
    let away = gradient * inverseSqrt(max(dot(gradient, gradient), 1e-6));
    let from_hull_m = max((r - 1.0) * r * inverseSqrt(max(dot(gradient, gradient), 1e-6)), 0.0);
    let wide_m = max(WAKE_LINE_M, 0.7 * pixel.y);
    let line = hull_images.hulls[i].line_foam * (WAKE_LINE_M / wide_m) * exp(-min(from_hull_m / wide_m, 40.0));
    // Ripples run away from a hull that the waves move.
    let k = 6.2832 / 0.55;
    let ripple = hull_images.hulls[i].line_foam * exp(-min(from_hull_m / WAKE_RIPPLE_M, 40.0))
      * cos(k * from_hull_m - hull_images.hulls[i].ripple_phase) * wake_kept(k, pixel.x);
    var slope = 0.22 * ripple * away;
    var foam = line;
    var fresh = 0.6;
    if speed_m_s > 0.3 {
      let way = wake_under_way(speed_m_s, at.x + half.x, abs(at.y), 2.0 * half.x, half.y, pixel);
      let fades = saturate(3.0 - 3.0 * at.x / WAKE_LONGEST_M);
      slope += fades * vec2f(way.slope.x, side * way.slope.y);
      let own = fades * way.foam;
      fresh = (fresh * line + way.fresh * own) / max(line + own, 1e-4);
      foam = max(line, own);
      out.plume = max(out.plume, fades * way.plume);
      out.rough *= mix(1.0, way.rough, fades);
    }
    out.slope += slope.x * astern + slope.y * starboard;
    if foam > out.foam {
      out.foam = foam;
      out.fresh = fresh;
      out.drift_m = hull_images.hulls[i].drift_m * astern;
    }
    out.open *= 1.0 - 0.65 * exp(-min(from_hull_m / WAKE_DARK_M, 40.0));
  }
  return out;
}

// Adds the foam of the hulls to that of the sea. Bubbles lie below it.
fn wake_add_foam(foam: FoamAmount, wake: Wake) -> FoamAmount {
  let added = wake.foam * (1.0 - foam.cover);
  let cover = foam.cover + added;
  let fresh = (foam.fresh * foam.cover + wake.fresh * added) / max(cover, 1e-4);
  let young = (foam.young * foam.cover + added) / max(cover, 1e-4);
  return FoamAmount(cover, fresh, max(foam.plume, max(wake.plume, wake.foam)), young);
}
