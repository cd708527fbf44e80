//! Fields: descriptions of parameters (key, label, unit, allowed values, help) with functions to read and write them.
//!
//! The macro [`parameters!`] declares a struct of parameters with a field for each member; [`choice_enum!`] declares an
//! enum with a word for each variant. [`fields`](super::fields) collects the fields of all structs in one list.

use super::text::shortest_decimal;

/// Declares an enum for a parameter's value. Each variant has a word, its text in a state string or in the panel.
macro_rules! choice_enum {
    (
        $(#[$doc:meta])*
        pub enum $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $word:literal),+ $(,)? }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$variant_doc])* $variant),+ }

        impl $name {
            /// All variants of the enum, in the order of declaration, which is that of [`Self::WORDS`].
            pub const ALL: [Self; Self::WORDS.len()] = [$(Self::$variant),+];
            /// Text of each variant for the state string or the panel, in the order of declaration.
            pub const WORDS: &'static [&'static str] = &[$($word),+];

            /// Text of this variant in the state string or the panel, from [`Self::WORDS`].
            pub fn word(self) -> &'static str {
                Self::WORDS[self as usize]
            }
        }

        impl $crate::state::field::FieldValue for $name {
            fn to_f64(self) -> f64 {
                f64::from(self as u8)
            }

            fn from_f64(value: f64) -> Self {
                Self::ALL[value as usize]
            }
        }
    };
}

