//! A gap in a thin, fully reflecting wall: the exact solution by an integral equation over the gap.

use std::f64::consts::{PI, TAU};

/// Collocation points across the gap.
const POINTS: usize = 48;
/// Euler's constant.
const EULER: f64 = 0.577_215_664_901_532_9;

/// Complex number as a pair.
type Pair = (f64, f64);

/// Waves of amplitude 1 that pass a gap in a wall along x = 0, around y = 0.
///
/// Behind the wall A(x, y) is the integral of (i/2) H0(k R) u(y') over the gap, with u = -dA/dx in the gap and the
/// Hankel function of the first kind: it fulfils the Helmholtz equation, radiates, and has no gradient across the wall.
/// In the gap the amplitude is that of the arriving wave, e^(i k y sin(direction)), because arriving and reflected wave
/// cancel each other's gradient there and the radiated waves of both sides are opposite. u grows like one over the square
/// root of the distance from an edge: with y = half cos(theta), u dy = w d theta has a smooth w. The logarithm in the
/// kernel is integrated exactly for trigonometric polynomials (Kress 1995).
pub struct Gap {
    k: f64,
    half_m: f64,
    /// w at the collocation points.
    density: Vec<Pair>,
}

impl Gap {
    /// Solves the integral equation for a gap of the width `width_m` and waves that travel at `direction_rad` from +x
    /// towards +y.
    pub fn new(k: f64, width_m: f64, direction_rad: f64) -> Self {
        let half_m = 0.5 * width_m;
        let angle = |i: usize| (i as f64 + 0.5) * PI / POINTS as f64;
        let place = |i: usize| half_m * angle(i).cos();
        let entry = |i: usize, j: usize| -> Pair {
            let z = k * (place(i) - place(j)).abs();
            // Y0 = 2 / pi J0 ln z + a smooth rest.
            let (bessel, rest) = if z < 1e-9 {
                (1.0, (EULER - 2.0_f64.ln()) * 2.0 / PI)
            } else {
                let bessel = libm::j0(z);
                (bessel, libm::y0(z) - 2.0 / PI * bessel * z.ln())
            };
            let smooth = PI / POINTS as f64;
            // ln z = ln(k half / 2) + ln|2 sin((a + b) / 2)| + ln|2 sin((a - b) / 2)|.
            let constant = (0.5 * k * half_m).ln() * smooth;
            let logarithm = constant + 0.5 * (log_weight(angle(i) - angle(j)) + log_weight(angle(i) + angle(j)));
            let y0 = 2.0 / PI * bessel * logarithm + rest * smooth;
            // (i / 2) (J0 + i Y0).
            (-0.5 * y0, 0.5 * bessel * smooth)
        };
        let matrix = (0..POINTS).map(|i| (0..POINTS).map(|j| entry(i, j)).collect()).collect();
        let right = (0..POINTS)
            .map(|i| {
                let (sin, cos) = (k * place(i) * direction_rad.sin()).sin_cos();
                (cos, sin)
            })
            .collect();
        Self { k, half_m, density: solve(matrix, right) }
    }

    /// Amplitude at a point behind the wall, at least a tenth of the gap's width away from it.
    pub fn amplitude(&self, x: f64, y: f64) -> f64 {
        let (mut re, mut im) = (0.0, 0.0);
        for (i, (wr, wi)) in self.density.iter().enumerate() {
            let place = self.half_m * ((i as f64 + 0.5) * PI / POINTS as f64).cos();
            let z = self.k * x.hypot(y - place);
            let (gr, gi) = (-0.5 * libm::y0(z), 0.5 * libm::j0(z));
            re += gr * wr - gi * wi;
            im += gr * wi + gi * wr;
        }
        let step = PI / POINTS as f64;
        (re * step).hypot(im * step)
    }

    /// Flux of energy through the gap over that of the arriving wave across the width of the gap.
    pub fn transmitted(&self, direction_rad: f64) -> f64 {
        // The flux is the integral of Im(conj(A) dA/dx) = Im(-conj(A) u) over the gap, where A is the arriving wave.
        let step = PI / POINTS as f64;
        let sum: f64 = (self.density.iter().enumerate())
            .map(|(i, (wr, wi))| {
                let place = self.half_m * ((i as f64 + 0.5) * step).cos();
                let (sin, cos) = (self.k * place * direction_rad.sin()).sin_cos();
                -(cos * wi - sin * wr)
            })
            .sum();
        sum * step / (self.k * direction_rad.cos() * 2.0 * self.half_m)
    }
}

/// Weight of a point in the integral of ln(4 sin^2) over the whole circle (Kress 1995), for 2 [`POINTS`] points, at the
/// angle `angle` from the singularity; the half of it is that of ln|2 sin|.
fn log_weight(angle: f64) -> f64 {
    let n = POINTS as f64;
    let sum: f64 = (1..POINTS).map(|m| (m as f64 * angle).cos() / m as f64).sum();
    -TAU / n * sum - PI / (n * n) * (n * angle).cos()
}

/// Solves a system of linear equations by elimination with pivots.
fn solve(mut matrix: Vec<Vec<Pair>>, mut right: Vec<Pair>) -> Vec<Pair> {
    let times = |a: Pair, b: Pair| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    let over = |a: Pair, b: Pair| {
        let norm = b.0 * b.0 + b.1 * b.1;
        ((a.0 * b.0 + a.1 * b.1) / norm, (a.1 * b.0 - a.0 * b.1) / norm)
    };
    let n = right.len();
    for column in 0..n {
        let size = |row: &usize| matrix[*row][column].0.hypot(matrix[*row][column].1);
        let pivot = (column..n).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(column);
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        for row in column + 1..n {
            let factor = over(matrix[row][column], matrix[column][column]);
            for c in column..n {
                let step = times(factor, matrix[column][c]);
                matrix[row][c] = (matrix[row][c].0 - step.0, matrix[row][c].1 - step.1);
            }
            let step = times(factor, right[column]);
            right[row] = (right[row].0 - step.0, right[row].1 - step.1);
        }
    }
    for row in (0..n).rev() {
        for c in row + 1..n {
            let step = times(matrix[row][c], right[c]);
            right[row] = (right[row].0 - step.0, right[row].1 - step.1);
        }
        right[row] = over(right[row], matrix[row][row]);
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Energy is conserved: the flux through the gap is that far behind it. A wide gap lets through what it covers, and a
    /// narrow one has the known limit of a point source, u = 1 / (1/2 i (1 + 2 i / pi ln(...))).
    #[test]
    fn the_gap_conserves_energy() {
        let k = TAU / 40.0;
        for (width_m, direction_rad) in [(40.0, 0.0), (80.0, 0.5), (15.0, -0.3)] {
            let gap = Gap::new(k, width_m, direction_rad);
            // Flux through a half circle of 4 km: |A|^2 k r d angle, where the waves travel straight outward.
            let (radius, steps) = (4000.0, 2000);
            let far: f64 = (0..steps)
                .map(|i| {
                    let angle = (f64::from(i) + 0.5) / f64::from(steps) * PI - 0.5 * PI;
                    gap.amplitude(radius * angle.cos(), radius * angle.sin()).powi(2) * radius * PI / f64::from(steps)
                })
                .sum();
            let far = far / (width_m * direction_rad.cos());
            let through = gap.transmitted(direction_rad);
            assert!((far / through - 1.0).abs() < 2e-3, "{width_m} m: {far} and {through}");
        }
        let wide = Gap::new(k, 200.0, 0.0);
        assert!((wide.transmitted(0.0) - 1.0).abs() < 0.05, "{}", wide.transmitted(0.0));
    }
}
