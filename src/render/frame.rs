//! The uniform of a picture: the view, the sea and where its maps lie relative to the eye, worked out in f64.

use super::scene::{Scene, SeaAppearance};
use super::water::mesh::{Mesh, MeshLattice};
use crate::gpu::layout::gpu_struct;
use crate::sim::Maps;
use crate::sim::maps::{FOAM_LEVELS, FoamLevel, MAX_DRAWN, MapCascade, TilePlace};
use crate::waves::slopes::SlopeVariance;
use std::f64::consts::PI;

/// Ratio of the finest cascade's patch to that of its ripples. It is no ratio of two patches, so that they share no period.
const RIPPLE_RATIO: f64 = 13.1;
/// Share of the unresolved slope variance that the ripples show; the rest stays roughness.
const RIPPLE_SHARE: f64 = 0.8;
/// Most ripples: one of each of two seas during a cross-fade.
const MAX_RIPPLES: usize = 2;
/// Most cascades and ripples.
const MAX_SHOWN: usize = MAX_DRAWN + MAX_RIPPLES;

gpu_struct! {
    /// WGSL `FrameCascade`: a cascade as seen from the eye, or its ripples, a shrunk copy whose slopes stand for waves that no
    /// cascade holds.
    #[derive(Default)]
    pub struct FrameCascade as "FrameCascade" {
        /// The lattice of the patch's copies at the eye's foot.
        pub tile: TilePlace,
        /// Texture coordinates of the eye's foot.
        pub uv: [f32; 2],
        /// 1 / side of the patch, 1/m.
        pub inverse_patch: f32,
        /// Unit of the slope moments.
        pub moment_scale: f32,
        /// Texels to the shortest wave.
        pub wave_texels: f32,
        /// Layer of the maps.
        pub layer: u32,
        /// Slope-variance correction during a cross-fade.
        pub variance_gain: f32,
        /// Factor of the slopes: 1 for a cascade.
        pub slope_scale: f32,
    }
}

gpu_struct! {
    /// WGSL `FrameFoamLevel`: a foam level as seen from the eye.
    #[derive(Default)]
    pub struct FrameFoamLevel as "FrameFoamLevel" {
        /// Centre relative to the eye's foot, m.
        pub centre: [f32; 2],
        /// Half the side of the valid square, m.
        pub half_side_m: f32,
        /// 1 / size of a cell, 1/m.
        pub inverse_cell: f32,
        /// Texture coordinates of the eye's foot.
        pub uv: [f32; 2],
        /// 1 / side of the level, 1/m.
        pub inverse_side: f32,
        unused: u32,
    }
}

gpu_struct! {
    /// Uniform of one frame: eye, projection, cascades and foam levels relative to the eye (WGSL `Frame`).
    pub struct FrameUniform as "Frame" {
        /// From positions relative to the eye to clip space, reverse-Z.
        pub clip_from_relative: glam::Mat4,
        /// Unit vector to the right of the picture, times the tangent of half the horizontal field of view.
        pub right: [f32; 3],
        /// Height of the eye over the still water, m.
        pub eye_m: f32,
        /// Unit vector to the top of the picture, times the tangent of half the vertical field of view.
        pub up: [f32; 3],
        /// Angle from the horizontal down to the horizon of the round Earth, rad.
        pub dip: f32,
        /// Unit vector into the picture.
        pub forward: [f32; 3],
        /// Angle of a pixel in the middle of the picture, rad.
        pub pixel: f32,
        /// Unit vector to the sun.
        pub sun: [f32; 3],
        /// Slope variance that stands for the width of the sun's disc: the sun's image in a mirror is as bright as the disc.
        pub sun_blur: f32,
        /// Covariance (xx, zz, xz) of the slopes that neither the maps nor the ripples hold.
        pub residual: [f32; 3],
        /// Radiance of the sun's disc over its irradiance, 1/sr.
        pub sun_peak: f32,
        /// Horizontal displacement factor along x and z.
        pub chop: [f32; 2],
        /// Undisplaced point (x, z) of the water below the eye, relative to the eye's foot, m; written by the GPU.
        pub foot: [f32; 2],
        /// Largest horizontal distance over which waves may carry water, m.
        pub reach_m: f32,
        /// 1 if the eye's height counts from the water below it, else 0.
        pub rides: f32,
        /// Texels along a side of a map.
        pub n: f32,
        /// Cascades in use.
        pub count: u32,
        /// Ripples in use; they stand after the first `count` cascades.
        pub ripple_count: u32,
        /// Foam levels in use.
        pub foam_count: u32,
        /// Significant wave height, m.
        pub hs_m: f32,
        /// Depth of the water, m.
        pub depth_m: f32,
        /// Mean foam beyond the foam levels, 0 to 1.
        pub mean_foam: f32,
        /// Factor of the foam that is shown.
        pub foam_gain: f32,
        /// Share of a pixel that is filtered over: 1, or 0 for the samples of a reference.
        pub footprint: f32,
        unused: u32,
        /// The lattice of the mesh.
        pub mesh: MeshLattice,
        /// The cascades that are drawn, then the ripples.
        pub cascades: [FrameCascade; MAX_SHOWN],
        /// The foam levels, finest first.
        pub foam_levels: [FrameFoamLevel; FOAM_LEVELS],
    }
}

