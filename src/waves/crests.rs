//! Crests, troughs, heights, moments and groups of the waves in a record: heights of the surface at one point at equal
//! steps of time. `crest_theory` has the distributions that theory expects.

use super::statistics::mean_sd_skewness_kurtosis;
use std::ops::Range;

/// Number of blocks of equal length into which a record is divided to estimate the errors of its moments.
const BLOCKS: usize = 16;

/// A wave between two up-crossings of the mean level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZeroCrossingWave {
    /// Height of the highest point above the mean level, m.
    pub crest_m: f64,
    /// Depth of the lowest point below the mean level, m, positive.
    pub trough_m: f64,
    /// Time between the two up-crossings, s.
    pub period_s: f64,
}

impl ZeroCrossingWave {
    /// Height from the trough to the crest before it, m.
    pub fn height_m(&self) -> f64 {
        self.crest_m + self.trough_m
    }
}

/// Waves between up-crossings of the mean level in heights (m) sampled every `step_s` (s). The waves before the first
/// and after the last up-crossing are left out. Crests and troughs are those of parabolas through three samples, the
/// times of crossings are interpolated linearly.
pub fn zero_up_crossing_waves(heights_m: &[f64], step_s: f64) -> Vec<ZeroCrossingWave> {
    let mean = heights_m.iter().sum::<f64>() / heights_m.len().max(1) as f64;
    let eta = |i: usize| heights_m[i] - mean;
    let crossings: Vec<usize> = (1..heights_m.len()).filter(|&i| eta(i - 1) < 0.0 && eta(i) >= 0.0).collect();
    let time_s = |i: usize| step_s * (i as f64 - eta(i) / (eta(i) - eta(i - 1)));
    let highest = |range: Range<usize>, sign: f64| {
        let at = |i: usize| sign * eta(i);
        range.map(|i| parabola_top([at(i - 1), at(i), at(i + 1)])).fold(0.0, f64::max)
    };
    (crossings.windows(2))
        .map(|pair| ZeroCrossingWave {
            // The last up-crossing has a sample before it, and so has every sample of the range one after it.
            crest_m: highest(pair[0]..pair[1], 1.0),
            trough_m: highest(pair[0]..pair[1], -1.0),
            period_s: time_s(pair[1]) - time_s(pair[0]),
        })
        .collect()
}

/// Largest value of the parabola through three samples at equal steps if the middle one is the largest of them, else
/// the middle sample.
fn parabola_top([before, here, after]: [f64; 3]) -> f64 {
    let bend = 2.0 * here - before - after;
    if here >= before && here >= after && bend > 0.0 { here + (after - before).powi(2) / (8.0 * bend) } else { here }
}

/// Values, such as crest heights, in descending order: how often each of them is exceeded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exceedance {
    descending_m: Vec<f64>,
}

impl Exceedance {
    /// Sorts `values_m` (m).
    pub fn new(values_m: impl Iterator<Item = f64>) -> Self {
        let mut descending_m: Vec<f64> = values_m.collect();
        descending_m.sort_by(|a, b| b.total_cmp(a));
        Self { descending_m }
    }

    /// Number of values.
    pub fn count(&self) -> usize {
        self.descending_m.len()
    }

    /// Value (m) that a value exceeds with the probability `p`, interpolated between the two nearest ones. The i-th
    /// largest of N values has the probability i / (N + 1). `None` beyond the largest or the smallest value.
    pub fn value_m(&self, p: f64) -> Option<f64> {
        let rank = p * (self.count() as f64 + 1.0) - 1.0;
        if !(0.0..=self.count() as f64 - 1.0).contains(&rank) {
            return None;
        }
        let (below, part) = (rank as usize, rank.fract());
        let next = self.descending_m[(below + 1).min(self.count() - 1)];
        Some(self.descending_m[below] + part * (next - self.descending_m[below]))
    }

    /// Points (value in m, probability of exceedance) for a plot: each of the largest hundred values, then ever fewer.
    pub fn points(&self) -> Vec<[f64; 2]> {
        let all = self.count() as f64 + 1.0;
        let mut out = Vec::new();
        let mut i = 0;
        while i < self.count() {
            out.push([self.descending_m[i], (i as f64 + 1.0) / all]);
            i += 1 + i / 100;
        }
        out
    }
}

/// An estimate with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The estimated value.
    pub value: f64,
    /// Standard error of the value.
    pub standard_error: f64,
}

/// Moments of the heights of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordMoments {
    /// Mean height, m.
    pub mean_m: f64,
    /// Standard deviation of the height, m; a quarter of the significant wave height.
    pub sd_m: f64,
    /// Skewness of the height; 0 for a Gaussian.
    pub skewness: Estimate,
    /// Kurtosis of the height; 3 for a Gaussian.
    pub kurtosis: Estimate,
}

