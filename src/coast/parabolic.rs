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
pub struct ParabolicSolver<'a> {
    bathymetry: &'a Bathymetry,
    options: Options,
    profile_m: Vec<f64>,
    marchers: Vec<Marcher>,
    field: Field,
    dissipation: Dissipation,
    energy: ColumnEnergy,
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

impl<'a> ParabolicSolver<'a> {
    /// Prepares the solution; the first column gets the waves of the open sea.
    pub fn new(bathymetry: &'a Bathymetry, incident: &[Incident], options: &Options) -> Self {
        let profile_m = mean_profile_m(bathymetry, options.min_depth_m);
        let points = bathymetry.columns * bathymetry.rows;
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
            bathymetry,
            options: *options,
            profile_m,
            marchers,
            field: Field { columns, rows, cell_m, components },
            dissipation: Dissipation::none(bathymetry),
            energy: ColumnEnergy::default(),
            solved: 1,
        };
        out.energy = out.column_energy();
        let depths = out.depths(0);
        out.dissipation.record(0, &out.energy, &depths, &out.options);
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
            self.dissipation.record(column, &arrived, &after, &self.options);
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
            .map(|refinement| DepthLine::between_columns(self.bathymetry, column - 1, refinement))
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
        for (marcher, component) in self.marchers.iter().zip(&mut self.field.components) {
            for j in 0..self.bathymetry.rows {
                let at = marcher.envelope(j);
                component.envelope[j * self.bathymetry.columns + column] = [at.re as f32, at.im as f32];
            }
        }
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
