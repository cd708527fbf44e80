//! What the spectrum pass cannot work out well in f32 on a GPU, tabulated in f64 over |k|.
//!
//! A square lattice is symmetric under both mirrors and the exchange of its axes, so 0 <= b <= a <= n/2 covers it:
//! entry a (a + 1) / 2 + b of a triangle. One entry stands for up to eight waves; nothing is interpolated.

use super::plan::{Cascade, Plan, Wave};
use super::spreading::{Lobe, Spreading};

/// One entry of the triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Frequency and orbit.
    pub wave: Wave,
    /// 1/2 sqrt(S dkx dkz) without the directional shape but with its norm, m; 0 outside the band.
    pub amplitude: f64,
    /// Directional shape.
    pub lobe: Lobe,
}

/// Entries of the triangle for lattices of `n` points a side.
pub fn len(n: u32) -> usize {
    let half = n as usize / 2;
    (half + 1) * (half + 2) / 2
}

/// Entry of the wave (ix, iz), signed indices up to n/2 in size.
pub fn index(ix: i32, iz: i32) -> usize {
    let (a, b) = (ix.unsigned_abs().max(iz.unsigned_abs()) as usize, ix.unsigned_abs().min(iz.unsigned_abs()) as usize);
    a * (a + 1) / 2 + b
}

/// The triangle of one cascade. The entry of k = 0 is all zero but for `turns`.
pub fn rows(plan: &Plan, cascade: &Cascade) -> Vec<Row> {
    let half = plan.n / 2;
    let norms = Norms::new(&plan.spreading, plan.spectrum.support());
    let nothing = Row {
        wave: Wave { k: 0.0, turns: 1, omega: 0.0, orbit: 0.0 },
        amplitude: 0.0,
        lobe: Lobe { beta: 0.0, s: 0.0 },
    };
    let mut out = Vec::with_capacity(len(plan.n));
    for a in 0..=half {
        for b in 0..=a {
            let i2 = a * a + b * b;
            let k = cascade.dk() * f64::from(i2).sqrt();
            if i2 == 0 || k < cascade.k_low || k >= cascade.k_high {
                out.push(nothing);
                continue;
            }
            let wave = plan.wave(cascade, i2);
            let lobe = plan.spreading.lobe(wave.omega);
            let variance = plan.radial_variance(cascade, &wave) * norms.at(wave.omega, &lobe);
            out.push(Row { wave, amplitude: 0.5 * variance.sqrt(), lobe });
        }
    }
    out
}

/// The norm of the lobes: in closed form where there is one, else from a table over ln(omega) that is split at the
/// spreading's kinks. Quadrature for every entry would make a slider stutter.
enum Norms {
    Closed,
    Table(Vec<Piece>),
}

struct Piece {
    ln_low: f64,
    step: f64,
    ln_norm: Vec<f64>,
}

impl Norms {
    const NODES: usize = 256;

    fn new(spreading: &Spreading, (low, high): (f64, f64)) -> Self {
        let probe = spreading.lobe(low);
        if probe.s == 0.0 || probe.beta == 0.0 {
            return Self::Closed;
        }
        let mut knots = spreading.breakpoints();
        knots.retain(|&w| w > low && w < high);
        knots.insert(0, 0.1 * low);
        knots.push(high);
        let piece = |w: &[f64]| {
            let (ln_low, ln_high) = (w[0].ln(), (w[1] * (1.0 - 1e-12)).ln());
            let step = (ln_high - ln_low) / Self::NODES as f64;
            let node = |i| spreading.lobe((ln_low + step * i as f64).exp().max(w[0])).norm().ln();
            Piece { ln_low, step, ln_norm: (0..=Self::NODES).map(node).collect() }
        };
        Self::Table(knots.windows(2).map(piece).collect())
    }

    fn at(&self, omega: f64, lobe: &Lobe) -> f64 {
        let Self::Table(pieces) = self else { return lobe.norm() };
        let ln = omega.ln();
        let piece = pieces.iter().rev().find(|p| ln >= p.ln_low).unwrap_or(&pieces[0]);
        // Cubic through the four nearest nodes of the piece.
        let x = ((ln - piece.ln_low) / piece.step).clamp(0.0, Self::NODES as f64);
        let first = (x as usize).clamp(1, Self::NODES - 2) - 1;
        let f = x - first as f64;
        let weights = [
            -(f - 1.0) * (f - 2.0) * (f - 3.0) / 6.0,
            f * (f - 2.0) * (f - 3.0) / 2.0,
            -f * (f - 1.0) * (f - 3.0) / 2.0,
            f * (f - 1.0) * (f - 2.0) / 6.0,
        ];
        weights.iter().zip(&piece.ln_norm[first..]).map(|(w, y)| w * y).sum::<f64>().exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::query;

    #[test]
    fn norms_from_the_table_are_those_of_the_quadrature() {
        let plan = Plan::new(&query::parse("swell=0.7").0);
        let norms = Norms::new(&plan.spreading, plan.spectrum.support());
        for i in 0..500 {
            let omega = plan.spectrum.omega_p * 0.4 * 100f64.powf(f64::from(i) / 499.0);
            let lobe = plan.spreading.lobe(omega);
            assert!((norms.at(omega, &lobe) / lobe.norm() - 1.0).abs() < 1e-7, "omega {omega}");
        }
    }

    #[test]
    fn the_triangle_covers_the_lattice_once() {
        let n = 64;
        let mut seen = vec![0; len(n)];
        for a in 0..=(n as i32 / 2) {
            for b in 0..=a {
                seen[index(a, -b)] += 1;
                assert_eq!(index(a, b), index(-b, a));
            }
        }
        assert!(seen.iter().all(|&s| s == 1));
    }
}
