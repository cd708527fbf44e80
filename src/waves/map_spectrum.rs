//! Frequency spectrum of the sea estimated from height maps that were read back from the GPU.

use super::fft::Fft;
use super::plan::Plan;

/// Elevation variance of the height maps of all cascades at one time, in total and in each bin of angular frequency.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapSpectrum {
    /// Elevation variance m0, m^2: the sum over all cascades of the mean square elevation of their height maps.
    pub variance_m2: f64,
    /// Elevation variance in each bin of angular frequency, m^2. Bin i covers frequencies from i to i + 1 bin widths.
    pub bin_variances_m2: Vec<f64>,
}

/// Measures the spectrum of the sea in the GPU's height maps, as a [`MapSpectrum`], in small steps, so that the program
/// can draw frames in between.
#[derive(Clone, Debug)]
pub struct MapSpectrumEstimator {
    fft: Fft,
    /// Index of the cascade whose height map is being transformed in `map`.
    cascade: usize,
    map: Vec<[f64; 2]>,
    /// Number of transforms done on `map`, 0 to 2 n: first its n rows are Fourier-transformed, then its n columns.
    transformed_lines: usize,
    bin_rad_s: f64,
    spectrum: MapSpectrum,
}

impl MapSpectrumEstimator {
    /// Starts an estimate for all cascades of a plan, with `bins` frequency bins of the width `bin_rad_s` (rad/s).
    /// Waves with frequencies above the last bin count only in the total variance.
    ///
    /// # Panics
    /// Panics if the FFT size of the plan is not a power of two.
    pub fn new(plan: &Plan, bin_rad_s: f64, bins: usize) -> Self {
        let n = plan.n as usize;
        let spectrum = MapSpectrum { variance_m2: 0.0, bin_variances_m2: vec![0.0; bins] };
        Self { fft: Fft::new(n), cascade: 0, map: vec![[0.0; 2]; n * n], transformed_lines: 0, bin_rad_s, spectrum }
    }

    /// Transforms about `points` more texels of the height maps. Returns the spectrum when all are done, else `None`.
    ///
    /// `row(cascade, z)` returns the n heights (m) in row z of a cascade's map. All calls must see the same maps.
    pub fn advance<R: Iterator<Item = f64>>(
        &mut self,
        plan: &Plan,
        points: usize,
        row: impl Fn(usize, usize) -> R,
    ) -> Option<&MapSpectrum> {
        let n = plan.n as usize;
        for _ in 0..points.div_ceil(n) {
            if self.cascade == plan.cascades.len() {
                break;
            }
            if self.transformed_lines < n {
                let line = &mut self.map[n * self.transformed_lines..n * (self.transformed_lines + 1)];
                line.iter_mut()
                    .zip(row(self.cascade, self.transformed_lines))
                    .for_each(|(to, height)| *to = [height, 0.0]);
                self.spectrum.variance_m2 += line.iter().map(|h| h[0] * h[0]).sum::<f64>() / (n * n) as f64;
                self.fft.forward(line);
            } else {
                let x = self.transformed_lines - n;
                let mut column: Vec<[f64; 2]> = self.map[x..].iter().step_by(n).copied().collect();
                self.fft.forward(&mut column);
                self.add_column(plan, x, &column);
            }
            self.transformed_lines += 1;
            if self.transformed_lines == 2 * n {
                self.cascade += 1;
                self.transformed_lines = 0;
            }
        }
        (self.cascade == plan.cascades.len()).then_some(&self.spectrum)
    }

    /// Adds the elevation variance of all waves in `column`, the column `x` of the Fourier-transformed height map of
    /// the current cascade, to the frequency bins of these waves.
    fn add_column(&mut self, plan: &Plan, x: usize, column: &[[f64; 2]]) {
        let n = column.len();
        let signed = |i: usize| if i < n / 2 { i as f64 } else { i as f64 - n as f64 };
        let unit = 1.0 / (n as f64).powi(4);
        let dk = plan.cascades[self.cascade].dk();
        for (z, h) in column.iter().enumerate().filter(|(z, _)| (x, *z) != (0, 0)) {
            let k = dk * signed(x).hypot(signed(z));
            let bin = (plan.dispersion.omega(k) / self.bin_rad_s) as usize;
            if let Some(sum) = self.spectrum.bin_variances_m2.get_mut(bin) {
                *sum += unit * (h[0] * h[0] + h[1] * h[1]);
            }
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
        // The first map has a wave of 3 periods along x and 4 along z, the second one of 10 periods along x.
        let map = |amplitude: f64, ix: f64, iz: f64| -> Vec<f64> {
            let phase = |i: usize| TAU * (ix * (i % n) as f64 + iz * (i / n) as f64) / n as f64;
            (0..n * n).map(|i| 0.7 + amplitude * (phase(i) + 0.3).cos()).collect()
        };
        let maps = [map(0.5, 3.0, 4.0), map(0.2, 10.0, 0.0)];
        let row = |cascade: usize, z: usize| maps[cascade][n * z..n * (z + 1)].iter().copied();
        let width = 0.01;
        let mut estimator = MapSpectrumEstimator::new(&plan, width, 2000);
        let mut rounds = 0;
        let MapSpectrum { variance_m2, bin_variances_m2: bins } = loop {
            rounds += 1;
            if let Some(spectrum) = estimator.advance(&plan, 1000, row) {
                break spectrum.clone();
            }
        };
        assert!(rounds > 4, "{rounds}");
        for (cascade, turns, variance) in [(0, 5.0, 0.125), (1, 10.0, 0.02)] {
            let bin = (plan.dispersion.omega(plan.cascades[cascade].dk() * turns) / width) as usize;
            assert!((bins[bin] - variance).abs() < 1e-12, "{} {variance}", bins[bin]);
        }
        assert!((bins.iter().sum::<f64>() - 0.145).abs() < 1e-12);
        // The mean square height includes the mean level, which is in no bin.
        assert!((variance_m2 - 0.145 - 2.0 * 0.49).abs() < 1e-12, "{variance_m2}");
    }
}
