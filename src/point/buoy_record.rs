//! The record of a buoy: the height of the sea at one point over time, with its significant wave height and spectrum.

use crate::waves::record;
use std::collections::VecDeque;

/// Samples per second.
const RATE_HZ: f64 = 4.0;
/// Length of the record, s: the half hour that is usual for buoys.
const LENGTH_S: f64 = 1800.0;
/// Longest gap within a record, s; after a longer one a new record starts.
const LONGEST_GAP_S: f64 = 5.0;

/// A record at one place.
#[derive(Default)]
pub struct BuoyRecord {
    /// Position, m east and south.
    place: [f64; 2],
    /// Time and height above the still water, s and m.
    samples: VecDeque<[f64; 2]>,
    /// omega and S(omega) of the record, and the number of samples they were computed from.
    spectrum: (Vec<[f64; 2]>, usize),
}

impl BuoyRecord {
    /// Samples the heights since the last call at a fixed rate, independent of the frame rate.
    pub fn advance(&mut self, t_s: f64, place: [f64; 2], height: impl Fn(f64) -> f64) {
        let moved = place != self.place;
        let last = self.samples.back().map(|s| s[0]);
        let jumped = last.is_some_and(|last| t_s < last || t_s - last > LONGEST_GAP_S);
        if moved || jumped || last.is_none() {
            *self = Self { place, ..Self::default() };
            let first = (t_s * RATE_HZ).floor() / RATE_HZ;
            self.samples.push_back([first, height(first)]);
            return;
        }
        let first = (last.unwrap_or(t_s) * RATE_HZ).round() as i64 + 1;
        for i in first..=(t_s * RATE_HZ).floor() as i64 {
            let t = i as f64 / RATE_HZ;
            self.samples.push_back([t, height(t)]);
        }
        while self.samples.len() > (LENGTH_S * RATE_HZ) as usize {
            self.samples.pop_front();
        }
        // A new spectrum every ten seconds.
        if self.samples.len() >= self.spectrum.1 + (10.0 * RATE_HZ) as usize {
            let heights: Vec<f64> = self.samples.iter().map(|s| s[1]).collect();
            self.spectrum = (record::spectrum(&heights, RATE_HZ), self.samples.len());
        }
    }

    /// Times and heights above the still water, s and m.
    pub fn samples(&self) -> &VecDeque<[f64; 2]> {
        &self.samples
    }

    /// Length of the record, s.
    pub fn length_s(&self) -> f64 {
        self.samples.len() as f64 / RATE_HZ
    }

    /// Whether the record reaches a time.
    pub fn is_current(&self, t_s: f64) -> bool {
        self.samples.back().is_some_and(|last| (0.0..1.0 / RATE_HZ).contains(&(t_s - last[0])))
    }

    /// Clears the record for another sea.
    pub fn clear(&mut self) {
        self.samples.clear();
        self.spectrum = (Vec::new(), 0);
    }

    /// Significant wave height of the record, m: four standard deviations, after 30 s.
    pub fn hs_m(&self) -> Option<f64> {
        let n = self.samples.len() as f64;
        if n < 30.0 * RATE_HZ {
            return None;
        }
        let mean = self.samples.iter().map(|s| s[1]).sum::<f64>() / n;
        Some(4.0 * (self.samples.iter().map(|s| (s[1] - mean).powi(2)).sum::<f64>() / n).sqrt())
    }

    /// omega (rad/s) and S(omega) (m^2 s) of the record; empty at its start.
    pub fn spectrum(&self) -> &[[f64; 2]] {
        &self.spectrum.0
    }
}
