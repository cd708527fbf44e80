//! The solved waves: complex amplitudes of the components of a sea at the points of a coast's grid.

use super::bathymetry::Bathymetry;
use super::complex::Complex;
use super::incident::Incident;
use super::local_wave::LocalWave;

/// The complex amplitudes of the components of a sea at the points of a [`Bathymetry`].
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Number of points along x (shoreward).
    pub columns: usize,
    /// Number of points along y (along the shore).
    pub rows: usize,
    /// Distance between neighbouring points, m.
    pub cell_m: f64,
    /// The solved components, in the order in which they were given.
    pub components: Vec<ComponentField>,
}

/// One component of a sea at the points of a grid. Its elevation is Re[A(x, y) e^(-i omega t)] with the complex
/// amplitude A = envelope times the carrier e^(i (phase(x) + ky y)).
#[derive(Clone, Debug, PartialEq)]
pub struct ComponentField {
    /// The component as it comes from the open sea.
    pub incident: Incident,
    /// The wave that refracts over the mean depth profile, by which the envelope is demodulated.
    pub carrier: Carrier,
    /// Envelope (real and imaginary part, m) of each point in the order of [`Bathymetry::depth_m`]; 0 on land.
    pub envelope: Vec<[f32; 2]>,
}

/// The phase of a plane wave that refracts by Snell's law over straight, parallel depth contours: phase(x) + ky y.
#[derive(Clone, Debug, PartialEq)]
pub struct Carrier {
    /// Wave number along the shore, rad/m, which Snell's law preserves.
    pub ky_rad_m: f64,
    /// Phase at each column, rad; 0 at the first.
    pub phase_rad: Vec<f64>,
    /// Wave number along x at each column, rad/m.
    pub kx_rad_m: Vec<f64>,
}

impl Field {
    /// Complex amplitude (m) of the component with the index `component` at point (i, j): the elevation is the real
    /// part of the amplitude times e^(-i omega t).
    pub fn amplitude(&self, component: usize, i: usize, j: usize) -> Complex {
        let component = &self.components[component];
        let phase = component.carrier.phase_rad[i] + component.carrier.ky_rad_m * j as f64 * self.cell_m;
        self.envelope(component, i, j) * Complex::polar(1.0, phase)
    }

    /// Gradient (d/dx, d/dy) of the complex amplitude (m/m) of a component at point (i, j), by differences of its
    /// envelope with the derivatives of its carrier.
    pub fn amplitude_gradient(&self, component: usize, i: usize, j: usize) -> [Complex; 2] {
        let field = &self.components[component];
        let difference =
            |low: Complex, high: Complex, steps: usize| (high - low) * (1.0 / (steps as f64 * self.cell_m));
        let (i0, i1) = (i.saturating_sub(1), (i + 1).min(self.columns - 1));
        let (j0, j1) = (j.saturating_sub(1), (j + 1).min(self.rows - 1));
        let along_x = difference(self.envelope(field, i0, j), self.envelope(field, i1, j), i1 - i0);
        let along_y = difference(self.envelope(field, i, j0), self.envelope(field, i, j1), j1 - j0);
        let carrier = &field.carrier;
        let here = self.envelope(field, i, j) * Complex::I;
        let turn = Complex::polar(1.0, carrier.phase_rad[i] + carrier.ky_rad_m * j as f64 * self.cell_m);
        [(along_x + here * carrier.kx_rad_m[i]) * turn, (along_y + here * carrier.ky_rad_m) * turn]
    }

    /// Elevation (m) of the sea at point (i, j) and time `t_s` (s): the sum over all components.
    pub fn elevation_m(&self, i: usize, j: usize, t_s: f64) -> f64 {
        let wave = |c: usize| {
            let turn = Complex::polar(1.0, -self.components[c].incident.omega_rad_s * t_s);
            (self.amplitude(c, i, j) * turn).re
        };
        (0..self.components.len()).map(wave).sum()
    }

    fn envelope(&self, component: &ComponentField, i: usize, j: usize) -> Complex {
        let [re, im] = component.envelope[j * self.columns + i];
        Complex::new(f64::from(re), f64::from(im))
    }
}

/// Smallest wave number along x of a carrier as a fraction of the wave number: at a caustic it would be 0.
const MIN_COSINE: f64 = 0.2;

/// Wave number along x (rad/m) of a wave with the wave number `k` and its component `ky` along the shore (rad/m), not
/// below a fifth of `k`.
pub(super) fn wave_number_along_x(k: f64, ky: f64) -> f64 {
    (k * k - ky * ky).max((MIN_COSINE * k).powi(2)).sqrt()
}

/// Depth of each column averaged along the shore, with at least `min_depth_m`.
pub(super) fn mean_profile_m(bathymetry: &Bathymetry, min_depth_m: f64) -> Vec<f64> {
    let mean = |i: usize| {
        (0..bathymetry.rows).map(|j| bathymetry.at(i, j).max(min_depth_m)).sum::<f64>() / bathymetry.rows as f64
    };
    (0..bathymetry.columns).map(mean).collect()
}

impl Carrier {
    /// The carrier of `incident`, whose wave number and direction are those over the first depth of `profile_m`, over
    /// the depths `profile_m` of columns `cell_m` apart.
    pub fn new(incident: &Incident, profile_m: &[f64], cell_m: f64, gravity_m_s2: f64) -> Self {
        let k = |depth_m: f64| LocalWave::new(incident.omega_rad_s, depth_m, gravity_m_s2).k;
        let ky = k(profile_m[0]) * incident.direction_rad.sin();
        let kx = |depth_m: f64| wave_number_along_x(k(depth_m), ky);
        let mut phase = vec![0.0];
        for pair in profile_m.windows(2) {
            phase.push(phase[phase.len() - 1] + cell_m * mean_by_simpson(pair[0], pair[1], kx));
        }
        Self { ky_rad_m: ky, phase_rad: phase, kx_rad_m: profile_m.iter().map(|h| kx(*h)).collect() }
    }
}

/// Mean of `f` between `a` and `b` by Simpson's rule.
pub(super) fn mean_by_simpson(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    (f(a) + 4.0 * f(0.5 * (a + b)) + f(b)) / 6.0
}
