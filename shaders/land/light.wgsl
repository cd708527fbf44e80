// Draws the land into the G-buffer, and lights its pixels.

@group(0) @binding(9) var<uniform> material: Material;
@group(1) @binding(0) var<storage, read> land_vertices: array<LandVertex>;

// Position in clip space of a point relative to the eye.
fn land_clip(at: vec3f) -> vec4f {
  let off = land_to_world(at.xz);
  return frame.clip_from_relative * vec4f(off.x, at.y, off.y, 1.0);
}

// A point of the land relative to the eye.
fn land_from_eye(place: vec2f, height: f32) -> vec3f {
  let off = place - land.eye_place;
  return vec3f(off.x, height - dot(off, off) / (2.0 * FRAME_EARTH_RADIUS_M) - frame.eye_height_m, off.y);
}

// Heights of crags on steep rock, m for each deviation of their noise: of those tens of metres wide, and of those metres
// wide.
const LAND_CRAGS_M = vec2f(1.3, 1.1);
// Heights of buttresses on steep rock, m for each deviation of their noise, and the side of the tile of that noise, m.
const LAND_BUTTRESSES_M = vec2f(3.0, 2.4);
const LAND_BUTTRESSES_TILE_M = 170.0;
// Width of the texels over which both noises are averaged, m. With finer ones, single vertices of the mesh would stand
// out.
const LAND_CRAG_SIZE_M = 4.0;

struct LandMeshFragment {
  @builtin(position) clip: vec4f,
  @location(0) slope: vec2f,
}

@vertex
fn mesh_vertex(@builtin(vertex_index) i: u32) -> LandMeshFragment {
  let v = land_vertices[i];
  let slope = unpack2x16float(v.slope);
  let bend = land_noise(v.place, LAND_WIDE_M, 1.0).z;
  let ledge = land_ledge(v.place, vec4f(v.height_m, slope, 0.0), bend);
  // Crags and buttresses break the outline of rock.
  let crag = land_noise(v.place.yx, LAND_MIDDLE_M, LAND_CRAG_SIZE_M).zw;
  let buttress = land_noise(v.place.yx, LAND_BUTTRESSES_TILE_M, LAND_CRAG_SIZE_M).zw;
  let share = land_rock_share(length(slope)) * maths_rise(v.height_m, LAND_LEDGE_FROM_M);
  let crags_m = dot(LAND_CRAGS_M, clamp(crag, vec2f(-1.5), vec2f(1.5)))
    + dot(LAND_BUTTRESSES_M, clamp(buttress, vec2f(-1.5), vec2f(1.5)));
  // They cut away at most half of the height above the lowest ledge, so that no rock sinks below the water.
  let raised = ledge.x + share * max(crags_m, -0.5 * max(v.height_m - LAND_LEDGE_FROM_M.x, 0.0));
  return LandMeshFragment(land_clip(land_from_eye(v.place, v.height_m + raised)), slope);
}

@fragment
fn mesh_fragment(in: LandMeshFragment) -> LandGBuffer {
  return LandGBuffer(vec2f(2.0 * LAND_NO_WATER_M, 0.0), vec4f(in.slope, 0.0, 1.0), vec2f(0.0));
}

@group(2) @binding(1) var undisplaced_map: texture_2d<f32>;
@group(2) @binding(2) var slope_map: texture_2d<f32>;

// Distance before steep land, m, at which the run-up of the waves that wash it is read, and the mean slopes between
// which land becomes steep.
const LAND_BEFORE_STEEP_M = 14.0;
const LAND_BEFORE_SLOPES = vec2f(0.12, 0.22);

// Share of the sky that the land around leaves open: less in hollows and at the foot of cliffs. `around` is the mean
// height of the land over LAND_AROUND_M, m.
fn land_open_sky(place: vec2f, height: f32, around: f32, size: f32) -> f32 {
  let near = land_at(place, land_lod(max(5.0, size))).x - height;
  return 1.0 / (1.0 + 0.55 * max(near, 0.0) + 0.09 * max(around - height, 0.0));
}

// Distances, m, at which a film of water looks for land that it mirrors, and half the range of tangents over which that
// land blends with the sky.
const LAND_FILM_REACH_M = vec2f(26.0, 80.0);
const LAND_FILM_BLEND = 0.04;

