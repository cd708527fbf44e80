//! `seastate coast`: what a sea becomes over a coast. Solves the waves over its depths, draws maps, and writes fields,
//! gauges and a table.

mod fields;
mod figure;
mod gauges;
mod table;

pub use gauges::{Gauge, Gauges};

use crate::coast::approach::approach;
use crate::coast::elliptic;
use crate::coast::incident::{spectrum_bins, strongest_waves};
use crate::coast::parabolic;
use crate::coast::runup::RunUp;
use crate::coast::structure::reflection_at;
use crate::coast::{Field, Incident, Options, PlacedCoast, SeaMaps};
use crate::state::{Params, query};
use crate::waves::Plan;
use crate::waves::statistics::SpectrumStatistics;
use std::f64::consts::TAU;

/// Bins of frequency and of direction that stand for the sea in maps of statistics.
const FREQUENCY_BINS: usize = 16;
const DIRECTION_BINS: usize = 35;
/// Largest angle from straight shoreward, rad, of waves in the open sea (85 degrees).
const MAX_OPEN_ANGLE_RAD: f64 = 1.484;
/// Depth, m, that counts for a sea without a bed.
const DEEP_M: f64 = 1e5;
/// Points per wave that the surface is drawn with at least.
const MIN_POINTS_PER_WAVE: f64 = 5.0;

/// What is asked of the sea over a coast.
#[derive(Clone, Debug, Default)]
pub struct CoastSettings {
    /// Gauges: points x, y in the frame of the coast, m.
    pub gauges_m: Vec<[f64; 2]>,
    /// Number of waves that are summed for the picture of the surface and for records; 0 leaves them out.
    pub wave_count: usize,
    /// Which equation is solved; `None` lets the coast decide: the elliptic one where there are structures.
    pub solver: Option<Solver>,
}

/// An equation of the waves over a coast (docs/design/coast.md).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// The parabolic mild-slope equation: waves that travel shoreward. Structures absorb them.
    Parabolic,
    /// The elliptic mild-slope equation: waves in all directions, which structures and steep shores reflect.
    Elliptic,
}

impl Solver {
    /// Largest angle from straight shoreward of the waves that are solved, rad.
    fn max_angle_rad(self) -> f64 {
        match self {
            Self::Parabolic => parabolic::MAX_ANGLE_RAD,
            Self::Elliptic => elliptic::MAX_ANGLE_RAD,
        }
    }
}

/// The sea before the coast.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenSea {
    /// Significant wave height, m, of all waves, and of those that travel towards the land.
    pub hs_m: f64,
    /// Significant wave height, m, of the waves that travel towards the land.
    pub shoreward_hs_m: f64,
    /// Peak period, s.
    pub tp_s: f64,
    /// Mean direction that the waves come from, degrees clockwise from north; `None` if no direction dominates.
    pub from_deg: Option<f64>,
    /// Water depth, m; infinite for deep water.
    pub depth_m: f64,
}

/// A sea over a coast.
pub struct CoastSea {
    /// State string of the sea.
    pub state: String,
    /// The coast.
    pub coast: PlacedCoast,
    /// The sea before it.
    pub open: OpenSea,
    /// Statistics at its points.
    pub maps: SeaMaps,
    /// Elevation of the surface at the state's time, m, as a sum of the strongest waves; empty if there are none.
    pub surface_m: Vec<f32>,
    /// The sea at the gauges.
    pub gauges: Gauges,
    /// Run-up on the beach; `None` where no water meets land.
    pub run_up: Option<RunUpOnBeach>,
}

/// Run-up on the beach of a coast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunUpOnBeach {
    /// By the formula of Stockdon et al. 2006.
    pub run_up: RunUp,
    /// Slope of the foreshore, height over length: the median along the shore.
    pub slope: f64,
}

