//! Read-only result of the simulation: the displacement, gradient, slope-moment and foam maps for the renderer.

use super::coast::square::{CoastSquare, SHORTEST_COASTAL_WAVE_TEXELS};
use super::resources::{MapKind, Resources, array_view};
use super::transition::{Interpolated, TransitionFrameProgress, TransitionKind, cross_fade_amplitudes};
use crate::gpu::layout::gpu_struct;
use crate::waves::overlap::SeaCovariance;
use crate::waves::plan::{Cascade, Plan};
use crate::waves::second_order::{BoundWaveTotals, BoundWaves, CascadeBoundWaves};
use crate::waves::tiling::{SHIFT_STEPS_PER_PATCH_SIDE, Tiling, TriangleLatticePosition};
use std::f64::consts::TAU;

/// Largest number of cascades (patches of sea, each with an FFT of its own) of one sea.
pub const MAX_CASCADES: usize = 4;
/// Number of layers that a coast adds to the maps of a sea: the coastal waves of the open sea, and those at the coast.
pub const COAST_LAYERS: usize = 2;
/// Number of layers behind those, for what shapes the breakers at a coast. Only mip level 0 of the displacement is written.
pub const BREAKER_LAYERS: usize = 1;
/// Largest number of layers of each kind of map of one sea that hold waves.
pub const MAX_SEA_LAYERS: usize = MAX_CASCADES + COAST_LAYERS;
/// Largest number of cascades that are drawn at once: those of the old and of the new sea of a cross-fade.
pub const MAX_DRAWN_CASCADES: usize = 2 * MAX_SEA_LAYERS;

gpu_struct! {
    /// WGSL `TileLatticePosition`: position of a point in the triangle lattice by which a patch covers the sea. Shaders
    /// find from it the shifted copies of the patch that are blended near the point.
    #[derive(Default)]
    pub struct TileLatticePosition as "TileLatticePosition" {
        /// Gradient (d/dx, d/dz), 1/m, of a point's first coordinate in the triangle lattice.
        pub gradient_u: [f32; 2],
        /// Gradient (d/dx, d/dz), 1/m, of a point's second coordinate in the triangle lattice.
        pub gradient_v: [f32; 2],
        /// Fractional parts of the point's two coordinates in the triangle lattice, 0 to 1, in sides of a triangle.
        pub fraction: [f32; 2],
        /// Integer parts of the point's two coordinates in the triangle lattice, wrapped to 32 bits.
        pub cell: [i32; 2],
        /// Key of the hash that gives each copy of the patch its random shift; it differs between cascades.
        pub shift_key: u32,
        /// Step of the random shifts between blended copies of the patch, in texture coordinates; 0 if the patch repeats
        /// periodically.
        pub shift_step: f32,
        unused: [u32; 2],
    }
}

