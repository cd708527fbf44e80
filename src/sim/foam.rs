//! Plans the time steps of the foam simulation, and where the levels of its clipmap lie in the world.

use super::maps::{FoamLevel, MAX_DRAWN_CASCADES, Maps};
use super::transition::{Interpolate, interpolate, interpolate_pair};
use super::uniforms::{FoamCascade, FoamLevelCorner, FoamLevelUniform, FoamUniform};
use crate::waves::foam::{FOAM_LEVEL_COUNT, FRONT_DECAY_RATIO, FRONT_GROWTH_RATIO, PLUME_DECAY_RATIO};
use crate::waves::{Plan, foam};

/// Number of time steps of a cold start, which computes the foam anew from the recent past, as after a jump of time.
pub const COLD_START_STEPS: usize = 48;
/// Length of the past that a cold start (computing the foam anew) simulates, in e-folding times of the foam's decay.
const COLD_START_DECAY_TIMES: f64 = 5.0;
/// Longest time step of the foam, s. If simulated time advances by more, the foam is computed anew (a cold start).
const MAX_STEP_S: f64 = 1.0;
/// Side of the square that the finest foam level (the smallest of four nested square foam grids) covers, m.
const FINEST_LEVEL_SIDE_M: f64 = 64.0;
/// Ratio of the side of a foam level (square foam grid) to the side of the next smaller level.
const LEVEL_SIDE_RATIO: f64 = 4.0;

/// One time step of the foam simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoamStep {
    /// Simulated time at the end of the time step, s; the step reads the wave maps of this time.
    pub t_s: f64,
    /// Length of the time step in simulated time, s.
    pub dt_s: f64,
    /// Whether all earlier foam is discarded first: every cell then starts from the expected mean of the foam.
    pub discards_history: bool,
}

/// Plans the time steps of the foam: keeps the time that the foam simulation has reached, the steps that are still to
/// be made, and the cells that the foam levels (nested square grids) cover.
#[derive(Debug)]
pub struct FoamScheduler {
    size: u32,
    /// Simulated time of the foam, s: the end of its last time step. None before the first step.
    at_s: Option<f64>,
    /// Time steps that a cold start of the foam has yet to make, in reverse order: the next step is the last element.
    cold_start_steps: Vec<FoamStep>,
    /// World indices (x, z) of the cell with the lowest x and z that each foam level covered at the last foam step;
    /// cell i begins at i times the level's cell size. None before the first step.
    cells: Option<[[i32; 2]; FOAM_LEVEL_COUNT]>,
    /// Simulated time that the foam had reached when the sea last changed, s; if time stands still after that, the foam
    /// is computed anew. None if no earlier sea's foam is left.
    changed_at_s: Option<f64>,
    /// World position (x, z) of the camera at the last time step, m; the foam levels lay around it.
    centre: [f64; 2],
    parameters: FoamParameters,
}

/// Parameters of the foam simulation (where foam forms, how fast it grows and decays), derived from a sea's plan.
#[derive(Clone, Debug, PartialEq)]
pub struct FoamParameters {
    /// Choppiness along x and z: factors by which the maps' horizontal displacements Dx and Dz are multiplied.
    pub choppiness: [f64; 2],
    /// For each foam level, the foam source (0 to 1, to be multiplied by `rate_per_s`) as a function of the Jacobian of
    /// the displacement: the Jacobian below which it is positive, and its increase per unit of Jacobian below that.
    sources: [foam::FoamSource; FOAM_LEVEL_COUNT],
    /// Expected mean of the foam over the sea surface, from 0 (no foam) to 1 (all covered).
    pub mean_foam: f64,
    /// Side of the smallest texels, m, on which the pass reads the Jacobian.
    breaker_texel_m: f64,
    decay_s: f64,
    rate_per_s: f64,
}

impl FoamParameters {
    /// Derives the foam parameters from a sea's plan, for foam levels (square grids) of `size` x `size` cells.
    pub fn new(size: u32, plan: &Plan) -> Self {
        let foam = foam::FoamModel::new(plan);
        Self {
            choppiness: plan.sea.choppiness_xz(),
            sources: std::array::from_fn(|level| foam.foam_source_for_texel(plan, cell_m(size, level))),
            mean_foam: foam.expected_mean_foam,
            breaker_texel_m: foam::breaker_texel_m(plan),
            decay_s: plan.sea.foam.decay_s,
            rate_per_s: plan.sea.foam.rate_per_s,
        }
    }
}

