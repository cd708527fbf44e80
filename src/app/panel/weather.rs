//! The panel's tab of the weather: the few parameters that most people want, in words.

use super::super::App;
use super::super::accessible_names::with_accessible_value;
use super::super::units::{UnitScale, round_to_significant_digits};
use super::{button_with_help, coast, rows, sun, touch};
use crate::app::language::{say, text, tr};
use crate::state::Params;
use crate::state::fields::{self, Group};
use crate::state::look::SunPlacement;
use crate::waves::beaufort::{self, BEAUFORT_FORCES};
use crate::waves::dispersion::Dispersion;
use std::f64::consts::TAU;

/// Lines that the longest description of a Beaufort force takes in the panel.
const APPEARANCE_LINES: f32 = 3.0;

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
    format!("{}, {}", sun::clock_text(hour), tr(time_of_light(p)))
}

fn time_of_light(p: &Params) -> &'static str {
    match sun::sky_of_now(p).sun_elevation_azimuth_deg()[0] {
        x if x < -12.0 => text!("night"),
        x if x < 0.0 => text!("dusk or dawn"),
        x if x < 10.0 => text!("golden light"),
        x if x < 35.0 => text!("morning or afternoon"),
        _ => text!("high sun"),
    }
}

/// Adds the widgets of the tab.
pub fn show_weather(app: &mut App, ui: &mut egui::Ui) {
    show_wind(app, ui);
    show_rows(app, ui, &WIND_ROWS);
    ui.separator();
    let swell_before = app.params.sea.systems[1].clone();
    show_rows(app, ui, &SWELL_ROWS);
    // Whoever moves a slider of the swell wants one.
    let swell = &mut app.params.sea.systems[1];
    if *swell != swell_before && !swell.is_on() {
        swell.height_factor = 1.0;
    }
    if swell.is_on() && ui.button(tr("No swell")).clicked() {
        swell.height_factor = 0.0;
    }
    ui.separator();
    show_sun(app, ui);
    show_rows(app, ui, &SKY_ROWS);
    ui.separator();
    show_rows(app, ui, &WATER_ROWS);
    coast::show_coast(app, ui);
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

/// Adds the slider of the wind speed, its force and name on the Beaufort scale, what the sea looks like in it, and a
/// button that gives the wind the fetch for which the sea is as high as the scale says, if it has another one.
fn show_wind(app: &mut App, ui: &mut egui::Ui) {
    let force = beaufort::beaufort_number(app.params.sea.first_system().wind_m_s);
    ui.horizontal(|ui| {
        ui.strong(tr("Wind"));
        let english = BEAUFORT_FORCES[force].name;
        // Translations have the letters that their language wants: German nouns begin with a capital.
        let name = if tr(english) == english { english.to_lowercase() } else { tr(english).to_owned() };
        ui.weak(say!("force {force}, {name}", force = force, name = name));
    });
    ui.horizontal(|ui| show_force_slider(app, ui));
    let force = beaufort::beaufort_number(app.params.sea.first_system().wind_m_s);
    let force = &BEAUFORT_FORCES[force];
    let metres = app.length_scale();
    let hs_m = app.derived.theoretical_statistics.hs_m;
    let (code, word) = beaufort::sea_state(hs_m);
    // Room for the longest text, so that no row below moves away from the pointer.
    ui.scope(|ui| {
        ui.set_min_height(APPEARANCE_LINES * ui.text_style_height(&egui::TextStyle::Body));
        ui.label(tr(force.appearance)).on_hover_text(tr("Beaufort scale, WMO"));
    });
    ui.weak(say!(
        "Textbook height {textbook}, this sea {height}; sea state {code}, {word} (Douglas)",
        textbook = metres.format(force.probable_hs_m, 1),
        height = metres.format(hs_m, 1),
        code = code,
        word = tr(word),
    ));
    if app.params.sea.first_system().fetch_km != force.fetch_km {
        let help = tr("Lets the wind blow over so much water that the sea is as high as the Beaufort scale says.");
        if button_with_help(ui, tr("As high as the textbook"), help) {
            let wind_m_s = app.params.sea.first_system().wind_m_s;
            app.params = force.apply(&app.params);
            app.params.sea.systems[0].wind_m_s = wind_m_s;
        }
    }
}

/// Adds the slider of the wind's force, and the field of its speed.
pub fn show_force_slider(app: &mut App, ui: &mut egui::Ui) {
    let speed = UnitScale::for_unit("m/s", app.params.screen.units);
    let wind_m_s = app.params.sea.first_system().wind_m_s;
    let force = beaufort::beaufort_number(wind_m_s);
    let mut number = force as f64;
    ui.spacing_mut().slider_width = rows::slider_width(ui);
    let slider = egui::Slider::new(&mut number, 0.0..=12.0).integer().show_value(false);
    let help = tr("Sets the wind of this force.");
    let slider = ui.add(slider);
    touch::keep_value_while_scrolling(ui, &slider, &mut number, force as f64);
    rows::explain(ui, with_accessible_value(slider, tr("Beaufort"), number), help);
    let mut shown = wind_m_s * speed.factor;
    let exact = egui::DragValue::new(&mut shown).range(0.0..=60.0 * speed.factor).speed(0.1).max_decimals(1);
    let exact = exact.suffix(speed.suffix()).custom_parser(move |text| parse_wind(text, speed));
    let exact = with_accessible_value(ui.add(exact), tr("Wind speed"), wind_m_s);
    if exact.on_hover_text(tr("Wind speed 10 m above the sea; 25 kn, 12 m/s and 7 bft are understood.")).changed() {
        app.params.sea.systems[0].wind_m_s = round_to_significant_digits(shown / speed.factor);
    }
    let number = number.round() as usize;
    if number != force {
        app.params.sea.systems[0].wind_m_s = BEAUFORT_FORCES[number].mean_wind_m_s;
        // A wind that does nothing, such as that of a measured spectrum, shall blow.
        if fields::find("wind").is_some_and(|wind| wind.inactive_because(&app.params).is_some()) {
            app.params = BEAUFORT_FORCES[number].apply(&app.params);
        }
    }
}

/// Reads a typed wind speed in the shown unit `speed`, in another unit that is named, or in Beaufort ("7 bft").
fn parse_wind(text: &str, speed: UnitScale) -> Option<f64> {
    let lower = text.trim().to_lowercase();
    let Some(force) = lower.strip_suffix("bft").or_else(|| lower.strip_prefix("force")) else {
        return speed.parse(&lower);
    };
    let force: usize = force.trim().parse().ok()?;
    Some(BEAUFORT_FORCES.get(force)?.mean_wind_m_s * speed.factor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::params::Units;

    #[test]
    fn compass_points_are_the_nearest() {
        let points = [(0.0, "N"), (350.0, "N"), (45.0, "NE"), (269.0, "W"), (281.0, "W"), (282.0, "WNW"), (-90.0, "W")];
        for (deg, name) in points {
            assert_eq!(compass_point(deg), name, "{deg}");
        }
    }

    #[test]
    fn a_typed_wind_may_have_any_unit() {
        let speed = UnitScale::for_unit("m/s", Units::Metric);
        assert!((parse_wind("25 kn", speed).expect("knots") - 12.861).abs() < 1e-3);
        assert_eq!(parse_wind("7 bft", speed), Some(15.5));
        assert_eq!(parse_wind("force 9", speed), Some(22.6));
        assert_eq!(
            (parse_wind("12", speed), parse_wind("13 bft", speed), parse_wind("x", speed)),
            (Some(12.0), None, None)
        );
    }
}
