//! The translations of the interface: each language has every text that the program can show, with the same places for
//! values, and characters that the fonts can draw.

use seastate::coast::built_in::BUILT_IN;
use seastate::state::fields::FIELDS;
use seastate::state::floats::FloatingObjectKind;
use seastate::state::motion::CAMERA_VIEWS;
use seastate::state::params::Language;
use seastate::state::presets;
use seastate::waves::beaufort::{BEAUFORT_FORCES, sea_state};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

type Translations = BTreeMap<String, String>;

/// The Rust files of the app.
fn app_sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the app's sources").map(|entry| entry.expect("an entry").path());
    entries.flat_map(|path| if path.is_dir() { app_sources(&path) } else { vec![path] }).collect()
}

/// The string literals that follow each `marker` in a source text.
fn literals_after(source: &str, marker: &str) -> Vec<String> {
    let starts = source.match_indices(marker).map(|(at, _)| at + marker.len());
    starts.filter_map(|at| source[at..].trim_start().strip_prefix('"').map(unescape)).collect()
}

/// The value of a Rust string literal, given the source text after its opening quote.
fn unescape(text: &str) -> String {
    let (mut value, mut letters) = (String::new(), text.chars().peekable());
    while let Some(letter) = letters.next() {
        match letter {
            '"' => return value,
            '\\' => match letters.next().expect("an escaped character") {
                'n' => value.push('\n'),
                '\n' => while letters.next_if(|c| c.is_whitespace()).is_some() {},
                'u' => {
                    let code: String = letters.by_ref().skip(1).take_while(|&c| c != '}').collect();
                    value.extend(u32::from_str_radix(&code, 16).ok().and_then(char::from_u32));
                }
                other => value.push(other),
            },
            other => value.push(other),
        }
    }
    panic!("a string without an end: {text:.40}");
}

/// All English texts of the interface.
fn english_texts() -> BTreeSet<String> {
    let mut texts = BTreeSet::new();
    for path in app_sources(Path::new("src/app")) {
        let source = fs::read_to_string(&path).expect("a source file");
        let source = source.split("#[cfg(test)]").next().unwrap_or_default();
        for marker in [" tr(", "(tr(", "&tr(", "!tr(", "[tr(", "say!("] {
            texts.extend(literals_after(source, marker));
        }
        // Texts in tables are translated where they are shown.
        texts.extend(literals_after(source, "text!("));
    }
    for field in FIELDS.iter() {
        texts.extend([field.label, field.help, field.zero_word, field.group.label()].map(str::to_owned));
    }
    texts.extend(seastate::state::inactive::reasons().map(str::to_owned));
    for force in &BEAUFORT_FORCES {
        texts.extend([force.name.to_owned(), force.appearance.to_owned()]);
    }
    texts.extend((0..200).map(|i| sea_state(0.1 * f64::from(i)).1.to_owned()));
    texts.extend(FloatingObjectKind::WORDS.iter().map(|word| (*word).to_owned()));
    for view in CAMERA_VIEWS {
        texts.extend([view.name.to_owned(), view.about.to_owned()]);
    }
    texts.extend(BUILT_IN.iter().map(|coast| coast.about.to_owned()));
    for preset in presets::built_in() {
        texts.extend([preset.name.clone(), preset.about.clone()]);
    }
    texts.remove("");
    texts
}

fn languages() -> impl Iterator<Item = (Language, Translations)> {
    let translated = Language::ALL.into_iter().filter(|l| !matches!(l, Language::Auto | Language::English));
    translated.map(|language| {
        let path = format!("assets/languages/{}.json", language.word());
        let text = fs::read_to_string(&path).expect("a language file");
        (language, serde_json::from_str(&text).unwrap_or_else(|e| panic!("{path}: {e}")))
    })
}

