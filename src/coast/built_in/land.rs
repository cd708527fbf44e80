//! Profiles of beaches, dunes and cliffs, and the gentle irregularity that all coasts share.

/// Slope of the foreshore, height over length.
const FORESHORE_SLOPE: f64 = 0.08;
/// Height of the berm, m.
const BERM_M: f64 = 2.2;
/// Height of the dunes above the berm, m.
const DUNES_M: f64 = 6.5;
/// Height of the cliffs, m.
const CLIFF_M: f64 = 22.0;

/// Profile factor A of Dean 1977, m^(1/3), of sand with grains of 0.2 mm.
pub const SAND: f64 = 0.1;
/// How much deeper the water is at the foot of a cliff than at a beach, as a fraction, and how far out, m.
const CLIFF_FOOT: [f64; 2] = [0.9, 80.0];

/// Rises smoothly from 0 at `low` to 1 at `high`.
pub fn smooth_step(low: f64, high: f64, v: f64) -> f64 {
    let t = ((v - low) / (high - low)).clamp(0.0, 1.0);
    t * t * t * (t * (6.0 * t - 15.0) + 10.0)
}

/// A bell of height 1 and half width `width` around 0.
pub fn bell(v: f64, width: f64) -> f64 {
    (-(v / width).powi(2)).exp()
}

/// The smaller of two values, with a soft transition over about `softness`.
pub fn soft_min(a: f64, b: f64, softness: f64) -> f64 {
    let low = a.min(b);
    low - softness * ((-(a - b).abs() / softness).exp()).ln_1p()
}

/// Irregularity of the land, -1 to 1, with hills of some 50 to 150 m.
pub fn hills(x_m: f64, y_m: f64) -> f64 {
    let wave = |ax: f64, ay: f64, phase: f64| (ax * x_m + ay * y_m + phase).sin();
    let bent = 0.9 * wave(0.013, 0.021, 1.3);
    0.4 * wave(0.041, 0.017, bent) + 0.35 * wave(-0.023, 0.057, 2.0 + bent) + 0.25 * wave(0.083, -0.061, 4.1)
}

/// Irregularity along a shoreline, -1 to 1, with curves of some 100 to 500 m.
pub fn curves(y_m: f64) -> f64 {
    0.5 * (0.0131 * y_m + 0.4).sin() + 0.3 * (0.0287 * y_m + 2.1).sin() + 0.2 * (0.0541 * y_m + 4.4).sin()
}

/// Depth (m) at a distance (m) before the waterline: A distance^(2/3), with the slope of the foreshore at the waterline
/// itself, where that formula would be vertical.
pub fn dean_depth_m(distance_m: f64, factor: f64) -> f64 {
    // The distance at which Dean's profile has the slope of the foreshore.
    let shift_m = (2.0 * factor / (3.0 * FORESHORE_SLOPE)).powi(3);
    factor * ((distance_m + shift_m).powf(2.0 / 3.0) - shift_m.powf(2.0 / 3.0))
}

/// Depth (m, negative on land) of a sandy shore `distance_m` (m) before its waterline; negative distances are inland.
pub fn beach_m(distance_m: f64, x_m: f64, y_m: f64) -> f64 {
    if distance_m >= 0.0 {
        return dean_depth_m(distance_m, SAND);
    }
    let inland_m = -distance_m;
    let berm = BERM_M * (1.0 - (-FORESHORE_SLOPE * inland_m / BERM_M).exp());
    let ridge = smooth_step(35.0, 80.0, inland_m) * (1.0 - 0.45 * smooth_step(85.0, 150.0, inland_m));
    let dunes = DUNES_M * ridge * (0.75 + 0.3 * hills(0.6 * x_m, y_m));
    -(berm + dunes + 0.012 * (inland_m - 120.0).max(0.0).powi(2) / (inland_m + 200.0))
}

/// Depth (m, negative on land) of a rocky shore with a cliff.
pub fn cliff_m(distance_m: f64, x_m: f64, y_m: f64) -> f64 {
    if distance_m >= 0.0 {
        // The slope at the waterline is that of the beach, so that the two blend; farther out lies sand, too.
        let [more, reach_m] = CLIFF_FOOT;
        let foot = more * smooth_step(0.0, 40.0, distance_m) * bell(distance_m, reach_m);
        return dean_depth_m(distance_m, SAND) * (1.0 + foot);
    }
    let inland_m = -distance_m;
    let ledge = FORESHORE_SLOPE * inland_m / (1.0 + inland_m / 40.0);
    -(ledge + CLIFF_M * smooth_step(3.0, 48.0, inland_m) * (0.95 + 0.09 * hills(x_m, y_m)))
}

/// A blend of a beach (0) and a cliff (1).
pub fn shore_m(distance_m: f64, rockiness: f64, x_m: f64, y_m: f64) -> f64 {
    (1.0 - rockiness) * beach_m(distance_m, x_m, y_m) + rockiness * cliff_m(distance_m, x_m, y_m)
}
