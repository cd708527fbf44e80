// A whole inverse transform of one line by plain radix 2 in workgroup memory, a thread for every point: the usual first step
// from a dispatch per stage to one per axis. It is here to be measured beside the others.

override N: u32 = 256u;

struct Line {
  unused: u32,
  vertical: u32,
}

@group(0) @binding(0) var<uniform> line: Line;
@group(0) @binding(1) var butterfly: texture_2d<f32>;
@group(0) @binding(2) var source: texture_2d<f32>;
@group(0) @binding(3) var sink: texture_storage_2d<rg32float, write>;

var<workgroup> points: array<vec2f, N>;

@compute @workgroup_size(N)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
  let t = local.x;
  let at = select(vec2u(t, group.x), vec2u(group.x, t), line.vertical != 0u);
  points[t] = textureLoad(source, at, 0).xy;
  workgroupBarrier();
  for (var stage = 0u; (1u << stage) < N; stage++) {
    let b = textureLoad(butterfly, vec2u(t, stage), 0);
    let u = points[u32(b.z)];
    let v = points[u32(b.w)];
    let sum = u + vec2f(b.x * v.x - b.y * v.y, b.x * v.y + b.y * v.x);
    workgroupBarrier();
    points[t] = sum;
    workgroupBarrier();
  }
  textureStore(sink, at, vec4f(points[t], 0.0, 0.0));
}