/// Declares a struct of parameters, its `Default`, and a function `fields` that returns a [`FieldDescription`] (key,
/// label, unit, range, help) of each member.
///
/// A member is written `name: type = default => ("key", "Label", "unit", kind)`. An optional fifth entry is the word
/// that stands for the value 0, such as "auto". The doc comment of a member is also the help text that users read. A
/// member without `=>` has no description.
macro_rules! parameters {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $(
                $(#[doc = $help:literal])+
                $member:ident: $type:ty = $default:expr
                $(=> ($key:literal, $label:literal, $unit:literal, $kind:expr $(, $zero_word:literal)?))?
            ),+ $(,)?
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name { $($(#[doc = $help])+ pub $member: $type),+ }

        impl Default for $name {
            fn default() -> Self {
                Self { $($member: $default),+ }
            }
        }

        impl $name {
            /// Returns descriptions (key, label, unit, range, help) of the parameters in this struct, for the section
            /// `group` of the panel. `part` and `part_mut` find the struct in `P`, the struct of all parameters.
            pub(in crate::state) fn fields<P: 'static>(
                group: $crate::state::field::Group,
                part: fn(&P) -> &Self,
                part_mut: fn(&mut P) -> &mut Self,
            ) -> Vec<$crate::state::field::FieldDescription<P>> {
                let fields = [$(
                    parameters!(@field group, part, part_mut, $member, ($($help)+)
                        $(, $key, $label, $unit, $kind $(, $zero_word)?)?)
                ),+];
                fields.into_iter().flatten().collect()
            }
        }
    };
    (@field $group:ident, $part:ident, $part_mut:ident, $member:ident, ($($help:literal)+)) => {
        None
    };
    (
        @field $group:ident, $part:ident, $part_mut:ident, $member:ident, ($($help:literal)+),
        $key:literal, $label:literal, $unit:literal, $kind:expr $(, $zero_word:literal)?
    ) => {
        Some($crate::state::field::FieldDescription {
            key: $key,
            label: $label,
            unit: $unit,
            group: $group,
            kind: $kind,
            zero_word: concat!($($zero_word)?),
            // Each line of a doc comment begins with a space, which also separates the lines.
            help: concat!($($help),+).trim_start(),
            get: Box::new(move |p| $crate::state::field::FieldValue::to_f64($part(p).$member)),
            set: Box::new(move |p, value| $part_mut(p).$member = $crate::state::field::FieldValue::from_f64(value)),
        })
    };
}

pub(super) use {choice_enum, parameters};

choice_enum! {
    /// Group of parameters: a section of the control panel and of docs/parameters.md, in the order of the variants. The
    /// word of a variant is the heading of its section.
    pub enum Group {
        /// Parameters of the first wave system: wind, spectrum and directional spreading.
        Sea = "Sea",
        /// Parameters of the second wave system, such as the swell of a distant storm.
        SecondSystem = "Second system",
        /// Parameters of the third wave system, such as long swell from another ocean.
        ThirdSystem = "Third system",
        /// Parameters of the fourth wave system, such as the remains of an older wind sea.
        FourthSystem = "Fourth system",
        /// Parameters of all waves: water depth, dispersion relation, physical constants, choppiness and random seed.
        Water = "Water",
        /// Parameters of whitecaps: when foam forms, how it decays and what it looks like.
        Foam = "Foam",
        /// Parameters of the coast: which one, and where it lies.
        Coast = "Coast",
        /// Parameters of sun, sky, haze and fog.
        Sky = "Sun and sky",
        /// Parameters of the colour, reflectance and roughness of the water, and of the sea bed.
        Surface = "Colour and shine",
        /// Parameters of exposure, tone mapping, bloom and dither.
        Film = "Film",
        /// Parameters of drawing: detail and extent of the water mesh, and the false-colour views.
        View = "Drawing",
        /// Parameters of the camera: position, direction, field of view and control mode.
        Camera = "Camera",
        /// Parameters of time: the simulated time, its speed, and the period after which the sea repeats.
        Clock = "Time",
        /// Parameters of the resolution: FFT size and cascades (patches of sea, each with its own FFT).
        Grid = "Resolution",
        /// Parameters of the window or web page: panel, units and render scale.
        Screen = "Window",
    }
}

impl Group {
    /// Heading of this group of parameters in the control panel.
    pub fn label(self) -> &'static str {
        self.word()
    }

    /// Index in [`Sea::systems`](super::params::Sea::systems) of the wave system that this group sets, 1 to 3, if the
    /// group belongs to a system beside the local wind sea.
    pub fn further_system_index(self) -> Option<usize> {
        [Self::SecondSystem, Self::ThirdSystem, Self::FourthSystem].iter().position(|g| *g == self).map(|i| i + 1)
    }
}

/// Type and range of a parameter's value. Every value is carried as f64: a choice as its index, a flag as 0 or 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FieldKind {
    /// Real number from `min` to `max`, both included.
    Number {
        /// Smallest allowed value, in the unit of the parameter.
        min: f64,
        /// Largest allowed value, in the unit of the parameter.
        max: f64,
        /// Whether the slider in the control panel has a logarithmic scale.
        log: bool,
    },
    /// Compass angle in degrees; other values are wrapped into [0, 360).
    Heading,
    /// Whole number from `min` to `max`, both included.
    Integer {
        /// Smallest allowed value, in the unit of the parameter.
        min: u32,
        /// Largest allowed value, in the unit of the parameter.
        max: u32,
    },
    /// One of the given words; the value is the index of the word.
    Choice(&'static [&'static str]),
    /// Switch: on (1) or off (0).
    Flag,
    /// Colour in sRGB; the value is the whole number 0xRRGGBB.
    Colour,
}

/// Makes the [`FieldKind`] of a real number from `min` to `max` that has a linear slider in the panel.
pub(super) const fn number(min: f64, max: f64) -> FieldKind {
    FieldKind::Number { min, max, log: false }
}

/// Makes the [`FieldKind`] of a real number from `min` to `max` that has a logarithmic slider in the panel.
pub(super) const fn logarithmic(min: f64, max: f64) -> FieldKind {
    FieldKind::Number { min, max, log: true }
}

/// Makes the [`FieldKind`] of a whole number from `min` to `max`.
pub(super) const fn integer(min: u32, max: u32) -> FieldKind {
    FieldKind::Integer { min, max }
}

/// White as 0xRRGGBB, which is the largest value of a [`FieldKind::Colour`].
pub(super) const WHITE_RGB: f64 = 0x00ff_ffff as f64;

