//! A wave system, such as the local wind sea or the swell, with its frequency spectrum and directional distribution.

use super::spectra::{self, FrequencySpectrum};
use super::spreading::{CosineFactor, MAX_LOBES, Spreading, SpreadingAtFrequency};
use crate::files::measured::{MaximumEntropyDistribution, TabulatedDistribution};
use crate::state::params::{MAX_WAVE_SYSTEMS, Sea};
use std::f64::consts::TAU;

/// Largest number of terms whose sum is the directional spectrum of a sea, and largest number of vectors of four numbers
/// in an entry of a spectrum table: one for each lobe of each wave system. A buoy's distribution takes two vectors.
pub const MAX_SPECTRUM_TERMS: usize = MAX_WAVE_SYSTEMS * MAX_LOBES;

/// One wave system of a planned sea, such as the local wind sea or the swell.
#[derive(Clone, Debug)]
pub struct WaveSystem {
    /// Number of the system in the state string and the panel, from 1: systems without waves leave gaps in a plan.
    pub number: usize,
    /// Frequency spectrum, scaled to the wave height that the parameters ask for.
    pub spectrum: FrequencySpectrum,
    /// Directional spreading; unused if the directions come from a measured spectrum.
    pub spreading: Spreading,
    /// Unit vector (x, z) of the main direction in which the waves travel.
    pub travel_direction: [f64; 2],
}

/// Directional distribution of the energy of a wave system at one frequency.
pub enum DirectionalDistribution<'a> {
    /// Spreading model: lobes around the main direction of travel.
    Lobes(SpreadingAtFrequency),
    /// Measured directions: the maximum entropy distribution for a buoy's moments, with angles from +x towards +z.
    Measured(MaximumEntropyDistribution),
    /// Densities over frequency and direction, used as they are, with angles from +x towards +z.
    Tabulated(TabulatedDistribution<'a>),
}

/// Kind of a term of the directional spectrum, which is a sum of terms: one for each lobe of a directional spreading,
/// or one for a measured distribution. For each wave number a term stores one or two vectors of four numbers, which the
/// spectrum shader evaluates in the direction of each wave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectionalTermKind {
    /// One lobe of the directional spreading with its factor 1 or cos^2(theta). It stores one vector: (v x norm x
    /// energy fraction of the lobe, beta, s, v / (2 pi) x isotropic energy fraction, or 0 after the first lobe), with
    /// the variance v, m^2, of the real part of the amplitude at time 0, before the directional spreading (1/rad).
    Lobe(CosineFactor),
    /// A buoy's distribution [`MaximumEntropyDistribution`] with the complex coefficients phi1 and phi2. It stores two
    /// vectors: (v x norm, Re phi1, Im phi1, Re phi2) and (Im phi2, 0, 0, 0), with the variance v as in `Lobe`.
    Measured,
    /// A distribution from a [`DirectionalTable`](crate::files::measured::DirectionalTable), which is stored once for
    /// the whole sea. The term stores one vector: (v x energy fraction of the lower band, v x that of the upper one,
    /// index of the lower band, index of the upper band), with the variance v as in `Lobe`.
    Tabulated,
}

impl WaveSystem {
    /// Makes the frequency spectrum and the directional spreading of the wave system with the index `index` in
    /// `Sea::systems` of `sea`, whose gravity, depth and height factor count too.
    pub fn new(sea: &Sea, index: usize) -> Self {
        let system = &sea.systems[index];
        let spectrum =
            spectra::spectrum_of_system(sea, system).scaled(sea.displacement_factor * sea.displacement_factor);
        let spreading = Spreading::new(sea, system, &spectrum);
        Self { number: index + 1, spectrum, spreading, travel_direction: travel_direction(system.from_deg) }
    }

    /// Whether the wave directions come from a measured spectrum instead of a spreading model.
    pub fn has_measured_directions(&self) -> bool {
        self.spectrum.measured.as_ref().is_some_and(|m| m.has_directions())
    }

