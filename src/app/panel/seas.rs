//! The panel's tab of named seas: the built-in ones and the user's own.

use super::super::accessible_names::with_accessible_name;
use super::super::{App, storage, thumbnails};
use super::{button_with_help, touch};
use crate::app::language::{say, tr};
use crate::state::presets::{self, Preset};

/// The user's own named seas, with the state of the widgets that edit the list.
#[derive(Default)]
pub struct OwnSeas {
    seas: Vec<Preset>,
    /// Text of the field for the name under which the current sea will be kept.
    name: String,
    /// Errors found when the stored list of the user's seas was read. If there are any, the list is copied before it is
    /// overwritten.
    stored_list_errors: Vec<String>,
    /// Whether the stored list with errors has already been copied to a second file or storage key.
    damaged_list_is_backed_up: bool,
}

impl OwnSeas {
    /// Loads the user's own named seas from storage.
    pub fn load() -> Self {
        let (seas, stored_list_errors) = presets::read_kept(&storage::load_seas());
        Self { seas, stored_list_errors, ..Self::default() }
    }

    /// Notices about errors in the stored text of the user's own seas.
    pub fn notices(&self) -> Vec<String> {
        self.stored_list_errors.iter().map(|notice| format!("your own seas: {notice}")).collect()
    }

    /// Adds named seas, replaces seas of equal name, and stores the list.
    ///
    /// # Errors
    /// One sentence, if the list cannot be stored.
    pub fn add(&mut self, new: Vec<Preset>) -> Result<(), String> {
        presets::add(&mut self.seas, new)?;
        self.store()
    }

    fn store(&mut self) -> Result<(), String> {
        if !self.stored_list_errors.is_empty() && !self.damaged_list_is_backed_up {
            storage::back_up_damaged_seas()?;
            self.damaged_list_is_backed_up = true;
        }
        storage::store_seas(&presets::write(&self.seas))
    }
}

/// Adds buttons for the built-in and the user's own named seas, and widgets that keep, forget and export the latter.
pub fn show_presets(app: &mut App, ui: &mut egui::Ui) {
    let mut chosen = None;
    let shown = app.shown_sea_name();
    let scrolls = std::mem::take(&mut app.panel.scrolls_to_shown_sea);
    let top = ui.cursor().top();
    for (index, preset) in presets::built_in().iter().enumerate() {
        let picture = app.thumbnails.image(index, ui.ctx());
        // The first sentence says what one sees; the rest and the source are for those who ask.
        let about = tr(&preset.about);
        let says = about
            .split_inclusive(['.', ':', '。', '：'])
            .next()
            .unwrap_or_default()
            .trim_end_matches(['.', ':', '。', '：']);
        let mut job = egui::text::LayoutJob::default();
        let picture_width = if picture.is_some() { thumbnails::SHOWN_SIZE.x + ui.spacing().icon_spacing } else { 0.0 };
        job.wrap.max_width = ui.available_width() - 16.0 - picture_width;
        let format = |points, color| egui::TextFormat {
            font_id: egui::FontId::proportional(points),
            color,
            ..Default::default()
        };
        job.append(&format!("{}\n", tr(&preset.name)), 0.0, format(15.0, ui.visuals().strong_text_color()));
        job.append(says, 0.0, format(12.5, ui.visuals().weak_text_color()));
        let is_shown = shown == Some(preset.name.as_str());
        let card = egui::Button::opt_image_and_text(picture, Some(job.into()));
        let card = card.selected(is_shown).min_size(egui::vec2(ui.available_width(), 0.0));
        let card = ui.add(card).on_hover_text(format!("{about}\n{}", preset.source));
        if is_shown && scrolls {
            card.scroll_to_me(None);
        }
        if with_accessible_name(card, &preset.name).clicked() {
            chosen = Some(preset.clone());
        }
    }
    let cards = ui.min_rect().with_min_y(top);
    if let Some(step) = touch::swiped_sideways(ui, cards) {
        app.open_neighbouring_sea(step);
    }
    let (own, dropped) = show_own_seas(&app.own_seas.seas, ui);
    if let Some(preset) = chosen.or(own) {
        app.open_preset(&preset);
    }
    if let Some(name) = dropped {
        app.own_seas.seas.retain(|p| p.name != name);
        app.run_or_notify(|app| app.own_seas.store());
    }
    ui.separator();
    ui.horizontal(|ui| {
        let label = ui.label(tr("Keep as"));
        let field = egui::TextEdit::singleline(&mut app.own_seas.name).hint_text(tr("name of this sea"));
        let field = field.char_limit(presets::MAX_NAME_CHARS).desired_width(150.0);
        ui.add(field).labelled_by(label.id);
        let name = app.own_seas.name.trim().to_owned();
        if ui.add_enabled(!name.is_empty(), egui::Button::new(tr("Keep"))).clicked() {
            app.own_seas.name.clear();
            let preset = Preset::from_params(&name, &app.params);
            app.run_or_notify(|app| app.own_seas.add(vec![preset]));
        }
        if ui
            .add_enabled(!app.own_seas.seas.is_empty(), egui::Button::new(tr("Export")))
            .on_hover_text(tr("Saves your seas as a text file: drop it on another Seastate to import them."))
            .clicked()
        {
            let text = presets::write(&app.own_seas.seas);
            app.save("seas.txt", text.as_bytes());
        }
    });
    ui.weak(tr("Drop a file of seas here to import it."));
}