impl RecordMoments {
    /// Moments of `records` (heights in m), taken together. The errors come from leaving out one of 16 blocks of equal
    /// length at a time (jackknife). If the blocks are much longer than a wave group, they are independent. `None` for
    /// fewer samples than blocks, or without variance.
    pub fn new(records: &[Vec<f64>]) -> Option<Self> {
        let all: Vec<f64> = records.iter().flatten().copied().collect();
        if all.len() < BLOCKS {
            return None;
        }
        let reference = all.iter().sum::<f64>() / all.len() as f64;
        let block = |i: usize| &all[i * all.len() / BLOCKS..(i + 1) * all.len() / BLOCKS];
        let sums: Vec<[f64; 5]> = (0..BLOCKS)
            .map(|i| {
                block(i)
                    .iter()
                    .fold([0.0; 5], |sums, x| std::array::from_fn(|p| sums[p] + (x - reference).powi(p as i32)))
            })
            .collect();
        let shape_without = |left_out: Option<usize>| {
            let kept = sums.iter().enumerate().filter(|(i, _)| Some(*i) != left_out);
            mean_sd_skewness_kurtosis(
                kept.fold([0.0; 5], |total, (_, sums)| std::array::from_fn(|p| total[p] + sums[p])),
            )
        };
        let [mean, sd, ..] = shape_without(None);
        let estimate = |which: usize| {
            let replicates: Vec<f64> = (0..BLOCKS).map(|i| shape_without(Some(i))[which]).collect();
            let mean = replicates.iter().sum::<f64>() / BLOCKS as f64;
            let squares: f64 = replicates.iter().map(|x| (x - mean).powi(2)).sum();
            let factor = (BLOCKS as f64 - 1.0) / BLOCKS as f64;
            Estimate { value: shape_without(None)[which], standard_error: (factor * squares).sqrt() }
        };
        (sd > 0.0).then(|| Self { mean_m: reference + mean, sd_m: sd, skewness: estimate(2), kurtosis: estimate(3) })
    }
}

/// Groups of high waves: runs of successive waves that are all higher than a threshold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaveGroups {
    /// Number of complete runs of high waves.
    pub run_count: usize,
    /// Mean number of waves in a run; 0 without a run.
    pub mean_run_length: f64,
    /// Mean number of waves from the begin of a run to that of the next; 0 with fewer than two runs.
    pub mean_repeat_length: f64,
}

impl WaveGroups {
    /// Groups of waves that are higher than `threshold_m` (m) in `records` of successive waves. Runs at the ends of a
    /// record count only if they are complete.
    pub fn new(records: &[Vec<ZeroCrossingWave>], threshold_m: f64) -> Self {
        let (mut run_count, mut high_waves, mut repeats, mut repeated_waves) = (0, 0, 0, 0);
        for waves in records {
            let is_high = |i: usize| waves[i].height_m() > threshold_m;
            let starts: Vec<usize> = (1..waves.len()).filter(|&i| is_high(i) && !is_high(i - 1)).collect();
            for &start in &starts {
                let end = (start..waves.len()).find(|&i| !is_high(i));
                if let Some(end) = end {
                    run_count += 1;
                    high_waves += end - start;
                }
            }
            repeats += starts.len().saturating_sub(1);
            repeated_waves += starts.last().map_or(0, |last| last - starts[0]);
        }
        let ratio = |a: usize, b: usize| if b > 0 { a as f64 / b as f64 } else { 0.0 };
        Self {
            run_count,
            mean_run_length: ratio(high_waves, run_count),
            mean_repeat_length: ratio(repeated_waves, repeats),
        }
    }
}

/// Statistics of the waves in one record or several of the same sea.
#[derive(Clone, Debug, PartialEq)]
pub struct WaveRecordStatistics {
    /// Moments of the heights.
    pub moments: RecordMoments,
    /// Significant wave height, m: four standard deviations.
    pub hs_m: f64,
    /// Mean period between up-crossings of the mean level, s; 0 without a wave.
    pub mean_period_s: f64,
    /// Heights of the crests above the mean level.
    pub crests: Exceedance,
    /// Depths of the troughs below the mean level.
    pub troughs: Exceedance,
    /// Wave heights from trough to crest.
    pub heights: Exceedance,
    /// Groups of waves higher than the significant wave height.
    pub groups: WaveGroups,
}

impl WaveRecordStatistics {
    /// Statistics of `records`: heights in m at one point each, sampled every `step_s` (s). `None` without variance.
    pub fn new(records: &[Vec<f64>], step_s: f64) -> Option<Self> {
        let moments = RecordMoments::new(records)?;
        let waves: Vec<Vec<ZeroCrossingWave>> = records.iter().map(|r| zero_up_crossing_waves(r, step_s)).collect();
        let all = || waves.iter().flatten();
        let count = all().count().max(1) as f64;
        let hs_m = 4.0 * moments.sd_m;
        Some(Self {
            moments,
            hs_m,
            mean_period_s: all().map(|w| w.period_s).sum::<f64>() / count,
            crests: Exceedance::new(all().map(|w| w.crest_m)),
            troughs: Exceedance::new(all().map(|w| w.trough_m)),
            heights: Exceedance::new(all().map(ZeroCrossingWave::height_m)),
            groups: WaveGroups::new(&waves, hs_m),
        })
    }
}

