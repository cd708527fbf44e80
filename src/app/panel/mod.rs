//! The panel: read-outs, named seas, widgets for all parameters, plots, notices and errors.

mod numbers;
mod rows;
mod seas;
mod spectra;
mod systems;
pub mod time;

use super::accessible_names::with_accessible_name;
use super::{App, plots};
use crate::files::measured::SpectrumList;
use crate::state::fields::{FIELDS, Field, Group};
use crate::state::floats::FloatingObjectKind;
use crate::state::{Params, motion};
use crate::waves::beaufort;

pub use seas::OwnSeas;

/// Width of the window, points, below which the panel is a collapsible sheet at the bottom of the window.
const NARROW_WINDOW_POINTS: f32 = 640.0;
/// Shorter side of the window, points, below which the panel is not shown, because its margins would leave no room.
const MIN_WINDOW_SIDE_FOR_PANEL_POINTS: f32 = 100.0;
/// Least height of a widget on a touch screen, points.
const TOUCH_TARGET_POINTS: f32 = 44.0;

/// Largest number of characters that the panel's search field accepts.
const MAX_TEXT_CHARS: usize = 100;

/// State of the panel that is not part of the parameters.
#[derive(Default)]
pub struct Panel {
    /// Text in the panel's search field, which selects the shown parameters; empty to show all.
    search: String,
    /// Text in the field into which the user types or pastes a link to open.
    link: String,
    /// Wave system that has just been switched on, whose section the next frame expands.
    added_system: Option<Group>,
    /// Whether the bottom sheet, which a narrow window shows in place of the panel, is expanded.
    sheet_is_open: bool,
    /// Whether the seed of the random phases stays the same when a named sea is opened or everything is reset.
    pub seed_locked: bool,
    /// Spectra of the file that was opened last, if it holds several; `None` if it does not or the list was closed.
    spectra: Option<SpectrumList>,
}

/// Shows the panel over the sea: as a floating window, or in a narrow window as a sheet at the bottom.
pub fn show_panel(app: &mut App, ctx: &egui::Context) {
    let screen = ctx.content_rect();
    if screen.width().min(screen.height()) < MIN_WINDOW_SIDE_FOR_PANEL_POINTS {
        return;
    }
    if screen.width() < NARROW_WINDOW_POINTS {
        return show_bottom_sheet(app, ctx, screen);
    }
    let window = egui::Window::new("Seastate")
        .id(egui::Id::unique("panel"))
        .vscroll(true)
        .default_pos(screen.right_top() + egui::vec2(-366.0, 12.0))
        .default_width(346.0)
        .default_height(screen.height() - 60.0)
        .max_height(screen.height() - 60.0);
    window.show(ctx, |ui| {
        if ctx.input(|i| i.any_touches()) {
            enlarge_for_touch(ui);
        }
        show_contents(app, ui);
    });
}

/// Shows the panel of a narrow window: a summary of the sea in one line, which expands and collapses the rest.
fn show_bottom_sheet(app: &mut App, ctx: &egui::Context, screen: egui::Rect) {
    let area = egui::Area::new(egui::Id::unique("sheet")).anchor(egui::Align2::CENTER_BOTTOM, egui::Vec2::ZERO);
    area.order(egui::Order::Middle).show(ctx, |ui| {
        let margin = egui::Margin { left: 8, right: 8, top: 4, bottom: 8 };
        egui::Frame::window(ui.style()).inner_margin(margin).show(ui, |ui| {
            ui.set_width(screen.width() - 20.0);
            enlarge_for_touch(ui);
            let ask = if app.panel.sheet_is_open { "" } else { ": tap to change" };
            let title = egui::Button::new(sea_summary(app) + ask).frame(false);
            let response = ui.add_sized([ui.available_width(), TOUCH_TARGET_POINTS], title);
            let icon = response.clone().with_new_rect(egui::Rect::from_center_size(
                response.rect.left_center() + egui::vec2(12.0, 0.0),
                egui::Vec2::splat(18.0),
            ));
            let openness = if app.panel.sheet_is_open { 1.0 } else { 0.0 };
            egui::collapsing_header::paint_default_icon(ui, openness, &icon);
            if response.clicked() {
                app.panel.sheet_is_open = !app.panel.sheet_is_open;
            }
            if app.panel.sheet_is_open {
                // An area takes the height of its last contents. Without a minimum height the sheet would never grow.
                let height = 0.5 * screen.height();
                let scroll = egui::ScrollArea::vertical().max_height(height).min_scrolled_height(height);
                scroll.auto_shrink(false).show(ui, |ui| show_contents(app, ui));
            }
        });
    });
}

