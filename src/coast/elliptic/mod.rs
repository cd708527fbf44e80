//! The elliptic mild-slope equation (Berkhoff 1972): waves that refract, diffract and are reflected near structures.
//!
//! The wave of the open sea over straight contours is known along each side of the grid. What the coast adds to it is
//! the unknown: scattered waves, which the borders of the grid absorb. Waves of nearly one frequency share a factorised
//! matrix, whatever their directions. docs/design/coast.md has the equations.

mod grid;
mod matrix;
mod nested;
mod reference;

use super::bathymetry::Bathymetry;
use super::complex::Complex;
use super::field::{Carrier, ComponentField, Field, mean_profile_m};
use super::incident::Incident;
use super::local_wave::LocalWave;
use super::losses::Dissipation;
use super::options::Options;
use grid::Grid;
use matrix::{Water, assemble, difference};
use nested::{Dissection, Factorisation, Factors, LANES, Stencil};
use reference::Profile;
use std::f64::consts::PI;
use std::sync::Arc;

/// Largest angle from straight shoreward of components that are solved, rad (85 degrees).
pub const MAX_ANGLE_RAD: f64 = 1.484;
/// Largest ratio of the frequencies of waves that share a matrix. The phase that a wave gains on its way in is made
/// that of its own frequency; only the phase of its scattered waves is that of the shared frequency.
const BIN_RATIO: f64 = 1.04;
/// Largest phase (rad) of a wave of the open sea in a cell.
const MAX_PHASE_PER_CELL: f64 = 1.2;
/// Largest number of cells in a cell of the coast's grid, along each axis.
const MAX_REFINEMENT: usize = 3;
/// Largest number of points of the solver along the longer side of the grid.
const MAX_POINTS: usize = 600;

/// Reflection coefficient of the edge of each land point from the slope there: that of Battjes 1974,
/// 0.1 slope^2 / steepness up to 1, with the steepness `hs_m` / `wavelength_m` (in deep water) of the sea. Vertical
/// walls reflect everything, beaches next to nothing. The slope is that between the point and the deepest neighbour.
pub fn reflection_by_slope(bathymetry: &Bathymetry, hs_m: f64, wavelength_m: f64) -> Vec<f32> {
    let steepness = (hs_m / wavelength_m).max(1e-4);
    let at = |point: usize| {
        let (i, j) = (point % bathymetry.columns, point / bathymetry.columns);
        let mut deepest = bathymetry.at(i, j);
        for y in j.saturating_sub(1)..(j + 2).min(bathymetry.rows) {
            for x in i.saturating_sub(1)..(i + 2).min(bathymetry.columns) {
                deepest = bathymetry.at(x, y).max(deepest);
            }
        }
        let slope = (deepest - bathymetry.at(i, j)) / bathymetry.cell_m;
        (0.1 * slope * slope / steepness).min(1.0) as f32
    };
    (0..bathymetry.columns * bathymetry.rows).map(at).collect()
}

/// Solves the elliptic mild-slope equation for the components of a sea, one band of frequencies after the other.
pub struct EllipticSolver {
    bathymetry: Bathymetry,
    options: Options,
    grid: Grid,
    dissection: Arc<Dissection>,
    open_depth_m: f64,
    profile_m: Vec<f64>,
    bins: Vec<Bin>,
    field: Field,
    /// Number of bands whose components are all solved.
    solved: usize,
    /// The band in progress, if there is one thread.
    work: Option<BinWork>,
    /// Components that are solved and were not yet taken.
    ready: Vec<usize>,
}

/// Components of nearly one frequency.
struct Bin {
    omega_rad_s: f64,
    members: Vec<usize>,
}

/// Indices of components with their envelopes.
type Solutions = Vec<(usize, Vec<[f32; 2]>)>;

/// The profile along each side that differs, and the matrix of the coast minus that of the profile, which drives the
/// scattered waves.
type Sides = Vec<(Profile, Stencil)>;

/// A band of frequencies in progress: its matrix is factorised, then its components are solved.
struct BinWork {
    sides: Sides,
    factorisation: Option<Factorisation>,
    factors: Option<Factors>,
    /// Number of members that are solved.
    solved: usize,
}

