//! Rain: sizes, number and fall of its drops, the light that they take, and the waves that they make. Rates are in
//! mm/h.

use std::f64::consts::PI;

/// Number of drops per volume and diameter, 1/(m^3 mm), that the distribution of Marshall and Palmer (1948) has at
/// diameter 0: N(D) = N0 exp(-slope D).
const DROPS_PER_M3_MM: f64 = 8000.0;
/// Fall speed of drops of the diameter D, mm: 9.65 - 10.3 exp(-0.6 D), m/s (Atlas, Srivastava and Sekhon 1973).
const FALL_SPEED_M_S: [f64; 2] = [9.65, 10.3];
const FALL_SPEED_PER_MM: f64 = 0.6;
/// Extinction cross-section of a drop divided by its area: half is blocked, and as much is diffracted.
const EXTINCTION_EFFICIENCY: f64 = 2.0;
/// Wave number of the ring waves that carry most energy, rad/m, from the dispersion of waves with surface tension.
const RING_WAVE_NUMBER: f64 = 121.0;
/// Rain rate over which the turbulence that drops stir reduces the variance of short wind waves to 1/e. Measurements in
/// tanks (Tsimplis 1992) leave a wide range.
const DAMPING_RATE_MM_H: f64 = 100.0;

/// Slope of the distribution of diameters, 1/mm (Marshall and Palmer 1948).
pub fn slope_per_mm(rate: f64) -> f64 {
    4.1 * rate.max(1e-3).powf(-0.21)
}

/// Number of drops per m^3 that are larger than the diameter `least_mm`.
pub fn drops_per_m3(rate: f64, least_mm: f64) -> f64 {
    let slope = slope_per_mm(rate);
    DROPS_PER_M3_MM / slope * (-slope * least_mm).exp()
}

/// Diameter, mm, above which there are `per_m3` drops per m^3; 0 if all drops are fewer.
pub fn least_diameter_mm(rate: f64, per_m3: f64) -> f64 {
    let slope = slope_per_mm(rate);
    ((DROPS_PER_M3_MM / (slope * per_m3)).ln() / slope).max(0.0)
}

/// Share of drops larger than `least_mm`, mm, in the sum of the cross-sections of all drops.
pub fn cover_share(rate: f64, least_mm: f64) -> f64 {
    let x = slope_per_mm(rate) * least_mm;
    (-x).exp() * (1.0 + x + 0.5 * x * x)
}

/// Fall speed of drops of the given diameter, m/s.
pub fn fall_speed_m_s(diameter_mm: f64) -> f64 {
    (FALL_SPEED_M_S[0] - FALL_SPEED_M_S[1] * (-FALL_SPEED_PER_MM * diameter_mm).exp()).max(0.0)
}

/// Number of drops larger than `least_mm`, mm, that fall on a square metre in a second.
pub fn impacts_per_m2_s(rate: f64, least_mm: f64) -> f64 {
    let slope = slope_per_mm(rate);
    let part = |speed: f64, steep: f64| speed / steep * (-steep * least_mm).exp();
    DROPS_PER_M3_MM * (part(FALL_SPEED_M_S[0], slope) - part(FALL_SPEED_M_S[1], slope + FALL_SPEED_PER_MM)).max(0.0)
}

/// Extinction coefficient of rain, 1/m: the integral of the drops' cross-sections, 0.365 R^0.63 per km. The visibility
/// that follows, 10.7 R^-0.63 km, is near that of Atlas (1953), 11.6 R^-0.63 km.
pub fn extinction_per_m(rate: f64) -> f64 {
    if rate <= 0.0 {
        return 0.0;
    }
    // The integral of D^2 exp(-slope D) is 2 / slope^3; areas are in mm^2.
    1e-6 * EXTINCTION_EFFICIENCY * (PI / 4.0) * DROPS_PER_M3_MM * 2.0 / slope_per_mm(rate).powi(3)
}

