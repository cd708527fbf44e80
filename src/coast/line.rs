//! One component of a sea on a line along the shore, which the parabolic solver moves shoreward.

use super::bathymetry::Bathymetry;
use super::complex::Complex;
use super::field::{Carrier, ComponentField, mean_by_simpson, wave_number_along_x};
use super::local_wave::LocalWave;
use super::losses::ColumnEnergy;
use super::options::Options;
use super::parabolic::{MAX_ANGLE_RAD, solve_tridiagonal};

/// Cells that are added beyond each side of the grid, in which scattered waves fade.
pub(super) const PAD_CELLS: usize = 20;
/// Attenuation (nepers) that the added cells give a wave that crosses them at 45 degrees.
const PAD_ATTENUATION: f64 = 4.0;
/// Largest number of fine cells of a line in a cell of the grid.
pub(super) const MAX_REFINEMENT: usize = 4;
/// Imaginary part of the coefficient 1/4 of the rational approximation. It damps waves that could not exist (evanescent
/// waves, for which the approximation has a pole) and leaves those that can nearly as they are.
const EVANESCENT_DAMPING: f64 = 0.004;

/// Depths (m) on a line along the shore with fine cells, padded at both sides with the depth of the edge.
pub(super) struct DepthLine {
    depth_m: Vec<f64>,
}

impl DepthLine {
    /// The depths at the column `at` (a fraction lies between columns), with `refinement` fine cells in each cell.
    pub(super) fn new(bathymetry: &Bathymetry, at: f64, refinement: usize) -> Self {
        let i = (at as usize).min(bathymetry.columns - 2);
        let fraction = at - i as f64;
        let on_row = |j: usize| {
            let (a, b) = (bathymetry.at(i, j), bathymetry.at(i + 1, j));
            a + fraction * (b - a)
        };
        let coarse: Vec<f64> = (0..bathymetry.rows).map(on_row).collect();
        let (pad, fine_rows) = (PAD_CELLS * refinement, (bathymetry.rows - 1) * refinement + 1);
        let depth = |fine: usize| {
            let inside = fine.saturating_sub(pad).min(fine_rows - 1);
            let (j, part) = (inside / refinement, inside % refinement);
            let next = coarse[(j + 1).min(bathymetry.rows - 1)];
            coarse[j] + part as f64 / refinement as f64 * (next - coarse[j])
        };
        Self { depth_m: (0..fine_rows + 2 * pad).map(depth).collect() }
    }

    /// The lines at `column`, after it at the ends and middles of the fine steps, and at the next column.
    pub(super) fn between_columns(bathymetry: &Bathymetry, column: usize, refinement: usize) -> Vec<Self> {
        let parts = 2 * refinement;
        (0..=parts).map(|part| Self::new(bathymetry, column as f64 + part as f64 / parts as f64, refinement)).collect()
    }
}

/// The envelope of one component on a line. It is stored as the square root of the energy flux, with the phase of the
/// carrier removed.
pub(super) struct Marcher {
    /// Number of fine cells in a cell of the grid.
    pub(super) refinement: usize,
    omega_rad_s: f64,
    ky: f64,
    /// Amplitude of the wave in the open sea, m, as a complex number.
    amplitude: Complex,
    rows: usize,
    /// Length of a fine cell, m.
    fine_m: f64,
    /// sqrt(C Cg kx) times the amplitude at each point of the line.
    flux_root: Vec<Complex>,
    /// The values that the wave would have over contours straight as at the low and the high side.
    sides: [Complex; 2],
    /// At each point: the local wave, and its wave number along x.
    local: Vec<(LocalWave, f64)>,
}

impl Marcher {
    pub(super) fn new(component: &ComponentField, depth_m: f64, bathymetry: &Bathymetry, options: &Options) -> Self {
        let incident = &component.incident;
        let wave = LocalWave::new(incident.omega_rad_s, depth_m, options.gravity_m_s2);
        let wanted = (wave.k * bathymetry.cell_m / options.max_phase_per_cell_rad).ceil() as usize;
        let refinement = wanted.clamp(1, MAX_REFINEMENT);
        let goes_shoreward = incident.direction_rad.abs() <= MAX_ANGLE_RAD;
        let amplitude = if goes_shoreward { incident.amplitude_m } else { 0.0 };
        Self {
            refinement,
            omega_rad_s: incident.omega_rad_s,
            ky: component.carrier.ky_rad_m,
            amplitude: Complex::polar(amplitude, incident.phase_rad),
            rows: bathymetry.rows,
            fine_m: bathymetry.cell_m / refinement as f64,
            flux_root: Vec::new(),
            sides: [Complex::ZERO; 2],
            local: Vec::new(),
        }
    }

