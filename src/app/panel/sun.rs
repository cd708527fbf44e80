//! The sun's day in the panel: times of sunrise and sunset, and the button that lets the day run.

use super::super::App;
use super::super::accessible_names::with_accessible_value;
use crate::app::language::{say, text, tr};
use crate::state::Params;
use crate::state::fields;
use crate::state::look::{SkyLook, SunPlacement};

/// Hours of the sun's day per minute with which the time-lapse begins: a day takes six minutes.
const TIME_LAPSE_H_PER_MIN: f64 = 4.0;
/// Speeds of the time-lapse that the number beside its button takes, h/min.
const TIME_LAPSE_RANGE_H_PER_MIN: std::ops::RangeInclusive<f64> = 0.1..=60.0;

/// Lights of the day that a button gives: name, and height of the sun, degrees.
const LIGHTS: [(&str, f64); 5] = [
    (text!("Day"), 40.0),
    (text!("Low sun"), 8.0),
    (text!("Sunset"), 0.0),
    (text!("Dusk"), -4.0),
    (text!("Night"), -15.0),
];
/// Difference of the sun's height from that of a button, up to which the button counts as chosen, degrees.
const SAME_LIGHT_DEG: f64 = 0.1;

/// Heights at which the sun counts as low, degrees: from the end of nautical twilight to golden light.
const LOW_SUN_DEG: std::ops::Range<f64> = -12.0..10.0;
/// Time after which a rising sun is seen to be higher, h.
const A_MOMENT_H: f64 = 0.05;

/// An hour of the day as on a clock, such as `4:07`.
pub fn clock_text(hour: f64) -> String {
    let minutes = (60.0 * hour).round().rem_euclid(24.0 * 60.0);
    format!("{:.0}:{:02.0}", (minutes / 60.0).floor(), minutes % 60.0)
}

/// The sky as it is drawn: on a running day the hour has advanced.
pub fn sky_of_now(params: &Params) -> SkyLook {
    params.look.sky.at_time(params.clock.t_s)
}

/// Whether a low sun that follows date and place is rising or setting; `None` for a high sun, deep night, and a sun
/// that stands where it was put.
pub fn low_sun_moves(sky: &SkyLook) -> Option<&'static str> {
    let height_deg = |sky: &SkyLook| sky.sun_elevation_azimuth_deg()[0];
    let is_low = LOW_SUN_DEG.contains(&height_deg(sky)) && sky.panorama().is_none();
    (is_low && sky.sun_placement == SunPlacement::Date).then(|| {
        let later = SkyLook { hour: sky.hour + A_MOMENT_H, ..sky.clone() };
        if height_deg(&later) > height_deg(sky) { text!("the sun is rising") } else { text!("the sun is setting") }
    })
}

/// Sunrise and sunset of the date and the place, in a sentence.
fn rise_and_set_in_words(sky: &SkyLook) -> String {
    match sky.rise_and_set_h() {
        [Some(rise), Some(set)] => say!(
            "The sun rises at {rise} and sets at {set}, solar time.",
            rise = clock_text(rise),
            set = clock_text(set)
        ),
        [Some(rise), None] => {
            say!("The sun rises at {rise}, solar time, and does not set on this day.", rise = clock_text(rise))
        }
        [None, Some(set)] => {
            say!("The sun sets at {set}, solar time, and did not rise on this day.", set = clock_text(set))
        }
        [None, None] => {
            let [day, night] =
                [text!("Polar day: the sun does not set."), text!("Polar night: the sun does not rise.")];
            tr(if sky.is_sun_up_at_noon() { day } else { night }).to_owned()
        }
    }
}

/// Says the time of the sun's day, sunrise and sunset, if a date places the sun.
pub fn show_rise_and_set(params: &Params, ui: &mut egui::Ui) {
    let sky = sky_of_now(params);
    if sky.sun_placement == SunPlacement::Date && sky.panorama().is_none() {
        ui.add(egui::Label::new(egui::RichText::new(rise_and_set_in_words(&sky)).weak()).wrap());
    }
}