// Light that a film of water at a place mirrors towards the eye (rgb), and its reflectance (w).
fn land_film_mirror(place: vec2f, height: f32, v: vec3f, slope: vec2f, sun: vec3f) -> vec4f {
  let square = 1.0 + dot(slope, slope);
  let facing = max(v.y - dot(v.xz, slope), 1e-3);
  let reflectance = water_fresnel(facing * inverseSqrt(square));
  let twice = 2.0 * facing;
  let over = MIRRORED_SCALE / max(square * (1.0 - v.y) + twice, 1e-4);
  let across = twice * slope + square * v.xz;
  let uv = 0.5 - over * across;
  let layer = mirrored_sky_layer(2.0 * LAND_FILM_ROUGHNESS);
  var radiance = reflectance * textureSampleLevel(mirrored_sky_map, sky_sampler, vec3f(saturate(uv), layer), 0.0).rgb;
  // Land that rises before the film hides the sky.
  let over_level = inverseSqrt(max(dot(across, across), 1e-8));
  let toward = -over_level * land_from_world(across);
  let near = land_at(place + LAND_FILM_REACH_M.x * toward, land_lod(0.3 * LAND_FILM_REACH_M.x));
  let far_at = place + LAND_FILM_REACH_M.y * toward;
  let far_size = 0.3 * LAND_FILM_REACH_M.y;
  let far = land_at(far_at, land_lod(far_size));
  let rise = (vec2f(near.x, far.x) - height) / LAND_FILM_REACH_M;
  let sky_rise = (twice - square * v.y) * over_level;
  let hidden = maths_smooth(0.5 + (max(rise.x, rise.y) - sky_rise) * (0.5 / LAND_FILM_BLEND));
  radiance = mix(radiance, reflectance * land_far_radiance(far_at, far, far_size), hidden);
  let between = frame.sun_direction + v;
  if frame.sun_direction.y > 0.0 && between.y > 0.01 {
    let off = -between.xz / between.y - slope;
    let variance = LAND_FILM_ROUGHNESS * LAND_FILM_ROUGHNESS + frame.sun_slope_variance;
    let facets = exp(-min(0.5 * dot(off, off) / variance, 60.0)) / (2.0 * ATM_PI * variance);
    let h = normalize(between);
    let brightness = water_fresnel(dot(v, h)) * facets / (4.0 * h.y * h.y * h.y * h.y * max(facing, 0.05));
    radiance += sun * min(brightness, frame.sun_radiance_per_irradiance);
  }
  return vec4f(radiance, reflectance);
}

// How far a place in the frame of the coast lies beyond its rectangle: 0 within, 1 from 100 m on. There the mesh alone
// knows the land.
fn land_beyond(place: vec2f) -> f32 {
  let outside = max(max(-place, place - land.side_m), vec2f(0.0));
  return maths_smooth(0.01 * max(outside.x, outside.y));
}

// Height above the still water, m, that the waves run up the land at a point (x, z) relative to the one below the eye.
fn land_run_up_m(at: vec2f) -> f32 {
  if land.has_waves == 0.0 {
    return land.run_up_m;
  }
  return coast_at(at).w;
}

