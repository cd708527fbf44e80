//! The envelopes of a transfer while it is made.

use super::WaveGroup;
use super::half_float::{pack, unpack};
use super::setup::Wave;
use super::shore::Shore;
use crate::coast::complex::Complex;
use crate::coast::field::ComponentField;

/// Packed envelopes of all waves, and the variance of their sum.
pub(super) struct Envelopes {
    columns: usize,
    cell_m: f64,
    points: usize,
    /// Half floats as in [`Transfer::envelopes`](super::Transfer::envelopes).
    pub(super) packed: Vec<u32>,
    /// Variance of the solved waves at each point, m^2.
    pub(super) variance_m2: Vec<f64>,
    /// That of the shortest third of the waves alone, m^2.
    pub(super) short_variance_m2: Vec<f64>,
    /// Variance of the waves as they were continued ashore, m^2.
    pub(super) continued_m2: Vec<f64>,
}

impl Envelopes {
    pub(super) fn new(waves: usize, columns: usize, rows: usize, cell_m: f64) -> Self {
        let points = columns * rows;
        Self {
            columns,
            cell_m,
            points,
            packed: vec![0; waves * points],
            variance_m2: vec![0.0; points],
            short_variance_m2: vec![0.0; points],
            continued_m2: vec![0.0; points],
        }
    }

    /// Stores the solved field of the wave with the index `index`.
    pub(super) fn store(
        &mut self,
        index: usize,
        wave: &Wave,
        field: &ComponentField,
        group: &WaveGroup,
        is_short: bool,
    ) {
        let rows = self.points / self.columns;
        let scale = 1.0 / wave.open_amplitude_m;
        let turn = |i: usize| Complex::polar(scale, field.carrier.phase_rad[i] - group.column_phase_rad[i]);
        let along_x: Vec<Complex> = (0..self.columns).map(turn).collect();
        let out = &mut self.packed[index * self.points..(index + 1) * self.points];
        for j in 0..rows {
            let y_m = j as f64 * self.cell_m;
            let along_y = Complex::polar(1.0, (field.carrier.ky_rad_m - group.ky_rad_m) * y_m);
            for i in 0..self.columns {
                let point = j * self.columns + i;
                let [re, im] = field.envelope[point].map(f64::from);
                let value = Complex::new(re, im);
                let variance_m2 = 0.5 * value.norm_squared();
                self.variance_m2[point] += variance_m2;
                if is_short {
                    self.short_variance_m2[point] += variance_m2;
                }
                out[point] = pack(value * along_x[i] * along_y);
            }
        }
    }

    /// Continues a wave over the shore: at each of its points the envelope is the mean of those around that are nearer to the
    /// open water. So the wave goes on as its carrier does.
    pub(super) fn continue_ashore(&mut self, index: usize, wave: &Wave, shore: &Shore) {
        let out = &mut self.packed[index * self.points..(index + 1) * self.points];
        for place in &shore.places {
            let mut sum = Complex::ZERO;
            for (source, weight) in &place.sources {
                sum += unpack(out[*source]) * *weight;
            }
            out[place.point] = pack(sum);
            self.continued_m2[place.point] += 0.5 * wave.open_amplitude_m.powi(2) * sum.norm_squared();
        }
    }

    /// Multiplies a wave by a factor at some points.
    pub(super) fn scale(&mut self, index: usize, factors: &[(usize, f64)]) {
        let out = &mut self.packed[index * self.points..(index + 1) * self.points];
        for (point, factor) in factors {
            out[*point] = pack(unpack(out[*point]) * *factor);
        }
    }
}
