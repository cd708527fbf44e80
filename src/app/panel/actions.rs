//! The row of buttons of the most frequent actions.

use super::super::accessible_names::with_accessible_name;
use super::super::opened_files::OPENABLE_FILES;
use super::super::{App, icons};
use super::{SHORT_WINDOW_POINTS, is_narrow};
use crate::app::language::tr;

/// Number of the buttons.
const ACTION_COUNT: f32 = 7.0;
/// Distance of the buttons, points: narrow, so that seven of them are wide enough for fingers on a narrow phone.
const ACTION_GAP_POINTS: f32 = 4.0;
/// Size of the symbols, and of the words below them, points.
const SYMBOL_POINTS: f32 = 17.0;
const WORD_POINTS: f32 = 10.5;
/// Height of a button with a word, points.
const HEIGHT_WITH_WORD_POINTS: f32 = 40.0;

/// A button: its symbol, the short word below it, its name, and its tooltip.
struct Action<'a> {
    icon: &'a str,
    word: &'a str,
    name: &'a str,
    help: &'a str,
    enabled: bool,
}

/// Adds the buttons of the most frequent actions: time, undo, redo, reset, another sea, opening a file, and help. Where
/// there is room, words stand below their symbols.
pub fn show_action_buttons(app: &mut App, ui: &mut egui::Ui) {
    let is_narrow = is_narrow(ui.ctx());
    let has_words = ui.ctx().content_rect().height() >= SHORT_WINDOW_POINTS;
    let most = if is_narrow { 80.0 } else { 48.0 };
    let width = ((ui.available_width() - ACTION_GAP_POINTS * (ACTION_COUNT - 1.0)) / ACTION_COUNT).min(most);
    let least = if has_words { HEIGHT_WITH_WORD_POINTS } else { 28.0 };
    let size = egui::vec2(width, ui.spacing().interact_size.y.max(least));
    let press = |ui: &mut egui::Ui, action: Action<'_>| show_action(ui, &action, size, has_words);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = ACTION_GAP_POINTS;
        ui.spacing_mut().button_padding.x = 0.0;
        let clock = &mut app.params.clock;
        let (icon, name) = if clock.paused { (icons::PLAY, tr("Play")) } else { (icons::PAUSE, tr("Pause")) };
        let action = |icon, word, name, help| Action { icon, word, name, help, enabled: true };
        if press(ui, action(icon, name, name, tr("Stops and starts the time (Space)."))) {
            clock.paused = !clock.paused;
        }
        let (can_undo, can_redo) = app.history.can_undo_redo(&app.params);
        let undo = action(icons::UNDO, tr("Undo"), tr("Undo"), tr("Undo (Ctrl+Z)."));
        if press(ui, Action { enabled: can_undo, ..undo }) {
            app.history.undo(&mut app.params);
        }
        let redo = action(icons::REDO, tr("Redo"), tr("Redo"), tr("Redo (Ctrl+Y)."));
        if press(ui, Action { enabled: can_redo, ..redo }) {
            app.history.redo(&mut app.params);
        }
        if press(ui, action(icons::RESET, tr("Reset"), tr("Reset"), tr("Every value back to its default."))) {
            let seed = app.params.sea.seed;
            app.set_state("");
            if app.panel.seed_locked {
                app.params.sea.seed = seed;
            }
        }
        if press(ui, action(icons::SURPRISE, tr("Surprise"), tr("Surprise me"), tr("A random named sea."))) {
            app.open_random_preset();
        }
        if press(ui, action(icons::OPEN, tr("Open"), tr("Open a file"), tr(OPENABLE_FILES))) {
            app.choose_files();
        }
        if press(ui, action(icons::HELP, tr("Help"), tr("Keys and gestures"), tr("Keys and gestures (F1)."))) {
            app.help_is_open = !app.help_is_open;
        }
    });
}

/// Adds a button. Returns whether it was pressed.
fn show_action(ui: &mut egui::Ui, action: &Action<'_>, size: egui::Vec2, has_word: bool) -> bool {
    let symbol = egui::RichText::new(if has_word { "" } else { action.icon }).size(SYMBOL_POINTS);
    let button = egui::Button::new(symbol).frame_when_inactive(false).min_size(size);
    let response = ui.add_enabled(action.enabled, button).on_hover_text(action.help);
    if has_word {
        let colour = ui.style().interact(&response).text_color();
        let colour = if action.enabled { colour } else { colour.gamma_multiply(ui.visuals().disabled_alpha()) };
        let middle = response.rect.center();
        let symbol = egui::FontId::proportional(SYMBOL_POINTS);
        ui.painter().text(middle - egui::vec2(0.0, 7.0), egui::Align2::CENTER_CENTER, action.icon, symbol, colour);
        let word =
            |points| ui.painter().layout_no_wrap(action.word.to_owned(), egui::FontId::proportional(points), colour);
        // A long word of another language is written smaller.
        let usual = word(WORD_POINTS);
        let excess = usual.size().x / size.x;
        let word = if excess > 1.0 { word(WORD_POINTS / excess) } else { usual };
        let at = middle + egui::vec2(-0.5 * word.size().x, 12.0 - 0.5 * word.size().y);
        ui.painter().galley(at, word, colour);
    }
    with_accessible_name(response, action.name).clicked()
}
