//! When and where foam is computed: the lattice of replayed times, and the world-anchored levels.

use super::glide::{Mix, mix, mix2};
use super::maps::{FOAM_LEVELS, MAX_DRAWN};
use super::maps::{FoamLevel, Maps};
use super::uniforms::{FoamCascade, FoamCorner, FoamLevelUniform, FoamUniform};
use crate::waves::{Plan, foam};

/// Evaluations of a cold start.
pub const REPLAY_STEPS: usize = 48;
/// Decay times that a cold start looks back.
const REPLAY_DECAYS: f64 = 5.0;
/// A longer step than this is a jump, and starts anew.
const LONGEST_STEP_S: f64 = 1.0;
/// Side of the finest level, m, and ratio of neighbouring levels.
const FINEST_SIDE_M: f64 = 64.0;
const LEVEL_RATIO: f64 = 4.0;

/// One step of the foam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Time at its end, s.
    pub t_s: f64,
    /// Its length, s.
    pub dt_s: f64,
    /// Whether nothing before it counts.
    pub fresh: bool,
}

/// Knows how far the foam has come and where its levels lie.
#[derive(Debug)]
pub struct FoamClock {
    size: u32,
    /// Time of the last step; None before the first.
    at_s: Option<f64>,
    /// Lattice times that a cold start has yet to replay, earliest first.
    replay: Vec<Step>,
    cells: Option<[[i32; 2]; FOAM_LEVELS]>,
    /// Time of the last step before the sea changed, while foam of the old sea may be left.
    changed_at_s: Option<f64>,
    /// Middle of the levels at the last step.
    centre: [f64; 2],
    numbers: Numbers,
}

/// What the foam takes from a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers {
    /// Horizontal displacement along x and z.
    pub chop: [f64; 2],
    /// Where foam forms, per level.
    sources: [foam::Source; FOAM_LEVELS],
    /// Mean foam to be expected.
    pub coverage: f64,
    decay_s: f64,
    rate_per_s: f64,
}

impl Numbers {
    /// On levels of `size` cells a side.
    pub fn new(size: u32, plan: &Plan) -> Self {
        let foam = foam::Whiteness::new(plan);
        Self {
            chop: plan.sea.lambda(),
            sources: std::array::from_fn(|level| foam.source(plan, texel_m(size, level))),
            coverage: foam.coverage,
            decay_s: plan.sea.foam.decay_s,
            rate_per_s: plan.sea.foam.rate_per_s,
        }
    }
}

impl Mix for Numbers {
    fn mix(&self, to: &Self, share: f64) -> Self {
        let source = |level: usize| {
            let (a, b) = (self.sources[level], to.sources[level]);
            // The threshold of a sea without foam stands for nothing.
            let threshold = match (a.slope > 0.0, b.slope > 0.0) {
                (true, false) => a.threshold,
                (false, true) => b.threshold,
                _ => mix(a.threshold, b.threshold, share),
            };
            foam::Source { threshold, slope: mix(a.slope, b.slope, share) }
        };
        Self {
            chop: mix2(self.chop, to.chop, share),
            sources: std::array::from_fn(source),
            coverage: mix(self.coverage, to.coverage, share),
            decay_s: mix(self.decay_s, to.decay_s, share),
            rate_per_s: mix(self.rate_per_s, to.rate_per_s, share),
        }
    }
}

impl FoamClock {
    /// Levels of `size` cells a side.
    pub fn new(size: u32, numbers: Numbers) -> Self {
        Self { size, at_s: None, replay: Vec::new(), cells: None, changed_at_s: None, centre: [0.0; 2], numbers }
    }

    /// Takes the numbers of a sea on its way to another.
    pub fn set_numbers(&mut self, numbers: Numbers) {
        self.numbers = numbers;
    }

    /// The sea is another now; the foam that is there stays while time runs.
    pub fn set_changed(&mut self) {
        self.changed_at_s = self.at_s;
    }

