//! `seastate coast`: what a sea becomes over a coast. Solves the waves over its depths, draws maps, and writes fields,
//! gauges and a table.

mod fields;
mod figure;
mod gauges;
mod table;

pub use crate::coast::gauges::{Gauge, Gauges};

use crate::coast::elliptic;
use crate::coast::incident::{spectrum_bins, strongest_waves};
pub use crate::coast::open_sea::Solver;
use crate::coast::open_sea::{Arrival, MAX_OPEN_ANGLE_RAD, foreshore_slope, reflection};
use crate::coast::parabolic;
use crate::coast::runup::RunUp;
use crate::coast::sea_maps::bearing_from_deg;
use crate::coast::{Field, Incident, Options, PlacedCoast, SeaMaps};
use crate::state::{Params, query};
use crate::waves::Plan;
use crate::waves::statistics::SpectrumStatistics;
use std::f64::consts::TAU;

/// Bins of frequency and of direction that stand for the sea in maps of statistics.
const FREQUENCY_BINS: usize = 16;
const DIRECTION_BINS: usize = 35;
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
    /// For each gauge the waves of the surface there: amplitude (m), phase (rad) and angular frequency (rad/s).
    pub waves_at_gauges: Vec<Vec<[f64; 3]>>,
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
    let solver = settings.solver.unwrap_or_else(|| Solver::of(&coast));
    let arrival = Arrival::new(&plan, &coast, solver);
    let arriving = |waves: Vec<Incident>| waves.iter().filter_map(|wave| arrival.arriving(wave)).collect::<Vec<_>>();
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
    let reflection = reflection(&coast, open.hs_m, open.tp_s, gravity_m_s2);
    let solve = |waves: &[Incident], marched: Option<Field>| match (solver, marched) {
        (Solver::Parabolic, Some(field)) => field,
        (Solver::Parabolic, None) => parabolic::solve(&coast.bathymetry, waves, &options).0,
        (Solver::Elliptic, _) => elliptic::solve(&coast.bathymetry, waves, &dissipation, &reflection, &options),
    };
    let field = solve(&bins, Some(marched));
    let maps = SeaMaps::new(&coast.bathymetry, &field, &dissipation, gravity_m_s2);
    let gauges = gauges::read_gauges(&plan, &coast, &maps, &field, &settings.gauges_m)?;
    drop(field);
    let (mut surface_m, mut waves_at_gauges) = (Vec::new(), Vec::new());
    if settings.wave_count > 0 {
        let shortest_m = MIN_POINTS_PER_WAVE * coast.bathymetry.cell_m;
        let waves = strongest_waves(&plan, coast.placement(), settings.wave_count, shortest_m, MAX_OPEN_ANGLE_RAD);
        let waves = solve(&arriving(waves), None);
        surface_m = surface(&coast, &waves, params.clock.t_s);
        waves_at_gauges = gauges.list.iter().map(|gauge| waves_at(&waves, gauge.point)).collect();
    }
    let run_up = foreshore_slope(&coast).map(|slope| RunUpOnBeach {
        run_up: RunUp::new(open.shoreward_hs_m, gravity_m_s2 * open.tp_s * open.tp_s / TAU, slope),
        slope,
    });
    Ok(CoastSea { state: query::write(params), coast, open, maps, surface_m, gauges, waves_at_gauges, run_up })
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

impl CoastSea {
    /// Bearing (degrees clockwise from north) that waves come from which travel in a direction of the coast's frame (rad).
    fn bearing_of(&self, direction_rad: f64) -> f64 {
        bearing_from_deg(self.coast.toward_deg, direction_rad)
    }
}

/// One of the sixteen points of the compass for a bearing, degrees.
fn compass_point(deg: f64) -> &'static str {
    const POINTS: [&str; 16] =
        ["N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"];
    POINTS[((deg / 22.5).round() as usize) % 16]
}

#[cfg(test)]
mod tests;
