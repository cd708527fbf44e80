//! The open sea before a coast: which of its waves arrive, which equation solves them, how strongly the shore reflects
//! them, and how steep the foreshore is.

use super::approach::approach;
use super::elliptic;
use super::incident::Incident;
use super::parabolic;
use super::placed::PlacedCoast;
use super::structure::reflection_at;
use crate::waves::Plan;
use std::f64::consts::TAU;

/// Largest angle from straight shoreward, rad, of waves in the open sea (85 degrees).
pub const MAX_OPEN_ANGLE_RAD: f64 = 1.484;
/// Depth, m, that counts for a sea without a bed.
const DEEP_M: f64 = 1e5;

/// An equation of the waves over a coast (docs/design/coast.md).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// The parabolic mild-slope equation: waves that travel shoreward. Structures absorb them.
    Parabolic,
    /// The elliptic mild-slope equation: waves in all directions, which structures and steep shores reflect.
    Elliptic,
}

impl Solver {
    /// The equation that suits a coast: the elliptic one where there are structures.
    pub fn of(coast: &PlacedCoast) -> Self {
        if coast.structures.is_empty() { Self::Parabolic } else { Self::Elliptic }
    }

    /// Largest angle from straight shoreward of the waves that are solved, rad.
    pub fn max_angle_rad(self) -> f64 {
        match self {
            Self::Parabolic => parabolic::MAX_ANGLE_RAD,
            Self::Elliptic => elliptic::MAX_ANGLE_RAD,
        }
    }
}

/// The way of the waves of a planned sea to the edge of a coast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// Depth of the open sea, m.
    pub open_depth_m: f64,
    /// Mean depth of the side of the coast that faces the open sea, m.
    pub edge_depth_m: f64,
    /// Largest angle from straight shoreward at which waves arrive, rad.
    pub max_angle_rad: f64,
    /// Acceleration of gravity, m/s^2.
    pub gravity_m_s2: f64,
}

impl Arrival {
    /// The way of the waves of `plan` to `coast`, if `solver` takes them on from there.
    pub fn new(plan: &Plan, coast: &PlacedCoast, solver: Solver) -> Self {
        let depth_m = plan.dispersion.depth_m();
        Self {
            open_depth_m: if depth_m.is_finite() { depth_m } else { DEEP_M },
            edge_depth_m: edge_depth_m(coast),
            max_angle_rad: solver.max_angle_rad(),
            gravity_m_s2: plan.sea.gravity_m_s2,
        }
    }

    /// The wave that `wave` of the open sea is at the edge of the coast; `None` if it does not arrive.
    pub fn arriving(&self, wave: &Incident) -> Option<Incident> {
        let arrived = approach(wave, self.open_depth_m, self.edge_depth_m, self.gravity_m_s2)?;
        (arrived.direction_rad.abs() < self.max_angle_rad).then_some(arrived)
    }
}

/// Reflection coefficient of each point of land: that of a structure beside it, else by the slope of the shore, for a
/// sea of the significant height `hs_m` (m) and the peak period `tp_s` (s).
pub fn reflection(coast: &PlacedCoast, hs_m: f64, tp_s: f64, gravity_m_s2: f64) -> Vec<f32> {
    let wavelength_m = gravity_m_s2 * tp_s * tp_s / TAU;
    let mut list = elliptic::reflection_by_slope(&coast.bathymetry, hs_m, wavelength_m);
    let grid = &coast.bathymetry;
    for (index, value) in list.iter_mut().enumerate().filter(|(index, _)| grid.depth_m[*index] <= 0.0) {
        let [x, y] = [index % grid.columns, index / grid.columns].map(|i| i as f64 * grid.cell_m);
        if let Some(of_structure) = reflection_at(&coast.structures, x, y, grid.cell_m) {
            *value = of_structure as f32;
        }
    }
    list
}

/// Mean depth of the water at the side that faces the open sea, m.
pub fn edge_depth_m(coast: &PlacedCoast) -> f64 {
    let grid = &coast.bathymetry;
    let wet: Vec<f64> = (0..grid.rows).map(|j| grid.at(0, j)).filter(|depth_m| *depth_m > 0.5).collect();
    wet.iter().sum::<f64>() / wet.len().max(1) as f64
}

/// Median slope of the shore where the first land from the sea meets the water, height over length, between the
/// points on both sides of the waterline. `None` if there is none.
pub fn foreshore_slope(coast: &PlacedCoast) -> Option<f64> {
    let grid = &coast.bathymetry;
    let slope = |j: usize| {
        let land = (1..grid.columns).find(|i| grid.at(*i, j) <= 0.0)?;
        Some((grid.at(land - 1, j) - grid.at(land, j)) / grid.cell_m)
    };
    let mut slopes: Vec<f64> = (0..grid.rows).filter_map(slope).collect();
    slopes.sort_by(f64::total_cmp);
    slopes.get(slopes.len() / 2).map(|slope| slope.clamp(0.005, 0.5))
}
