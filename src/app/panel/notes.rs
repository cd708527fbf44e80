//! Notices at the top of the panel: news about opened files, what the plan has changed, warnings and errors.

use super::super::{App, notices};
use super::system_name;
use crate::app::language::{say, tr};
use crate::state::params::{MAX_WAVE_SYSTEMS, SpectrumKind};

/// Colours of warnings and errors.
const WARNING: egui::Color32 = egui::Color32::from_rgb(240, 200, 110);
const ERROR: egui::Color32 = egui::Color32::from_rgb(255, 130, 120);
/// Words that only the notice about a wave system that is off has.
const IS_OFF: &str = " wave system is off: ";

/// Adds the notices.
pub fn show_notices(app: &mut App, ui: &mut egui::Ui) {
    for text in &app.news {
        ui.label(text);
    }
    let missing = app.params.look.sky.missing_file_notice();
    let of_coast = app.coast_notices();
    // Notices of the plan tell how the waves were computed, such as a limit by the depth. They are no warnings, so they
    // have a neutral colour.
    for text in app.derived.plan.notices.iter().filter(|text| !text.contains(IS_OFF)) {
        ui.weak(notices::translate(text));
    }
    if app.derived.plan.notices.iter().any(|text| text.contains(IS_OFF)) {
        show_systems_that_are_off(app, ui);
    }
    for text in app.notices.iter().chain(&missing).chain(&of_coast) {
        ui.colored_label(WARNING, notices::translate(text));
    }
    for text in app.errors() {
        ui.colored_label(ERROR, text);
    }
}

/// Says which wave systems have values of their own but are off, and adds a button for each that switches it on. The
/// notice of the plan names keys of the state string instead, which the command line needs.
fn show_systems_that_are_off(app: &mut App, ui: &mut egui::Ui) {
    // A measured spectrum is the whole sea: the swell of the sea before is no part of it.
    if app.params.sea.first_system().spectrum == SpectrumKind::Measured {
        return;
    }
    let defaults = crate::state::params::Sea::default().systems;
    for index in 1..MAX_WAVE_SYSTEMS {
        let system = &mut app.params.sea.systems[index];
        if system.is_on() || *system == defaults[index] {
            continue;
        }
        ui.horizontal_wrapped(|ui| {
            let name = system_name(index + 1);
            ui.weak(say!("Switched off: {system}.", system = name));
            if ui
                .small_button(say!("Switch on: {system}", system = name))
                .on_hover_text(tr("Its waves come back."))
                .clicked()
            {
                system.height_factor = 1.0;
            }
        });
    }
}
