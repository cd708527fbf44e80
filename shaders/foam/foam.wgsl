// Simulates foam on clipmap levels that are fixed to the world, in undisplaced coordinates. Cell (X, Z) of a level
// covers [X, X + 1) x [Z, Z + 1) texels and is stored at (X, Z) mod size. So a moving camera only rewrites cells that
// come into range.
//
// The source s in [0, 1] is positive where the Jacobian of the displacement by all cascades falls below a threshold.
// The foam F follows dF/dt = rate s (1 - F) - F / decay time, solved exactly over the time step. So the result does not
// depend on the frame rate and stays in [0, 1]. The breaker's front, thick foam that grows and decays fast, and the
// plume of bubbles below, which lasts longest, follow the same equation. So the picture tells young foam from old.

// The structs `Sea` and `Foam` are declared in src/sim/uniforms.rs.

@group(0) @binding(0) var<uniform> sea: Sea;
@group(0) @binding(1) var<uniform> foam: Foam;
@group(0) @binding(2) var displacement: texture_2d_array<f32>;
@group(0) @binding(3) var gradients: texture_2d_array<f32>;
@group(0) @binding(4) var repeating_sampler: sampler;
@group(0) @binding(5) var<storage, read_write> history: array<f32>; // [level][z][x][foam, front, plume]
@group(0) @binding(6) var foam_out: texture_storage_2d_array<rgba16float, write>;
// With a coast: factors of the layers over its square.
@group(0) @binding(7) var gains_map: texture_2d<f32>;

// Whether the sea runs up to a coast.
override FOAM_COAST: bool = false;

// Foam that a breaker at a coast leaves behind its front, relative to that of one in the open sea with the same source: the
// next one comes a period later, and between them foam is torn to lace over bubbles.
const FOAM_BEHIND_ROLLER = 0.65;

// Largest stored excess over the breaking criterion.
const FOAM_MOST_EXCESS = 6.0;

// Range of wave heights, relative to that from which waves break, over which a roller grows.
const FOAM_ROLLER_RANGE = vec2f(0.9, 1.1);
// Phase before the crest at which a roller is strongest, as (cos, sin): in the middle of the front, which surf squeezes.
const FOAM_ROLLER_PHASE = vec2f(0.5, 0.866);

// Rolling foam, 0 to 1, of waves whose elevation is the real part of 2 z, and whose height is `over` relative to that from
// which they break.
fn foam_roller(z: vec2f, over: f32) -> f32 {
  let before_crest = 0.5 + 0.5 * dot(z, FOAM_ROLLER_PHASE) / max(length(z), 1e-9);
  // Half of the roller's strength is left 0.6 rad from its middle, which is a tenth of the wave's length.
  var window = before_crest * before_crest;
  window *= window;
  return maths_rise(over, FOAM_ROLLER_RANGE) * window * window;
}

// Factors of ordinary cascades, offshore waves and waves at the coast (x, y, z) at an offset, m, from a level's corner.
fn foam_coast_gains(level: u32, offset: vec2f) -> vec3f {
  let map = foam.levels[level];
  let half_texel = 0.5 / vec2f(textureDimensions(gains_map));
  let uv = clamp(map.coast_uv + offset * (map.coast_uv_per_cell / map.cell_m), half_texel, 1.0 - half_texel);
  return textureSampleLevel(gains_map, repeating_sampler, uv, 0.0).xyz;
}

struct FoamWaves {
  // Jacobian of the displaced surface.
  jacobian: f32,
  // Rolling foam of waves that break at a coast, 0 to 1.
  roller: f32,
}

