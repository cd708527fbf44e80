//! Solutions in f64 that share no code with the solvers of [`crate::coast`].

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

/// Amplitude beside a vertical pile (MacCamy and Fuchs 1954) at the scaled distance `kr` and the angle `angle` from the
/// direction of travel, for the scaled radius `ka`: the sum of e_m i^m (J_m(kr) - J_m'(ka) / H_m'(ka) H_m(kr)) cos(m
/// angle).
pub fn pile(kr: f64, ka: f64, angle: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for m in 0..(kr.max(ka) as i32 + 25) {
        let derivative =
            |f: &dyn Fn(i32, f64) -> f64| if m == 0 { -f(1, ka) } else { 0.5 * (f(m - 1, ka) - f(m + 1, ka)) };
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

/// Amplitude near a fully reflecting thin wall along x = 0, y > 0 (Sommerfeld 1896; Penney and Price 1952), for waves
/// of amplitude 1 that travel at `direction` from +x towards +y. The exact solution is the sum of the waves that arrive
/// and that are reflected, each times (1 + i) / 2 integral from -infinity of e^(-i pi t^2 / 2), here as complex
/// conjugates.
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
        let weight = if n == 0 || n == steps {
            1.0
        } else if n % 2 == 1 {
            4.0
        } else {
            2.0
        };
        let (sin, cos) = (std::f64::consts::FRAC_PI_2 * (h * f64::from(n)).powi(2)).sin_cos();
        c += weight * cos;
        s += weight * sin;
    }
    (c * h / 3.0, s * h / 3.0)
}

/// C Cg and k^2 C Cg.
fn mild_slope_coefficients(omega: f64, depth_m: f64, gravity: f64) -> (f64, f64) {
    let k = wave_number(omega, depth_m, gravity);
    let p = omega / k * group_velocity(omega, depth_m, gravity);
    (p, k * k * p)
}

/// Complex number as a pair.
type Pair = (f64, f64);

/// Reflection and transmission coefficients of a slope between the places `x` (from sea to shore), for waves that come
/// straight: Runge-Kutta integration of the one-dimensional mild-slope equation from a transmitted wave of amplitude 1
/// back to sea.
pub fn slope(omega: f64, depth: impl Fn(f64) -> f64, x: [f64; 2], gravity: f64) -> (f64, f64) {
    let steps = 4000;
    let h = (x[0] - x[1]) / f64::from(steps);
    let (p, q) = mild_slope_coefficients(omega, depth(x[1]), gravity);
    // Value and flux, each real and imaginary.
    let mut state = [1.0, 0.0, 0.0, (q * p).sqrt()];
    let rate = |x: f64, s: [f64; 4]| {
        let (p, q) = mild_slope_coefficients(omega, depth(x), gravity);
        [s[2] / p, s[3] / p, -q * s[0], -q * s[1]]
    };
    for step in 0..steps {
        state = runge_kutta(&rate, x[1] + h * f64::from(step), h, state);
    }
    let (p, q) = mild_slope_coefficients(omega, depth(x[0]), gravity);
    let impedance = (q * p).sqrt();
    // value = a + b, flux = i impedance (a - b).
    let (difference_re, difference_im) = (state[3] / impedance, -state[2] / impedance);
    let arriving = (0.5 * (state[0] + difference_re)).hypot(0.5 * (state[1] + difference_im));
    let reflected = (0.5 * (state[0] - difference_re)).hypot(0.5 * (state[1] - difference_im));
    (reflected / arriving, 1.0 / arriving)
}

fn runge_kutta<const N: usize>(rate: &impl Fn(f64, [f64; N]) -> [f64; N], x: f64, h: f64, s: [f64; N]) -> [f64; N] {
    let along = |s: [f64; N], d: [f64; N], f: f64| -> [f64; N] { std::array::from_fn(|n| s[n] + f * d[n]) };
    let a = rate(x, s);
    let b = rate(x + 0.5 * h, along(s, a, 0.5 * h));
    let c = rate(x + 0.5 * h, along(s, b, 0.5 * h));
    let d = rate(x + h, along(s, c, h));
    std::array::from_fn(|n| s[n] + h / 6.0 * (a[n] + 2.0 * b[n] + 2.0 * c[n] + d[n]))
}

