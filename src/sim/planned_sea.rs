//! Converts the plan of a sea to the uniforms that the compute passes read.

use super::maps::{CascadeRole, MAX_CASCADES, MAX_SEA_LAYERS, MapCascade};
use super::uniforms::{SeaCascade, SeaUniform, SpectrumTerm};
use crate::waves::spreading::CosineFactor;
use crate::waves::system::{DirectionalTermKind, MAX_SPECTRUM_TERMS};
use crate::waves::{Plan, table};

/// The plan of a sea, with its directional spectrum in the form that shaders read: the source of the sea's uniforms.
pub struct SeaUniformSource {
    /// Plan of the sea (its waves, divided among cascades), from which the uniforms are made.
    pub plan: Plan,
    terms: [SpectrumTerm; MAX_SPECTRUM_TERMS],
    term_count: u32,
    vectors_per_entry: u32,
    /// Whether the maps have the layers of a coast for this sea.
    pub has_coast: bool,
}

/// Parameters, besides the plan, of one computation of a sea's waves at one time by the passes.
#[derive(Clone, Copy, Debug)]
pub struct SeaUniformParameters {
    /// Simulated time at which the waves are computed, s.
    pub t_s: f64,
    /// Whether the column pass also keeps the maps in f32, in the buffer `Resources::row_transforms`, to be read back.
    pub keeps_f32_maps: bool,
    /// Fraction of the way, 0 to 1, that the spectrum pass moves the amplitudes h0 in their buffer towards the plan's.
    pub spectrum_blend: f64,
}

/// What a pass needs to run for one sea at one time: where the sea's uniform, wave buffers and map layers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SeaDispatch {
    /// Dynamic offset of the uniform for this sea and time in the buffer `SimulationUniforms::sea`, bytes.
    pub uniform_offset: u32,
    /// Number of cascades that the spectrum, row and column passes compute.
    pub cascade_count: u32,
    /// Number of map layers of each kind, with those of a coast, whose mip levels are computed.
    pub layer_count: u32,
    /// Index of the sea's buffers (spectrum, frequencies, h0) in `Resources::wave_buffers`: 0 or 1.
    pub wave_buffers_index: usize,
    /// Whether only those waves are computed that a coast transforms; else, with a coast, only the others are.
    pub is_offshore: bool,
    /// Index of the sea's first cascade among the layers of each kind of map; its other cascades follow.
    pub first_layer: u32,
    /// Whether the column pass also keeps the maps in f32, in the buffer `Resources::row_transforms`, to be read back.
    pub keeps_f32_maps: bool,
}

impl SeaUniformSource {
    /// Takes a plan and converts its directional spectrum, a sum of spreading lobes or measured distributions, to the
    /// form that shaders read.
    pub fn new(plan: Plan) -> Self {
        let (parts, vectors_per_entry) = table::directional_terms(&plan);
        let mut terms = [SpectrumTerm::default(); MAX_SPECTRUM_TERMS];
        for (out, part) in terms.iter_mut().zip(&parts) {
            let kind = match part.kind {
                DirectionalTermKind::Lobe(CosineFactor::One) => 0,
                DirectionalTermKind::Lobe(CosineFactor::Squared) => 1,
                DirectionalTermKind::Lobe(CosineFactor::SquaredForward) => 2,
                DirectionalTermKind::Measured => 3,
                DirectionalTermKind::Tabulated => 4,
            };
            *out = SpectrumTerm {
                reference_direction: part.travel.map(|x| x as f32),
                kind,
                first_vector: part.first_vector as u32,
            };
        }
        Self {
            plan,
            terms,
            term_count: parts.len() as u32,
            vectors_per_entry: vectors_per_entry as u32,
            has_coast: false,
        }
    }

    /// Makes the uniform for the waves at the time in `parameters`. `maps` gives the layer and amplitude factor of each
    /// cascade, `choppiness` the factors of the horizontal displacement along x and z.
    pub fn uniform(&self, maps: &[MapCascade], choppiness: [f64; 2], parameters: SeaUniformParameters) -> SeaUniform {
        let plan = &self.plan;
        let mut cascades = [SeaCascade::default(); MAX_SEA_LAYERS];
        let mut weights = [0.0; MAX_CASCADES];
        let first_layer = maps.iter().map(|map| map.layer).min().unwrap_or(0);
        for map in maps {
            let index = (map.layer - first_layer) as usize;
            // The layers of a coast hold waves of the first cascade.
            let cascade = &plan.cascades[if map.role == CascadeRole::Ordinary { index } else { 0 }];
            cascades[index] = SeaCascade {
                patch_m: map.patch_m as f32,
                dk: cascade.dk() as f32,
                noise_key: cascade.noise_key,
                moment_unit: map.moment_unit,
            };
            if map.role == CascadeRole::Ordinary {
                weights[index] = map.cross_fade_amplitude_factor;
            }
        }
        SeaUniform {
            cascades,
            terms: self.terms,
            amplitude_factors: weights,
            choppiness: choppiness.map(|l| l as f32),
            n: plan.n,
            cascade_count: plan.cascades.len() as u32,
            seed: plan.sea.seed,
            period_fraction_u32: plan.period_fraction_u32(parameters.t_s),
            keeps_f32_maps: u32::from(parameters.keeps_f32_maps),
            term_count: self.term_count,
            vectors_per_entry: self.vectors_per_entry,
            first_layer,
            spectrum_blend: parameters.spectrum_blend as f32,
            direction_table_start: (plan.cascades.len() * table::entry_count(plan.n)) as u32 * self.vectors_per_entry,
        }
    }

    /// Makes the uniform for only those waves of the first cascade that a coast transforms, from that of all waves.
    pub fn offshore_uniform(&self, all: &SeaUniform) -> SeaUniform {
        let first_layer = all.first_layer + self.plan.cascades.len() as u32;
        SeaUniform { cascade_count: 1, first_layer, ..*all }
    }
}
