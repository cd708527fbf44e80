//! Directional parameters of the frequency bands of a measured spectrum.

use std::f64::consts::PI;

/// Directional parameters of one frequency band in the convention of the NDBC. The directional distribution is D(A) =
/// 1/pi (1/2 + r1 cos(A - alpha1) + r2 cos(2 (A - alpha2))), where A is the direction waves come FROM, degrees
/// clockwise from true north.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DirectionalParameters {
    /// Mean direction alpha1 that the waves come from, degrees clockwise from north in [0, 360).
    pub alpha1_deg: f64,
    /// Principal direction alpha2, the axis of the second harmonic of the distribution, degrees clockwise from north in
    /// [0, 360); alpha2 + 180 is equivalent.
    pub alpha2_deg: f64,
    /// Magnitude r1 of the first directional moment: 0 if opposite directions balance, 1 for a single direction.
    pub r1: f64,
    /// Magnitude r2 of the second directional moment, 0 to 1; 1 if all energy lies along one axis, in either sense.
    pub r2: f64,
}

impl DirectionalParameters {
    /// Directional parameters of a distribution cos^{2s}(theta/2), theta from its mean direction `from_deg` (degrees
    /// clockwise from north, where waves come from), with the circular spread `spread_deg` = sqrt(2 (1 - r1)), degrees.
    ///
    /// The exponent s = r1/(1 - r1) gives r2 = s (s - 1)/((s + 1)(s + 2)) = r1 (2 r1 - 1)/(2 - r1) (Longuet-Higgins,
    /// Cartwright and Smith 1963). This is negative for s < 1: the principal direction is then across alpha1.
    pub fn from_spread(from_deg: f64, spread_deg: f64) -> Self {
        let r1 = (1.0 - 0.5 * spread_deg.to_radians().powi(2)).clamp(0.0, 1.0);
        let r2 = r1 * (2.0 * r1 - 1.0) / (2.0 - r1);
        let alpha2_deg = if r2 < 0.0 { from_deg + 90.0 } else { from_deg };
        Self { alpha1_deg: from_deg, alpha2_deg, r1, r2: r2.abs() }
    }

    /// Moments [re c1, im c1, re c2, im c2] of the directional distribution D: c_n is the integral of D e^{i n theta},
    /// where theta is the direction that waves travel TO, atan2(z, x) with x east, z south. Waves that come from the
    /// angle A have theta = A + pi/2.
    pub(super) fn directional_moments(&self) -> [f64; 4] {
        let theta1 = self.alpha1_deg.to_radians() + 0.5 * PI;
        let theta2 = 2.0 * self.alpha2_deg.to_radians() + PI;
        [self.r1 * theta1.cos(), self.r1 * theta1.sin(), self.r2 * theta2.cos(), self.r2 * theta2.sin()]
    }

    /// Copy in the precision of a state string: angles rounded to 0.1 degree and wrapped into [0, 360), r1 and r2
    /// limited to [0, 1] and rounded to 0.001. An error if a number is not finite.
    pub(super) fn rounded(&self) -> Result<Self, String> {
        let Self { alpha1_deg, alpha2_deg, r1, r2 } = *self;
        if ![alpha1_deg, alpha2_deg, r1, r2].iter().all(|v| v.is_finite()) {
            return Err("a directional parameter is not a finite number".into());
        }
        let angle = |v: f64| ((10.0 * v.rem_euclid(360.0)).round() / 10.0) % 360.0 + 0.0;
        let magnitude = |v: f64| (1000.0 * v.clamp(0.0, 1.0)).round() / 1000.0 + 0.0;
        Ok(Self { alpha1_deg: angle(alpha1_deg), alpha2_deg: angle(alpha2_deg), r1: magnitude(r1), r2: magnitude(r2) })
    }
}

/// Returns `directions`, one for each of `bands` (frequency in Hz, variance density), with each None replaced by the
/// direction of the nearest band that has one. Returns None and adds a notice if under a third of them have one.
pub(super) fn fill_missing_directions(
    bands: &[(f64, f64)],
    directions: &[Option<DirectionalParameters>],
    notices: &mut Vec<String>,
) -> Option<Vec<DirectionalParameters>> {
    let known: Vec<(f64, DirectionalParameters)> =
        bands.iter().zip(directions).filter_map(|(b, d)| Some((b.0, (*d)?))).collect();
    let (have, all) = (known.len(), bands.len());
    if have == 0 || 3 * have < all {
        notices.push(format!("only {have} of {all} bands have a direction: the spectrum is used without directions"));
        return None;
    }
    bands.iter().zip(directions).map(|(b, d)| d.or_else(|| Some(nearest_entry(&known, b.0)?.1))).collect()
}

/// Returns the entry (frequency in Hz, value) whose frequency is nearest to `f_hz`; None if there are no entries.
pub(super) fn nearest_entry<T>(entries: &[(f64, T)], f_hz: f64) -> Option<&(f64, T)> {
    entries.iter().min_by(|a, b| (a.0 - f_hz).abs().total_cmp(&(b.0 - f_hz).abs()))
}
