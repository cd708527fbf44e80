// Shadows of waves on waves while the sun is low. A ray from the water towards the sun is compared with the heights of
// the waves of the maps along it, once for each vertex of the mesh, which are far fewer than the pixels. Waves within a
// pixel shade each other statistically (Smith's shadowing in facets.wgsl).

// Number of cascades that cast shadows, and of steps along the ray.
const SHADOW_CASCADES = 4u;
const SHADOW_STEPS = 12;
// Binary logarithm of the number of texels along a patch below which a cascade has faded out.
const SHADOW_LOG_TEXELS_PER_PATCH = 4.0;
// Height, per metre of a step, by which a crest between two steps is higher than the surface at both.
const SHADOW_BETWEEN_STEPS = 0.014;
// Height of the highest crest that is looked for, in significant wave heights; one crest in 3,000 is higher.
const SHADOW_HIGHEST_CREST = 1.0;
// Length of the ray, in significant wave heights: the least height that it gains, and the greatest distance.
const SHADOW_LEAST_RISE = 0.15;
const SHADOW_FARTHEST = 60.0;
// Length of a pixel on the sea, in significant wave heights, at which shadows begin to fade into statistics.
const SHADOW_FADE_START = 1.5;

// Copies of the patches that are visible at the start of a ray: texture coordinates there, and weight. They serve for
// the whole ray, over which the weights change little, and so the heights keep their variance.
alias ShadowCopies = array<vec3f, 12>;

// Index of the cascade that is the `i`-th to cast shadows. In a cross-fade both seas cast some.
fn shadow_cascade(i: u32) -> u32 {
  let fading = frame.fading_cascade_count;
  return i + select(0u, fading - 1u, fading > 0u && i > 0u);
}

fn shadow_copies(at: vec2f) -> ShadowCopies {
  var copies: ShadowCopies;
  var gains: vec3f;
  if WATER_COAST {
    gains = coast_gains(at);
  }
  for (var i = 0u; i < SHADOW_CASCADES; i++) {
    let c = shadow_cascade(i);
    if c >= frame.cascade_count {
      break;
    }
    let map = frame.cascades[c];
    var next = tile_blend(map.tile_position, at, false);
    for (var k = 0u; k < TILE_COPIES; k++) {
      let blend = next;
      next = tile_next_copy(blend);
      if blend.weight.x > WATER_LEAST_COPY_WEIGHT {
        let uv = map.uv_below_eye + at * map.inverse_patch + tile_copy_shift(map.tile_position, blend);
        var weight = blend.weight.x;
        if WATER_COAST {
          weight *= coast_gain(map, gains);
        }
        copies[3u * i + k] = vec3f(uv, weight);
      }
    }
  }
  return copies;
}

// Displacement by the waves, filtered over 2^`log_size_m` metres, at the undisplaced offset `off`, m, from the start of
// a ray.
fn shadow_displacement(copies: ptr<function, ShadowCopies>, off: vec2f, log_size_m: f32) -> vec3f {
  var sum = vec3f(0.0);
  // As in water_displacement.
  var bound_m = 0.0;
  var longer = vec3f(0.0, frame.bound_elevation_gain, 0.0);
  // Mip level at which a cascade has faded out: its longest waves are two texels long.
  let coarsest_lod = log2(frame.n) - SHADOW_LOG_TEXELS_PER_PATCH;
  for (var i = 0u; i < SHADOW_CASCADES; i++) {
    let map = frame.cascades[shadow_cascade(i)];
    let lod = log_size_m + map.log_texels_per_m;
    let share = saturate(coarsest_lod - lod);
    if share <= 0.0 {
      continue;
    }
    let along = off * map.inverse_patch;
    var own = vec3f(0.0);
    for (var k = 0u; k < TILE_COPIES; k++) {
      let copy = (*copies)[3u * i + k];
      if copy.z > 0.0 {
        own += copy.z * textureSampleLevel(displacement_map, trilinear_sampler, copy.xy + along, map.layer, lod).xyz;
      }
    }
    own *= share;
    sum += own;
    bound_m += dot(own, map.bound_own.yxy * (0.5 * own) + longer);
    longer += own * map.bound_with_shorter.yxy;
  }
  sum.y += bound_m;
  return sum * vec3f(frame.choppiness.x, 1.0, frame.choppiness.y);
}

// Fraction of the sun's disc that the waves leave visible from an undisplaced position, averaged over a footprint that
// is `size_m` metres wide.
fn shadow_visible_sun(at: vec2f, size_m: f32) -> f32 {
  let fade = 1.0 - maths_smooth(size_m / (SHADOW_FADE_START * frame.hs_m) - 1.0);
  if fade <= 0.0 {
    return 1.0;
  }
  let l = frame.sun_direction;
  let over_across = inverseSqrt(max(dot(l.xz, l.xz), 1e-6));
  let toward = l.xz * over_across;
  let rise = max(l.y * over_across, 1e-3);
  let log_pixel_m = log2(max(WATER_TAP_TEXEL_RATIO * size_m, 1e-6));
  var copies = shadow_copies(at);
  let start = shadow_displacement(&copies, vec2f(0.0), log_pixel_m);
  let to_crest_m = max(SHADOW_HIGHEST_CREST * frame.hs_m - start.y, SHADOW_LEAST_RISE * frame.hs_m);
  let length_m = min(to_crest_m / rise, SHADOW_FARTHEST * frame.hs_m);
  // Half the height of the sun's disc per metre, and half that of a pixel. Water beside the start is no obstacle.
  let disc = min(sqrt(8.0 * frame.sun_slope_variance), 0.5 * rise);
  let pixel_m = 0.5 * size_m * max(rise, 0.1);
  var moved = vec2f(0.0);
  // Clearances of the ray, in half widths of the penumbra, at the last three steps, and the least. The first step is no
  // lowest point.
  var before = -1e3;
  var here = -1e3;
  var least = 1e3;
  var distance_m = 0.0;
  for (var i = 1; i <= SHADOW_STEPS; i++) {
    let part = f32(i) * (1.0 / f32(SHADOW_STEPS));
    let next_m = length_m * part * part;
    let step_m = next_m - distance_m;
    distance_m = next_m;
    // The waves have moved the water that is now over the ray, about as far as that of the step before.
    let off = toward * distance_m - moved;
    let d = shadow_displacement(&copies, off, max(log2(0.3 * step_m), log_pixel_m)) - start;
    moved = d.xz;
    let along_m = max(dot(off + moved, toward), 1e-4);
    let half_width_m = along_m * disc + min(pixel_m, 0.1 * along_m * rise);
    let after = (along_m * rise - d.y - SHADOW_BETWEEN_STEPS * step_m) / half_width_m;
    // The lowest point of a parabola through three steps.
    let bend = before - 2.0 * here + after;
    let fall = before - after;
    let is_lowest = here < before && here <= after;
    least = min(least, select(after, here - fall * fall / max(8.0 * bend, 1e-6), is_lowest));
    if least <= -1.0 {
      return 1.0 - fade;
    }
    before = here;
    here = after;
  }
  return mix(1.0, maths_smooth(0.5 + 0.5 * least), fade);
}