/// Makes the widgets that are later added to `ui` high enough for fingers on a touch screen.
fn enlarge_for_touch(ui: &mut egui::Ui) {
    ui.spacing_mut().interact_size.y = TOUCH_TARGET_POINTS;
    ui.spacing_mut().icon_width = 22.0;
}

/// One line about the sea, such as `Hs 2.4 m, Beaufort 5`: significant wave height and Beaufort number.
pub fn sea_summary(app: &App) -> String {
    let hs = app.length_scale().format(app.derived.theoretical_statistics.hs_m, 1);
    format!("Hs {hs}, Beaufort {}", beaufort::beaufort_number(app.params.sea.first_system().wind_m_s))
}

/// Adds a button with the text `label` and the tooltip `help`. Returns whether it was clicked.
fn button_with_help(ui: &mut egui::Ui, label: &str, help: &str) -> bool {
    ui.button(label).on_hover_text(help).clicked()
}

/// Adds `label` and a field for `text` that fills the line, except for the widgets that `right` adds at its right end.
/// Returns the field's response and the result of `right`.
fn text_field<T>(
    ui: &mut egui::Ui,
    label: &str,
    text: &mut String,
    (hint, most_letters): (&str, usize),
    right: impl FnOnce(&mut egui::Ui) -> T,
) -> (egui::Response, T) {
    let label = ui.label(label);
    // The layout runs from right to left, so that the field takes only the space that the widgets leave.
    let layout = egui::Layout::right_to_left(egui::Align::Center);
    ui.with_layout(layout, |ui| {
        let right = right(ui);
        let field = egui::TextEdit::singleline(text).hint_text(hint).char_limit(most_letters);
        (ui.add(field.desired_width(f32::INFINITY)).labelled_by(label.id), right)
    })
    .inner
}

fn show_contents(app: &mut App, ui: &mut egui::Ui) {
    numbers::show_main_statistics(app, ui);
    seas::show_wind_slider(app, ui);
    show_action_buttons(app, ui);
    time::show_time_controls(app, ui);
    spectra::show_spectrum_list(app, ui);
    show_notices(app, ui);
    ui.separator();
    egui::CollapsingHeader::new("Seas").show(ui, |ui| seas::show_presets(app, ui));
    egui::CollapsingHeader::new("Views").show(ui, |ui| show_camera_views(app, ui));
    egui::CollapsingHeader::new("Afloat").show(ui, |ui| show_floating_objects(app, ui));
    egui::CollapsingHeader::new("Plots").show(ui, |ui| plots::show_all_plots(app, ui));
    egui::CollapsingHeader::new("More numbers").show(ui, |ui| numbers::show_all_statistics(app, ui));
    show_parameters(app, ui);
    egui::CollapsingHeader::new("Share").show(ui, |ui| show_share_buttons(app, ui));
    egui::CollapsingHeader::new("Time of a frame").show(ui, |ui| numbers::show_frame_times(app, ui));
    egui::CollapsingHeader::new("This program").show(ui, |ui| numbers::show_system_information(app, ui));
    ui.weak(format!("Seastate {}", crate::ocean::device_info::VERSION));
}

/// Adds the buttons for the most frequent actions: link, picture, undo, redo, reset and help.
fn show_action_buttons(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        if button_with_help(ui, "Copy link", "Copies the state of this sea and camera (L).") {
            app.copy_link();
        }
        if button_with_help(ui, "Picture", "Saves a PNG that remembers its sea: drop it here to return (P).") {
            app.save_picture();
        }
        let (can_undo, can_redo) = app.history.can_undo_redo(&app.params);
        if ui.add_enabled(can_undo, egui::Button::new("Undo")).on_hover_text("Ctrl+Z").clicked() {
            app.history.undo(&mut app.params);
        }
        if ui.add_enabled(can_redo, egui::Button::new("Redo")).on_hover_text("Ctrl+Y").clicked() {
            app.history.redo(&mut app.params);
        }
        if button_with_help(ui, "Reset", "Every value back to its default.") {
            let seed = app.params.sea.seed;
            app.set_state("");
            if app.panel.seed_locked {
                app.params.sea.seed = seed;
            }
        }
        if with_accessible_name(ui.button("?"), "Keys and gestures").on_hover_text("Keys and gestures (F1)").clicked() {
            app.help_is_open = !app.help_is_open;
        }
    });
}

fn show_notices(app: &App, ui: &mut egui::Ui) {
    let missing = app.params.look.sky.missing_file_notice();
    for text in app.notices.iter().chain(&app.derived.plan.notices).chain(&missing) {
        ui.colored_label(egui::Color32::from_rgb(240, 200, 110), text);
    }
    for text in app.errors() {
        ui.colored_label(egui::Color32::from_rgb(255, 130, 120), text);
    }
}

