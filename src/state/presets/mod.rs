//! Presets (named seas): the built-in ones, and users' files in the same format.
//!
//! A preset file is text. `[Name]` begins a sea, and `about:`, `source:` and `state:` begin its lines. Each kind of
//! line may be repeated: texts are joined by a space, states by `&`. Lines that begin with `#` are comments. Reading
//! never fails: a line that cannot be read becomes a notice.
//!
//! The group of a parameter in [`FIELDS`] decides whether a preset sets it, see [`Preset::apply`].

use super::fields::{FIELDS, Field, Group};
use super::params::Params;
use super::query;
use super::text::{printable_prefix, quoted_excerpt, truncate_notices};
use std::fmt::Write as _;
use std::sync::LazyLock;

#[cfg(test)]
mod tests;

/// Largest preset file that is read, bytes; the rest is ignored with a notice.
pub const MAX_FILE_BYTES: usize = 1024 * 1024;
/// Largest number of presets that are read from a file; more are ignored with a notice.
pub const MAX_PRESETS: usize = 200;
/// Longest name of a preset, characters; a longer one is cut.
pub const MAX_NAME_CHARS: usize = 60;
/// Longest `about` or `source` text of a preset, characters; a longer one is cut.
pub const MAX_DESCRIPTION_CHARS: usize = 1000;
/// Key of the random seed, which a preset does not reset: it only chooses among seas of the same statistics.
const SEED_KEY: &str = "seed";

/// A preset: a named sea that the user can choose.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Preset {
    /// Name of the sea, at most [`MAX_NAME_CHARS`] characters.
    pub name: String,
    /// Description of the sea for the user, with typical wave heights and periods.
    pub about: String,
    /// Source of the numbers, such as a paper.
    pub source: String,
    /// State string of the sea, such as `wind=14&fetch=300`; empty for the default sea.
    pub state: String,
}

/// What happens to a parameter when the user chooses a preset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ApplyRule {
    /// Parameters of wind, waves, water, foam, coast, sun, sky, colours or film: always set, to the default where the
    /// preset does not name them. Otherwise a calm sea chosen after a hurricane would keep its fog and its clouds.
    SeaAndLight,
    /// Parameters of the camera: set only where the preset names them.
    Camera,
    /// Parameters of time, resolution, views and window: never changed by a preset.
    NeverSet,
}

fn apply_rule(group: Group) -> ApplyRule {
    match group {
        Group::Sea
        | Group::SecondSystem
        | Group::ThirdSystem
        | Group::FourthSystem
        | Group::Water
        | Group::Foam
        | Group::Coast
        | Group::Sky
        | Group::Surface
        | Group::Film => ApplyRule::SeaAndLight,
        Group::Camera => ApplyRule::Camera,
        Group::Grid | Group::View | Group::Clock | Group::Screen => ApplyRule::NeverSet,
    }
}

/// Returns the presets that come with the program.
pub fn built_in() -> &'static [Preset] {
    static SEAS: LazyLock<Vec<Preset>> = LazyLock::new(|| read(include_str!("../../../assets/presets/seas.txt")).0);
    &SEAS
}

/// Whether a text looks like a preset file: its first line that is neither empty nor a comment is a name in brackets.
pub fn is_preset_file(text: &str) -> bool {
    let first = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'));
    first.is_some_and(|line| line.starts_with('[') && line.ends_with(']'))
}

impl Preset {
    /// Makes a preset `name` of the waves and the light of `params`, without a description. Camera, floating objects,
    /// time, resolution, views and default values are left out.
    pub fn from_params(name: &str, params: &Params) -> Self {
        let mut carried = Params::default();
        for field in FIELDS.iter().filter(|f| apply_rule(f.group) == ApplyRule::SeaAndLight) {
            copy_field(field, params, &mut carried);
        }
        carried.sea.measured.clone_from(&params.sea.measured);
        carried.look.sky.file.clone_from(&params.look.sky.file);
        Self { name: name.to_owned(), state: query::write_to_keep(&carried), ..Self::default() }.sanitised()
    }

    /// Returns the parameters `now` changed to this preset, and one notice for each value of its state string that was
    /// not taken as written.
    ///
    /// Wind, waves, water, foam, the coast, the buoy's spectrum, sun, sky, colours and film are reset and then set by
    /// the preset; the seed is kept unless the preset names it. The camera changes only where it is named, and floating
    /// objects that are named replace all others. Time, resolution, views and the window's settings are kept. The image
    /// of a sky file is kept if the preset names the same file, and the file of a coast if the preset's coast is a
    /// file.
    /// [`SkyLook::missing_file_notice`](super::look::SkyLook::missing_file_notice) tells whether the image is missing.
    pub fn apply(&self, now: &Params) -> (Params, Vec<String>) {
        let query::ParsedState { params: wanted, keys_taken, mut notices } = query::parse_with_keys(&self.state);
        let named = |field: &Field| keys_taken.contains(&field.key);
        let mut next = now.clone();
        let mut left = Vec::new();
        for field in FIELDS.iter() {
            let set = match apply_rule(field.group) {
                ApplyRule::SeaAndLight => field.key != SEED_KEY || named(field),
                ApplyRule::Camera => named(field),
                ApplyRule::NeverSet => false,
            };
            if set {
                copy_field(field, &wanted, &mut next);
            } else if named(field) {
                left.push(field.key);
            }
        }
        next.sea.measured = wanted.sea.measured;
        if keys_taken.contains(&query::FLOATING_OBJECTS_KEY) {
            next.floating_objects = wanted.floating_objects;
        }
        let loaded = std::mem::replace(&mut next.look.sky.file, wanted.look.sky.file);
        next.look.sky.adopt_loaded_image(loaded.as_ref());
        next.coast.adopt_file(None);
        if !left.is_empty() {
            let left = left.join(", ");
            notices.push(format!("a named sea does not set these parameters, they keep their values: {left}"));
        }
        (next, notices)
    }