/// Solves the elliptic mild-slope equation for all `incident` waves. `dissipation` is that of the parabolic solution of
/// the same sea, or [`Dissipation::none`]; `reflection` holds the reflection coefficient (0 to 1) of the edge of each
/// point of land. Components that travel at more than [`MAX_ANGLE_RAD`] from shoreward are 0 everywhere.
pub fn solve(
    bathymetry: &Bathymetry,
    incident: &[Incident],
    dissipation: &Dissipation,
    reflection: &[f32],
    options: &Options,
) -> Field {
    let mut solver = EllipticSolver::new(bathymetry, incident, dissipation, reflection, options);
    while solver.advance() < 1.0 {}
    solver.finish()
}

impl EllipticSolver {
    /// Prepares the solution.
    pub fn new(
        bathymetry: &Bathymetry,
        incident: &[Incident],
        dissipation: &Dissipation,
        reflection: &[f32],
        options: &Options,
    ) -> Self {
        let profile_m = mean_profile_m(bathymetry, options.min_depth_m);
        let open_depth_m = profile_m[0];
        let fastest = incident.iter().map(|wave| wave.omega_rad_s).fold(1e-3, f64::max);
        let k = LocalWave::new(fastest, open_depth_m, options.gravity_m_s2).k;
        let wanted = (k * bathymetry.cell_m / MAX_PHASE_PER_CELL).ceil() as usize;
        let affordable = (MAX_POINTS / bathymetry.columns.max(bathymetry.rows)).max(1);
        let refinement = wanted.clamp(1, MAX_REFINEMENT.min(affordable));
        let slowest = incident.iter().map(|wave| wave.omega_rad_s).fold(fastest, f64::min).max(1e-3);
        let k_low = LocalWave::new(slowest, open_depth_m, options.gravity_m_s2).k;
        let grid = Grid::new(bathymetry, dissipation, reflection, (refinement, open_depth_m, k_low), options);
        let component = |incident: &Incident| ComponentField {
            incident: *incident,
            carrier: Carrier::new(incident, &profile_m, bathymetry.cell_m, options.gravity_m_s2),
            envelope: Vec::new(),
        };
        let components = incident.iter().map(component).collect();
        let (columns, rows, cell_m) = (bathymetry.columns, bathymetry.rows, bathymetry.cell_m);
        Self {
            bathymetry: bathymetry.clone(),
            options: *options,
            dissection: Arc::new(Dissection::new(grid.columns, grid.rows)),
            grid,
            open_depth_m,
            profile_m,
            bins: bins(incident),
            field: Field { columns, rows, cell_m, components },
            solved: 0,
            work: None,
            ready: Vec::new(),
        }
    }

    /// Solves as many bands of frequencies as there are threads; with one thread, does some milliseconds of work.
    /// Returns the fraction of the work that is done, 1 at the end.
    pub fn advance(&mut self) -> f64 {
        if self.solved >= self.bins.len() {
            return 1.0;
        }
        if self.options.threads < 2 {
            return self.advance_alone();
        }
        let end = (self.solved + self.options.threads).min(self.bins.len());
        let this = &*self;
        let solutions: Vec<Solutions> = std::thread::scope(|scope| {
            let threads: Vec<_> = (self.solved..end).map(|bin| scope.spawn(move || this.solve_bin(bin))).collect();
            threads.into_iter().map(|thread| thread.join().unwrap_or_default()).collect()
        });
        self.keep(solutions.into_iter().flatten().collect());
        self.solved = end;
        self.solved as f64 / self.bins.len() as f64
    }

    /// Some milliseconds of work in the calling thread.
    fn advance_alone(&mut self) -> f64 {
        let mut work = match self.work.take() {
            Some(work) => work,
            None => self.begin(self.solved),
        };
        let solutions = self.step(self.solved, &mut work);
        self.keep(solutions);
        let members = self.bins[self.solved].members.len();
        let mut part = 0.5 * f64::from(u8::from(work.factors.is_some())) + 0.5 * work.solved as f64 / members as f64;
        if work.solved < members {
            self.work = Some(work);
        } else {
            self.solved += 1;
            part = 0.0;
        }
        (self.solved as f64 + part) / self.bins.len() as f64
    }

    fn keep(&mut self, solutions: Solutions) {
        for (component, envelope) in solutions {
            self.field.components[component].envelope = envelope;
            self.ready.push(component);
        }
    }

    /// The components that were solved since the last call, with their indices. They are missing in the field at the
    /// end.
    pub fn take_solved(&mut self) -> Vec<(usize, ComponentField)> {
        let components = &mut self.field.components;
        let take = |index: usize| {
            let envelope = std::mem::take(&mut components[index].envelope);
            (index, ComponentField { envelope, ..components[index].clone() })
        };
        std::mem::take(&mut self.ready).into_iter().map(take).collect()
    }

