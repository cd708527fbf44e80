//! Six small coasts that come with the program, as smooth functions of x and y in the frame of a coast: 1 to 2 km a side,
//! with open water at x = 0 and land at the far side.
//!
//! Beaches have the equilibrium profile of Dean 1977, depth = A distance^(2/3), with a foreshore of 8 % where that profile
//! would be vertical; behind them lie a berm and dunes. Cliffs are up to 30 m high. No coast is a real place.

mod coasts;
mod land;

use super::bathymetry::Bathymetry;
use super::seamark::Seamark;
use super::structure::Structure;

/// A coast that comes with the program.
#[derive(Clone, Copy, Debug)]
pub struct BuiltInCoast {
    /// Its name in commands.
    pub name: &'static str,
    /// Its title.
    pub title: &'static str,
    /// What it shows, in one sentence.
    pub about: &'static str,
    /// Bearing of its x axis, which points from the sea to the land, degrees clockwise from north, unless the user turns
    /// it.
    pub toward_deg: f64,
    /// Lengths of its sides along x and along y, m.
    pub side_m: [f64; 2],
    /// Depth (m, negative on land) at x and y (m), without its structures.
    pub depth_m: fn(f64, f64) -> f64,
    /// Its breakwaters and walls.
    pub structures: fn() -> Vec<Structure>,
    /// Seamarks of the coast: lighthouses, harbour lights and beacons.
    pub seamarks: &'static [Seamark],
}

/// The coasts. They face the south-west, from where the wind of the default sea blows; the beach faces the west, so that
/// the waves of that sea arrive obliquely.
pub static BUILT_IN: [BuiltInCoast; 6] = [
    BuiltInCoast {
        name: "beach",
        title: "Straight beach",
        about: "A long sandy beach before dunes: waves that arrive obliquely turn towards the shore, grow and break.",
        toward_deg: 90.0,
        side_m: [1500.0, 1500.0],
        depth_m: coasts::beach,
        structures: Vec::new,
        seamarks: &[coasts::BEACH_LIGHTHOUSE],
    },
    BuiltInCoast {
        name: "headland",
        title: "Headland and bay",
        about: "A rocky headland beside a bay: waves bend towards the headland and leave the bay calmer.",
        toward_deg: 60.0,
        side_m: [1600.0, 1600.0],
        depth_m: coasts::headland,
        structures: Vec::new,
        seamarks: &[coasts::HEADLAND_LIGHTHOUSE],
    },
    BuiltInCoast {
        name: "island",
        title: "Island with a lee",
        about: "An island before a beach: behind it the sea is calmer, and waves that bend around both ends cross.",
        toward_deg: 60.0,
        side_m: [1600.0, 1600.0],
        depth_m: coasts::island,
        structures: Vec::new,
        seamarks: &[coasts::ISLAND_LIGHTHOUSE],
    },
    BuiltInCoast {
        name: "harbour",
        title: "Harbour with breakwaters",
        about: "Two breakwaters of rubble around a basin with a quay: waves spread from the entrance into the calm.",
        toward_deg: 60.0,
        side_m: [1400.0, 1400.0],
        depth_m: coasts::harbour,
        structures: coasts::harbour_structures,
        seamarks: &coasts::HARBOUR_LIGHTS,
    },
    BuiltInCoast {
        name: "bar",
        title: "Bar and channel",
        about: "A sand bar along a beach, cut by a channel: waves break on the bar and pass the channel unbroken.",
        toward_deg: 60.0,
        side_m: [1400.0, 1400.0],
        depth_m: coasts::bar,
        structures: Vec::new,
        seamarks: &coasts::BAR_SEAMARKS,
    },
    BuiltInCoast {
        name: "shoal",
        title: "Elliptic shoal",
        about: "An underwater hill that focuses waves like a lens: the laboratory shoal of Berkhoff, Booij and Radder \
                1982, fifty times enlarged.",
        toward_deg: 60.0,
        side_m: [1800.0, 1206.0],
        depth_m: coasts::shoal,
        structures: Vec::new,
        seamarks: &[],
    },
];

