//! Maps of the waves of the drawn sea near a coast, and the gauges that the user places there. Both are computed in
//! slices of a frame while the panel shows them, and saved as files.

use super::App;
use super::coast::work_slice;
use super::derived::DerivedSeaData;
use super::language::text;
use crate::coast::Transfer;
use crate::coast::effect::CoastEffect;
use crate::coast::fields_file::CoastFields;
use crate::coast::gauges::{Gauge, Gauges};
use crate::coast::sea_maps::bearing_from_deg;
use crate::coast::transfer::{StatisticsSolver, TransferStatistics};
use crate::ocean::coast_task::{CoastKey, work_for};
use crate::point::buoy_record::BuoyRecord;
use crate::state::coast::Coast;
use std::cell::Cell;
use std::f64::consts::TAU;
use std::sync::Arc;
use web_time::Duration;

/// Largest number of gauges.
pub const MAX_GAUGES: usize = 4;
/// Length of the record that a frame adds to a gauge, s: 8 samples of 0.3 ms on a desktop.
const RECORDED_PER_FRAME_S: f64 = 2.0;
/// Time before the present at which the record of a gauge begins, s.
const RECORD_BEFORE_S: f64 = 120.0;
/// Time that the record of a gauge is ahead of the present, s.
pub const RECORD_AHEAD_S: f64 = 60.0;
/// Length of the record of a gauge, s.
pub const RECORD_LENGTH_S: f64 = 1790.0;
/// Time by which a record may lag behind the present, s, before it begins anew.
const LONGEST_LAG_S: f64 = 300.0;

/// A quantity that the map shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    Depth,
    #[default]
    Height,
    Direction,
    Breaking,
}

impl Quantity {
    /// All quantities, each with its name in the panel.
    pub const NAMES: [(Self, &'static str); 4] = [
        (Self::Depth, text!("Depth")),
        (Self::Height, text!("Wave height")),
        (Self::Direction, text!("Wave direction")),
        (Self::Breaking, text!("Breaking")),
    ];
}

/// The maps of the coast that is shown, and the gauges on it.
#[derive(Default)]
pub struct CoastMaps {
    /// Whether the panel shows the maps. Drawing them sets it, the next frame clears it.
    pub is_visible: Cell<bool>,
    /// The quantity that the map shows.
    pub quantity: Quantity,
    /// The gauges.
    pub gauges: Vec<PlacedGauge>,
    /// The coast of the maps and the gauges.
    coast: Coast,
    /// Transfer and sea of the maps that are being computed or were.
    of: Option<(Arc<Transfer>, CoastKey)>,
    solver: Option<(StatisticsSolver, f64)>,
    statistics: Option<Arc<TransferStatistics>>,
    effect: Option<CoastEffect>,
}

/// A gauge on the coast.
#[derive(Default)]
pub struct PlacedGauge {
    /// Column and row of the point where it stands.
    pub point: [usize; 2],
    /// Heights of the drawn sea there, m above the still water.
    pub record: BuoyRecord,
    /// Time of the first sample of the record, s.
    begun_s: f64,
}

impl CoastMaps {
    /// The maps; `None` in the open sea, and until they are computed.
    pub fn statistics(&self) -> Option<&Arc<TransferStatistics>> {
        self.statistics.as_ref()
    }

    /// How the coast changes the waves; `None` in the open sea, and until the maps are computed.
    pub fn effect(&self) -> Option<&CoastEffect> {
        self.effect.as_ref()
    }

    /// Fraction of the maps that is computed, while they are.
    pub fn progress(&self) -> Option<f64> {
        self.solver.as_ref().map(|(_, done)| *done)
    }

    /// Forgets the records of the gauges, because another surface is drawn.
    pub fn clear_records(&mut self) {
        self.gauges.iter_mut().for_each(|gauge| gauge.record.clear());
    }

    /// Places a gauge at the wet point nearest to (x, y), m, of the coast's frame.
    ///
    /// # Errors
    /// A text of the interface, in English: why there is none.
    pub fn place(&mut self, at_m: [f64; 2]) -> Result<(), &'static str> {
        let point = self.wet_point(at_m).ok_or(text!("There is no water there."))?;
        if self.gauges.len() >= MAX_GAUGES {
            return Err(text!("There is no room for more."));
        }
        self.gauges.push(PlacedGauge { point, ..PlacedGauge::default() });
        Ok(())
    }

