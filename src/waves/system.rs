//! A wave system of a plan: frequency spectrum and directional distribution.

use super::spectra::{self, FrequencySpectrum};
use super::spreading::{Cosine, Lobes, Spreading};
use crate::files::measured::Mem;
use crate::state::params::{Sea, System};

/// One wave system of a plan.
#[derive(Clone, Debug)]
pub struct WaveSystem {
    /// Frequency spectrum with all scales applied.
    pub spectrum: FrequencySpectrum,
    /// Directional spreading; unused if the directions are measured.
    pub spreading: Spreading,
    /// Unit vector (x, z) towards which the waves travel.
    pub travel: [f64; 2],
}

/// Directional distribution of a system at one frequency.
pub enum Directions {
    /// Lobes around the direction of travel.
    Lobes(Lobes),
    /// Maximum entropy distribution of a buoy's directional moments, in world axes.
    Measured(Mem),
}

/// Form of one term of the directional spectrum. The spectrum of a sea is a sum of terms; for each wave a term stores
/// one or two vectors of four numbers, which the spectrum pass evaluates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermKind {
    /// One lobe of the spreading: (variance x norm, beta, s, isotropic variance per rad).
    Lobe(Cosine),
    /// A measured distribution: (variance x norm, Re phi1, Im phi1, Re phi2), (Im phi2, 0, 0, 0).
    Measured,
}

impl WaveSystem {
    /// The plan's form of a system of a sea.
    pub fn new(sea: &Sea, system: &System) -> Self {
        let spectrum = spectra::of_system(sea, system).scaled(sea.height * sea.height);
        let spreading = Spreading::new(sea, system, &spectrum);
        Self { spectrum, spreading, travel: travel(system.from_deg) }
    }

    /// Whether the directions come from a buoy's data.
    pub fn has_measured_directions(&self) -> bool {
        self.spectrum.measured.as_ref().is_some_and(|m| m.directions().is_some())
    }

    /// Maximum entropy distribution of the buoy's directional moments at frequency `omega`, rad/s. Its moments can
    /// differ from the measured ones, which need not be those of any distribution.
    fn measured(&self, omega: f64) -> Option<Mem> {
        self.spectrum.measured.as_ref()?.moments(omega).map(Mem::new)
    }

    /// Directional distribution at frequency `omega`, rad/s.
    pub fn directions(&self, omega: f64) -> Directions {
        self.measured(omega).map_or_else(|| Directions::Lobes(self.spreading.lobes(omega)), Directions::Measured)
    }

    /// Directional spreading D, per rad, at frequency `omega` (rad/s) in the direction of the wave vector `k`.
    pub fn direction_density(&self, omega: f64, k: [f64; 2]) -> f64 {
        match self.measured(omega) {
            Some(mem) => mem.density(k[1].atan2(k[0])),
            None => self.spreading.density(omega, angle(self.travel, k)),
        }
    }

    /// First directional moment in world axes (x, z): the integral of D times the unit vector of travel.
    pub fn first_moment(&self, omega: f64) -> [f64; 2] {
        match self.measured(omega) {
            Some(mem) => mem.first_moment(),
            None => {
                let r1 = self.spreading.first_moment(omega);
                self.travel.map(|t| t * r1)
            }
        }
    }

    /// Terms of the directional spectrum, the same at every frequency.
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
    /// Number of vectors of four numbers that the term takes per wave.
    pub fn size(self) -> usize {
        if self == Self::Measured { 2 } else { 1 }
    }
}

/// Unit vector (x, z) of travel of waves that come from a compass bearing, degrees clockwise from north.
pub fn travel(from_deg: f64) -> [f64; 2] {
    let from = from_deg.to_radians();
    [-from.sin(), from.cos()]
}

/// Angle between a wave vector `k` and a direction of travel, 0 to pi rad.
pub fn angle(travel: [f64; 2], k: [f64; 2]) -> f64 {
    let dot = travel[0] * k[0] + travel[1] * k[1];
    let cross = travel[0] * k[1] - travel[1] * k[0];
    cross.abs().atan2(dot)
}
