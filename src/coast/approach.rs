//! The way from the open sea to the edge of a coast's grid: waves that refract and shoal over straight, parallel depth
//! contours, without loss.

use super::incident::Incident;
use super::local_wave::LocalWave;

/// The wave in water of `to_depth_m` that `wave` becomes on its way from water of `from_depth_m` (m, positive), under
/// gravity `gravity_m_s2`. `None` if it travels seaward or along the contours, or turns back before it arrives.
///
/// Snell's law keeps the wave number along the shore, and the energy flux across the contours stays the same:
/// a^2 Cg cos(direction).
pub fn approach(wave: &Incident, from_depth_m: f64, to_depth_m: f64, gravity_m_s2: f64) -> Option<Incident> {
    let (sin, cos) = wave.direction_rad.sin_cos();
    let [from, to] = [from_depth_m, to_depth_m].map(|depth_m| LocalWave::new(wave.omega_rad_s, depth_m, gravity_m_s2));
    let arriving = from.k * sin / to.k;
    if cos <= 1e-6 || arriving.abs() >= 1.0 {
        return None;
    }
    let direction_rad = arriving.asin();
    let flux = from.group_velocity_m_s * cos / (to.group_velocity_m_s * direction_rad.cos());
    Some(Incident { amplitude_m: wave.amplitude_m * flux.sqrt(), direction_rad, ..*wave })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_6, TAU};

    #[test]
    fn waves_refract_and_shoal_on_their_way() {
        let wave = Incident { amplitude_m: 1.0, phase_rad: 0.3, omega_rad_s: TAU / 10.0, direction_rad: FRAC_PI_6 };
        // Deep water to 5 m, 10 s: k0 = 0.040243, k = 0.092836 rad/m, so the sine of 30 degrees becomes 0.21674. Group
        // velocities 7.8065 and 6.3268 m/s: amplitude sqrt(7.8065 x 0.86603 / (6.3268 x 0.97623)) = 1.0462.
        let here = approach(&wave, 1000.0, 5.0, 9.81).expect("it arrives");
        assert!((here.direction_rad.sin() - 0.216_74).abs() < 1e-4, "{here:?}");
        assert!((here.amplitude_m - 1.046_23).abs() < 2e-4, "{here:?}");
        assert_eq!((here.phase_rad, here.omega_rad_s), (wave.phase_rad, wave.omega_rad_s));
        // The way back is the same way.
        let back = approach(&here, 5.0, 1000.0, 9.81).expect("it arrives");
        assert!((back.amplitude_m - 1.0).abs() < 1e-9 && (back.direction_rad - FRAC_PI_6).abs() < 1e-9);
        // Obliquely into deeper water a wave turns back; seaward it never arrives.
        let oblique = Incident { direction_rad: 1.2, ..wave };
        assert_eq!(approach(&oblique, 5.0, 1000.0, 9.81), None);
        assert_eq!(approach(&Incident { direction_rad: 2.0, ..wave }, 1000.0, 5.0, 9.81), None);
    }
}
