//! The parabolic mild-slope equation: waves that travel shoreward, refract, diffract, shoal and break.
//!
//! Each component is marched along x as an envelope on a carrier, a plane wave that refracts over the mean depth
//! profile. The wide-angle expansion (a rational approximation of the square root, after Kirby 1986) is made around the
//! carrier, so that it is exact for plane waves of any direction over straight contours. docs/design/coast.md has the
//! equations.

use super::bathymetry::Bathymetry;
use super::complex::Complex;
use super::field::{Carrier, ComponentField, Field, mean_profile_m};
use super::incident::Incident;
use super::line::{DepthLine, MAX_REFINEMENT, Marcher};
use super::losses::{ColumnEnergy, Dissipation, lose_energy};
use super::options::Options;

/// Largest angle from straight shoreward of components that are marched, rad (75 degrees).
pub const MAX_ANGLE_RAD: f64 = 1.309;
/// Number of components from which on threads share a column.
const COMPONENTS_FOR_THREADS: usize = 32;

/// Marches the components of a sea over a coast, one column of points after the other, so that a program can show
/// progress or do other work between columns.
pub struct ParabolicSolver {
    bathymetry: Bathymetry,
    options: Options,
    profile_m: Vec<f64>,
    marchers: Vec<Marcher>,
    field: Field,
    dissipation: Dissipation,
    energy: ColumnEnergy,
    /// Whether the field is kept, or only what breaking does.
    keeps_field: bool,
    /// Number of columns that are solved.
    solved: usize,
}

/// Solves the parabolic mild-slope equation for all `incident` waves, with the energy that they lose together by
/// breaking. Components that travel at more than [`MAX_ANGLE_RAD`] from shoreward are 0 everywhere.
pub fn solve(bathymetry: &Bathymetry, incident: &[Incident], options: &Options) -> (Field, Dissipation) {
    let mut solver = ParabolicSolver::new(bathymetry, incident, options);
    while solver.advance() < 1.0 {}
    solver.finish()
}

impl ParabolicSolver {
    /// Prepares the solution; the first column gets the waves of the open sea.
    pub fn new(bathymetry: &Bathymetry, incident: &[Incident], options: &Options) -> Self {
        Self::prepared(bathymetry, incident, true, options)
    }

    /// Prepares a solution that only tells how the sea breaks: its field is empty.
    pub fn without_field(bathymetry: &Bathymetry, incident: &[Incident], options: &Options) -> Self {
        Self::prepared(bathymetry, incident, false, options)
    }

    fn prepared(bathymetry: &Bathymetry, incident: &[Incident], keeps_field: bool, options: &Options) -> Self {
        let profile_m = mean_profile_m(bathymetry, options.min_depth_m);
        let points = if keeps_field { bathymetry.columns * bathymetry.rows } else { 0 };
        let component = |incident: &Incident| ComponentField {
            incident: *incident,
            carrier: Carrier::new(incident, &profile_m, bathymetry.cell_m, options.gravity_m_s2),
            envelope: vec![[0.0; 2]; points],
        };
        let components: Vec<ComponentField> = incident.iter().map(component).collect();
        let lines: Vec<DepthLine> =
            (1..=MAX_REFINEMENT).map(|refinement| DepthLine::new(bathymetry, 0.0, refinement)).collect();
        let marcher = |c: &ComponentField| {
            let mut marcher = Marcher::new(c, profile_m[0], bathymetry, options);
            marcher.start(&lines[marcher.refinement - 1], options);
            marcher
        };
        let marchers = components.iter().map(marcher).collect();
        let (columns, rows, cell_m) = (bathymetry.columns, bathymetry.rows, bathymetry.cell_m);
        let mut out = Self {
            bathymetry: bathymetry.clone(),
            options: *options,
            profile_m,
            marchers,
            field: Field { columns, rows, cell_m, components },
            dissipation: Dissipation::none(bathymetry),
            energy: ColumnEnergy::default(),
            keeps_field,
            solved: 1,
        };
        out.energy = out.column_energy();
        let depths = out.depths(0);
        out.dissipation.record(0, &out.energy, &vec![1.0; rows], &depths, &out.options);
        out.store(0);
        out
    }

    /// Solves the next column. Returns the fraction of the work that is done, 1 at the end.
    pub fn advance(&mut self) -> f64 {
        if self.solved < self.bathymetry.columns {
            let column = self.solved;
            self.march_to(column);
            let mut arrived = self.column_energy();
            let (before, after) = (self.depths(column - 1), self.depths(column));
            let gains =
                lose_energy(&self.energy, &mut arrived, [&before, &after], self.bathymetry.cell_m, &self.options);
            for marcher in &mut self.marchers {
                marcher.scale(&gains);
            }
            self.dissipation.record(column, &arrived, &gains, &after, &self.options);
            self.energy = arrived;
            self.store(column);
            self.solved += 1;
        }
        self.solved as f64 / self.bathymetry.columns as f64
    }

    /// The solved field and the dissipation by breaking.
    pub fn finish(self) -> (Field, Dissipation) {
        (self.field, self.dissipation)
    }

