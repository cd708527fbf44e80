//! Languages of the interface.
//!
//! The English texts stand in the code where they are shown, inside [`tr`] or `say!`. A language file
//! (assets/languages/de.json and so on) maps each of them to its translation. The window has the files built in; the page
//! fetches them. Japanese and Chinese come with a font of the characters that their file uses.

use super::tasks::Inbox;
use crate::state::params::Language;
use egui::epaint::text::{FontInsert, FontPriority, InsertFontFamily};
use std::cell::Cell;
use std::collections::HashMap;

type Translations = HashMap<String, String>;

thread_local! {
    /// Translations of the current language, and whether it writes a comma before decimals. `None` is English.
    static CURRENT: Cell<Option<(&'static Translations, bool)>> = const { Cell::new(None) };
}

/// Contents of a language's files: translations in JSON, and a font unless the fonts of icons.rs have all of its
/// characters.
pub type LanguageFiles = (Vec<u8>, Option<Vec<u8>>);

/// The translation of an English text, or the text itself if the current language has none.
pub fn tr(english: &str) -> &str {
    CURRENT.get().and_then(|(translations, _)| translations.get(english)).map_or(english, String::as_str)
}

/// Runs `compose` with English as the language of the interface.
pub fn in_english<T>(compose: impl FnOnce() -> T) -> T {
    let current = CURRENT.take();
    let composed = compose();
    CURRENT.set(current);
    composed
}

/// Translates an English text with places such as `{height}`, and puts the values of `places` there.
pub fn fill(english: &str, places: &[(&str, String)]) -> String {
    let mut text = tr(english).to_owned();
    for (name, value) in places {
        text = text.replace(&format!("{{{name}}}"), value);
    }
    text
}

/// Translates a text and puts values in its places: `say!("Waves {height} high", height = text)`.
macro_rules! say {
    ($english:literal $(, $name:ident = $value:expr)* $(,)?) => {
        $crate::app::language::fill($english, &[$((stringify!($name), $value.to_string())),*])
    };
}
pub(crate) use say;

/// Marks an English text in a table, which is translated where it is shown, for the list of texts to translate.
macro_rules! text {
    ($english:literal) => {
        $english
    };
}
pub(crate) use text;

/// A number, written with a decimal point, in the way of the current language.
pub fn local_number(number: String) -> String {
    if CURRENT.get().is_some_and(|(_, comma)| comma) { number.replace('.', ",") } else { number }
}

impl Language {
    /// Name of the language in the language itself.
    pub fn own_name(self) -> &'static str {
        match self {
            Self::Auto => "Automatic",
            Self::English => "English",
            Self::German => "Deutsch",
            Self::French => "Français",
            Self::Spanish => "Español",
            Self::Portuguese => "Português",
            Self::Japanese => "日本語",
            Self::Chinese => "简体中文",
        }
    }

    /// The language of a tag such as `pt-BR` or `de_AT.UTF-8`; English if there is no translation.
    fn from_tag(tag: &str) -> Self {
        let code = tag.get(..2).unwrap_or_default().to_lowercase();
        Self::ALL.into_iter().find(|language| language.word() == code).unwrap_or(Self::English)
    }

    /// The language that is shown if the user has chosen this one: for `Auto`, the system's or the browser's.
    fn resolved(self) -> Self {
        if self == Self::Auto { Self::from_tag(&system_tag().unwrap_or_default()) } else { self }
    }

    fn writes_decimal_comma(self) -> bool {
        matches!(self, Self::German | Self::French | Self::Spanish | Self::Portuguese)
    }

    #[cfg(target_arch = "wasm32")]
    fn has_own_font(self) -> bool {
        matches!(self, Self::Japanese | Self::Chinese)
    }
}

/// Tag of the language that the browser prefers.
#[cfg(target_arch = "wasm32")]
fn system_tag() -> Option<String> {
    web_sys::window()?.navigator().language()
}

/// Tag of the system's language.
#[cfg(not(target_arch = "wasm32"))]
fn system_tag() -> Option<String> {
    sys_locale::get_locale()
}

/// Fetches the files of a language from the page's host.
#[cfg(target_arch = "wasm32")]
async fn load(language: Language) -> Result<LanguageFiles, String> {
    use wasm_bindgen::JsCast as _;
    use wasm_bindgen_futures::JsFuture;
    let fetch = async |end: &str| -> Result<Vec<u8>, wasm_bindgen::JsValue> {
        let window = web_sys::window().ok_or("no window")?;
        let address = format!("languages/{}.{end}", language.word());
        let response: web_sys::Response = JsFuture::from(window.fetch_with_str(&address)).await?.unchecked_into();
        if !response.ok() {
            return Err(format!("the host answers with {}", response.status()).into());
        }
        Ok(js_sys::Uint8Array::new(&JsFuture::from(response.array_buffer()?).await?).to_vec())
    };
    let run = async || -> Result<LanguageFiles, wasm_bindgen::JsValue> {
        let translations = fetch("json").await?;
        let font = if language.has_own_font() { Some(fetch("ttf").await?) } else { None };
        Ok((translations, font))
    };
    run().await.map_err(|e| format!("The translations of this language cannot be fetched: {e:?}"))
}

