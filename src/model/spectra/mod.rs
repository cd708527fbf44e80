//! Frequency spectra S(omega): one-sided variance density of elevation, m^2 s, integral over omega = m0.
//!
//! [`FrequencySpectrum`] is what the program uses; the families stand in their own files. Each takes its height and
//! period from the wind unless the system gives them.

mod double;
mod tails;
mod wind;

use super::dispersion::Dispersion;
use super::measured::Measured;
use super::params::{Sea, SpectrumKind, System};
use super::quadrature::adaptive;
use double::{OchiHubble, Torsethaugen};
use std::f64::consts::TAU;
use std::sync::Arc;
pub use tails::elfouhaily_delta;
use tails::{Elfouhaily, Karaev};
use wind::{Ab, Donelan, Jonswap, Marnero, Phillips, Tessendorf};

/// Below this wind there are no waves, m/s.
const CALM_M_S: f64 = 0.05;

/// A variance below this cannot be raised to a given height, m^2.
const LEAST_M2: f64 = 1e-12;
/// Shortest peak period that can be asked for, s: waves of 14 cm.
const SHORTEST_S: f64 = 0.3;

/// A frequency spectrum with its coefficients worked out.
#[derive(Clone, Debug, PartialEq)]
pub struct FrequencySpectrum {
    shape: Shape,
    /// Where S is largest, rad/s; the higher peak of a double one.
    pub omega_p: f64,
    /// What the user should know of it.
    pub notice: Option<String>,
    factor: f64,
    fade_m: f64,
    dispersion: Dispersion,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Calm,
    Phillips(Phillips),
    Tessendorf(Tessendorf),
    Ab(Ab),
    Jonswap(Jonswap),
    Marnero(Marnero),
    Karaev(Karaev),
    Elfouhaily(Elfouhaily),
    Donelan(Donelan),
    OchiHubble(OchiHubble),
    Torsethaugen(Torsethaugen),
    Measured(Arc<Measured>),
}

/// What a family is made from.
struct Source<'a> {
    sea: &'a Sea,
    system: &'a System,
    /// Wind, m/s, never 0.
    wind_m_s: f64,
    /// Peak frequency that was asked for, rad/s.
    omega_p: Option<f64>,
}

impl Source<'_> {
    fn gravity(&self) -> f64 {
        self.sea.gravity_m_s2
    }

    /// Dimensionless fetch g F / U^2.
    fn fetch(&self) -> f64 {
        1000.0 * self.system.fetch_km * self.gravity() / (self.wind_m_s * self.wind_m_s)
    }

    /// Height and peak frequency of the sea that the wind would raise by JONSWAP's growth curves, unless they are given.
    fn height_and_peak(&self) -> (f64, f64) {
        let grown = Jonswap::grown(self);
        let omega_p = self.omega_p.unwrap_or(grown.omega_p);
        let hs_m = if self.system.hs_m > 0.0 {
            self.system.hs_m
        } else {
            let (low, high) = (0.3 * grown.omega_p, 400.0 * grown.omega_p);
            let knots = [low, grown.omega_p, 1.5 * grown.omega_p, 5.0 * grown.omega_p, high];
            4.0 * adaptive(|w| grown.density(w), &knots, 1e-9).sqrt()
        };
        (hs_m, omega_p)
    }
}

impl FrequencySpectrum {
    /// The spectrum of one system of a sea. Without wind, and without a height and a period of its own, it is 0.
    pub fn new(sea: &Sea, system: &System) -> Self {
        let dispersion = Dispersion::new(sea);
        let has_own_size = system.hs_m > 0.0 && system.tp_s > 0.0;
        let source = Source {
            sea,
            system,
            wind_m_s: system.wind_m_s.max(CALM_M_S),
            omega_p: (system.tp_s > 0.0).then(|| TAU / system.tp_s.max(SHORTEST_S)),
        };
        let (kind, notice) = match (system.spectrum, &sea.measured) {
            (SpectrumKind::Measured, None) => (
                SpectrumKind::Jonswap,
                Some("spectrum=measured needs a buoy's file: jonswap is shown until one is given".to_owned()),
            ),
            (kind, _) => (kind, None),
        };
        let is_calm =
            system.scale == 0.0 || system.wind_m_s < CALM_M_S && !has_own_size && kind != SpectrumKind::Measured;
        let shape = match kind {
            _ if is_calm => Shape::Calm,
            SpectrumKind::Phillips => Shape::Phillips(Phillips::new(&source)),
            SpectrumKind::Tessendorf => Shape::Tessendorf(Tessendorf::new(&source)),
            SpectrumKind::GeneralisedAb => Shape::Ab(Ab::generalised(&source)),
            SpectrumKind::PiersonMoskowitz => Shape::Ab(Ab::pierson_moskowitz(&source)),
            SpectrumKind::Jonswap => Shape::Jonswap(Jonswap::new(&source)),
            SpectrumKind::Tma => Shape::Jonswap(Jonswap::tma(&source)),
            SpectrumKind::Marnero => Shape::Marnero(Marnero::new(&source)),
            SpectrumKind::Karaev => Shape::Karaev(Karaev::new(&source)),
            SpectrumKind::Elfouhaily => Shape::Elfouhaily(Elfouhaily::new(&source)),
            SpectrumKind::Donelan => Shape::Donelan(Donelan::new(&source)),
            SpectrumKind::OchiHubble => Shape::OchiHubble(OchiHubble::new(&source)),
            SpectrumKind::Torsethaugen => Shape::Torsethaugen(Torsethaugen::new(&source)),
            SpectrumKind::Measured => sea.measured.clone().map_or(Shape::Calm, Shape::Measured),
        };
        let omega_p = match &shape {
            Shape::Calm => 1.0,
            Shape::Phillips(s) => s.omega_p,
            Shape::Tessendorf(s) => dispersion.omega(s.k_p()),
            Shape::Ab(s) => s.omega_p(),
            Shape::Jonswap(s) => s.omega_p,
            Shape::Marnero(s) => s.omega_p(),
            Shape::Karaev(s) => s.jonswap.omega_p,
            Shape::Elfouhaily(s) => dispersion.omega(s.k_p),
            Shape::Donelan(s) => s.omega_p,
            Shape::OchiHubble(s) => s.omega_p(),
            Shape::Torsethaugen(s) => s.omega_p(),
            Shape::Measured(s) => s.omega_p(),
        };
        let notice = notice.or_else(|| match &shape {
            Shape::Karaev(s) => s.notice.clone(),
            _ => None,
        });
        let mut spectrum = Self { shape, omega_p, notice, factor: 1.0, fade_m: system.fade_m, dispersion };
        if system.hs_m > 0.0 && !is_calm {
            let (low, high) = spectrum.support();
            let mut knots = spectrum.breakpoints();
            knots.retain(|&w| w > low && w < high);
            knots.extend([low, high]);
            knots.sort_by(f64::total_cmp);
            let m0 = adaptive(|w| spectrum.density(w), &knots, 1e-9);
            if m0 < LEAST_M2 {
                spectrum.notice = Some("the short-wave fade leaves nothing of a system whose height is given".to_owned());
                spectrum.shape = Shape::Calm;
            } else {
                spectrum = spectrum.scaled((system.hs_m / 4.0).powi(2) / m0);
            }
        }
        spectrum.scaled(system.scale * system.scale)
    }