    /// Whether the sea, its coast and the light of `params` are those of this preset. The seed may be another one.
    pub fn shows_sea_of(&self, params: &Params) -> bool {
        let (mut applied, _) = self.apply(params);
        applied.sea.seed = params.sea.seed;
        (&applied.sea, &applied.coast, &applied.look) == (&params.sea, &params.coast, &params.look)
    }

    /// Removes control characters and surrounding white space from all texts, and cuts all but the state string to
    /// their largest length. Writing and reading the result leaves it unchanged.
    #[must_use]
    fn sanitised(self) -> Self {
        Self {
            name: printable_prefix(&self.name, MAX_NAME_CHARS),
            about: printable_prefix(&self.about, MAX_DESCRIPTION_CHARS),
            source: printable_prefix(&self.source, MAX_DESCRIPTION_CHARS),
            state: printable_prefix(&self.state, usize::MAX),
        }
    }
}

fn copy_field(field: &Field, from: &Params, to: &mut Params) {
    (field.set)(to, (field.get)(from));
}

/// Adds the presets `new` to the end of the list `to`. A preset replaces the one of the same name at its place.
///
/// # Errors
/// One sentence if the list would exceed the limits of a file; the list is then unchanged.
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
        return Err(format!("more than {MAX_PRESETS} seas or {kib} KiB cannot be kept: forget some of yours first"));
    }
    *to = all;
    Ok(())
}

/// Writes presets as the text of a preset file, which [`read`] reads; presets without a name are left out.
pub fn write(presets: &[Preset]) -> String {
    let mut out = String::new();
    for preset in presets {
        let Preset { name, about, source, state } = preset.clone().sanitised();
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

/// A preset whose lines are being read from a file.
struct PresetBuilder {
    preset: Preset,
    has_state: bool,
    /// Message to the user about the first fault in the lines of the preset; None if there is none.
    fault: Option<String>,
}

impl PresetBuilder {
    fn new(heading: &str) -> Self {
        let name = printable_prefix(heading, MAX_NAME_CHARS);
        let fault = (name != printable_prefix(heading, usize::MAX))
            .then(|| format!("the name is cut to {MAX_NAME_CHARS} characters"));
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
                self.fault.get_or_insert_with(|| {
                    format!("\"{}\" is not about, source or state: ignored", quoted_excerpt(key))
                });
                return;
            }
        };
        let value = value.trim();
        if !to.is_empty() && !value.is_empty() {
            to.push_str(between);
        }
        to.push_str(value);
    }

    /// Returns the preset, or None if it has no name or no state string or too long a one, and a message to the user
    /// about its first fault, if any.
    fn finish(self) -> (Option<Preset>, Option<String>) {
        let preset = self.preset.sanitised();
        let name = &preset.name;
        let refusal = if name.is_empty() {
            "a sea without a name: ignored".to_owned()
        } else if !self.has_state {
            format!("{name}: no state: ignored")
        } else if preset.state.len() > crate::files::MAX_STATE_BYTES {
            format!("{name}: the state is longer than {} bytes: ignored", crate::files::MAX_STATE_BYTES)
        } else {
            let notice = self.fault.map(|fault| format!("{name}: {fault}"));
            return (Some(preset), notice);
        };
        (None, Some(refusal))
    }
}

/// Reads the text of a preset file: the presets in their order, and one notice for each that was not taken as written.
/// A preset replaces an earlier one of the same name. State strings are not checked here; [`Preset::apply`] notes
/// faults.
pub fn read(text: &str) -> (Vec<Preset>, Vec<String>) {
    let mut presets: Vec<Preset> = Vec::new();
    let mut notices = Vec::new();
    let text = complete_lines_within_limit(text.trim_start_matches('\u{feff}'), &mut notices);
    let mut entry: Option<PresetBuilder> = None;
    let mut strays = 0_usize;
    let mut surplus = 0_usize;
    let mut close = |entry: Option<PresetBuilder>, notices: &mut Vec<String>| {
        let (preset, notice) = entry.map_or((None, None), PresetBuilder::finish);
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
            close(entry.replace(PresetBuilder::new(heading)), &mut notices);
        } else if let Some(entry) = &mut entry {
            entry.line(line);
        } else {
            strays += 1;
        }
    }
    close(entry, &mut notices);
    if strays > 0 {
        notices.push(format!("{strays} line(s) before the first [name]: ignored"));
    }
    if surplus > 0 {
        notices.push(format!("more than {MAX_PRESETS} seas: {surplus} ignored"));
    }
    truncate_notices(&mut notices);
    (presets, notices)
}

/// Reads a list that a user has kept, as [`read`] does. Like a link, a sea without a version has the first one.
pub fn read_kept(text: &str) -> (Vec<Preset>, Vec<String>) {
    let (mut presets, notices) = read(text);
    for preset in &mut presets {
        if !preset.state.split('&').any(|pair| pair.starts_with("v=")) {
            preset.state.insert_str(0, "v=1&");
        }
    }
    (presets, notices)
}

/// Returns the complete lines within the first [`MAX_FILE_BYTES`] bytes of a text, with a notice if it is longer.
fn complete_lines_within_limit<'a>(text: &'a str, notices: &mut Vec<String>) -> &'a str {
    if text.len() <= MAX_FILE_BYTES {
        return text;
    }
    notices.push(format!("the file is longer than {} KiB: the rest was ignored", MAX_FILE_BYTES / 1024));
    let start = &text[..text.floor_char_boundary(MAX_FILE_BYTES)];
    start.rfind('\n').map_or("", |end| &start[..end])
}
