//! Position of the sun by date, time and latitude.

use std::f64::consts::TAU;

/// Length of the year in Spencer's series for the sun's declination, days.
const YEAR_DAYS: f64 = 365.0;

/// Declination of the sun, rad, on the day `day` of the year (1 is 1 January) at the hour `hour` (0 to 24) of true
/// solar time, by Spencer, "Fourier series representation of the position of the sun", Search 2 (5), 1971; error
/// 0.05 degrees.
fn declination_rad(day: f64, hour: f64) -> f64 {
    let g = TAU * (day - 1.0 + (hour - 12.0) / 24.0) / YEAR_DAYS;
    0.006_918 - 0.399_912 * g.cos() + 0.070_257 * g.sin() - 0.006_758 * (2.0 * g).cos() + 0.000_907 * (2.0 * g).sin()
        - 0.002_697 * (3.0 * g).cos()
        + 0.001_480 * (3.0 * g).sin()
}

/// Returns elevation above the horizon and azimuth (clockwise from north) of the centre of the sun, degrees, without
/// refraction. `day` is the day of the year from 1, `hour` true solar time, in which the sun is highest at 12,
/// `latitude_deg` is positive in the north.
pub fn elevation_azimuth_deg(day: f64, hour: f64, latitude_deg: f64) -> [f64; 2] {
    let (sin_d, cos_d) = declination_rad(day, hour).sin_cos();
    let (sin_l, cos_l) = latitude_deg.to_radians().sin_cos();
    let (sin_h, cos_h) = (TAU * (hour - 12.0) / 24.0).sin_cos();
    let up = sin_l * sin_d + cos_l * cos_d * cos_h;
    let north = cos_l * sin_d - sin_l * cos_d * cos_h;
    let east = -cos_d * sin_h;
    let azimuth = east.atan2(north).to_degrees().rem_euclid(360.0);
    [up.atan2(north.hypot(east)).to_degrees(), azimuth]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Declinations at noon, degrees, from The Nautical Almanac, averaged over leap years.
    #[test]
    fn declinations_of_the_almanac() {
        for (day, degrees) in [
            (1, -23.0),
            (32, -17.2),
            (60, -7.7),
            (80, 0.0),
            (91, 4.4),
            (121, 15.0),
            (152, 22.0),
            (172, 23.44),
            (213, 18.1),
            (244, 8.4),
            (266, 0.0),
            (305, -14.3),
            (335, -21.8),
            (355, -23.44),
        ] {
            let d = declination_rad(f64::from(day), 12.0).to_degrees();
            assert!((d - degrees).abs() < 0.4, "day {day}: {d}, almanac {degrees}");
        }
    }

    #[test]
    fn heights_at_noon() {
        // London (51.5 N) and Sydney (33.87 S) at the solstices, 40 N at the equinox.
        for (day, latitude, elevation, azimuth) in [
            (172.0, 51.5, 61.94, 180.0),
            (355.0, 51.5, 15.06, 180.0),
            (355.0, -33.87, 79.57, 0.0),
            (172.0, -33.87, 32.69, 0.0),
            (80.0, 40.0, 50.0, 180.0),
        ] {
            let [e, a] = elevation_azimuth_deg(day, 12.0, latitude);
            assert!((e - elevation).abs() < 0.5, "{day} {latitude}: {e}");
            let off = (a - azimuth + 180.0).rem_euclid(360.0) - 180.0;
            assert!(off.abs() < 0.5, "{day} {latitude}: {a}");
        }
    }

    #[test]
    fn rising_and_setting() {
        // At the equinox the sun rises in the east at six everywhere, and sets in the west.
        for latitude in [-60.0, -30.0, 0.0, 45.0, 66.0] {
            let [e, a] = elevation_azimuth_deg(80.0, 6.0, latitude);
            assert!(e.abs() < 0.5 && (a - 90.0).abs() < 0.5, "{latitude}: {e} {a}");
            let [e, a] = elevation_azimuth_deg(80.0, 18.0, latitude);
            assert!(e.abs() < 0.5 && (a - 270.0).abs() < 0.5, "{latitude}: {e} {a}");
        }
        // London at midsummer: cos H = -tan(51.5) tan(23.44), 8.21 h before noon; cos A = sin(23.44) / cos(51.5).
        let [e, a] = elevation_azimuth_deg(172.0, 12.0 - 8.205, 51.5);
        assert!(e.abs() < 0.5 && (a - 50.3).abs() < 0.5, "{e} {a}");
    }

    #[test]
    fn polar_day_and_night() {
        for hour in 0..24 {
            let [e, _] = elevation_azimuth_deg(172.0, f64::from(hour), 80.0);
            assert!((13.0..34.0).contains(&e), "the sun does not set: {e} at {hour} h");
            let [e, _] = elevation_azimuth_deg(355.0, f64::from(hour), 80.0);
            assert!((-34.0..-13.0).contains(&e), "the sun does not rise: {e} at {hour} h");
            let [e, _] = elevation_azimuth_deg(172.0, f64::from(hour), 90.0);
            assert!((e - 23.44).abs() < 0.1, "at the pole it circles: {e} at {hour} h");
        }
    }
}