/// Mean square slope of the ring waves that drops make: the spectrum over frequency of Bliven, Sobieski and Craeye
/// (1997), a log-Gaussian, times the square of the wave number at its peak. Treat it as an approximation: its coefficients
/// were not compared with the paper. One wave number for all frequencies and the logarithm in the width are our choices.
/// Read as a bandwidth in Hz instead, the same width would give about three times the slope.
pub fn ring_slope_variance(rate: f64) -> f64 {
    if rate <= 0.0 {
        return 0.0;
    }
    let peak_m2_s = 6e-8 * rate.powf(0.53);
    let peak_hz = 5.772 - 0.0018 * rate;
    // The integral of exp(-pi (ln(f / peak) / width)^2) over ln f is the width.
    let width = (peak_hz / (4.42 + 0.0028 * rate)).ln();
    RING_WAVE_NUMBER * RING_WAVE_NUMBER * peak_m2_s * peak_hz * width
}

/// Factor on the slope variance of the shortest wind waves, which drops damp.
pub fn short_wave_factor(rate: f64) -> f64 {
    (-rate / DAMPING_RATE_MM_H).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sum of `of(D)` times the number of drops per m^3 over diameters of `least_mm` to 20 mm.
    fn sum(rate: f64, least_mm: f64, of: impl Fn(f64) -> f64) -> f64 {
        let step = 1e-3;
        let steps = ((20.0 - least_mm) / step) as u32;
        let at = |i: u32| least_mm + (f64::from(i) + 0.5) * step;
        (0..steps).map(|i| of(at(i)) * DROPS_PER_M3_MM * (-slope_per_mm(rate) * at(i)).exp() * step).sum()
    }

    #[test]
    fn numbers_and_cross_sections_are_those_of_the_distribution() {
        for rate in [0.5, 2.0, 10.0, 50.0, 100.0] {
            let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-3, "{rate} mm/h: {a} {b}");
            near(drops_per_m3(rate, 1.5), sum(rate, 1.5, |_| 1.0));
            near(impacts_per_m2_s(rate, 1.0), sum(rate, 1.0, fall_speed_m_s));
            near(extinction_per_m(rate), sum(rate, 0.0, |d| 2.0 * PI / 4.0 * d * d * 1e-6));
            near(cover_share(rate, 1.5), sum(rate, 1.5, |d| d * d) / sum(rate, 0.0, |d| d * d));
            near(drops_per_m3(rate, least_diameter_mm(rate, 12.0)), 12.0);
            // The mean diameter of an exponential distribution is the reciprocal of its slope.
            near(sum(rate, 0.0, |d| d) / sum(rate, 0.0, |_| 1.0), slope_per_mm(rate).recip());
        }
    }

    /// The water that the drops carry down is the rain rate, to the fifth that Marshall and Palmer's fit leaves.
    #[test]
    fn the_drops_carry_the_rain() {
        for rate in [1.0, 5.0, 25.0, 100.0] {
            let mm_h = sum(rate, 0.0, |d| PI / 6.0 * d.powi(3) * fall_speed_m_s(d)) * 1e-9 * 3.6e6;
            assert!((mm_h / rate - 1.0).abs() < 0.25, "{rate} mm/h: {mm_h}");
        }
    }

    #[test]
    fn published_values() {
        assert!((fall_speed_m_s(1.0) - 4.0).abs() < 0.1 && (fall_speed_m_s(5.0) - 9.1).abs() < 0.1);
        for rate in [1.0, 10.0, 100.0] {
            let visibility_km = 3.912 / (1e3 * extinction_per_m(rate));
            let published_km = 11.6 * rate.powf(-0.63);
            assert!((visibility_km / published_km - 1.0).abs() < 0.1, "{rate} mm/h: {visibility_km} {published_km}");
        }
        // The square of the wave number at 5.77 Hz, with gravity and surface tension.
        let omega = 2.0 * PI * 5.77;
        let k = RING_WAVE_NUMBER;
        assert!((9.81 * k + 7.3e-5 * k.powi(3) - omega * omega).abs() < 0.02 * omega * omega);
        assert!((ring_slope_variance(10.0) - 4.5e-3).abs() < 3e-4);
        assert_eq!([extinction_per_m(0.0), ring_slope_variance(0.0)], [0.0; 2]);
    }
}