/// Texture views of the maps of all drawn cascades, and what a shader needs to sample them. Texel (i, j) of an n x n
/// map is for x = i p / n, z = j p / n, where p is the patch side; texture coordinates are (x, z) / p + 0.5 / n.
#[derive(Debug)]
pub struct Maps {
    /// Displacement maps: 2d array texture with mip levels, one layer per cascade (`MapCascade::layer`). Texels are Dx,
    /// eta, Dz and dDx/dz: horizontal displacement Dx and Dz (m) without choppiness, height eta (m).
    pub displacement: wgpu::TextureView,
    /// Gradient maps: 2d array texture with mip levels, one layer per cascade (`MapCascade::layer`). Texels are the
    /// slopes d eta/dx and d eta/dz, then dDx/dx and dDz/dz of the horizontal displacement without choppiness.
    pub gradients: wgpu::TextureView,
    /// Slope moments: 2d array texture with mip levels, one layer per cascade, n/2 texels a side. Texels are means of
    /// sx^2, sz^2, sx sz (sx and sz: slopes along x and z), divided by `moment_unit` of the cascade, and 0. Mip level j
    /// belongs to mip level j + 1 of the other maps.
    pub slope_moments: wgpu::TextureView,
    /// Foam maps: 2d array texture, one layer per foam level, finest first, with coordinates that wrap around. Texels
    /// are foam (0 to 1), foam source (0 no growth, 1 fastest growth), front of a breaker and plume of bubbles, at points before horizontal displacement.
    pub foam: wgpu::TextureView,
    /// Fourier amplitudes h0 of the current sea at time 0, m: complex f32, \[cascade\]\[iz\]\[ix\] in FFT order.
    pub h0: wgpu::Buffer,
    /// For each cascade of the current sea and magnitude of its wave vectors: the number of wave cycles in the sea's
    /// repeat period (u32), and the orbit axis ratio (horizontal to vertical) divided by the wave number (f32, m).
    pub wave_table: wgpu::Buffer,
    /// Time of the maps as a fraction of the sea's repeat period, in units of 2^-32. Its wrapping product with a wave's
    /// number of cycles per period is the wave's phase in units of 2^-32 cycles.
    pub period_fraction_u32: u32,
    /// Cascades that are drawn, longest waves first within each sea. During a cross-fade, the cascades of the old sea
    /// come before those of the current sea. With a coast, each sea begins with the layers that the coast adds.
    pub cascades: Vec<MapCascade>,
    /// The coast up to which the sea runs; None in the open sea.
    pub coast: Option<MapCoast>,
    /// Placeholder to bind where there is no coast: a texture of one texel.
    pub no_coast: wgpu::TextureView,
    /// Number of entries at the start of `cascades` that belong to the old sea of a cross-fade; 0 without a cross-fade.
    pub fading_cascade_count: usize,
    /// Bound waves of the second order.
    bound_waves: Interpolated<BoundWaves>,
    /// The current sea's fraction of the sum of both elevation variances, 0 to 1, while a cross-fade runs.
    new_sea_weight: f64,
    /// Cell sizes and positions of the foam levels, finest level first.
    pub foam_levels: Vec<FoamLevel>,
    /// Number of cells along a side of a foam level (one of the nested square foam grids).
    pub foam_cells_per_side: u32,
    /// FFT size, which is also the number of texels along a side of mip level 0 of the displacement and gradient maps.
    pub n: u32,
    /// Counter that increases when these texture views are replaced: bind groups with them must then be renewed.
    pub view_generation: u64,
}

/// What a layer of the maps holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CascadeRole {
    /// The waves of a cascade, without those that a coast transforms.
    #[default]
    Ordinary,
    /// Those waves of the first cascade that a coast transforms, as they are in the open sea.
    Offshore,
    /// The same waves as the coast makes them, in a square of the world that encloses the coast.
    Coast,
}

/// What shaders need to know of a coast to sum the layers of the maps over it.
#[derive(Clone, Debug)]
pub struct MapCoast {
    /// Factors of the layers at each point of `square`, which does not repeat: of ordinary cascades, of offshore waves, and
    /// of waves at the coast (x, y, z), each 0 to 1; and the depth, m (w). Outside the square those of its edge hold.
    pub gains: wgpu::TextureView,
    /// Square of the world that encloses the coast.
    pub square: CoastSquare,
}

/// What a shader needs to know to sample the maps of one cascade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapCascade {
    /// What the layer holds.
    pub role: CascadeRole,
    /// Side of the square patch of sea that the cascade's maps cover, m.
    pub patch_m: f64,
    /// How the sea is covered with the cascade's patch: it repeats, or randomly shifted copies of it are blended.
    pub tiling: Tiling,
    /// Wavelength of the shortest wave of the cascade, m.
    pub shortest_wavelength_m: f64,
    /// Unit of the slope moments (means of slope products) in the maps: half the cascade's mean square slope.
    pub moment_unit: f32,
    /// Index of the cascade's layer in each of the texture views of displacement, gradients and slope moments.
    pub layer: u32,
    /// Factor that the amplitudes of the cascade's waves have in the maps: 1 except during a cross-fade.
    pub cross_fade_amplitude_factor: f32,
    /// Factor on the slope variance that shaders sum over the cascades of both seas of a cross-fade: correlated waves
    /// of both seas add by amplitude, not by variance. 1 without a cross-fade.
    pub cross_fade_variance_factor: f32,
}

