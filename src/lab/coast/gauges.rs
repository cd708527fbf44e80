//! The sea at gauges of a solved coast, and records of the surface there.

use super::CoastSea;
use crate::coast::gauges::{Gauge, Gauges};
use crate::coast::sea_maps::bearing_from_deg;
use crate::coast::{Field, PlacedCoast, SeaMaps};
use crate::waves::Plan;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Largest number of gauges.
const MAX_GAUGES: usize = 100;
/// Largest number of samples of a record, times times gauges.
const MAX_SAMPLES: f64 = 5e6;

/// Reads the sea at points (x, y; m) off the solved bins of a sea's spectrum.
///
/// # Errors
/// One sentence, if a point lies outside the coast or there are too many.
pub(super) fn read_gauges(
    plan: &Plan,
    coast: &PlacedCoast,
    maps: &SeaMaps,
    field: &Field,
    points_m: &[[f64; 2]],
) -> Result<Gauges, String> {
    if points_m.len() > MAX_GAUGES {
        return Err(format!("{} gauges, but at most {MAX_GAUGES} are possible", points_m.len()));
    }
    // Components of one frequency, by the bits of the frequency, which is positive: their order is that of the numbers.
    let mut groups: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for (c, component) in field.components.iter().enumerate() {
        groups.entry(component.incident.omega_rad_s.to_bits()).or_default().push(c);
    }
    let omegas: Vec<f64> = groups.keys().map(|bits| f64::from_bits(*bits)).collect();
    let all: f64 = plan.spectrum_integrals.m0_between_wave_numbers(0.0, plan.k_max());
    let bin_m2 = all / super::FREQUENCY_BINS as f64;
    let open_m2_hz: Vec<f64> = omegas.iter().map(|omega| TAU * plan.density(*omega)).collect();
    let side_m = coast.side_m();
    let grid = &coast.bathymetry;
    let gauge = |at_m: &[f64; 2]| {
        if !at_m.iter().zip(side_m).all(|(at, side)| (-1e-6..=side + 1e-6).contains(at)) {
            let ([x, y], [wide, long]) = (at_m, side_m);
            return Err(format!(
                "the gauge {x},{y} lies outside the coast: x is 0 to {wide:.0} m from the sea to the land, y 0 to \
                 {long:.0} m along the shore"
            ));
        }
        let [i, j] = at_m.map(|at| (at / grid.cell_m).round() as usize);
        let (i, j) = (i.min(grid.columns - 1), j.min(grid.rows - 1));
        let index = j * grid.columns + i;
        // The share of each bin's variance that is left is the share of the density.
        let density = |(group, open): (&Vec<usize>, &f64)| {
            let here: f64 = group.iter().map(|c| 0.5 * field.amplitude(*c, i, j).norm_squared()).sum();
            open * here / bin_m2
        };
        Ok(Gauge {
            point: [i, j],
            at_m: [i, j].map(|index| index as f64 * grid.cell_m),
            depth_m: grid.at(i, j),
            hs_m: f64::from(maps.hs_m[index]),
            tp_s: f64::from(maps.peak_period_s[index]),
            from_deg: bearing_from_deg(coast.toward_deg, f64::from(maps.direction_rad[index])),
            breaking_fraction: f64::from(maps.breaking_fraction[index]),
            spectrum_m2_hz: groups.values().zip(&open_m2_hz).map(density).collect(),
        })
    };
    let list = points_m.iter().map(gauge).collect::<Result<_, String>>()?;
    let frequencies_hz = omegas.iter().map(|omega| omega / TAU).collect();
    Ok(Gauges { frequencies_hz, open_m2_hz, list })
}

impl CoastSea {
    /// Writes the elevation of the surface at the gauges over time, from `t_s` (s) on, as a table.
    ///
    /// # Errors
    /// One sentence, if the length or the rate is out of range.
    pub fn record_csv(&self, t_s: f64, hours: f64, rate_hz: f64) -> Result<String, String> {
        let count = (hours * 3600.0 * rate_hz).round();
        if !(count >= 1.0 && hours > 0.0) {
            return Err("the hours and the rate of a record must be above 0".into());
        }
        if count * self.gauges.list.len() as f64 > MAX_SAMPLES {
            return Err(format!("more than {MAX_SAMPLES} samples: record fewer hours or gauges, or with a lower rate"));
        }
        let mut out = format!("# seastate coast '{}': elevation of the surface at the gauges\nt_s", self.state);
        out.extend((1..=self.gauges.list.len()).map(|i| format!(",eta{i}_m")));
        out.push('\n');
        for step in 0..count as usize {
            let t = t_s + step as f64 / rate_hz;
            let _ = write!(out, "{t}");
            for waves in &self.waves_at_gauges {
                let eta: f64 =
                    waves.iter().map(|[amplitude, phase, omega]| amplitude * (phase - omega * t).cos()).sum();
                let _ = write!(out, ",{eta:.4}");
            }
            out.push('\n');
        }
        Ok(out)
    }
}
