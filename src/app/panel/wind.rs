//! The wind in the panel: a slider with marks of the Beaufort scale, the speed as a number, and what a sea of this
//! force looks like beside this sea.

use super::super::App;
use super::super::accessible_names::with_accessible_value;
use super::super::units::{UnitScale, round_to_significant_digits};
use super::{button_with_help, rows, touch};
use crate::app::language::{say, tr};
use crate::state::fields;
use crate::state::params::SpectrumKind;
use crate::waves::beaufort::{self, BEAUFORT_FORCES, BeaufortForce};

/// Height of the marks below the slider, and of the ticks among them, points.
const MARKS_POINTS: [f32; 2] = [14.0, 3.0];
/// Size of the numbers at the marks, points.
const MARK_TEXT_POINTS: f32 = 10.0;
/// Least distance of two numbers at the marks, points: room for `11`.
const LEAST_NUMBER_DISTANCE_POINTS: f32 = 15.0;
/// Ratios of the height of the wind's waves to that of the textbook between which they count as alike.
const ALIKE: std::ops::RangeInclusive<f64> = 0.75..=1.33;
/// Adds the slider of the wind speed, its force and name on the Beaufort scale, what the sea looks like in it, and a
/// button that gives the wind the fetch for which the sea is as high as the scale says, if it has another one.
pub fn show_wind(app: &mut App, ui: &mut egui::Ui) {
    let force = beaufort::beaufort_number(app.params.sea.first_system().wind_m_s);
    ui.horizontal(|ui| {
        ui.strong(tr("Wind"));
        let english = BEAUFORT_FORCES[force].name;
        // Translations have the letters that their language wants: German nouns begin with a capital.
        let name = if tr(english) == english { english.to_lowercase() } else { tr(english).to_owned() };
        ui.weak(say!("force {force}, {name}", force = force, name = name));
    });
    show_force_slider(app, ui);
    let force = &BEAUFORT_FORCES[beaufort::beaufort_number(app.params.sea.first_system().wind_m_s)];
    let why = fetch_in_words(app, force);
    // Waves that have not grown as high as the scale says look otherwise.
    let appearance = match &why {
        Some(_) => {
            egui::RichText::new(say!("In a fully grown sea: {appearance}", appearance = tr(force.appearance))).weak()
        }
        None => tr(force.appearance).into(),
    };
    ui.label(appearance).on_hover_text(tr("Beaufort scale, WMO"));
    ui.label(height_in_words(app, force, why));
    if app.params.sea.first_system().fetch_km != force.fetch_km {
        let help = tr("Lets the wind blow over so much water that the sea is as high as the Beaufort scale says.");
        if button_with_help(ui, tr("As high as the textbook"), help) {
            let wind_m_s = app.params.sea.first_system().wind_m_s;
            app.params = force.apply(&app.params);
            app.params.sea.systems[0].wind_m_s = wind_m_s;
        }
    }
}

/// How high this sea is, beside what the textbook says of the wind's force; and `why`, if the fetch makes a great
/// difference.
fn height_in_words(app: &App, force: &BeaufortForce, why: Option<String>) -> String {
    let metres = app.length_scale();
    let hs_m = app.derived.theoretical_statistics.hs_m;
    let (code, word) = beaufort::sea_state(hs_m);
    let Some(why) = why else {
        return say!(
            "Textbook height {textbook}, this sea {height}; sea state {code}, {word} (Douglas)",
            textbook = metres.format(force.probable_hs_m, 1),
            height = metres.format(hs_m, 1),
            code = code,
            word = tr(word),
        );
    };
    let this = say!(
        "This sea is {height} high: sea state {code}, {word} (Douglas).",
        height = metres.format(hs_m, 1),
        code = code,
        word = tr(word),
    );
    format!("{why} {this}")
}

