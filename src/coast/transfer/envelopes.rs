//! The envelopes of a transfer while it is made.

use super::WaveGroup;
use super::half_float::{pack, unpack};
use super::setup::Wave;
use super::shore::Shore;
use crate::coast::complex::Complex;
use crate::coast::field::{ComponentField, wave_number_along_x};

/// Largest turn of an envelope between two points of the shore, rad, without the delay of the lobes. Drawn linearly
/// between them, the envelope loses an eighth of the turn's square in the middle.
const MAX_TURN_RAD: f64 = 1.0;

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

    /// Continues a wave over the shore: at each of its points the envelope is the mean of those around that are
    /// nearer to the open water. It turns by the phase that the wave gains along x on the carrier of its group, and by
    /// the delay of the lobes.
    pub(super) fn continue_ashore(&mut self, index: usize, wave: &Wave, group: &WaveGroup, shore: &Shore) {
        let columns = self.columns;
        let out = &mut self.packed[index * self.points..(index + 1) * self.points];
        for place in &shore.places {
            let mut sum = Complex::ZERO;
            for (source, weight) in &place.sources {
                let [to, from] = [place.point % columns, source % columns];
                let slowness_s_m = 0.5 * (shore.slowness_s_m[place.point] + shore.slowness_s_m[*source]);
                let kx_rad_m = wave_number_along_x(wave.omega_rad_s * slowness_s_m, group.ky_rad_m);
                let run_rad = kx_rad_m * (to as f64 - from as f64) * self.cell_m;
                let carried_rad = group.column_phase_rad[to] - group.column_phase_rad[from];
                let turn_rad = (run_rad - carried_rad).clamp(-MAX_TURN_RAD, MAX_TURN_RAD);
                let since_s = shore.delay_s[place.point] - shore.delay_s[*source];
                sum += unpack(out[*source]) * Complex::polar(*weight, turn_rad + wave.omega_rad_s * since_s);
            }
            out[place.point] = pack(sum);
            self.continued_m2[place.point] += 0.5 * wave.open_amplitude_m.powi(2) * sum.norm_squared();
        }
    }

    /// Multiplies a wave by a factor at some points, and sharpens it at those of open water. Nothing changes the wave after that.
    pub(super) fn scale(&mut self, index: usize, factors: &[(usize, f64)], is_open: impl Fn(usize) -> bool) {
        let out = &mut self.packed[index * self.points..(index + 1) * self.points];
        let mut envelope: Vec<Complex> = out.iter().map(|bits| unpack(*bits)).collect();
        factors.iter().for_each(|(point, factor)| envelope[*point] *= *factor);
        sharpen(&mut envelope, self.columns, is_open);
        out.iter_mut().zip(&envelope).for_each(|(bits, value)| *bits = pack(*value));
    }
}

/// Changes an envelope with `columns` points in a row so that it is best drawn linearly between its points. An envelope
/// that bends lies outside of the lines between its values, by delta^2 / 12 in the mean if its phase turns by delta from
/// point to point. A twelfth of the second differences moves the points so far outwards. That leaves the least mean square
/// error, less than half of what it was. Only points for which `is_open` move, along an axis on which both points beside
/// them are open, too.
pub fn sharpen(envelope: &mut [Complex], columns: usize, is_open: impl Fn(usize) -> bool) {
    let before = envelope.to_vec();
    let rows = before.len() / columns.max(1);
    for (point, out) in envelope.iter_mut().enumerate() {
        *out -= bend(point, [columns, rows], &is_open, |at| before[at]);
    }
}

/// The value that a sharpened envelope with the values `value` has in the mean around a point, drawn linearly to the points
/// beside it. So much was it at the point before.
pub(super) fn mean_drawn(
    point: usize,
    size: [usize; 2],
    is_open: impl Fn(usize) -> bool,
    value: impl Fn(usize) -> Complex,
) -> Complex {
    value(point) + bend(point, size, is_open, value)
}

/// A twelfth of the second differences at a point of a grid of `size` columns and rows.
fn bend(
    point: usize,
    [columns, rows]: [usize; 2],
    is_open: impl Fn(usize) -> bool,
    value: impl Fn(usize) -> Complex,
) -> Complex {
    let mut sum = Complex::ZERO;
    for (at, count, step) in [(point % columns, columns, 1), (point / columns, rows, columns)] {
        let is_inside = at > 0 && at + 1 < count;
        if is_inside && [point - step, point, point + step].into_iter().all(&is_open) {
            sum += (value(point - step) + value(point + step) - value(point) * 2.0) * (1.0 / 12.0);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rms error of linear interpolation of a turning envelope falls by the square root of 6 along one axis, and more
    /// along both. The envelope before can be told from the sharpened one.
    #[test]
    fn sharpened_envelopes_are_drawn_better() {
        let (columns, rows, turn) = (24, 20, [0.3, -0.2]);
        let wave = |x: f64, y: f64| Complex::polar(0.7, turn[0] * x + turn[1] * y);
        let plain: Vec<Complex> =
            (0..columns * rows).map(|i| wave((i % columns) as f64, (i / columns) as f64)).collect();
        let rms = |values: &[Complex]| {
            let mut sum = 0.0;
            for i in 0..400_usize {
                let [p, q] = [i % 20, i / 20].map(|part| (part as f64 + 0.5) / 20.0);
                let at = |dx: usize, dy: usize| values[(9 + dy) * columns + 10 + dx];
                let low = at(0, 0) * (1.0 - p) + at(1, 0) * p;
                let high = at(0, 1) * (1.0 - p) + at(1, 1) * p;
                sum += (low * (1.0 - q) + high * q - wave(10.0 + p, 9.0 + q)).norm_squared();
            }
            (sum / 400.0).sqrt()
        };
        let mut sharp = plain.clone();
        sharpen(&mut sharp, columns, |_| true);
        assert!(rms(&plain) > 6_f64.sqrt() * rms(&sharp), "{} {}", rms(&plain), rms(&sharp));
        let at = 9 * columns + 11;
        assert!((mean_drawn(at, [columns, rows], |_| true, |at| sharp[at]) - plain[at]).norm_squared().sqrt() < 2e-4);
        // A point beside the shore is sharpened along the shore alone: across it, its neighbour is not open water.
        let mut coast = plain.clone();
        sharpen(&mut coast, columns, |point| point % columns < 12);
        assert_eq!(coast[9 * columns + 12], plain[9 * columns + 12]);
        let along_only = plain[9 * columns + 11] * (1.0 + (1.0 - turn[1].cos()) / 6.0);
        assert!((coast[9 * columns + 11] - along_only).norm_squared() < 1e-20);
    }
}
