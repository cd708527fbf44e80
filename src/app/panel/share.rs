//! The panel's tab for sharing a sea: link, picture, frame and maps.

use super::super::accessible_names::with_accessible_name;
use super::super::{App, icons};
use super::{button_with_help, text_field};

/// Adds the widgets of the tab: copy and open a link, save a picture, copy an iframe, save the wave maps.
pub fn show_share_buttons(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        let link = format!("{} Copy link", icons::LINK);
        let help = "Copies the state of this sea and camera (L).";
        if with_accessible_name(ui.button(link).on_hover_text(help), "Copy link").clicked() {
            app.copy_link();
        }
        let picture = format!("{} Picture", icons::PICTURE);
        let help = "Saves a PNG that remembers its sea: drop it here to return (P).";
        if with_accessible_name(ui.button(picture).on_hover_text(help), "Picture").clicked() {
            app.save_picture();
        }
    });
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