/// Adds a button for each light of the day, if the sun is not that of a sky from a file.
pub fn show_lights(app: &mut App, ui: &mut egui::Ui) {
    let (sky, t_s) = (&mut app.params.look.sky, app.params.clock.t_s);
    if sky.panorama().is_some() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.label(tr("Light"));
        let [elevation_deg, _] = sky.at_time(t_s).sun_elevation_azimuth_deg();
        for (name, height_deg) in LIGHTS {
            let is_chosen = (elevation_deg - height_deg).abs() < SAME_LIGHT_DEG;
            let help = say!("Puts the sun at a height of {degrees}°.", degrees = height_deg);
            let button = egui::Button::new(tr(name)).selected(is_chosen);
            if ui.add(button).on_hover_text(help).clicked() {
                sky.set_sun_height(height_deg, t_s);
            }
        }
    });
}

/// Adds the button that lets the sun's day run, and its speed while it runs.
pub fn show_time_lapse(app: &mut App, ui: &mut egui::Ui) {
    let t_s = app.params.clock.t_s;
    let daylight = fields::find("daylight").and_then(|field| field.inactive_because(&app.params));
    // A sky from a file has a sun that no setting moves.
    let obstacle = daylight.filter(|why| why.waking.is_empty());
    ui.horizontal(|ui| {
        let sky = &mut app.params.look.sky;
        let runs = sky.sun_placement == SunPlacement::Date && sky.daylight_h_per_min > 0.0;
        let button = egui::Button::new(tr("Time-lapse of the day")).selected(runs);
        let help = tr("Lets the sun's day run, as the date and the place say. It begins with the sun that is shown.");
        let button = ui.add_enabled(obstacle.is_none(), button).on_hover_text(help);
        let button = match obstacle {
            Some(why) => button.on_disabled_hover_text(tr(why.reason)),
            None => button,
        };
        if button.clicked() {
            sky.place_sun_by_date();
            sky.set_daylight(if runs { 0.0 } else { TIME_LAPSE_H_PER_MIN }, t_s);
            app.params.clock.paused &= runs;
        } else if runs && obstacle.is_none() {
            let mut speed = sky.daylight_h_per_min;
            let number =
                egui::DragValue::new(&mut speed).range(TIME_LAPSE_RANGE_H_PER_MIN).speed(0.05).suffix(" h/min");
            let number = with_accessible_value(ui.add(number), tr("Speed of the day"), speed);
            if number.on_hover_text(tr("Hours of the sun's day in a minute.")).changed() {
                sky.set_daylight(speed, t_s);
            }
        }
    });
    if app.params.look.sky.daylight_h_per_min > 0.0 && obstacle.is_none() {
        let [_, hour] = app.params.look.sky.day_and_hour(t_s);
        ui.weak(say!("It is {time}, solar time.", time = clock_text(hour)));
        show_rise_and_set(&app.params, ui);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hours_are_written_as_on_a_clock() {
        assert_eq!([0.0, 4.12, 12.0, 23.999, 24.0].map(clock_text), ["0:00", "4:07", "12:00", "0:00", "0:00"]);
    }

    #[test]
    fn sunrise_is_said_in_words_at_every_place() {
        let words = |day, latitude_deg| rise_and_set_in_words(&SkyLook { day, latitude_deg, ..SkyLook::default() });
        assert!(words(80.0, 45.0).starts_with("The sun rises at 5:5"), "{}", words(80.0, 45.0));
        assert_eq!(words(172.0, 78.0), "Polar day: the sun does not set.");
        assert_eq!(words(355.0, 78.0), "Polar night: the sun does not rise.");
    }
    #[test]
    fn a_low_sun_rises_in_the_morning_and_sets_in_the_evening() {
        let at = |hour, sun_placement| {
            let sky = SkyLook { day: 80.0, latitude_deg: 45.0, hour, sun_placement, ..SkyLook::default() };
            low_sun_moves(&sky)
        };
        let date = SunPlacement::Date;
        assert_eq!([at(6.2, date), at(17.8, date)], [Some("the sun is rising"), Some("the sun is setting")]);
        assert_eq!([at(12.0, date), at(0.0, date), at(6.2, SunPlacement::Direction)], [None; 3]);
    }
}
