//! The running day (parameter `daylight`): the hour advances with the simulated time, and the sun with the hour.

use super::Look;
use super::sky::{SkyLook, SunPlacement};
use crate::optics::sun;

/// Day of the year of the March equinox.
const MARCH_EQUINOX_DAY: f64 = 80.0;
/// Least value of the parameter `sun`, degrees.
const LOWEST_ELEVATION_DEG: f64 = -24.0;
/// Number of days after which the running day begins the year anew.
const YEAR_DAYS: f64 = 365.0;
/// Steps of the running day in an hour: the sun moves by a tenth of a degree a step, and the sky is not computed anew in
/// each frame.
const DAY_STEPS_PER_H: f64 = 150.0;

impl Look {
    /// This look at the simulated time `t_s`: the running day has moved the sun on.
    #[must_use]
    pub fn at_time(&self, t_s: f64) -> Self {
        Self { sky: self.sky.at_time(t_s), ..self.clone() }
    }
}

impl SkyLook {
    /// Day of the year and hour of true solar time at the simulated time `t_s`.
    pub fn day_and_hour(&self, t_s: f64) -> [f64; 2] {
        day_and_hour(self.day, self.hour + self.elapsed_h(t_s))
    }

    /// Hours by which the day has run on at the simulated time `t_s`, in whole steps; 0 if no date places the sun.
    fn elapsed_h(&self, t_s: f64) -> f64 {
        if self.sun_placement == SunPlacement::Direction {
            return 0.0;
        }
        (self.daylight_h_per_min * t_s / 60.0 * DAY_STEPS_PER_H).round() / DAY_STEPS_PER_H
    }

    /// This sky at the simulated time `t_s`: the running day has moved the sun on.
    #[must_use]
    pub fn at_time(&self, t_s: f64) -> Self {
        let [day, hour] = self.day_and_hour(t_s);
        Self { day, hour, ..self.clone() }
    }

    /// Hours of true solar time at which the sun of the date rises and sets; `None` for what does not happen on that day.
    pub fn rise_and_set_h(&self) -> [Option<f64>; 2] {
        sun::rise_and_set_h(self.day, self.latitude_deg)
    }

    /// Whether the sun of the date is up at noon. If it neither rises nor sets, this tells polar day from polar night.
    pub fn is_sun_up_at_noon(&self) -> bool {
        sun::elevation_azimuth_deg(self.day, 12.0, self.latitude_deg)[0] > sun::RISE_ELEVATION_DEG
    }

    /// Sets the speed of the running day so that the sun does not jump at the simulated time `t_s`.
    pub fn set_daylight(&mut self, h_per_min: f64, t_s: f64) {
        let [day, hour] = self.day_and_hour(t_s);
        self.daylight_h_per_min = h_per_min;
        [self.day, self.hour] = day_and_hour(day, hour - self.elapsed_h(t_s));
        // Three decimals, or four seconds, are enough for a link.
        self.hour = (1e3 * self.hour).round() / 1e3;
    }

    /// Places the sun by date. If it was placed by direction, day, hour and latitude become those at which the sun is
    /// where it was: on the day that is set, or at an equinox, at which every direction has its place.
    pub fn place_sun_by_date(&mut self) {
        if self.sun_placement == SunPlacement::Date {
            return;
        }
        self.sun_placement = SunPlacement::Date;
        let place = |day| Some((day, sun::latitude_and_hour(self.sun_elevation_deg, self.sun_azimuth_deg, day)?));
        if let Some((day, [latitude_deg, hour])) = place(self.day).or_else(|| place(MARCH_EQUINOX_DAY)) {
            let round = |x: f64, steps: f64| (x * steps).round() / steps;
            (self.day, self.hour, self.latitude_deg) = (day, round(hour, 100.0), round(latitude_deg, 10.0));
        }
    }

    /// Moves the sun to a height above the horizon, degrees, where it stands. If a date places it, the hour becomes that of
    /// the afternoon or evening at which it is nearest to this height, and a running day stops at the simulated time `t_s`.
    pub fn set_sun_height(&mut self, elevation_deg: f64, t_s: f64) {
        if self.sun_placement == SunPlacement::Direction {
            self.sun_elevation_deg = elevation_deg;
            return;
        }
        self.set_daylight(0.0, t_s);
        let afternoon_h = [12.0, 24.0];
        let passing = sun::passing_h(self.day, self.latitude_deg, elevation_deg, afternoon_h);
        let hour = passing.unwrap_or_else(|| {
            let noon_deg = sun::elevation_azimuth_deg(self.day, 12.0, self.latitude_deg)[0];
            afternoon_h[usize::from(noon_deg > elevation_deg)]
        });
        self.hour = (1e3 * hour).round() / 1e3;
    }