    /// Marches all components from the column before to `column`, without breaking.
    fn march_to(&mut self, column: usize) {
        let profile = [self.profile_m[column - 1], self.profile_m[column]];
        let steps: Vec<Vec<DepthLine>> = (1..=MAX_REFINEMENT)
            .map(|refinement| DepthLine::between_columns(&self.bathymetry, column - 1, refinement))
            .collect();
        let options = &self.options;
        let work = |marchers: &mut [Marcher]| {
            for marcher in marchers {
                let lines = &steps[marcher.refinement - 1];
                marcher.march(lines, profile, options);
            }
        };
        if options.threads < 2 || self.marchers.len() < COMPONENTS_FOR_THREADS {
            return work(&mut self.marchers);
        }
        let share = self.marchers.len().div_ceil(options.threads);
        std::thread::scope(|scope| {
            for chunk in self.marchers.chunks_mut(share) {
                scope.spawn(|| work(chunk));
            }
        });
    }

    /// Energy, its flux and mean frequency at each row of the present column, summed over the components.
    fn column_energy(&self) -> ColumnEnergy {
        let mut sum = ColumnEnergy::zeros(self.bathymetry.rows);
        for marcher in &self.marchers {
            marcher.add_energy(&mut sum);
        }
        sum
    }

    fn depths(&self, column: usize) -> Vec<f64> {
        (0..self.bathymetry.rows).map(|j| self.bathymetry.at(column, j)).collect()
    }

    fn store(&mut self, column: usize) {
        if !self.keeps_field {
            return;
        }
        for (marcher, component) in self.marchers.iter().zip(&mut self.field.components) {
            for j in 0..self.bathymetry.rows {
                let at = marcher.envelope(j);
                component.envelope[j * self.bathymetry.columns + column] = [at.re as f32, at.im as f32];
            }
        }
    }
}

/// Marches single waves through a sea whose breaking is known. All waves lose the same fraction of their energy, so a
/// wave that was marched alone is what it is among the others.
pub struct LoneMarch {
    bathymetry: Bathymetry,
    options: Options,
    profile_m: Vec<f64>,
    dissipation: Dissipation,
    /// Depths of the fine steps of each column, for each refinement.
    steps: Vec<Vec<Vec<DepthLine>>>,
}

impl LoneMarch {
    /// Prepares marches through a sea with the `dissipation` of a [`ParabolicSolver`] over the same `bathymetry`.
    pub fn new(bathymetry: &Bathymetry, dissipation: Dissipation, options: &Options) -> Self {
        let columns = bathymetry.columns - 1;
        let steps = |refinement: usize| {
            (0..columns).map(|column| DepthLine::between_columns(bathymetry, column, refinement)).collect()
        };
        Self {
            bathymetry: bathymetry.clone(),
            options: *options,
            profile_m: mean_profile_m(bathymetry, options.min_depth_m),
            steps: (1..=MAX_REFINEMENT).map(steps).collect(),
            dissipation,
        }
    }

    /// The breaking of the sea.
    pub fn dissipation(&self) -> &Dissipation {
        &self.dissipation
    }

    /// The field of one wave.
    pub fn march(&self, incident: &Incident) -> ComponentField {
        let (grid, options) = (&self.bathymetry, &self.options);
        let carrier = Carrier::new(incident, &self.profile_m, grid.cell_m, options.gravity_m_s2);
        let mut out =
            ComponentField { incident: *incident, carrier, envelope: vec![[0.0; 2]; grid.columns * grid.rows] };
        let mut marcher = Marcher::new(&out, self.profile_m[0], grid, options);
        let steps = &self.steps[marcher.refinement - 1];
        marcher.start(&steps[0][0], options);
        for column in 0..grid.columns {
            if column > 0 {
                let profile = [self.profile_m[column - 1], self.profile_m[column]];
                marcher.march(&steps[column - 1], profile, options);
                marcher.scale(&self.dissipation.factors_at(column, grid.columns));
            }
            for j in 0..grid.rows {
                let at = marcher.envelope(j);
                out.envelope[j * grid.columns + column] = [at.re as f32, at.im as f32];
            }
        }
        out
    }
}

/// Solves a tridiagonal system in place by Thomas's algorithm without pivoting: `right` becomes the solution. The
/// entries `below` and `above` stand beside the diagonal in each row; the first of `below` and the last of `above` are
/// unused.
pub(super) fn solve_tridiagonal(below: &[Complex], diagonal: &mut [Complex], above: &[Complex], right: &mut [Complex]) {
    let n = right.len();
    for j in 1..n {
        let factor = below[j] * diagonal[j - 1].recip();
        diagonal[j] -= factor * above[j - 1];
        let before = right[j - 1];
        right[j] -= factor * before;
    }
    right[n - 1] *= diagonal[n - 1].recip();
    for j in (0..n - 1).rev() {
        let next = right[j + 1];
        right[j] = (right[j] - above[j] * next) * diagonal[j].recip();
    }
}
