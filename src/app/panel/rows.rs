//! One row of the panel for each parameter: slider, number field with unit, choice, check box or colour.

use super::super::accessible_names::with_accessible_name;
use super::super::units::{UnitScale, round_to_significant_digits};
use super::touch;
use crate::app::language::{local_number, say, tr};
use crate::state::fields::{Field, FieldKind, Group, InvalidValue};
use crate::state::{Params, day_words};

/// Whether a search for `words` finds a parameter: each word, or another word for the same thing, occurs in its label,
/// key, group or help text, in upper or lower case.
pub fn matches_search(field: &Field, words: &str) -> bool {
    let english = [field.key, field.label, field.group.label(), field.help];
    has_all_words(&english.map(|text| format!("{text} {}", tr(text))).join(" "), words)
}

/// Other words for what the texts of the parameters say.
const SYNONYMS: &[(&str, &[&str])] = &[
    ("color", &["colour"]),
    ("gray", &["grey"]),
    ("meter", &["metre"]),
    ("sunset", &["sun height", "sun by"]),
    ("sunrise", &["sun height", "sun by"]),
    ("dusk", &["sun height"]),
    ("beaufort", &["wind"]),
    ("storm", &["wind", "clouds"]),
    ("mist", &["fog"]),
    ("quality", &["render scale", "fft size"]),
    ("resolution", &["render scale", "fft size"]),
    ("zoom", &["field of view"]),
    ("lens", &["field of view"]),
    ("whitecap", &["foam"]),
    ("direction", &["azimuth", "heading", "from"]),
];

/// Whether each of the words occurs in a text, or another word for it, in upper or lower case.
pub fn has_all_words(text: &str, words: &str) -> bool {
    let text = text.to_lowercase();
    let has_synonym = |word: &str| {
        let mut others = SYNONYMS.iter().filter(|(known, _)| word.starts_with(known)).flat_map(|(_, others)| *others);
        others.any(|other| text.contains(other))
    };
    words.to_lowercase().split_whitespace().all(|word| text.contains(word) || has_synonym(word))
}

/// Width of a slider beside its label, points: label, slider and number then fit the panel.
const GRID_SLIDER_POINTS: f32 = 96.0;
/// Width of the rows of a section in a panel of the usual width, points. A wider panel has longer sliders.
const GRID_WIDTH_POINTS: f32 = 334.0;
/// Least width of a slider beside its label, points.
const MIN_GRID_SLIDER_POINTS: f32 = 64.0;
/// Size of the sentence that says why a row has no effect, points.
pub const REASON_TEXT_POINTS: f32 = 11.5;
/// Width of the sentence below a row that says why it has no effect, points.
const REASON_WIDTH_POINTS: f32 = 190.0;

/// Explains a widget of the panel in a tooltip at the panel's left side, or above it: a tooltip below it would cover
/// the next rows, and what the widget changes.
pub fn explain(ui: &egui::Ui, response: egui::Response, text: &str) -> egui::Response {
    let row = response.rect.with_min_x(ui.clip_rect().left()).with_max_x(ui.clip_rect().right());
    let is_open = egui::Tooltip::should_show_tooltip(&response, true);
    let mut tooltip = egui::Tooltip::for_widget(&response);
    let places = &[egui::RectAlign::TOP_START, egui::RectAlign::BOTTOM_START];
    tooltip.popup =
        tooltip.popup.open(is_open).anchor(row).align(egui::RectAlign::LEFT_START).align_alternatives(places);
    tooltip.show(|ui| ui.label(text));
    response
}