    /// Places the sun by direction, where it is at the simulated time `t_s`.
    pub fn place_sun_by_direction(&mut self, t_s: f64) {
        let [elevation_deg, azimuth_deg] = self.at_time(t_s).sun_elevation_azimuth_deg();
        self.sun_placement = SunPlacement::Direction;
        // A sun deeper below the horizon than the parameter allows gives no light either.
        self.sun_elevation_deg = ((10.0 * elevation_deg).round() / 10.0).max(LOWEST_ELEVATION_DEG);
        self.sun_azimuth_deg = (10.0 * azimuth_deg).round() / 10.0;
    }
}

/// Day of the year and hour of the day for an `hour` that may lie on a later or an earlier day.
fn day_and_hour(day: f64, hour: f64) -> [f64; 2] {
    // 24:00 of a day that does not run stays as it was written.
    if (0.0..=24.0).contains(&hour) {
        return [day, hour];
    }
    [1.0 + (day - 1.0 + (hour / 24.0).floor()).rem_euclid(YEAR_DAYS), hour.rem_euclid(24.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_moves_to_a_height() {
        let mut by_hand = SkyLook { sun_elevation_deg: 30.0, ..SkyLook::default() };
        by_hand.set_sun_height(-4.0, 7.0);
        assert_eq!(by_hand, SkyLook { sun_elevation_deg: -4.0, ..SkyLook::default() });
        let mut sky = dated(80.0, 9.0, 4.0);
        sky.set_sun_height(-4.0, 7.0);
        let [elevation_deg, azimuth_deg] = sky.sun_elevation_azimuth_deg();
        assert!((elevation_deg + 4.0).abs() < 0.02 && azimuth_deg > 180.0, "{elevation_deg} {azimuth_deg}");
        assert_eq!(sky.daylight_h_per_min, 0.0);
        // No evening is as bright as noon in winter, and no night as dark in summer at high latitudes.
        let mut winter = dated(355.0, 9.0, 0.0);
        winter.set_sun_height(80.0, 0.0);
        assert_eq!(winter.hour, 12.0);
        let mut summer = SkyLook { latitude_deg: 78.0, ..dated(172.0, 9.0, 0.0) };
        summer.set_sun_height(-15.0, 0.0);
        assert_eq!(summer.hour, 24.0);
    }

    fn dated(day: f64, hour: f64, daylight_h_per_min: f64) -> SkyLook {
        SkyLook { sun_placement: SunPlacement::Date, day, hour, daylight_h_per_min, ..SkyLook::default() }
    }

    #[test]
    fn the_day_runs_on_into_the_next_one() {
        assert_eq!(dated(172.0, 9.0, 0.0).at_time(1e6), dated(172.0, 9.0, 0.0), "a day that does not run stays");
        assert_eq!(dated(172.0, 9.0, 4.0).day_and_hour(90.0), [172.0, 15.0]);
        assert_eq!(dated(172.0, 23.0, 4.0).day_and_hour(60.0), [173.0, 3.0]);
        assert_eq!(dated(365.0, 23.0, 60.0).day_and_hour(60.0), [3.0, 11.0], "a new year");
        assert_eq!(dated(80.0, 24.0, 0.0).day_and_hour(5.0), [80.0, 24.0]);
        // A tenth of a degree a step: 36 frames at 60 Hz share six skies.
        let mut hours: Vec<f64> =
            (0..36).map(|i| dated(172.0, 9.0, 4.0).day_and_hour(f64::from(i) / 60.0)[1]).collect();
        hours.dedup();
        assert!((6..=8).contains(&hours.len()), "{hours:?}");
    }

    #[test]
    fn the_sun_stays_where_it_is_when_its_day_begins_and_ends() {
        for (elevation, azimuth) in [(12.0, 20.0), (24.0, 340.0), (3.0, 95.0), (-5.0, 270.0), (70.0, 180.0)] {
            let mut sky = SkyLook { sun_elevation_deg: elevation, sun_azimuth_deg: azimuth, ..SkyLook::default() };
            let before = sky.sun_direction();
            let t_s = 1234.5;
            let apart = |sky: &SkyLook| {
                let now = sky.at_time(t_s).sun_direction();
                before.iter().zip(now).map(|(a, b)| a * b).sum::<f64>().min(1.0).acos().to_degrees()
            };
            sky.place_sun_by_date();
            sky.set_daylight(4.0, t_s);
            assert!(apart(&sky) < 0.3, "{elevation}, {azimuth}: {} degrees apart", apart(&sky));
            sky.set_daylight(0.0, t_s);
            assert!(apart(&sky) < 0.3 && sky.day.fract() == 0.0, "{elevation}, {azimuth}: {sky:?}");
            sky.place_sun_by_direction(t_s);
            assert!(apart(&sky) < 0.4 && sky.sun_placement == SunPlacement::Direction, "{elevation}, {azimuth}");
        }
    }
}