    /// The point nearest to (x, y), m, of the coast's frame, if it is wet.
    pub fn wet_point(&self, at_m: [f64; 2]) -> Option<[usize; 2]> {
        let grid = &self.statistics.as_ref()?.bathymetry;
        let [i, j] = at_m.map(|at| (at / grid.cell_m).round());
        let is_inside = (0.0..grid.columns as f64).contains(&i) && (0.0..grid.rows as f64).contains(&j);
        (is_inside && grid.at(i as usize, j as usize) > 0.0).then_some([i as usize, j as usize])
    }

    /// Computes the maps of the sea that `transfer` draws, until `slice` is over. Returns whether there is more to do.
    fn advance(&mut self, transfer: &Arc<Transfer>, key: &CoastKey, app: &DerivedSeaData, slice: Duration) -> bool {
        let is_same = self.of.as_ref().is_some_and(|(of, sea)| Arc::ptr_eq(of, transfer) && sea.fits(&app.params));
        if !is_same {
            self.of = Some((transfer.clone(), key.clone()));
            self.solver = StatisticsSolver::new(transfer.clone(), &app.plan).map(|solver| (solver, 0.0));
            self.clear_records();
            return self.solver.is_some();
        }
        let Some((mut solver, _)) = self.solver.take() else { return false };
        let mut done = 0.0;
        work_for(slice, || {
            done = solver.step();
            done >= 1.0
        });
        if done < 1.0 {
            self.solver = Some((solver, done));
            return true;
        }
        let statistics = solver.finish();
        self.effect = CoastEffect::new(&statistics);
        self.statistics = Some(Arc::new(statistics));
        false
    }

    /// The gauges with their spectra. `density` is the variance density of the open sea, m^2 s, at an angular
    /// frequency, rad/s.
    pub fn gauges(&self, density: impl Fn(f64) -> f64) -> Option<Gauges> {
        let statistics = self.statistics.as_ref()?;
        let mut out = Gauges::default();
        for gauge in &self.gauges {
            let [i, j] = gauge.point;
            let bands = statistics.spectrum(i, j);
            out.frequencies_hz = bands.iter().map(|band| band.omega_rad_s / TAU).collect();
            out.open_m2_hz = bands.iter().map(|band| TAU * density(band.omega_rad_s)).collect();
            let here = bands.iter().zip(&out.open_m2_hz).map(|(b, open)| open * b.share());
            out.list.push(Gauge { spectrum_m2_hz: here.collect(), ..sea_at(statistics, gauge.point) });
        }
        Some(out)
    }
}

/// The sea at a point of the maps, without its spectrum.
pub fn sea_at(statistics: &TransferStatistics, [i, j]: [usize; 2]) -> Gauge {
    let (grid, maps) = (&statistics.bathymetry, &statistics.maps);
    let index = j * grid.columns + i;
    Gauge {
        point: [i, j],
        at_m: [i, j].map(|index| index as f64 * grid.cell_m),
        depth_m: grid.at(i, j),
        hs_m: f64::from(maps.hs_m[index]),
        tp_s: f64::from(maps.peak_period_s[index]),
        from_deg: bearing_from_deg(toward_deg(statistics), f64::from(maps.direction_rad[index])),
        breaking_fraction: f64::from(maps.breaking_fraction[index]),
        spectrum_m2_hz: Vec::new(),
    }
}

/// Bearing of the direction from the sea to the land, degrees clockwise from north.
pub fn toward_deg(statistics: &TransferStatistics) -> f64 {
    (statistics.transfer().placement.turn_rad.to_degrees() + 90.0).rem_euclid(360.0)
}

impl PlacedGauge {
    /// Adds a piece to the record, up to a minute ahead of the present `t_s` (s), and beyond until it is half an hour
    /// long. `height(t)` is the height of the sea (m) at `place` (x, z; m) at time t (s).
    fn advance(&mut self, t_s: f64, place: [f64; 2], height: impl Fn(f64) -> f64) {
        let ends = self.record.samples().front().zip(self.record.samples().back()).map(|(a, b)| [a[0], b[0]]);
        match ends {
            Some([first, last]) if (first..last + LONGEST_LAG_S).contains(&t_s) => {
                let until = (last + RECORDED_PER_FRAME_S).min(self.end_s(t_s));
                self.record.advance(until, place, height);
            }
            _ => {
                self.record.clear();
                self.begun_s = t_s - RECORD_BEFORE_S;
                self.record.advance(self.begun_s, place, height);
            }
        }
    }

