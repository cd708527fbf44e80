// Mip pass for GPUs: up to four mip levels in one dispatch. A workgroup covers 16 x 16 texels of the level that is
// read. Its threads pass their means on through workgroup memory.

override LEVELS: u32 = 4u; // number of mip levels that are written

@group(0) @binding(2) var below_1: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(3) var below_2: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(4) var below_3: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(5) var below_4: texture_storage_2d_array<rgba16float, write>;

var<workgroup> mips_shared: array<MipsTexel, 64>;

fn mips_store(level: u32, at: vec2u, layer: u32, mean: MipsTexel) {
  let room = mips_room();
  switch level {
    case 1u: {
      textureStore(below_1, at, layer, mean.displacement);
      textureStore(below_1, at, room + layer, mean.gradients);
      textureStore(below_1, at, 2u * room + layer, mean.moments);
    }
    case 2u: {
      textureStore(below_2, at, layer, mean.displacement);
      textureStore(below_2, at, room + layer, mean.gradients);
      textureStore(below_2, at, 2u * room + layer, mean.moments);
    }
    case 3u: {
      textureStore(below_3, at, layer, mean.displacement);
      textureStore(below_3, at, room + layer, mean.gradients);
      textureStore(below_3, at, 2u * room + layer, mean.moments);
    }
    default: {
      textureStore(below_4, at, layer, mean.displacement);
      textureStore(below_4, at, room + layer, mean.gradients);
      textureStore(below_4, at, 2u * room + layer, mean.moments);
    }
  }
}

@compute @workgroup_size(8, 8)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
  let layer = sea.first_layer + group.z;
  // If a level is smaller than a workgroup, stores outside the level have no effect.
  var mean = mips_mean(8u * group.xy + local.xy, group.z);
  mips_store(1u, 8u * group.xy + local.xy, layer, mean);
  for (var level = 2u; level <= LEVELS; level++) {
    let side = 16u >> level;
    workgroupBarrier();
    mips_shared[8u * local.y + local.x] = mean;
    workgroupBarrier();
    if local.x < side && local.y < side {
      var sum: MipsTexel;
      for (var i = 0u; i < 4u; i++) {
        let part = mips_shared[8u * (2u * local.y + (i >> 1u)) + 2u * local.x + (i & 1u)];
        sum.displacement += part.displacement;
        sum.gradients += part.gradients;
        sum.moments += part.moments;
      }
      mean = MipsTexel(0.25 * sum.displacement, 0.25 * sum.gradients, 0.25 * sum.moments);
      mips_store(level, side * group.xy + local.xy, layer, mean);
    }
  }
}
