//! Maps of what a sea is like along a coast: significant wave height, direction, period and breaking.

use super::bathymetry::Bathymetry;
use super::field::Field;
use super::local_wave::LocalWave;
use super::losses::Dissipation;

/// Ratio of the edges of the bands of frequency among which the peak of the spectrum is sought.
pub(super) const BAND_RATIO: f64 = 1.06;

/// The sea at the points of a coast's grid, each map in the order of [`Bathymetry::depth_m`]. On land all are 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SeaMaps {
    /// Significant wave height 4 sqrt(m0), m.
    pub hs_m: Vec<f32>,
    /// Direction of the mean energy flux, rad: 0 is straight shoreward (+x), positive angles turn towards +y.
    pub direction_rad: Vec<f32>,
    /// Period of the strongest band of the local spectrum, s.
    pub peak_period_s: Vec<f32>,
    /// Fraction of the waves that break, 0 to 1.
    pub breaking_fraction: Vec<f32>,
}

impl SeaMaps {
    /// Sums the energy of all components of `field`. `dissipation` is that of the same solution.
    pub fn new(bathymetry: &Bathymetry, field: &Field, dissipation: &Dissipation, gravity_m_s2: f64) -> Self {
        let points = field.columns * field.rows;
        let omegas = || field.components.iter().map(|c| c.incident.omega_rad_s);
        let lowest = omegas().fold(f64::INFINITY, f64::min);
        let band_of = |omega: f64| ((omega / lowest).ln() / BAND_RATIO.ln()) as usize;
        let bands = omegas().map(band_of).max().map_or(0, |band| band + 1);
        let mut out = Self {
            hs_m: vec![0.0; points],
            direction_rad: vec![0.0; points],
            peak_period_s: vec![0.0; points],
            breaking_fraction: dissipation.breaking_fraction.clone(),
        };
        // Variance, and variance times frequency, of each band.
        let mut spectrum = vec![[0.0; 2]; bands];
        for point in 0..points {
            let (i, j) = (point % field.columns, point / field.columns);
            let depth_m = bathymetry.at(i, j);
            if depth_m <= 0.0 {
                continue;
            }
            spectrum.fill([0.0; 2]);
            let mut flux = [0.0; 2];
            for (c, component) in field.components.iter().enumerate() {
                let omega = component.incident.omega_rad_s;
                let amplitude = field.amplitude(c, i, j);
                let variance = 0.5 * amplitude.norm_squared();
                if variance > 0.0 {
                    let band = &mut spectrum[band_of(omega)];
                    *band = [band[0] + variance, band[1] + variance * omega];
                    // The flux of the energy is C Cg / omega Im(A* grad A) / 2.
                    let weight = LocalWave::new(omega, depth_m, gravity_m_s2).c_cg / omega;
                    let gradient = field.amplitude_gradient(c, i, j);
                    for axis in 0..2 {
                        flux[axis] += weight * (amplitude.conj() * gradient[axis]).im;
                    }
                }
            }
            let m0: f64 = spectrum.iter().map(|band| band[0]).sum();
            if m0 > 0.0 {
                let peak = spectrum.iter().copied().reduce(|a, b| if b[0] > a[0] { b } else { a }).unwrap_or_default();
                out.hs_m[point] = (4.0 * m0.sqrt()) as f32;
                out.direction_rad[point] = flux[1].atan2(flux[0]) as f32;
                out.peak_period_s[point] = (std::f64::consts::TAU * peak[0] / peak[1]) as f32;
            }
        }
        out
    }
}

/// Bearing, degrees clockwise from north, that waves come from which travel in the direction `direction_rad` (rad) of the
/// frame of a coast whose land lies towards the bearing `toward_deg`.
pub fn bearing_from_deg(toward_deg: f64, direction_rad: f64) -> f64 {
    (toward_deg + direction_rad.to_degrees() + 180.0).rem_euclid(360.0)
}

/// The value that all but the largest half per cent of the positive values do not exceed, so that a few points beside a
/// wall do not count.
pub fn usual_largest(values: &[f32]) -> f64 {
    let mut sizes: Vec<f32> = values.iter().copied().filter(|value| *value > 0.0).collect();
    sizes.sort_by(f32::total_cmp);
    sizes.get((sizes.len() * 199 / 200).min(sizes.len().saturating_sub(1))).copied().map_or(0.0, f64::from)
}
