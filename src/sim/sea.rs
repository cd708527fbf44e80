//! One sea of a simulation: its plan, as the passes take it.

use super::maps::MAX_CASCADES;
use super::maps::MapCascade;
use super::uniforms::{MAX_TERMS, SeaCascade, SeaTerm, SeaUniform};
use crate::waves::spreading::Cosine;
use crate::waves::system::TermKind;
use crate::waves::{Plan, table};

/// A plan and the parts of its spectrum.
pub struct Sea {
    /// What is computed.
    pub plan: Plan,
    terms: Terms,
}

/// What one evaluation does beyond its plan.
#[derive(Clone, Copy, Debug)]
pub struct Evaluation {
    /// Time, s.
    pub t_s: f64,
    /// Whether an f32 copy of the maps is left in the intermediate buffer.
    pub keep_f32: bool,
    /// Part of the way to the table that the spectrum pass takes.
    pub ease: f64,
}

impl Sea {
    /// A sea that is to be computed.
    pub fn new(plan: Plan) -> Self {
        let terms = Terms::new(&plan);
        Self { plan, terms }
    }

    /// The uniform of one evaluation onto maps, with a chop.
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
            terms: self.terms.parts,
            weights,
            chop: chop.map(|l| l as f32),
            n: plan.n,
            count: plan.cascades.len() as u32,
            seed: plan.sea.seed,
            phase_time: plan.phase_time(evaluation.t_s),
            keep_f32: u32::from(evaluation.keep_f32),
            term_count: self.terms.count,
            stride: self.terms.stride,
            first_layer: maps.first().map_or(0, |map| map.layer),
            ease: evaluation.ease as f32,
            unused: 0,
        }
    }
}

/// The parts of a plan's spectrum as the spectrum pass sees them.
struct Terms {
    parts: [SeaTerm; MAX_TERMS],
    count: u32,
    stride: u32,
}

impl Terms {
    fn new(plan: &Plan) -> Self {
        let (terms, stride) = table::terms(plan);
        let mut parts = [SeaTerm::default(); MAX_TERMS];
        for (out, part) in parts.iter_mut().zip(&terms) {
            let kind = match part.kind {
                TermKind::Lobe(Cosine::None) => 0,
                TermKind::Lobe(Cosine::Full) => 1,
                TermKind::Lobe(Cosine::Forward) => 2,
                TermKind::Measured => 3,
            };
            *out = SeaTerm { travel: part.travel.map(|x| x as f32), kind, slot: part.slot as u32 };
        }
        Self { parts, count: terms.len() as u32, stride: stride as u32 }
    }
}
