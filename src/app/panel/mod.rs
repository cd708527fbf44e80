//! The panel over the sea: tabs of named seas, weather, view, study and sharing. A wide window shows it at the right; a
//! narrow one has a bar of tabs at the bottom, with a sheet above it.

mod actions;
mod chosen;
mod coast;
mod coast_map;
mod gauges;
mod handle;
mod notes;
mod numbers;
mod place;
mod rows;
mod seas;
mod share;
mod sheet;
mod spectra;
mod study;
mod summary;
mod sun;
mod systems;
pub mod time;
pub mod touch;
mod view;
mod weather;
mod wind;

use super::accessible_names::with_accessible_name;
use super::saved_picture::PictureChoice;
use super::{App, icons};
use crate::app::language::tr;
use crate::files::measured::{MeasuredSpectrum, SpectrumList};
use crate::state::fields::Group;
use std::sync::Arc;

use actions::show_action_buttons;
use notes::show_notices;
pub use place::{Place, free_part};
pub use seas::OwnSeas;
pub use sheet::show_bottom_sheet;
#[cfg(target_arch = "wasm32")]
pub use summary::sea_summary;
pub use summary::{show_summary, system_name};

/// Width of the window, points, below which the panel is a sheet at the bottom of the window.
const NARROW_WINDOW_POINTS: f32 = 640.0;
/// Shorter side of the window, points, below which the panel is not shown, because its margins would leave no room.
const MIN_WINDOW_SIDE_FOR_PANEL_POINTS: f32 = 100.0;
/// Least height of a widget on a touch screen, points.
pub const TOUCH_TARGET_POINTS: f32 = 44.0;
/// Width of the panel's contents in a wide window, points.
const PANEL_WIDTH_POINTS: f32 = 366.0;
/// Height of a tab's button, points.
const TAB_HEIGHT_POINTS: f32 = 52.0;
/// Height of the window, points, below which all of the panel but its tabs scrolls, as on a phone that lies on its
/// side.
const SHORT_WINDOW_POINTS: f32 = 480.0;
/// Least height of the part of the panel that scrolls, points.
const MIN_SCROLL_POINTS: f32 = 40.0;
/// Largest number of characters that the panel's search field accepts.
const MAX_TEXT_CHARS: usize = 100;

/// A tab of the panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
enum Tab {
    Seas,
    #[default]
    Weather,
    View,
    Study,
    Share,
}

impl Tab {
    const ALL: [Self; 5] = [Self::Seas, Self::Weather, Self::View, Self::Study, Self::Share];

    fn icon_and_label(self) -> (&'static str, &'static str) {
        match self {
            Self::Seas => (icons::SEAS, tr("Seas")),
            Self::Weather => (icons::WEATHER, tr("Weather")),
            Self::View => (icons::VIEW, tr("View")),
            Self::Study => (icons::STUDY, tr("Study")),
            Self::Share => (icons::SHARE, tr("Share")),
        }
    }

    fn help(self) -> &'static str {
        match self {
            Self::Seas => tr("Named seas, and your own."),
            Self::Weather => tr("Wind, swell, sun, clouds, depth and coast."),
            Self::View => tr("Camera, time, and what floats."),
            Self::Study => tr("Every number, plot and parameter."),
            Self::Share => tr("Link, picture, frame for a page."),
        }
    }
}

