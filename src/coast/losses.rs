//! The energy that the components of a sea lose together while they are marched shoreward.

use super::bathymetry::Bathymetry;
use super::local_wave::LocalWave;
use super::options::Options;

/// Steps in which the loss between two columns is integrated.
const STEPS: usize = 8;

/// Variance of the elevation, its flux shoreward and the mean frequency at each row of a column.
#[derive(Clone, Debug, Default)]
pub(super) struct ColumnEnergy {
    /// Variance, m^2.
    variance_m2: Vec<f64>,
    /// Flux of the variance along x, m^3/s.
    flux_m3_s: Vec<f64>,
    /// Variance times angular frequency, m^2 rad/s.
    first_moment: Vec<f64>,
}

/// Breaking at the points of a grid, in the order of [`Bathymetry::depth_m`], and the marched sea that breaks.
#[derive(Clone, Debug, PartialEq)]
pub struct Dissipation {
    /// Fraction of the waves that break, 0 to 1.
    pub breaking_fraction: Vec<f32>,
    /// Rate at which breaking takes the energy of each component, 1/s.
    pub rate_per_s: Vec<f32>,
    /// Factor of breaking on the amplitudes on their way from the column before.
    pub amplitude_factor: Vec<f32>,
    /// Variance of the elevation of all components, m^2.
    pub variance_m2: Vec<f32>,
    /// Flux of that variance along x, m^3/s.
    pub shoreward_flux_m3_s: Vec<f32>,
    /// Mean angular frequency, weighted by variance, rad/s; 0 without waves.
    pub mean_omega_rad_s: Vec<f32>,
}

impl Dissipation {
    /// No breaking anywhere.
    pub fn none(bathymetry: &Bathymetry) -> Self {
        let zeros = vec![0.0; bathymetry.columns * bathymetry.rows];
        Self {
            breaking_fraction: zeros.clone(),
            rate_per_s: zeros.clone(),
            amplitude_factor: vec![1.0; zeros.len()],
            variance_m2: zeros.clone(),
            shoreward_flux_m3_s: zeros.clone(),
            mean_omega_rad_s: zeros,
        }
    }

    /// Stores the sea `energy` at the rows of `column` with the depths `depth_m`, and how it breaks. `factors` are
    /// those of breaking on the amplitudes since the column before.
    pub(super) fn record(
        &mut self,
        column: usize,
        energy: &ColumnEnergy,
        factors: &[f64],
        depth_m: &[f64],
        options: &Options,
    ) {
        let columns = self.rate_per_s.len() / depth_m.len();
        for (j, depth_m) in depth_m.iter().enumerate() {
            let (m0, point) = (energy.variance_m2[j], j * columns + column);
            self.amplitude_factor[point] = factors[j] as f32;
            if m0 <= 0.0 || *depth_m < options.min_depth_m {
                continue;
            }
            let omega = energy.first_moment[j] / m0;
            let k = LocalWave::new(omega, *depth_m, options.gravity_m_s2).k;
            let (fraction, loss) = options.losses.breaking(m0, omega, k, *depth_m);
            self.breaking_fraction[point] = fraction as f32;
            self.rate_per_s[point] = (loss / m0) as f32;
            self.variance_m2[point] = m0 as f32;
            self.shoreward_flux_m3_s[point] = energy.flux_m3_s[j] as f32;
            self.mean_omega_rad_s[point] = omega as f32;
        }
    }

    /// Factors of breaking on the amplitudes at the rows of `column` since the column before.
    pub(super) fn factors_at(&self, column: usize, columns: usize) -> Vec<f64> {
        self.amplitude_factor.iter().skip(column).step_by(columns).map(|factor| f64::from(*factor)).collect()
    }
}

impl ColumnEnergy {
    pub(super) fn zeros(rows: usize) -> Self {
        Self { variance_m2: vec![0.0; rows], flux_m3_s: vec![0.0; rows], first_moment: vec![0.0; rows] }
    }

    /// Adds a component at row `j` with its variance (m^2), its group velocity along x (m/s) and its frequency (rad/s).
    pub(super) fn add(&mut self, j: usize, variance_m2: f64, velocity_m_s: f64, omega_rad_s: f64) {
        self.variance_m2[j] += variance_m2;
        self.flux_m3_s[j] += variance_m2 * velocity_m_s;
        self.first_moment[j] += variance_m2 * omega_rad_s;
    }
}

/// Lets the sea that arrived at a column lose the energy that breaks on the way from the column before, with the
/// depths `depths_m` of both and the distance `cell_m`. Returns the factor on the amplitudes at each row.
///
/// Along the way the flux changes as d ln(flux)/dx = -loss / flux, beside its change without breaking. The local sea
/// follows from the flux and the mean group velocity along x.
pub(super) fn lose_energy(
    before: &ColumnEnergy,
    arrived: &mut ColumnEnergy,
    depths_m: [&[f64]; 2],
    cell_m: f64,
    options: &Options,
) -> Vec<f64> {
    let rows = arrived.variance_m2.len();
    let mut gains = vec![1.0; rows];
    if options.losses.breaker_ratio <= 0.0 {
        return gains;
    }
    for j in 0..rows {
        let (m0, flux) = (arrived.variance_m2[j], arrived.flux_m3_s[j]);
        if m0 <= 0.0 || flux <= 0.0 {
            continue;
        }
        let omega = arrived.first_moment[j] / m0;
        let end = flux / m0;
        let has_before = before.flux_m3_s[j] > 0.0;
        let start = if has_before { before.flux_m3_s[j] / before.variance_m2[j] } else { end };
        let start_flux = if has_before { before.flux_m3_s[j] } else { flux };
        let loss_per_m = |part: f64, log_gain: f64| {
            let unbroken = start_flux + part * (flux - start_flux);
            let here = unbroken * log_gain.exp();
            let m0 = here / (start + part * (end - start));
            let depth_m = (depths_m[0][j] + part * (depths_m[1][j] - depths_m[0][j])).max(options.min_depth_m);
            let k = LocalWave::new(omega, depth_m, options.gravity_m_s2).k;
            options.losses.breaking(m0, omega, k, depth_m).1 / here
        };
        let mut log_gain = 0.0;
        let step_m = cell_m / STEPS as f64;
        for step in 0..STEPS {
            let part = step as f64 / STEPS as f64;
            let half = log_gain - 0.5 * step_m * loss_per_m(part, log_gain);
            log_gain -= step_m * loss_per_m(part + 0.5 / STEPS as f64, half);
        }
        let gain = log_gain.exp();
        gains[j] = gain.sqrt();
        arrived.variance_m2[j] *= gain;
        arrived.flux_m3_s[j] *= gain;
        arrived.first_moment[j] *= gain;
    }
    gains
}