    /// The solved field.
    pub fn finish(self) -> Field {
        self.field
    }

    /// Envelopes of the components of a band, with their indices.
    fn solve_bin(&self, bin: usize) -> Solutions {
        let mut work = self.begin(bin);
        let mut out = Vec::new();
        while work.solved < self.bins[bin].members.len() {
            out.extend(self.step(bin, &mut work));
        }
        out
    }

    /// Wave number of a band in the open sea.
    fn wave_number(&self, bin: usize) -> f64 {
        LocalWave::new(self.bins[bin].omega_rad_s, self.open_depth_m, self.options.gravity_m_s2).k
    }

    /// Assembles the matrices of a band.
    fn begin(&self, bin: usize) -> BinWork {
        let (omega, k) = (self.bins[bin].omega_rad_s, self.wave_number(bin));
        let matrix = assemble(&self.grid, Water::Coast, omega, k, &self.options);
        let mut profiles: Vec<Profile> =
            [0, self.grid.rows - 1].map(|row| Profile::new(&self.grid, row, omega, &self.options)).into();
        if profiles[0].is_like(&profiles[1]) {
            profiles.truncate(1);
        }
        let side = |profile: Profile| {
            let straight = assemble(&self.grid, Water::Straight(&profile), omega, k, &self.options);
            (profile, difference(&matrix, &straight))
        };
        let sides = profiles.into_iter().map(side).collect();
        let factorisation = Some(Factorisation::new(&self.dissection, matrix));
        BinWork { sides, factorisation, factors: None, solved: 0 }
    }

    /// Goes on with a band: factorises a part of its matrix, or solves some of its components, which it returns.
    fn step(&self, bin: usize, work: &mut BinWork) -> Solutions {
        if let Some(mut factorisation) = work.factorisation.take() {
            if factorisation.step() < 1.0 {
                work.factorisation = Some(factorisation);
            } else {
                work.factors = Some(factorisation.finish());
            }
            return Vec::new();
        }
        let Some(factors) = &work.factors else { return Vec::new() };
        let (omega, k) = (self.bins[bin].omega_rad_s, self.wave_number(bin));
        let members = &self.bins[bin].members[work.solved..];
        let members = &members[..members.len().min(LANES)];
        let waves: Vec<Incident> = members
            .iter()
            .map(|member| Incident { omega_rad_s: omega, ..self.field.components[*member].incident })
            .collect();
        let mut lanes = vec![[0.0; 2 * LANES]; self.grid.columns * self.grid.rows];
        let mut open = Vec::new();
        for (lane, wave) in waves.iter().enumerate() {
            let (field, drive) = self.open_sea(&work.sides, k, k * wave.direction_rad.sin());
            for (x, drive) in lanes.iter_mut().zip(drive) {
                (x[lane], x[LANES + lane]) = (drive.re, drive.im);
            }
            open.push(field);
        }
        factors.solve(&mut lanes);
        let mut out = Vec::new();
        for (lane, (member, wave)) in members.iter().zip(&waves).enumerate() {
            let carrier = Carrier::new(wave, &self.profile_m, self.bathymetry.cell_m, self.options.gravity_m_s2);
            out.push((*member, self.envelope(&open[lane], &lanes, lane, wave, &carrier)));
        }
        work.solved += members.len();
        out
    }

    /// The waves of the open sea of amplitude 1 over straight contours, blended between the two sides of the grid, and
    /// what they drive where the coast differs from that.
    fn open_sea(&self, sides: &Sides, k: f64, ky: f64) -> (Vec<Complex>, Vec<Complex>) {
        let (columns, rows) = (self.grid.columns, self.grid.rows);
        let mut field = vec![Complex::ZERO; columns * rows];
        let mut drive = field.clone();
        for (side, (profile, difference)) in sides.iter().enumerate() {
            let along_x = profile.amplitude(ky, &self.options);
            let leaving = profile.continued(&along_x, ky, k, &self.grid);
            let mut part = vec![Complex::ZERO; columns * rows];
            for j in 0..rows {
                let y = (j as f64 - self.grid.first[1] as f64) * self.grid.cell_m;
                let turn = Complex::polar(1.0, ky * y);
                let [weight, slope, curvature] = if sides.len() == 1 { [1.0, 0.0, 0.0] } else { self.blend(j, side) };
                for i in 0..columns {
                    let wave = along_x[i] * turn;
                    part[j * columns + i] = wave * weight;
                    if (slope != 0.0 || curvature != 0.0) && i < profile.wet {
                        let area = self.grid.cell_m * self.grid.cell_m;
                        let source = Complex::new(curvature, 2.0 * ky * slope) * (profile.c_cg[i] * area);
                        drive[j * columns + i] += source * leaving[i] * turn;
                    }
                }
            }
            drive.iter_mut().zip(difference.times(&part)).for_each(|(drive, d)| *drive -= d);
            field.iter_mut().zip(part).for_each(|(field, part)| *field += part);
        }
        (field, drive)
    }

