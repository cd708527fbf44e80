//! Fonts of the interface, and the symbols of the panel's buttons: glyphs of the Lucide icons (assets/icons.ttf holds
//! those that are used; licence in assets/icons-license.txt).

use std::sync::Arc;

pub const SEAS: &str = "\u{e283}";
pub const WEATHER: &str = "\u{e1b0}";
pub const VIEW: &str = "\u{e064}";
pub const STUDY: &str = "\u{e2a5}";
pub const SHARE: &str = "\u{e156}";
pub const PLAY: &str = "\u{e13c}";
pub const PAUSE: &str = "\u{e12e}";
pub const SURPRISE: &str = "\u{e2c5}";
pub const TO_START: &str = "\u{e15f}";
pub const STEP_BACK: &str = "\u{e3e9}";
pub const STEP_FORWARD: &str = "\u{e3ea}";
pub const UNDO: &str = "\u{e2a1}";
pub const REDO: &str = "\u{e2a0}";
pub const RESET: &str = "\u{e148}";
pub const HELP: &str = "\u{e082}";
pub const OPEN: &str = "\u{e247}";
pub const LINK: &str = "\u{e102}";
pub const PICTURE: &str = "\u{e0f6}";

/// Sets the fonts of the interface: a text font, and symbols and the names of Japanese and Chinese for characters that
/// the text font lacks. Both of egui's families get the same fonts, because no text needs letters of equal width.
pub fn install(ctx: &egui::Context) {
    let fonts: [(&str, &[u8]); 3] = [
        ("Ubuntu Light", epaint_default_fonts::UBUNTU_LIGHT),
        ("icons", include_bytes!("../../assets/icons.ttf")),
        ("names of languages", include_bytes!("../../assets/languages/names.ttf")),
    ];
    let mut definitions = egui::FontDefinitions::empty();
    for (name, bytes) in fonts {
        definitions.font_data.insert(name.to_owned(), Arc::new(egui::FontData::from_static(bytes)));
        for family in [egui::FontFamily::Proportional, egui::FontFamily::Monospace] {
            definitions.families.entry(family).or_default().push(name.to_owned());
        }
    }
    ctx.set_fonts(definitions);
}