/// Adds the rows of the parameters `fields` of a group.
pub fn show_group(params: &mut Params, group: Group, fields: &[&'static Field], ui: &mut egui::Ui) {
    let more = ui.available_width() - GRID_WIDTH_POINTS;
    ui.spacing_mut().slider_width = (GRID_SLIDER_POINTS + more).max(MIN_GRID_SLIDER_POINTS);
    egui::Grid::new(group.label()).num_columns(3).show(ui, |ui| {
        for field in fields {
            show_field_row(params, field, ui);
            ui.end_row();
        }
    });
}

fn show_field_row(params: &mut Params, field: &'static Field, ui: &mut egui::Ui) {
    let unit = if field.unit.is_empty() { String::new() } else { format!(" {}", field.unit) };
    let mut help = say!(
        "{help}\n{key} = {values}, default {default}",
        help = tr(field.help),
        key = field.key,
        values = format!("{}{unit}", field.allowed_values_text()),
        default = field.format(field.default_value()),
    );
    let inactive = field.inactive_because(params);
    if let Some(why) = inactive {
        help = format!("{}\n\n{help}", say!("No effect now. {reason}", reason = tr(why.reason)));
    }
    let label = ui.add_enabled(inactive.is_none(), egui::Label::new(tr(field.label)));
    let label = explain(ui, label, &help);
    let before = (field.get)(params);
    let mut value = before;
    ui.vertical(|ui| {
        let editor = ui.add_enabled_ui(inactive.is_none(), |ui| value_editor(field, &mut value, params, ui)).inner;
        explain(ui, editor.labelled_by(label.id), &help);
        if let Some(why) = inactive.filter(|_| touch::is_used(ui.ctx())) {
            ui.set_max_width(REASON_WIDTH_POINTS);
            ui.weak(egui::RichText::new(tr(why.reason)).size(REASON_TEXT_POINTS));
        }
    });
    let default = field.default_value();
    let undo = egui::Button::new("×").small().frame(false);
    let undo = with_accessible_name(
        ui.add_enabled(value != default, undo),
        &say!("{group}, {label}: back to the default", group = tr(field.group.label()), label = tr(field.label)),
    );
    if undo.on_hover_text(tr("Back to the default.")).clicked() {
        value = default;
    }
    if value != before {
        set_value(params, field, value);
    }
}

/// Sets a parameter to a typed or dragged value. A typed value outside the range is clamped, and the slider shows the
/// clamped value.
fn set_value(params: &mut Params, field: &Field, value: f64) {
    let (Ok(value) | Err(InvalidValue::Clamped(value))) = field.check_value(value) else { return };
    if field.key == "daylight" {
        // Another speed of the day leaves the sun where it is at this moment.
        params.look.sky.set_daylight(value, params.clock.t_s);
    } else {
        (field.set)(params, value);
    }
}

/// Adds a wide widget for one parameter, disabled if `is_enabled` is false. `label` is the widget that shows its name.
pub fn show_value(
    params: &mut Params,
    field: &'static Field,
    (label, is_enabled): (egui::Id, bool),
    ui: &mut egui::Ui,
) {
    let before = (field.get)(params);
    let mut value = before;
    ui.spacing_mut().slider_width = slider_width(ui);
    let editor = ui.add_enabled_ui(is_enabled, |ui| value_editor(field, &mut value, params, ui)).inner;
    explain(ui, editor.labelled_by(label), tr(field.help));
    if value != before {
        set_value(params, field, value);
    }
}

/// Width of a slider, points, that leaves room for its number at the right.
pub fn slider_width(ui: &egui::Ui) -> f32 {
    (ui.available_width() - 92.0).max(80.0)
}

fn value_editor(field: &'static Field, value: &mut f64, params: &Params, ui: &mut egui::Ui) -> egui::Response {
    match field.kind {
        FieldKind::Number { min, max, log } => number_editor(field, value, (min, max, log), params, ui),
        FieldKind::Heading => {
            let before = *value;
            let response = ui.add(egui::Slider::new(value, 0.0..=360.0).suffix("°").max_decimals(1));
            touch::keep_value_while_scrolling(ui, &response, value, before);
            response
        }
        FieldKind::Integer { min, max } if max > 1000 => {
            ui.add(egui::DragValue::new(value).range(f64::from(min)..=f64::from(max)).max_decimals(0))
        }
        FieldKind::Integer { min, max } => {
            let before = *value;
            let slider = egui::Slider::new(value, f64::from(min)..=f64::from(max)).integer();
            let response = ui.add(with_unit_and_zero_word(field, slider, 1.0, params));
            touch::keep_value_while_scrolling(ui, &response, value, before);
            response
        }
        FieldKind::Choice(words) => {
            let mut index = *value as usize;
            let response = egui::ComboBox::from_id_salt(field.key)
                .selected_text(words[index.min(words.len() - 1)])
                .show_ui(ui, |ui| {
                    for (i, word) in words.iter().enumerate() {
                        ui.selectable_value(&mut index, i, *word);
                    }
                })
                .response;
            *value = index as f64;
            response
        }
        FieldKind::Flag => {
            let mut on = *value != 0.0;
            let response = ui.checkbox(&mut on, "");
            *value = f64::from(u8::from(on));
            response
        }
        FieldKind::Colour => colour_editor(field, value, ui),
    }
}

/// Adds a slider in the user's units for a metric `value` from `min` to `max`, logarithmic if `log`. The value changes
/// only if the slider moves, so converting units never rounds it.
fn number_editor(
    field: &'static Field,
    value: &mut f64,
    (min, max, log): (f64, f64, bool),
    params: &Params,
    ui: &mut egui::Ui,
) -> egui::Response {
    let scale = UnitScale::for_field(field, params.screen.units);
    let mut shown = *value * scale.factor;
    let before = shown;
    let slider =
        egui::Slider::new(&mut shown, min * scale.factor..=max * scale.factor).logarithmic(log).smart_aim(true);
    let response = ui.add(with_unit_and_zero_word(field, slider, scale.factor, params));
    touch::keep_value_while_scrolling(ui, &response, &mut shown, before);
    if shown != before {
        // More digits would only make the link longer.
        let digits = if scale.factor == 1.0 { shown } else { round_to_significant_digits(shown / scale.factor) };
        *value = digits;
    }
    response
}

/// Adds a colour picker for `value`, a colour as the number 0xRRGGBB, and beside it the colour as text.
fn colour_editor(field: &Field, value: &mut f64, ui: &mut egui::Ui) -> egui::Response {
    let bits = *value as u32;
    let mut rgb = [16, 8, 0].map(|shift| (bits >> shift) as u8);
    ui.horizontal(|ui| {
        let response = ui.color_edit_button_srgb(&mut rgb);
        ui.weak(field.format(*value));
        *value = rgb.iter().fold(0.0, |sum, &c| 256.0 * sum + f64::from(c));
        response
    })
    .inner
}

/// Makes a slider show the field's unit after the number, and the field's word for 0, such as "off", in place of 0.
/// Both can also be typed, and words for times of the day where they say something. `factor` is the shown value divided
/// by the metric value.
fn with_unit_and_zero_word<'a>(
    field: &'static Field,
    slider: egui::Slider<'a>,
    factor: f64,
    params: &'a Params,
) -> egui::Slider<'a> {
    let scale = UnitScale::for_field(field, params.screen.units);
    let unit = scale.suffix();
    // On a linear slider with a wide range small values could not be set.
    let most = if let FieldKind::Number { max, .. } = field.kind { max * factor } else { 0.0 };
    let wide = !field.zero_word.is_empty() && most > 100.0 * factor;
    let slider = if wide { slider.logarithmic(true).smallest_positive(1e-6 * most) } else { slider };
    slider
        .custom_formatter(move |value, digits| match value {
            0.0 if !field.zero_word.is_empty() => tr(field.zero_word).to_owned(),
            _ => format!("{}{unit}", local_number(egui::emath::format_with_decimals_in_range(value, digits))),
        })
        .custom_parser(move |text| {
            let zero = !field.zero_word.is_empty()
                && [field.zero_word, tr(field.zero_word)].iter().any(|word| text.trim().eq_ignore_ascii_case(word));
            if zero {
                Some(0.0)
            } else {
                day_words::typed_value(field.key, text, &params.look.sky).or_else(|| scale.parse(text))
            }
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::fields;

    #[test]
    fn other_words_for_the_same_thing_are_found() {
        let finds = |words: &str, key: &str| matches_search(fields::find(key).expect("a parameter"), words);
        assert!(finds("color", "suncolour") && finds("sun color", "suncolour") && finds("sunset", "sun"));
        assert!(finds("colour", "suncolour") && finds("Beaufort", "wind") && finds("whitecaps", "foam"));
        assert!(!finds("color", "hs") && !finds("sunset", "hs") && !finds("fog", "hs"));
    }
}
