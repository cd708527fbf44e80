//! What a map of heights tells: where in frequency the variance of a sea lies that was computed, whoever computed it.

use super::plan::Plan;
use super::transform::Transform;

/// Variance over frequency, measured in maps of heights by their Fourier transform. It is done bit by bit, so that a program
/// that draws frames meanwhile is not held up.
#[derive(Clone, Debug)]
pub struct Survey {
    transform: Transform,
    /// The cascade whose map is being transformed, and that map.
    cascade: usize,
    map: Vec<[f64; 2]>,
    /// Lines of it that are done: n rows, then n columns.
    done: usize,
    width_rad_s: f64,
    found: Found,
}

/// What a survey finds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// Variance of the heights, m^2.
    pub m0_m2: f64,
    /// That of each bin, m^2.
    pub bins_m2: Vec<f64>,
}

impl Survey {
    /// A survey of the maps of a plan's cascades into `bins` bins of `width_rad_s`. What is faster than the last is in none.
    ///
    /// # Panics
    /// If the plan's size is no power of two.
    pub fn new(plan: &Plan, width_rad_s: f64, bins: usize) -> Self {
        let n = plan.n as usize;
        Self {
            transform: Transform::new(n),
            cascade: 0,
            map: vec![[0.0; 2]; n * n],
            done: 0,
            width_rad_s,
            found: Found { m0_m2: 0.0, bins_m2: vec![0.0; bins] },
        }
    }

    /// Transforms about `points` points more of the maps whose rows `row` tells: heights (m) by cascade and row, always the
    /// same ones. Returns what was found when all is done.
    pub fn advance<R: Iterator<Item = f64>>(
        &mut self,
        plan: &Plan,
        points: usize,
        row: impl Fn(usize, usize) -> R,
    ) -> Option<&Found> {
        let n = plan.n as usize;
        let mut column = vec![[0.0; 2]; n];
        for _ in 0..points.div_ceil(n) {
            if self.cascade == plan.cascades.len() {
                break;
            }
            if self.done < n {
                let line = &mut self.map[n * self.done..n * (self.done + 1)];
                line.iter_mut().zip(row(self.cascade, self.done)).for_each(|(to, height)| *to = [height, 0.0]);
                self.found.m0_m2 += line.iter().map(|h| h[0] * h[0]).sum::<f64>() / (n * n) as f64;
                self.transform.run(line);
            } else {
                // Columns are counted at once, so they need not be put back.
                let x = self.done - n;
                column.iter_mut().enumerate().for_each(|(z, value)| *value = self.map[n * z + x]);
                self.transform.run(&mut column);
                count(plan, self.cascade, x, &column, self.width_rad_s, &mut self.found.bins_m2);
            }
            self.done += 1;
            if self.done == 2 * n {
                self.cascade += 1;
                self.done = 0;
            }
        }
        (self.cascade == plan.cascades.len()).then_some(&self.found)
    }
}

/// Adds the waves of one column of the transformed map.
fn count(plan: &Plan, cascade: usize, x: usize, column: &[[f64; 2]], width_rad_s: f64, bins_m2: &mut [f64]) {
    let n = column.len();
    let signed = |i: usize| if i < n / 2 { i as f64 } else { i as f64 - n as f64 };
    let unit = 1.0 / (n as f64).powi(4);
    let dk = plan.cascades[cascade].dk();
    for (z, h) in column.iter().enumerate() {
        let k = dk * signed(x).hypot(signed(z));
        if k == 0.0 {
            continue;
        }
        let bin = (plan.dispersion.omega(k) / width_rad_s) as usize;
        if let Some(sum) = bins_m2.get_mut(bin) {
            *sum += unit * (h[0] * h[0] + h[1] * h[1]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;
    use std::f64::consts::TAU;

    #[test]
    fn waves_are_found_where_they_are_and_as_large() {
        let plan = Plan::new(&query::parse("wind=10&n=64&cascades=2").0);
        let n = 64;
        // A wave of three and four turns along the axes in the first map, and one of ten along x in the second.
        let map = |amplitude: f64, ix: f64, iz: f64| -> Vec<f64> {
            let phase = |i: usize| TAU * (ix * (i % n) as f64 + iz * (i / n) as f64) / n as f64;
            (0..n * n).map(|i| 0.7 + amplitude * (phase(i) + 0.3).cos()).collect()
        };
        let maps = [map(0.5, 3.0, 4.0), map(0.2, 10.0, 0.0)];
        let row = |cascade: usize, z: usize| maps[cascade][n * z..n * (z + 1)].iter().copied();
        let width = 0.01;
        let mut survey = Survey::new(&plan, width, 2000);
        let mut rounds = 0;
        let bins = loop {
            rounds += 1;
            if let Some(found) = survey.advance(&plan, 1000, row) {
                break found.clone();
            }
        };
        let (m0_m2, bins) = (bins.m0_m2, bins.bins_m2);
        assert!(rounds > 4, "{rounds}");
        for (cascade, turns, variance) in [(0, 5.0, 0.125), (1, 10.0, 0.02)] {
            let bin = (plan.dispersion.omega(plan.cascades[cascade].dk() * turns) / width) as usize;
            assert!((bins[bin] - variance).abs() < 1e-12, "{} {variance}", bins[bin]);
        }
        assert!((bins.iter().sum::<f64>() - 0.145).abs() < 1e-12);
        // The mean level is in the variance about 0, and no wave.
        assert!((m0_m2 - 0.145 - 2.0 * 0.49).abs() < 1e-12, "{m0_m2}");
    }
}
