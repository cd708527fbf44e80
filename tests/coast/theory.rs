//! Solutions that share no code with the solvers of `coast`.

#![allow(dead_code, reason = "each test file uses a part")]

use std::f64::consts::TAU;

/// Wave number (rad/m) of a wave with the angular frequency `omega` (rad/s), by bisection.
pub fn wave_number(omega: f64, depth_m: f64, gravity: f64) -> f64 {
    let (mut low, mut high) = (0.0, omega * omega / gravity + 2.0 * omega / (gravity * depth_m).sqrt());
    for _ in 0..80 {
        let k = 0.5 * (low + high);
        if gravity * k * (k * depth_m).tanh() < omega * omega {
            low = k;
        } else {
            high = k;
        }
    }
    0.5 * (low + high)
}

/// Group velocity (m/s).
pub fn group_velocity(omega: f64, depth_m: f64, gravity: f64) -> f64 {
    let k = wave_number(omega, depth_m, gravity);
    0.5 * omega / k * (1.0 + 2.0 * k * depth_m / (2.0 * k * depth_m).sinh())
}

/// Significant wave height (m) at the distance x (m) over a plane beach that rises from `depth_m` with `slope`, for
/// waves that come straight ashore with the height `hs_m`, by the balance of Battjes and Janssen 1978 with gamma 0.73.
pub fn battjes_janssen_hs_m(hs_m: f64, omega: f64, depth_m: f64, slope: f64, gravity: f64) -> impl Fn(f64) -> f64 {
    let dx = 0.02;
    let loss = move |flux: f64, x: f64| {
        let depth = depth_m - slope * x;
        let k = wave_number(omega, depth, gravity);
        let m0 = flux / group_velocity(omega, depth, gravity);
        let largest = 0.88 / k * (0.73 * k * depth / 0.88).tanh();
        let b = 8.0 * m0 / (largest * largest);
        // 1 - Q + b ln Q is negative below the solution and positive above it, up to Q = 1.
        let (mut low, mut high) = (0.0_f64, if b < 1.0 { (b * 1.0_f64).min(1.0 - 1e-12) } else { 1.0 });
        if b < 1.0 {
            for _ in 0..60 {
                let q = 0.5 * (low + high);
                if 1.0 - q + b * q.ln() < 0.0 {
                    low = q;
                } else {
                    high = q;
                }
            }
        } else {
            low = 1.0;
        }
        0.25 * omega / TAU * low * largest * largest
    };
    let mut flux = hs_m * hs_m / 16.0 * group_velocity(omega, depth_m, gravity);
    let mut heights = vec![hs_m];
    let mut x = 0.0;
    while depth_m - slope * (x + dx) > 0.3 {
        let first = loss(flux, x);
        let second = loss(flux - 0.5 * dx * first, x + 0.5 * dx);
        flux -= dx * second;
        x += dx;
        heights.push(4.0 * (flux / group_velocity(omega, depth_m - slope * x, gravity)).sqrt());
    }
    move |x: f64| heights[((x / dx).round() as usize).min(heights.len() - 1)]
}