/// Why the waves of the wind are much lower or higher than the textbook says; `None` if they are about as high, or if
/// it is not the fetch that makes them so.
fn fetch_in_words(app: &App, force: &BeaufortForce) -> Option<String> {
    let wind = app.params.sea.first_system();
    let follows_fetch = !matches!(
        wind.spectrum,
        SpectrumKind::PiersonMoskowitz
            | SpectrumKind::GeneralisedAb
            | SpectrumKind::OchiHubble
            | SpectrumKind::Measured
    );
    if !follows_fetch || wind.hs_m > 0.0 || wind.tp_s > 0.0 || !wind.is_on() || force.probable_hs_m <= 0.0 {
        return None;
    }
    let derived = &app.derived;
    let of_wind = derived.systems.iter().find(|system| system.number == 1).map(|system| system.hs_m);
    let hs_m = of_wind.unwrap_or(derived.theoretical_statistics.hs_m);
    if ALIKE.contains(&(hs_m / force.probable_hs_m)) || (hs_m < force.probable_hs_m) != (wind.fetch_km < force.fetch_km)
    {
        return None;
    }
    let metres = app.length_scale();
    let fetch = UnitScale::for_unit("km", app.params.screen.units).format(wind.fetch_km, 0);
    let (height, textbook) = (metres.format(hs_m, 1), metres.format(force.probable_hs_m, 1));
    Some(if hs_m < force.probable_hs_m {
        say!(
            "The wind has blown over only {fetch} of water, so its waves are {height} high. In a fully grown sea of \
             this force they are {textbook} high (textbook).",
            fetch = fetch,
            height = height,
            textbook = textbook,
        )
    } else {
        say!(
            "The wind has blown over {fetch} of water, so its waves are {height} high. The textbook expects \
             {textbook} at this force.",
            fetch = fetch,
            height = height,
            textbook = textbook,
        )
    })
}

/// The wind in a line, such as `Wind 8.0 m/s, force 5`.
pub fn wind_in_words(app: &App) -> String {
    let wind_m_s = app.params.sea.first_system().wind_m_s;
    let speed = UnitScale::for_unit("m/s", app.params.screen.units).format(wind_m_s, 1);
    say!("Wind {speed}, force {force}", speed = speed, force = beaufort::beaufort_number(wind_m_s))
}

/// Adds the slider of the wind's force with its marks, and the field of its speed.
pub fn show_force_slider(app: &mut App, ui: &mut egui::Ui) {
    let wind_m_s = app.params.sea.first_system().wind_m_s;
    let force = beaufort::beaufort_number(wind_m_s);
    let mut number = force as f64;
    ui.scope(|ui| {
        // The marks belong to the slider, so they stand close to it.
        ui.spacing_mut().item_spacing.y = 0.0;
        let slider = ui.horizontal(|ui| {
            ui.spacing_mut().slider_width = rows::slider_width(ui);
            let slider = ui.add(egui::Slider::new(&mut number, 0.0..=12.0).integer().show_value(false));
            touch::keep_value_while_scrolling(ui, &slider, &mut number, force as f64);
            let slider = with_accessible_value(slider, tr("Beaufort"), number);
            let place = rows::explain(ui, slider, tr("Sets the wind of this force.")).rect;
            show_speed(app, ui);
            place
        });
        if let Some(pressed) = show_force_marks(slider.inner, number.round() as usize, ui) {
            number = pressed as f64;
        }
    });
    let number = number.round() as usize;
    if number != force {
        app.params.sea.systems[0].wind_m_s = BEAUFORT_FORCES[number].mean_wind_m_s;
        // A wind that does nothing, such as that of a measured spectrum, shall blow.
        if fields::find("wind").is_some_and(|wind| wind.inactive_because(&app.params).is_some()) {
            app.params = BEAUFORT_FORCES[number].apply(&app.params);
        }
    }
}

/// Adds the field of the wind's speed.
fn show_speed(app: &mut App, ui: &mut egui::Ui) {
    let speed = UnitScale::for_unit("m/s", app.params.screen.units);
    let wind_m_s = app.params.sea.first_system().wind_m_s;
    let mut shown = wind_m_s * speed.factor;
    let exact = egui::DragValue::new(&mut shown).range(0.0..=60.0 * speed.factor).speed(0.1).max_decimals(1);
    let exact = exact.suffix(speed.suffix()).custom_parser(move |text| parse_wind(text, speed));
    let exact = with_accessible_value(ui.add(exact), tr("Wind speed"), wind_m_s);
    let help = tr("Wind speed 10 m above the sea; 25 kn, 12 m/s, force 7, 7 bft and F7 are understood.");
    if exact.on_hover_text(help).changed() {
        app.params.sea.systems[0].wind_m_s = round_to_significant_digits(shown / speed.factor);
    }
}