impl From<TriangleLatticePosition> for TileLatticePosition {
    fn from(position: TriangleLatticePosition) -> Self {
        let [u, v] = position.tiling.lattice_coordinate_gradients_per_m();
        Self {
            gradient_u: u.map(|x| x as f32),
            gradient_v: v.map(|x| x as f32),
            fraction: position.cell_fraction.map(|x| x as f32),
            cell: position.cell,
            shift_key: position.tiling.shift_hash_key,
            shift_step: if position.tiling.blends_copies { SHIFT_STEPS_PER_PATCH_SIDE.recip() as f32 } else { 0.0 },
            unused: [0; 2],
        }
    }
}

/// One foam level: one of the nested square foam grids around the camera, with `Maps::foam_n` x `foam_n` cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoamLevel {
    /// Side of a foam cell, m.
    pub cell_m: f64,
    /// World position (x, z) of the level's centre, m.
    pub centre_m: [f64; 2],
    /// Whether crests of the open sea break, and the cells are fine enough to tell where.
    pub has_breakers: bool,
}

impl Maps {
    /// Creates views of the maps and foam in `resources`. The drawn cascades are those of `plan`.
    pub fn new(plan: &Plan, resources: &Resources) -> Self {
        Self {
            displacement: resources.map_view(MapKind::Displacement),
            gradients: resources.map_view(MapKind::Gradients),
            slope_moments: resources.map_view(MapKind::Moments),
            foam: array_view(&resources.foam, None),
            h0: resources.current_waves().h0.clone(),
            wave_table: resources.current_waves().wave_table.clone(),
            period_fraction_u32: 0,
            cascades: MapCascade::all_of_plan(plan, resources, false),
            coast: None,
            no_coast: resources.placeholder.clone(),
            fading_cascade_count: 0,
            bound_waves: Interpolated::new(plan.bound_waves()),
            new_sea_weight: 1.0,
            foam_levels: Vec::new(),
            foam_cells_per_side: resources.foam_n,
            n: resources.n,
            view_generation: 0,
        }
    }

    /// Entries of `cascades` that belong to the current sea, without those of the old sea of a cross-fade.
    pub fn current_cascades(&self) -> &[MapCascade] {
        &self.cascades[self.fading_cascade_count..]
    }

