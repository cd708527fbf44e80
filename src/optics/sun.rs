//! Position of the sun by date, time and latitude.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

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

/// Elevation of the centre of the sun, degrees, at which its upper edge stands on the horizon: refraction lifts it by 34
/// minutes of arc, and its radius is 16. Almanacs use this elevation for sunrise and sunset.
pub const RISE_ELEVATION_DEG: f64 = -0.833;
/// Number of halvings of half a day that find the time of sunrise or sunset, to less than a millisecond.
const RISE_BISECTIONS: u32 = 28;

/// Angle by which the sun may miss a direction that it has at no latitude, rad. On the day of an equinox it rises nearly,
/// not exactly, in the east, and stands nearly on the horizon of a pole.
const DIRECTION_TOLERANCE_RAD: f64 = 0.01;

/// When the sun rises and sets on the day `day` of the year at a latitude: hours of true solar time, to about two minutes
/// in moderate latitudes. `None` for what does not happen, as in polar day and polar night.
pub fn rise_and_set_h(day: f64, latitude_deg: f64) -> [Option<f64>; 2] {
    // The sun is highest at noon: before, it can only rise, after, it can only set.
    [[0.0, 12.0], [12.0, 24.0]].map(|hours| passing_h(day, latitude_deg, RISE_ELEVATION_DEG, hours))
}

/// The hour of true solar time, between `from` and `to` of a morning or an afternoon, at which the sun passes an
/// elevation, degrees, on the day `day` of the year at a latitude; `None` if it does not.
pub fn passing_h(day: f64, latitude_deg: f64, elevation_deg: f64, [mut from, mut to]: [f64; 2]) -> Option<f64> {
    let is_above = |hour: f64| elevation_azimuth_deg(day, hour, latitude_deg)[0] > elevation_deg;
    let before = is_above(from);
    if before == is_above(to) {
        return None;
    }
    for _ in 0..RISE_BISECTIONS {
        let middle = 0.5 * (from + to);
        if is_above(middle) == before { from = middle } else { to = middle }
    }
    Some(0.5 * (from + to))
}

