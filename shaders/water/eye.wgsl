// Keeps an eye that does not dive above the water: one workgroup samples the waves around the eye and raises it above
// them, in the frame uniform that later passes read. For an eye that dives, it measures the surface there. The result
// depends only on the maps, so a still depends only on the state.

@group(0) @binding(0) var<storage, read_write> frame: Frame;

const EYE_SAMPLES = 256u;
// Least height of the eye above the water straight below it, m.
const EYE_CLEARANCE_M = 0.8;
// Slope at which the highest permitted water rises with the distance from the eye.
const EYE_CLEARANCE_SLOPE = 0.7;
// Height over which the eye begins to rise before a crest forces it to, m.
const EYE_SOFTENING_M = 0.25;
// Number of map samples by the first thread: its own point, 12 steps towards the water below the eye, the height there.
const EYE_FIRST_THREAD_SAMPLES = 14;
// Distance of two more samples beside the eye, from which the slope of the surface at a diving eye follows, m.
const EYE_BESIDE_M = 0.1;

var<workgroup> eye_required_height_m: array<f32, EYE_SAMPLES>;

@compute @workgroup_size(EYE_SAMPLES)
fn main(@builtin(local_invocation_index) i: u32) {
  // Points of a sunflower spiral, over all the water that waves can displace to the eye.
  let reach = 1.0 + frame.max_displacement_m;
  let turn = f32(i) * 2.39996323;
  let at = reach * sqrt((f32(i) + 0.5) / f32(EYE_SAMPLES)) * vec2f(cos(turn), sin(turn));
  // Every thread samples its own point. The first one then finds the undisplaced position and the height of the water
  // below the eye. All samples share one loop, because the long function is copied into each call.
  var moved = vec3f(0.0);
  var under = vec3f(0.0);
  var east = vec3f(0.0);
  var south = vec3f(0.0);
  // Waves do not lift an eye below the still water.
  let dives = frame.eye_height_m < 0.0;
  var foot = vec2f(0.0);
  let looks = select(1, EYE_FIRST_THREAD_SAMPLES + select(0, 2, dives), i == 0u);
  for (var look = 0; look < looks; look++) {
    var width = select(1.0, 0.5, look == EYE_FIRST_THREAD_SAMPLES - 1);
    if look == 0 {
      width = reach / sqrt(f32(EYE_SAMPLES));
    } else if dives {
      width = 0.5 * EYE_BESIDE_M;
    }
    var place = foot;
    if look == 0 {
      place = at;
    } else if look >= EYE_FIRST_THREAD_SAMPLES {
      place += select(vec2f(0.0, EYE_BESIDE_M), vec2f(EYE_BESIDE_M, 0.0), look == EYE_FIRST_THREAD_SAMPLES);
    }
    let waves = water_displacement(place, width, false).displacement;
    let surf = surf_motion(place);
    let there = waves + breaker_motion(place, waves.y + surf.moved.y, vec2f(0.0), surf).moved;
    if look == 0 {
      moved = there;
    } else if look < EYE_FIRST_THREAD_SAMPLES {
      under = there;
      if look < EYE_FIRST_THREAD_SAMPLES - 1 {
        foot += 0.7 * (-under.xz - foot);
      }
    } else if look == EYE_FIRST_THREAD_SAMPLES {
      east = there;
    } else {
      south = there;
    }
  }
  eye_required_height_m[i] = moved.y + EYE_CLEARANCE_M - EYE_CLEARANCE_SLOPE * length(at + moved.xz);
  workgroupBarrier();
  for (var step = EYE_SAMPLES / 2u; step > 0u; step /= 2u) {
    if i < step {
      eye_required_height_m[i] = max(eye_required_height_m[i], eye_required_height_m[i + step]);
    }
    workgroupBarrier();
  }
  if i == 0u {
    // If the camera rides on a buoy, the eye's height counts from the water below it.
    frame.eye_height_m += frame.height_from_waves * under.y;
    if dives {
      let n = cross(south - under + vec3f(0.0, 0.0, EYE_BESIDE_M), east - under + vec3f(EYE_BESIDE_M, 0.0, 0.0));
      let slope = -n.xz / max(n.y, 0.2 * EYE_BESIDE_M * EYE_BESIDE_M);
      frame.water_at_eye = vec3f(under.y - frame.eye_height_m, slope);
    } else {
      let over = (eye_required_height_m[0] - frame.eye_height_m) / EYE_SOFTENING_M;
      let rise = select(log(1.0 + exp(over)), over, over > 20.0);
      frame.eye_height_m += EYE_SOFTENING_M * rise;
    }
    frame.undisplaced_below_eye = foot;
    frame.horizon_dip = sqrt(2.0 * max(frame.eye_height_m, 0.1) / FRAME_EARTH_RADIUS_M);
  }
}
