//! Symbols of the panel's buttons: glyphs of the Lucide icons (assets/icons.ttf holds those that are used; licence in
//! assets/icons-license.txt).

use egui::epaint::text::{FontInsert, FontPriority, InsertFontFamily};

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

/// Adds the symbols, and the names of Japanese and Chinese, to egui's fonts, for characters that the text fonts lack.
pub fn install(ctx: &egui::Context) {
    let fonts: [(_, &[u8]); 2] = [
        ("icons", include_bytes!("../../assets/icons.ttf")),
        ("names of languages", include_bytes!("../../assets/languages/names.ttf")),
    ];
    for (name, bytes) in fonts {
        let family = egui::FontFamily::Proportional;
        let last = vec![InsertFontFamily { family, priority: FontPriority::Lowest }];
        ctx.add_font(FontInsert::new(name, egui::FontData::from_static(bytes), last));
    }
}
