// Mip pass for GPUs: up to four mip levels in one dispatch. A workgroup covers 16 x 16 texels of the level that is
// read. Its threads pass their means on through workgroup memory.

override LEVELS_WRITTEN: u32 = 4u; // number of mip levels that are written

@group(0) @binding(2) var target_level_1: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(3) var target_level_2: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(4) var target_level_3: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(5) var target_level_4: texture_storage_2d_array<rgba16float, write>;

var<workgroup> mips_workgroup_means: array<MipTexels, 64>;

fn mips_store(level: u32, at: vec2u, layer: u32, mean: MipTexels) {
  let layers_per_kind = mips_layers_per_kind();
  switch level {
    case 1u: {
      textureStore(target_level_1, at, layer, mean.displacement);
      textureStore(target_level_1, at, layers_per_kind + layer, mean.gradients);
      textureStore(target_level_1, at, 2u * layers_per_kind + layer, mean.moments);
    }
    case 2u: {
      textureStore(target_level_2, at, layer, mean.displacement);
      textureStore(target_level_2, at, layers_per_kind + layer, mean.gradients);
      textureStore(target_level_2, at, 2u * layers_per_kind + layer, mean.moments);
    }
    case 3u: {
      textureStore(target_level_3, at, layer, mean.displacement);
      textureStore(target_level_3, at, layers_per_kind + layer, mean.gradients);
      textureStore(target_level_3, at, 2u * layers_per_kind + layer, mean.moments);
    }
    default: {
      textureStore(target_level_4, at, layer, mean.displacement);
      textureStore(target_level_4, at, layers_per_kind + layer, mean.gradients);
      textureStore(target_level_4, at, 2u * layers_per_kind + layer, mean.moments);
    }
  }
}

@compute @workgroup_size(8, 8)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
  let layer = sea.first_layer + group.z;
  // If a level is smaller than a workgroup, stores outside the level have no effect.
  var mean = mips_mean_of_four(8u * group.xy + local.xy, group.z);
  mips_store(1u, 8u * group.xy + local.xy, layer, mean);
  for (var level = 2u; level <= LEVELS_WRITTEN; level++) {
    let side = 16u >> level;
    workgroupBarrier();
    mips_workgroup_means[8u * local.y + local.x] = mean;
    workgroupBarrier();
    if local.x < side && local.y < side {
      var sum: MipTexels;
      for (var i = 0u; i < 4u; i++) {
        let part = mips_workgroup_means[8u * (2u * local.y + (i >> 1u)) + 2u * local.x + (i & 1u)];
        sum.displacement += part.displacement;
        sum.gradients += part.gradients;
        sum.moments += part.moments;
      }
      mean = MipTexels(0.25 * sum.displacement, 0.25 * sum.gradients, 0.25 * sum.moments);
      mips_store(level, side * group.xy + local.xy, layer, mean);
    }
  }
}
