//! One row per parameter. The query codec, the panel, the command-line help and the property tests are made from it.

use super::number::shortest;
use super::params::Params;
use std::sync::LazyLock;

/// Where the panel shows a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Wind and waves.
    Sea,
    /// The second wave system.
    Swell,
    /// Depth, physics and displacement.
    Water,
    /// Whitecaps.
    Foam,
    /// Resolution of the simulation.
    Grid,
    /// Sun and sky.
    Sky,
    /// The look of the water.
    Surface,
    /// Exposure and tone.
    Film,
    /// Detail of what is drawn, and views for the curious.
    View,
    /// Viewpoint.
    Camera,
    /// Simulated time.
    Clock,
    /// The window or the page.
    Screen,
}

impl Group {
    /// Every group, in the order of the panel.
    pub const ALL: [Self; 12] = [
        Self::Sea,
        Self::Swell,
        Self::Water,
        Self::Foam,
        Self::Sky,
        Self::Surface,
        Self::Film,
        Self::View,
        Self::Camera,
        Self::Clock,
        Self::Grid,
        Self::Screen,
    ];

    /// Heading in the panel.
    pub fn label(self) -> &'static str {
        match self {
            Self::Sea => "Sea",
            Self::Swell => "Second system",
            Self::Water => "Water",
            Self::Foam => "Foam",
            Self::Grid => "Resolution",
            Self::Sky => "Sun and sky",
            Self::Surface => "Colour and shine",
            Self::Film => "Film",
            Self::View => "Drawing",
            Self::Camera => "Camera",
            Self::Clock => "Time",
            Self::Screen => "Window",
        }
    }
}

/// What values a parameter takes. All are carried as f64: a choice by its index, a flag as 0 or 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A real number in a closed range; `log` asks for a logarithmic slider.
    Number {
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
        /// Logarithmic scale.
        log: bool,
    },
    /// An angle in degrees, wrapped into [0, 360).
    Heading,
    /// A whole number in a closed range.
    Integer {
        /// Smallest value.
        min: u32,
        /// Largest value.
        max: u32,
    },
    /// One of several words.
    Choice(&'static [&'static str]),
    /// Yes (1) or no (0).
    Flag,
    /// A colour as 0xRRGGBB, sRGB.
    Colour,
}

/// One parameter.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Name in the state string.
    pub key: &'static str,
    /// Name in the panel.
    pub label: &'static str,
    /// Unit of the value, or "".
    pub unit: &'static str,
    /// Where the panel shows it.
    pub group: Group,
    /// Its values.
    pub kind: Kind,
    /// What 0 stands for where it is no quantity, such as "auto"; else "".
    pub zero: &'static str,
    /// Meaning and source.
    pub help: &'static str,
    /// Reads it.
    pub get: fn(&Params) -> f64,
    /// Writes a value that [`Field::accept`] returned.
    pub set: fn(&mut Params, f64),
}

/// The largest colour.
const WHITE: u32 = 0x00ff_ffff;

/// A colour of [`Kind::Colour`] in linear light, red, green and blue from 0 to 1 (IEC 61966-2-1).
pub fn linear_rgb(colour: f64) -> [f64; 3] {
    let bits = colour as u32;
    [16, 8, 0].map(|shift| {
        let encoded = f64::from((bits >> shift) & 0xff) / 255.0;
        if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
    })
}

/// Why a value was not taken as given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// Not a value of this parameter: ignored.
    Ignored,
    /// Outside the range: this value was taken instead.
    Clamped(f64),
}

impl Field {
    /// The row of a parameter whose 0 is no quantity but stands for a word.
    fn zero(self, word: &'static str) -> Self {
        Self { zero: word, ..self }
    }

    /// The default value.
    pub fn default_value(&self) -> f64 {
        (self.get)(&Params::default())
    }

    /// The nearest allowed value, and whether that is another one than `value`; not-a-number and infinities have none.
    pub fn accept(&self, value: f64) -> Result<f64, Refusal> {
        if !value.is_finite() {
            return Err(Refusal::Ignored);
        }
        let taken = match self.kind {
            Kind::Number { min, max, .. } => value.clamp(min, max) + 0.0, // + 0.0 turns -0 into 0
            Kind::Heading => return Ok(wrap_degrees(value)),
            Kind::Integer { min, max } => value.round().clamp(f64::from(min), f64::from(max)),
            Kind::Choice(words) => value.round().clamp(0.0, words.len() as f64 - 1.0),
            Kind::Flag => f64::from(u8::from(value != 0.0)),
            Kind::Colour => value.round().clamp(0.0, f64::from(WHITE)),
        };
        if taken == value { Ok(taken) } else { Err(Refusal::Clamped(taken)) }
    }

