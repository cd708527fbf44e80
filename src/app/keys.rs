//! Keyboard shortcuts: their table (docs/using.md has it, too), their actions, and the help window with the table.

use super::{App, camera, caption, panel};
use crate::app::language::{text, tr};
use crate::state::params::Interface;
use egui::{Key, Modifiers};

/// Table of the help window: each key or gesture, and what it does.
pub const KEYBOARD_HELP: &[(&str, &str)] = &[
    (text!("drag"), text!("look around; in orbit, turn around the sea in the middle")),
    (text!("wheel, pinch"), text!("zoom; in orbit, come closer")),
    (text!("W A S D, arrows"), text!("fly over the water; with Shift faster")),
    (
        text!("left, right"),
        text!("previous and next sea, while the named seas are shown; or swipe over their pictures"),
    ),
    (text!("Q, E"), text!("sink and rise; from the least height, dive and come up again")),
    (text!("C"), text!("camera: fly, orbit, ride on the water")),
    (text!("Space"), text!("stop and start the time")),
    (text!(". and ,"), text!("one frame forward and back, standing still")),
    (text!("Home"), text!("back to time 0")),
    (text!("B"), text!("put a buoy where the pointer is")),
    (text!("V"), text!("views of spectra, maps and mesh; with Shift backwards; 0 to 4 choose a cascade")),
    (text!("H"), text!("hide and show the panel")),
    (text!("L"), text!("copy the link")),
    (text!("P"), text!("save a picture that remembers its sea")),
    (text!("Ctrl+Z, Ctrl+Y"), text!("undo and redo (Cmd on a Mac)")),
    (text!("F1 or ?"), text!("this list")),
    (text!("Escape"), text!("close this list, or leave a view; in the desktop program then quit")),
];

/// Shows the help window with the keyboard shortcuts while `open` is true. Closing the window sets `open` to false.
pub fn show_keyboard_help(open: &mut bool, ctx: &egui::Context) {
    egui::Window::new(tr("Keys and gestures"))
        .open(open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .max_width(ctx.content_rect().width() - 24.0)
        .max_height(ctx.content_rect().height() - 60.0)
        // High enough to show the whole table without scrolling.
        .default_size([440.0, 510.0])
        .vscroll(true)
        .show(ctx, |ui| {
            egui::Grid::new("keys").num_columns(2).striped(true).spacing([16.0, 6.0]).show(ui, |ui| {
                for (key, does) in KEYBOARD_HELP {
                    ui.strong(tr(key));
                    ui.add(egui::Label::new(tr(does)).wrap());
                    ui.end_row();
                }
            });
            ui.separator();
            ui.label(tr(
                "On a touch screen one finger looks around, two fingers pinch to zoom and move over the water.",
            ));
        });
}

impl App {
    /// Performs the actions of the keys pressed in this frame, unless a text field has the keyboard focus.
    pub(super) fn handle_keys(&mut self, ctx: &egui::Context) {
        if ctx.egui_wants_keyboard_input() {
            return;
        }
        self.undo_keys(ctx);
        let pressed = |key| ctx.input(|i| i.key_pressed(key));
        let plain = |key| ctx.input(|i| i.key_pressed(key) && !i.modifiers.command && !i.modifiers.alt);
        let clock = &mut self.params.clock;
        // A focused widget uses Space and the arrow keys itself.
        let free = ctx.memory(|m| m.focused().is_none());
        if free && pressed(Key::Space) {
            clock.paused = !clock.paused;
        }
        if free && pressed(Key::Home) {
            clock.t_s = 0.0;
        }
        if pressed(Key::Period) {
            panel::time::step_clock(clock, 1.0);
        }
        if pressed(Key::Comma) {
            panel::time::step_clock(clock, -1.0);
        }
        if plain(Key::H) {
            let interface = &mut self.params.screen.interface;
            *interface = if *interface == Interface::Panel { Interface::None } else { Interface::Panel };
        }
        if plain(Key::L) {
            self.copy_link();
        }
        if plain(Key::P) {
            self.save_picture();
        }
        if pressed(Key::F1) || pressed(Key::Questionmark) {
            self.help_is_open = !self.help_is_open;
        }
        let closes_help = self.help_is_open && pressed(Key::Escape);
        if closes_help {
            self.help_is_open = false;
        }
        let ends_hints = !closes_help && self.visitor.first_steps.is_shown() && pressed(Key::Escape);
        if ends_hints {
            self.end_first_steps();
        }
        let uses_escape = closes_help || ends_hints || caption::apply_view_keys(&mut self.params.look.view, ctx);
        if !uses_escape && cfg!(not(target_arch = "wasm32")) && pressed(Key::Escape) {
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        }
        // The arrows either choose a sea or fly, never both.
        let chooses_sea = self.params.screen.interface == Interface::Panel && self.panel.shows_seas(ctx);
        if free && chooses_sea && plain(Key::ArrowRight) {
            self.open_neighbouring_sea(1);
        }
        if free && chooses_sea && plain(Key::ArrowLeft) {
            self.open_neighbouring_sea(-1);
        }
        if free {
            let before = self.params.camera.mode;
            camera::apply_keys_to_camera(&mut self.params.camera, self.params.sea.depth_m, !chooses_sea, ctx);
            if self.params.camera.mode != before {
                self.show_brief_message(camera::mode_in_words(self.params.camera.mode));
            }
        }
    }

    fn undo_keys(&mut self, ctx: &egui::Context) {
        let pressed = |modifiers, key| ctx.input_mut(|i| i.consume_key(modifiers, key));
        if pressed(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z) || pressed(Modifiers::COMMAND, Key::Y) {
            self.history.redo(&mut self.params);
        } else if pressed(Modifiers::COMMAND, Key::Z) {
            self.history.undo(&mut self.params);
        }
    }
}
