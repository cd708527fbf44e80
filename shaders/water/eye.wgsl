// Keeps the eye above the water: one workgroup samples the waves around the eye and raises it above them, in the frame
// uniform that later passes read. The result depends only on the maps, so a still depends only on the state.

@group(0) @binding(0) var<storage, read_write> frame: Frame;

const EYE_POINTS = 256u;
// Least height of the eye above the water straight below it, m.
const EYE_CLEARANCE = 0.8;
// Slope at which the highest permitted water rises with the distance from the eye.
const EYE_STEEPNESS = 0.7;
// Height over which the eye begins to rise before a crest forces it to, m.
const EYE_SOFTNESS = 0.25;
// Number of map samples by the first thread: its own point, 12 steps towards the water below the eye, the height there.
const EYE_LOOKS = 14;

var<workgroup> eye_needed: array<f32, EYE_POINTS>;

@compute @workgroup_size(EYE_POINTS)
fn main(@builtin(local_invocation_index) i: u32) {
  // Points of a sunflower spiral, over all the water that waves can displace to the eye.
  let reach = 1.0 + frame.reach_m;
  let turn = f32(i) * 2.39996323;
  let at = reach * sqrt((f32(i) + 0.5) / f32(EYE_POINTS)) * vec2f(cos(turn), sin(turn));
  // Every thread samples its own point. The first one then finds the undisplaced position and the height of the water
  // below the eye. All samples share one loop, because the long function is copied into each call.
  var moved = vec3f(0.0);
  var under = vec3f(0.0);
  var foot = vec2f(0.0);
  let looks = select(1, EYE_LOOKS, i == 0u);
  for (var look = 0; look < looks; look++) {
    var width = select(1.0, 0.5, look == EYE_LOOKS - 1);
    if look == 0 {
      width = reach / sqrt(f32(EYE_POINTS));
    }
    under = water_moved(select(foot, at, look == 0), width, false).displacement;
    if look == 0 {
      moved = under;
    } else if look < EYE_LOOKS - 1 {
      foot += 0.7 * (-under.xz - foot);
    }
  }
  eye_needed[i] = moved.y + EYE_CLEARANCE - EYE_STEEPNESS * length(at + moved.xz);
  workgroupBarrier();
  for (var step = EYE_POINTS / 2u; step > 0u; step /= 2u) {
    if i < step {
      eye_needed[i] = max(eye_needed[i], eye_needed[i + step]);
    }
    workgroupBarrier();
  }
  if i == 0u {
    // If the camera rides on a buoy, the eye's height counts from the water below it.
    frame.eye_m += frame.rides * under.y;
    let over = (eye_needed[0] - frame.eye_m) / EYE_SOFTNESS;
    let rise = select(log(1.0 + exp(over)), over, over > 20.0);
    frame.eye_m += EYE_SOFTNESS * rise;
    frame.foot = foot;
    frame.dip = sqrt(2.0 * max(frame.eye_m, 0.1) / FRAME_EARTH_M);
  }
}
