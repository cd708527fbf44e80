//! The coast in the panel's tab of the weather: which one, and what it does to the waves.

use super::super::App;
use super::super::coast::COAST_NAMES;
use super::{button_with_help, coast_map, rows};
use crate::app::language::{say, text, tr};
use crate::coast::built_in::BuiltInCoast;
use crate::state::coast::CoastName;
use crate::state::presets;

/// Effects of a coast on waves, such as shoaling: the name of each, its explanation, and the named sea that shows it.
const EFFECTS: [(&str, &str, &str); 6] = [
    (
        text!("Shoaling"),
        text!(
            "In shallow water waves slow down. They draw together and grow, because their energy comes on as before."
        ),
        "Swell on a beach",
    ),
    (
        text!("Refraction"),
        text!(
            "The part of a crest in deeper water runs ahead. So crests turn towards the shore, and gather at headlands."
        ),
        "Headland and bay",
    ),
    (
        text!("Breaking"),
        text!("A wave that is nearly as high as the water is deep breaks, and rolls ashore as foam."),
        "Surf on a bar",
    ),
    (
        text!("Diffraction"),
        text!("Crests bend around an end into the calm behind it. Behind an island, waves from both sides cross."),
        "Behind the island",
    ),
    (
        text!("Reflection"),
        text!("A steep wall throws waves back, and they stand before it. Rubble swallows most of them."),
        "Harbour entrance",
    ),
    (
        text!("Focusing"),
        text!("A hill under water bends waves together, as a lens bends light: behind it they are the highest."),
        "Over the shoal",
    ),
];

/// Adds the choice of the coast, what is shown of it, and what coasts do to waves.
pub fn show_coast(app: &mut App, ui: &mut egui::Ui) {
    let now = app.params.coast.name;
    let mut chosen = now;
    ui.horizontal(|ui| {
        let label = ui.label(tr("Coast"));
        let name_of = |name: CoastName| COAST_NAMES.iter().find(|(each, _)| *each == name).map_or("", |(_, n)| tr(n));
        let list = egui::ComboBox::from_id_salt("coast").selected_text(name_of(now)).width(rows::slider_width(ui));
        let list = list.show_ui(ui, |ui| {
            for (name, _) in COAST_NAMES {
                ui.selectable_value(&mut chosen, name, name_of(name));
            }
        });
        list.response.labelled_by(label.id);
    });
    if chosen != now {
        app.choose_coast(chosen);
    }
    match (&app.params.coast.file, BuiltInCoast::find(now.word())) {
        (Some(file), _) => drop(ui.weak(&file.0.name)),
        (None, Some(coast)) => drop(ui.weak(tr(coast.about))),
        (None, None) => {}
    }
    if let Some(progress) = app.coast_progress() {
        ui.label(progress);
    }
    ui.horizontal_wrapped(|ui| {
        if let Some(depth_m) = app.unlike_depth_m() {
            let depth = app.length_scale().format(depth_m, 1);
            let help = tr("Gives the sea the depth with which the coast begins, so that the waves go on as they come.");
            if button_with_help(ui, &say!("Make the sea {depth} deep", depth = depth), help) {
                app.params.sea.depth_m = depth_m;
            }
        }
        show_open_button(app, ui);
    });
    if app.params.coast.is_on() {
        let header = egui::CollapsingHeader::new(tr("Map of the coast")).default_open(true);
        header.show(ui, |ui| coast_map::show_map(app, ui));
    }
    egui::CollapsingHeader::new(tr("What coasts do to waves")).show(ui, |ui| show_effects(app, ui));
}

/// Adds the button that opens a coast's file.
pub fn show_open_button(app: &App, ui: &mut egui::Ui) {
    let help = tr("Depths and heights: GeoTIFF, NetCDF, ESRI ASCII grid, or text of x, y, z. Dropping works, too.");
    if button_with_help(ui, tr("Open a coast…"), help) {
        app.choose_files();
    }
}

/// Adds a line about each effect, with the named sea that shows it.
fn show_effects(app: &mut App, ui: &mut egui::Ui) {
    for (effect, meaning, sea) in EFFECTS {
        ui.horizontal_wrapped(|ui| {
            ui.strong(tr(effect));
            let Some(preset) = presets::built_in().iter().find(|preset| preset.name == sea) else { return };
            if ui.small_button(tr(sea)).on_hover_text(tr(&preset.about)).clicked() {
                app.open_preset(preset);
            }
        });
        ui.label(tr(meaning));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::Params;

    #[test]
    fn each_effect_has_a_named_sea_with_a_coast() {
        for (effect, _, sea) in EFFECTS {
            let preset = presets::built_in().iter().find(|preset| preset.name == sea).expect(sea);
            assert!(preset.apply(&Params::default()).0.coast.is_on(), "{effect}");
            assert!(preset.about.to_lowercase().contains(&effect.to_lowercase()), "{sea} says nothing of {effect}");
        }
    }
}
