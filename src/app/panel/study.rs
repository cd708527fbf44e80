//! The panel's tab of study: read-outs, plots and every parameter.

use super::super::App;
use super::super::accessible_names::with_accessible_name;
use super::super::plots;
use super::{MAX_TEXT_CHARS, coast, numbers, rows, seas, share, spectra, sun, systems, text_field};
use crate::app::language::{say, tr};
use crate::state::fields::{FIELDS, Field, Group};

/// Adds the widgets of the tab.
pub fn show_study(app: &mut App, ui: &mut egui::Ui) {
    numbers::show_main_statistics(app, ui);
    spectra::show_spectrum_list(app, ui);
    egui::CollapsingHeader::new(tr("Spectrum and other plots")).show(ui, |ui| plots::show_all_plots(app, ui));
    egui::CollapsingHeader::new(tr("Open a spectrum or a sky")).show(ui, |ui| share::show_open_buttons(app, ui));
    ui.separator();
    show_parameters(app, ui);
    ui.separator();
    egui::CollapsingHeader::new(tr("More numbers")).show(ui, |ui| numbers::show_all_statistics(app, ui));
    let is_asked_for = std::mem::take(&mut app.panel.shows_frame_times);
    let header = egui::CollapsingHeader::new(tr("Time of a frame")).open(is_asked_for.then_some(true));
    let frame_times = header.show(ui, |ui| numbers::show_frame_times(app, ui));
    if is_asked_for {
        frame_times.header_response.scroll_to_me(Some(egui::Align::TOP));
    }
    egui::CollapsingHeader::new(tr("This program")).show(ui, |ui| numbers::show_system_information(app, ui));
    ui.weak(format!("Seastate {}", crate::ocean::device_info::VERSION));
}

/// Adds widgets for all parameters, group by group, or for those that match the text in the search field.
fn show_parameters(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let search = &mut app.panel.search;
        let searching = !search.is_empty();
        let (_, clears) = text_field(ui, tr("Search"), search, (tr("all parameters"), MAX_TEXT_CHARS), |ui| {
            let clear = egui::Button::new(egui::RichText::new("×").size(17.0))
                .min_size(egui::Vec2::splat(ui.spacing().interact_size.y.max(24.0)));
            with_accessible_name(ui.add_enabled(searching, clear), tr("Clear the search")).clicked()
        });
        if clears {
            search.clear();
        }
    });
    let words = app.panel.search.trim().to_owned();
    let searching = !words.is_empty();
    let added = app.panel.added_system.take();
    let seas = if searching { App::seas_with_words(&words) } else { Vec::new() };
    let mut any = !seas.is_empty();
    for sea in seas {
        if ui.button(say!("Sea: {name}", name = tr(&sea.name))).on_hover_text(tr(&sea.about)).clicked() {
            app.open_preset(sea);
        }
    }
    for group in Group::ALL {
        if group == Group::Water && !searching {
            systems::show_add_button(app, ui);
        }
        let in_use = systems::is_in_use(&app.params, group);
        let shown = |f: &&Field| {
            f.group == group && rows::matches_search(f, &words) && (in_use || systems::is_asked_for(f, &words))
        };
        let fields: Vec<&'static Field> = FIELDS.iter().filter(shown).collect();
        if fields.is_empty() {
            continue;
        }
        any = true;
        // A search expands the groups with results. Without a search each group stays as the user left it.
        let header = egui::CollapsingHeader::new(tr(group.label())).id_salt((group.label(), searching));
        let expand = (added == Some(group)).then_some(true);
        header.default_open(searching).open(expand).show(ui, |ui| {
            let coast = app.params.coast.name;
            rows::show_group(&mut app.params, group, &fields, ui);
            // A coast comes with the depth of its edge and a camera before its shore.
            let chosen = app.params.coast.name;
            if chosen != coast {
                app.params.coast.name = coast;
                app.choose_coast(chosen);
            }
            match group {
                Group::Sky if !searching => {
                    sun::show_rise_and_set(&app.params, ui);
                    show_sky_file(app, ui);
                }
                Group::Water if !searching => seas::show_seed_row(app, ui),
                Group::Coast if !searching => coast::show_open_button(app, ui),
                _ if !searching => systems::show_remove_button(&mut app.params, group, ui),
                _ => {}
            }
        });
    }
    if !any {
        ui.weak(tr("No parameter and no named sea has these words."));
    }
}

/// Shows the name of the sky image file, and a button that returns to the computed sky.
fn show_sky_file(app: &mut App, ui: &mut egui::Ui) {
    let Some(file) = &app.params.look.sky.file else {
        if ui.button(tr("Open a sky…")).on_hover_text(tr("A .hdr or .exr file with the whole sky.")).clicked() {
            app.choose_files();
        }
        return;
    };
    let name = file.name.clone();
    ui.horizontal(|ui| {
        ui.label(name);
        if ui.small_button("×").on_hover_text(tr("Back to the computed sky.")).clicked() {
            app.params.look.sky.file = None;
        }
    });
}
