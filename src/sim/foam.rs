//! When the foam is computed, and where its world-anchored levels lie.

use super::maps::{FOAM_LEVELS, FoamLevel, MAX_DRAWN, Maps};
use super::transition::{Interpolate, interpolate, interpolate2};
use super::uniforms::{FoamCascade, FoamCorner, FoamLevelUniform, FoamUniform};
use crate::waves::{Plan, foam};

/// Time steps of a cold start.
pub const REPLAY_STEPS: usize = 48;
/// Length of the replayed past in decay times.
const REPLAY_DECAYS: f64 = 5.0;
/// Longest time step, s. A longer one is a jump of time and causes a cold start.
const LONGEST_STEP_S: f64 = 1.0;
/// Side of the finest level, m.
const FINEST_SIDE_M: f64 = 64.0;
/// Ratio of the sides of neighbouring levels.
const LEVEL_RATIO: f64 = 4.0;

/// One time step of the foam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoamStep {
    /// Time at the end of the step, s.
    pub t_s: f64,
    /// Length of the step, s.
    pub dt_s: f64,
    /// Whether the foam before the step is discarded.
    pub fresh: bool,
}

/// Time and place of the foam.
#[derive(Debug)]
pub struct FoamClock {
    size: u32,
    /// Time of the last step; None before the first.
    at_s: Option<f64>,
    /// Steps that a cold start has yet to replay, the next one last.
    replay: Vec<FoamStep>,
    /// First cell of each level at the last step.
    cells: Option<[[i32; 2]; FOAM_LEVELS]>,
    /// Time of the last step before the sea changed, as long as foam of the previous sea may be left.
    changed_at_s: Option<f64>,
    /// Centre of the levels at the last step, world x and z, m.
    centre: [f64; 2],
    parameters: FoamParameters,
}

/// The parameters of the foam that follow from a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct FoamParameters {
    /// Horizontal displacement factor along x and z.
    pub chop: [f64; 2],
    /// Threshold and slope of the source, per level.
    sources: [foam::FoamSource; FOAM_LEVELS],
    /// Expected mean foam, 0 to 1.
    pub coverage: f64,
    decay_s: f64,
    rate_per_s: f64,
}

impl FoamParameters {
    /// The parameters of a plan on levels of `size` cells a side.
    pub fn new(size: u32, plan: &Plan) -> Self {
        let foam = foam::FoamModel::new(plan);
        Self {
            chop: plan.sea.lambda(),
            sources: std::array::from_fn(|level| foam.source(plan, texel_m(size, level))),
            coverage: foam.coverage,
            decay_s: plan.sea.foam.decay_s,
            rate_per_s: plan.sea.foam.rate_per_s,
        }
    }
}

impl Interpolate for FoamParameters {
    fn interpolate(&self, to: &Self, share: f64) -> Self {
        let source = |level: usize| {
            let (a, b) = (self.sources[level], to.sources[level]);
            // Without foam (slope 0) the threshold has no meaning.
            let threshold = match (a.slope > 0.0, b.slope > 0.0) {
                (true, false) => a.threshold,
                (false, true) => b.threshold,
                _ => interpolate(a.threshold, b.threshold, share),
            };
            foam::FoamSource { threshold, slope: interpolate(a.slope, b.slope, share) }
        };
        Self {
            chop: interpolate2(self.chop, to.chop, share),
            sources: std::array::from_fn(source),
            coverage: interpolate(self.coverage, to.coverage, share),
            decay_s: interpolate(self.decay_s, to.decay_s, share),
            rate_per_s: interpolate(self.rate_per_s, to.rate_per_s, share),
        }
    }
}

impl FoamClock {
    /// A clock before its first step, for levels of `size` cells a side.
    pub fn new(size: u32, parameters: FoamParameters) -> Self {
        Self { size, at_s: None, replay: Vec::new(), cells: None, changed_at_s: None, centre: [0.0; 2], parameters }
    }

    /// Replaces the parameters; the foam and its time stay.
    pub fn set_parameters(&mut self, parameters: FoamParameters) {
        self.parameters = parameters;
    }