/// Adds buttons for the user's own named seas. Returns the sea that the user opens, and the name of the one to forget.
fn show_own_seas(seas: &[Preset], ui: &mut egui::Ui) -> (Option<Preset>, Option<String>) {
    let (mut chosen, mut dropped) = (None, None);
    if seas.is_empty() {
        return (chosen, dropped);
    }
    ui.separator();
    ui.horizontal_wrapped(|ui| {
        for preset in seas {
            if button_with_help(ui, &preset.name, &preset.state) {
                chosen = Some(preset.clone());
            }
            let cross = ui.small_button("×").on_hover_text(tr("Forget this sea."));
            if with_accessible_name(cross, &say!("Forget {name}", name = preset.name)).clicked() {
                dropped = Some(preset.name.clone());
            }
        }
    });
    (chosen, dropped)
}

/// Adds the button that changes the seed of the random wave phases, and the check box that locks the seed.
pub fn show_seed_row(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        if button_with_help(ui, tr("New seed"), tr("Another sea with the same spectrum.")) {
            let old = app.params.sea.seed;
            app.params.sea.seed = crate::waves::noise::pcg4d([old, app.frames as u32, 7, 11])[0] % 100_000;
        }
        ui.checkbox(&mut app.panel.seed_locked, tr("Lock"))
            .on_hover_text(tr("Named seas and Reset leave the seed as it is."));
    });
}

impl App {
    /// Opens a named sea in place of the current one, with its light and foam. Camera, floating objects and seed change
    /// only if its state string sets them, and a locked seed never changes.
    pub(super) fn open_preset(&mut self, preset: &Preset) {
        let seed = self.params.sea.seed;
        let (params, notices) = preset.apply(&self.params);
        self.params = params;
        self.params.look.sky.adopt_loaded_image(self.sky.as_ref());
        (self.notices, self.restarts_foam) = (notices, true);
        self.news.clear();
        if self.panel.seed_locked {
            self.params.sea.seed = seed;
        }
    }

    /// Opens another built-in named sea, with another seed unless that is locked or the sea has one of its own.
    pub(super) fn open_random_preset(&mut self) {
        let [which, seed, ..] = crate::waves::noise::pcg4d([self.params.sea.seed, self.frames as u32, 5, 3]);
        let seas = presets::built_in();
        if !self.panel.seed_locked {
            self.params.sea.seed = seed % 100_000;
        }
        self.open_preset(&seas[which as usize % seas.len()]);
    }

    /// Runs the action `what` on the app, and shows its error, if any, in the notices.
    fn run_or_notify(&mut self, what: impl FnOnce(&mut Self) -> Result<(), String>) {
        if let Err(reason) = what(self) {
            self.notices.push(reason);
        }
    }
}
