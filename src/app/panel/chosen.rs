//! Which named sea is shown, so that the list can mark it.

use super::super::App;
use crate::app::language::tr;
use crate::state::coast::Coast;
use crate::state::params::{Look, Sea};
use crate::state::presets;

/// Name of the built-in sea that is shown, if any, with the sea, the coast and the light for which it was looked up.
#[derive(Default)]
pub struct ShownSea {
    found_for: Option<(Sea, Coast, Look)>,
    name: Option<&'static str>,
    /// Name of the built-in sea that was shown last, also if the user has changed it since.
    last_name: Option<&'static str>,
}

impl App {
    /// Name of the built-in sea that is shown: the one whose choice would change nothing. It is looked up again only
    /// after a change of sea, coast or light.
    pub(super) fn shown_sea_name(&mut self) -> Option<&'static str> {
        let (params, shown) = (&self.params, &mut self.panel.shown_sea);
        let now = (&params.sea, &params.coast, &params.look);
        let is_known = shown.found_for.as_ref().is_some_and(|(sea, coast, look)| (sea, coast, look) == now);
        if !is_known {
            let is_shown = |preset: &&presets::Preset| preset.shows_sea_of(params);
            shown.name = presets::built_in().iter().find(is_shown).map(|preset| preset.name.as_str());
            shown.last_name = shown.name.or(shown.last_name);
            shown.found_for = Some((params.sea.clone(), params.coast.clone(), params.look.clone()));
        }
        shown.name
    }

    /// Opens the built-in sea that follows the shown one in the list by `step` (negative: that comes before it), says its
    /// name, and lets the list scroll to it. The first follows the last.
    pub(in crate::app) fn open_neighbouring_sea(&mut self, step: isize) {
        let name = self.shown_sea_name().or(self.panel.shown_sea.last_name);
        let seas = presets::built_in();
        let from = seas.iter().position(|sea| Some(sea.name.as_str()) == name);
        let start = if step > 0 { -1 } else { 0 };
        let next = (from.map_or(start, |i| i as isize) + step).rem_euclid(seas.len() as isize) as usize;
        self.open_preset(&seas[next]);
        self.panel.scrolls_to_shown_sea = true;
        self.show_brief_message(tr(&seas[next].name));
    }

    /// Names of the built-in seas that a search finds: each word occurs in the name or the description.
    pub(super) fn seas_with_words(words: &str) -> Vec<&'static presets::Preset> {
        let has = |p: &&presets::Preset| super::rows::has_all_words(&format!("{} {}", p.name, p.about), words);
        presets::built_in().iter().filter(has).collect()
    }
}
