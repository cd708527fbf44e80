//! Converts the plan of a sea to the uniforms that the compute passes read.

use super::maps::{MAX_CASCADES, MapCascade};
use super::uniforms::{MAX_TERMS, SeaCascade, SpectrumTerm, SeaUniform};
use crate::waves::spreading::Cosine;
use crate::waves::system::TermKind;
use crate::waves::{Plan, table};

/// The plan of a sea, with the terms of its directional spectrum in the form that shaders read.
pub struct PlannedSea {
    /// The plan of the sea.
    pub plan: Plan,
    terms: [SpectrumTerm; MAX_TERMS],
    term_count: u32,
    stride: u32,
}

/// Parameters of one evaluation of a sea, which computes its waves at one time.
#[derive(Clone, Copy, Debug)]
pub struct Evaluation {
    /// Time of the waves, s.
    pub t_s: f64,
    /// Whether the column pass also keeps the maps in f32, in the buffer `Resources::lines`.
    pub keep_f32: bool,
    /// Weight with which the spectrum pass moves h0 to the amplitudes of the plan, 0 to 1; 1 replaces h0.
    pub blend: f64,
}

/// An evaluation of a sea whose uniform has been added to the uniform buffer of the submission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EvaluationSlot {
    /// Dynamic offset of the uniform in its buffer, bytes.
    pub uniform: u32,
    /// Number of cascades of the sea.
    pub count: u32,
    /// Index of the sea's wave buffers in `Resources::waves`.
    pub waves: usize,
    /// Index of the sea's first cascade among the layers of each kind of map.
    pub first_layer: u32,
    /// Whether the column pass also keeps the maps in f32, in the buffer `Resources::lines`.
    pub keep_f32: bool,
}

impl PlannedSea {
    /// Converts the terms of a plan's directional spectrum to the form that shaders read.
    pub fn new(plan: Plan) -> Self {
        let (parts, stride) = table::terms(&plan);
        let mut terms = [SpectrumTerm::default(); MAX_TERMS];
        for (out, part) in terms.iter_mut().zip(&parts) {
            let kind = match part.kind {
                TermKind::Lobe(Cosine::None) => 0,
                TermKind::Lobe(Cosine::Full) => 1,
                TermKind::Lobe(Cosine::Forward) => 2,
                TermKind::Measured => 3,
            };
            *out = SpectrumTerm { travel: part.travel.map(|x| x as f32), kind, slot: part.slot as u32 };
        }
        Self { plan, terms, term_count: parts.len() as u32, stride: stride as u32 }
    }

    /// Uniform for one evaluation of the sea, for the cascades `maps` and the choppiness `chop` along x and z.
    pub fn uniform(&self, maps: &[MapCascade], chop: [f64; 2], evaluation: Evaluation) -> SeaUniform {
        let plan = &self.plan;
        let mut cascades = [SeaCascade::default(); MAX_CASCADES];
        let mut weights = [0.0; MAX_CASCADES];
        for (((out, weight), cascade), map) in cascades.iter_mut().zip(&mut weights).zip(&plan.cascades).zip(maps) {
            *out = SeaCascade {
                patch_m: cascade.patch_m as f32,
                dk: cascade.dk() as f32,
                key: cascade.key,
                moment_scale: map.moment_scale,
            };
            *weight = map.weight;
        }
        SeaUniform {
            cascades,
            terms: self.terms,
            weights,
            chop: chop.map(|l| l as f32),
            n: plan.n,
            count: plan.cascades.len() as u32,
            seed: plan.sea.seed,
            phase_time: plan.phase_time(evaluation.t_s),
            keep_f32: u32::from(evaluation.keep_f32),
            term_count: self.term_count,
            stride: self.stride,
            first_layer: maps.first().map_or(0, |map| map.layer),
            blend: evaluation.blend as f32,
            unused: 0,
        }
    }
}
