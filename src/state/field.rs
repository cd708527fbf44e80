//! Fields: the name, the allowed values and the access functions of a parameter.
//!
//! [`parameters!`] declares a struct together with the fields of its members, [`words!`] an enum for a choice. Both
//! know no particular struct; [`fields`](super::fields) collects the fields of all of them.

use super::text::shortest;

/// Declares an enum with a word for each variant; the words are the values of a [`FieldKind::Choice`].
macro_rules! words {
    (
        $(#[$doc:meta])*
        pub enum $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $word:literal),+ $(,)? }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$variant_doc])* $variant),+ }

        impl $name {
            /// All variants, in the order of [`Self::WORDS`].
            pub const ALL: [Self; Self::WORDS.len()] = [$(Self::$variant),+];
            /// The word of each variant.
            pub const WORDS: &'static [&'static str] = &[$($word),+];

            /// The word of this variant.
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

/// Declares a struct of parameters, its default values and the fields of its members.
///
/// A member is written `name: type = default => ("key", "Label", "unit", kind)`. Where the value 0 stands for a word
/// such as "auto", that word is the fifth entry. The doc comment of the member is the help text that users read. A
/// member without `=>` has no field.
macro_rules! parameters {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $(
                $(#[doc = $help:literal])+
                $member:ident: $type:ty = $default:expr
                $(=> ($key:literal, $label:literal, $unit:literal, $kind:expr $(, $zero:literal)?))?
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
            /// The fields of this struct as a part of `P`.
            pub(in crate::state) fn fields<P: 'static>(
                group: $crate::state::field::Group,
                part: fn(&P) -> &Self,
                part_mut: fn(&mut P) -> &mut Self,
            ) -> Vec<$crate::state::field::FieldOf<P>> {
                let fields = [$(
                    parameters!(@field group, part, part_mut, $member, ($($help)+)
                        $(, $key, $label, $unit, $kind $(, $zero)?)?)
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
        $key:literal, $label:literal, $unit:literal, $kind:expr $(, $zero:literal)?
    ) => {
        Some($crate::state::field::FieldOf {
            key: $key,
            label: $label,
            unit: $unit,
            group: $group,
            kind: $kind,
            zero: concat!($($zero)?),
            // Each line of a doc comment begins with a blank.
            help: concat!($($help),+).trim_start(),
            get: Box::new(move |p| $crate::state::field::FieldValue::to_f64($part(p).$member)),
            set: Box::new(move |p, value| $part_mut(p).$member = $crate::state::field::FieldValue::from_f64(value)),
        })
    };
}

pub(super) use {parameters, words};

words! {
    /// Section of the panel that shows a parameter, in the order of the panel; the words are the headings.
    pub enum Group {
        /// Wind and waves.
        Sea = "Sea",
        /// The second wave system.
        Swell = "Second system",
        /// Depth, physics and displacement.
        Water = "Water",
        /// Whitecaps.
        Foam = "Foam",
        /// Sun and sky.
        Sky = "Sun and sky",
        /// Colour and reflection of the water.
        Surface = "Colour and shine",
        /// Exposure and tone curve.
        Film = "Film",
        /// Mesh and views.
        View = "Drawing",
        /// Viewpoint.
        Camera = "Camera",
        /// Simulated time.
        Clock = "Time",
        /// Resolution of the simulation.
        Grid = "Resolution",
        /// The window or the page.
        Screen = "Window",
    }
}

impl Group {
    /// Heading in the panel.
    pub fn label(self) -> &'static str {
        self.word()
    }
}

/// The values that a parameter can take. All are carried as f64: a choice by its index, a flag as 0 or 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FieldKind {
    /// A real number in a closed range.
    Number {
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
        /// Whether the slider is logarithmic.
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
    /// An sRGB colour as 0xRRGGBB.
    Colour,
}

/// A number with a linear slider.
pub(super) const fn number(min: f64, max: f64) -> FieldKind {
    FieldKind::Number { min, max, log: false }
}

/// A number with a logarithmic slider.
pub(super) const fn logarithmic(min: f64, max: f64) -> FieldKind {
    FieldKind::Number { min, max, log: true }
}

/// A whole number.
pub(super) const fn integer(min: u32, max: u32) -> FieldKind {
    FieldKind::Integer { min, max }
}

/// White as 0xRRGGBB, the largest value of a colour.
pub(super) const WHITE: f64 = 0x00ff_ffff as f64;

/// A colour of [`FieldKind::Colour`] in linear light: red, green and blue, 0..1 (IEC 61966-2-1).
pub fn linear_rgb(colour: f64) -> [f64; 3] {
    let bits = colour as u32;
    [16, 8, 0].map(|shift| {
        let encoded = f64::from((bits >> shift) & 0xff) / 255.0;
        if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
    })
}

/// A type of a parameter and its conversion to the f64 that a field carries.
pub(super) trait FieldValue: Copy {
    /// The number of this value.
    fn to_f64(self) -> f64;
    /// The value of a number that [`FieldOf::accept`] returned.
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

/// One parameter of a set of parameters `P`.
pub struct FieldOf<P> {
    /// Name in the state string.
    pub key: &'static str,
    /// Name in the panel.
    pub label: &'static str,
    /// Unit of the value, or "".
    pub unit: &'static str,
    /// Section of the panel.
    pub group: Group,
    /// Allowed values.
    pub kind: FieldKind,
    /// Word for the value 0 where 0 is no quantity, such as "auto"; else "".
    pub zero: &'static str,
    /// Meaning and source.
    pub help: &'static str,
    /// Reads the value.
    pub get: Box<dyn Fn(&P) -> f64 + Send + Sync>,
    /// Writes a value that [`Self::accept`] returned.
    pub set: Box<dyn Fn(&mut P, f64) + Send + Sync>,
}

/// The reason why a value was not taken as given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// It is no value of this parameter and is ignored.
    Ignored,
    /// It is outside the range; this value is taken instead.
    Clamped(f64),
}

impl<P: Default> FieldOf<P> {
    /// The default value.
    pub fn default_value(&self) -> f64 {
        (self.get)(&P::default())
    }
}

impl<P> FieldOf<P> {
    /// The value if it is allowed, else the nearest allowed value as a refusal; NaN and infinities are ignored.
    pub fn accept(&self, value: f64) -> Result<f64, Refusal> {
        if !value.is_finite() {
            return Err(Refusal::Ignored);
        }
        let taken = match self.kind {
            FieldKind::Number { min, max, .. } => value.clamp(min, max) + 0.0, // + 0.0 turns -0 into 0
            FieldKind::Heading => return Ok(wrap_degrees(value)),
            FieldKind::Integer { min, max } => value.round().clamp(min.into(), max.into()),
            FieldKind::Choice(words) => value.round().clamp(0.0, words.len() as f64 - 1.0),
            FieldKind::Flag => f64::from(u8::from(value != 0.0)),
            FieldKind::Colour => value.round().clamp(0.0, WHITE),
        };
        if taken == value { Ok(taken) } else { Err(Refusal::Clamped(taken)) }
    }

    /// Reads a value of a state string.
    pub fn parse(&self, text: &str) -> Result<f64, Refusal> {
        let text = text.trim();
        match self.kind {
            FieldKind::Choice(words) => {
                words.iter().position(|w| w.eq_ignore_ascii_case(text)).map(|i| i as f64).ok_or(Refusal::Ignored)
            }
            FieldKind::Flag => match text {
                "1" | "true" | "yes" | "on" | "" => Ok(1.0),
                "0" | "false" | "no" | "off" => Ok(0.0),
                _ => Err(Refusal::Ignored),
            },
            FieldKind::Colour if !self.zero.is_empty() && text.eq_ignore_ascii_case(self.zero) => Ok(0.0),
            FieldKind::Colour => {
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
            FieldKind::Choice(words) => words.get(value as usize).copied().unwrap_or_default().to_owned(),
            FieldKind::Colour if value == 0.0 && !self.zero.is_empty() => self.zero.to_owned(),
            FieldKind::Colour => format!("{:06x}", value as u32),
            _ => shortest(value),
        }
    }

    /// The allowed values in words, for help texts and tooltips.
    pub fn range(&self) -> String {
        let zero = if self.zero.is_empty() { String::new() } else { format!(" ({})", self.zero) };
        match self.kind {
            FieldKind::Number { min, max, .. } => format!("{min}{zero} to {max}"),
            FieldKind::Heading => "0 to 360".to_owned(),
            FieldKind::Integer { min, max } => format!("{min}{zero} to {max}"),
            FieldKind::Choice(words) => words.join(", "),
            FieldKind::Flag => "0 or 1".to_owned(),
            FieldKind::Colour if !self.zero.is_empty() => format!("{}, or a colour as rrggbb", self.zero),
            FieldKind::Colour => "a colour as rrggbb".to_owned(),
        }
    }
}

/// An angle in degrees, wrapped into [0, 360).
fn wrap_degrees(value: f64) -> f64 {
    let wrapped = value.rem_euclid(360.0);
    if wrapped >= 360.0 { 0.0 } else { wrapped + 0.0 }
}