impl FrameCascade {
    /// A cascade as seen from an eye over the point `foot` of the world.
    fn new(cascade: &MapCascade, foot: [f64; 2], n: f64) -> Self {
        Self {
            tile: cascade.tiling.place(foot).into(),
            uv: foot.map(|x| ((x / cascade.patch_m).rem_euclid(1.0) + 0.5 / n) as f32),
            inverse_patch: (1.0 / cascade.patch_m) as f32,
            moment_scale: cascade.moment_scale,
            wave_texels: (cascade.shortest_m * n / cascade.patch_m) as f32,
            layer: cascade.layer,
            variance_gain: cascade.gain,
            slope_scale: 1.0,
        }
    }

    /// The ripples of a cascade, with this share of its slope variance.
    fn ripples(cascade: &MapCascade, share: f64, foot: [f64; 2], n: f64) -> Self {
        let patch_m = cascade.patch_m / RIPPLE_RATIO;
        Self {
            tile: cascade.tiling.shrunk(RIPPLE_RATIO).place(foot).into(),
            // An offset of their own keeps the copies of cascade and ripples from coinciding at the origin.
            uv: foot.map(|x| ((x / patch_m).rem_euclid(1.0) + 0.381_966) as f32),
            inverse_patch: (1.0 / patch_m) as f32,
            slope_scale: share.sqrt() as f32,
            ..Self::new(cascade, foot, n)
        }
    }
}

impl FrameFoamLevel {
    /// A level of `cells` cells a side as seen from an eye over the point `foot` of the world.
    fn new(level: &FoamLevel, foot: [f64; 2], cells: u32) -> Self {
        let side_m = f64::from(cells) * level.texel_m;
        Self {
            centre: [0, 1].map(|axis| (level.centre[axis] - foot[axis]) as f32),
            half_side_m: (0.5 * side_m - 2.0 * level.texel_m) as f32,
            inverse_cell: (1.0 / level.texel_m) as f32,
            uv: foot.map(|x| (x / side_m).rem_euclid(1.0) as f32),
            inverse_side: (1.0 / side_m) as f32,
            unused: 0,
        }
    }
}

