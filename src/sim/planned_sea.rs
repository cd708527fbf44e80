//! A plan in the form that the passes read.

use super::maps::{MAX_CASCADES, MapCascade};
use super::uniforms::{MAX_TERMS, SeaCascade, SeaTerm, SeaUniform};
use crate::waves::spreading::Cosine;
use crate::waves::system::TermKind;
use crate::waves::{Plan, table};

/// A plan and the terms of its directional spectrum.
pub struct PlannedSea {
    /// The plan.
    pub plan: Plan,
    terms: [SeaTerm; MAX_TERMS],
    term_count: u32,
    stride: u32,
}

/// Parameters of one evaluation of a sea.
#[derive(Clone, Copy, Debug)]
pub struct Evaluation {
    /// Time, s.
    pub t_s: f64,
    /// Whether the column pass also leaves the maps in the intermediate buffer, in f32.
    pub keep_f32: bool,
    /// Weight of the tabulated amplitudes in the spectrum pass; 1 replaces the current ones.
    pub blend: f64,
}

/// An evaluation whose uniform has a slot in the buffer of the submission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EvaluationSlot {
    /// Dynamic offset of the uniform.
    pub uniform: u32,
    /// Number of cascades.
    pub count: u32,
    /// Index of the wave buffers in `Resources::waves`.
    pub waves: usize,
    /// Layer of the first cascade among the layers of a kind of map.
    pub first_layer: u32,
    /// Whether the column pass also leaves the maps in the intermediate buffer, in f32.
    pub keep_f32: bool,
}

impl PlannedSea {
    /// Takes a plan.
    pub fn new(plan: Plan) -> Self {
        let (parts, stride) = table::terms(&plan);
        let mut terms = [SeaTerm::default(); MAX_TERMS];
        for (out, part) in terms.iter_mut().zip(&parts) {
            let kind = match part.kind {
                TermKind::Lobe(Cosine::None) => 0,
                TermKind::Lobe(Cosine::Full) => 1,
                TermKind::Lobe(Cosine::Forward) => 2,
                TermKind::Measured => 3,
            };
            *out = SeaTerm { travel: part.travel.map(|x| x as f32), kind, slot: part.slot as u32 };
        }
        Self { plan, terms, term_count: parts.len() as u32, stride: stride as u32 }
    }

    /// The uniform of one evaluation into the given maps, with horizontal displacement factors `chop` along x and z.
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
