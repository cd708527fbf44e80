//! The waves of the open sea over straight contours: the solution beside the grid, which the borders absorb nothing of.

use super::grid::Grid;
use crate::coast::complex::Complex;
use crate::coast::local_wave::LocalWave;
use crate::coast::options::Options;

/// Layers of constant depth in a cell.
const LAYERS: usize = 4;

/// The depth profile along one side of the grid, for waves of one frequency.
pub(super) struct Profile {
    omega_rad_s: f64,
    cell_m: f64,
    /// Depth, m, and losses by breaking, 1/s, at each column.
    pub(super) depth_m: Vec<f64>,
    pub(super) loss_per_s: Vec<f64>,
    /// Number of columns from the first that are wet without a gap.
    pub(super) wet: usize,
    /// Reflection coefficient of the shore behind them; `None` if the sea goes on.
    pub(super) reflection: Option<f64>,
    /// C Cg at each column, m^2/s^2.
    pub(super) c_cg: Vec<f64>,
    /// C Cg, k^2 C Cg and the losses at each layer.
    layers: Vec<[f64; 3]>,
    first_column: usize,
}

impl Profile {
    /// The profile along the row `row` of `grid`.
    pub(super) fn new(grid: &Grid, row: usize, omega_rad_s: f64, options: &Options) -> Self {
        let range = row * grid.columns..(row + 1) * grid.columns;
        let depth_m = grid.depth_m[range.clone()].to_vec();
        let loss_per_s = grid.loss_per_s[range.clone()].to_vec();
        let wet = grid.is_wet[range.clone()].iter().take_while(|wet| **wet).count();
        let shore = if wet < grid.columns { grid.reflection[range][wet] } else { 0.0 };
        let mut layers = Vec::new();
        for i in 0..wet - 1 {
            for part in 0..LAYERS {
                let fraction = (part as f64 + 0.5) / LAYERS as f64;
                let mix = |values: &[f64]| values[i] + fraction * (values[i + 1] - values[i]);
                layers.push(coefficients(omega_rad_s, mix(&depth_m), mix(&loss_per_s), options));
            }
        }
        let reflection = (wet < grid.columns || !grid.is_open_behind).then_some(shore);
        let first_column = grid.first[0];
        let c_cg = depth_m.iter().map(|h| coefficients(omega_rad_s, *h, 0.0, options)[0]).collect();
        Self { omega_rad_s, cell_m: grid.cell_m, depth_m, loss_per_s, wet, reflection, c_cg, layers, first_column }
    }

