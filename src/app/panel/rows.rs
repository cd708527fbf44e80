//! One row of the panel for each parameter: slider, number field with unit, choice, check box or colour.

use super::super::accessible_names::with_accessible_name;
use super::super::units::UnitScale;
use crate::state::Params;
use crate::state::fields::{Field, FieldKind, Group, InvalidValue};
use crate::state::params::Units;

/// Whether a search for `words` finds a parameter: each word occurs in its label, key, group or help text, in upper or
/// lower case.
pub fn matches_search(field: &Field, words: &str) -> bool {
    let text = format!("{} {} {} {}", field.key, field.label, field.group.label(), field.help).to_lowercase();
    words.to_lowercase().split_whitespace().all(|word| text.contains(word))
}

/// Adds the rows of the parameters `fields` of a group.
pub fn show_group(params: &mut Params, group: Group, fields: &[&'static Field], ui: &mut egui::Ui) {
    let units = params.screen.units;
    egui::Grid::new(group.label()).num_columns(3).show(ui, |ui| {
        for field in fields {
            show_field_row(params, field, units, ui);
            ui.end_row();
        }
    });
}

fn show_field_row(params: &mut Params, field: &'static Field, units: Units, ui: &mut egui::Ui) {
    let unit = if field.unit.is_empty() { String::new() } else { format!(" {}", field.unit) };
    let help = format!(
        "{}\n{} = {}{unit}, default {}",
        field.help,
        field.key,
        field.allowed_values_text(),
        field.format(field.default_value())
    );
    let label = ui.label(field.label).on_hover_text(&help);
    let before = (field.get)(params);
    let mut value = before;
    value_editor(field, &mut value, units, ui).labelled_by(label.id).on_hover_text(&help);
    let default = field.default_value();
    let undo = egui::Button::new("×").small().frame(false);
    let undo = with_accessible_name(
        ui.add_enabled(value != default, undo),
        &format!("{}, {}: back to the default", field.group.label(), field.label),
    );
    if undo.on_hover_text("Back to the default.").clicked() {
        value = default;
    }
    if value != before {
        // A typed value outside the range was clamped, and the slider shows the clamped value.
        let (Ok(v) | Err(InvalidValue::Clamped(v))) = field.check_value(value) else { return };
        (field.set)(params, v);
    }
}

/// Adds a wide widget for one parameter. `label` is the widget that shows its name.
pub fn show_value(params: &mut Params, field: &'static Field, label: egui::Id, ui: &mut egui::Ui) {
    let before = (field.get)(params);
    let mut value = before;
    ui.spacing_mut().slider_width = slider_width(ui);
    value_editor(field, &mut value, params.screen.units, ui).labelled_by(label).on_hover_text(field.help);
    if value != before {
        let (Ok(v) | Err(InvalidValue::Clamped(v))) = field.check_value(value) else { return };
        (field.set)(params, v);
    }
}

/// Width of a slider, points, that leaves room for its number at the right.
pub fn slider_width(ui: &egui::Ui) -> f32 {
    (ui.available_width() - 92.0).max(80.0)
}

fn value_editor(field: &'static Field, value: &mut f64, units: Units, ui: &mut egui::Ui) -> egui::Response {
    match field.kind {
        FieldKind::Number { min, max, log } => number_editor(field, value, (min, max, log), units, ui),
        FieldKind::Heading => ui.add(egui::Slider::new(value, 0.0..=360.0).suffix("°").max_decimals(1)),
        FieldKind::Integer { min, max } if max > 1000 => {
            ui.add(egui::DragValue::new(value).range(f64::from(min)..=f64::from(max)).max_decimals(0))
        }
        FieldKind::Integer { min, max } => ui.add(with_unit_and_zero_word(
            field,
            egui::Slider::new(value, f64::from(min)..=f64::from(max)).integer(),
            1.0,
            units,
        )),
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
    units: Units,
    ui: &mut egui::Ui,
) -> egui::Response {
    let scale = UnitScale::for_field(field, units);
    let mut shown = *value * scale.factor;
    let before = shown;
    let slider =
        egui::Slider::new(&mut shown, min * scale.factor..=max * scale.factor).logarithmic(log).smart_aim(true);
    let response = ui.add(with_unit_and_zero_word(field, slider, scale.factor, units));
    if shown != before {
        // More digits would only make the link longer.
        let digits = if scale.factor == 1.0 { shown } else { round_to_significant_digits(shown / scale.factor) };
        *value = digits;
    }
    response
}

/// Rounds a number to six significant digits.
pub fn round_to_significant_digits(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
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
/// Both can also be typed. `factor` is the shown value divided by the metric value.
fn with_unit_and_zero_word<'a>(
    field: &'static Field,
    slider: egui::Slider<'a>,
    factor: f64,
    units: Units,
) -> egui::Slider<'a> {
    let scale = UnitScale::for_field(field, units);
    let unit = scale.suffix();
    // On a linear slider with a wide range small values could not be set.
    let most = if let FieldKind::Number { max, .. } = field.kind { max * factor } else { 0.0 };
    let wide = !field.zero_word.is_empty() && most > 100.0 * factor;
    let slider = if wide { slider.logarithmic(true).smallest_positive(1e-6 * most) } else { slider };
    slider
        .custom_formatter(move |value, digits| match value {
            0.0 if !field.zero_word.is_empty() => field.zero_word.to_owned(),
            _ => format!("{}{unit}", egui::emath::format_with_decimals_in_range(value, digits)),
        })
        .custom_parser(move |text| {
            let zero = !field.zero_word.is_empty() && text.trim().eq_ignore_ascii_case(field.zero_word);
            if zero { Some(0.0) } else { scale.parse(text) }
        })
}
