//! A directional spectrum as data: the density E(f, direction) of every frequency band on a grid of directions. It is
//! used as it is, without a reconstruction from moments.

use super::spectrum::{MAX_BANDS, MIN_BANDS};
use super::state::MAX_TEXT_BYTES;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Smallest number of directions of a directional spectrum.
pub const MIN_DIRECTIONS: usize = 4;
/// Largest number of directions of a directional spectrum that is kept; a file may have more, up to
/// [`MAX_FILE_DIRECTIONS`].
pub const MAX_DIRECTIONS: usize = 360;
/// Largest number of directions that a file may have.
pub const MAX_FILE_DIRECTIONS: usize = 1440;
/// Level of the strongest direction of a band. Levels are whole numbers from 0 to this one, which two letters of a link
/// can hold.
pub const HIGHEST_LEVEL: u16 = 4095;
/// Length that the text of one band in a link never exceeds, without its levels, bytes.
const BAND_TEXT_BYTES: usize = 22;
/// Length that the beginning of the text in a link never exceeds, bytes.
const HEAD_TEXT_BYTES: usize = 20;

/// Nodes (fractions of the width) and weights of the four-point Gauss-Legendre rule for means over an angle.
const MEAN_NODES: [(f64, f64); 4] = [
    (-0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
    (-0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Shares of the directions in the energy of each frequency band. The directions are evenly spaced over the circle.
///
/// Each band has a level from 0 to [`HIGHEST_LEVEL`] for each direction, in proportion to its density. Levels are what
/// a link carries, so a spectrum survives a link unchanged. Rounding to levels changes a density by at most 0.013 % of
/// the largest one of its band.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionalTable {
    first_from_deg: f64,
    direction_count: usize,
    /// Levels, band by band, in each band clockwise from `first_from_deg`.
    levels: Vec<u16>,
}

/// Directional distribution D of wave energy at one frequency, per rad, between two bands of a [`DirectionalTable`].
/// It is linear between the directions of the table, and its integral over all directions is 1.
#[derive(Clone, Copy, Debug)]
pub struct TabulatedDistribution<'a> {
    table: &'a DirectionalTable,
    /// Index of each of the two bands, and its fraction of the energy; the fractions add to 1.
    pub bands: [(usize, f64); 2],
}

/// Largest number of directions with which the text of `band_count` bands fits into a link.
pub fn most_directions(band_count: usize) -> usize {
    let for_levels = (MAX_TEXT_BYTES - HEAD_TEXT_BYTES) / band_count.max(1);
    (for_levels.saturating_sub(BAND_TEXT_BYTES) / 2).min(MAX_DIRECTIONS)
}

impl DirectionalTable {
    /// Makes a table from densities (any unit, at least 0), band by band, for `direction_count` directions evenly spaced
    /// over the circle, clockwise from the bearing `first_from_deg` that waves come from.
    ///
    /// More directions than [`most_directions`] are averaged to that many or fewer.
    ///
    /// # Errors
    /// One sentence, if the sizes are out of range or do not match, or a density is negative or not finite.
    pub fn new(first_from_deg: f64, direction_count: usize, densities: &[f64]) -> Result<Self, String> {
        if !(MIN_DIRECTIONS..=MAX_FILE_DIRECTIONS).contains(&direction_count) {
            return Err(format!(
                "{direction_count} directions, but {MIN_DIRECTIONS} to {MAX_FILE_DIRECTIONS} are needed"
            ));
        }
        let band_count = densities.len() / direction_count;
        if !(MIN_BANDS..=MAX_BANDS).contains(&band_count) || !densities.len().is_multiple_of(direction_count) {
            return Err(format!("{} densities for {direction_count} directions", densities.len()));
        }
        if !first_from_deg.is_finite() || densities.iter().any(|d| !(0.0..1e30).contains(d)) {
            return Err("a density over frequency and direction is negative or not a number".into());
        }
        let most = most_directions(band_count);
        if direction_count > most {
            // The largest divisor keeps every new direction the mean of a whole number of old ones.
            let count = (MIN_DIRECTIONS..=most).rev().find(|n| direction_count.is_multiple_of(*n)).unwrap_or(most);
            let (first, fewer) = averaged_directions(first_from_deg, direction_count, densities, count);
            return Self::new(first, count, &fewer);
        }
        let levels = densities.chunks(direction_count).flat_map(|band| {
            let largest = band.iter().copied().fold(0.0, f64::max);
            let scale = if largest > 0.0 { f64::from(HIGHEST_LEVEL) / largest } else { 0.0 };
            band.iter().map(move |d| if scale.is_finite() { (d * scale).round() as u16 } else { 0 })
        });
        Ok(Self { first_from_deg: rounded_bearing_deg(first_from_deg), direction_count, levels: levels.collect() })
    }

    /// Makes a table from levels, band by band. An error if a level, the first bearing or a size is out of range.
    pub(super) fn from_levels(first_from_deg: f64, direction_count: usize, levels: Vec<u16>) -> Result<Self, String> {
        let band_count = levels.len() / direction_count.max(1);
        if !(MIN_DIRECTIONS..=MAX_DIRECTIONS).contains(&direction_count)
            || !(MIN_BANDS..=MAX_BANDS).contains(&band_count)
            || levels.len() != band_count * direction_count
            || direction_count > most_directions(band_count)
        {
            return Err(format!("{} levels for {direction_count} directions", levels.len()));
        }
        if !(0.0..360.0).contains(&first_from_deg) || levels.iter().any(|l| *l > HIGHEST_LEVEL) {
            return Err("a direction or a level is out of range".into());
        }
        Ok(Self { first_from_deg: rounded_bearing_deg(first_from_deg), direction_count, levels })
    }

    /// Bearing that the waves of the first direction come from, degrees clockwise from north in [0, 360).
    pub fn first_from_deg(&self) -> f64 {
        self.first_from_deg
    }

    /// Number of directions.
    pub fn direction_count(&self) -> usize {
        self.direction_count
    }

    /// Number of frequency bands.
    pub fn band_count(&self) -> usize {
        self.levels.len() / self.direction_count
    }

    /// Angle between two neighbouring directions, rad.
    pub fn step_rad(&self) -> f64 {
        TAU / self.direction_count as f64
    }

    /// Levels of the directions of the band `band`.
    pub(super) fn levels(&self, band: usize) -> &[u16] {
        &self.levels[band * self.direction_count..(band + 1) * self.direction_count]
    }

    /// Directional distribution D of the band `band` at each direction of the table, per rad. Their sum times the step
    /// is 1. A band without energy is even over all directions.
    pub fn distribution_of_band(&self, band: usize) -> Vec<f64> {
        let levels = self.levels(band);
        let sum: u32 = levels.iter().map(|l| u32::from(*l)).sum();
        let per_level = 1.0 / (f64::from(sum) * self.step_rad());
        levels.iter().map(|l| if sum > 0 { f64::from(*l) * per_level } else { 1.0 / TAU }).collect()
    }

    /// Angle theta = atan2(z, x), with x east and z south, in which the waves of the first direction travel, rad.
    /// Further directions follow in the sense of growing theta, because both it and a bearing turn clockwise.
    pub fn first_travel_rad(&self) -> f64 {
        self.first_from_deg.to_radians() + FRAC_PI_2
    }

    /// Distribution between two bands (index and fraction of the energy of each; the fractions add to 1).
    pub fn between(&self, bands: [(usize, f64); 2]) -> TabulatedDistribution<'_> {
        TabulatedDistribution { table: self, bands }
    }
}