// The waves at an offset, m, from a level's corner, with the blend of water/surface.wgsl.
fn foam_waves(level: u32, offset: vec2f) -> FoamWaves {
  var stretch = vec2f(0.0);
  var shear = vec2f(0.0);
  var roller = 0.0;
  var gains = vec3f(1.0);
  if FOAM_COAST {
    gains = foam_coast_gains(level, offset);
  }
  for (var c = 0u; c < foam.cascade_count; c++) {
    let corner = foam.levels[level].corners[c];
    let patch_m = foam.cascades[c].patch_m;
    let layer = foam.cascades[c].layer;
    let uv = corner.uv + offset / patch_m;
    // Waves shorter than a breaker's texel make no foam, so fine cells read coarser mip levels. The level is one finer
    // than the texel, because linear interpolation between uncorrelated texels loses variance.
    let texel_m = max(foam.levels[level].cell_m, foam.breaker_texel_m);
    let lod = max(log2(texel_m * f32(sea.n) / patch_m) - 1.0, 0.0);
    var gain = 1.0;
    if FOAM_COAST {
      gain = gains[foam.cascades[c].role];
      if foam.cascades[c].role == 2u {
        let surf = textureSampleLevel(displacement, repeating_sampler, uv, layer + 1u, 0.0);
        roller = gain * foam_roller(surf.xy, surf.z);
      }
    }
    var next = tile_blend(corner.tile_position, offset, true);
    for (var i = 0u; i < TILE_COPIES; i++) {
      let blend = next;
      next = tile_next_copy(blend);
      if blend.weight.x <= 0.0 {
        continue;
      }
      let at = uv + tile_copy_shift(corner.tile_position, blend);
      let g = textureSampleLevel(gradients, repeating_sampler, at, layer, lod);
      let d = textureSampleLevel(displacement, repeating_sampler, at, layer, lod);
      var weight = vec3f(blend.weight.x, tile_weight_gradient(corner.tile_position, blend));
      if FOAM_COAST {
        weight *= gain;
      }
      stretch += weight.x * g.zw + weight.yz * d.xz;
      shear += weight.x * d.ww + weight.zy * d.xz;
    }
  }
  let l = sea.choppiness;
  let jacobian = (1.0 + l.x * stretch.x) * (1.0 + l.y * stretch.y) - l.x * l.y * shear.x * shear.y;
  return FoamWaves(jacobian, roller);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = i32(foam.cells_per_side);
  let level = id.z;
  // `ahead` is the cell that is stored at this texel, counted from the level's first cell.
  let first = foam.levels[level].first_cell;
  let ahead = ((vec2i(id.xy) - first) % size + size) % size;
  let before = first + ahead - foam.levels[level].previous_first_cell;
  let known = all(before >= vec2i(0)) && all(before < vec2i(size));
  let cell_m = foam.levels[level].cell_m;
  let waves = foam_waves(level, (vec2f(ahead) + 0.5) * cell_m);
  // The source rises from 0 to 1 while the excess rises from 1 to 2, so that crests lean before they foam.
  let slope = foam.levels[level].source_slope;
  let over = 1.0 + (foam.levels[level].jacobian_threshold - waves.jacobian) * slope;
  var excess = select(0.0, clamp(over, 0.0, FOAM_MOST_EXCESS), slope > 0.0);
  // Sources of foam, front and plume. A level that is too coarse for the waves that break has the sea's mean foam in all
  // cells, and no leaning crests.
  var source = vec3f(max(saturate(excess - 1.0), foam.levels[level].even_source));
  if FOAM_COAST {
    // A wave that breaks at a coast leans as far as one in the open sea with the same source. All of its roller draws in
    // air, and the middle of it is a front.
    excess = max(excess, 2.0 * waves.roller);
    let square = waves.roller * waves.roller;
    source = max(source, vec3f(FOAM_BEHIND_ROLLER * waves.roller, square * square, waves.roller));
  }

  let at = 3u * ((level * foam.cells_per_side + id.y) * foam.cells_per_side + id.x);
  let initial = foam.levels[level].initial_foam * vec3f(1.0, foam.initial_front_ratio, foam.initial_plume_ratio);
  let old = select(initial, vec3f(history[at], history[at + 1u], history[at + 2u]), known);
  let growth = source * vec3f(foam.growth_per_s, foam.front_growth_per_s, foam.growth_per_s);
  let loss = growth + vec3f(foam.decay_per_s, foam.front_decay_per_s, foam.plume_decay_per_s);
  let goal = growth / loss;
  let left = vec3f(
    maths_exp(-loss.x * foam.dt_s), maths_exp(-loss.y * foam.dt_s), maths_exp(-loss.z * foam.dt_s));
  let now = saturate(goal + (old - goal) * left);
  history[at] = now.x;
  history[at + 1u] = now.y;
  history[at + 2u] = now.z;
  textureStore(foam_out, id.xy, level, vec4f(now.x, excess, now.yz));
}
