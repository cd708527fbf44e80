// The second half of the transform along z by itself, a thread for every x and k1.

@group(0) @binding(0) var<storage, read> halves: array<vec4f>; // [cascade][pair][k1][n2][x]