/// Solves the sea of `params` over a coast.
///
/// # Errors
/// One sentence, if the sea has no waves that travel towards the land, or a gauge lies outside the coast.
pub fn run(params: &Params, coast: PlacedCoast, settings: &CoastSettings) -> Result<CoastSea, String> {
    let plan = Plan::new(params);
    let gravity_m_s2 = plan.sea.gravity_m_s2;
    let options = Options { gravity_m_s2, ..Options::default() };
    let open_depth_m = if plan.dispersion.depth_m().is_finite() { plan.dispersion.depth_m() } else { DEEP_M };
    let edge_m = edge_depth_m(&coast);
    let by_coast = if coast.structures.is_empty() { Solver::Parabolic } else { Solver::Elliptic };
    let solver = settings.solver.unwrap_or(by_coast);
    let arriving = |waves: Vec<Incident>| -> Vec<Incident> {
        let arrive = waves.iter().filter_map(|wave| approach(wave, open_depth_m, edge_m, gravity_m_s2));
        arrive.filter(|wave| wave.direction_rad.abs() < solver.max_angle_rad()).collect()
    };
    let bins = spectrum_bins(&plan, coast.turn_rad(), FREQUENCY_BINS, DIRECTION_BINS, MAX_OPEN_ANGLE_RAD);
    let shoreward_m2: f64 = bins.iter().map(Incident::variance_m2).sum();
    let bins = arriving(bins);
    if bins.is_empty() {
        return Err(format!(
            "no waves of this sea travel towards the land, which lies towards {:.0}°: change the direction of the sea \
             (dir) or turn the coast (--toward)",
            coast.toward_deg
        ));
    }
    let statistics = SpectrumStatistics::new(&plan);
    let open = OpenSea {
        hs_m: statistics.hs_m,
        shoreward_hs_m: 4.0 * shoreward_m2.sqrt(),
        tp_s: statistics.tp_s,
        from_deg: statistics.mean_from_deg,
        depth_m: plan.dispersion.depth_m(),
    };
    // Waves break together, which the parabolic equation finds out on their way.
    let (marched, dissipation) = parabolic::solve(&coast.bathymetry, &bins, &options);
    let reflection = reflection(&coast, open.hs_m, gravity_m_s2 * open.tp_s * open.tp_s / TAU);
    let solve = |waves: &[Incident], marched: Option<Field>| match (solver, marched) {
        (Solver::Parabolic, Some(field)) => field,
        (Solver::Parabolic, None) => parabolic::solve(&coast.bathymetry, waves, &options).0,
        (Solver::Elliptic, _) => elliptic::solve(&coast.bathymetry, waves, &dissipation, &reflection, &options),
    };
    let field = solve(&bins, Some(marched));
    let maps = SeaMaps::new(&coast.bathymetry, &field, &dissipation, gravity_m_s2);
    let mut gauges = Gauges::new(&plan, &coast, &maps, &field, &settings.gauges_m)?;
    drop(field);
    let mut surface_m = Vec::new();
    if settings.wave_count > 0 {
        let shortest_m = MIN_POINTS_PER_WAVE * coast.bathymetry.cell_m;
        let waves = strongest_waves(&plan, coast.placement(), settings.wave_count, shortest_m, MAX_OPEN_ANGLE_RAD);
        let waves = solve(&arriving(waves), None);
        surface_m = surface(&coast, &waves, params.clock.t_s);
        gauges.waves = gauges.list.iter().map(|gauge| waves_at(&waves, gauge.point)).collect();
    }
    let run_up = foreshore_slope(&coast).map(|slope| RunUpOnBeach {
        run_up: RunUp::new(open.shoreward_hs_m, gravity_m_s2 * open.tp_s * open.tp_s / TAU, slope),
        slope,
    });
    Ok(CoastSea { state: query::write(params), coast, open, maps, surface_m, gauges, run_up })
}

/// Reflection coefficient of each point of land: that of a structure beside it, else by the slope of the shore for a sea
/// of the height `hs_m` (m) with waves of `wavelength_m` (m) in deep water.
pub(in crate::lab) fn reflection(coast: &PlacedCoast, hs_m: f64, wavelength_m: f64) -> Vec<f32> {
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
pub(in crate::lab) fn edge_depth_m(coast: &PlacedCoast) -> f64 {
    let grid = &coast.bathymetry;
    let wet: Vec<f64> = (0..grid.rows).map(|j| grid.at(0, j)).filter(|depth_m| *depth_m > 0.5).collect();
    wet.iter().sum::<f64>() / wet.len().max(1) as f64
}

/// Elevation of the surface (m) at all points; 0 on land.
fn surface(coast: &PlacedCoast, waves: &Field, t_s: f64) -> Vec<f32> {
    let grid = &coast.bathymetry;
    let at = |index: usize| {
        let (i, j) = (index % grid.columns, index / grid.columns);
        if grid.at(i, j) > 0.0 { waves.elevation_m(i, j, t_s) as f32 } else { 0.0 }
    };
    (0..grid.columns * grid.rows).map(at).collect()
}

/// Amplitude (m), phase (rad) and angular frequency (rad/s) of each wave at a point (i, j): its elevation is amplitude
/// times cos(phase - omega t).
fn waves_at(field: &Field, [i, j]: [usize; 2]) -> Vec<[f64; 3]> {
    let at = |c: usize| {
        let amplitude = field.amplitude(c, i, j);
        [amplitude.modulus(), amplitude.argument(), field.components[c].incident.omega_rad_s]
    };
    (0..field.components.len()).map(at).collect()
}

/// Median slope of the shore where the first land from the sea meets the water, height over length, between the points on
/// both sides of the waterline. `None` if there is none.
fn foreshore_slope(coast: &PlacedCoast) -> Option<f64> {
    let grid = &coast.bathymetry;
    let slope = |j: usize| {
        let land = (1..grid.columns).find(|i| grid.at(*i, j) <= 0.0)?;
        Some((grid.at(land - 1, j) - grid.at(land, j)) / grid.cell_m)
    };
    let mut slopes: Vec<f64> = (0..grid.rows).filter_map(slope).collect();
    slopes.sort_by(f64::total_cmp);
    slopes.get(slopes.len() / 2).map(|slope| slope.clamp(0.005, 0.5))
}

impl CoastSea {
    /// Bearing (degrees clockwise from north) that waves come from which travel in a direction of the coast's frame (rad).
    fn bearing_of(&self, direction_rad: f64) -> f64 {
        bearing_from_deg(&self.coast, direction_rad)
    }
}

fn bearing_from_deg(coast: &PlacedCoast, direction_rad: f64) -> f64 {
    (coast.toward_deg + direction_rad.to_degrees() + 180.0).rem_euclid(360.0)
}

/// One of the sixteen points of the compass for a bearing, degrees.
fn compass_point(deg: f64) -> &'static str {
    const POINTS: [&str; 16] =
        ["N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"];
    POINTS[((deg / 22.5).round() as usize) % 16]
}

#[cfg(test)]
mod tests;
