//! The uniform of a picture: everything relative to the eye, worked out in f64.

use super::scene::{Scene, SeaLook};
use super::water::mesh::Mesh;
use crate::gpu::layout::gpu_struct;
use crate::sim::Maps;
use crate::sim::maps::{FOAM_LEVELS, MAX_DRAWN, TilePlace};
use crate::waves::slopes::SlopeVariance;
use std::f64::consts::PI;

/// Shrinkage of the finest cascade for the ripples below it. Not a rung of the ladder of patches.
const RIPPLE_RATIO: f64 = 13.1;
/// Share of the unresolved slopes that the ripples show; the rest stays roughness.
const RIPPLE_SHARE: f64 = 0.8;
/// Most ripples: those of a sea, and of the one that it fades out of.
const MAX_RIPPLES: usize = 2;
/// Most cascades and ripples.
const MAX_SHOWN: usize = MAX_DRAWN + MAX_RIPPLES;

gpu_struct! {
    /// WGSL `Frame`.
    pub struct FrameUniform as "Frame" {
        clip_from_relative: [[f32; 4]; 4],
        right: [f32; 3],
        eye_m: f32,
        up: [f32; 3],
        dip: f32,
        forward: [f32; 3],
        pixel: f32,
        sun: [f32; 3],
        chop_x: f32,
        cascades: [[f32; 4]; MAX_SHOWN],
        layers: [[f32; 4]; MAX_SHOWN],
        tile_lattice: [[f32; 4]; MAX_SHOWN],
        tile_cell: [[i32; 4]; MAX_SHOWN],
        residual: [f32; 4],
        foam_place: [[f32; 4]; FOAM_LEVELS],
        foam_uv: [[f32; 4]; FOAM_LEVELS],
        mesh: [f32; 4],
        mesh_radius: f32,
        mesh_rows: u32,
        count: u32,
        foam_count: u32,
        ripple_count: u32,
        unused: [u32; 3],
        foot: [f32; 4],
        downwind: [f32; 2],
        n: f32,
        wind_m_s: f32,
        hs_m: f32,
        depth_m: f32,
        mean_foam: f32,
        foam_gain: f32,
        sun_blur: f32,
        sun_peak: f32,
        chop_z: f32,
        footprint: f32,
    }
}

impl FrameUniform {
    /// The uniform of a scene in `size` pixels.
    pub fn new(scene: &Scene, maps: &Maps, mesh: &Mesh, size: [u32; 2]) -> Self {
        let (view, look, sea) = (&scene.view, &scene.look, &scene.sea);
        let foot = [view.eye.x, view.eye.z];
        let n = f64::from(maps.n);
        let (mut cascades, mut layers) = ([[0.0; 4]; MAX_SHOWN], [[0.0; 4]; MAX_SHOWN]);
        for ((out, layer), map) in cascades.iter_mut().zip(&mut layers).zip(&maps.cascades) {
            *layer = [(map.shortest_m * n / map.patch_m) as f32, map.layer as f32, map.gain, 1.0];
            let [u, v] = foot.map(|x| ((x / map.patch_m).rem_euclid(1.0) + 0.5 / n) as f32);
            *out = [u, v, (1.0 / map.patch_m) as f32, map.moment_scale];
        }
        let mut tiles = tiles(maps, foot);
        let (shown, residual) = ripples(maps, sea);
        for (i, &(cascade, share)) in shown.iter().enumerate() {
            let (at, finest) = (maps.cascades.len() + i, &maps.cascades[cascade]);
            let patch = finest.patch_m / RIPPLE_RATIO;
            // The texel's half is not worth keeping here; another offset keeps the copies from lining up at the origin.
            let [u, v] = foot.map(|x| ((x / patch).rem_euclid(1.0) + 0.381_966) as f32);
            cascades[at] = [u, v, (1.0 / patch) as f32, finest.moment_scale];
            layers[at] = layers[cascade];
            layers[at][3] = share.sqrt() as f32;
            tiles[at] = finest.tiling.shrunk(RIPPLE_RATIO).place(foot).into();
        }
        let mut foam_place = [[0.0; 4]; FOAM_LEVELS];
        let mut foam_uv = [[0.0; 4]; FOAM_LEVELS];
        for ((place, uv), level) in foam_place.iter_mut().zip(&mut foam_uv).zip(&maps.foam_levels) {
            let side = f64::from(maps.foam_n) * level.texel_m;
            let valid = 0.5 * side - 2.0 * level.texel_m;
            *place = [
                (level.centre[0] - foot[0]) as f32,
                (level.centre[1] - foot[1]) as f32,
                valid as f32,
                (1.0 / level.texel_m) as f32,
            ];
            let [u, v] = foot.map(|x| (x / side).rem_euclid(1.0) as f32);
            *uv = [u, v, (1.0 / side) as f32, 0.0];
        }
        let [tx, ty] = view.tan_half;
        let disc = look.sky.sun_radius_rad().sin().powi(2);
        Self {
            clip_from_relative: view.clip_from_relative().as_mat4().to_cols_array_2d(),
            right: (view.right * tx).as_vec3().to_array(),
            eye_m: view.eye.y as f32,
            up: (view.up * ty).as_vec3().to_array(),
            dip: dip(view.eye.y) as f32,
            forward: view.forward.as_vec3().to_array(),
            pixel: (2.0 * ty / f64::from(size[1])) as f32,
            sun: look.sky.sun_direction().map(|x| x as f32),
            chop_x: sea.chop[0],
            cascades,
            layers,
            tile_lattice: tiles.map(|t| [t.turn[0], t.turn[1], t.rest[0], t.rest[1]]),
            tile_cell: tiles.map(|t| [t.cell[0], t.cell[1], t.key as i32, t.on as i32]),
            residual,
            foam_place,
            foam_uv,
            mesh: mesh.lattice,
            mesh_radius: mesh.radius,
            mesh_rows: mesh.rows,
            count: maps.cascades.len() as u32,
            foam_count: maps.foam_levels.len() as u32,
            ripple_count: shown.len() as u32,
            unused: [0; 3],
            downwind: sea.downwind,
            foot: [0.0, 0.0, reach_m(sea), f32::from(u8::from(scene.rides))],
            n: maps.n as f32,
            wind_m_s: sea.wind_m_s,
            hs_m: sea.hs_m,
            depth_m: sea.depth_m,
            mean_foam: sea.mean_foam,
            foam_gain: look.surface.foam.shown as f32,
            sun_blur: (disc / 8.0) as f32,
            sun_peak: (PI * disc).recip() as f32,
            chop_z: sea.chop[1],
            footprint: 1.0,
        }
    }

