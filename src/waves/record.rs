//! Frequency spectrum of a buoy record, a series of surface heights at one point, by the method of Welch (1967).

use super::fft::Fft;
use std::f64::consts::TAU;

/// Number of height samples in each of the segments of a buoy's record, whose periodograms are averaged. It is large
/// enough to separate two swells and small enough to give several segments.
const SEGMENT_SAMPLES: usize = 512;

/// Frequency spectrum of the heights `heights_m` sampled at `rate_hz`: pairs of angular frequency omega (rad/s) and
/// one-sided variance density S(omega) (m^2 s).
///
/// It is the mean of the periodograms of segments that overlap by half. Each segment has its mean removed and a Hann
/// window applied. The last segment ends at the newest sample. The spectrum is empty if there is no full segment.
pub fn welch_spectrum(heights_m: &[f64], rate_hz: f64) -> Vec<[f64; 2]> {
    const SEGMENT_HOP_SAMPLES: usize = SEGMENT_SAMPLES / 2;
    let Some(spare) = heights_m.len().checked_sub(SEGMENT_SAMPLES) else { return Vec::new() };
    let segments = spare / SEGMENT_HOP_SAMPLES + 1;
    let window: Vec<f64> =
        (0..SEGMENT_SAMPLES).map(|i| 0.5 - 0.5 * (TAU * i as f64 / SEGMENT_SAMPLES as f64).cos()).collect();
    let window_power: f64 = window.iter().map(|w| w * w).sum();
    let fft = Fft::new(SEGMENT_SAMPLES);
    let mut power = vec![0.0; SEGMENT_SAMPLES / 2 + 1];
    for s in (0..segments).rev() {
        let segment = &heights_m[spare - s * SEGMENT_HOP_SAMPLES..][..SEGMENT_SAMPLES];
        let mean = segment.iter().sum::<f64>() / SEGMENT_SAMPLES as f64;
        let mut line: Vec<[f64; 2]> = segment.iter().zip(&window).map(|(h, w)| [(h - mean) * w, 0.0]).collect();
        fft.forward(&mut line);
        power.iter_mut().zip(&line).for_each(|(sum, x)| *sum += x[0] * x[0] + x[1] * x[1]);
    }
    // Converts the power per bin to a one-sided density per rad/s.
    let unit = 2.0 / (segments as f64 * window_power * rate_hz * TAU);
    let omega = |i: usize| TAU * rate_hz * i as f64 / SEGMENT_SAMPLES as f64;
    power.iter().enumerate().skip(1).map(|(i, x)| [omega(i), x * unit]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spectrum_of_a_wave_is_where_it_is_and_as_large() {
        let (amplitude, omega, rate) = (1.5, 0.7, 4.0);
        let heights: Vec<f64> = (0..7200).map(|i| amplitude * (omega * f64::from(i) / rate).cos() + 3.0).collect();
        let spectrum = welch_spectrum(&heights, rate);
        let step = spectrum[1][0] - spectrum[0][0];
        let m0: f64 = spectrum.iter().map(|p| p[1] * step).sum();
        assert!((m0 - 0.5 * amplitude * amplitude).abs() < 1e-3 * m0, "{m0}");
        let peak = spectrum.iter().fold([0.0; 2], |a, b| if b[1] > a[1] { *b } else { a });
        assert!((peak[0] - omega).abs() < step, "{peak:?}");
    }

    #[test]
    fn the_record_of_a_sea_has_its_height() {
        use crate::point::StrongestWaves;
        use crate::state::query;
        use crate::waves::Plan;
        let plan = Plan::new(&query::parse("wind=12&n=64").0);
        let sea = StrongestWaves::new(&plan, 400);
        let heights: Vec<f64> = (0..4096).map(|i| sea.sample(3.0, 5.0, f64::from(i) / 2.0).height_m).collect();
        let spectrum = welch_spectrum(&heights, 2.0);
        let step = spectrum[1][0] - spectrum[0][0];
        let hs = 4.0 * spectrum.iter().map(|p| p[1] * step).sum::<f64>().sqrt();
        let want = plan.hs_m();
        // Half an hour holds only a few hundred waves.
        assert!((hs / want - 1.0).abs() < 0.15, "{hs} {want}");
        assert_eq!(welch_spectrum(&heights[..100], 2.0), Vec::<[f64; 2]>::new());
    }
}
