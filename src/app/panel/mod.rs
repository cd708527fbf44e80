//! The panel: the sea in numbers, what it is made of, every parameter of FIELDS, plots, and what went wrong.

mod numbers;
mod rows;
mod seas;
pub mod time;

use super::access::named;
use super::{App, plots};
use crate::state::fields::{FIELDS, Group};
use crate::state::floats::FloatKind;
use crate::state::{Params, query};
use crate::waves::beaufort;

pub use seas::Seas;

/// Below this width the panel is a sheet at the bottom that starts closed: a phone shows the sea first.
const NARROW_POINTS: f32 = 640.0;
/// Smaller than this along a side there is no room for a panel, and its margins would leave less than nothing.
const LEAST_POINTS: f32 = 100.0;
/// Least side of what a finger must hit, points.
const TOUCH_POINTS: f32 = 44.0;

/// Longest text to look for.
const MOST_LETTERS: usize = 100;

/// What the panel itself remembers.
#[derive(Default)]
pub struct Panel {
    /// Words to look for among the parameters.
    search: String,
    /// Link to open.
    link: String,
    /// Whether the sheet of a narrow screen is open.
    sheet_is_open: bool,
    /// Whether the user's and the program's seas keep the seed.
    pub seed_locked: bool,
}

/// Shows the panel over the sea: a window, or on a narrow screen a sheet at its bottom.
pub fn show(app: &mut App, ctx: &egui::Context) {
    let screen = ctx.content_rect();
    if screen.width().min(screen.height()) < LEAST_POINTS {
        return;
    }
    if screen.width() < NARROW_POINTS {
        return sheet(app, ctx, screen);
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
            for_fingers(ui);
        }
        contents(app, ui);
    });
}

/// The panel of a phone. It starts closed, as a line that says what the sea is and opens when it is tapped.
fn sheet(app: &mut App, ctx: &egui::Context, screen: egui::Rect) {
    let area = egui::Area::new(egui::Id::unique("sheet")).anchor(egui::Align2::CENTER_BOTTOM, egui::Vec2::ZERO);
    area.order(egui::Order::Middle).show(ctx, |ui| {
        let margin = egui::Margin { left: 8, right: 8, top: 4, bottom: 8 };
        egui::Frame::window(ui.style()).inner_margin(margin).show(ui, |ui| {
            ui.set_width(screen.width() - 20.0);
            for_fingers(ui);
            let ask = if app.panel.sheet_is_open { "" } else { ": tap to change" };
            let title = egui::Button::new(summary(app) + ask).frame(false);
            let response = ui.add_sized([ui.available_width(), TOUCH_POINTS], title);
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
                // An area is as high as its contents were: without a least height the sheet would never grow.
                let height = 0.5 * screen.height();
                let scroll = egui::ScrollArea::vertical().max_height(height).min_scrolled_height(height);
                scroll.auto_shrink(false).show(ui, |ui| contents(app, ui));
            }
        });
    });
}

/// What a finger can hit.
fn for_fingers(ui: &mut egui::Ui) {
    ui.spacing_mut().interact_size.y = TOUCH_POINTS;
    ui.spacing_mut().icon_width = 22.0;
}

/// The sea in one line.
pub fn summary(app: &App) -> String {
    let metres = super::units::Scale::of("m", app.params.screen.units);
    let wind = app.params.sea.local().wind_m_s;
    let hs = metres.text(app.derived.theory.hs_m, 1);
    format!("Hs {hs}, Beaufort {}", beaufort::number_of(wind))
}

fn contents(app: &mut App, ui: &mut egui::Ui) {
    numbers::show(app, ui);
    seas::wind(app, ui);
    actions(app, ui);
    time::show(app, ui);
    notices(app, ui);
    ui.separator();
    egui::CollapsingHeader::new("Seas").show(ui, |ui| seas::show(app, ui));
    egui::CollapsingHeader::new("Views").show(ui, |ui| views(app, ui));
    egui::CollapsingHeader::new("Afloat").show(ui, |ui| afloat(app, ui));
    egui::CollapsingHeader::new("Plots").show(ui, |ui| plots::show(app, ui));
    egui::CollapsingHeader::new("More numbers").show(ui, |ui| numbers::more(app, ui));
    parameters(app, ui);
    egui::CollapsingHeader::new("Share").show(ui, |ui| share(app, ui));
    egui::CollapsingHeader::new("Time of a frame").show(ui, |ui| numbers::cost(app, ui));
    egui::CollapsingHeader::new("This program").show(ui, |ui| numbers::about(app, ui));
    ui.weak(format!("Seastate {}", crate::ocean::about::VERSION));
}

/// What one reaches for most.
fn actions(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        if ui.button("Copy link").on_hover_text("Copies the state of this sea and camera (L).").clicked() {
            app.copy_link();
        }
        if ui
            .button("Picture")
            .on_hover_text("Saves a PNG that remembers its sea: drop it here to return (P).")
            .clicked()
        {
            app.save_picture();
        }
        let (can_undo, can_redo) = app.history.can();
        if ui.add_enabled(can_undo, egui::Button::new("Undo")).on_hover_text("Ctrl+Z").clicked() {
            app.history.undo(&mut app.params);
        }
        if ui.add_enabled(can_redo, egui::Button::new("Redo")).on_hover_text("Ctrl+Y").clicked() {
            app.history.redo(&mut app.params);
        }
        if ui.button("Reset").on_hover_text("Every value back to its default.").clicked() {
            let seed = app.params.sea.seed;
            app.set_state("");
            if app.panel.seed_locked {
                app.params.sea.seed = seed;
            }
        }
        if named(ui.button("?"), "Keys and gestures").on_hover_text("Keys and gestures (F1)").clicked() {
            app.help = !app.help;
        }
    });
}