/// The files of a language, which are built into the program.
#[cfg(not(target_arch = "wasm32"))]
#[expect(clippy::unused_async, reason = "the page's function of the same name waits for the host")]
async fn load(language: Language) -> Result<LanguageFiles, String> {
    macro_rules! files {
        ($($code:literal),+) => {
            match language.word() {
                $($code => &include_bytes!(concat!("../../assets/languages/", $code, ".json"))[..],)+
                _ => b"{}",
            }
        };
    }
    let translations = files!("de", "fr", "es", "pt", "ja", "zh");
    let font: Option<&[u8]> = match language {
        Language::Japanese => Some(include_bytes!("../../assets/languages/ja.ttf")),
        Language::Chinese => Some(include_bytes!("../../assets/languages/zh.ttf")),
        _ => None,
    };
    Ok((translations.to_vec(), font.map(<[u8]>::to_vec)))
}

/// The language of the interface, and the one that is being loaded.
#[derive(Default)]
pub struct Languages {
    wanted: Option<Language>,
    loaded: Inbox<(Language, Result<LanguageFiles, String>)>,
    /// Value for [`CURRENT`] from the next frame on: egui draws with a new font only after the frame that added it.
    next: Option<Option<(&'static Translations, bool)>>,
}

impl Languages {
    /// Shows the interface in the `chosen` language as soon as its files are there. Returns what went wrong, if
    /// anything. Call it once a frame.
    pub fn update(&mut self, chosen: Language, ctx: &egui::Context) -> Result<(), String> {
        if let Some(next) = self.next.take() {
            CURRENT.set(next);
        }
        let before = self.wanted.replace(chosen);
        if before.is_none() {
            // A new window or a new device begins without the fonts of the one before.
            CURRENT.set(None);
        }
        if before != Some(chosen) {
            let language = chosen.resolved();
            if language == Language::English {
                self.show(language, (b"{}".to_vec(), None), ctx)?;
            } else {
                let (loaded, ctx) = (self.loaded.clone(), ctx.clone());
                super::tasks::spawn(async move { loaded.put((language, load(language).await), &ctx) });
            }
        }
        for (language, files) in self.loaded.take() {
            // A slow answer for a language that is no longer wanted is dropped.
            if chosen.resolved() == language {
                self.show(language, files?, ctx)?;
            }
        }
        Ok(())
    }

    fn show(&mut self, language: Language, (json, font): LanguageFiles, ctx: &egui::Context) -> Result<(), String> {
        let fault = |e| format!("The translations of this language cannot be read: {e}");
        let translations: serde_json::Map<String, serde_json::Value> = serde_json::from_slice(&json).map_err(fault)?;
        let texts = translations.into_iter().filter_map(|(english, text)| Some((english, text.as_str()?.to_owned())));
        // Texts of the interface are borrowed for as long as the program runs; a language is rarely changed.
        let translations: &'static Translations = Box::leak(Box::new(texts.collect()));
        let comma = language.writes_decimal_comma();
        self.next = Some((language != Language::English).then_some((translations, comma)));
        if let Some(font) = font {
            let families = [egui::FontFamily::Proportional, egui::FontFamily::Monospace];
            let families = families.map(|family| InsertFontFamily { family, priority: FontPriority::Lowest });
            ctx.add_font(FontInsert::new(language.word(), egui::FontData::from_owned(font), families.to_vec()));
        }
        ctx.all_styles_mut(|style| {
            style.number_formatter = egui::style::NumberFormatter::new(|number, decimals| {
                local_number(egui::emath::format_with_decimals_in_range(number, decimals))
            });
        });
        ctx.request_repaint();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_name_languages() {
        let tags =
            [("pt-BR", "pt"), ("de_AT.UTF-8", "de"), ("zh-Hans-CN", "zh"), ("en-GB", "en"), ("C", "en"), ("", "en")];
        for (tag, code) in tags {
            assert_eq!(Language::from_tag(tag).word(), code, "{tag}");
        }
    }

    #[test]
    fn places_are_filled_in_the_order_of_the_translation() {
        let json = br#"{"From {a} to {b}": "Nach {b} von {a}"}"#.to_vec();
        let mut languages = Languages::default();
        let context = egui::Context::default();
        assert_eq!(languages.show(Language::German, (json, None), &context), Ok(()));
        CURRENT.set(languages.next.flatten());
        assert_eq!(say!("From {a} to {b}", a = 1, b = 2), "Nach 2 von 1");
        assert_eq!((tr("unknown"), local_number("1.5".into()).as_str()), ("unknown", "1,5"));
        CURRENT.set(None);
        assert_eq!(say!("From {a} to {b}", a = 1, b = local_number("2.5".into())), "From 1 to 2.5");
    }
}