impl Interpolate for FoamParameters {
    fn interpolate(&self, to: &Self, fraction: f64) -> Self {
        let source = |level: usize| {
            let (a, b) = (self.sources[level], to.sources[level]);
            // A sea without foam has slope 0 and no meaningful threshold.
            let threshold = match (a.source_slope > 0.0, b.source_slope > 0.0) {
                (true, false) => a.jacobian_threshold,
                (false, true) => b.jacobian_threshold,
                _ => interpolate(a.jacobian_threshold, b.jacobian_threshold, fraction),
            };
            foam::FoamSource {
                jacobian_threshold: threshold,
                source_slope: interpolate(a.source_slope, b.source_slope, fraction),
                even: interpolate(a.even, b.even, fraction),
            }
        };
        Self {
            choppiness: interpolate_pair(self.choppiness, to.choppiness, fraction),
            sources: std::array::from_fn(source),
            mean_foam: interpolate(self.mean_foam, to.mean_foam, fraction),
            breaker_texel_m: interpolate(self.breaker_texel_m, to.breaker_texel_m, fraction),
            decay_s: interpolate(self.decay_s, to.decay_s, fraction),
            rate_per_s: interpolate(self.rate_per_s, to.rate_per_s, fraction),
        }
    }
}

impl FoamScheduler {
    /// Creates the scheduler of a foam simulation that has made no time step yet, with levels of `size` x `size` cells.
    pub fn new(size: u32, parameters: FoamParameters) -> Self {
        Self {
            size,
            at_s: None,
            cold_start_steps: Vec::new(),
            cells: None,
            changed_at_s: None,
            centre: [0.0; 2],
            parameters,
        }
    }

    /// Replaces the parameters of later foam steps. The foam and the time that it has reached are kept.
    pub fn set_parameters(&mut self, parameters: FoamParameters) {
        self.parameters = parameters;
    }

    /// Records that the sea has changed. Foam on the water is kept while simulated time runs. If time stands still, the
    /// next call of [`Self::steps_to`] starts computing the foam anew.
    pub fn note_sea_change(&mut self) {
        self.changed_at_s = self.at_s;
    }

    /// Forgets all foam: the next call of [`Self::steps_to`] starts computing it anew from the recent past.
    pub fn restart(&mut self) {
        (self.at_s, self.changed_at_s) = (None, None);
        self.cold_start_steps.clear();
    }

    /// Returns the next time steps of the foam towards the simulated time `t_s` (s), at most `max_steps`, and counts
    /// them as made; none if the foam has reached `t_s`. The foam levels lie around the world position `centre` (x, z),
    /// m. A cold start (at the first call, after a jump of time, or in another sea or place while time stands still)
    /// makes steps that depend only on `t_s` and the decay time. So a still picture depends only on the state.
    pub fn steps_to(&mut self, t_s: f64, centre: [f64; 2], max_steps: usize) -> Vec<FoamStep> {
        let jumped = |at: f64| t_s < at || t_s - at > MAX_STEP_S;
        let memory_s = COLD_START_DECAY_TIMES * self.parameters.decay_s;
        if self.changed_at_s.is_some_and(|changed| t_s - changed > memory_s) {
            self.changed_at_s = None;
        }
        let moved = (0..2).any(|axis| (centre[axis] - self.centre[axis]).abs() > 0.25 * FINEST_LEVEL_SIDE_M);
        let stands = self.at_s == Some(t_s);
        let elsewhere = stands && (moved || self.changed_at_s.is_some());
        if self.at_s.is_none_or(jumped) && self.cold_start_steps.is_empty() || elsewhere {
            self.changed_at_s = None;
            self.centre = centre;
            self.cold_start_steps = cold_start_steps(t_s, self.parameters.decay_s);
            self.cold_start_steps.reverse();
        }
        if !stands {
            self.centre = centre;
        }
        let mut steps = Vec::new();
        while steps.len() < max_steps {
            match self.cold_start_steps.pop() {
                Some(step) => {
                    // Time may have moved on since the cold start began. Its last step then ends at the current time.
                    let last = self.cold_start_steps.is_empty();
                    let from = step.t_s - step.dt_s;
                    let t = if last && t_s >= from && t_s - from <= MAX_STEP_S { t_s } else { step.t_s };
                    steps.push(FoamStep { t_s: t, dt_s: t - from, discards_history: step.discards_history });
                    self.at_s = Some(t);
                }
                None => {
                    if let Some(at) = self.at_s
                        && t_s > at
                        && !jumped(at)
                    {
                        steps.push(FoamStep { t_s, dt_s: t_s - at, discards_history: false });
                        self.at_s = Some(t_s);
                    }
                    break;
                }
            }
        }
        steps
    }

