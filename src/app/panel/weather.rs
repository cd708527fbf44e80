//! The panel's tab of the weather: the few parameters that most people want, in words.

use super::super::App;
use super::{button_with_help, coast, rows, summary, sun, wind};
use crate::app::language::{say, text, tr};
use crate::state::Params;
use crate::state::fields::{self, Group};
use crate::state::look::SunPlacement;
use crate::waves::dispersion::Dispersion;
use std::f64::consts::TAU;

/// Names of the sixteen points of the compass, clockwise from north.
const COMPASS_POINTS: [&str; 16] = [
    text!("N"),
    text!("NNE"),
    text!("NE"),
    text!("ENE"),
    text!("E"),
    text!("ESE"),
    text!("SE"),
    text!("SSE"),
    text!("S"),
    text!("SSW"),
    text!("SW"),
    text!("WSW"),
    text!("W"),
    text!("WNW"),
    text!("NW"),
    text!("NNW"),
];

/// Name of the compass point nearest to a direction in degrees, clockwise from north.
pub fn compass_point(deg: f64) -> &'static str {
    COMPASS_POINTS[(deg / 22.5).round().rem_euclid(16.0) as usize % 16]
}

/// A row of the tab: the key of the parameter, the words above it, and what its value means.
struct Row {
    key: &'static str,
    label: &'static str,
    meaning: fn(&Params) -> String,
}

fn nothing(_: &Params) -> String {
    String::new()
}

const WIND_ROWS: [Row; 2] = [
    Row { key: "fetch", label: text!("Blowing over"), meaning: |_| tr("of open water (fetch)").into() },
    Row { key: "dir", label: text!("Wind from"), meaning: |p| tr(compass_point(p.sea.first_system().from_deg)).into() },
];
const SWELL_ROWS: [Row; 3] = [
    Row { key: "hs2", label: text!("Swell height"), meaning: |_| tr("waves of a wind far away").into() },
    Row { key: "tp2", label: text!("Swell period"), meaning: swell_length },
    Row { key: "dir2", label: text!("Swell from"), meaning: |p| tr(compass_point(p.sea.systems[1].from_deg)).into() },
];
/// The sun by direction.
const SUN_ROWS: [Row; 2] = [
    Row { key: "sun", label: text!("Sun height"), meaning: |p| tr(time_of_light(p)).into() },
    Row {
        key: "sunaz",
        label: text!("Sun in the"),
        meaning: |p| tr(compass_point(sun::sky_of_now(p).sun_elevation_azimuth_deg()[1])).into(),
    },
];
/// The sun by date.
const DATE_ROWS: [Row; 3] = [
    Row { key: "hour", label: text!("Solar time"), meaning: hour_of_now },
    Row { key: "day", label: text!("Day of the year"), meaning: nothing },
    Row { key: "lat", label: text!("Latitude"), meaning: nothing },
];
const SKY_ROWS: [Row; 2] = [
    Row { key: "clouds", label: text!("Clouds"), meaning: nothing },
    Row { key: "cloudcover", label: text!("Cloud cover"), meaning: nothing },
];
const WATER_ROWS: [Row; 1] = [Row { key: "depth", label: text!("Water depth"), meaning: nothing }];

/// Length of the swell in water of the sea's depth, in words; empty if its period is computed from the wind.
fn swell_length(p: &Params) -> String {
    let period_s = p.sea.systems[1].tp_s;
    if period_s > 0.0 {
        let k = Dispersion::new(&p.sea).wave_number(TAU / period_s);
        say!("about {length} m long", length = format!("{:.0}", TAU / k))
    } else {
        String::new()
    }
}

/// The time of the sun's day on a clock, and the light of that time.
fn hour_of_now(p: &Params) -> String {
    let [_, hour] = p.look.sky.day_and_hour(p.clock.t_s);
    let now = format!("{}, {}", sun::clock_text(hour), tr(time_of_light(p)));
    match sun::low_sun_moves(&sun::sky_of_now(p)) {
        Some(moves) => format!("{now}, {}", tr(moves)),
        None => now,
    }
}

