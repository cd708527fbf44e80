//! The keyboard: what a key does, in one table for the help; docs/using.md lists it too.

/// Keys and what they do.
pub const KEYS: &[(&str, &str)] = &[
    ("drag", "look around; in orbit, turn around the sea in the middle"),
    ("wheel, pinch", "zoom; in orbit, come closer"),
    ("W A S D, arrows", "fly over the water; with Shift faster"),
    ("Q, E", "sink and rise"),
    ("C", "camera: fly, orbit, ride on the water"),
    ("Space", "stop and start the time"),
    (". and ,", "one frame forward and back, standing still"),
    ("Home", "back to time 0"),
    ("B", "put a buoy where the pointer is"),
    ("V", "views of spectra, maps and mesh; with Shift backwards; 0 to 4 choose a cascade"),
    ("H", "hide and show the panel"),
    ("L", "copy the link"),
    ("P", "save a picture that remembers its sea"),
    ("Ctrl+Z, Ctrl+Y", "undo and redo (Cmd on a Mac)"),
    ("F1 or ?", "this list"),
    ("Escape", "close this list, leave a view; then close the window"),
];

/// The list of keys, in a window of its own; `open` is cleared when it is closed.
pub fn help(open: &mut bool, ctx: &egui::Context) {
    egui::Window::new("Keys and gestures")
        .open(open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .max_width(ctx.content_rect().width() - 24.0)
        .max_height(ctx.content_rect().height() - 60.0)
        // All keys at once, where there is room for them.
        .default_size([440.0, 510.0])
        .vscroll(true)
        .show(ctx, |ui| {
            egui::Grid::new("keys").num_columns(2).striped(true).spacing([16.0, 6.0]).show(ui, |ui| {
                for (key, does) in KEYS {
                    ui.strong(*key);
                    ui.add(egui::Label::new(*does).wrap());
                    ui.end_row();
                }
            });
            ui.separator();
            ui.label("On a touch screen one finger looks around, two fingers pinch to zoom and move over the water.");
        });
}
