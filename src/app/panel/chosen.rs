//! Which named sea is shown, so that the list can mark it.

use super::super::App;
use crate::state::params::{Look, Sea};
use crate::state::presets;

/// Name of the built-in sea that is shown, if any, with the sea and the light for which it was looked up.
#[derive(Default)]
pub struct ShownSea {
    found_for: Option<(Sea, Look)>,
    name: Option<&'static str>,
}

impl App {
    /// Name of the built-in sea that is shown: the one whose choice would change nothing. It is looked up again only
    /// after a change of sea or light.
    pub(super) fn shown_sea_name(&mut self) -> Option<&'static str> {
        let (params, shown) = (&self.params, &mut self.panel.shown_sea);
        let is_known = shown.found_for.as_ref().is_some_and(|(sea, look)| (sea, look) == (&params.sea, &params.look));
        if !is_known {
            let is_shown = |preset: &&presets::Preset| preset.shows_sea_of(params);
            shown.name = presets::built_in().iter().find(is_shown).map(|preset| preset.name.as_str());
            shown.found_for = Some((params.sea.clone(), params.look.clone()));
        }
        shown.name
    }

    /// Names of the built-in seas that a search finds: each word occurs in the name or the description.
    pub(super) fn seas_with_words(words: &str) -> Vec<&'static presets::Preset> {
        let has = |p: &&presets::Preset| super::rows::has_all_words(&format!("{} {}", p.name, p.about), words);
        presets::built_in().iter().filter(has).collect()
    }
}
