//! Converts the plan of a sea to the uniforms that the compute passes read.

use super::maps::{MAX_CASCADES, MapCascade};
use super::uniforms::{MAX_SPECTRUM_TERMS, SeaCascade, SeaUniform, SpectrumTerm};
use crate::waves::spreading::CosineFactor;
use crate::waves::system::TermKind;
use crate::waves::{Plan, table};

/// The plan of a sea, with the terms of its directional spectrum in the form that shaders read.
pub struct SeaUniformSource {
    /// The plan of the sea.
    pub plan: Plan,
    terms: [SpectrumTerm; MAX_SPECTRUM_TERMS],
    term_count: u32,
    vectors_per_entry: u32,
}

/// Parameters of one evaluation of a sea, which computes its waves at one time.
#[derive(Clone, Copy, Debug)]
pub struct SeaUniformParameters {
    /// Time of the waves, s.
    pub t_s: f64,
    /// Whether the column pass also keeps the maps in f32, in the buffer `Resources::row_transforms`.
    pub keeps_f32_maps: bool,
    /// Weight with which the spectrum pass moves h0 to the amplitudes of the plan, 0 to 1; 1 replaces h0.
    pub spectrum_blend: f64,
}

/// An evaluation of a sea whose uniform has been added to the uniform buffer of the submission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SeaDispatch {
    /// Dynamic offset of the uniform in its buffer, bytes.
    pub uniform_offset: u32,
    /// Number of cascades of the sea.
    pub cascade_count: u32,
    /// Index of the sea's wave buffers in `Resources::wave_buffers`.
    pub wave_buffers_index: usize,
    /// Index of the sea's first cascade among the layers of each kind of map.
    pub first_layer: u32,
    /// Whether the column pass also keeps the maps in f32, in the buffer `Resources::row_transforms`.
    pub keeps_f32_maps: bool,
}

impl SeaUniformSource {
    /// Converts the terms of a plan's directional spectrum to the form that shaders read.
    pub fn new(plan: Plan) -> Self {
        let (parts, vectors_per_entry) = table::terms(&plan);
        let mut terms = [SpectrumTerm::default(); MAX_SPECTRUM_TERMS];
        for (out, part) in terms.iter_mut().zip(&parts) {
            let kind = match part.kind {
                TermKind::Lobe(CosineFactor::One) => 0,
                TermKind::Lobe(CosineFactor::Squared) => 1,
                TermKind::Lobe(CosineFactor::SquaredForward) => 2,
                TermKind::Measured => 3,
            };
            *out = SpectrumTerm {
                reference_direction: part.travel.map(|x| x as f32),
                kind,
                first_vector: part.first_vector as u32,
            };
        }
        Self { plan, terms, term_count: parts.len() as u32, vectors_per_entry: vectors_per_entry as u32 }
    }

    /// Uniform for one evaluation of the sea, for the cascades `maps` and the choppiness `choppiness` along x and z.
    pub fn uniform(&self, maps: &[MapCascade], choppiness: [f64; 2], parameters: SeaUniformParameters) -> SeaUniform {
        let plan = &self.plan;
        let mut cascades = [SeaCascade::default(); MAX_CASCADES];
        let mut weights = [0.0; MAX_CASCADES];
        for (((out, weight), cascade), map) in cascades.iter_mut().zip(&mut weights).zip(&plan.cascades).zip(maps) {
            *out = SeaCascade {
                patch_m: cascade.patch_m as f32,
                dk: cascade.dk() as f32,
                noise_key: cascade.noise_key,
                moment_unit: map.moment_unit,
            };
            *weight = map.amplitude_factor;
        }
        SeaUniform {
            cascades,
            terms: self.terms,
            amplitude_factors: weights,
            choppiness: choppiness.map(|l| l as f32),
            n: plan.n,
            cascade_count: plan.cascades.len() as u32,
            seed: plan.sea.seed,
            time_in_period_u32: plan.time_in_period_u32(parameters.t_s),
            keeps_f32_maps: u32::from(parameters.keeps_f32_maps),
            term_count: self.term_count,
            vectors_per_entry: self.vectors_per_entry,
            first_layer: maps.first().map_or(0, |map| map.layer),
            spectrum_blend: parameters.spectrum_blend as f32,
            unused: 0,
        }
    }
}