/// Waves around a round island with a depth that depends on the distance from its centre, by angular modes: each is a
/// real solution of (r p R')' + (q r - p m^2 / r) R = 0 with R' = 0 at the island, joined to Bessel functions outside
/// the shoal.
pub struct Island {
    k: f64,
    shoal_m: f64,
    island_m: f64,
    step_m: f64,
    /// For each mode: R at each step, its factor (complex), and the scattered wave's factor.
    modes: Vec<(Vec<f64>, Pair, Pair)>,
}

impl Island {
    const STEPS: u32 = 3000;

    /// Solves the modes.
    pub fn new(omega: f64, island_m: f64, shoal_m: f64, depth: impl Fn(f64) -> f64, gravity: f64) -> Self {
        let k = wave_number(omega, depth(shoal_m), gravity);
        let step_m = (shoal_m - island_m) / f64::from(Self::STEPS);
        // p and q at the ends and middles of all steps.
        let table: Vec<Pair> = (0..=2 * Self::STEPS)
            .map(|n| mild_slope_coefficients(omega, depth(island_m + 0.5 * step_m * f64::from(n)), gravity))
            .collect();
        let mode = |m: i32| {
            let rate = |x: f64, s: [f64; 2]| {
                let r = island_m + x;
                let (p, q) = table[(2.0 * x / step_m).round() as usize];
                [s[1] / (r * p), (p * f64::from(m * m) / r - q * r) * s[0]]
            };
            let mut state = [1.0, 0.0];
            let mut values = vec![1.0];
            for step in 0..Self::STEPS {
                state = runge_kutta(&rate, step_m * f64::from(step), step_m, state);
                values.push(state[0]);
            }
            let slope = state[1] / (shoal_m * table[2 * Self::STEPS as usize].0);
            // c R = e_m i^m J_m + b H_m, and the same for the derivatives, at the edge of the shoal.
            let x = k * shoal_m;
            let derivative =
                |f: &dyn Fn(i32, f64) -> f64| k * if m == 0 { -f(1, x) } else { 0.5 * (f(m - 1, x) - f(m + 1, x)) };
            let (j, y, dj, dy) = (libm::jn(m, x), libm::yn(m, x), derivative(&libm::jn), derivative(&libm::yn));
            // Without i^m: b = e_m (dj R - j R') / (h R' - dh R) with h = j + i y.
            let even = if m == 0 { 1.0 } else { 2.0 };
            let numerator = even * (dj * state[0] - j * slope);
            let (dr, di) = (j * slope - dj * state[0], y * slope - dy * state[0]);
            let norm = dr * dr + di * di;
            let b = (numerator * dr / norm, -numerator * di / norm);
            let c = ((even * j + b.0 * j - b.1 * y) / state[0], (b.0 * y + b.1 * j) / state[0]);
            (values, c, b)
        };
        let count = (k * shoal_m) as i32 + 12;
        Self { k, shoal_m, island_m, step_m, modes: (0..count).map(mode).collect() }
    }

    /// Amplitude at the distance `r` (m) from the centre and the angle `angle` from the direction of travel.
    pub fn amplitude(&self, r: f64, angle: f64) -> f64 {
        let (mut re, mut im) = (0.0, 0.0);
        if r >= self.shoal_m {
            let phase = self.k * r * angle.cos();
            (re, im) = (phase.cos(), phase.sin());
        }
        for (m, (values, c, b)) in self.modes.iter().enumerate() {
            let (mut tr, mut ti) = if r < self.shoal_m {
                let at = (r - self.island_m) / self.step_m;
                let low = at as usize;
                let value = values[low] + at.fract() * (values[(low + 1).min(values.len() - 1)] - values[low]);
                (c.0 * value, c.1 * value)
            } else {
                let (j, y) = (libm::jn(m as i32, self.k * r), libm::yn(m as i32, self.k * r));
                (b.0 * j - b.1 * y, b.0 * y + b.1 * j)
            };
            for _ in 0..m % 4 {
                (tr, ti) = (-ti, tr);
            }
            let cos = (m as f64 * angle).cos();
            (re, im) = (re + tr * cos, im + ti * cos);
        }
        re.hypot(im)
    }
}