    /// Parameters with which the next foam steps are made; during a transition, they lie between those of both seas.
    pub fn parameters(&self) -> &FoamParameters {
        &self.parameters
    }

    /// Whether the foam simulation has reached the time `t_s`, s, so that no time step is left to make.
    pub fn has_reached(&self, t_s: f64) -> bool {
        self.cold_start_steps.is_empty() && self.at_s == Some(t_s)
    }

    /// Cell sizes and centres of the foam levels, finest first, for a camera at the world position `centre` (x, z), m.
    pub fn levels(&self, centre: [f64; 2]) -> Vec<FoamLevel> {
        let half = f64::from(self.size / 2);
        (0..FOAM_LEVEL_COUNT)
            .map(|level| {
                let cell_m = cell_m(self.size, level);
                let centre = self.first_cell(level, centre).map(|c| (f64::from(c) + half) * cell_m);
                let source = self.parameters.sources[level];
                // A sea that glides from one of shorter waves has part of an even source, and no crests yet.
                let has_breakers = source.source_slope > 0.0 && source.even == 0.0;
                FoamLevel { cell_m, centre_m: centre, has_breakers }
            })
            .collect()
    }

    /// Makes the uniform of one foam time step. `maps` are the wave maps at the end of the step; the foam levels lie
    /// around the world position `centre` (x, z), m. Remembers which cells they cover, for the next step.
    pub fn uniform(&mut self, step: &FoamStep, centre: [f64; 2], maps: &Maps) -> FoamUniform {
        let cells: [[i32; 2]; FOAM_LEVEL_COUNT] = std::array::from_fn(|level| self.first_cell(level, centre));
        // With a previous first cell far out of range, the foam pass finds no earlier foam for any cell.
        let unknown = [[i32::MIN / 2; 2]; FOAM_LEVEL_COUNT];
        let previous = if step.discards_history { unknown } else { self.cells.unwrap_or(unknown) };
        self.cells = Some(cells);
        let levels = std::array::from_fn(|level| {
            let cell_m = cell_m(self.size, level);
            let source = self.parameters.sources[level];
            let corner = cells[level].map(|c| f64::from(c) * cell_m);
            let half_texel = 0.5 / f64::from(maps.n);
            let mut corners = [FoamLevelCorner::default(); MAX_DRAWN_CASCADES];
            for (out, cascade) in corners.iter_mut().zip(&maps.cascades) {
                out.tile_position = cascade.tiling.lattice_position(corner).into();
                out.uv = corner.map(|x| ((x / cascade.patch_m).rem_euclid(1.0) + half_texel) as f32);
            }
            FoamLevelUniform {
                corners,
                first_cell: cells[level],
                previous_first_cell: previous[level],
                cell_m: cell_m as f32,
                jacobian_threshold: source.jacobian_threshold as f32,
                source_slope: source.source_slope as f32,
                initial_foam: self.parameters.mean_foam as f32,
                coast_uv: maps.coast.as_ref().map_or([0.0; 2], |coast| coast.square.uv(corner).map(|x| x as f32)),
                coast_uv_per_cell: maps.coast.as_ref().map_or(0.0, |coast| (cell_m / coast.square.side_m) as f32),
                even_source: source.even as f32,
            }
        });
        let mut cascades = [FoamCascade::default(); MAX_DRAWN_CASCADES];
        for (out, cascade) in cascades.iter_mut().zip(&maps.cascades) {
            let (patch_m, role) = (cascade.patch_m as f32, cascade.role as u32);
            *out = FoamCascade { patch_m, layer: cascade.layer, role, unused: 0 };
        }
        FoamUniform {
            levels,
            cascades,
            dt_s: step.dt_s as f32,
            decay_per_s: (1.0 / self.parameters.decay_s) as f32,
            growth_per_s: self.parameters.rate_per_s as f32,
            cells_per_side: self.size,
            cascade_count: maps.cascades.len() as u32,
            front_growth_per_s: (FRONT_GROWTH_RATIO * self.parameters.rate_per_s) as f32,
            front_decay_per_s: (1.0 / (FRONT_DECAY_RATIO * self.parameters.decay_s)) as f32,
            plume_decay_per_s: (1.0 / (PLUME_DECAY_RATIO * self.parameters.decay_s)) as f32,
            breaker_texel_m: self.parameters.breaker_texel_m as f32,
            initial_front_ratio: foam::MEAN_FRONT_RATIO as f32,
            initial_plume_ratio: foam::MEAN_PLUME_RATIO as f32,
            unused: 0,
        }
    }

