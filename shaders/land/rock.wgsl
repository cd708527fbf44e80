// Bedrock of the land: strata, ledges, blocks and cracks.

// Sides of the tiles of noise of beds and of blocks of rock, m, and how much beds stretch along their strike.
const LAND_BEDS_M = 17.0;
const LAND_FACE_M = 59.0;
const LAND_BEDS_STRETCH = 0.05;
// Heights of lumps and of blocks of rock, m for each deviation of their noise.
const LAND_FACE_RELIEF_M = vec2f(0.13, 0.24);
// Slope that the sides of lumps and blocks do not exceed, and slopes of the finest detail for each deviation of its
// noise.
const LAND_FACE_STEEPEST = 0.85;
const LAND_DETAIL_SLOPES = vec2f(0.3, 0.22);
// Share of the distance inland in the vertical coordinate of faces, and side of the tile of their finest detail, m.
const LAND_FACE_LEAN = 0.6;
const LAND_DETAIL_M = 8.7;
// Albedo of lichen, and the heights above the splash, m, between which it begins to grow.
const LAND_LICHEN = vec3f(0.195, 0.192, 0.150);
const LAND_LICHEN_M = vec2f(1.5, 4.7);

// Thickness of a stratum of rock, m, the part of it that its joint darkens on either side, and the change of slope from
// its joint to its upper edge, relative to the slope of the land.
const LAND_STRATUM_M = 1.6;
const LAND_STRATUM_JOINT = 0.13;
const LAND_STRATUM_RELIEF = -0.9;

// Bedrock: beds with ledges between them, which cracks part into blocks; dark and weedy where waves keep it wet, with
// lichen above. `slope` is that of the land with its ledges, `around` is that of land_ground.
fn land_rock(
  place: vec2f, height: f32, run_up: f32, slope: vec2f, around: vec4f, size: f32, middle: vec4f, wide: vec4f,
) -> LandGround {
  let toward = land.toward_sun;
  let layer = land_layer(place, height, wide.z);
  let beds = land_noise(vec2f(LAND_BEDS_STRETCH * (place.x - place.y), layer), LAND_BEDS_M, 0.4 * size);
  // The pattern of a face is seen from the side and above. Where the land turns a corner, another face begins.
  let is_along_y = abs(around.y) > abs(around.z);
  let axis = select(vec2f(0.0, sign(around.z)), vec2f(sign(around.y), 0.0), is_along_y);
  let face_at = vec2f(dot(place, abs(axis.yx)), height + LAND_FACE_LEAN * dot(place, axis));
  let face = land_noise(face_at, LAND_FACE_M, 0.7 * size);
  let detail = land_noise(face_at.yx, LAND_DETAIL_M, 0.7 * size);
  // Only the slope towards the sun decides how bright a face is, and it takes one read more, not two as both axes do.
  let step_m = 0.15 + 0.7 * size;
  let off = step_m * vec2f(dot(toward, abs(axis.yx)), dot(slope + LAND_FACE_LEAN * axis, toward));
  let sunward = land_noise(face_at + off, LAND_FACE_M, 0.7 * size);
  let walls = saturate(1.6 * length(slope) - 0.3);
  // Hard beds are massive, and soft ones crumble.
  let crumbled = clamp(0.8 - 0.25 * beds.z, 0.45, 1.0);
  let rise = crumbled * (0.4 + 0.6 * walls) * dot(LAND_FACE_RELIEF_M, sunward.zw - face.zw) / step_m;
  let facet = rise * inverseSqrt(1.0 + rise * rise / (LAND_FACE_STEEPEST * LAND_FACE_STEEPEST));
  var out: LandGround;
  // Hard beds are steep, and debris lies on soft ones.
  let ledge = clamp(1.1 * beds.z + 0.3 * beds.w, -1.3, 1.5);
  out.relief = 0.65 * ledge * slope + facet * toward + LAND_DETAIL_SLOPES * detail.wz;
  // Thin strata: each has a tone of its own, a worn upper edge, and a joint below.
  let strata = layer * (1.0 / LAND_STRATUM_M) + 0.12 * beds.z + 0.06 * middle.z;
  let part = fract(strata);
  let pixel = size * length(slope) / LAND_STRATUM_M;
  let seen = walls * saturate(1.6 - 2.2 * pixel);
  let own = fract(0.618 * floor(strata)) - 0.5;
  out.relief += (LAND_STRATUM_RELIEF * seen * (part - 0.5)) * slope;
  let line = max(LAND_STRATUM_JOINT, pixel);
  let joint = seen * maths_smooth(1.0 - min(part, 1.0 - part) / line) * (LAND_STRATUM_JOINT / line);
  let tone = saturate(0.42 + 0.30 * beds.z + 0.26 * face.z + 0.16 * middle.z + 0.4 * seen * own);
  out.albedo = mix(LAND_DARK_ROCK, LAND_ROCK, tone) * max(1.0 + 0.18 * detail.z + 0.10 * detail.w, 0.3);
  // Iron colours some beds.
  out.albedo *= mix(vec3f(1.0), vec3f(1.18, 1.0, 0.78), saturate(0.2 + 0.35 * wide.w + 0.3 * beds.z));
  let dry = maths_rise(height - LAND_SPLASH * run_up, LAND_LICHEN_M);
  let lichen = dry * maths_smooth(0.5 * detail.z + 0.4 * face.z + 0.3 * middle.z);
  out.albedo = mix(out.albedo, LAND_LICHEN, 0.55 * lichen);
  let washed = land_washed(out.albedo, height, run_up, 1.2 * middle.z + 0.5 * detail.z);
  // Little light reaches cracks, joints between beds, and what is below a ledge.
  let cracks = saturate(vec3f(-0.8, -0.7 * walls, -0.6) * vec3f(face.w, beds.w, detail.w) - vec3f(0.45, 0.4, 0.5));
  let open = (1.0 - (0.4 + 0.5 * crumbled) * cracks.x) * (1.0 - 0.6 * cracks.y) * (1.0 - 0.3 * cracks.z)
    * (1.0 - 0.6 * joint);
  out.albedo = washed.rgb * open;
  out.film = LAND_STONE_FILM * washed.w;
  out.foamy = LAND_STONE_FOAMY * washed.w;
  return out;
}