    /// Whether the waves along two profiles are the same.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        (self.wet, self.reflection, &self.depth_m) == (other.wet, other.reflection, &other.depth_m)
            && self.loss_per_s == other.loss_per_s
    }

    /// Amplitude at each column of a wave with the wave number `ky` (rad/m) along the shore that comes from the open
    /// sea with the amplitude 1 and the phase 0 at the coast's first column; 0 behind the shore.
    ///
    /// It is exact for layers of constant depth: in each, the wave is a sum of two exponentials. They are passed from
    /// the shore to the sea, in which direction a decaying wave grows.
    pub(super) fn amplitude(&self, ky: f64, options: &Options) -> Vec<Complex> {
        let mut out = vec![Complex::ZERO; self.depth_m.len()];
        let last = self.wet - 1;
        let [p, q, _] = coefficients(self.omega_rad_s, self.depth_m[last], 0.0, options);
        // The flux p dF/dx over F at the end: a radiating wave, or the partly absorbing edge, half a cell on.
        let mut value = Complex::ONE;
        let mut flux = match self.reflection {
            None => Complex::new(q / p - ky * ky, 0.0).sqrt() * Complex::I * p,
            Some(r) => Complex::I * (p * (q / p).sqrt() * (1.0 - r) / (1.0 + r)),
        };
        if self.reflection.is_some() {
            let here = coefficients(self.omega_rad_s, self.depth_m[last], self.loss_per_s[last], options);
            (value, flux) = self.step_back(here, ky, 0.5 * self.cell_m, value, flux);
        }
        out[last] = value;
        for i in (0..last).rev() {
            for layer in self.layers[i * LAYERS..(i + 1) * LAYERS].iter().rev() {
                (value, flux) = self.step_back(*layer, ky, self.cell_m / LAYERS as f64, value, flux);
            }
            out[i] = value;
        }
        let [p, q, _] = self.layers[0];
        let kx = (q / p - ky * ky).max(1e-12).sqrt();
        let arriving = (value + flux * Complex::new(0.0, -1.0 / (kx * p))) * 0.5;
        let wanted = Complex::polar(1.0, -kx * self.first_column as f64 * self.cell_m);
        let scale = wanted * arriving.recip();
        out.iter_mut().for_each(|value| *value *= scale);
        out
    }

    /// The part of `amplitude` (of [`Self::amplitude`]) that leaves the grid, in the absorbing borders at the open sea
    /// and behind: it decays there as the stretched coordinates say, and is multiplied by their derivative. Elsewhere
    /// it is the whole.
    pub(super) fn continued(&self, amplitude: &[Complex], ky: f64, k_open: f64, grid: &Grid) -> Vec<Complex> {
        let mut out = amplitude.to_vec();
        let row = 0.5 * (grid.rows - 1) as f64;
        let [p, q, _] = self.layers[0];
        let kx = (q / p - ky * ky).max(1e-12).sqrt();
        let stretched = |i: usize, kx: f64| {
            let sigma = grid.stretch(i as f64, row, k_open * self.cell_m)[0];
            let inwards = (i as f64).min((grid.columns - 1 - i) as f64);
            // The integral of sigma, which grows with the square of the distance into the border.
            let integral = sigma * self.cell_m * (grid.border as f64 - inwards).max(0.0) / 3.0;
            Complex::new(1.0, sigma) * (-kx * integral).exp()
        };
        for (i, value) in out.iter_mut().enumerate().take(grid.border) {
            let arriving = Complex::polar(1.0, kx * (i as f64 - self.first_column as f64) * self.cell_m);
            *value = (*value - arriving) * stretched(i, kx);
        }
        if let (true, Some([p, q, _])) = (grid.is_open_behind && self.wet == grid.columns, self.layers.last()) {
            let kx = (q / p - ky * ky).max(0.0).sqrt();
            for i in grid.columns - grid.border..grid.columns {
                out[i] *= stretched(i, kx);
            }
        }
        out
    }

    /// Value and flux at the seaward side of a layer `length_m` wide from those at its shoreward side.
    fn step_back(
        &self,
        [p, q, loss]: [f64; 3],
        ky: f64,
        length_m: f64,
        value: Complex,
        flux: Complex,
    ) -> (Complex, Complex) {
        let kx = (Complex::new(q - p * ky * ky, self.omega_rad_s * loss) * (1.0 / p)).sqrt();
        let phase = kx * length_m;
        // e^(i phase) with its complex argument.
        let forward = Complex::polar((-phase.im).exp(), phase.re);
        let back = Complex::polar(phase.im.exp(), -phase.re);
        let cos = (forward + back) * 0.5;
        let sin = (forward - back) * Complex::new(0.0, -0.5);
        let impedance = kx * p;
        let sin_over =
            if impedance.norm_squared() > 0.0 { sin * impedance.recip() } else { Complex::new(length_m / p, 0.0) };
        (value * cos - flux * sin_over, flux * cos + value * sin * impedance)
    }
}

/// C Cg, k^2 C Cg and the loss rate of friction and breaking, for waves in water of `depth_m` in which breaking takes
/// `breaking_per_s`.
pub(super) fn coefficients(omega_rad_s: f64, depth_m: f64, breaking_per_s: f64, options: &Options) -> [f64; 3] {
    let wave = LocalWave::new(omega_rad_s, depth_m, options.gravity_m_s2);
    let friction = options.losses.friction_rate_per_s(omega_rad_s, wave.k, depth_m, options.gravity_m_s2);
    [wave.c_cg, wave.k * wave.k * wave.c_cg, friction + breaking_per_s]
}
