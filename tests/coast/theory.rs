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

/// Amplitude beside a vertical pile (MacCamy and Fuchs 1954) at the scaled distance `kr` and the angle `angle` from the direction
/// of travel, for the scaled radius `ka`: the sum of e_m i^m (J_m(kr) - J_m'(ka) / H_m'(ka) H_m(kr)) cos(m angle).
pub fn pile(kr: f64, ka: f64, angle: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for m in 0..(kr.max(ka) as i32 + 25) {
        let derivative = |f: &dyn Fn(i32, f64) -> f64| if m == 0 { -f(1, ka) } else { 0.5 * (f(m - 1, ka) - f(m + 1, ka)) };
        let (dj, dy) = (derivative(&libm::jn), derivative(&libm::yn));
        let (j, y) = (libm::jn(m, kr), libm::yn(m, kr));
        // J_m' / H_m' with H = J + i Y.
        let norm = dj * dj + dy * dy;
        let (qr, qi) = if norm.is_finite() { (dj * dj / norm, -dj * dy / norm) } else { (0.0, 0.0) };
        let (hr, hi) = if y.is_finite() { (qr * j - qi * y, qr * y + qi * j) } else { (0.0, 0.0) };
        let (tr, ti) = (j - hr, -hi);
        let factor = if m == 0 { 1.0 } else { 2.0 } * (f64::from(m) * angle).cos();
        let (tr, ti) = (tr * factor, ti * factor);
        let (ar, ai) = match m % 4 {
            0 => (tr, ti),
            1 => (-ti, tr),
            2 => (-tr, -ti),
            _ => (ti, -tr),
        };
        re += ar;
        im += ai;
    }
    re.hypot(im)
}

/// Amplitude near a fully reflecting thin wall along x = 0, y > 0 (Sommerfeld 1896; Penney and Price 1952), for waves of
/// amplitude 1 that travel at `direction` from +x towards +y. The exact solution is the sum of the waves that arrive and
/// that are reflected, each times (1 + i) / 2 integral from -infinity of e^(-i pi t^2 / 2), here as complex conjugates.
pub fn breakwater(k: f64, x: f64, y: f64, direction: f64) -> f64 {
    let r = x.hypot(y);
    // Polar angle from the wall, 0 to 2 pi, growing on the seaward side first; that from which the waves come.
    let angle = (-x).atan2(y).rem_euclid(TAU);
    let source = std::f64::consts::FRAC_PI_2 + direction;
    let source = source.rem_euclid(TAU);
    let wave = |from: f64| {
        // Arriving from the polar angle `from`: phase -k r cos(angle - from); argument of the Fresnel integral.
        let argument = 2.0 * (k * r / std::f64::consts::PI).sqrt() * (0.5 * (angle - from)).cos();
        let (c, s) = fresnel(argument);
        // F = (1 - i) / 2 (1/2 + C + i (1/2 + S)).
        let (a, b) = (0.5 + c, 0.5 + s);
        let (fr, fi) = (0.5 * (a + b), 0.5 * (b - a));
        let phase = -k * r * (angle - from).cos();
        let (sin, cos) = phase.sin_cos();
        (fr * cos - fi * sin, fr * sin + fi * cos)
    };
    let (arriving, reflected) = (wave(source), wave(-source));
    (arriving.0 + reflected.0).hypot(arriving.1 + reflected.1)
}

/// Fresnel integrals C and S of pi t^2 / 2 from 0 to `x`, by Simpson's rule.
pub fn fresnel(x: f64) -> (f64, f64) {
    let steps = 2 * (20.0 + 30.0 * x * x) as u32;
    let h = x / f64::from(steps);
    let (mut c, mut s) = (0.0, 0.0);
    for n in 0..=steps {
        let weight = if n == 0 || n == steps { 1.0 } else if n % 2 == 1 { 4.0 } else { 2.0 };
        let (sin, cos) = (std::f64::consts::FRAC_PI_2 * (h * f64::from(n)).powi(2)).sin_cos();
        c += weight * cos;
        s += weight * sin;
    }
    (c * h / 3.0, s * h / 3.0)
}