/// Adds widgets for all parameters, group by group, or for those that match the text in the search field.
fn show_parameters(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let search = &mut app.panel.search;
        let searching = !search.is_empty();
        let (_, clears) = text_field(ui, "Search", search, ("all parameters", MAX_TEXT_CHARS), |ui| {
            with_accessible_name(ui.add_enabled(searching, egui::Button::new("×").small()), "Clear the search")
                .clicked()
        });
        if clears {
            search.clear();
        }
    });
    let words = app.panel.search.trim().to_owned();
    let searching = !words.is_empty();
    let added = app.panel.added_system.take();
    let mut any = false;
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
        let header = egui::CollapsingHeader::new(group.label()).id_salt((group.label(), searching));
        let expand = (added == Some(group)).then_some(true);
        header.default_open(searching).open(expand).show(ui, |ui| {
            rows::show_group(&mut app.params, group, &fields, ui);
            match group {
                Group::Sky if !searching => show_sky_file(&mut app.params, ui),
                Group::Water if !searching => seas::show_seed_row(app, ui),
                _ if !searching => systems::show_remove_button(&mut app.params, group, ui),
                _ => {}
            }
        });
    }
    if !any {
        ui.weak("No parameter has these words.");
    }
}

/// Shows the name of the sky image file, and a button that returns to the computed sky.
fn show_sky_file(params: &mut Params, ui: &mut egui::Ui) {
    let Some(file) = &params.look.sky.file else {
        ui.weak("Drop a .hdr or .exr file for another sky.");
        return;
    };
    let name = file.name.clone();
    ui.horizontal(|ui| {
        ui.label(name);
        if ui.small_button("×").on_hover_text("Back to the built sky.").clicked() {
            params.look.sky.file = None;
        }
    });
}

/// Adds a button for each named view of the camera.
fn show_camera_views(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        for view in motion::CAMERA_VIEWS {
            if button_with_help(ui, view.name, view.about) {
                motion::set_named_view(&mut app.params, view);
            }
        }
    });
}

/// Adds the widgets that place, list and remove floating objects.
fn show_floating_objects(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        for kind in FloatingObjectKind::ALL {
            let on = app.placing == Some(kind);
            let help = "Then click on the sea where it shall be moored.";
            if ui.selectable_label(on, format!("Moor a {}", kind.word())).on_hover_text(help).clicked() {
                app.placing = (!on).then_some(kind);
            }
        }
    });
    let mut lifted = None;
    for (i, float) in app.params.floating_objects.iter().enumerate() {
        ui.horizontal(|ui| {
            let height = app.derived.strongest_waves().sample(float.x_m, float.z_m, app.params.clock.t_s).height_m;
            let metres = app.length_scale();
            let [east, south] = [float.x_m, float.z_m].map(|x| metres.format(x, 0));
            ui.label(format!("{} at {east} east, {south} south: {}", float.kind.word(), metres.format(height, 2)));
            let cross = ui.small_button("×").on_hover_text("Lifts it out of the water.");
            if with_accessible_name(cross, &format!("Lift {} {}", float.kind.word(), i + 1)).clicked() {
                lifted = Some(i);
            }
        });
    }
    if let Some(i) = lifted {
        app.params.floating_objects.remove(i);
    }
    if app.params.floating_objects.is_empty() {
        ui.weak("Or press B over the water. The first floating object keeps a record of the height: see the plots.");
    }
}

/// Adds the widgets for sharing a sea: open a link, copy an iframe, save the wave maps.
fn show_share_buttons(app: &mut App, ui: &mut egui::Ui) {
    ui.label("The address of the page is always the whole sea: send it, bookmark it, go back and forward.");
    ui.horizontal(|ui| {
        let hint = ("paste an address here", crate::files::MAX_STATE_BYTES);
        let (field, pressed) = text_field(ui, "Open link", &mut app.panel.link, hint, |ui| ui.button("Open").clicked());
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        if (pressed || entered) && !app.panel.link.trim().is_empty() {
            let link = std::mem::take(&mut app.panel.link);
            app.open_link(&link);
        }
    });
    if button_with_help(ui, "Copy frame", "Copies an <iframe> that shows this sea in another page, without the panel.")
    {
        app.copy_iframe();
    }
    let maps =
        "Saves displacement and slopes of every cascade at this moment as one OpenEXR file: docs/use-the-maps.md.";
    if button_with_help(ui, "Save maps", maps) {
        app.save_maps();
    }
    ui.weak("Drop a picture that was saved here to see its sea again.");
}