/// Converts an sRGB colour 0xRRGGBB to linear red, green and blue, each 0 to 1 (IEC 61966-2-1).
pub fn linear_rgb(colour: f64) -> [f64; 3] {
    let bits = colour as u32;
    [16, 8, 0].map(|shift| {
        let encoded = f64::from((bits >> shift) & 0xff) / 255.0;
        if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
    })
}

/// Type of a parameter, with conversions to and from f64, in which [`FieldDescription`] carries all values.
pub(super) trait FieldValue: Copy {
    /// Converts the value to f64: a choice to its index, a flag to 0 or 1.
    fn to_f64(self) -> f64;
    /// Converts back from an f64 that [`FieldDescription::check_value`] or [`FieldDescription::parse`] returned.
    fn from_f64(value: f64) -> Self;
}

impl FieldValue for f64 {
    fn to_f64(self) -> f64 {
        self
    }

    fn from_f64(value: f64) -> Self {
        value
    }
}

impl FieldValue for u32 {
    fn to_f64(self) -> f64 {
        self.into()
    }

    fn from_f64(value: f64) -> Self {
        value as Self
    }
}

impl FieldValue for bool {
    fn to_f64(self) -> f64 {
        u8::from(self).into()
    }

    fn from_f64(value: f64) -> Self {
        value != 0.0
    }
}

/// Description of one parameter: key, label, unit, range, help, and functions that read and write its value in `P`, the
/// struct of all parameters.
pub struct FieldDescription<P> {
    /// Key of the parameter in the state string, such as `wind`.
    pub key: &'static str,
    /// Label of the parameter in the control panel.
    pub label: &'static str,
    /// Unit of the value, such as "m/s"; empty if it has none.
    pub unit: &'static str,
    /// Section of the control panel that shows the parameter.
    pub group: Group,
    /// Type and range of the allowed values.
    pub kind: FieldKind,
    /// Word for the value 0 where 0 has a special meaning, such as "auto" or "off"; else empty.
    pub zero_word: &'static str,
    /// Help text: meaning of the parameter, and the paper that it comes from.
    pub help: &'static str,
    /// Function that reads the parameter in the struct `P` of all parameters: a choice as index, a flag as 0 or 1.
    pub get: Box<dyn Fn(&P) -> f64 + Send + Sync>,
    /// Function that writes a value to the parameter in the struct `P` of all parameters. The value must be one that
    /// [`Self::check_value`] or [`Self::parse`] returned.
    pub set: Box<dyn Fn(&mut P, f64) + Send + Sync>,
}

/// What happens to a parameter value that is not allowed: it is ignored, or the nearest allowed value is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InvalidValue {
    /// The value has no meaning for the parameter, such as an unknown word; the parameter is not changed.
    Ignored,
    /// The value is out of range, or a fraction where a whole number is needed; the nearest allowed value, given here,
    /// is taken.
    Clamped(f64),
}

impl<P: Default> FieldDescription<P> {
    /// Default value of the parameter: a choice as its index, a flag as 0 or 1.
    pub fn default_value(&self) -> f64 {
        (self.get)(&P::default())
    }
}

impl<P> FieldDescription<P> {
    /// Checks a value and returns it if it is allowed; headings are wrapped. Otherwise returns the nearest allowed
    /// value as [`InvalidValue::Clamped`], or [`InvalidValue::Ignored`] for NaN and infinities.
    pub fn check_value(&self, value: f64) -> Result<f64, InvalidValue> {
        if !value.is_finite() {
            return Err(InvalidValue::Ignored);
        }
        let taken = match self.kind {
            FieldKind::Number { min, max, .. } => value.clamp(min, max) + 0.0, // + 0.0 turns -0 into 0
            FieldKind::Heading => return Ok(wrap_degrees(value)),
            FieldKind::Integer { min, max } => value.round().clamp(min.into(), max.into()),
            FieldKind::Choice(words) => value.round().clamp(0.0, words.len() as f64 - 1.0),
            FieldKind::Flag => f64::from(u8::from(value != 0.0)),
            FieldKind::Colour => value.round().clamp(0.0, WHITE_RGB),
        };
        if taken == value { Ok(taken) } else { Err(InvalidValue::Clamped(taken)) }
    }

