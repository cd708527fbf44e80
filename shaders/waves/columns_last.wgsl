// The second half of the transform along z after middle.wgsl, a thread for every x and k1.

@group(0) @binding(0) var<storage, read> halves: array<vec2<u64>>; // [cascade][pair][k1][x / 8][n2][x % 8]
