//! Spray of breaking crests: square grids of places, anchored to the world, from which puffs of drops come. Each place
//! has one puff at a time; coarser grids with larger puffs follow farther from the eye.

use super::grid_before_eye;
use crate::gpu::layout::gpu_struct;
use crate::render::scene::Scene;
use std::f64::consts::TAU;

/// Number of places along a side of a grid (`SPRAY_SIDE` in shaders/drops/spray.wgsl), and of grids.
const SIDE: u32 = 96;
const LEVELS: usize = 4;
/// Number of puffs.
pub const QUADS: u32 = SIDE * SIDE * LEVELS as u32;
/// Distance between the places of the finest grid, m, and its growth from each grid to the next.
const FINEST_CELL_M: f64 = 0.6;
const CELL_RATIO: f64 = 2.0;
/// The grids lie before the eye: distance of their middles from it, and the distance up to which they fill the view,
/// both in sides of the grid.
const AHEAD: f64 = 0.42;
const REACH: f64 = 0.7;
/// Time between two puffs of a place, s; no puff lasts longer.
const PUFF_S: f64 = 1.6;
/// Wind speed at 10 m from which crests lose spray, and range above it over which it becomes full, m/s. Beaufort's
/// scale has blown foam from 14 m/s, spindrift from 17 m/s and spray that affects the visibility from 21 m/s.
const FIRST_WIND_M_S: f64 = 12.0;
const WIND_RANGE_M_S: f64 = 14.0;
/// Wind speed at the height of the spray divided by that at 10 m.
const WIND_AT_CREST: f64 = 0.75;

gpu_struct! {
    /// WGSL `SprayLevel`: a grid of places from which puffs come.
    #[derive(Default)]
    pub struct SprayLevel as "SprayLevel" {
        /// World index (x, z) of the grid's first place.
        first_cell: [i32; 2],
        /// Corner (x, z) of that place relative to the point below the eye, m.
        corner: [f32; 2],
        /// Distance between two places, m.
        cell_m: f32,
        /// Distance from the eye up to which the grid fills the view, m.
        reach_m: f32,
        unused: [u32; 2],
    }
}

gpu_struct! {
    /// WGSL `Spray`: where and when spray is thrown up.
    pub struct SprayUniform as "Spray" {
        levels: [SprayLevel; LEVELS],
        /// Unit vector (x, z) of the direction towards which the wind blows.
        downwind: [f32; 2],
        /// Wind speed at the height of the spray, m/s.
        wind_m_s: f32,
        /// Fraction of the puffs of the open sea that are drawn, 0 to 1.
        share: f32,
        /// Speed of breaking crests, m/s.
        breaker_speed_m_s: f32,
        /// Time between two puffs of a place, s.
        puff_s: f32,
        /// Time in such periods: its whole part, and its fraction.
        moment: u32,
        moment_fraction: f32,
        /// Fraction of the puffs of surf and of waves that burst on stone that are drawn, 0 to 1.
        coast_share: f32,
        /// Frequency of the waves at the peak of the spectrum, Hz.
        peak_hz: f32,
        /// Acceleration of gravity, m/s^2.
        gravity_m_s2: f32,
        unused: u32,
    }
}

/// Fraction of the full spray in a wind of the given speed at 10 m, m/s: 0 up to 12 m/s, 1 from 26 m/s.
pub fn share_in_wind(wind_m_s: f64) -> f64 {
    let x = ((wind_m_s - FIRST_WIND_M_S) / WIND_RANGE_M_S).clamp(0.0, 1.0);
    x * x.sqrt()
}

impl SprayUniform {
    /// The spray of a scene; None if it has none.
    pub fn new(scene: &Scene) -> Option<Self> {
        let (sea, view) = (&scene.sea, &scene.view);
        let foam = &scene.look.surface.foam;
        let share = foam.spray * share_in_wind(sea.wind_m_s);
        // Surf throws up drops in any wind.
        let coast_share = if scene.has_coast { foam.spray } else { 0.0 };
        if share.max(coast_share) <= 0.0 || foam.coverage_factor <= 0.0 {
            return None;
        }
        let levels = std::array::from_fn(|level| {
            let cell_m = FINEST_CELL_M * CELL_RATIO.powi(level as i32);
            let side_m = cell_m * f64::from(SIDE);
            let (first_cell, corner) = grid_before_eye(view, cell_m, SIDE, AHEAD);
            SprayLevel { first_cell, corner, cell_m: cell_m as f32, reach_m: (REACH * side_m) as f32, unused: [0; 2] }
        });
        let (moment, moment_fraction) = scene.moment(PUFF_S);
        Some(Self {
            levels,
            downwind: sea.downwind.map(|x| x as f32),
            wind_m_s: (WIND_AT_CREST * sea.wind_m_s) as f32,
            share: share as f32,
            breaker_speed_m_s: sea.breaker_speed_m_s as f32,
            puff_s: PUFF_S as f32,
            moment,
            moment_fraction,
            coast_share: coast_share as f32,
            peak_hz: (sea.gravity_m_s2 / (TAU * sea.peak_wavelength_m)).sqrt() as f32,
            gravity_m_s2: sea.gravity_m_s2 as f32,
            unused: 0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spray_grows_from_nothing_at_12_metres_per_second() {
        assert_eq!([0.0, 8.0, 12.0].map(share_in_wind), [0.0; 3]);
        assert_eq!([26.0, 40.0].map(share_in_wind), [1.0; 2]);
        let winds: Vec<f64> = (0..=28).map(|i| 12.0 + 0.5 * f64::from(i)).collect();
        assert!(winds.windows(2).all(|pair| share_in_wind(pair[1]) > share_in_wind(pair[0])));
        // Little in the first gusts of a near gale, where Beaufort's scale has no spray yet.
        assert!(share_in_wind(14.0) < 0.06 && share_in_wind(20.0) > 0.4);
    }
}