/// Adds a tick for each force below the slider at `slider`, and numbers at as many of them as there is room for. Returns
/// the force whose mark was clicked.
fn show_force_marks(slider: egui::Rect, force: usize, ui: &mut egui::Ui) -> Option<usize> {
    let [height, tick] = MARKS_POINTS;
    // The slider above is what keys and screen readers use, so the marks take no focus.
    let (id, space) = ui.allocate_space(egui::vec2(slider.width(), height));
    let row = egui::Rect::from_x_y_ranges(slider.x_range(), space.y_range());
    let clicked = ui.interact(row, id, egui::Sense::CLICK);
    // The middle of a slider's handle keeps its radius away from the ends: egui's `SliderGeometry::handle_radius`.
    let range = slider.x_range().shrink(slider.height() / 2.5);
    let distance = range.span() / 12.0;
    let (first, step) = numbered_forces(distance);
    let (weak, strong) = (ui.visuals().weak_text_color(), ui.visuals().strong_text_color());
    for number in 0..=12 {
        let x = range.min + distance * number as f32;
        let colour = if number == force { strong } else { weak };
        ui.painter().vline(x, egui::Rangef::new(row.top(), row.top() + tick), egui::Stroke::new(1.0, colour));
        if number >= first && (number - first) % step == 0 {
            let (at, font) = (egui::pos2(x, row.bottom()), egui::FontId::proportional(MARK_TEXT_POINTS));
            ui.painter().text(at, egui::Align2::CENTER_BOTTOM, number, font, colour);
        }
    }
    let at = clicked.interact_pointer_pos().filter(|_| clicked.clicked())?;
    Some(((at.x - range.min) / distance).round().clamp(0.0, 12.0) as usize)
}

/// The first force with a number, and the step from one number to the next, for marks at this distance, points.
fn numbered_forces(distance: f32) -> (usize, usize) {
    let steps = [(0, 1), (1, 2), (3, 4), (3, 6)];
    let has_room = |(_, step): &(usize, usize)| distance * *step as f32 >= LEAST_NUMBER_DISTANCE_POINTS;
    steps.into_iter().find(has_room).unwrap_or((0, 12))
}

/// Reads a typed wind speed in the shown unit `speed`, in another unit that is named, or as a force ("7 bft", "F7").
fn parse_wind(text: &str, speed: UnitScale) -> Option<f64> {
    let lower = text.trim().to_lowercase();
    if !beaufort::names_force(&lower) {
        return speed.parse(&lower);
    }
    Some(BEAUFORT_FORCES[beaufort::parse_force(&lower)?].mean_wind_m_s * speed.factor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::params::Units;

    #[test]
    fn a_typed_wind_may_have_any_unit() {
        let speed = UnitScale::for_unit("m/s", Units::Metric);
        assert!((parse_wind("25 kn", speed).expect("knots") - 12.861).abs() < 1e-3);
        assert_eq!([parse_wind("7 bft", speed), parse_wind("F7", speed)], [Some(15.5); 2]);
        assert_eq!(parse_wind("12", speed), Some(12.0));
        assert_eq!([parse_wind("13 bft", speed), parse_wind("x", speed)], [None; 2]);
    }

    /// Numbers never touch, and a slider of usual width has those that sailors speak of.
    #[test]
    fn the_marks_have_as_many_numbers_as_there_is_room_for() {
        assert_eq!(
            [20.0, 12.0, 8.0, 4.0, 2.6, 0.5].map(numbered_forces),
            [(0, 1), (1, 2), (1, 2), (3, 4), (3, 6), (0, 12)]
        );
    }
}
