//! The read-only product of the simulation: everything that the renderer sees of it.

use super::resources::{MapKind, Resources, array_view};
use super::transition::{TransitionKind, weights};
use crate::gpu::layout::gpu_struct;
use crate::waves::Plan;
use crate::waves::overlap::Overlap;
use crate::waves::tiling::{Place, Tiling};
use std::f64::consts::TAU;

/// Most cascades of a sea.
pub const MAX_CASCADES: usize = 4;
/// Most cascades that are drawn: those of two seas during a cross-fade.
pub const MAX_DRAWN: usize = 2 * MAX_CASCADES;
/// Levels of the foam clipmap.
pub const FOAM_LEVELS: usize = 4;

gpu_struct! {
    /// WGSL `TilePlace`: the lattice of a patch's copies as seen from a point.
    #[derive(Default)]
    pub struct TilePlace as "TilePlace" {
        /// Cosine and sine of the lattice's angle, over the side of a triangle.
        pub turn: [f32; 2],
        /// Fractional lattice coordinates of the point.
        pub rest: [f32; 2],
        /// Whole lattice coordinates of the point.
        pub cell: [i32; 2],
        /// Seed of the hash that chooses the shift of each copy of the patch.
        pub key: u32,
        /// 0 if the patch repeats instead.
        pub on: u32,
    }
}

/// Views of the maps of the drawn cascades, and what a shader needs to sample them. Texel (i, j) of a map holds the
/// point x = i patch/n, z = j patch/n: uv = x / patch + 0.5 / n, repeating.
#[derive(Debug)]
pub struct Maps {
    /// 2d array, one layer per cascade, n texels a side, all mip levels: Dx, eta, Dz (m) and dDx/dz, without chop.
    pub displacement: wgpu::TextureView,
    /// 2d array, one layer per cascade, n texels a side, all mip levels: d eta/dx, d eta/dz, dDx/dx, dDz/dz, without
    /// chop.
    pub gradients: wgpu::TextureView,
    /// 2d array, one layer per cascade, n/2 texels a side: second moments of the slopes (xx, zz, xz, 0) in units of
    /// `moment_scale`. Mip level j belongs to mip level j + 1 of the other maps.
    pub moments: wgpu::TextureView,
    /// 2d array, one layer per foam level, repeating: foam and current source, both 0 to 1, in undisplaced coordinates.
    pub foam: wgpu::TextureView,
    /// h0 of the current sea, complex f32, \[cascade\]\[iz\]\[ix\] in FFT order.
    pub h0: wgpu::Buffer,
    /// Turns (u32) and orbit over wave number (f32, m) per triangle entry and cascade of the current sea.
    pub wave: wgpu::Buffer,
    /// Phase of all waves at the time of the maps, t / period in units of 2^-32.
    pub phase_time: u32,
    /// The drawn cascades: first those of the sea that fades out, if there is one, then those of the current sea.
    /// Longest waves first within each sea.
    pub cascades: Vec<MapCascade>,
    /// Number of leading `cascades` that belong to the sea that fades out.
    pub fading: usize,
    /// Foam levels, finest first.
    pub foam_levels: Vec<FoamLevel>,
    /// Cells along a side of a foam level.
    pub foam_n: u32,
    /// Texels along a side of a map's mip level 0.
    pub n: u32,
    /// Increases when the views are replaced.
    pub generation: u64,
}

/// The maps of one cascade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapCascade {
    /// Side of the patch, m.
    pub patch_m: f64,
    /// How copies of the patch cover the plane.
    pub tiling: Tiling,
    /// Wavelength of the shortest wave, m.
    pub shortest_m: f64,
    /// Unit of the slope moments.
    pub moment_scale: f32,
    /// Layer of the maps.
    pub layer: u32,
    /// Amplitude with which the maps are computed: 1 except during a cross-fade.
    pub weight: f32,
    /// Slope-variance correction during a cross-fade: waves that both seas have in common add by amplitude, while the
    /// shaders add the variances of all cascades.
    pub gain: f32,
}

impl From<Place> for TilePlace {
    fn from(place: Place) -> Self {
        Self {
            turn: place.tiling.turn.map(|x| x as f32),
            rest: place.rest.map(|x| x as f32),
            cell: place.cell,
            key: place.tiling.key,
            on: u32::from(place.tiling.on),
        }
    }
}

/// One level of the foam. It covers foam_n cells around its centre along each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoamLevel {
    /// Size of a cell, m.
    pub texel_m: f64,
    /// World x and z of the centre, m.
    pub centre: [f64; 2],
}