    /// World indices (x, z) of the cell with the lowest x and z of a foam level around the world position `centre`, m.
    fn first_cell(&self, level: usize, centre: [f64; 2]) -> [i32; 2] {
        let half = self.size as i32 / 2;
        centre.map(|x| (x / cell_m(self.size, level)).floor() as i32 - half)
    }
}

/// Side of a cell of the foam level with index `level`, m. The level has `size` cells along a side.
fn cell_m(size: u32, level: usize) -> f64 {
    FINEST_LEVEL_SIDE_M * LEVEL_SIDE_RATIO.powi(level as i32) / f64::from(size)
}

/// Time steps of a cold start that ends at the simulated time `t_s`, s, for foam that decays by 1/e in `decay_s`, s.
/// They cover five decay times and get shorter towards `t_s`, because recent foam has faded least.
fn cold_start_steps(t_s: f64, decay_s: f64) -> Vec<FoamStep> {
    const STEP_GRADING_EXPONENT: f64 = 1.8;
    let age = |i: usize| {
        let back = (COLD_START_STEPS - 1).saturating_sub(i) as f64 / (COLD_START_STEPS - 1) as f64;
        COLD_START_DECAY_TIMES * decay_s * back.powf(STEP_GRADING_EXPONENT)
    };
    let dt = |i: usize| age(i.saturating_sub(1)) - age(i.max(1));
    (0..COLD_START_STEPS).map(|i| FoamStep { t_s: t_s - age(i), dt_s: dt(i), discards_history: i == 0 }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::Params;

    #[test]
    fn a_cold_start_ends_at_its_time_and_depends_on_it_alone() {
        let plan = Plan::new(&Params::default());
        for t in [0.0, 20.0, 20.1, 1e6] {
            let steps = FoamScheduler::new(64, FoamParameters::new(64, &plan)).steps_to(t, [0.0; 2], usize::MAX);
            assert_eq!(steps.len(), COLD_START_STEPS);
            assert_eq!(steps[COLD_START_STEPS - 1].t_s, t);
            for pair in steps.windows(2) {
                assert!((pair[1].t_s - pair[0].t_s - pair[1].dt_s).abs() < 1e-6 * t.max(1.0));
            }
        }
    }

    #[test]
    fn a_cold_start_in_parts_catches_up_with_time() {
        let plan = Plan::new(&Params::default());
        let mut scheduler = FoamScheduler::new(64, FoamParameters::new(64, &plan));
        let mut t = 5.0;
        let mut total = 0;
        for _ in 0..20 {
            t += 0.02;
            total += scheduler.steps_to(t, [0.0; 2], 6).len();
        }
        assert_eq!(scheduler.at_s, Some(t));
        assert!(total >= COLD_START_STEPS);
        assert_eq!(scheduler.steps_to(t, [0.0; 2], 6), vec![], "nothing to do while time stands still");
        scheduler.note_sea_change();
        assert!(scheduler.steps_to(t, [0.0; 2], 6)[0].discards_history, "another sea at the same time starts anew");
        while !scheduler.steps_to(t, [0.0; 2], 6).is_empty() {}
        assert!(scheduler.steps_to(t, [50.0, 0.0], 6)[0].discards_history, "and so does another place");
        while !scheduler.steps_to(t, [50.0, 0.0], 6).is_empty() {}
        scheduler.restart();
        let steps = scheduler.steps_to(t + 0.02, [50.0, 0.0], COLD_START_STEPS);
        assert!(steps[0].discards_history, "a restart forgets all foam, also while time runs");
        assert_eq!((steps.len(), scheduler.at_s), (COLD_START_STEPS, Some(t + 0.02)));
    }
}
