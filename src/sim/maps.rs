//! The read-only product of the simulation: all that the renderer sees of it.

use super::glide::{Turn, weights};
use super::resources::{MapKind, Resources, view};
use crate::gpu::layout::gpu_struct;
use crate::waves::Plan;
use crate::waves::overlap::Overlap;
use crate::waves::tiling::{Place, Tiling};
use std::f64::consts::TAU;

/// Most cascades of a sea.
pub const MAX_CASCADES: usize = 4;
/// Most cascades that are drawn: those of a sea, and of the one that it fades out of.
pub const MAX_DRAWN: usize = 2 * MAX_CASCADES;
/// Levels of the foam clipmap.
pub const FOAM_LEVELS: usize = 4;

gpu_struct! {
    /// WGSL `TilePlace`: the lattice of a patch's copies as seen from a point.
    #[derive(Default)]
    pub struct TilePlace as "TilePlace" {
        /// Cosine and sine of its angle, over the side of a triangle.
        pub turn: [f32; 2],
        /// The point in lattice coordinates, beyond its cell.
        pub rest: [f32; 2],
        /// Whole lattice coordinates of the point.
        pub cell: [i32; 2],
        /// Of the shifts.
        pub key: u32,
        /// 0: the patch repeats.
        pub on: u32,
    }
}

/// Views of the current sea and what is needed to sample them. A texel (i, j) of a map holds the point
/// x = i patch/n, z = j patch/n: uv = x / patch + 0.5 / n, repeating.
#[derive(Debug)]
pub struct Maps {
    /// 2d array, four numbers, a layer for each cascade, with mips: Dx, eta, Dz (m) and dDx/dz; chop not applied.
    pub displacement: wgpu::TextureView,
    /// The same shape: d eta/dx, d eta/dz, dDx/dx, dDz/dz.
    pub gradients: wgpu::TextureView,
    /// n/2 a side, with mips: second moments of the slopes (xx, zz, xz, 0) in units of `moment_scale`; mip j belongs
    /// to mip j + 1 of the others.
    pub moments: wgpu::TextureView,
    /// 2d array, layer = foam level, repeating: foam and present source, both 0..1, undisplaced.
    pub foam: wgpu::TextureView,
    /// h0 of the sea, complex f32, \[cascade\]\[iz\]\[ix\] in FFT order.
    pub h0: wgpu::Buffer,
    /// Turns (u32) and orbit over wave number (f32, m) per triangle entry and cascade of the sea.
    pub wave: wgpu::Buffer,
    /// Phase of all waves at the time of the maps, t / period in units of 2^-32.
    pub phase_time: u32,
    /// All that are drawn: those of a sea that fades, if any, then those of the sea. Longest waves first.
    pub cascades: Vec<MapCascade>,
    /// How many of them belong to a sea that fades.
    pub fading: usize,
    /// Finest first.
    pub foam_levels: Vec<FoamLevel>,
    /// Cells along a side of a foam level.
    pub foam_n: u32,
    /// Texels along a side of a map.
    pub n: u32,
    /// Changes when the views are new.
    pub generation: u64,
}

/// One cascade's maps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapCascade {
    /// Side of the patch, m.
    pub patch_m: f64,
    /// How it covers the plane.
    pub tiling: Tiling,
    /// Its shortest wave, m.
    pub shortest_m: f64,
    /// Unit of the moments.
    pub moment_scale: f32,
    /// Layer of the maps.
    pub layer: u32,
    /// Amplitude that the maps are drawn with: 1, unless one sea fades into another.
    pub weight: f32,
    /// What the variance of its slopes is short of meanwhile: seas that have waves in common add by their amplitudes.
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

/// One level of the foam: valid within half of foam_n texels of its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoamLevel {
    /// Size of a cell, m.
    pub texel_m: f64,
    /// World x and z of the middle.
    pub centre: [f64; 2],
}

impl Maps {
    /// Views of the resources of a plan.
    pub fn new(plan: &Plan, resources: &Resources) -> Self {
        Self {
            displacement: resources.map_view(MapKind::Displacement),
            gradients: resources.map_view(MapKind::Gradients),
            moments: resources.map_view(MapKind::Moments),
            foam: view(&resources.foam, None),
            h0: resources.sea.h0.clone(),
            wave: resources.sea.wave.clone(),
            phase_time: 0,
            cascades: MapCascade::all(plan, resources),
            fading: 0,
            foam_levels: Vec::new(),
            foam_n: resources.foam_n,
            n: resources.n,
            generation: 0,
        }
    }

    /// The cascades of the sea alone.
    pub fn sea(&self) -> &[MapCascade] {
        &self.cascades[self.fading..]
    }

    /// Takes over a plan of the same size.
    pub(super) fn turn(&mut self, plan: &Plan, resources: &Resources, turn: Turn) {
        match turn {
            Turn::Jump => {
                self.cascades.clear();
                self.fading = 0;
            }
            Turn::Ease => self.cascades.truncate(self.fading),
            Turn::Fade => {
                self.end_fade();
                self.fading = self.cascades.len();
            }
        }
        self.cascades.extend(MapCascade::all(plan, resources));
        (self.h0, self.wave) = (resources.sea.h0.clone(), resources.sea.wave.clone());
    }

    /// Sets the weights of a fade in which the sea has this share.
    pub(super) fn weigh(&mut self, overlaps: &[Overlap], share: f64) {
        let fading = self.fading;
        for (i, cascade) in self.cascades.iter_mut().enumerate() {
            let overlap = overlaps.get(i).copied().unwrap_or_default();
            let ([old, new], gain) = weights(&overlap, share);
            (cascade.weight, cascade.gain) = (if i < fading { old } else { new } as f32, gain as f32);
        }
    }

    /// The sea that fades is gone.
    pub(super) fn end_fade(&mut self) {
        self.cascades.drain(..self.fading);
        self.fading = 0;
    }

    /// Takes over new textures.
    pub(super) fn rebind(&mut self, resources: &Resources) {
        self.displacement = resources.map_view(MapKind::Displacement);
        self.gradients = resources.map_view(MapKind::Gradients);
        self.moments = resources.map_view(MapKind::Moments);
        self.generation += 1;
    }
}

impl MapCascade {
    fn all(plan: &Plan, resources: &Resources) -> Vec<Self> {
        (resources.sea.first_layer..)
            .zip(&plan.cascades)
            .map(|(layer, c)| {
                // Half the cascade's mean square slope is one component's; half floats then hold numbers near 1.
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