impl BuiltInCoast {
    /// The coast of this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        BUILT_IN.iter().find(|coast| coast.name == name)
    }

    /// Its depths on a grid with cells of about `cell_m` (m) that cover it, with its structures.
    pub fn bathymetry(&self, cell_m: f64) -> Bathymetry {
        let count = |side_m: f64| (side_m / cell_m).round().max(1.0) as usize + 1;
        let [columns, rows] = self.side_m.map(count);
        let mut grid = Bathymetry::from_fn(columns, rows, cell_m, self.depth_m);
        (self.structures)().iter().for_each(|structure| structure.build_in(&mut grid));
        grid
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::SeamarkKind;

    #[test]
    fn every_coast_has_sea_before_and_land_behind() {
        for coast in &BUILT_IN {
            let [wide, long] = coast.side_m;
            for step in 0..=400 {
                let y = long * f64::from(step) / 400.0;
                let (edge, end) = ((coast.depth_m)(0.0, y), (coast.depth_m)(wide, y));
                assert!((8.0..25.0).contains(&edge), "{}: {edge} m at the sea's edge, y {y}", coast.name);
                assert!(end < -1.0, "{}: depth {end} m at the land's edge, y {y}", coast.name);
            }
            assert!(coast.side_m.iter().all(|side| (1000.0..=2000.0).contains(side)));
            assert!(coast.about.ends_with('.') && coast.about.len() < 160, "{}", coast.name);
            assert!(std::ptr::eq(BuiltInCoast::find(coast.name).expect("a name"), coast));
        }
        assert!(BuiltInCoast::find("atlantis").is_none());
    }

    /// No step, no needle: neighbouring metres differ by less than the slope of a cliff, and slopes change gradually.
    #[test]
    fn every_coast_is_smooth_and_of_moderate_height() {
        for coast in &BUILT_IN {
            let [wide, long] = coast.side_m;
            let mut highest: f64 = 0.0;
            for step in 0..60_000 {
                let (x, y) = (wide * (f64::from(step) * 0.618_034).fract(), long * f64::from(step) / 60_000.0);
                let at = |x: f64, y: f64| (coast.depth_m)(x, y);
                let here = at(x, y);
                assert!(here.is_finite() && here < 25.0, "{}: {here} m at {x} {y}", coast.name);
                highest = highest.max(-here);
                for [dx, dy] in [[1.0, 0.0], [0.0, 1.0]] {
                    let slope = at(x + dx, y + dy) - here;
                    assert!(slope.abs() < 1.5, "{}: slope {slope} at {x} {y}", coast.name);
                    let bend = slope - (here - at(x - dx, y - dy));
                    assert!(bend.abs() < 0.3, "{}: slope changes by {bend} a metre at {x} {y}", coast.name);
                }
            }
            assert!((1.0..=30.0).contains(&highest), "{}: {highest} m", coast.name);
        }
    }

    #[test]
    fn each_coast_is_what_it_says() {
        let depth = |name: &str, x: f64, y: f64| (BuiltInCoast::find(name).expect("a coast").depth_m)(x, y);
        // Where the land begins along a line of constant y.
        let shore = |name: &str, y: f64| (0..2000).map(f64::from).find(|x| depth(name, *x, y) < 0.0).expect("land");
        // The beach is straight to 30 m, and has Dean's profile: 0.1 x 300^(2/3) = 4.48 m, 300 m before the shore.
        let shores: Vec<f64> = (0..16).map(|i| shore("beach", 100.0 * f64::from(i))).collect();
        let (low, high) = shores.iter().fold((f64::MAX, f64::MIN), |(a, b), s| (a.min(*s), b.max(*s)));
        assert!(high - low < 30.0 && high > low, "{shores:?}");
        assert!((depth("beach", shore("beach", 750.0) - 300.0, 750.0) / 4.48 - 1.0).abs() < 0.08);
        // The headland reaches hundreds of metres farther out than the bay, and is a cliff.
        assert!(shore("headland", 600.0) < shore("headland", 1150.0) - 300.0);
        assert!(depth("headland", shore("headland", 600.0) + 60.0, 600.0) < -15.0);
        // Behind the island is water again, then the mainland.
        let island = shore("island", 800.0);
        assert!(island < 800.0 && depth("island", island + 450.0, 800.0) > 2.0 && depth("island", 1590.0, 800.0) < 0.0);
        // The bar is shallower than the water before and behind it; in the channel it is not.
        let profile =
            |y: f64| -> Vec<f64> { (20..400).map(|d| depth("bar", shore("bar", y) - f64::from(d), y)).collect() };
        let dips = |p: &[f64]| p.windows(2).filter(|w| w[1] < w[0] - 1e-3).count();
        assert!(dips(&profile(200.0)) > 30, "a bar has a trough behind it");
        let least = |p: &[f64]| p[80..300].iter().copied().fold(f64::MAX, f64::min);
        assert!(least(&profile(200.0)) < 1.8 && least(&profile(700.0)) > 3.0, "the channel is deep");
        // The basin of the harbour is dredged, and land at the quay.
        assert!(depth("harbour", 1000.0, 700.0) > 5.0 && depth("harbour", 1250.0, 700.0) < -2.0);
    }

    #[test]
    fn the_shoal_has_the_published_geometry() {
        let shoal = BuiltInCoast::find("shoal").expect("a shoal").depth_m;
        // Berkhoff, Booij and Radder 1982: 0.45 m of water before the slope of 1 in 50, which begins 5.82 m before the
        // middle of the shoal and is turned by 20 degrees; the shoal rises 0.2 m above the slope in its middle.
        let scale = 50.0;
        let at = |x: f64, y: f64| {
            let (sin, cos) = 20.0_f64.to_radians().sin_cos();
            let (u, v) = (x * cos + y * sin, -x * sin + y * cos);
            shoal(coasts::SHOAL_MIDDLE_M[0] + u * scale, coasts::SHOAL_MIDDLE_M[1] + v * scale) / scale
        };
        assert!((at(-8.0, 0.0) - 0.45).abs() < 0.002, "{}", at(-8.0, 0.0));
        assert!((at(0.0, 0.0) - (0.45 - 0.02 * 5.82 - 0.2)).abs() < 1e-3, "{}", at(0.0, 0.0));
        assert!((at(5.0, 0.0) - (0.45 - 0.02 * 10.82)).abs() < 1e-3, "beyond the shoal is the slope");
        assert!((at(0.0, 4.1) - (0.45 - 0.02 * 5.82)).abs() < 1e-3, "the shoal ends 4 m along its long axis");
        assert!(at(0.0, 3.8) < 0.45 - 0.02 * 5.82 - 1e-3);
    }

    #[test]
    fn grids_have_the_structures() {
        let coast = BuiltInCoast::find("harbour").expect("a harbour");
        let structures = (coast.structures)();
        assert!(structures.iter().any(|s| s.side_slope == 0.0 && (0.9..=1.0).contains(&s.reflection)));
        assert!(structures.iter().filter(|s| s.side_slope > 0.0 && (0.3..=0.5).contains(&s.reflection)).count() == 2);
        let grid = coast.bathymetry(10.0);
        assert_eq!((grid.columns, grid.rows), (141, 141));
        // From the open sea one comes into the basin only through the entrance: a flood that starts at the sea's edge
        // and is stopped by a closed entrance does not reach the basin.
        let basin = (100, 70);
        assert!(grid.at(basin.0, basin.1) > 5.0);
        let reaches = |closes: bool| {
            let mut wet: Vec<bool> = (0..grid.depth_m.len()).map(|i| grid.depth_m[i] > 0.0).collect();
            if closes {
                let [a, b] = coasts::HARBOUR_HEADS_M;
                let gate = Structure { line_m: vec![a, b], side_slope: 0.0, ..structures[0].clone() };
                for (i, wet) in wet.iter_mut().enumerate() {
                    let (x, y) = ((i % grid.columns) as f64 * 10.0, (i / grid.columns) as f64 * 10.0);
                    *wet &= gate.distance_m(x, y) > 10.0;
                }
            }
            let mut next = vec![0];
            let mut seen = vec![false; wet.len()];
            while let Some(i) = next.pop() {
                if i < wet.len() && wet[i] && !std::mem::replace(&mut seen[i], true) {
                    next.extend([i.wrapping_sub(1), i + 1, i.wrapping_sub(grid.columns), i + grid.columns]);
                }
            }
            seen[basin.1 * grid.columns + basin.0]
        };
        assert!(reaches(false) && !reaches(true));
    }

    #[test]
    fn seamarks_stand_on_the_ground() {
        for coast in &BUILT_IN {
            for mark in coast.seamarks {
                let [x, y] = mark.at_m;
                let structures = (coast.structures)();
                let on_structure = structures.iter().find(|structure| structure.distance_m(x, y) < 1.0);
                let ground_m = on_structure.map_or(-(coast.depth_m)(x, y), |structure| structure.top_height_m);
                assert!((mark.ground_m - ground_m).abs() < 0.3, "{}, {mark:?}: {ground_m} m", coast.name);
            }
        }
    }

    #[test]
    fn ships_that_come_in_have_red_to_port() {
        let [port, starboard] = coasts::HARBOUR_LIGHTS;
        assert_eq!([port.kind, starboard.kind], [SeamarkKind::PortLight, SeamarkKind::StarboardLight]);
        // Starboard is 90 degrees clockwise from the way in, as y is from x. The basin lies around (950, 700).
        let across = [starboard.at_m[0] - port.at_m[0], starboard.at_m[1] - port.at_m[1]];
        let way_in =
            [950.0 - 0.5 * (port.at_m[0] + starboard.at_m[0]), 700.0 - 0.5 * (port.at_m[1] + starboard.at_m[1])];
        assert!(way_in[0] * across[1] - way_in[1] * across[0] > 0.0, "{way_in:?} {across:?}");
        let beacon = |kind: SeamarkKind| coasts::BAR_SEAMARKS.iter().find(|mark| mark.kind == kind).expect("a beacon");
        assert!(beacon(SeamarkKind::PortBeacon).at_m[1] < beacon(SeamarkKind::StarboardBeacon).at_m[1]);
    }
}
