//! Run-up on plane beaches, as the command prints it.

use super::GRAVITY_M_S2;
use crate::coast::{Bathymetry, PlacedCoast};
use crate::lab::coast::{self, CoastSettings, Solver};
use crate::lab::validate::measurement::parse_params;
use std::f64::consts::TAU;

/// Slopes of the foreshore.
pub const SLOPES: [f64; 5] = [0.01, 0.03, 0.06, 0.1, 0.2];
/// Significant wave heights of the open sea, m, and their peak periods, s.
pub const HEIGHTS_M: [f64; 3] = [1.0, 2.0, 5.0];
/// Peak periods of the seas of [`HEIGHTS_M`], s.
pub const PERIODS_S: [f64; 3] = [6.0, 12.0, 14.0];

/// Run-up on one beach.
#[derive(Clone, Copy, Debug)]
pub struct RunUpCase {
    /// Nominal slope of the foreshore.
    pub slope: f64,
    /// Nominal significant wave height of the open sea, m.
    pub hs_m: f64,
    /// Run-up that 2 % of the waves exceed by the program, m.
    pub run_up_m: f64,
    /// The same by the formula, m.
    pub expected_m: f64,
}

/// Run-up that 2 % of the waves exceed, m, by the formula of Stockdon et al. 2006.
pub fn stockdon_m(hs_m: f64, tp_s: f64, slope: f64) -> f64 {
    let wavelength_m = GRAVITY_M_S2 * tp_s * tp_s / TAU;
    let product = hs_m * wavelength_m;
    if slope / (hs_m / wavelength_m).sqrt() < 0.3 {
        return 0.043 * product.sqrt();
    }
    let set_up = 0.35 * slope * product.sqrt();
    let swash = (product * (0.563 * slope * slope + 0.004)).sqrt();
    1.1 * (set_up + swash / 2.0)
}

/// Run-up on plane beaches of all [`SLOPES`] for all [`HEIGHTS_M`].
///
/// # Errors
/// If a beach cannot be solved.
pub fn cases() -> Result<Vec<RunUpCase>, String> {
    let mut list = Vec::new();
    for slope in SLOPES {
        for (hs_m, tp_s) in HEIGHTS_M.into_iter().zip(PERIODS_S) {
            list.push(RunUpCase {
                slope,
                hs_m,
                run_up_m: run_up_m(slope, hs_m, tp_s)?,
                expected_m: stockdon_m(hs_m, tp_s, slope),
            });
        }
    }
    Ok(list)
}

/// Run-up of swell that comes straight to a plane beach of a slope, m.
fn run_up_m(slope: f64, hs_m: f64, tp_s: f64) -> Result<f64, String> {
    let (columns, rows, depth_m) = (48, 9, 12.0);
    let cell_m = 1.1 * depth_m / slope / (columns - 1) as f64;
    let beach = PlacedCoast {
        title: "Plane beach".into(),
        built_in: None,
        about: String::new(),
        bathymetry: Bathymetry::from_fn(columns, rows, cell_m, |x, _| depth_m - slope * x),
        structures: Vec::new(),
        toward_deg: 90.0,
        middle_m: [0.0; 2],
        notices: Vec::new(),
    };
    let params = parse_params(&format!("hs={hs_m}&tp={tp_s}&dir=270&swell=1&n=64"))?;
    let settings = CoastSettings { solver: Some(Solver::Parabolic), ..CoastSettings::default() };
    let sea = coast::run(&params, beach, &settings)?;
    sea.run_up.map(|found| found.run_up.two_percent_m).ok_or_else(|| "a beach without a shore".into())
}
