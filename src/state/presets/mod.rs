//! Named seas: those that ship with the program, and users' own files of the same form.
//!
//! A file is text. `[Name]` begins a sea; `about:`, `source:` and `state:` are its lines, each of which may be
//! repeated: texts are joined by a space, states by `&`. Lines that begin with `#` are comments. Reading never fails:
//! what cannot be taken becomes a notice.
//!
//! What a sea carries follows from the groups of [`FIELDS`] alone, see [`Preset::apply`].

use super::fields::{FIELDS, Field, Group};
use super::look::SkyFile;
use super::params::Params;
use super::query;
use std::fmt::Write as _;
use std::sync::LazyLock;

#[cfg(test)]
mod tests;

/// Largest file of seas that is read; the rest is ignored with a notice.
pub const MAX_FILE_BYTES: usize = 1024 * 1024;
/// Most seas of a file.
pub const MAX_PRESETS: usize = 200;
/// Longest name, characters.
pub const MAX_NAME: usize = 60;
/// Longest `about` and `source`, characters.
pub const MAX_TEXT: usize = 1000;
const MAX_NOTICES: usize = 24;
/// The one value of the sea groups that a sea does not reset: which of all seas of the same statistics is shown.
const SEED: &str = "seed";

/// A named sea.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Preset {
    /// Name, at most [`MAX_NAME`] characters.
    pub name: String,
    /// What one sees, with typical numbers.
    pub about: String,
    /// Where the numbers come from.
    pub source: String,
    /// State string of what it sets; empty is the default sea.
    pub state: String,
}

/// What becomes of a parameter when a sea is applied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// Wind, waves, water, foam: as the sea has it, named or not.
    Sea,
    /// Sun, sky, colours, film: all as the sea has them if it names any of them, else left.
    Light,
    /// Camera: what the sea names.
    Camera,
    /// Time, resolution, views: never the sea's.
    Kept,
}

fn role(group: Group) -> Role {
    match group {
        Group::Sea | Group::Swell | Group::Water | Group::Foam => Role::Sea,
        Group::Sky | Group::Surface | Group::Film => Role::Light,
        Group::Camera => Role::Camera,
        Group::Grid | Group::View | Group::Clock | Group::Screen => Role::Kept,
    }
}

/// The seas that ship with the program.
pub fn built_in() -> &'static [Preset] {
    static SEAS: LazyLock<Vec<Preset>> = LazyLock::new(|| read(include_str!("../../../assets/presets/seas.txt")).0);
    &SEAS
}

/// Whether a text looks like a file of seas: its first line that is no comment is a name in brackets.
pub fn is_file(text: &str) -> bool {
    let first = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'));
    first.is_some_and(|line| line.starts_with('[') && line.ends_with(']'))
}

impl Preset {
    /// The sea and light of `params` under a name, without a description. Camera, time, resolution and views are not in
    /// it, nor is what stands at its default: a sea in default light carries no light.
    pub fn of(name: &str, params: &Params) -> Self {
        let mut carried = Params::default();
        for field in FIELDS.iter().filter(|f| matches!(role(f.group), Role::Sea | Role::Light)) {
            copy(field, params, &mut carried);
        }
        carried.sea.measured.clone_from(&params.sea.measured);
        carried.look.sky.file.clone_from(&params.look.sky.file);
        Self { name: name.to_owned(), state: query::write(&carried), ..Self::default() }.tidy()
    }

    /// This sea in place of that of `now`, and a notice for each thing of its state that was not taken as written.
    ///
    /// Wind, waves, water and foam go to their defaults and then to what the state names, all but the seed, which stays
    /// unless it is named; a buoy's spectrum is the state's or none. Sun, sky, colours and film do the same if the
    /// state names any of them, else they stay. Of the camera only what is named changes; time, resolution and views
    /// stay. A sky from a file is kept if it is the one that the state names;
    /// [`SkyLook::missing_file`](super::look::SkyLook::missing_file) tells.
    pub fn apply(&self, now: &Params) -> (Params, Vec<String>) {
        let query::Reading { params: wanted, taken, mut notices } = query::read(&self.state);
        let named = |field: &Field| taken.contains(&field.key);
        let light = taken.contains(&query::SKY) || FIELDS.iter().any(|f| role(f.group) == Role::Light && named(f));
        let mut next = now.clone();
        let mut left = Vec::new();
        for field in FIELDS.iter() {
            let set = match role(field.group) {
                Role::Sea => field.key != SEED || named(field),
                Role::Light => light,
                Role::Camera => named(field),
                Role::Kept => false,
            };
            if set {
                copy(field, &wanted, &mut next);
            } else if named(field) {
                left.push(field.key);
            }
        }
        next.sea.measured = wanted.sea.measured;
        if light {
            let loaded: Option<SkyFile> = next.look.sky.file.take();
            next.look.sky.file = wanted.look.sky.file;
            next.look.sky.attach(loaded.as_ref());
        }
        if !left.is_empty() {
            notices.push(format!("a named sea does not set these, they stay as they are: {}", left.join(", ")));
        }
        (next, notices)
    }

    /// Without control characters and surrounding blanks, texts cut to their longest. Files hold such seas, and what is
    /// written in this form is read back to the same.
    #[must_use]
    fn tidy(self) -> Self {
        Self {
            name: printable(&self.name, MAX_NAME),
            about: printable(&self.about, MAX_TEXT),
            source: printable(&self.source, MAX_TEXT),
            state: printable(&self.state, usize::MAX),
        }
    }
}

fn copy(field: &Field, from: &Params, to: &mut Params) {
    (field.set)(to, (field.get)(from));
}