@fragment
fn light_fragment(in: LightFragment) -> @location(0) vec4f {
  let pixel = vec2i(in.clip.xy);
  let shown = textureLoad(undisplaced_map, pixel, 0).xy;
  if shown.x < LAND_NO_WATER_M {
    discard;
  }
  let position = lit_position(in.ray, pixel);
  let distance_m = length(position);
  let dir = position / distance_m;
  let height = position.y + frame.eye_height_m + dot(position.xz, position.xz) / (2.0 * FRAME_EARTH_RADIUS_M);
  let place = land_place(position.xz);
  // Beyond the coast's rectangle the slope is that of the mesh.
  let is_outside = land_beyond(place);
  let mesh = textureLoad(slope_map, pixel, 0);
  let mesh_slope = mesh.xy;
  // Texels that cover the pixel on the ground: the mean of its two sides.
  let facing = max(-dir.y + dot(land_to_world(mesh_slope), dir.xz), 0.0) * inverseSqrt(1.0 + dot(mesh_slope, mesh_slope));
  let size = 0.58 * frame.pixel_angle * distance_m * inverseSqrt(max(facing, 0.02));
  let map = land_at(place, land_lod(size));
  var slope = mix(map.yz, mesh_slope, is_outside);
  let around = land_at(place, land_lod(max(LAND_AROUND_M, size)));
  // Before steep land, the waves that wash it are known some metres away.
  let steep = length(around.yz);
  let before = (LAND_BEFORE_STEEP_M * maths_rise(steep, LAND_BEFORE_SLOPES) / max(steep, 1e-3)) * around.yz;
  let run_up = land_run_up_m(position.xz - land_to_world(before));
  var ground: LandGround;
  if shown.y == 0.0 {
    let known = vec4f(mix(around.x, height, is_outside), (1.0 - is_outside) * around.yzw);
    ground = land_ground(place, height, run_up, map * (1.0 - is_outside), slope, size, known);
  } else {
    slope = mesh_slope;
    ground = cover_ground(shown.y, mesh.z, place, height, run_up, size);
  }

  if SKY_CLOUD_SHADOWS {
    cloud_sun_fraction = cloud_sun_transmittance(position.xz, log2(max(size, 1.0)));
  }
  var sunlight = cloud_sun_irradiance();
  if LAND_SHADOWS {
    // The map does not know the treads below ledges.
    sunlight *= land_visible_sun(place, max(height, map.x));
  }
  sunlight *= 0.3 + 0.7 * mesh.w;
  let tilt = land_to_world(slope + ground.relief);
  let n = vec3f(-tilt.x, 1.0, -tilt.y) * inverseSqrt(1.0 + dot(tilt, tilt));
  let l = frame.sun_direction;
  let open = mesh.w * mix(land_open_sky(place, height, around.x, size), 1.0, is_outside);
  // A slope sees less of the sky and, instead, ground nearby, which reflects a fifth of the light that falls on it.
  let level = sunlight * max(l.y, 0.0) + light.sky_irradiance;
  let up = 0.5 + 0.5 * n.y;
  let above = up * (1.0 + scene_skylight_change(n));
  let sky_light = open * (above * light.sky_irradiance + (1.0 - up) * 0.2 * level);
  let to_sun = dot(n, l);
  // Grass is lit from both sides.
  let cosine = max(to_sun, select(0.0, -COVER_BLADE_THROUGH * to_sun, shown.y < 0.0));
  var radiance = ground.albedo * (sunlight * cosine + sky_light) / ATM_PI;
  var film = ground.film;
  var foamy = ground.foamy;
  var sheet = vec2f(0.0);
  var swept = 0.0;
  if film > 0.0 || (shown.y == 0.0 && height < run_up) {
    swept = swash_cover(position.xz, size);
    if swept > SWASH_SWEPT.x && shown.y == 0.0 {
      let bend = swash_tongues(place, size);
      // Level stone keeps as little of a film as steep stone.
      let stone = max(land_level_rock(around, height), land_built_share(map));
      let steep_or_rock = max(length(slope), stone);
      sheet = swash_film(swept, height, run_up, bend.z + 0.5 * bend.w, steep_or_rock);
      film = max(film, sheet.x);
      foamy = max(foamy, sheet.x);
    }
  }
  if film > 0.0 {
    // As sand under water that has no depth (shaders/water/bed.wgsl).
    let smooth_tilt = land_film_slope(place, land_to_world(slope), size);
    let v = vec3f(-dir.x, max(-dir.y, 1e-3), -dir.z);
    // Steep stone keeps no film that is smooth enough to mirror sun or sky, and foam slides off it.
    let lies = saturate(1.8 * n.y - 0.5);
    let mirror = land_film_mirror(place, height, v, smooth_tilt, sunlight);
    let entering = sunlight * (cosine * (1.0 - water_fresnel(cosine))) + 0.934 * sky_light;
    let spread = material.inverse_relative_index * material.inverse_relative_index;
    // Sand that is not yet damp is no brighter under water than that of the bed.
    let wet = min(ground.albedo / (LAND_DRY * LAND_DAMP), material.bed_colour) * entering / ATM_PI;
    let mirrored = mirror.rgb + (1.0 - mirror.w) * spread * wet;
    let dry = radiance;
    radiance = mix(dry, mirrored, film * lies);
    // Foam that a higher wave has left thins out on damp sand and on rock as the water does.
    let cover = lies * max(foamy * SWASH_LEFT * swept, SWASH_LIP_COVER * sheet.y);
    let foam = swash_foam(position.xz, size, cover, dir);
    // Wet bubbles mirror the sky as a film of water does, also on rough stone.
    let sheen = FOAM_SHORE_SHEEN * mix(dry, mirrored, foamy * lies);
    let white = (SWASH_ALBEDO / ATM_PI) * (foam.lit * sunlight + foam.open * sky_light) + sheen;
    radiance = mix(foam.beside * radiance, white, foam.opacity);
  }
  let air = air_to_point(dir, distance_m);
  let nearness = 1.0 / distance_m;
  let edged = frame_edged_nearness(nearness, vec2u(pixel));
  return frame_hdr_output(radiance * air[1] + air[0], select(nearness, edged, shown.y > 0.0));
}