/// The places for values in a text, such as `{height}`.
fn places(text: &str) -> BTreeSet<&str> {
    text.split('{').skip(1).filter_map(|rest| rest.split_once('}')).map(|(name, _)| name).collect()
}

#[test]
fn every_language_has_every_text() {
    let english = english_texts();
    assert!(english.len() > 200, "{} texts", english.len());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("languages");
    fs::create_dir_all(&folder).expect("a folder");
    let mut faults = Vec::new();
    for (language, translations) in languages() {
        let missing: Translations =
            english.iter().filter(|e| !translations.contains_key(*e)).map(|e| (e.clone(), String::new())).collect();
        let needless: Vec<_> = translations.keys().filter(|key| !english.contains(*key)).collect();
        let path = folder.join(format!("{}-missing.json", language.word()));
        fs::write(&path, serde_json::to_string_pretty(&missing).expect("JSON")).expect("a file");
        if !(missing.is_empty() && needless.is_empty()) {
            faults.push(format!(
                "{}: {} texts are missing ({}); not used: {needless:?}",
                language.word(),
                missing.len(),
                path.display()
            ));
        }
        for (text, translation) in &translations {
            assert_eq!(places(text), places(translation), "{}: {text}", language.word());
            assert!(!translation.trim().is_empty(), "{}: {text}", language.word());
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn fonts_have_every_character() {
    for (language, translations) in languages() {
        let mut fonts = egui::FontDefinitions::empty();
        let mut add = |name: &str, bytes: Vec<u8>| {
            fonts.font_data.insert(name.to_owned(), egui::FontData::from_owned(bytes).into());
            fonts.families.entry(egui::FontFamily::Proportional).or_default().push(name.to_owned());
        };
        add("text", epaint_default_fonts::UBUNTU_LIGHT.to_vec());
        add("icons", fs::read("assets/icons.ttf").expect("the icons"));
        if matches!(language, Language::Japanese | Language::Chinese) {
            add("own", fs::read(format!("assets/languages/{}.ttf", language.word())).expect("the language's font"));
        }
        let mut fonts = egui::epaint::text::Fonts::new(Default::default(), fonts);
        let font = egui::FontId::proportional(14.0);
        let letters: BTreeSet<char> = translations.values().flat_map(|text| text.chars()).collect();
        let mut view = fonts.with_pixels_per_point(1.0);
        let missing: String = letters.into_iter().filter(|&c| c != '\n' && !view.has_glyph(&font, c)).collect();
        assert!(missing.is_empty(), "{}: no glyphs for {missing}", language.word());
    }
}

/// The content of an HTML element as words.js names it: child elements are numbered, and code stays out.
fn page_template(content: &str) -> String {
    let (mut text, mut rest, mut number) = (String::new(), content, 0);
    while let Some((before, tag)) = rest.split_once('<') {
        let name: String = tag.chars().take_while(char::is_ascii_alphanumeric).collect();
        let (inner, after) =
            tag.split_once('>').and_then(|(_, t)| t.split_once(&format!("</{name}>"))).expect("an end");
        number += 1;
        text.push_str(before);
        text.push_str(&if name == "code" { format!("<{number}/>") } else { format!("<{number}>{inner}</{number}>") });
        rest = after;
    }
    (text + rest).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The texts of the page that scripts can translate: not those that are shown where no script of the page runs.
fn page_texts() -> BTreeSet<String> {
    let html = fs::read_to_string("web/index.html").expect("the page");
    let body = html.split_once("<body>").expect("a body").1;
    let without = |text: &str, start: &str, end: &str| {
        let pieces = text.split(start).enumerate();
        pieces.map(|(i, t)| if i == 0 { t } else { t.split_once(end).expect("an end").1 }).collect::<String>()
    };
    let mut body = without(body, "<!--", "-->");
    for (start, end) in [
        ("<noscript>", "</noscript>"),
        ("<p id=\"unbooted\">", "</p>"),
        ("<section data-rung=\"file\"", "</section>"),
        ("<section data-rung=\"old\"", "</section>"),
    ] {
        body = without(&body, start, end);
    }
    let mut texts = BTreeSet::new();
    for name in ["h2", "p", "summary", "button"] {
        for after in body.split(&format!("<{name}")).skip(1).filter(|t| t.starts_with([' ', '>'])) {
            let (content, _) = after.split_once(&format!("</{name}>")).expect("an end");
            texts.insert(page_template(content.split_once('>').expect("a tag").1));
        }
    }
    for name in [" aria-label=\"", " alt=\""] {
        texts.extend(body.split(name).skip(1).map(|t| t.split_once('"').expect("an end").0.to_owned()));
    }
    let boot = fs::read_to_string("web/boot.js").expect("the page's script");
    for marker in ["say('", "seastateWords('"] {
        texts.extend(boot.split(marker).skip(1).map(|t| t.split_once('\'').expect("an end").0.to_owned()));
    }
    texts.remove("");
    texts
}

/// The numbered elements of a text of the page.
fn numbered(text: &str) -> BTreeSet<&str> {
    let marks = text.split('<').skip(1).filter_map(|rest| rest.split_once('>'));
    marks.map(|(mark, _)| mark).collect()
}

#[test]
fn every_language_has_the_texts_of_the_page() {
    let english = page_texts();
    assert!(english.len() > 30, "{english:?}");
    for (language, _) in languages() {
        let path = format!("assets/languages/page-{}.json", language.word());
        let text = fs::read_to_string(&path).expect("a language file of the page");
        let translations: Translations = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{path}: {e}"));
        let missing: Vec<_> = english.iter().filter(|e| !translations.contains_key(*e)).collect();
        let needless: Vec<_> = translations.keys().filter(|key| !english.contains(*key)).collect();
        assert!(missing.is_empty() && needless.is_empty(), "{path}: missing {missing:#?}, not used {needless:#?}");
        for (text, translation) in &translations {
            assert_eq!(places(text), places(translation), "{path}: {text}");
            assert_eq!(numbered(text), numbered(translation), "{path}: {text}");
            assert!(!translation.trim().is_empty() && translation != text, "{path}: {text}");
        }
    }
}

/// A text with values in braces, where each value stands as `{}`.
fn without_names(text: &str) -> String {
    let mut pieces = text.split('{');
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.filter_map(|piece| piece.split_once('}')).fold(first, |text, (_, rest)| text + "{}" + rest)
}

/// Rooms that know no language write notices in English. The app has a pattern for each that a state or its waves give.
#[test]
fn every_notice_of_states_and_waves_has_a_pattern() {
    let source = fs::read_to_string("src/app/notices.rs").expect("the patterns");
    let patterns: BTreeSet<String> = literals_after(&source, "text!(").iter().map(|t| without_names(t)).collect();
    let mut count = 0;
    for path in app_sources(Path::new("src/state")).into_iter().chain(app_sources(Path::new("src/waves"))) {
        let source = fs::read_to_string(&path).expect("a source file");
        let source = source.split("#[cfg(test)]").next().unwrap_or_default();
        for marker in ["notices.push(", "notices.push(format!(", "notice = format!(", "let notice = "] {
            for notice in literals_after(source, marker) {
                count += 1;
                let notice = without_names(&notice);
                // A value may be a part of a pattern, such as the size of a grid.
                let fits =
                    patterns.contains(&notice) || patterns.contains(&notice.replace("{} x {} points", "{} points"));
                // The number of a key belongs to the key.
                let fits = fits || patterns.contains(&notice.replace("scale{}", "{}"));
                let fits = fits || patterns.contains(&notice.replace("{MAX_STATE_BYTES}", "{}"));
                assert!(fits, "{}: no pattern in src/app/notices.rs for {notice:?}", path.display());
            }
        }
    }
    assert!(count >= 15, "{count} notices");
}