    /// Parses the text of a value in a state string: a word of a choice, a flag, a hexadecimal colour or a number. An
    /// error says whether the value is ignored or clamped.
    pub fn parse(&self, text: &str) -> Result<f64, InvalidValue> {
        let text = text.trim();
        match self.kind {
            FieldKind::Choice(words) => {
                let position = |word: &str| words.iter().position(|w| w.eq_ignore_ascii_case(word)).map(|i| i as f64);
                // A choice that has the words 0 and 1 was once a flag.
                let as_flag = || flag_value(text).and_then(|on| position(if on { "1" } else { "0" }));
                position(text).or_else(as_flag).ok_or(InvalidValue::Ignored)
            }
            FieldKind::Flag => flag_value(text).map(|on| f64::from(u8::from(on))).ok_or(InvalidValue::Ignored),
            FieldKind::Colour if !self.zero_word.is_empty() && text.eq_ignore_ascii_case(self.zero_word) => Ok(0.0),
            FieldKind::Colour => {
                let digits = text.strip_prefix('#').unwrap_or(text);
                let hex = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
                u32::from_str_radix(digits, 16).ok().filter(|_| hex).map(f64::from).ok_or(InvalidValue::Ignored)
            }
            _ => self.check_value(text.parse().map_err(|_| InvalidValue::Ignored)?),
        }
    }

    /// Formats a value for a state string as the shortest text that parses to the same value.
    pub fn format(&self, value: f64) -> String {
        match self.kind {
            FieldKind::Choice(words) => words.get(value as usize).copied().unwrap_or_default().to_owned(),
            FieldKind::Colour if value == 0.0 && !self.zero_word.is_empty() => self.zero_word.to_owned(),
            FieldKind::Colour => format!("{:06x}", value as u32),
            _ => shortest_decimal(value),
        }
    }

    /// Says in words what a value must be, such as "it must be a number from 0 (auto) to 30".
    pub fn needed_value_text(&self) -> String {
        let allowed = self.allowed_values_text();
        match self.kind {
            FieldKind::Number { .. } | FieldKind::Heading => format!("it must be a number from {allowed}"),
            FieldKind::Integer { .. } => format!("it must be a whole number from {allowed}"),
            FieldKind::Flag | FieldKind::Choice(_) => format!("it must be one of {allowed}"),
            FieldKind::Colour => format!("it must be {allowed}"),
        }
    }

    /// Describes the allowed values for help texts and tooltips, such as "0 (auto) to 30".
    pub fn allowed_values_text(&self) -> String {
        let zero_word = if self.zero_word.is_empty() { String::new() } else { format!(" ({})", self.zero_word) };
        match self.kind {
            FieldKind::Number { min, max, .. } => format!("{min}{zero_word} to {max}"),
            FieldKind::Heading => "0 to 360".to_owned(),
            FieldKind::Integer { min, max } => format!("{min}{zero_word} to {max}"),
            FieldKind::Choice(words) => words.join(", "),
            FieldKind::Flag => "0 or 1".to_owned(),
            FieldKind::Colour if !self.zero_word.is_empty() => format!("{}, or a colour as rrggbb", self.zero_word),
            FieldKind::Colour => "a colour as rrggbb".to_owned(),
        }
    }
}

/// Value of a flag's text in a state string; `None` if it is no such text.
fn flag_value(text: &str) -> Option<bool> {
    match text {
        "1" | "true" | "yes" | "on" | "" => Some(true),
        "0" | "false" | "no" | "off" => Some(false),
        _ => None,
    }
}

/// Wraps an angle in degrees into [0, 360).
fn wrap_degrees(value: f64) -> f64 {
    let wrapped = value.rem_euclid(360.0);
    if wrapped >= 360.0 { 0.0 } else { wrapped + 0.0 }
}
