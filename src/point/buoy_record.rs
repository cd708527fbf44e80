//! The record of a buoy: the height of the sea at one point over time, with its significant wave height, spectrum and
//! single waves.

use crate::waves::crests::WaveRecordStatistics;
use crate::waves::record;
use std::collections::VecDeque;

/// Number of height samples that a buoy takes per second of simulated time, Hz.
const SAMPLE_RATE_HZ: f64 = 4.0;
/// Longest buoy record, s: half an hour, as is usual for buoys. Older samples are dropped.
const RECORD_LENGTH_S: f64 = 1800.0;
/// Simulated time between two computations of a record's spectrum and waves, s.
const SPECTRUM_INTERVAL_S: f64 = 10.0;
/// Longest step of simulated time between updates, s, that is filled with samples; a longer one starts a new record.
const LONGEST_GAP_S: f64 = 5.0;

/// Record of a buoy: the surface height at one point over the last half hour of simulated time or less.
#[derive(Default)]
pub struct BuoyRecord {
    /// Position of the buoy (x, z), m.
    place: [f64; 2],
    /// Samples as pairs of time (s) and height above the still water (m), oldest first.
    samples: VecDeque<[f64; 2]>,
    /// Latest frequency spectrum as pairs of angular frequency omega (rad/s) and variance density S(omega) (m^2 s).
    spectrum: Vec<[f64; 2]>,
    /// Latest statistics of the record's waves.
    waves: Option<WaveRecordStatistics>,
    /// Number of samples taken after the latest spectrum was computed.
    samples_since_spectrum: usize,
}

impl BuoyRecord {
    /// Adds samples to the record up to the time `t_s` (s), four per second whatever the frame rate. `height(t)`
    /// returns the height above still water (m) at `place` (x, z; m) at time t (s). Another place, a time before the
    /// last sample or more than 5 s after it starts a new record.
    pub fn advance(&mut self, t_s: f64, place: [f64; 2], height: impl Fn(f64) -> f64) {
        let moved = place != self.place;
        let last = self.samples.back().map(|s| s[0]);
        let jumped = last.is_some_and(|last| t_s < last || t_s - last > LONGEST_GAP_S);
        if moved || jumped || last.is_none() {
            *self = Self { place, ..Self::default() };
            let first = (t_s * SAMPLE_RATE_HZ).floor() / SAMPLE_RATE_HZ;
            self.samples.push_back([first, height(first)]);
            return;
        }
        let first = (last.unwrap_or(t_s) * SAMPLE_RATE_HZ).round() as i64 + 1;
        for i in first..=(t_s * SAMPLE_RATE_HZ).floor() as i64 {
            let t = i as f64 / SAMPLE_RATE_HZ;
            self.samples.push_back([t, height(t)]);
            self.samples_since_spectrum += 1;
        }
        while self.samples.len() > (RECORD_LENGTH_S * SAMPLE_RATE_HZ) as usize {
            self.samples.pop_front();
        }
        if self.samples_since_spectrum >= (SPECTRUM_INTERVAL_S * SAMPLE_RATE_HZ) as usize {
            let heights: Vec<f64> = self.samples.iter().map(|s| s[1]).collect();
            self.spectrum = record::welch_spectrum(&heights, SAMPLE_RATE_HZ);
            self.waves = WaveRecordStatistics::new(&[heights], 1.0 / SAMPLE_RATE_HZ);
            self.samples_since_spectrum = 0;
        }
    }

    /// Samples as pairs of time (s) and height above the still water (m), oldest first.
    pub fn samples(&self) -> &VecDeque<[f64; 2]> {
        &self.samples
    }

    /// Duration of the record, s.
    pub fn length_s(&self) -> f64 {
        self.samples.len() as f64 / SAMPLE_RATE_HZ
    }

    /// Whether the record reaches up to the time `t_s` (s): its last sample was taken at that time or less than one
    /// sample interval (0.25 s) before it.
    pub fn is_current(&self, t_s: f64) -> bool {
        self.samples.back().is_some_and(|last| (0.0..1.0 / SAMPLE_RATE_HZ).contains(&(t_s - last[0])))
    }

    /// Removes all samples, the spectrum and the waves, for example because another sea is drawn.
    pub fn clear(&mut self) {
        self.samples.clear();
        self.spectrum.clear();
        self.waves = None;
        self.samples_since_spectrum = 0;
    }

    /// Significant wave height of the record, m: four standard deviations of the height. `None` if the record is
    /// shorter than 30 s.
    pub fn hs_m(&self) -> Option<f64> {
        let n = self.samples.len() as f64;
        if n < 30.0 * SAMPLE_RATE_HZ {
            return None;
        }
        let mean = self.samples.iter().map(|s| s[1]).sum::<f64>() / n;
        Some(4.0 * (self.samples.iter().map(|s| (s[1] - mean).powi(2)).sum::<f64>() / n).sqrt())
    }

    /// Latest frequency spectrum of the record, renewed every 10 s, as pairs of angular frequency omega (rad/s) and
    /// variance density S(omega) (m^2 s). Empty in the first two minutes of a record.
    pub fn spectrum(&self) -> &[[f64; 2]] {
        &self.spectrum
    }

    /// Latest statistics of the record's waves, renewed every 10 s; `None` in the first 10 s of a record.
    pub fn waves(&self) -> Option<&WaveRecordStatistics> {
        self.waves.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The period of the waves changes after an hour, long after the record has reached its full length.
    #[test]
    fn the_spectrum_follows_the_waves_of_a_full_record() {
        let mut record = BuoyRecord::default();
        let height = |t: f64| if t < 3600.0 { (0.5 * t).sin() } else { (1.5 * t).sin() };
        let peak = |record: &BuoyRecord| {
            record.spectrum().iter().copied().max_by(|a, b| a[1].total_cmp(&b[1])).map_or(0.0, |p| p[0])
        };
        for second in 0..3600 {
            record.advance(f64::from(second), [0.0; 2], height);
        }
        assert!((peak(&record) - 0.5).abs() < 0.1, "{}", peak(&record));
        for second in 3600..5460 {
            record.advance(f64::from(second), [0.0; 2], height);
        }
        assert!((peak(&record) - 1.5).abs() < 0.1, "{}", peak(&record));
    }
}