    /// Notes that the sea has changed. The existing foam stays while time runs; if time stands still, the next call of
    /// [`Self::steps_to`] causes a cold start.
    pub fn set_changed(&mut self) {
        self.changed_at_s = self.at_s;
    }

    /// The next time steps towards `t_s`, at most `most`; none if the foam is at `t_s` already. A cold start (the first
    /// call, a jump of time, or another sea or place while time stands still) replays time steps that depend on `t_s`
    /// alone, so that a still depends on the state alone.
    pub fn steps_to(&mut self, t_s: f64, centre: [f64; 2], most: usize) -> Vec<FoamStep> {
        let jumped = |at: f64| t_s < at || t_s - at > LONGEST_STEP_S;
        let memory_s = REPLAY_DECAYS * self.parameters.decay_s;
        if self.changed_at_s.is_some_and(|changed| t_s - changed > memory_s) {
            self.changed_at_s = None;
        }
        let moved = (0..2).any(|axis| (centre[axis] - self.centre[axis]).abs() > 0.25 * FINEST_SIDE_M);
        let stands = self.at_s == Some(t_s);
        let elsewhere = stands && (moved || self.changed_at_s.is_some());
        if self.at_s.is_none_or(jumped) && self.replay.is_empty() || elsewhere {
            self.changed_at_s = None;
            self.centre = centre;
            self.replay = replay(t_s, self.parameters.decay_s);
            self.replay.reverse();
        }
        if !stands {
            self.centre = centre;
        }
        let mut steps = Vec::new();
        while steps.len() < most {
            match self.replay.pop() {
                Some(step) => {
                    // Time may have moved on since the replay was planned; its last step then ends at the present time.
                    let last = self.replay.is_empty();
                    let from = step.t_s - step.dt_s;
                    let t = if last && t_s >= from && t_s - from <= LONGEST_STEP_S { t_s } else { step.t_s };
                    steps.push(FoamStep { t_s: t, dt_s: t - from, fresh: step.fresh });
                    self.at_s = Some(t);
                }
                None => {
                    if let Some(at) = self.at_s
                        && t_s > at
                        && !jumped(at)
                    {
                        steps.push(FoamStep { t_s, dt_s: t_s - at, fresh: false });
                        self.at_s = Some(t_s);
                    }
                    break;
                }
            }
        }
        steps
    }

    /// The present parameters.
    pub fn parameters(&self) -> &FoamParameters {
        &self.parameters
    }

    /// Whether the foam has reached `t_s`.
    pub fn is_at(&self, t_s: f64) -> bool {
        self.replay.is_empty() && self.at_s == Some(t_s)
    }

    /// The levels around `centre` (world x, z, m).
    pub fn levels(&self, centre: [f64; 2]) -> Vec<FoamLevel> {
        let half = f64::from(self.size / 2);
        (0..FOAM_LEVELS)
            .map(|level| {
                let texel_m = texel_m(self.size, level);
                let centre = self.first_cell(level, centre).map(|c| (f64::from(c) + half) * texel_m);
                FoamLevel { texel_m, centre }
            })
            .collect()
    }