    /// Bound waves of the second order of each entry of `cascades`. Offshore waves are part of the first cascade, whose
    /// entry counts for the products of both; most of its waves are offshore waves, so that they get its level. Waves at the
    /// coast have none.
    pub fn bound_waves_of_cascades(&self) -> impl Iterator<Item = CascadeBoundWaves> + '_ {
        let of_sea = |sea: &BoundWaves, cascades: &[MapCascade]| -> Vec<CascadeBoundWaves> {
            let mut ordinary = sea.cascades.iter();
            let mut level_m = None;
            let mut of = |cascade: &MapCascade| match cascade.role {
                CascadeRole::Ordinary => {
                    let own = ordinary.next().copied().unwrap_or_default();
                    CascadeBoundWaves { level_m: level_m.take().map_or(own.level_m, |_| 0.0), ..own }
                }
                CascadeRole::Offshore => {
                    level_m = ordinary.clone().next().map(|own| own.level_m);
                    CascadeBoundWaves { level_m: level_m.unwrap_or_default(), ..CascadeBoundWaves::default() }
                }
                CascadeRole::Coast => CascadeBoundWaves::default(),
            };
            cascades.iter().map(&mut of).collect()
        };
        let (old, new) = self.bound_waves.fading_and_current();
        let (fading, own) = self.cascades.split_at(self.fading_cascade_count);
        [of_sea(old.unwrap_or(new), fading), of_sea(new, own)].concat().into_iter()
    }

    /// Bound waves of the drawn sea as a whole: in a cross-fade they go from those of the old sea to those of the new one.
    pub fn bound_wave_totals(&self) -> BoundWaveTotals {
        self.bound_waves.cross_faded_value(self.new_sea_weight).totals
    }

    /// The ordinary cascades of the current sea, in the order of its plan.
    pub fn current_ordinary_cascades(&self) -> impl Iterator<Item = &MapCascade> {
        MapCascade::ordinary(self.current_cascades())
    }

    /// Updates the drawn cascades when a transition to `plan`, with equal FFT size, starts. A cross-fade adds those of
    /// the new sea; `Amplitudes` replaces those of the current sea, and `Immediate` all; other kinds change nothing.
    pub(super) fn start_transition(
        &mut self,
        plan: &Plan,
        resources: &Resources,
        kind: TransitionKind,
        has_coast: bool,
    ) {
        match kind {
            TransitionKind::Foam | TransitionKind::Surface => return,
            TransitionKind::Immediate => {
                self.cascades.clear();
                self.fading_cascade_count = 0;
            }
            TransitionKind::Amplitudes => self.cascades.truncate(self.fading_cascade_count),
            TransitionKind::CrossFade => {
                self.end_cross_fade();
                self.fading_cascade_count = self.cascades.len();
            }
        }
        self.cascades.extend(MapCascade::all_of_plan(plan, resources, has_coast));
        (self.h0, self.wave_table) =
            (resources.current_waves().h0.clone(), resources.current_waves().wave_table.clone());
    }

    /// Applies one frame of a transition to `plan` to the bound waves.
    pub(super) fn apply_transition_step(&mut self, step: &TransitionFrameProgress, plan: &Plan) {
        self.bound_waves.apply_transition_step(step, |_| plan.bound_waves());
    }

    /// Sets amplitude factor and variance correction of each drawn cascade in a cross-fade. `overlaps` has an entry per
    /// ordinary cascade, the covariance of both seas, which holds for the layers of a coast before it, too.
    pub(super) fn set_cross_fade_weights(&mut self, overlaps: &[SeaCovariance], new_sea_weight: f64) {
        self.new_sea_weight = new_sea_weight;
        let fading = self.fading_cascade_count;
        let mut ordinary = 0;
        for (i, cascade) in self.cascades.iter_mut().enumerate() {
            let overlap = overlaps.get(ordinary).copied().unwrap_or_default();
            ordinary += usize::from(cascade.role == CascadeRole::Ordinary);
            let ([old, new], variance_correction) = cross_fade_amplitudes(&overlap, new_sea_weight);
            (cascade.cross_fade_amplitude_factor, cascade.cross_fade_variance_factor) =
                (if i < fading { old } else { new } as f32, variance_correction as f32);
        }
    }

    /// Ends a cross-fade: removes the entries of the old sea from `cascades`.
    pub(super) fn end_cross_fade(&mut self) {
        self.cascades.drain(..self.fading_cascade_count);
        self.fading_cascade_count = 0;
    }

    /// Draws the current sea alone, with or without the layers of a coast, after a coast has come or gone.
    pub(super) fn set_coast(&mut self, plan: &Plan, resources: &Resources) {
        self.coast =
            resources.coast.as_ref().map(|coast| MapCoast { gains: coast.gains.clone(), square: coast.square });
        self.fading_cascade_count = 0;
        self.cascades = MapCascade::all_of_plan(plan, resources, self.coast.is_some());
        self.recreate_views(resources);
    }

    /// Creates the texture views of the maps anew after their texture has been replaced, and increases
    /// `view_generation`.
    pub(super) fn recreate_views(&mut self, resources: &Resources) {
        self.displacement = resources.map_view(MapKind::Displacement);
        self.gradients = resources.map_view(MapKind::Gradients);
        self.slope_moments = resources.map_view(MapKind::Moments);
        self.view_generation += 1;
    }
}

