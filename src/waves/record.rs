//! What a record of heights at one point tells: its spectrum after Welch (1967).

use super::transform::Transform;
use std::f64::consts::TAU;

/// Samples of a segment: long enough to tell two swells apart, short enough for an average of several.
const SEGMENT: usize = 512;

/// S(omega) of a record sampled `rate_hz` times a second: pairs of omega (rad/s) and density (m^2 s), from segments that
/// overlap by half, each with its mean taken off and a Hann window. Empty if the record is shorter than one segment.
pub fn spectrum(heights_m: &[f64], rate_hz: f64) -> Vec<[f64; 2]> {
    let segments = if heights_m.len() < SEGMENT { 0 } else { (heights_m.len() - SEGMENT) / (SEGMENT / 2) + 1 };
    if segments == 0 {
        return Vec::new();
    }
    let window: Vec<f64> = (0..SEGMENT).map(|i| 0.5 - 0.5 * (TAU * i as f64 / SEGMENT as f64).cos()).collect();
    let power: f64 = window.iter().map(|w| w * w).sum();
    let transform = Transform::new(SEGMENT);
    let mut sum = vec![0.0; SEGMENT / 2 + 1];
    for s in 0..segments {
        // The newest samples always count: segments are laid from the end.
        let first = heights_m.len() - SEGMENT - (segments - 1 - s) * (SEGMENT / 2);
        let part = &heights_m[first..first + SEGMENT];
        let mean = part.iter().sum::<f64>() / SEGMENT as f64;
        let mut line: Vec<[f64; 2]> = part.iter().zip(&window).map(|(h, w)| [(h - mean) * w, 0.0]).collect();
        transform.run(&mut line);
        for (sum, x) in sum.iter_mut().zip(&line) {
            *sum += x[0] * x[0] + x[1] * x[1];
        }
    }
    // Both signs of the frequency, per rad/s.
    let unit = 2.0 / (segments as f64 * power * rate_hz * TAU);
    let omega = |i: usize| TAU * rate_hz * i as f64 / SEGMENT as f64;
    sum.iter().enumerate().skip(1).map(|(i, x)| [omega(i), x * unit]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spectrum_of_a_wave_is_where_it_is_and_as_large() {
        let (amplitude, omega, rate) = (1.5, 0.7, 4.0);
        let heights: Vec<f64> = (0..7200).map(|i| amplitude * (omega * f64::from(i) / rate).cos() + 3.0).collect();
        let spectrum = spectrum(&heights, rate);
        let step = spectrum[1][0] - spectrum[0][0];
        let m0: f64 = spectrum.iter().map(|p| p[1] * step).sum();
        assert!((m0 - 0.5 * amplitude * amplitude).abs() < 1e-3 * m0, "{m0}");
        let peak = spectrum.iter().fold([0.0; 2], |a, b| if b[1] > a[1] { *b } else { a });
        assert!((peak[0] - omega).abs() < step, "{peak:?}");
    }

    #[test]
    fn the_record_of_a_sea_has_its_height() {
        use crate::point::Heights;
        use crate::state::query;
        use crate::waves::Plan;
        let plan = Plan::new(&query::parse("wind=12&n=64").0);
        let sea = Heights::new(&plan, 400);
        let heights: Vec<f64> = (0..4096).map(|i| sea.sample(3.0, 5.0, f64::from(i) / 2.0).height_m).collect();
        let spectrum = spectrum(&heights, 2.0);
        let step = spectrum[1][0] - spectrum[0][0];
        let hs = 4.0 * spectrum.iter().map(|p| p[1] * step).sum::<f64>().sqrt();
        let want = plan.hs_m();
        // Half an hour of one sea: a few hundred waves.
        assert!((hs / want - 1.0).abs() < 0.15, "{hs} {want}");
        assert_eq!(super::spectrum(&heights[..100], 2.0), Vec::<[f64; 2]>::new());
    }
}
