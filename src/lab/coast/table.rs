//! The table of a sea over a coast: the open sea, the sea at several depths, the gauges, and the run-up.

use super::{CoastSea, compass_point};
use crate::coast::open_sea::edge_depth_m;
use std::fmt;

/// Depths of the lines of the table, m.
pub(super) const DEPTHS_M: [f64; 3] = [10.0, 5.0, 2.0];

/// Steepest slope of a sea bed (Booij 1983).
const MOST_SLOPE: f64 = 1.0 / 3.0;

/// The sea along a contour of the depth, or along the side that faces the open sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeaAtDepth {
    /// Depth, m.
    pub depth_m: f64,
    /// Significant wave height, m: the root of the mean square.
    pub hs_m: f64,
    /// Smallest and largest significant wave height along the contour, m.
    pub range_m: [f64; 2],
    /// Mean of the peak periods, s.
    pub tp_s: f64,
    /// Mean direction that the waves come from, degrees clockwise from north.
    pub from_deg: f64,
    /// Mean fraction of the waves that break, 0 to 1.
    pub breaking_fraction: f64,
}

impl CoastSea {
    /// The sea where the water coming from the open sea first becomes as shallow as `depth_m` (m); `None` if it does so
    /// nowhere.
    pub fn at_depth(&self, depth_m: f64) -> Option<SeaAtDepth> {
        let grid = &self.coast.bathymetry;
        let place = |j: usize| {
            let i = (1..grid.columns).find(|i| grid.at(*i, j) <= depth_m && grid.at(*i - 1, j) > depth_m)?;
            let (deep, shallow) = (grid.at(i - 1, j), grid.at(i, j));
            // Where the bed is steeper than the mild-slope equation allows, it is the foot of a structure, before which
            // reflected waves stand.
            let is_bed = shallow > 0.0 && deep - shallow < MOST_SLOPE * grid.cell_m;
            is_bed.then(|| (j * grid.columns + i - 1, (deep - depth_m) / (deep - shallow)))
        };
        self.mean(depth_m, (0..grid.rows).filter_map(place))
    }

    /// The sea at the side that faces the open sea.
    pub fn at_edge(&self) -> Option<SeaAtDepth> {
        let grid = &self.coast.bathymetry;
        let wet = (0..grid.rows).filter(|j| grid.at(0, *j) > 0.5).map(|j| (j * grid.columns, 0.0));
        self.mean(edge_depth_m(&self.coast), wet)
    }

    /// The mean sea at places: each the index of a point, and how far the place lies on the way to the next column.
    fn mean(&self, depth_m: f64, places: impl Iterator<Item = (usize, f64)>) -> Option<SeaAtDepth> {
        let (mut count, mut sums, mut heading, mut range) = (0, [0.0; 3], [0.0; 2], [f64::INFINITY, 0.0]);
        for (index, t) in places {
            let at = |map: &[f32]| {
                let next = if t > 0.0 { f64::from(map[index + 1]) } else { 0.0 };
                (1.0 - t) * f64::from(map[index]) + t * next
            };
            let hs_m = at(&self.maps.hs_m);
            let direction = f64::from(self.maps.direction_rad[index]);
            sums = [
                sums[0] + hs_m * hs_m,
                sums[1] + at(&self.maps.peak_period_s),
                sums[2] + at(&self.maps.breaking_fraction),
            ];
            heading = [heading[0] + hs_m * hs_m * direction.cos(), heading[1] + hs_m * hs_m * direction.sin()];
            range = [f64::min(range[0], hs_m), f64::max(range[1], hs_m)];
            count += 1;
        }
        let mean = sums.map(|sum| sum / f64::from(count));
        (count > 0).then(|| SeaAtDepth {
            depth_m,
            hs_m: mean[0].sqrt(),
            range_m: range,
            tp_s: mean[1],
            from_deg: self.bearing_of(heading[1].atan2(heading[0])),
            breaking_fraction: mean[2],
        })
    }
}

/// A bearing in degrees with its point of the compass.
fn bearing(deg: f64) -> String {
    format!("{:.0}° {}", deg.rem_euclid(360.0), compass_point(deg.rem_euclid(360.0)))
}

impl fmt::Display for CoastSea {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let coast = &self.coast;
        let [wide, long] = coast.side_m();
        writeln!(f, "{}. {}", coast.title, coast.about)?;
        writeln!(
            f,
            "{wide:.0} m towards the land, which lies towards {}, and {long:.0} m along the shore, in cells of {} m\n",
            bearing(coast.toward_deg),
            (coast.bathymetry.cell_m * 100.0).round() / 100.0
        )?;
        let row = |f: &mut fmt::Formatter<'_>, cells: [&str; 7]| {
            let [name, depth, hs, range, tp, from, breaking] = cells;
            writeln!(f, "{name:<20} {depth:>8} {hs:>7} {range:>11} {tp:>7} {from:>9} {breaking:>9}")
        };
        row(f, ["", "depth, m", "Hs, m", "range, m", "Tp, s", "from", "breaking"])?;
        let open = &self.open;
        let depth = if open.depth_m.is_finite() { format!("{:.0}", open.depth_m) } else { "deep".into() };
        let from = open.from_deg.map_or_else(String::new, bearing);
        row(f, ["open sea", &depth, &format!("{:.2}", open.hs_m), "", &format!("{:.1}", open.tp_s), &from, ""])?;
        let write = |f: &mut fmt::Formatter<'_>, name: &str, sea: &SeaAtDepth| {
            let range = format!("{:.2} - {:.2}", sea.range_m[0], sea.range_m[1]);
            let breaking = format!("{:.1} %", 100.0 * sea.breaking_fraction);
            let [depth, hs, tp] =
                [format!("{:.1}", sea.depth_m), format!("{:.2}", sea.hs_m), format!("{:.1}", sea.tp_s)];
            row(f, [name, &depth, &hs, &range, &tp, &bearing(sea.from_deg), &breaking])
        };
        if let Some(edge) = self.at_edge() {
            write(f, "edge of the map", &edge)?;
        }
        for depth_m in DEPTHS_M {
            if let Some(sea) = self.at_depth(depth_m) {
                write(f, &format!("{depth_m:.0} m of water"), &sea)?;
            }
        }
        for (number, gauge) in self.gauges.list.iter().enumerate() {
            let [x, y] = gauge.at_m;
            let name = format!("gauge {} {x:.0},{y:.0}", number + 1);
            let breaking = format!("{:.1} %", 100.0 * gauge.breaking_fraction);
            let [depth, hs, tp] =
                [format!("{:.1}", gauge.depth_m), format!("{:.2}", gauge.hs_m), format!("{:.1}", gauge.tp_s)];
            row(f, [&name, &depth, &hs, "", &tp, &bearing(gauge.from_deg), &breaking])?;
        }
        if let Some(beach) = &self.run_up {
            writeln!(
                f,
                "\nrun-up: 2 % of the waves reach more than {:.2} m above the still water on a foreshore of {:.1} %; the mean \
                 water level at the shore (set-up) is {:.2} m above it",
                beach.run_up.two_percent_m,
                100.0 * beach.slope,
                beach.run_up.set_up_m
            )?;
        }
        Ok(())
    }
}