impl MapCascade {
    /// Those of the given cascades that are cascades of a plan, not layers that a coast adds.
    pub fn ordinary(cascades: &[Self]) -> impl Iterator<Item = &Self> {
        cascades.iter().filter(|cascade| cascade.role == CascadeRole::Ordinary)
    }

    /// Entries of a plan's sea. A coast's layers come first in the list, but last in the textures.
    fn all_of_plan(plan: &Plan, resources: &Resources, has_coast: bool) -> Vec<Self> {
        let first = resources.first_layer();
        let ordinary: Vec<Self> =
            (first..).zip(&plan.cascades).map(|(layer, c)| Self::of_plan(plan, c, layer)).collect();
        let (Some(coast), Some(longest)) = (resources.coast.as_ref().filter(|_| has_coast), ordinary.first()) else {
            return ordinary;
        };
        let layer = first + ordinary.len() as u32;
        let square = coast.square;
        let texel_m = square.side_m / f64::from(resources.n);
        let at_coast = Self {
            role: CascadeRole::Coast,
            patch_m: square.side_m,
            tiling: Tiling::new(square.side_m, 0, plan.sea.seed, false),
            shortest_wavelength_m: SHORTEST_COASTAL_WAVE_TEXELS * texel_m,
            layer: layer + 1,
            ..*longest
        };
        let offshore = Self { role: CascadeRole::Offshore, layer, ..*longest };
        [at_coast, offshore].into_iter().chain(ordinary.iter().copied()).collect()
    }

    fn of_plan(plan: &Plan, c: &Cascade, layer: u32) -> Self {
        // Half the mean square slope is the mean variance of one slope component: moments in this unit are near 1.
        let mss = plan.spectrum_integrals.mss_between_wave_numbers(c.k_low, c.k_high);
        Self {
            role: CascadeRole::Ordinary,
            patch_m: c.patch_m,
            tiling: plan.tiling(c),
            shortest_wavelength_m: TAU / c.k_high.max(c.dk()),
            moment_unit: if mss > 1e-12 { 0.5 * mss as f32 } else { 1.0 },
            layer,
            cross_fade_amplitude_factor: 1.0,
            cross_fade_variance_factor: 1.0,
        }
    }
}

/// Displacement and gradient maps of all cascades in f32, as before rounding for textures, without choppiness.
#[derive(Clone, Debug)]
pub struct MapsF32 {
    /// Number of texels along a side of a map.
    pub n: usize,
    /// Per cascade, n x n texels of displacement (Dx, eta, Dz in m; dDx/dz), then n x n texels of gradients (d eta/dx,
    /// d eta/dz, dDx/dx, dDz/dz). Each map is stored row by row: x varies fastest, then z.
    pub texels: Vec<[f32; 4]>,
}

impl MapsF32 {
    /// Number of cascades whose maps `texels` holds.
    pub fn cascade_count(&self) -> usize {
        self.texels.len() / (2 * self.n * self.n)
    }

    /// Displacement map of the cascade with index `cascade`, row by row: Dx, height eta and Dz (m), and dDx/dz.
    pub fn displacement(&self, cascade: usize) -> &[[f32; 4]] {
        &self.texels[2 * cascade * self.n * self.n..][..self.n * self.n]
    }

    /// Gradient map of the cascade with index `cascade`, row by row: d eta/dx, d eta/dz, dDx/dx and dDz/dz.
    pub fn gradients(&self, cascade: usize) -> &[[f32; 4]] {
        &self.texels[(2 * cascade + 1) * self.n * self.n..][..self.n * self.n]
    }
}