impl Maps {
    /// Views of the resources of a plan.
    pub fn new(plan: &Plan, resources: &Resources) -> Self {
        Self {
            displacement: resources.map_view(MapKind::Displacement),
            gradients: resources.map_view(MapKind::Gradients),
            moments: resources.map_view(MapKind::Moments),
            foam: array_view(&resources.foam, None),
            h0: resources.sea().h0.clone(),
            wave: resources.sea().wave.clone(),
            phase_time: 0,
            cascades: MapCascade::all(plan, resources),
            fading: 0,
            foam_levels: Vec::new(),
            foam_n: resources.foam_n,
            n: resources.n,
            generation: 0,
        }
    }

    /// The cascades of the current sea.
    pub fn sea(&self) -> &[MapCascade] {
        &self.cascades[self.fading..]
    }

    /// Takes over the waves of a plan of the same FFT size when a transition to them starts.
    pub(super) fn start(&mut self, plan: &Plan, resources: &Resources, kind: TransitionKind) {
        match kind {
            TransitionKind::Foam | TransitionKind::Surface => return,
            TransitionKind::Immediate => {
                self.cascades.clear();
                self.fading = 0;
            }
            TransitionKind::Amplitudes => self.cascades.truncate(self.fading),
            TransitionKind::CrossFade => {
                self.end_fade();
                self.fading = self.cascades.len();
            }
        }
        self.cascades.extend(MapCascade::all(plan, resources));
        (self.h0, self.wave) = (resources.sea().h0.clone(), resources.sea().wave.clone());
    }

    /// Sets the weights during a cross-fade in which the current sea has this share of the variance.
    pub(super) fn weigh(&mut self, overlaps: &[Overlap], share: f64) {
        let fading = self.fading;
        for (i, cascade) in self.cascades.iter_mut().enumerate() {
            let overlap = overlaps.get(i).copied().unwrap_or_default();
            let ([old, new], gain) = weights(&overlap, share);
            (cascade.weight, cascade.gain) = (if i < fading { old } else { new } as f32, gain as f32);
        }
    }

    /// Removes the cascades of the sea that has faded out.
    pub(super) fn end_fade(&mut self) {
        self.cascades.drain(..self.fading);
        self.fading = 0;
    }

    /// Takes over replaced textures.
    pub(super) fn rebind(&mut self, resources: &Resources) {
        self.displacement = resources.map_view(MapKind::Displacement);
        self.gradients = resources.map_view(MapKind::Gradients);
        self.moments = resources.map_view(MapKind::Moments);
        self.generation += 1;
    }
}

impl MapCascade {
    fn all(plan: &Plan, resources: &Resources) -> Vec<Self> {
        (resources.first_layer()..)
            .zip(&plan.cascades)
            .map(|(layer, c)| {
                // Half the cascade's mean square slope, the variance of one component: moments in this unit are near 1.
                let mss = plan.energy.mss_between(c.k_low, c.k_high);
                let moment_scale = if mss > 1e-12 { 0.5 * mss as f32 } else { 1.0 };
                let shortest_m = TAU / c.k_high.max(c.dk());
                Self {
                    patch_m: c.patch_m,
                    tiling: plan.tiling(c),
                    shortest_m,
                    moment_scale,
                    layer,
                    weight: 1.0,
                    gain: 1.0,
                }
            })
            .collect()
    }
}

/// The maps of all cascades in f32, without chop. Texels lie cascade by cascade: first n x n of displacement (Dx, eta,
/// Dz, dDx/dz), then n x n of gradients (d eta/dx, d eta/dz, dDx/dx, dDz/dz), rows along z, columns along x.
#[derive(Clone, Debug)]
pub struct MapsF32 {
    /// Texels along a side of a map.
    pub n: usize,
    /// All texels.
    pub texels: Vec<[f32; 4]>,
}

impl MapsF32 {
    /// Number of cascades.
    pub fn cascades(&self) -> usize {
        self.texels.len() / (2 * self.n * self.n)
    }

    /// Dx, eta, Dz (m) and dDx/dz of one cascade.
    pub fn displacement(&self, cascade: usize) -> &[[f32; 4]] {
        &self.texels[2 * cascade * self.n * self.n..][..self.n * self.n]
    }

    /// d eta/dx, d eta/dz, dDx/dx and dDz/dz of one cascade.
    pub fn gradients(&self, cascade: usize) -> &[[f32; 4]] {
        &self.texels[(2 * cascade + 1) * self.n * self.n..][..self.n * self.n]
    }
}