impl FrameUniform {
    /// The uniform of a scene in `size` pixels.
    pub fn new(scene: &Scene, maps: &Maps, mesh: &Mesh, size: [u32; 2]) -> Self {
        let (view, look, sea) = (&scene.view, &scene.look, &scene.sea);
        let foot = [view.eye.x, view.eye.z];
        let n = f64::from(maps.n);
        let (shown, residual) = ripples(scene, maps);
        let ripples = shown.iter().map(|(cascade, share)| FrameCascade::ripples(cascade, *share, foot, n));
        let cascades = maps.cascades.iter().map(|cascade| FrameCascade::new(cascade, foot, n));
        let levels = maps.foam_levels.iter().map(|level| FrameFoamLevel::new(level, foot, maps.foam_n));
        let [tx, ty] = view.tan_half;
        let disc = look.sky.sun_radius_rad().sin().powi(2);
        Self {
            clip_from_relative: view.clip_from_relative().as_mat4(),
            right: (view.right * tx).as_vec3().to_array(),
            eye_m: view.eye.y as f32,
            up: (view.up * ty).as_vec3().to_array(),
            dip: dip(view.eye.y) as f32,
            forward: view.forward.as_vec3().to_array(),
            pixel: (2.0 * ty / f64::from(size[1])) as f32,
            sun: look.sky.sun_direction().map(|x| x as f32),
            sun_blur: (disc / 8.0) as f32,
            residual,
            sun_peak: (PI * disc).recip() as f32,
            chop: sea.chop.map(|l| l as f32),
            foot: [0.0; 2],
            reach_m: (1.0 + 0.8 * sea.most_chop() * sea.hs_m) as f32,
            rides: f32::from(u8::from(scene.rides)),
            n: maps.n as f32,
            count: maps.cascades.len() as u32,
            ripple_count: shown.len() as u32,
            foam_count: maps.foam_levels.len() as u32,
            hs_m: sea.hs_m as f32,
            depth_m: sea.depth_m as f32,
            mean_foam: scene.mean_foam as f32,
            foam_gain: look.surface.foam.amount as f32,
            footprint: 1.0,
            unused: 0,
            mesh: mesh.lattice,
            cascades: filled(cascades.chain(ripples)),
            foam_levels: filled(levels),
        }
    }

    /// The same view for unfiltered samples, moved by this way in clip coordinates.
    pub fn unfiltered(self, [x, y]: [f32; 2]) -> Self {
        let moved = glam::Mat4::from_translation(glam::vec3(x, y, 0.0)) * self.clip_from_relative;
        let forward = std::array::from_fn(|i| self.forward[i] - x * self.right[i] - y * self.up[i]);
        Self { clip_from_relative: moved, forward, footprint: 0.0, ..self }
    }
}

/// An array that begins with these values; the rest are defaults.
fn filled<T: Copy + Default, const N: usize>(values: impl Iterator<Item = T>) -> [T; N] {
    let mut out = [T::default(); N];
    out.iter_mut().zip(values).for_each(|(out, value)| *out = value);
    out
}

/// Angle from the horizontal down to the horizon of the round Earth, rad.
pub fn dip(eye_m: f64) -> f64 {
    let r = crate::state::camera::EARTH_RADIUS_M;
    (r / (r + eye_m.max(0.0))).min(1.0).acos()
}

/// The cascades whose ripples are shown, each with its share of their slope variance, and the covariance (xx, zz, xz) of the
/// unresolved slopes that the ripples leave.
fn ripples<'a>(scene: &Scene, maps: &'a Maps) -> (Vec<(&'a MapCascade, f64)>, [f32; 3]) {
    let sea = &scene.sea;
    let mut left = sea.residual;
    let mut shown = Vec::new();
    let own = (maps.cascades.last(), sea.finest, 1.0 - scene.fading.map_or(0.0, |f| f.share));
    let fading = scene.fading.map(|f| (maps.cascades[..maps.fading].last(), f.finest, f.share));
    for (cascade, finest, weight) in std::iter::once(own).chain(fading) {
        // A copy has the slopes of its cascade along and across the wind: no more of either than there is.
        let share = |i: usize| if finest[i] > 1e-5 { sea.residual[i] / finest[i] } else { 0.0 };
        let share = (RIPPLE_SHARE * share(0).min(share(1))).min(1.0);
        if let Some(cascade) = cascade.filter(|_| share > 0.0) {
            shown.push((cascade, share));
            left = [left[0] - share * weight * finest[0], left[1] - share * weight * finest[1]];
        }
    }
    (shown, covariance(sea, left.map(|l| l.max(0.0))))
}

/// Covariance (xx, zz, xz) in world axes of variances along and across the wind.
fn covariance(sea: &SeaAppearance, [along, across]: SlopeVariance) -> [f32; 3] {
    let [x, z] = sea.downwind;
    [along * x * x + across * z * z, along * z * z + across * x * x, (along - across) * x * z].map(|v| v as f32)
}