fn time_of_light(p: &Params) -> &'static str {
    match sun::sky_of_now(p).sun_elevation_azimuth_deg()[0] {
        x if x < -12.0 => text!("night"),
        x if x < -6.0 => text!("late dusk or early dawn"),
        x if x < 0.0 => text!("dusk or dawn"),
        x if x < 10.0 => text!("golden light"),
        x if x < 35.0 => text!("morning or afternoon"),
        _ => text!("high sun"),
    }
}

/// Adds the widgets of the tab.
pub fn show_weather(app: &mut App, ui: &mut egui::Ui) {
    wind::show_wind(app, ui);
    show_rows(app, ui, &WIND_ROWS);
    ui.separator();
    sun::show_lights(app, ui);
    ui.separator();
    let swell_before = app.params.sea.systems[1].clone();
    show_rows(app, ui, &SWELL_ROWS);
    // Whoever moves a slider of the swell wants one.
    let swell = &mut app.params.sea.systems[1];
    if *swell != swell_before && !swell.is_on() {
        swell.height_factor = 1.0;
    }
    ui.horizontal_wrapped(|ui| {
        let swell = &mut app.params.sea.systems[1];
        if swell.is_on() && ui.button(tr("No swell")).clicked() {
            swell.height_factor = 0.0;
        }
        if let Some(sum) = summary::heights_in_words(app) {
            ui.weak(sum);
        }
    });
    ui.separator();
    show_rows(app, ui, &WATER_ROWS);
    coast::show_coast(app, ui);
    coast::show_map_and_effects(app, ui);
    ui.separator();
    show_sun(app, ui);
    show_rows(app, ui, &SKY_ROWS);
}

/// Adds the rows that place the sun, by direction or by date, and the button that changes between the two.
fn show_sun(app: &mut App, ui: &mut egui::Ui) {
    let t_s = app.params.clock.t_s;
    let is_by_date = app.params.look.sky.sun_placement == SunPlacement::Date;
    show_rows(app, ui, if is_by_date { &DATE_ROWS[..] } else { &SUN_ROWS[..] });
    if app.params.look.sky.panorama().is_some() {
        return;
    }
    if is_by_date {
        sun::show_rise_and_set(&app.params, ui);
        let help = tr("The sun stays where it is, and sliders for its height and direction move it.");
        if button_with_help(ui, tr("Place the sun by hand"), help) {
            app.params.look.sky.place_sun_by_direction(t_s);
        }
    } else {
        let help = tr("The sun stays where it is, and sliders for hour, day and latitude move it.");
        if button_with_help(ui, tr("Place the sun by hour and date"), help) {
            app.params.look.sky.place_sun_by_date();
        }
    }
}

fn show_rows(app: &mut App, ui: &mut egui::Ui, rows: &[Row]) {
    for row in rows {
        let Some(field) = fields::find(row.key) else { continue };
        let meaning = (row.meaning)(&app.params);
        ui.add_space(4.0);
        // A slider of the swell switches it on, so it has an effect also while there is no swell.
        let is_swell = field.group == Group::SecondSystem;
        let inactive = field.inactive_because(&app.params).filter(|_| !is_swell);
        let label = ui.horizontal(|ui| {
            let label = ui.add_enabled(inactive.is_none(), egui::Label::new(tr(row.label)));
            let label = rows::explain(ui, label, tr(field.help));
            if inactive.is_none() {
                ui.weak(meaning);
            }
            label.id
        });
        if let Some(why) = inactive {
            ui.weak(egui::RichText::new(tr(why.reason)).size(rows::REASON_TEXT_POINTS));
        }
        rows::show_value(&mut app.params, field, (label.inner, inactive.is_none()), ui);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn compass_points_are_the_nearest() {
        let points = [(0.0, "N"), (350.0, "N"), (45.0, "NE"), (269.0, "W"), (281.0, "W"), (282.0, "WNW"), (-90.0, "W")];
        for (deg, name) in points {
            assert_eq!(compass_point(deg), name, "{deg}");
        }
    }
}