    /// Distribution of the wave system's energy over directions at the angular frequency `omega` (rad/s): that of the
    /// measured spectrum if it has directions, otherwise that of the spreading model.
    pub fn directional_distribution(&self, omega: f64) -> DirectionalDistribution<'_> {
        let measured = self.spectrum.measured.as_ref();
        if let Some(table) = measured.and_then(|m| m.tabulated_distribution(omega)) {
            return DirectionalDistribution::Tabulated(table);
        }
        measured.and_then(|m| m.directional_moments(omega)).map_or_else(
            || DirectionalDistribution::Lobes(self.spreading.lobes(omega)),
            |moments| DirectionalDistribution::Measured(MaximumEntropyDistribution::new(moments)),
        )
    }

    /// Directional spreading D of this wave system, per rad, at angular frequency `omega` (rad/s) in the direction in
    /// which the wave vector `k` (x, z; any length) points. Its integral over all directions is 1.
    pub fn direction_density(&self, omega: f64, k: [f64; 2]) -> f64 {
        match self.directional_distribution(omega) {
            DirectionalDistribution::Tabulated(table) => table.density(k[1].atan2(k[0])),
            DirectionalDistribution::Measured(mem) => mem.density(k[1].atan2(k[0])),
            DirectionalDistribution::Lobes(_) => {
                self.spreading.density(omega, angle_from_travel(self.travel_direction, k))
            }
        }
    }

    /// Directional spreading D, per rad, as the waves of a lattice have it. `k` is a wave vector (x, z) in units of the
    /// lattice spacing. Tabulated densities may be narrower than the lattice resolves: they are averaged over the angle
    /// 1 / |k| that the lattice cell of the wave vector covers. Other distributions are taken at the wave vector.
    pub fn direction_density_in_cell(&self, omega: f64, k: [f64; 2]) -> f64 {
        match self.directional_distribution(omega) {
            DirectionalDistribution::Tabulated(table) => table.mean_density(k[1].atan2(k[0]), 1.0 / k[0].hypot(k[1])),
            _ => self.direction_density(omega, k),
        }
    }

    /// Energy at the angular frequency `omega` (rad/s) in each of `directions` (unit vectors (x, z) of travel, spread
    /// evenly over the circle), relative to one another.
    pub fn relative_direction_densities(&self, omega: f64, directions: &[[f64; 2]]) -> Vec<f64> {
        match self.directional_distribution(omega) {
            DirectionalDistribution::Tabulated(table) => {
                let width_rad = TAU / directions.len() as f64;
                directions.iter().map(|[x, z]| table.mean_density(z.atan2(*x), width_rad)).collect()
            }
            DirectionalDistribution::Measured(mem) => {
                directions.iter().map(|[x, z]| mem.density(z.atan2(*x))).collect()
            }
            DirectionalDistribution::Lobes(at) => {
                // Each lobe is normalised over the directions: the quadrature of its norm would take too long.
                let mut out = vec![at.isotropic_fraction / directions.len() as f64; directions.len()];
                let angles: Vec<f64> =
                    directions.iter().map(|k| angle_from_travel(self.travel_direction, *k)).collect();
                for (share, lobe) in &at.lobes {
                    let densities: Vec<f64> = angles.iter().map(|theta| lobe.unnormalised_density(*theta)).collect();
                    let scale = share / densities.iter().sum::<f64>().max(f64::MIN_POSITIVE);
                    out.iter_mut().zip(&densities).for_each(|(out, density)| *out += scale * density);
                }
                out
            }
        }
    }

    /// First directional moment of this wave system at the angular frequency `omega` (rad/s): the mean unit vector of
    /// travel (x, z), weighted by the directional spreading.
    pub fn first_moment(&self, omega: f64) -> [f64; 2] {
        match self.directional_distribution(omega) {
            DirectionalDistribution::Tabulated(table) => table.first_moment(),
            DirectionalDistribution::Measured(mem) => mem.first_moment(),
            DirectionalDistribution::Lobes(_) => {
                let r1 = self.spreading.first_moment(omega);
                self.travel_direction.map(|t| t * r1)
            }
        }
    }

    /// Kinds of the terms (lobes, or one measured or tabulated distribution) whose sum is the directional spectrum of this
    /// wave system. They are the same at every frequency.
    pub fn terms(&self) -> Vec<DirectionalTermKind> {
        if self.has_measured_directions() {
            let is_table = self.spectrum.measured.as_ref().is_some_and(|m| m.directional_table().is_some());
            return vec![if is_table { DirectionalTermKind::Tabulated } else { DirectionalTermKind::Measured }];
        }
        let lobes = self.spreading.lobes(self.spectrum.omega_p).lobes;
        if lobes.is_empty() {
            return vec![DirectionalTermKind::Lobe(CosineFactor::One)];
        }
        lobes.iter().map(|(_, lobe)| DirectionalTermKind::Lobe(lobe.cosine_factor)).collect()
    }
}

impl DirectionalTermKind {
    /// Number of vectors of four numbers that a term of this kind stores for each wave number.
    pub fn vectors_per_entry(self) -> usize {
        if self == Self::Measured { 2 } else { 1 }
    }
}

/// Unit vector (x, z) along which waves from the compass bearing `from_deg` (degrees clockwise from north) travel.
pub fn travel_direction(from_deg: f64) -> [f64; 2] {
    let from = from_deg.to_radians();
    [-from.sin(), from.cos()]
}

/// Angle (0 to pi rad) between the wave vector `k` and the direction of travel `travel`: both (x, z), of any length.
pub fn angle_from_travel(travel: [f64; 2], k: [f64; 2]) -> f64 {
    let dot = travel[0] * k[0] + travel[1] * k[1];
    let cross = travel[0] * k[1] - travel[1] * k[0];
    cross.abs().atan2(dot)
}