    /// The uniform of one time step, with the maps at its end.
    pub fn uniform(&mut self, step: &FoamStep, centre: [f64; 2], maps: &Maps) -> FoamUniform {
        let cells: [[i32; 2]; FOAM_LEVELS] = std::array::from_fn(|level| self.first_cell(level, centre));
        // A first cell that is out of range marks all cells as unknown.
        let unknown = [[i32::MIN / 2; 2]; FOAM_LEVELS];
        let previous = if step.fresh { unknown } else { self.cells.unwrap_or(unknown) };
        self.cells = Some(cells);
        let levels = std::array::from_fn(|level| {
            let texel_m = texel_m(self.size, level);
            let source = self.parameters.sources[level];
            let corner = cells[level].map(|c| f64::from(c) * texel_m);
            let half_texel = 0.5 / f64::from(maps.n);
            let mut corners = [FoamCorner::default(); MAX_DRAWN];
            for (out, cascade) in corners.iter_mut().zip(&maps.cascades) {
                out.tile = cascade.tiling.place(corner).into();
                out.uv = corner.map(|x| ((x / cascade.patch_m).rem_euclid(1.0) + half_texel) as f32);
            }
            FoamLevelUniform {
                corners,
                cell: cells[level],
                previous: previous[level],
                texel_m: texel_m as f32,
                threshold: source.threshold as f32,
                slope: source.slope as f32,
                start: self.parameters.coverage as f32,
            }
        });
        let mut cascades = [FoamCascade::default(); MAX_DRAWN];
        for (out, cascade) in cascades.iter_mut().zip(&maps.cascades) {
            *out = FoamCascade { patch_m: cascade.patch_m as f32, layer: cascade.layer, unused: [0; 2] };
        }
        FoamUniform {
            levels,
            cascades,
            dt: step.dt_s as f32,
            decay: (1.0 / self.parameters.decay_s) as f32,
            rate: self.parameters.rate_per_s as f32,
            size: self.size,
            count: maps.cascades.len() as u32,
            unused: [0; 3],
        }
    }

    /// First cell in range along x and z of a level around `centre`.
    fn first_cell(&self, level: usize, centre: [f64; 2]) -> [i32; 2] {
        let half = self.size as i32 / 2;
        centre.map(|x| (x / texel_m(self.size, level)).floor() as i32 - half)
    }
}

/// Size of a cell of a level, m.
fn texel_m(size: u32, level: usize) -> f64 {
    FINEST_SIDE_M * LEVEL_RATIO.powi(level as i32) / f64::from(size)
}

/// The time steps of a cold start at `t_s`. They cover the last decay times and get shorter towards `t_s`: recently
/// formed foam is the brightest and the least faded, so that long steps would be visible there.
fn replay(t_s: f64, decay_s: f64) -> Vec<FoamStep> {
    const GRADING: f64 = 1.8;
    let age = |i: usize| {
        let back = (REPLAY_STEPS - 1).saturating_sub(i) as f64 / (REPLAY_STEPS - 1) as f64;
        REPLAY_DECAYS * decay_s * back.powf(GRADING)
    };
    let dt = |i: usize| age(i.saturating_sub(1)) - age(i.max(1));
    (0..REPLAY_STEPS).map(|i| FoamStep { t_s: t_s - age(i), dt_s: dt(i), fresh: i == 0 }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::Params;

    #[test]
    fn a_cold_start_ends_at_its_time_and_depends_on_it_alone() {
        let plan = Plan::new(&Params::default());
        for t in [0.0, 20.0, 20.1, 1e6] {
            let steps = FoamClock::new(64, FoamParameters::new(64, &plan)).steps_to(t, [0.0; 2], usize::MAX);
            assert_eq!(steps.len(), REPLAY_STEPS);
            assert_eq!(steps[REPLAY_STEPS - 1].t_s, t);
            for pair in steps.windows(2) {
                assert!((pair[1].t_s - pair[0].t_s - pair[1].dt_s).abs() < 1e-6 * t.max(1.0));
            }
        }
    }

    #[test]
    fn a_replay_in_parts_catches_up_with_time() {
        let plan = Plan::new(&Params::default());
        let mut clock = FoamClock::new(64, FoamParameters::new(64, &plan));
        let mut t = 5.0;
        let mut total = 0;
        for _ in 0..20 {
            t += 0.02;
            total += clock.steps_to(t, [0.0; 2], 6).len();
        }
        assert_eq!(clock.at_s, Some(t));
        assert!(total >= REPLAY_STEPS);
        assert_eq!(clock.steps_to(t, [0.0; 2], 6), vec![], "nothing to do while time stands still");
        clock.set_changed();
        assert!(clock.steps_to(t, [0.0; 2], 6)[0].fresh, "another sea at the same time starts anew");
        while !clock.steps_to(t, [0.0; 2], 6).is_empty() {}
        assert!(clock.steps_to(t, [50.0, 0.0], 6)[0].fresh, "and so does another place");
    }
}