    /// The next steps towards `t_s`, at most `most`: none when the foam is there already. A cold start (the first call, a
    /// jump of time, or another sea or place while time stands still) replays a lattice of times that depends on `t_s`
    /// alone, so that a still depends on the state alone.
    pub fn steps_to(&mut self, t_s: f64, centre: [f64; 2], most: usize) -> Vec<Step> {
        let jumped = |at: f64| t_s < at || t_s - at > LONGEST_STEP_S;
        let memory_s = REPLAY_DECAYS * self.numbers.decay_s;
        if self.changed_at_s.is_some_and(|changed| t_s - changed > memory_s) {
            self.changed_at_s = None;
        }
        let moved = (0..2).any(|axis| (centre[axis] - self.centre[axis]).abs() > 0.25 * FINEST_SIDE_M);
        let stands = self.at_s == Some(t_s);
        let elsewhere = stands && (moved || self.changed_at_s.is_some());
        if self.at_s.is_none_or(jumped) && self.replay.is_empty() || elsewhere {
            self.changed_at_s = None;
            self.centre = centre;
            self.replay = replay(t_s, self.numbers.decay_s);
            self.replay.reverse();
        }
        if !stands {
            self.centre = centre;
        }
        let mut steps = Vec::new();
        while steps.len() < most {
            match self.replay.pop() {
                Some(step) => {
                    // Time may have gone on since the replay was planned; its last step leads to where time is now.
                    let last = self.replay.is_empty();
                    let from = step.t_s - step.dt_s;
                    let t = if last && t_s >= from && t_s - from <= LONGEST_STEP_S { t_s } else { step.t_s };
                    steps.push(Step { t_s: t, dt_s: t - from, fresh: step.fresh });
                    self.at_s = Some(t);
                }
                None => {
                    if let Some(at) = self.at_s
                        && t_s > at
                        && !jumped(at)
                    {
                        steps.push(Step { t_s, dt_s: t_s - at, fresh: false });
                        self.at_s = Some(t_s);
                    }
                    break;
                }
            }
        }
        steps
    }

    /// What the foam goes by.
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// Whether the foam has come to `t_s`.
    pub fn is_at(&self, t_s: f64) -> bool {
        self.replay.is_empty() && self.at_s == Some(t_s)
    }

    /// The levels around `centre` (world x, z).
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

    /// The uniform of one step on maps.
    pub fn uniform(&mut self, step: &Step, centre: [f64; 2], maps: &Maps) -> FoamUniform {
        let cells: [[i32; 2]; FOAM_LEVELS] = std::array::from_fn(|level| self.first_cell(level, centre));
        // Before the first step no cell is known: anything out of range says so.
        let nowhere = [[i32::MIN / 2; 2]; FOAM_LEVELS];
        let previous = if step.fresh { nowhere } else { self.cells.unwrap_or(nowhere) };
        self.cells = Some(cells);
        let levels = std::array::from_fn(|level| {
            let texel_m = texel_m(self.size, level);
            let source = self.numbers.sources[level];
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
                start: self.numbers.coverage as f32,
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
            decay: (1.0 / self.numbers.decay_s) as f32,
            rate: self.numbers.rate_per_s as f32,
            size: self.size,
            count: maps.cascades.len() as u32,
            unused: [0; 3],
        }
    }

    fn first_cell(&self, level: usize, centre: [f64; 2]) -> [i32; 2] {
        let half = self.size as i32 / 2;
        centre.map(|x| (x / texel_m(self.size, level)).floor() as i32 - half)
    }
}

/// Size of a cell of a level, m.
fn texel_m(size: u32, level: usize) -> f64 {
    FINEST_SIDE_M * LEVEL_RATIO.powi(level as i32) / f64::from(size)
}

/// The steps of a cold start at `t_s`: ages of fixed length over the last decay times, shorter and shorter. What has just
/// broken is the whitest and has not been smeared by fading, so that is where long steps would be seen.
fn replay(t_s: f64, decay_s: f64) -> Vec<Step> {
    const GRADING: f64 = 1.8;
    let age = |i: usize| {
        let back = (REPLAY_STEPS - 1).saturating_sub(i) as f64 / (REPLAY_STEPS - 1) as f64;
        REPLAY_DECAYS * decay_s * back.powf(GRADING)
    };
    let dt = |i: usize| age(i.saturating_sub(1)) - age(i.max(1));
    (0..REPLAY_STEPS).map(|i| Step { t_s: t_s - age(i), dt_s: dt(i), fresh: i == 0 }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::Params;

    #[test]
    fn a_cold_start_ends_at_its_time_and_depends_on_it_alone() {
        let plan = Plan::new(&Params::default());
        for t in [0.0, 20.0, 20.1, 1e6] {
            let steps = FoamClock::new(64, Numbers::new(64, &plan)).steps_to(t, [0.0; 2], usize::MAX);
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
        let mut clock = FoamClock::new(64, Numbers::new(64, &plan));
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