    /// The time up to which the record is to reach, s.
    fn end_s(&self, t_s: f64) -> f64 {
        (self.begun_s + RECORD_LENGTH_S).max(t_s + RECORD_AHEAD_S)
    }

    /// Length of the record that is still to be computed at the time `t_s` (s), s.
    fn missing_s(&self, t_s: f64) -> f64 {
        self.record.samples().back().map_or(f64::INFINITY, |last| self.end_s(t_s) - last[0])
    }
}

impl App {
    /// Computes a slice of the maps and the records of the gauges, while the panel shows them.
    pub(super) fn advance_coast_maps(&mut self, ctx: &egui::Context) {
        let maps = &mut self.coast.maps;
        if maps.coast != self.params.coast {
            // Gauges belong to their coast, but not to its place.
            let is_other = (maps.coast.name, &maps.coast.file) != (self.params.coast.name, &self.params.coast.file);
            let gauges = if is_other { Vec::new() } else { std::mem::take(&mut maps.gauges) };
            let (coast, quantity) = (self.params.coast.clone(), maps.quantity);
            *maps = CoastMaps { coast, quantity, gauges, is_visible: maps.is_visible.clone(), ..CoastMaps::default() };
            maps.clear_records();
        }
        if !maps.is_visible.take() || !self.is_coast_shown() {
            return;
        }
        let (Some(transfer), Some(key)) = (self.coast.shown().1, CoastKey::of(&self.params)) else { return };
        let mut has_more = self.coast.maps.advance(&transfer, &key, &self.derived, work_slice(ctx));
        if !has_more {
            has_more = self.advance_gauges(&transfer);
        }
        if has_more {
            ctx.request_repaint();
        }
    }

    /// Adds a piece to the record of the gauge that lacks most. Returns whether there is more to do.
    fn advance_gauges(&mut self, transfer: &Transfer) -> bool {
        let t_s = self.params.clock.t_s;
        let (sea, level_m) = (self.derived.strongest_waves(), self.params.sea.still_water_level_m);
        let gauges = &mut self.coast.maps.gauges;
        let lacking = gauges.iter_mut().max_by(|a, b| a.missing_s(t_s).total_cmp(&b.missing_s(t_s)));
        let Some(gauge) = lacking.filter(|gauge| gauge.missing_s(t_s) > 0.25) else { return false };
        let [x, z] = transfer.world_m(gauge.point.map(|index| index as f64 * transfer.cell_m));
        gauge.advance(t_s, [x, z], |t_s| sea.sample(x, z, t_s).height_m - level_m);
        true
    }

    /// Saves the maps as NetCDF.
    pub(super) fn save_coast_fields(&mut self) {
        let Some(statistics) = self.coast.maps.statistics().cloned() else { return };
        let fields = CoastFields {
            title: &self.coast_title(),
            source: &format!("Seastate {}", self.state()),
            toward_deg: toward_deg(&statistics),
            bathymetry: &statistics.bathymetry,
            maps: &statistics.maps,
            surface_m: &[],
        };
        let bytes = fields.netcdf();
        self.save(&self.coast_file_name("", "nc"), &bytes);
    }

    /// Saves the gauges with their spectra as CSV.
    pub(super) fn save_coast_gauges(&mut self) {
        let Some(gauges) = self.coast.maps.gauges(|omega| self.derived.plan.density(omega)) else { return };
        let text = gauges.csv(&format!("Seastate {}", self.state()), &self.coast_title());
        self.save(&self.coast_file_name("-gauges", "csv"), text.as_bytes());
    }

    /// Title of the coast, in English; empty in the open sea.
    fn coast_title(&self) -> String {
        self.coast.shown().0.map_or_else(String::new, |land| land.title.clone())
    }

    /// File name with the coast and the wind speed (m/s), such as `seastate-beach-gauges-wind14.csv`.
    fn coast_file_name(&self, what: &str, ending: &str) -> String {
        let (coast, wind_m_s) = (self.params.coast.name.word(), self.params.sea.first_system().wind_m_s);
        format!("seastate-{coast}{what}-wind{wind_m_s:.0}.{ending}")
    }
}