/// State of the panel that is not part of the parameters.
#[derive(Default)]
pub struct Panel {
    /// The open tab; `None` before the user has chosen one, or if all are closed.
    tab: Option<Tab>,
    /// Whether the user has opened or closed a tab. Before, a wide window shows the weather and a narrow one no tab.
    tab_was_chosen: bool,
    /// Text in the panel's search field, which selects the shown parameters; empty to show all.
    search: String,
    /// Text in the field into which the user types or pastes a link to open.
    link: String,
    /// The named sea that is shown, see [`App::shown_sea_name`](super::App::shown_sea_name).
    shown_sea: chosen::ShownSea,
    /// Whether the next frame scrolls the list of named seas to the one that is shown.
    scrolls_to_shown_sea: bool,
    /// Places of the tabs' buttons in the last frame, in the order of [`Tab::ALL`].
    tab_places: [Option<egui::Rect>; Tab::ALL.len()],
    /// How pictures are saved.
    pub picture: PictureChoice,
    /// Length of a film, s, if the user has chosen one.
    pub film_s: Option<f64>,
    /// Wave system that has just been switched on, whose section the next frame expands.
    added_system: Option<Group>,
    /// Whether the seed of the random phases stays the same when a named sea is opened or everything is reset.
    pub seed_locked: bool,
    /// Spectra of the file that was opened last, if it holds several; `None` if it does not or the list was closed.
    spectra: Option<SpectrumList>,
    /// The picture of the map of the coast, once it was shown.
    coast_map: Option<coast_map::MapPicture>,
    /// The sheet of a narrow window.
    pub sheet: sheet::Sheet,
    /// Distance by which the panel of a wide window has been dragged away from its edge, points; 0 at rest.
    dragged_points: f32,
    /// Whether the next frame shows the times of a frame in the tab of study.
    shows_frame_times: bool,
    /// Whether the visitor has asked for the line about frames over the sea of a narrow window.
    shows_frame_line: bool,
    /// Whether the last frame showed the sea in words over the sea.
    summary_is_shown: bool,
    /// The spectrum that was opened from a file, and its title: whence and when.
    spectrum_title: Option<(Arc<MeasuredSpectrum>, String)>,
    /// The part of the window in which the sea was drawn last, points.
    pub sea: Option<egui::Rect>,
}

impl Panel {
    fn open_tab(&self, is_narrow: bool) -> Option<Tab> {
        if self.tab_was_chosen { self.tab } else { (!is_narrow).then_some(Tab::Weather) }
    }

    /// Whether the named seas are shown; the arrow keys then choose among them.
    pub fn shows_seas(&self, ctx: &egui::Context) -> bool {
        has_room(ctx) && self.open_tab(is_narrow(ctx)) == Some(Tab::Seas)
    }

    /// Whether the tab with the link and the pictures is open.
    pub fn shows_sharing(&self, ctx: &egui::Context) -> bool {
        self.open_tab(is_narrow(ctx)) == Some(Tab::Share)
    }

    /// Place of the button of the tab of named seas in the window; `None` before the first frame of the panel.
    pub fn seas_tab(&self) -> Option<egui::Rect> {
        self.tab_places[Tab::Seas as usize]
    }

    /// Place of the button of the tab of the weather.
    pub fn weather_tab(&self) -> Option<egui::Rect> {
        self.tab_places[Tab::Weather as usize]
    }

    /// Place of the button of the tab of sharing.
    pub fn share_tab(&self) -> Option<egui::Rect> {
        self.tab_places[Tab::Share as usize]
    }

    /// Opens a tab.
    fn open(&mut self, tab: Tab) {
        (self.tab, self.tab_was_chosen) = (Some(tab), true);
    }

    /// Closes the open tab.
    fn close(&mut self) {
        (self.tab, self.tab_was_chosen) = (None, true);
    }
}

/// Whether the window is so narrow that the panel is a sheet at its bottom.
fn is_narrow(ctx: &egui::Context) -> bool {
    ctx.content_rect().width() < NARROW_WINDOW_POINTS
}

/// The part of `sea` that the panel of a wide window leaves free, at the larger side of the panel.
pub fn part_beside_panel(sea: egui::Rect, ctx: &egui::Context) -> egui::Rect {
    let panel = ctx.memory(|m| m.area_rect(egui::Id::unique("panel"))).filter(|_| !is_narrow(ctx));
    match panel {
        Some(panel) if panel.center().x > sea.center().x => sea.with_max_x(panel.left()),
        Some(panel) => sea.with_min_x(panel.right()),
        None => sea,
    }
}

/// Whether the window has room for the panel.
fn has_room(ctx: &egui::Context) -> bool {
    ctx.content_rect().size().min_elem() >= MIN_WINDOW_SIDE_FOR_PANEL_POINTS
}

