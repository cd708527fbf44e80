//! How far waves run up a beach.

/// Foreshore similarity (slope over the square root of the steepness) below which a beach is dissipative.
const DISSIPATIVE_BELOW: f64 = 0.3;

/// Run-up of a sea on a natural beach by Stockdon et al. 2006.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunUp {
    /// Set-up: rise of the mean water level at the shoreline, m.
    pub set_up_m: f64,
    /// Significant height of the swash, m.
    pub swash_m: f64,
    /// Height above the still water that 2 % of the waves exceed, m.
    pub two_percent_m: f64,
}

impl RunUp {
    /// Run-up of waves of the significant height `hs_m` (m) and the length `wavelength_m` (m) in deep water on a
    /// foreshore of the slope `slope` (height over length): R2 = 1.1 (0.35 b sqrt(H L) + sqrt(H L (0.563 b^2 + 0.004))
    /// / 2), and 0.043 sqrt(H L) on dissipative beaches, where b / sqrt(H / L) is below 0.3.
    pub fn new(hs_m: f64, wavelength_m: f64, slope: f64) -> Self {
        let scale = (hs_m * wavelength_m).sqrt();
        let set_up_m = 0.35 * slope * scale;
        let swash_m = scale * (0.563 * slope * slope + 0.004).sqrt();
        let is_dissipative = slope * wavelength_m < DISSIPATIVE_BELOW * scale;
        let two_percent_m = if is_dissipative { 0.043 * scale } else { 1.1 * (set_up_m + 0.5 * swash_m) };
        Self { set_up_m, swash_m, two_percent_m }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn run_up_follows_the_published_form() {
        // 2 m and 10 s: deep water wavelength 156.1 m, sqrt(H L) 17.669 m. Slope 0.1: set-up 0.6184 m, swash
        // 17.669 sqrt(0.00963) = 1.7339 m, R2 = 1.1 (0.6184 + 0.8670) = 1.6339 m.
        let run_up = RunUp::new(2.0, 156.1, 0.1);
        assert!((run_up.set_up_m - 0.6184).abs() < 1e-3 && (run_up.swash_m - 1.7339).abs() < 1e-3);
        assert!((run_up.two_percent_m - 1.6339).abs() < 1e-3);
        // Dissipative: similarity 0.02 / sqrt(2 / 156.1) = 0.177.
        assert!((RunUp::new(2.0, 156.1, 0.02).two_percent_m - 0.043 * 17.669).abs() < 1e-3);
        assert_eq!(RunUp::new(0.0, 100.0, 0.05).two_percent_m, 0.0);
    }
}