    /// Weight of the profile of the low (`side` 0) or the high side at row `j`, with its first and second derivative
    /// along y: half a cosine over the middle half of the grid.
    fn blend(&self, j: usize, side: usize) -> [f64; 3] {
        let length = (self.grid.rows - 1 - 2 * self.grid.first[1]) as f64;
        let (start, width) = (self.grid.first[1] as f64 + 0.25 * length, 0.5 * length);
        let at = ((j as f64 - start) / width).clamp(0.0, 1.0);
        let inside = at > 0.0 && at < 1.0;
        let rate = PI / (width * self.grid.cell_m);
        let (sin, cos) = (PI * at).sin_cos();
        let sign = if side == 0 { 1.0 } else { -1.0 };
        let derivatives = if inside { [-0.5 * rate * sin * sign, -0.5 * rate * rate * cos * sign] } else { [0.0; 2] };
        [0.5 + 0.5 * sign * cos, derivatives[0], derivatives[1]]
    }

    /// The envelope of one component: open sea and scattered waves at the points of the coast's grid.
    fn envelope(
        &self,
        open: &[Complex],
        lanes: &[[f64; 2 * LANES]],
        lane: usize,
        wave: &Incident,
        carrier: &Carrier,
    ) -> Vec<[f32; 2]> {
        let goes_shoreward = wave.direction_rad.abs() <= MAX_ANGLE_RAD;
        let amplitude = Complex::polar(if goes_shoreward { wave.amplitude_m } else { 0.0 }, wave.phase_rad);
        let mut out = Vec::with_capacity(self.bathymetry.columns * self.bathymetry.rows);
        let [first_i, first_j] = self.grid.first;
        for j in 0..self.bathymetry.rows {
            let y = j as f64 * self.bathymetry.cell_m;
            for i in 0..self.bathymetry.columns {
                if self.bathymetry.at(i, j) < self.options.min_depth_m {
                    out.push([0.0; 2]);
                    continue;
                }
                let (column, row) = (first_i + i * self.grid.refinement, first_j + j * self.grid.refinement);
                let index = row * self.grid.columns + column;
                let scattered = Complex::new(lanes[index][lane], lanes[index][LANES + lane]);
                let phase = carrier.phase_rad[i] + carrier.ky_rad_m * y;
                let value = (open[index] + scattered) * amplitude * Complex::polar(1.0, -phase);
                out.push([value.re as f32, value.im as f32]);
            }
        }
        out
    }
}

/// Groups components by frequency. The frequency of a group is the mean of its waves, weighted by their energy.
fn bins(incident: &[Incident]) -> Vec<Bin> {
    let mut order: Vec<usize> = (0..incident.len()).collect();
    order.sort_by(|a, b| incident[*a].omega_rad_s.total_cmp(&incident[*b].omega_rad_s));
    let mut out: Vec<Bin> = Vec::new();
    let mut lowest = 0.0;
    for index in order {
        let omega = incident[index].omega_rad_s;
        if out.is_empty() || omega > lowest * BIN_RATIO {
            out.push(Bin { omega_rad_s: 0.0, members: Vec::new() });
            lowest = omega;
        }
        if let Some(bin) = out.last_mut() {
            bin.members.push(index);
        }
    }
    for bin in &mut out {
        let sum = |f: &dyn Fn(&Incident) -> f64| bin.members.iter().map(|m| f(&incident[*m])).sum::<f64>();
        let energy = sum(&|wave| wave.variance_m2() + f64::MIN_POSITIVE);
        bin.omega_rad_s = sum(&|wave| (wave.variance_m2() + f64::MIN_POSITIVE) * wave.omega_rad_s) / energy;
    }
    out
}
