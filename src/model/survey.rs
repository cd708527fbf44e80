//! What a map of heights tells: where in frequency the variance of a sea lies that was computed, whoever computed it.

use super::plan::Plan;
use super::transform::Transform;

/// Variance over frequency, measured in maps of heights by their Fourier transform. It is done bit by bit, so that a program
/// that draws frames meanwhile is not held up.
#[derive(Clone, Debug)]
pub struct Survey {
    transform: Transform,
    n: usize,
    /// Maps that are still to be transformed, the last first: index of the cascade, n x n heights (m, 0).
    maps: Vec<(usize, Vec<[f64; 2]>)>,
    /// Lines of the last map that are done: n rows, then n columns.
    done: usize,
    width_rad_s: f64,
    bins_m2: Vec<f64>,
}

impl Survey {
    /// A survey of maps of heights (m; n x n, row by row), one of each of the plan's cascades, into `bins` bins of
    /// `width_rad_s`. What is faster than the last bin is left out.
    ///
    /// # Panics
    /// If a map has another size than the plan's, or there are more maps than cascades.
    pub fn new(plan: &Plan, maps: Vec<Vec<f64>>, width_rad_s: f64, bins: usize) -> Self {
        let n = plan.n as usize;
        assert!(maps.len() <= plan.cascades.len() && maps.iter().all(|map| map.len() == n * n), "maps of another plan");
        let complex = |map: Vec<f64>| map.into_iter().map(|h| [h, 0.0]).collect();
        Self {
            transform: Transform::new(n),
            n,
            maps: maps.into_iter().map(complex).enumerate().collect(),
            done: 0,
            width_rad_s,
            bins_m2: vec![0.0; bins],
        }
    }

    /// Transforms about `points` points more. Returns the variance of each bin, m^2, when all is done.
    pub fn advance(&mut self, plan: &Plan, points: usize) -> Option<&[f64]> {
        let n = self.n;
        let mut column = vec![[0.0; 2]; n];
        for _ in 0..points.div_ceil(n) {
            let Some((cascade, map)) = self.maps.last_mut() else { return Some(&self.bins_m2) };
            if self.done < n {
                self.transform.run(&mut map[n * self.done..n * (self.done + 1)]);
            } else {
                // Columns are counted at once, so they need not be put back.
                let x = self.done - n;
                column.iter_mut().enumerate().for_each(|(z, value)| *value = map[n * z + x]);
                self.transform.run(&mut column);
                count(plan, *cascade, x, &column, self.width_rad_s, &mut self.bins_m2);
            }
            self.done += 1;
            if self.done == 2 * n {
                self.maps.pop();
                self.done = 0;
            }
        }
        None
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
    use crate::model::query;
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
        let width = 0.01;
        let mut survey = Survey::new(&plan, vec![map(0.5, 3.0, 4.0), map(0.2, 10.0, 0.0)], width, 2000);
        let mut rounds = 0;
        let bins = loop {
            rounds += 1;
            if let Some(bins) = survey.advance(&plan, 1000) {
                break bins.to_vec();
            }
        };
        assert!(rounds > 4, "{rounds}");
        for (cascade, turns, variance) in [(0, 5.0, 0.125), (1, 10.0, 0.02)] {
            let bin = (plan.dispersion.omega(plan.cascades[cascade].dk() * turns) / width) as usize;
            assert!((bins[bin] - variance).abs() < 1e-12, "{} {variance}", bins[bin]);
        }
        assert!((bins.iter().sum::<f64>() - 0.145).abs() < 1e-12);
    }
}