impl TabulatedDistribution<'_> {
    /// Density D, per rad, at the angle `theta` = atan2(z, x) in which waves travel, rad.
    pub fn density(&self, theta: f64) -> f64 {
        let steps = (theta - self.table.first_travel_rad()) / self.table.step_rad();
        let (whole, t) = (steps.floor(), steps - steps.floor());
        let n = self.table.direction_count;
        let at = whole.rem_euclid(n as f64) as usize % n;
        let in_band = |&(band, fraction): &(usize, f64)| {
            let levels = self.table.levels(band);
            let sum: u32 = levels.iter().map(|l| u32::from(*l)).sum();
            let [a, b] = [levels[at], levels[(at + 1) % n]].map(f64::from);
            let share = if sum > 0 { (a + t * (b - a)) / f64::from(sum) } else { 1.0 / n as f64 };
            fraction * share / self.table.step_rad()
        };
        self.bands.iter().map(in_band).sum()
    }

    /// Mean of the density D, per rad, over the angle `width_rad` around `theta`, rad, by a four-point rule.
    pub fn mean_density(&self, theta: f64, width_rad: f64) -> f64 {
        MEAN_NODES.iter().map(|(x, w)| w * self.density(theta + x * width_rad)).sum()
    }

    /// First moment [re, im], the integral of D e^{i theta}, with the angle theta in which waves travel.
    pub fn first_moment(&self) -> [f64; 2] {
        let step = self.table.step_rad();
        // D is linear between directions: a sum of triangles, whose transform is the square of a sinc.
        let half = 0.5 * step;
        let triangle = (half.sin() / half).powi(2);
        let mut sum = [0.0; 2];
        for &(band, fraction) in &self.bands {
            for (i, d) in self.table.distribution_of_band(band).into_iter().enumerate() {
                let (sin, cos) = (self.table.first_travel_rad() + i as f64 * step).sin_cos();
                sum[0] += fraction * triangle * d * step * cos;
                sum[1] += fraction * triangle * d * step * sin;
            }
        }
        sum
    }
}

/// Averages densities for `old_count` directions over the circle to `count` fewer ones, band by band. Returns the
/// bearing of the first new direction, degrees, and the new densities. Each new direction is the mean over its sector.
fn averaged_directions(first_from_deg: f64, old_count: usize, densities: &[f64], count: usize) -> (f64, Vec<f64>) {
    let per_sector = old_count as f64 / count as f64;
    let fewer = densities.chunks(old_count).flat_map(|band| {
        (0..count).map(move |i| {
            // The sector covers these fractions of old directions, each of which stands for one unit.
            let (low, high) = (i as f64 * per_sector, (i + 1) as f64 * per_sector);
            let part = |j: usize| (high.min(j as f64 + 1.0) - low.max(j as f64)).max(0.0) * band[j];
            (low as usize..old_count.min(high.ceil() as usize)).map(part).sum::<f64>() / per_sector
        })
    });
    let first = first_from_deg + 0.5 * (per_sector - 1.0) * 360.0 / old_count as f64;
    (first, fewer.collect())
}

/// Rounds a bearing to 0.01 degree and wraps it into [0, 360).
fn rounded_bearing_deg(v: f64) -> f64 {
    ((100.0 * v.rem_euclid(360.0)).round() / 100.0) % 360.0 + 0.0
}