fn notices(app: &App, ui: &mut egui::Ui) {
    let missing = app.params.look.sky.missing_file();
    for text in app.notices.iter().chain(&app.derived.plan.notices).chain(&missing) {
        ui.colored_label(egui::Color32::from_rgb(240, 200, 110), text);
    }
    for text in app.errors() {
        ui.colored_label(egui::Color32::from_rgb(255, 130, 120), text);
    }
}

/// Every parameter, by group, or those that a search finds.
fn parameters(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let label = ui.label("Search");
        // From the right: what takes the rest must not push its neighbour out of the panel.
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let clear = ui.add_enabled(!app.panel.search.is_empty(), egui::Button::new("×").small());
            if named(clear, "Clear the search").clicked() {
                app.panel.search.clear();
            }
            let words =
                egui::TextEdit::singleline(&mut app.panel.search).hint_text("all parameters").char_limit(MOST_LETTERS);
            ui.add(words.desired_width(f32::INFINITY)).labelled_by(label.id);
        });
    });
    let words = app.panel.search.trim().to_owned();
    let mut any = false;
    for group in Group::ALL {
        let count = FIELDS.iter().filter(|f| f.group == group && rows::found(f, &words)).count();
        if count == 0 {
            continue;
        }
        any = true;
        // A search opens what it finds; without one each group is as the user left it.
        let searching = !words.is_empty();
        egui::CollapsingHeader::new(group.label()).id_salt((group.label(), searching)).default_open(searching).show(
            ui,
            |ui| {
                rows::group(&mut app.params, group, &words, ui);
                match group {
                    Group::Sky if !searching => sky_file(&mut app.params, ui),
                    Group::Water if !searching => seas::seed(app, ui),
                    _ => {}
                }
            },
        );
    }
    if !any {
        ui.weak("No parameter has these words.");
    }
}

/// The sky's file by name, and the way back to the built sky.
fn sky_file(params: &mut Params, ui: &mut egui::Ui) {
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

/// Places to look from.
fn views(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        for view in super::camera::VIEWS {
            if ui.button(view.name).on_hover_text(view.about).clicked() {
                super::camera::turn_to(&mut app.params, view);
            }
        }
    });
}

/// Buoys and boats.
fn afloat(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        for kind in FloatKind::ALL {
            let on = app.placing == Some(kind);
            let help = "Then click on the sea where it shall be moored.";
            if ui.selectable_label(on, format!("Moor a {}", kind.word())).on_hover_text(help).clicked() {
                app.placing = (!on).then_some(kind);
            }
        }
    });
    let mut lifted = None;
    for (i, float) in app.params.floats.iter().enumerate() {
        ui.horizontal(|ui| {
            let height = app.derived.heights().sample(float.x_m, float.z_m, app.params.clock.t_s).height_m;
            let metres = super::units::Scale::of("m", app.params.screen.units);
            let east = metres.text(float.x_m, 0);
            let south = metres.text(float.z_m, 0);
            ui.label(format!("{} at {east} east, {south} south: {}", float.kind.word(), metres.text(height, 2)));
            let cross = ui.small_button("×").on_hover_text("Lifts it out of the water.");
            if named(cross, &format!("Lift {} {}", float.kind.word(), i + 1)).clicked() {
                lifted = Some(i);
            }
        });
    }
    if let Some(i) = lifted {
        app.params.floats.remove(i);
    }
    if app.params.floats.is_empty() {
        ui.weak("Or press B over the water. The first buoy keeps a record: see the plots.");
    }
}

/// Other ways to pass a sea on.
fn share(app: &mut App, ui: &mut egui::Ui) {
    ui.label("The address of the page is always the whole sea: send it, bookmark it, go back and forward.");
    ui.horizontal(|ui| {
        let label = ui.label("Open link");
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let pressed = ui.button("Open").clicked();
            let field = egui::TextEdit::singleline(&mut app.panel.link).hint_text("paste an address here");
            let field = field.char_limit(query::MAX_BYTES);
            let typed = ui.add(field.desired_width(f32::INFINITY)).labelled_by(label.id);
            let entered = typed.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
            if (pressed || entered) && !app.panel.link.trim().is_empty() {
                let link = std::mem::take(&mut app.panel.link);
                app.open_link(&link);
            }
        });
    });
    if ui
        .button("Copy frame")
        .on_hover_text("Copies an <iframe> that shows this sea in another page, without the panel.")
        .clicked()
    {
        app.copy_frame();
    }
    let maps =
        "Saves displacement and slopes of every cascade at this moment as one OpenEXR file: docs/use-the-maps.md.";
    if ui.button("Save maps").on_hover_text(maps).clicked() {
        app.save_maps();
    }
    ui.weak("Drop a picture that was saved here to see its sea again.");
}
