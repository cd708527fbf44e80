//! The depths of the six coasts.

use super::super::seamark::{Seamark, SeamarkKind};
use super::super::structure::Structure;
use super::land::{beach_m, bell, curves, shore_m, smooth_step, soft_min};

/// Middle of the elliptic shoal, m.
pub const SHOAL_MIDDLE_M: [f64; 2] = [520.0, 603.0];
/// Heads of the breakwaters of the harbour, between which the entrance lies, m.
pub const HARBOUR_HEADS_M: [[f64; 2]; 2] = [[770.0, 790.0], [858.0, 888.0]];
/// Height of the top of the breakwaters of the harbour above the water, m.
const BREAKWATER_TOP_M: f64 = 4.5;
/// Lights at the heads of the breakwaters: ships that enter leave the main one to port.
pub const HARBOUR_LIGHTS: [Seamark; 2] = [
    Seamark { kind: SeamarkKind::PortLight, at_m: HARBOUR_HEADS_M[0], ground_m: BREAKWATER_TOP_M },
    Seamark { kind: SeamarkKind::StarboardLight, at_m: HARBOUR_HEADS_M[1], ground_m: BREAKWATER_TOP_M },
];
/// Lighthouse in the dunes of the beach.
pub const BEACH_LIGHTHOUSE: Seamark = Seamark { kind: SeamarkKind::Lighthouse, at_m: [1400.0, 1300.0], ground_m: 8.2 };
/// Lighthouse in the dunes at the channel through the bar, and beacons where the channel begins.
pub const BAR_SEAMARKS: [Seamark; 3] = [
    Seamark { kind: SeamarkKind::Lighthouse, at_m: [1302.0, 700.0], ground_m: 7.7 },
    Seamark { kind: SeamarkKind::PortBeacon, at_m: [1000.0, 640.0], ground_m: -3.6 },
    Seamark { kind: SeamarkKind::StarboardBeacon, at_m: [1000.0, 800.0], ground_m: -3.8 },
];
/// Lighthouse on the cliff of the headland.
pub const HEADLAND_LIGHTHOUSE: Seamark =
    Seamark { kind: SeamarkKind::Lighthouse, at_m: [1000.0, 590.0], ground_m: 24.7 };
/// Lighthouse on the hill of the island.
pub const ISLAND_LIGHTHOUSE: Seamark = Seamark { kind: SeamarkKind::Lighthouse, at_m: [568.0, 815.0], ground_m: 24.1 };
/// Enlargement of the laboratory shoal.
const SHOAL_SCALE: f64 = 50.0;

/// A straight sandy beach with a waterline that varies by some metres.
pub fn beach(x_m: f64, y_m: f64) -> f64 {
    beach_m(1330.0 + 10.0 * curves(y_m) - x_m, x_m, y_m)
}

/// A headland of rock at y = 600 m, and a sandy bay beside it.
pub fn headland(x_m: f64, y_m: f64) -> f64 {
    let rockiness = bell(y_m - 600.0, 230.0);
    let waterline = |y_m: f64| 1330.0 - 430.0 * bell(y_m - 600.0, 170.0) + 70.0 * bell(y_m - 1130.0, 260.0);
    let bends = 9.0 * curves(y_m) * (1.0 + rockiness);
    let before_m = waterline(y_m) + bends - x_m;
    // The distance to a waterline that runs obliquely is shorter than that along x. Far out the contours are straighter.
    let slope = 0.5 * (waterline(y_m + 1.0) - waterline(y_m - 1.0));
    let near = 1.0 / (1.0 + slope * slope * bell(before_m, 160.0)).sqrt();
    let far = smooth_step(100.0, 1000.0, before_m);
    let distance_m = before_m * near + 0.45 * far * (1330.0 - waterline(y_m));
    shore_m(distance_m, rockiness, x_m, y_m)
}

/// An island with a cliff on its seaward side, a beach on its lee, and shallow water between it and the mainland.
pub fn island(x_m: f64, y_m: f64) -> f64 {
    let mainland = beach_m(1480.0 + 12.0 * curves(y_m) - x_m - 45.0 * bell(y_m - 800.0, 300.0), x_m, y_m);
    let (dx, dy) = (x_m - 650.0, y_m - 800.0);
    let around = dy.atan2(dx);
    let outline =
        1.0 + 0.09 * (2.0 * around + 0.7).sin() + 0.05 * (3.0 * around + 2.0).cos() + 0.03 * (5.0 * around).sin();
    let from_middle = (dx / 130.0).hypot(dy / 210.0) / outline;
    // Metres before the waterline, nearly: the size of the island times how far outside its outline the point is.
    let distance_m = 168.0 * (from_middle - 1.0);
    // Farther out the bed falls to the depth that the mainland has there, so that the sea's edge is open water.
    let distance_m = distance_m * (1.0 + smooth_step(1.6, 4.2, from_middle));
    let rockiness = smooth_step(-1.0, 1.0, -dx / 110.0);
    let island = shore_m(distance_m, rockiness, x_m, y_m);
    let hill = 4.0 * bell(from_middle, 0.6);
    soft_min(mainland, island - hill, 0.8)
}