    /// Reads a value as it stands in a state string.
    pub fn parse(&self, text: &str) -> Result<f64, Refusal> {
        let text = text.trim();
        match self.kind {
            Kind::Choice(words) => {
                words.iter().position(|w| w.eq_ignore_ascii_case(text)).map(|i| i as f64).ok_or(Refusal::Ignored)
            }
            Kind::Flag => match text {
                "1" | "true" | "yes" | "on" | "" => Ok(1.0),
                "0" | "false" | "no" | "off" => Ok(0.0),
                _ => Err(Refusal::Ignored),
            },
            Kind::Colour if !self.zero.is_empty() && text.eq_ignore_ascii_case(self.zero) => Ok(0.0),
            Kind::Colour => {
                let digits = text.strip_prefix('#').unwrap_or(text);
                let hex = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
                u32::from_str_radix(digits, 16).ok().filter(|_| hex).map(f64::from).ok_or(Refusal::Ignored)
            }
            _ => self.accept(text.parse().map_err(|_| Refusal::Ignored)?),
        }
    }

    /// Writes a value for a state string: the shortest text that reads back to the same number.
    pub fn format(&self, value: f64) -> String {
        match self.kind {
            Kind::Choice(words) => words.get(value as usize).copied().unwrap_or_default().to_owned(),
            Kind::Colour if value == 0.0 && !self.zero.is_empty() => self.zero.to_owned(),
            Kind::Colour => format!("{:06x}", value as u32),
            _ => shortest(value),
        }
    }

    /// The range in words, for help and tooltips.
    pub fn range(&self) -> String {
        match self.kind {
            Kind::Number { min, max, .. } if !self.zero.is_empty() => format!("{min} ({}) to {max}", self.zero),
            Kind::Integer { min, max } if !self.zero.is_empty() => format!("{min} ({}) to {max}", self.zero),
            Kind::Number { min, max, .. } => format!("{min} to {max}"),
            Kind::Heading => "0 to 360".to_owned(),
            Kind::Integer { min, max } => format!("{min} to {max}"),
            Kind::Choice(words) => words.join(", "),
            Kind::Flag => "0 or 1".to_owned(),
            Kind::Colour if !self.zero.is_empty() => format!("{}, or a colour as rrggbb", self.zero),
            Kind::Colour => "a colour as rrggbb".to_owned(),
        }
    }
}

/// Looks a parameter up by its key.
pub fn find(key: &str) -> Option<&'static Field> {
    FIELDS.iter().find(|f| f.key == key)
}

fn wrap_degrees(value: f64) -> f64 {
    let wrapped = value.rem_euclid(360.0);
    if wrapped >= 360.0 { 0.0 } else { wrapped + 0.0 }
}

/// A table of words and what they stand for, and the words alone.
macro_rules! words {
    ($table:ident, $words:ident, $kind:ty, $($word:literal => $value:expr),+ $(,)?) => {
        pub(crate) const $table: &[(&str, $kind)] = &[$(($word, $value)),+];
        pub(crate) const $words: &[&str] = &[$($word),+];
    };
}

fn index_of<T: PartialEq>(table: &[(&str, T)], value: &T) -> f64 {
    table.iter().position(|(_, v)| v == value).unwrap_or(0) as f64
}

const fn number(min: f64, max: f64) -> Kind {
    Kind::Number { min, max, log: false }
}

const fn logarithmic(min: f64, max: f64) -> Kind {
    Kind::Number { min, max, log: true }
}

/// Builds a row; the accessor is a place inside `Params`, or a choice with its table there.
macro_rules! row {
    ($key:expr, $label:expr, $unit:literal, $group:ident, $kind:expr, [$($place:tt)+], $help:expr) => {
        row!($key, $label, $unit, $group, $kind, $help, |p| p.$($place)+, |p, v| p.$($place)+ = v)
    };
    ($key:expr, $label:expr, $group:ident, $words:ident of $table:ident, [$($place:tt)+], $help:expr) => {
        row!($key, $label, "", $group, Kind::Choice($words), $help,
            |p| index_of($table, &p.$($place)+), |p, v| p.$($place)+ = $table[v as usize].1)
    };
    ($key:expr, $label:expr, $group:ident, flag [$($place:tt)+], $help:expr) => {
        row!($key, $label, "", $group, Kind::Flag, $help,
            |p| f64::from(u8::from(p.$($place)+)), |p, v| p.$($place)+ = v != 0.0)
    };
    ($key:expr, $label:expr, $unit:literal, $group:ident, $kind:expr, $help:expr, $get:expr, $set:expr) => {
        Field { key: $key, label: $label, unit: $unit, group: Group::$group, kind: $kind, zero: "", help: $help, get: $get, set: $set }
    };
}

mod look;
mod sea;
pub(crate) mod spectrum;
mod view;

/// Every parameter, in the order in which the state string writes them.
pub static FIELDS: LazyLock<Vec<Field>> = LazyLock::new(|| {
    [
        sea::systems(),
        sea::water(),
        sea::whitecaps(),
        look::sky(),
        look::surface(),
        look::film(),
        view::detail(),
        view::views(),
        view::camera(),
        view::grid(),
        view::patches(),
        view::screen(),
    ]
    .concat()
});