/// Shows the panel of a wide window over the sea.
pub fn show_panel(app: &mut App, ctx: &egui::Context) {
    if is_narrow(ctx) || !has_room(ctx) {
        return;
    }
    let screen = ctx.content_rect();
    let place = app.visitor.preferences.panel.clone();
    let window = egui::Window::new(tr("Seastate"))
        .id(egui::Id::unique("panel"))
        .title_bar(false)
        .auto_sized()
        .anchor(place.corner(), egui::vec2(app.panel.dragged_points, 0.0))
        .constrain_to(screen.shrink(place::MARGIN_POINTS));
    touch::note(ctx);
    let width = place.width(screen.width());
    window.show(ctx, |ui| {
        ui.set_width(width);
        if touch::is_used(ctx) {
            enlarge_for_touch(ui);
        }
        place::show_grip(app, ui);
        show_tabs(app, ui);
        let tab = app.panel.open_tab(false);
        let is_short = screen.height() < SHORT_WINDOW_POINTS;
        if tab.is_some() && !is_short {
            show_action_buttons(app, ui);
        }
        let frame = ui.style().spacing.window_margin.bottomf();
        let height = screen.bottom() - place::MARGIN_POINTS - frame - ui.cursor().top();
        // Rows wider than the panel scroll sideways: it keeps its width, so that no row moves away from the pointer.
        // Each tab stays where it was scrolled to.
        let scroll = egui::ScrollArea::both().id_salt(tab).max_height(height.max(MIN_SCROLL_POINTS));
        let scroll = scroll.auto_shrink([false, true]);
        scroll.show(ui, |ui| {
            // Room for the scroll bar, whether it is shown or not: the rows do not move when it appears.
            ui.set_max_width(width - 14.0);
            if tab.is_some() && is_short {
                show_action_buttons(app, ui);
            }
            show_notices(app, ui);
            if let Some(tab) = tab {
                show_tab(app, tab, ui);
            }
        });
        place::show_edge(app, ui);
    });
}

/// Adds a button for each tab. A click on the open tab closes it.
fn show_tabs(app: &mut App, ui: &mut egui::Ui) {
    let is_narrow = is_narrow(ui.ctx());
    let open = app.panel.open_tab(is_narrow);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let count = Tab::ALL.len() as f32;
        let size = egui::vec2((ui.available_width() - 4.0 * (count - 1.0)) / count, TAB_HEIGHT_POINTS);
        for tab in Tab::ALL {
            let (_, label) = tab.icon_and_label();
            let is_open = open == Some(tab);
            let button = tab_button(ui, tab, is_open, size).on_hover_text(tab.help());
            app.panel.tab_places[tab as usize] = Some(button.rect);
            if with_accessible_name(button, label).clicked() {
                (app.panel.tab, app.panel.tab_was_chosen) = ((!is_open).then_some(tab), true);
            }
        }
    });
}

/// Adds a button with the tab's symbol above its name.
fn tab_button(ui: &mut egui::Ui, tab: Tab, is_open: bool, size: egui::Vec2) -> egui::Response {
    let (icon, label) = tab.icon_and_label();
    let response = ui.add_sized(size, egui::Button::selectable(is_open, ""));
    let colour = ui.style().interact_selectable(&response, is_open).text_color();
    let middle = response.rect.center();
    for (text, points, down) in [(icon, 20.0, -9.0), (label, 12.5, 14.0)] {
        let (at, font) = (middle + egui::vec2(0.0, down), egui::FontId::proportional(points));
        ui.painter().text(at, egui::Align2::CENTER_CENTER, text, font, colour);
    }
    response
}

fn show_tab(app: &mut App, tab: Tab, ui: &mut egui::Ui) {
    match tab {
        Tab::Seas => seas::show_presets(app, ui),
        Tab::Weather => weather::show_weather(app, ui),
        Tab::View => view::show_view(app, ui),
        Tab::Study => study::show_study(app, ui),
        Tab::Share => share::show_share_buttons(app, ui),
    }
}

/// Makes the widgets that are later added to `ui` high enough for fingers on a touch screen.
fn enlarge_for_touch(ui: &mut egui::Ui) {
    ui.spacing_mut().interact_size.y = TOUCH_TARGET_POINTS;
    ui.spacing_mut().icon_width = 22.0;
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
        let field = field.align(egui::Align2::LEFT_CENTER);
        (ui.add(field.desired_width(f32::INFINITY)).labelled_by(label.id), right)
    })
    .inner
}
