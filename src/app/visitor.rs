//! What the app knows of its visitor: preferences that belong to the visitor and not to the sea, so that no link carries
//! them, kept for the next visit; and what is shown to who is new, or away.

use super::first_steps::FirstSteps;
use super::panel::Place;
use super::plots::SpectrumAxis;
use super::slow_camera::SlowCamera;
use super::{App, storage};

/// What the app knows of its visitor.
#[derive(Default)]
pub struct Visitor {
    pub preferences: Preferences,
    /// Whether changes of the preferences are stored.
    stores_preferences: bool,
    pub first_steps: FirstSteps,
    pub slow_camera: SlowCamera,
    /// Whether the pointer is in the window but not over the sea, as in the panel.
    pub pointer_is_off_sea: bool,
}

/// Preferences of the visitor.
#[derive(Clone, Debug, PartialEq)]
pub struct Preferences {
    /// Whether the visitor has seen or skipped the first steps.
    pub knows_first_steps: bool,
    /// Whether the camera may move slowly while nobody touches anything.
    pub slow_camera: bool,
    /// Place and width of the panel of a wide window.
    pub panel: Place,
    /// The quantity along the horizontal axis of plotted spectra.
    pub spectrum_axis: SpectrumAxis,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            knows_first_steps: false,
            slow_camera: true,
            panel: Place::default(),
            spectrum_axis: SpectrumAxis::default(),
        }
    }
}

impl Preferences {
    /// Reads a text as [`Self::text`] writes it. What is missing or cannot be read has its default value.
    fn parse(text: &str) -> Self {
        let mut preferences = Self::default();
        for (key, value) in text.split_whitespace().filter_map(|word| word.split_once('=')) {
            match key {
                "knows-first-steps" => preferences.knows_first_steps = value == "1",
                "slow-camera" => preferences.slow_camera = value != "0",
                "spectrum-axis" => preferences.spectrum_axis = SpectrumAxis::from_word(value),
                _ => preferences.panel.read(key, value),
            }
        }
        preferences
    }

    fn text(&self) -> String {
        let [knows, slow] = [self.knows_first_steps, self.slow_camera].map(u8::from);
        let (axis, panel) = (self.spectrum_axis.word(), self.panel.text());
        format!("knows-first-steps={knows}\nslow-camera={slow}\nspectrum-axis={axis}\n{panel}")
    }
}

impl App {
    /// Reads the stored preferences, and stores every change of them from now on. Without this call, the app has the
    /// default preferences and stores nothing.
    pub fn load_preferences(&mut self) {
        self.visitor.preferences = Preferences::parse(&storage::load_preferences(self.save_folder.as_deref()));
        self.visitor.stores_preferences = true;
    }

    /// Changes the preferences, and stores them for the next visit.
    pub(in crate::app) fn change_preferences(&mut self, change: impl FnOnce(&mut Preferences)) {
        change(&mut self.visitor.preferences);
        self.store_preferences();
    }

    /// Stores the preferences for the next visit.
    pub(in crate::app) fn store_preferences(&self) {
        let text = self.visitor.preferences.text();
        if self.visitor.stores_preferences
            && let Err(reason) = storage::store_preferences(self.save_folder.as_deref(), &text)
        {
            // They hold until the program ends; whoever switches storage off knows that nothing is kept.
            log::warn!("the preferences are not kept: {reason}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_stored_is_read_and_nonsense_is_not() {
        for word in ["period", "hz", "rad/s"] {
            for (knows_first_steps, slow_camera) in [(false, false), (false, true), (true, false), (true, true)] {
                let spectrum_axis = SpectrumAxis::from_word(word);
                let mut panel = Place::default();
                panel.read("side", if slow_camera { "left" } else { "right" });
                panel.read("width", "500");
                let preferences = Preferences { knows_first_steps, slow_camera, panel, spectrum_axis };
                assert_eq!(Preferences::parse(&preferences.text()), preferences);
            }
        }
        for text in ["", "\0\u{1}", "knows-first-steps", "slow-camera=", "other=1\nknows-first-steps=yes"] {
            assert_eq!(Preferences::parse(text), Preferences::default(), "{text:?}");
        }
    }

    #[test]
    fn the_older_file_of_the_panel_is_read_and_newer_preferences_count() {
        let place = |text: &str| Preferences::parse(text).panel.text();
        assert_eq!(place("side=left width=446\nknows-first-steps=1\n"), "side=left\nwidth=446\n");
        assert_eq!(place("side=left width=446\nside=right\nwidth=400\n"), "side=right\nwidth=400\n");
    }
}
