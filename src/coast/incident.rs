//! The sea that comes from the open water: its components in the frame of a coast.

use crate::waves::Plan;
use crate::waves::lattice::LatticeWave;
use crate::waves::plan::Cascade;
use crate::waves::statistics::{initial_amplitude, lattice_indices};
use crate::waves::table::{SpectrumTable, entry_index};
use std::f64::consts::{PI, TAU};

/// A plane wave of the open sea in the frame of a coast, with the elevation
/// amplitude cos(kx x + ky y - omega t + phase). Wave number and direction are those over the mean depth of the
/// grid's edge at x = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Incident {
    /// Amplitude, m.
    pub amplitude_m: f64,
    /// Phase at the origin of the frame at time 0, rad.
    pub phase_rad: f64,
    /// Angular frequency, rad/s.
    pub omega_rad_s: f64,
    /// Direction of travel, rad: 0 is straight shoreward (+x), positive angles turn towards +y.
    pub direction_rad: f64,
}

impl Incident {
    /// Elevation variance of the wave, m^2.
    pub fn variance_m2(&self) -> f64 {
        0.5 * self.amplitude_m * self.amplitude_m
    }
}

/// Place of a coast in the world: where its origin lies, and how it is turned.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placement {
    /// World coordinates (x, z) of the origin of the coast's frame, m.
    pub origin_m: [f64; 2],
    /// Angle (rad) by which the coast's x axis is turned from the world's +x (east) towards +z (south).
    pub turn_rad: f64,
}

impl Placement {
    /// World position (x, z), m, of a point (x, y) in the coast's frame, m.
    pub fn world_m(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.turn_rad.sin_cos();
        let [east, south] = self.origin_m;
        [east + x * cos - y * sin, south + x * sin + y * cos]
    }

    /// Point (x, y) in the coast's frame, m, of a world position (x, z), m.
    pub fn in_frame_m(&self, world_m: [f64; 2]) -> [f64; 2] {
        self.turned_into_frame([0, 1].map(|axis| world_m[axis] - self.origin_m[axis]))
    }

    /// Components (x, y) in the coast's frame of a vector (x, z) of the world.
    pub fn turned_into_frame(&self, [x, z]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.turn_rad.sin_cos();
        [x * cos + z * sin, z * cos - x * sin]
    }
}

/// A wave of a cascade's lattice in the frame of a coast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticeIncident {
    /// The wave. Its direction is that in the open sea.
    pub incident: Incident,
    /// Indices (along x and z of the world) of its wave vector on the lattice.
    pub lattice_index: [i32; 2],
    /// Wave number and angular frequency of this wave.
    pub wave: LatticeWave,
}

/// The `count` strongest waves of a planned sea that are longer than `min_wavelength_m` and travel at less than
/// `max_angle_rad` from straight shoreward, with the phases of the plan's seed, strongest first.
///
/// They are waves of the patches as these repeat; the blending of shifted copies that hides the repetition is left out.
pub fn strongest_waves(
    plan: &Plan,
    place: Placement,
    count: usize,
    min_wavelength_m: f64,
    max_angle_rad: f64,
) -> Vec<Incident> {
    let all = plan.cascades.iter().flat_map(|c| shoreward_waves(plan, c, place, min_wavelength_m, max_angle_rad));
    strongest(all.collect(), count).into_iter().map(|wave| wave.incident).collect()
}

/// As [`strongest_waves`], but only those of `cascade`, with their places on its lattice.
pub fn strongest_waves_of_cascade(
    plan: &Plan,
    cascade: &Cascade,
    place: Placement,
    count: usize,
    min_wavelength_m: f64,
    max_angle_rad: f64,
) -> Vec<LatticeIncident> {
    strongest(shoreward_waves(plan, cascade, place, min_wavelength_m, max_angle_rad), count)
}

fn strongest(mut waves: Vec<LatticeIncident>, count: usize) -> Vec<LatticeIncident> {
    waves.retain(|wave| wave.incident.amplitude_m > 0.0);
    waves.sort_by(|a, b| b.incident.amplitude_m.total_cmp(&a.incident.amplitude_m));
    waves.truncate(count);
    waves
}