    /// The same shape with its variance multiplied by `factor`.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.factor *= factor;
        self
    }

    /// Whether there are no waves at all.
    pub fn is_calm(&self) -> bool {
        self.shape == Shape::Calm
    }

    /// The buoy's data behind a measured spectrum.
    pub fn measured(&self) -> Option<&Measured> {
        if let Shape::Measured(m) = &self.shape { Some(m) } else { None }
    }

    /// S(omega), m^2 s; 0 for omega <= 0.
    pub fn density(&self, omega: f64) -> f64 {
        if omega <= 0.0 {
            return 0.0;
        }
        // Spectra in wave numbers: S(omega) d omega = S(k) dk.
        let by_wave_number = |density: &dyn Fn(f64) -> f64| {
            let k = self.dispersion.wave_number(omega);
            density(k) / self.dispersion.group_velocity(k)
        };
        let bare = match &self.shape {
            Shape::Calm => 0.0,
            Shape::Phillips(s) => s.density(omega),
            Shape::Tessendorf(s) => by_wave_number(&|k| s.density_k(k)),
            Shape::Ab(s) => s.density(omega),
            Shape::Jonswap(s) => s.density(omega),
            Shape::Marnero(s) => s.density(omega),
            Shape::Karaev(s) => s.density(omega),
            Shape::Elfouhaily(s) => by_wave_number(&|k| s.density_k(k)),
            Shape::Donelan(s) => s.density(omega),
            Shape::OchiHubble(s) => s.density(omega),
            Shape::Torsethaugen(s) => s.density(omega),
            Shape::Measured(s) => s.density(omega),
        };
        let fade =
            if self.fade_m > 0.0 { (-(self.fade_m * self.dispersion.wave_number(omega)).powi(2)).exp() } else { 1.0 };
        self.factor * bare * fade
    }

    /// Range of omega (rad/s) below which S is negligible and above which m0 is.
    pub fn support(&self) -> (f64, f64) {
        let low = match &self.shape {
            Shape::Phillips(s) => s.omega_p,
            Shape::OchiHubble(s) => 0.3 * s.lowest_peak(),
            Shape::Torsethaugen(s) => 0.3 * s.lowest_peak(),
            Shape::Measured(s) => s.support().0.max(1e-3),
            _ => 0.3 * self.omega_p,
        };
        (low, (400.0 * self.omega_p).max(4000.0))
    }

    /// Frequencies at which S has a kink, a jump or a narrow peak: quadrature is split there.
    pub fn breakpoints(&self) -> Vec<f64> {
        let around = |omega: f64| [0.8, 0.93, 1.0, 1.15, 1.5, 3.0].map(|r| r * omega).to_vec();
        match &self.shape {
            Shape::Karaev(s) => [around(self.omega_p), s.joints().to_vec()].concat(),
            Shape::OchiHubble(s) => s.peaks().into_iter().flat_map(around).collect(),
            Shape::Torsethaugen(s) => s.peaks().into_iter().flat_map(around).collect(),
            Shape::Measured(s) => s.breakpoints(),
            Shape::Jonswap(s) => [around(self.omega_p), s.joints()].concat(),
            Shape::Elfouhaily(_) => {
                let ripples = [100.0, 370.0, 1500.0].map(|k| self.dispersion.omega(k)).to_vec();
                [around(self.omega_p), ripples].concat()
            }
            _ => around(self.omega_p),
        }
    }

    /// Where S jumps, rad/s.
    pub fn jump(&self) -> Option<f64> {
        if let Shape::Phillips(s) = &self.shape { Some(s.omega_p) } else { None }
    }

    /// Whether the spectrum is defined with its own directional factor, cos^2.
    pub fn has_own_direction(&self) -> bool {
        matches!(self.shape, Shape::Tessendorf(_))
    }
}
