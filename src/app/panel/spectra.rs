//! The list of spectra in an opened file that holds several times or places.

use super::super::App;
use super::super::accessible_names::with_accessible_name;
use super::Tab;
use crate::app::language::{local_number, say, tr};
use crate::files::measured::SpectrumList;
use std::sync::Arc;

/// Greatest height of the list, points.
const LIST_HEIGHT_POINTS: f32 = 110.0;

impl App {
    /// Uses the default spectrum of an opened file. If the file holds several, the panel offers the others.
    pub(in crate::app) fn use_spectra(&mut self, list: SpectrumList) {
        let (count, used) = (list.records.len(), list.default_index);
        let spectrum = list.records[used].spectrum.clone();
        let (title, bands) = (list.title(used), spectrum.bands().len());
        let height = local_number(format!("{:.2}", spectrum.hs_m()));
        let details = match spectrum.directional_table().map(|table| table.direction_count()) {
            Some(directions) => say!(
                "{title}: {bands} bands x {directions} directions, Hs {height} m",
                title = title,
                bands = bands,
                directions = directions,
                height = height
            ),
            None => say!("{title}: {bands} bands, Hs {height} m", title = title, bands = bands, height = height),
        };
        self.tell_opened(&self.waves_of_file(&list.name, spectrum.hs_m()), details);
        self.notices = list.notices.iter().chain(&list.records[used].notices).cloned().collect();
        let title = list.title(used);
        self.params.sea.set_measured_spectrum(spectrum);
        self.remember_title(title);
        // A buoy measures all waves of its sea. Others would come on top.
        for system in &mut self.params.sea.systems[1..] {
            system.height_factor = 0.0;
        }
        if count > 1 {
            self.panel.open(Tab::Study);
            self.panel.spectra = Some(list);
        } else {
            self.panel.spectra = None;
        }
    }

    /// Keeps the title of the spectrum that the sea has from a file.
    fn remember_title(&mut self, title: impl Into<String>) {
        self.panel.spectrum_title = self.params.sea.measured.clone().map(|spectrum| (spectrum, title.into()));
    }

    /// Whence the measured waves of the sea are: name of the file and time of the record; `None` if the sea has no
    /// measured waves, or a link has brought them.
    pub(super) fn measured_title(&self) -> Option<&str> {
        let (spectrum, title) = self.panel.spectrum_title.as_ref()?;
        let is_shown = self.params.sea.measured.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, spectrum));
        (is_shown && self.has_measured_waves()).then_some(title)
    }

    /// Says that the sea has the waves of a file, or of one of its spectra, called `name`.
    fn waves_of_file(&self, name: &str, hs_m: f64) -> String {
        let height = self.length_scale().format(hs_m, 1);
        say!("The sea has the waves of {name} now, {height} high.", name = name, height = height)
    }
}

/// Adds the list of the spectra of the file that was opened last, if it holds several. A click uses one of them.
pub fn show_spectrum_list(app: &mut App, ui: &mut egui::Ui) {
    let Some(list) = app.panel.spectra.take() else { return };
    let mut keeps = true;
    ui.horizontal(|ui| {
        ui.label(say!("{name}: {count} spectra", name = list.name, count = list.records.len()));
        keeps = !with_accessible_name(ui.small_button("×"), tr("Close the list of spectra")).clicked();
    });
    let mut chosen = None;
    let row_height = ui.spacing().interact_size.y;
    let area = egui::ScrollArea::vertical().id_salt("spectra").max_height(LIST_HEIGHT_POINTS).auto_shrink(true);
    area.show_rows(ui, row_height, list.records.len(), |ui, rows| {
        for i in rows {
            let record = &list.records[i];
            let text = format!("{}  Hs {}", record.label, app.length_scale().format(record.spectrum.hs_m(), 2));
            let is_used = app.params.sea.measured.as_deref() == Some(&record.spectrum);
            let row = ui.add_sized(
                [ui.available_width(), row_height],
                egui::Button::selectable(is_used, text.trim_start()).truncate(),
            );
            if row.clicked() {
                chosen = Some(i);
            }
        }
    });
    if let Some(i) = chosen {
        let spectrum = list.records[i].spectrum.clone();
        let message = app.waves_of_file(&list.records[i].label, spectrum.hs_m());
        app.tell_opened(&message, format!("{}: Hs {:.2} m", list.title(i), spectrum.hs_m()));
        app.notices.clone_from(&list.records[i].notices);
        app.params.sea.set_measured_spectrum(spectrum);
        app.remember_title(list.title(i));
    }
    if keeps {
        app.panel.spectra = Some(list);
    }
}