/// All waves of a cascade that are longer than `min_wavelength_m` and travel at less than `max_angle_rad` from straight
/// shoreward.
fn shoreward_waves(
    plan: &Plan,
    cascade: &Cascade,
    place: Placement,
    min_wavelength_m: f64,
    max_angle_rad: f64,
) -> Vec<LatticeIncident> {
    if cascade.k_low * min_wavelength_m >= TAU {
        return Vec::new();
    }
    let table = SpectrumTable::new(plan, cascade);
    let wave = |(ix, iz): (i32, i32)| {
        let wave = table.waves[entry_index(ix, iz)];
        if wave.k <= 0.0 || wave.k * min_wavelength_m > TAU {
            return None;
        }
        let [kx, kz] = [ix, iz].map(|index| f64::from(index) * cascade.dk());
        let direction_rad = wrapped(kz.atan2(kx) - place.turn_rad);
        if direction_rad.abs() > max_angle_rad {
            return None;
        }
        let [re, im] = initial_amplitude(plan, cascade, &table, ix, iz);
        let phase_rad = im.atan2(re) + kx * place.origin_m[0] + kz * place.origin_m[1];
        let incident = Incident {
            amplitude_m: 2.0 * re.hypot(im),
            phase_rad: wrapped(phase_rad),
            omega_rad_s: wave.omega,
            direction_rad,
        };
        Some(LatticeIncident { incident, lattice_index: [ix, iz], wave })
    };
    lattice_indices(plan.n).filter_map(wave).collect()
}

/// The directional spectrum of a planned sea as one component for each of `frequencies` x `directions` bins, for maps
/// of statistics, which need no phases: the phases are 0. Each bin of frequency holds the same variance. The bins of
/// direction cover the angles below `max_angle_rad` from straight shoreward evenly; energy outside is left out.
pub fn spectrum_bins(
    plan: &Plan,
    turn_rad: f64,
    frequencies: usize,
    directions: usize,
    max_angle_rad: f64,
) -> Vec<Incident> {
    // Directions over the whole circle, of which the shoreward ones are kept, so that the shares add up to 1.
    let step = 2.0 * max_angle_rad / directions as f64;
    let whole = (TAU / step).round().max(1.0) as usize;
    let angle = |index: usize| (index as f64 + 0.5) * (TAU / whole as f64) - PI;
    let unit: Vec<[f64; 2]> = (0..whole)
        .map(|index| {
            let (sin, cos) = (angle(index) + turn_rad).sin_cos();
            [cos, sin]
        })
        .collect();
    let mut bins = Vec::new();
    let k_max = plan.k_max();
    for (k, variance_m2) in plan.spectrum_integrals.bins_of_equal_variance(0.0, k_max, frequencies) {
        let omega = plan.dispersion.omega(k);
        let total = plan.density(omega).max(f64::MIN_POSITIVE);
        let mut shares = vec![0.0; whole];
        for system in &plan.systems {
            let weight = system.spectrum.density(omega) / total;
            let relative = system.relative_direction_densities(omega, &unit);
            let sum = relative.iter().sum::<f64>().max(f64::MIN_POSITIVE);
            shares.iter_mut().zip(relative).for_each(|(share, r)| *share += weight * r / sum);
        }
        for (index, share) in shares.iter().enumerate().filter(|(index, _)| angle(*index).abs() < max_angle_rad) {
            bins.push(Incident {
                amplitude_m: (2.0 * variance_m2 * share).sqrt(),
                phase_rad: 0.0,
                omega_rad_s: omega,
                direction_rad: angle(index),
            });
        }
    }
    bins.retain(|bin| bin.amplitude_m > 0.0);
    bins
}

/// The angle plus a multiple of 2 pi that lies between -pi and pi.
pub(super) fn wrapped(angle_rad: f64) -> f64 {
    (angle_rad + PI).rem_euclid(TAU) - PI
}