    /// The same view for unfiltered samples, moved by a part of a pixel (in clip coordinates).
    pub fn unfiltered(self, [x, y]: [f32; 2]) -> Self {
        let mut clip = self.clip_from_relative;
        for column in &mut clip {
            column[0] += x * column[3];
            column[1] += y * column[3];
        }
        let forward = std::array::from_fn(|i| self.forward[i] - x * self.right[i] - y * self.up[i]);
        Self { clip_from_relative: clip, forward, footprint: 0.0, ..self }
    }
}

/// How far the waves carry water from where it would lie in a still sea, m.
fn reach_m(sea: &SeaLook) -> f32 {
    1.0 + 0.8 * sea.chop[0].max(sea.chop[1]) * sea.hs_m
}

/// Angle from the horizontal down to the horizon of the round Earth, rad.
pub fn dip(eye_m: f64) -> f64 {
    let r = crate::state::camera::EARTH_RADIUS_M;
    (r / (r + eye_m.max(0.0))).min(1.0).acos()
}

/// The cascades of which shrunk copies are shown with their share of those slopes, and the covariance (xx, zz, xz) of what
/// they leave of the unresolved slopes.
fn ripples(maps: &Maps, sea: &SeaLook) -> (Vec<(usize, f64)>, [f32; 4]) {
    let mut left = sea.residual;
    let mut shown = Vec::new();
    let own = (maps.cascades.len(), sea.finest, 1.0 - sea.fading.map_or(0.0, |f| f.share));
    let fading = sea.fading.map(|f| (maps.fading, f.finest, f.share));
    for (end, finest, weight) in std::iter::once(own).chain(fading).filter(|(end, ..)| *end > 0) {
        // The copy has the cascade's slopes along and across the wind: no more of either than there is.
        let share = |i: usize| if finest[i] > 1e-5 { sea.residual[i] / finest[i] } else { 0.0 };
        let share = (RIPPLE_SHARE * share(0).min(share(1))).min(1.0);
        if share > 0.0 {
            shown.push((end - 1, share));
            left = [left[0] - share * weight * finest[0], left[1] - share * weight * finest[1]];
        }
    }
    (shown, covariance(sea, left.map(|l| l.max(0.0))))
}

/// The lattices of the cascades' copies, and room for those of the ripples.
fn tiles(maps: &Maps, foot: [f64; 2]) -> [TilePlace; MAX_SHOWN] {
    let mut out = [TilePlace::default(); MAX_SHOWN];
    for (out, map) in out.iter_mut().zip(&maps.cascades) {
        *out = map.tiling.place(foot).into();
    }
    out
}

/// Variances along and across the wind in world axes.
fn covariance(sea: &SeaLook, [along, across]: SlopeVariance) -> [f32; 4] {
    let [x, z] = sea.downwind.map(f64::from);
    [along * x * x + across * z * z, along * z * z + across * x * x, (along - across) * x * z, 0.0].map(|v| v as f32)
}