/// A beach with a dredged basin, which [`harbour_structures`] shelter.
pub fn harbour(x_m: f64, y_m: f64) -> f64 {
    let natural = beach_m(1150.0 + 8.0 * curves(y_m) - x_m, x_m, y_m);
    // Ground of the harbour, 3.5 m above the water; the quay stands at its edge.
    let within = smooth_step(430.0, 490.0, y_m) * (1.0 - smooth_step(910.0, 970.0, y_m));
    let ground = within * smooth_step(1168.0, 1194.0, x_m);
    let basin = within * smooth_step(690.0, 860.0, x_m) * (1.0 - ground);
    let dredged = natural + basin * (7.0 - natural).max(0.0);
    dredged * (1.0 - ground) - 3.5 * ground
}

/// The two breakwaters of the harbour and its quay.
pub fn harbour_structures() -> Vec<Structure> {
    let [main_head, lee_head] = HARBOUR_HEADS_M;
    let rubble = |line_m: Vec<[f64; 2]>| Structure {
        name: "breakwater",
        line_m,
        top_width_m: 9.0,
        top_height_m: BREAKWATER_TOP_M,
        side_slope: 1.5,
        reflection: 0.4,
    };
    let main = vec![
        [1240.0, 425.0],
        [1080.0, 428.0],
        [960.0, 446.0],
        [865.0, 490.0],
        [800.0, 560.0],
        [768.0, 645.0],
        [762.0, 720.0],
        main_head,
    ];
    let lee = vec![[1240.0, 978.0], [1090.0, 976.0], [990.0, 962.0], [915.0, 930.0], lee_head];
    let quay = Structure {
        name: "quay",
        line_m: vec![[1180.0, 440.0], [1180.0, 960.0]],
        top_width_m: 12.0,
        top_height_m: 3.5,
        side_slope: 0.0,
        reflection: 0.95,
    };
    vec![rubble(main), rubble(lee), quay]
}

/// A bar along a beach with a channel across it.
pub fn bar(x_m: f64, y_m: f64) -> f64 {
    let distance_m = 1230.0 + 9.0 * curves(y_m) - x_m;
    let plain = beach_m(distance_m, x_m, y_m);
    // Crescents along the bar; the channel winds a little.
    let crest_m = 185.0 + 22.0 * (0.0113 * y_m + 1.0).sin();
    let middle_m = 700.0 + 28.0 * (distance_m / 110.0).sin();
    let channel = bell(y_m - middle_m, 75.0);
    let sand = (1.75 + 0.25 * (0.017 * y_m).sin()) * bell(distance_m - crest_m, 55.0);
    let trough = 0.7 * bell(distance_m - crest_m + 95.0, 42.0);
    let cut = 2.3 * bell(distance_m - crest_m, 120.0);
    plain + trough * smooth_step(0.0, 60.0, distance_m) - sand * (1.0 - channel)
        + cut * channel * smooth_step(10.0, 90.0, distance_m)
}

/// The shoal of Berkhoff, Booij and Radder 1982 ("Verification of numerical wave propagation models for simple harmonic
/// linear water waves", Coastal Engineering 6, 255-279) on its slope of 1 in 50, which is turned by 20 degrees. It is
/// 50 times enlarged: 22.5 m of water before it, and waves of 7.1 s for the 1 s of the laboratory. The slope goes on to a
/// beach; the corner at its foot is rounded.
pub fn shoal(x_m: f64, y_m: f64) -> f64 {
    let (sin, cos) = 20.0_f64.to_radians().sin_cos();
    let [x, y] = [x_m - SHOAL_MIDDLE_M[0], y_m - SHOAL_MIDDLE_M[1]].map(|v| v / SHOAL_SCALE);
    let (u, v) = (x * cos - y * sin, x * sin + y * cos);
    // Soft over 0.2 m of length: 0.004 m of depth.
    let slope = soft_min(0.45, 0.45 - 0.02 * (5.82 + u), 0.004);
    let inside = (u / 3.0).powi(2) + (v / 4.0).powi(2);
    let hill = if inside < 1.0 { 0.5 * (1.0 - (u / 3.75).powi(2) - (v / 5.0).powi(2)).sqrt() - 0.3 } else { 0.0 };
    SHOAL_SCALE * (slope - hill)
}
