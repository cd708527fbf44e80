//! A wave system with its coefficients worked out: how much energy it has at a frequency and where that travels.

use super::spectra::FrequencySpectrum;
use super::spreading::{Cosine, Lobes, Spreading};
use crate::files::measured::Mem;
use crate::state::params::{Sea, System};

/// One system of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct WaveSystem {
    /// Frequency spectrum with all scales applied.
    pub spectrum: FrequencySpectrum,
    /// Directional spreading; not used where the buoy has measured directions.
    pub spreading: Spreading,
    /// Unit vector (x, z) towards which the waves travel.
    pub travel: [f64; 2],
}

/// The directions of a system at one frequency.
pub enum Directions {
    /// Lobes around the direction of travel.
    Lobes(Lobes),
    /// As measured, in world axes.
    Measured(Mem),
}

/// What kind of number quadruple stands for a part of a system's directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermKind {
    /// One lobe: variance, beta, s, isotropic variance.
    Lobe(Cosine),
    /// A measured distribution, two quadruples: variance x norm, phi1 (re, im), Re phi2; Im phi2.
    Measured,
}

impl WaveSystem {
    /// A system of a sea.
    pub fn new(sea: &Sea, system: &System) -> Self {
        let spectrum = FrequencySpectrum::new(sea, system).scaled(sea.height * sea.height);
        let spreading = Spreading::new(sea, system, &spectrum);
        Self { spectrum, spreading, travel: travel(system.from_deg) }
    }

    /// Whether the directions come from a buoy.
    pub fn has_measured_directions(&self) -> bool {
        self.spectrum.measured().is_some_and(|m| m.directions().is_some())
    }

    /// The directions at a frequency, rad/s.
    pub fn directions(&self, omega: f64) -> Directions {
        match self.spectrum.measured().and_then(|m| m.moments(omega)) {
            Some([a, b, c, d]) => Directions::Measured(Mem::new([a, b, c, d])),
            None => Directions::Lobes(self.spreading.lobes(omega)),
        }
    }

    /// D at a frequency for waves along the wave vector `k`, per rad.
    pub fn direction_density(&self, omega: f64, k: [f64; 2]) -> f64 {
        match self.directions(omega) {
            Directions::Measured(mem) => mem.density(k[1].atan2(k[0])),
            Directions::Lobes(_) => self.spreading.density(omega, angle(self.travel, k)),
        }
    }

    /// Integral of D times the unit vector of travel: first directional moment in world axes (x, z).
    pub fn first_moment(&self, omega: f64) -> [f64; 2] {
        match self.spectrum.measured().and_then(|m| m.moments(omega)) {
            // As the maximum entropy distribution has it: inadmissible moments were moved.
            Some([a, b, c, d]) => Mem::new([a, b, c, d]).first_moment(),
            None => {
                let r1 = self.spreading.first_moment(omega);
                self.travel.map(|t| t * r1)
            }
        }
    }

    /// The quadruples that hold the directions, the same at every frequency.
    pub fn terms(&self) -> Vec<TermKind> {
        if self.has_measured_directions() {
            return vec![TermKind::Measured];
        }
        let lobes = self.spreading.lobes(self.spectrum.omega_p).lobes;
        if lobes.is_empty() {
            return vec![TermKind::Lobe(Cosine::None)];
        }
        lobes.iter().map(|(_, lobe)| TermKind::Lobe(lobe.cosine)).collect()
    }
}

impl TermKind {
    /// Quadruples that it takes.
    pub fn size(self) -> usize {
        match self {
            Self::Lobe(_) => 1,
            Self::Measured => 2,
        }
    }
}

/// Unit vector (x, z) along which waves travel that come from a compass bearing, degrees.
pub fn travel(from_deg: f64) -> [f64; 2] {
    let from = from_deg.to_radians();
    [-from.sin(), from.cos()]
}

/// Angle between a wave vector and a direction of travel, rad in [0, pi].
pub fn angle(travel: [f64; 2], k: [f64; 2]) -> f64 {
    let dot = travel[0] * k[0] + travel[1] * k[1];
    let cross = travel[0] * k[1] - travel[1] * k[0];
    cross.abs().atan2(dot)
}