/// Latitude, degrees, and hour of true solar time at which the sun has this elevation and azimuth, degrees, on the day
/// `day` of the year; of two latitudes the one nearer to the equator. `None` if there is no such place on that day.
pub fn latitude_and_hour(elevation_deg: f64, azimuth_deg: f64, day: f64) -> Option<[f64; 2]> {
    let (up, level) = elevation_deg.to_radians().sin_cos();
    let (sin_a, cos_a) = azimuth_deg.to_radians().sin_cos();
    let (north, east) = (level * cos_a, level * sin_a);
    let mut found = None;
    let mut hour = 12.0;
    // The declination depends a little on the hour.
    for _ in 0..3 {
        // up sin(latitude) + north cos(latitude) = sin(declination)
        let (sin_d, most) = (declination_rad(day, hour).sin(), up.hypot(north));
        if sin_d.abs() > most + DIRECTION_TOLERANCE_RAD {
            return None;
        }
        let angle = (sin_d / most).clamp(-1.0, 1.0).acos();
        let middle = up.atan2(north);
        let latitudes = [middle - angle, middle + angle].map(|x| (x + PI).rem_euclid(TAU) - PI);
        let fits = latitudes.into_iter().filter(|x| x.abs() <= FRAC_PI_2 + DIRECTION_TOLERANCE_RAD);
        // The sun rises in the east at every latitude: the equator is one of them.
        let equator = (most < DIRECTION_TOLERANCE_RAD).then_some(0.0);
        let latitude = equator.or_else(|| fits.min_by(|a, b| a.abs().total_cmp(&b.abs())))?;
        let latitude = latitude.clamp(-FRAC_PI_2, FRAC_PI_2);
        let (sin_l, cos_l) = latitude.sin_cos();
        hour = (12.0 + 24.0 / TAU * (-east).atan2(cos_l * up - sin_l * north)).rem_euclid(24.0);
        found = Some([latitude.to_degrees(), hour]);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sunrise in hours of true solar time after NOAA's solar calculator (Meeus, "Astronomical Algorithms", chapter 25),
    /// which shares no formula with this file but that of the hour angle. `day` counts from 1 January 2025.
    fn noaa_sunrise_h(day: f64, latitude_deg: f64) -> f64 {
        // Julian centuries since noon of 1 January 2000; the sun rises about six hours before noon.
        let century = (9131.0 + day - 1.0 - 0.25) / 36525.0;
        let sin = |degrees: f64| degrees.to_radians().sin();
        let mean_longitude = 280.466_46 + century * (36_000.769_83 + century * 0.000_303_2);
        let anomaly = 357.529_11 + century * (35_999.050_29 - 0.000_153_7 * century);
        let centre = sin(anomaly) * (1.914_602 - century * 0.004_817)
            + sin(2.0 * anomaly) * (0.019_993 - 0.000_101 * century)
            + sin(3.0 * anomaly) * 0.000_289;
        let node = 125.04 - 1934.136 * century;
        let longitude = mean_longitude + centre - 0.005_69 - 0.004_78 * sin(node);
        let obliquity = 23.439_291 - 0.013_004_2 * century + 0.002_56 * (node.to_radians().cos());
        let declination = (sin(obliquity) * sin(longitude)).asin();
        let latitude = latitude_deg.to_radians();
        let cos_h =
            90.833_f64.to_radians().cos() / (latitude.cos() * declination.cos()) - latitude.tan() * declination.tan();
        12.0 - cos_h.acos().to_degrees() / 15.0
    }

    #[test]
    fn the_sun_rises_when_noaa_says() {
        for latitude in [-55.0, -33.9, 0.0, 40.7, 51.5, 60.0] {
            for day in [1.0, 45.0, 80.0, 100.0, 172.0, 220.0, 266.0, 310.0, 355.0] {
                let [Some(rise), Some(set)] = rise_and_set_h(day, latitude) else { panic!("{latitude}, day {day}") };
                let minutes = 60.0 * (rise - noaa_sunrise_h(day, latitude));
                // Spencer's series is right to 0.05 degrees, and calendar years differ by up to 0.3 degrees at the equinox.
                assert!(minutes.abs() < 2.5, "{latitude}, day {day}: {minutes} minutes late");
                assert!((rise + set - 24.0).abs() < 0.06, "{latitude}, day {day}: noon is in the middle");
            }
        }
    }

    /// Lengths of the longest and the shortest day as almanacs print them, hours and minutes.
    #[test]
    fn days_are_as_long_as_almanacs_say() {
        let published = [
            ("London", 51.5, [16, 38], [7, 50]),
            ("New York", 40.71, [15, 6], [9, 15]),
            ("Quito", -0.2, [12, 7], [12, 7]),
        ];
        for (place, latitude, longest, shortest) in published {
            for (day, [hours, minutes]) in [(172.0, longest), (355.0, shortest)] {
                let [Some(rise), Some(set)] = rise_and_set_h(day, latitude) else { panic!("{place}") };
                let late = 60.0 * (set - rise) - f64::from(60 * hours + minutes);
                assert!(late.abs() < 3.0, "{place}, day {day}: {late} minutes too long");
            }
        }
    }

    #[test]
    fn polar_days_and_nights_have_no_sunrise() {
        for (day, latitude) in [(172.0, 69.65), (355.0, 69.65), (172.0, -80.0), (355.0, -80.0), (20.0, 90.0)] {
            assert_eq!(rise_and_set_h(day, latitude), [None; 2], "{latitude}, day {day}");
        }
        // Just outside of the polar circle, midsummer's sun sets for a moment around midnight.
        let [Some(rise), Some(set)] = rise_and_set_h(172.0, 65.0) else { panic!("the sun sets at 65 degrees") };
        assert!(rise > 0.5 && rise < 2.0 && set > 22.0, "{rise} {set}");
    }

    #[test]
    fn a_place_and_an_hour_are_found_for_the_sun() {
        for elevation in [-12.0, 0.0, 12.0, 45.0, 80.0] {
            for azimuth in [0.0, 20.0, 90.0, 135.0, 200.0, 340.0] {
                // At an equinox every direction of the sun has its place.
                let Some([latitude, hour]) = latitude_and_hour(elevation, azimuth, 80.0) else {
                    panic!("no place for {elevation}, {azimuth}")
                };
                let [e, a] = elevation_azimuth_deg(80.0, hour, latitude);
                let apart = (a - azimuth + 180.0).rem_euclid(360.0) - 180.0;
                // Exactly in the east on the horizon and at the poles, the declination of that day is missed.
                let tolerance = if [0.0, 90.0].contains(&latitude.abs()) { 0.6 } else { 0.05 };
                let misses = (e - elevation).abs().max(apart.abs() * elevation.to_radians().cos());
                assert!(misses < tolerance, "{elevation}, {azimuth}: {e}, {a} at {latitude}");
            }
        }
        assert_eq!(latitude_and_hour(0.0, 90.0, 172.0), None, "in June the sun rises north of east everywhere");
    }

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