    /// Gives the line the wave of the open sea; `line` holds the depths of the first column.
    pub(super) fn start(&mut self, line: &DepthLine, options: &Options) {
        self.local = line.depth_m.iter().map(|h| self.local_wave(*h, options)).collect();
        let at = |(depth_m, (wave, kx)): (&f64, &(LocalWave, f64))| {
            if *depth_m < options.min_depth_m { Complex::ZERO } else { self.amplitude * (wave.c_cg * kx).sqrt() }
        };
        self.flux_root = line.depth_m.iter().zip(&self.local).map(at).collect();
        self.sides = [self.flux_root[0], self.flux_root[self.flux_root.len() - 1]];
    }

    fn local_wave(&self, depth_m: f64, options: &Options) -> (LocalWave, f64) {
        let wave = LocalWave::new(self.omega_rad_s, depth_m.max(options.min_depth_m), options.gravity_m_s2);
        (wave, wave_number_along_x(wave.k, self.ky))
    }

    /// Moves the line by one cell of the grid. `lines` holds the depths at the ends and middles of the fine steps,
    /// `profile_m` the mean depths of the two columns, over which the carrier refracts.
    pub(super) fn march(&mut self, lines: &[DepthLine], profile_m: [f64; 2], options: &Options) {
        if self.amplitude == Complex::ZERO {
            return;
        }
        let carrier_kx = mean_by_simpson(profile_m[0], profile_m[1], |h| self.local_wave(h, options).1);
        for step in 0..self.refinement {
            let [middle, end] = [1, 2].map(|part| &lines[2 * step + part]);
            self.fine_step(middle, end, carrier_kx, options);
        }
    }

    /// Moves the line by one fine cell: half of the phase relative to the carrier, diffraction, the other half.
    fn fine_step(&mut self, middle: &DepthLine, end: &DepthLine, carrier_kx: f64, options: &Options) {
        let step_m = self.fine_m;
        let count = self.flux_root.len();
        let mut halves = Vec::with_capacity(count);
        let mut middle_kx = Vec::with_capacity(count);
        for index in 0..count {
            let (h, h_end) = (middle.depth_m[index], end.depth_m[index]);
            if index > 0 && h == middle.depth_m[index - 1] && h_end == end.depth_m[index - 1] {
                halves.push(halves[index - 1]);
                middle_kx.push(middle_kx[index - 1]);
                self.local[index] = self.local[index - 1];
                continue;
            }
            let (wave, kx) = self.local_wave(h, options);
            let (end_wave, end_kx) = self.local_wave(h_end, options);
            let mean_kx = (self.local[index].1 + 4.0 * kx + end_kx) / 6.0;
            let depth_m = h.max(options.min_depth_m);
            let friction = options.losses.friction_rate_per_s(self.omega_rad_s, wave.k, depth_m, options.gravity_m_s2);
            let attenuation = 0.5 * friction * wave.k / (wave.group_velocity_m_s * kx);
            let half = Complex::polar((-0.5 * step_m * attenuation).exp(), 0.5 * step_m * (mean_kx - carrier_kx));
            halves.push(if h_end < options.min_depth_m { Complex::ZERO } else { half });
            middle_kx.push(kx);
            self.local[index] = (end_wave, end_kx);
        }
        for (value, half) in self.flux_root.iter_mut().zip(&halves) {
            *value *= *half;
        }
        self.diffract(&middle_kx, step_m);
        for (value, half) in self.flux_root.iter_mut().zip(&halves) {
            *value *= *half;
        }
        for (side, half) in self.sides.iter_mut().zip([halves[0], halves[count - 1]]) {
            *side *= half * half;
        }
        self.fade_in_pads(step_m);
    }

