//! The panel's tab for sharing a sea: link, picture, film, files, and HTML for other pages.

use super::super::accessible_names::with_accessible_name;
use super::super::film::MAX_FILM_S;
use super::super::opened_files::OPENABLE_FILES;
use super::super::saved_picture::PictureSize;
use super::super::{App, icons};
use super::{button_with_help, text_field};
use crate::app::language::{text, tr};

/// Messages after the copying of a link, and of HTML.
const LINK_MESSAGES: [&str; 2] = [text!("Link copied."), text!("Link copied, with a line about the sea.")];
const EMBEDDING_MESSAGES: [&str; 2] =
    [text!("Frame copied: paste it into a page."), text!("Element copied: paste it into a page.")];

/// The message over the sea, if it is one of `messages`: the panel repeats it beside the buttons that cause it, where
/// the visitor looks.
fn done_in_words(app: &App, messages: &[&str]) -> Option<String> {
    let shown = &app.message.as_ref()?.text;
    messages.iter().any(|message| tr(message) == shown).then(|| shown.clone())
}

/// Adds the widgets of the tab.
pub fn show_share_buttons(app: &mut App, ui: &mut egui::Ui) {
    show_links(app, ui);
    ui.separator();
    show_picture(app, ui);
    ui.separator();
    show_film(app, ui);
    ui.separator();
    ui.strong(tr("Open"));
    show_link_field(app, ui);
    show_open_buttons(app, ui);
    ui.separator();
    show_embedding(app, ui);
}

/// Adds the button that opens files, says what can be opened, and adds two samples to try.
pub fn show_open_buttons(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        if ui.button(tr("Open a file…")).clicked() {
            app.choose_files();
        }
        let help = tr("Waves that a buoy measured: an example of such a file.");
        if button_with_help(ui, tr("Try a spectrum"), help) {
            app.open_sample_spectrum();
        }
        let help = tr("A sky of dusk: an example of a sky from a picture, which links name but do not contain.");
        if button_with_help(ui, tr("Try a sky"), help) {
            app.open_sample_sky();
        }
    });
    ui.weak(tr(OPENABLE_FILES));
}

fn show_links(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        let link = format!("{} {}", icons::LINK, tr("Copy link"));
        let help = tr("Copies the state of this sea and camera (L).");
        if with_accessible_name(ui.button(link).on_hover_text(help), tr("Copy link")).clicked() {
            app.copy_link();
        }
        let help = tr("Copies a line for a message: the sea in words, and its link.");
        if button_with_help(ui, tr("Copy link with words"), help) {
            app.copy_link_with_words();
        }
    });
    // The message takes the place of this line, and no row moves under the pointer.
    let words = egui::RichText::new(format!("\u{201c}{}: …\u{201d}", app.sea_in_words())).weak();
    let done = done_in_words(app, &LINK_MESSAGES).map(|text| egui::RichText::new(text).strong());
    let sizes =
        egui::WidgetText::from(words.clone()).into_galley(ui, None, ui.available_width(), egui::TextStyle::Body);
    ui.scope(|ui| {
        ui.set_min_height(sizes.size().y);
        ui.label(done.unwrap_or(words));
    });
    ui.label(tr("The address of the page is always the whole sea: send it, bookmark it, go back and forward."));
}

/// Adds the field into which a link is pasted to open it.
fn show_link_field(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let hint = (tr("paste an address here"), crate::files::MAX_STATE_BYTES);
        let (field, pressed) =
            text_field(ui, tr("Open link"), &mut app.panel.link, hint, |ui| ui.button(tr("Open")).clicked());
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        if (pressed || entered) && !app.panel.link.trim().is_empty() {
            let link = std::mem::take(&mut app.panel.link);
            app.open_link(&link);
        }
    });
}

fn show_picture(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        let picture = format!("{} {}", icons::PICTURE, tr("Picture"));
        let help = tr("Saves a PNG in full quality that remembers its sea: open it here to return (P).");
        if with_accessible_name(ui.button(picture).on_hover_text(help), tr("Picture")).clicked() {
            app.save_picture();
        }
        let choice = &mut app.panel.picture;
        let size = egui::ComboBox::from_id_salt("picture size").selected_text(choice.size.label()).width(120.0);
        let size = size.show_ui(ui, |ui| {
            for each in PictureSize::ALL {
                ui.selectable_value(&mut choice.size, each, each.label());
            }
        });
        with_accessible_name(size.response, tr("Size of the picture"));
        ui.checkbox(&mut choice.has_caption, tr("Caption")).on_hover_text(tr("The sea in words at the lower edge."));
    });
    ui.weak(tr("Open a picture that was saved here to see its sea again."));
}

fn show_film(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        let repeats = app.params.sea.repeat_period_s > 0.0;
        let mut length_s = app.film_length_s();
        #[cfg(target_arch = "wasm32")]
        {
            let moves = app.params.clock.speed > 0.0;
            let record = ui.add_enabled(moves, egui::Button::new(tr("Record a film")));
            if record.on_hover_text(tr("Records the sea as it moves, without the panel, as a WebM file.")).clicked() {
                app.begin_film();
            }
        }
        #[cfg(not(target_arch = "wasm32"))]
        if button_with_help(ui, tr("Copy film command"), tr("Copies the command that draws the frames of a film.")) {
            app.copy_film_command();
        }
        let editor = egui::DragValue::new(&mut length_s).range(1.0..=MAX_FILM_S).max_decimals(1).suffix(" s");
        let editor = ui.add_enabled(!repeats, editor);
        if with_accessible_name(editor, tr("Length of the film")).changed() {
            app.panel.film_s = Some(length_s);
        }
        if repeats {
            ui.weak(tr("one period: the end fits the beginning"));
        }
    });
    #[cfg(not(target_arch = "wasm32"))]
    ui.weak(tr("seastate render --frames draws each frame of a film, however long it takes."));
}

fn show_embedding(app: &mut App, ui: &mut egui::Ui) {
    ui.strong(tr("In other pages and programs"));
    ui.horizontal_wrapped(|ui| {
        let help = tr("Copies an <iframe> that shows this sea in another page, with a caption instead of the panel.");
        if button_with_help(ui, tr("Copy frame"), help) {
            app.copy_iframe();
        }
        let help = tr("Copies a <sea-state> element: a frame that the page's scripts can set and ask (docs/embed.md).");
        if button_with_help(ui, tr("Copy element"), help) {
            app.copy_element();
        }
        let help = tr(
            "Saves displacement and slopes of every cascade at this moment as one OpenEXR file: docs/use-the-maps.md.",
        );
        if button_with_help(ui, tr("Save maps"), help) {
            app.save_maps();
        }
    });
    if let Some(text) = done_in_words(app, &EMBEDDING_MESSAGES) {
        ui.strong(text);
    }
}