/// Records in units of the significant wave height of each, so that records of several seeds, whose heights differ by
/// chance, can be taken together. Records without variance are left out.
pub fn in_units_of_hs(records: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let scaled = |record: &Vec<f64>| {
        let hs = 4.0 * RecordMoments::new(std::slice::from_ref(record))?.sd_m;
        Some(record.iter().map(|x| x / hs).collect())
    };
    records.iter().filter_map(scaled).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::noise;
    use std::f64::consts::TAU;

    #[test]
    fn waves_of_a_sine_have_its_height_and_period() {
        let (period_s, step_s) = (7.3, 0.5);
        let heights: Vec<f64> =
            (0..400).map(|i| 5.0 + 1.5 * (TAU * f64::from(i) * step_s / period_s + 1.0).sin()).collect();
        let waves = zero_up_crossing_waves(&heights, step_s);
        assert_eq!(waves.len(), 26);
        let mean = |f: &dyn Fn(&ZeroCrossingWave) -> f64| waves.iter().map(f).sum::<f64>() / waves.len() as f64;
        // The mean of a record that ends within a wave is not exactly the level of the sine.
        for wave in &waves {
            assert!((wave.height_m() - 3.0).abs() < 0.005, "{wave:?}");
        }
        assert!((mean(&|w| w.period_s) - period_s).abs() < 0.01);
        assert!((mean(&|w| w.crest_m) - mean(&|w| w.trough_m)).abs() < 0.1);
        assert!(zero_up_crossing_waves(&[], 1.0).is_empty() && zero_up_crossing_waves(&[1.0; 9], 1.0).is_empty());
    }

    #[test]
    fn a_stokes_wave_has_high_crests_and_flat_troughs() {
        let eta = |t: f64| t.cos() + 0.1 * (2.0 * t).cos();
        let heights: Vec<f64> = (0..3142).map(|i| eta(0.2 * f64::from(i))).collect();
        for wave in zero_up_crossing_waves(&heights, 0.2) {
            assert!((wave.crest_m - 1.1).abs() < 0.002 && (wave.trough_m - 0.9).abs() < 0.002, "{wave:?}");
        }
        let moments = RecordMoments::new(&[heights]).expect("moments");
        // Skewness 3 a b / (4 sd^3) with a = 1, b = 0.1: 3 <eta^3> of the pair is 3/4 a^2 b.
        let variance: f64 = 0.5 * (1.0 + 0.01);
        assert!((moments.skewness.value - 0.075 / variance.powf(1.5)).abs() < 0.002, "{moments:?}");
    }

    #[test]
    fn exceedance_counts_ranks() {
        let some = Exceedance::new([1.0, 4.0, 2.0, 3.0].into_iter());
        assert_eq!(some.value_m(0.2), Some(4.0));
        assert_eq!(some.value_m(0.5), Some(2.5));
        assert_eq!((some.value_m(0.1), some.value_m(0.9)), (None, None));
        assert_eq!(some.points(), vec![[4.0, 0.2], [3.0, 0.4], [2.0, 0.6], [1.0, 0.8]]);
        assert_eq!(Exceedance::default().value_m(0.5), None);
        assert!(Exceedance::new((0..100_000).map(f64::from)).points().len() < 1000);
    }

    #[test]
    fn moments_of_independent_numbers_have_their_theoretical_errors() {
        let gauss = |i: u32| {
            let [a, b, ..] = noise::pcg4d([i, 3, 5, 7]);
            noise::complex_gaussian([a, b])[0]
        };
        let numbers: Vec<f64> = (0..40_000).map(gauss).collect();
        let moments = RecordMoments::new(&[numbers]).expect("moments");
        // Standard errors sqrt(6 / N) and sqrt(24 / N).
        for (estimate, expected, error) in [(moments.skewness, 0.0, 6.0f64), (moments.kurtosis, 3.0, 24.0)] {
            let error = (error / 40_000.0).sqrt();
            assert!((estimate.value - expected).abs() < 4.0 * error, "{moments:?}");
            assert!((estimate.standard_error / error - 1.0).abs() < 0.5, "{moments:?}");
        }
        assert!(RecordMoments::new(&[vec![2.0; 100]]).is_none() && RecordMoments::new(&[vec![]]).is_none());
    }

    #[test]
    fn groups_are_runs_of_high_waves() {
        let waves = |heights: &[f64]| -> Vec<ZeroCrossingWave> {
            heights.iter().map(|h| ZeroCrossingWave { crest_m: 0.5 * h, trough_m: 0.5 * h, period_s: 8.0 }).collect()
        };
        let groups = WaveGroups::new(&[waves(&[3.0, 1.0, 3.0, 3.0, 1.0, 1.0, 3.0, 1.0, 3.0])], 2.0);
        assert_eq!(groups, WaveGroups { run_count: 2, mean_run_length: 1.5, mean_repeat_length: 3.0 });
        assert_eq!(WaveGroups::new(&[], 2.0), WaveGroups::default());
    }
}
