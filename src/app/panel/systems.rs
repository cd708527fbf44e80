//! The panel's sections of the wave systems beside the local wind sea: which are shown, how one is added and removed.

use super::super::App;
use super::super::accessible_names::with_accessible_name;
use crate::app::language::tr;
use crate::state::Params;
use crate::state::fields::{Field, Group};
use crate::state::params::Sea;

/// Whether the panel shows the section of a group. It hides wave systems beside the local wind sea that are switched
/// off and have default values.
pub fn is_in_use(params: &Params, group: Group) -> bool {
    group.further_system_index().is_none_or(|i| params.sea.systems[i] != Sea::default().systems[i])
}

/// Whether a search for `words` asks for a parameter of a wave system that is switched off: by its key, such as
/// `wind3`, or by the first word of the name of its section, such as "third". Other words find only systems in use.
pub fn is_asked_for(field: &Field, words: &str) -> bool {
    let section = field.group.label().to_lowercase();
    let name = section.split(' ').next().unwrap_or_default();
    words.to_lowercase().split_whitespace().any(|word| word == field.key || word == name)
}

/// Adds the button that switches on the next wave system that is off. It is disabled if all are on.
pub fn show_add_button(app: &mut App, ui: &mut egui::Ui) {
    let is_off = |group: &Group| group.further_system_index().is_some_and(|i| !app.params.sea.systems[i].is_on());
    let next = Group::ALL.into_iter().find(is_off);
    let button = ui.add_enabled(next.is_some(), egui::Button::new(tr("Add a wave system")));
    let button = button.on_hover_text(tr("Swell, or another wind sea: its spectrum adds to those of the others."));
    let button = button.on_disabled_hover_text(tr("All wave systems are on."));
    let Some(group) = next.filter(|_| button.clicked()) else { return };
    if let Some(i) = group.further_system_index() {
        app.params.sea.systems[i].height_factor = 1.0;
        app.panel.added_system = Some(group);
    }
}

/// Adds the button that switches a wave system off and gives it its default values, if `group` is one beside the local
/// wind sea.
pub fn show_remove_button(params: &mut Params, group: Group, ui: &mut egui::Ui) {
    let Some(i) = group.further_system_index() else { return };
    let button = ui.button(tr("Remove this system")).on_hover_text(tr("Switches it off, with its default values."));
    if with_accessible_name(button, &format!("Remove the {}", group.label().to_lowercase())).clicked() {
        params.sea.systems[i] = Sea::default().systems[i].clone();
    }
}