fn printable(text: &str, longest: usize) -> String {
    let clean: String = text.chars().filter(|c| !c.is_control()).collect();
    let short: String = clean.trim().chars().take(longest).collect();
    short.trim_end().to_owned()
}

/// Puts seas in place of those of the same names, or after the others.
///
/// # Errors
/// One sentence, if that is more than a file holds; then nothing has changed.
pub fn add(to: &mut Vec<Preset>, new: Vec<Preset>) -> Result<(), String> {
    let mut all = to.clone();
    for preset in new {
        match all.iter_mut().find(|p| p.name == preset.name) {
            Some(old) => *old = preset,
            None => all.push(preset),
        }
    }
    if all.len() > MAX_PRESETS || write(&all).len() > MAX_FILE_BYTES {
        let kib = MAX_FILE_BYTES / 1024;
        return Err(format!(
            "more than {MAX_PRESETS} seas or {kib} KiB of them are not kept: forget some of yours first"
        ));
    }
    *to = all;
    Ok(())
}

/// Writes seas as a file that [`read`] takes. Control characters are left out, and so are seas without a name.
pub fn write(presets: &[Preset]) -> String {
    let mut out = String::new();
    for preset in presets {
        let Preset { name, about, source, state } = preset.clone().tidy();
        if name.is_empty() {
            continue;
        }
        let blank = if out.is_empty() { "" } else { "\n" };
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{blank}[{name}]");
        for (key, value) in [("about", &about), ("source", &source)] {
            if !value.is_empty() {
                let _ = writeln!(out, "{key}: {value}");
            }
        }
        let _ = writeln!(out, "{}", format!("state: {state}").trim_end());
    }
    out
}

/// A sea as it stands in a file.
struct Block {
    preset: Preset,
    has_state: bool,
    /// The first thing that is wrong with it.
    fault: Option<String>,
}

impl Block {
    fn new(heading: &str) -> Self {
        let name = printable(heading, MAX_NAME);
        let fault =
            (name != printable(heading, usize::MAX)).then(|| format!("the name is cut to {MAX_NAME} characters"));
        Self { preset: Preset { name, ..Preset::default() }, has_state: false, fault }
    }

    fn line(&mut self, text: &str) {
        let (key, value) = text.split_once(':').unwrap_or((text, ""));
        let (to, between) = match key.trim() {
            "about" => (&mut self.preset.about, " "),
            "source" => (&mut self.preset.source, " "),
            "state" => {
                self.has_state = true;
                (&mut self.preset.state, "&")
            }
            _ => {
                let shown = printable(key, 40);
                let fault = format!("\"{shown}\" is none of about, source, state: ignored");
                self.fault.get_or_insert(fault);
                return;
            }
        };
        let value = value.trim();
        if !to.is_empty() && !value.is_empty() {
            to.push_str(between);
        }
        to.push_str(value);
    }

    /// The sea if it is one, and what to say of it.
    fn finish(self) -> (Option<Preset>, Option<String>) {
        let preset = self.preset.tidy();
        let refusal = if preset.name.is_empty() {
            Some("a sea without a name: ignored".to_owned())
        } else if !self.has_state {
            Some(format!("{}: no state: ignored", preset.name))
        } else if preset.state.len() > query::MAX_BYTES {
            Some(format!("{}: its state is longer than {} bytes: ignored", preset.name, query::MAX_BYTES))
        } else {
            None
        };
        match refusal {
            Some(_) => (None, refusal),
            None => {
                let notice = self.fault.map(|fault| format!("{}: {fault}", preset.name));
                (Some(preset), notice)
            }
        }
    }
}

/// Reads a file of seas: the seas in their order, and one notice for each that was not taken as written. The states are
/// not looked into; [`Preset::apply`] says what is wrong with them. A sea of the same name replaces the earlier one.
pub fn read(text: &str) -> (Vec<Preset>, Vec<String>) {
    let mut presets: Vec<Preset> = Vec::new();
    let mut notices = Vec::new();
    let text = cut(text.trim_start_matches('\u{feff}'), &mut notices);
    let mut block: Option<Block> = None;
    let mut strays = 0_usize;
    let mut surplus = 0_usize;
    let mut close = |block: Option<Block>, notices: &mut Vec<String>| {
        let (preset, notice) = block.map_or((None, None), Block::finish);
        notices.extend(notice);
        let Some(preset) = preset else { return };
        match presets.iter().position(|p| p.name == preset.name) {
            Some(earlier) => presets[earlier] = preset,
            None if presets.len() < MAX_PRESETS => presets.push(preset),
            None => surplus += 1,
        }
    };
    for line in text.lines().map(str::trim) {
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        if let Some(heading) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            close(block.replace(Block::new(heading)), &mut notices);
        } else if let Some(block) = &mut block {
            block.line(line);
        } else {
            strays += 1;
        }
    }
    close(block, &mut notices);
    if strays > 0 {
        notices.push(format!("{strays} line(s) before the first [name]: ignored"));
    }
    if surplus > 0 {
        notices.push(format!("more than {MAX_PRESETS} seas: {surplus} ignored"));
    }
    if notices.len() > MAX_NOTICES {
        let more = notices.len() - MAX_NOTICES;
        notices.truncate(MAX_NOTICES);
        notices.push(format!("and {more} more"));
    }
    (presets, notices)
}

/// The whole lines within [`MAX_FILE_BYTES`].
fn cut<'a>(text: &'a str, notices: &mut Vec<String>) -> &'a str {
    if text.len() <= MAX_FILE_BYTES {
        return text;
    }
    notices.push(format!("the file is longer than {} KiB: the rest was ignored", MAX_FILE_BYTES / 1024));
    let end = (0..=MAX_FILE_BYTES).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0);
    text[..end].rfind('\n').map_or("", |line| &text[..line])
}