    /// One Crank-Nicolson step of (1 + Y / 4) du/dx = i kx Y / 2 u, the rational approximation of
    /// du/dx = i kx (sqrt(1 + Y) - 1) u, with Y = (d2/dy2 + 2 i ky d/dy) / kx^2 at the wave numbers `kx` of the line.
    fn diffract(&mut self, kx: &[f64], step_m: f64) {
        let count = kx.len();
        let (second, first) = (1.0 / (self.fine_m * self.fine_m), self.ky / self.fine_m);
        // The operator d2/dy2 + 2 i ky d/dy is Hermitian: entries below and above the diagonal are conjugates.
        let (lower, upper) = (Complex::new(second, -first), Complex::new(second, first));
        let quarter = Complex::new(0.25, -EVANESCENT_DAMPING);
        let inverse: Vec<f64> = kx.iter().map(|k| 1.0 / k).collect();
        let (mut below, mut above) = (vec![Complex::ZERO; count], vec![Complex::ZERO; count]);
        let mut diagonal = vec![Complex::ZERO; count];
        let mut right = vec![Complex::ZERO; count];
        for j in 0..count {
            // Weights of Y on both sides of the step, 1 + Y (quarter -+ i step kx / 4), made symmetric between
            // neighbours.
            let weights = |a: usize, b: usize| {
                let symmetric = inverse[a] * inverse[b];
                let rotation = 0.25 * step_m * symmetric.sqrt();
                let base = quarter * symmetric;
                (base - Complex::new(0.0, rotation), base + Complex::new(0.0, rotation))
            };
            let (minus, plus) = weights(j, j);
            // A point beyond each end has the value of the end.
            let mut centre = Complex::new(-2.0 * second, 0.0);
            if j == 0 {
                centre += lower;
            }
            if j + 1 == count {
                centre += upper;
            }
            diagonal[j] = Complex::ONE + minus * centre;
            right[j] = (Complex::ONE + plus * centre) * self.flux_root[j];
            if j > 0 {
                let (minus, plus) = weights(j - 1, j);
                below[j] = minus * lower;
                right[j] += plus * lower * self.flux_root[j - 1];
            }
            if j + 1 < count {
                let (minus, plus) = weights(j, j + 1);
                above[j] = minus * upper;
                right[j] += plus * upper * self.flux_root[j + 1];
            }
        }
        solve_tridiagonal(&below, &mut diagonal, &above, &mut right);
        self.flux_root = right;
    }

    /// Draws the values beyond the sides of the grid towards those of the plane wave there.
    fn fade_in_pads(&mut self, step_m: f64) {
        let pad = PAD_CELLS * self.refinement;
        let last = self.flux_root.len() - 1;
        let width_m = pad as f64 * self.fine_m;
        for index in 0..pad {
            let depth_in_pad = 1.0 - index as f64 / pad as f64;
            // The rate's integral over the width, 3 x attenuation / 3, is the attenuation at 45 degrees.
            let rate = 3.0 * PAD_ATTENUATION / width_m * depth_in_pad * depth_in_pad;
            let kept = (-rate * step_m).exp();
            for (at, side) in [index, last - index].into_iter().zip(self.sides) {
                self.flux_root[at] = side + (self.flux_root[at] - side) * kept;
            }
        }
    }

    /// Multiplies the amplitudes at the rows of the grid by `gains`.
    pub(super) fn scale(&mut self, gains: &[f64]) {
        let pad = PAD_CELLS * self.refinement;
        let fine_rows = (self.rows - 1) * self.refinement + 1;
        let rows = self.rows;
        for (index, value) in self.flux_root.iter_mut().enumerate() {
            let inside = index.saturating_sub(pad).min(fine_rows - 1);
            let (j, part) = (inside / self.refinement, inside % self.refinement);
            let fraction = part as f64 / self.refinement as f64;
            *value *= gains[j] + fraction * (gains[(j + 1).min(rows - 1)] - gains[j]);
        }
        self.sides[0] *= gains[0];
        self.sides[1] *= gains[rows - 1];
    }

    /// Envelope (m) at row `j` of the grid.
    pub(super) fn envelope(&self, j: usize) -> Complex {
        if self.amplitude == Complex::ZERO {
            return Complex::ZERO;
        }
        let index = (PAD_CELLS + j) * self.refinement;
        let (wave, kx) = &self.local[index];
        self.flux_root[index] * (1.0 / (wave.c_cg * kx).sqrt())
    }

    /// Adds variance, flux and frequency of this component at each row to `sum`.
    pub(super) fn add_energy(&self, sum: &mut ColumnEnergy) {
        if self.amplitude == Complex::ZERO {
            return;
        }
        for j in 0..self.rows {
            let variance = 0.5 * self.envelope(j).norm_squared();
            let (wave, kx) = &self.local[(PAD_CELLS + j) * self.refinement];
            sum.add(j, variance, wave.group_velocity_m_s * kx / wave.k, self.omega_rad_s);
        }
    }
}

impl Carrier {
    /// Phase (rad) of the carrier at column i and the distance `y_m` along the shore.
    pub fn phase_at(&self, i: usize, y_m: f64) -> f64 {
        self.phase_rad[i] + self.ky_rad_m * y_m
    }
}
