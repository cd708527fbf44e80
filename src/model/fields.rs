//! One row per parameter. The query codec, the panel, the command-line help and the property tests are made from it.

use super::params::{Params, SpectrumKind, SpreadKind};

/// Where the panel shows a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Wind, waves and water.
    Sea,
    /// Whitecaps.
    Foam,
    /// Resolution of the simulation.
    Grid,
    /// Light, sky and film.
    Look,
    /// Viewpoint.
    Camera,
    /// Simulated time.
    Clock,
}

impl Group {
    /// Every group, in the order of the panel.
    pub const ALL: [Self; 6] = [Self::Sea, Self::Foam, Self::Look, Self::Camera, Self::Clock, Self::Grid];

    /// Heading in the panel.
    pub fn label(self) -> &'static str {
        match self {
            Self::Sea => "Sea",
            Self::Foam => "Foam",
            Self::Grid => "Resolution",
            Self::Look => "Light",
            Self::Camera => "Camera",
            Self::Clock => "Time",
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
    /// Meaning and source.
    pub help: &'static str,
    /// Reads it.
    pub get: fn(&Params) -> f64,
    /// Writes a value that [`Field::accept`] returned.
    pub set: fn(&mut Params, f64),
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
            _ => self.accept(text.parse().map_err(|_| Refusal::Ignored)?),
        }
    }

    /// Writes a value for a state string: the shortest text that reads back to the same number.
    pub fn format(&self, value: f64) -> String {
        match self.kind {
            Kind::Choice(words) => words.get(value as usize).copied().unwrap_or_default().to_owned(),
            _ => format!("{value}"),
        }
    }

    /// The range in words, for help and tooltips.
    pub fn range(&self) -> String {
        match self.kind {
            Kind::Number { min, max, .. } => format!("{min} to {max}"),
            Kind::Heading => "0 to 360".to_owned(),
            Kind::Integer { min, max } => format!("{min} to {max}"),
            Kind::Choice(words) => words.join(", "),
            Kind::Flag => "0 or 1".to_owned(),
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

const SPECTRA: [(&str, SpectrumKind); 3] =
    [("pm", SpectrumKind::PiersonMoskowitz), ("jonswap", SpectrumKind::Jonswap), ("tma", SpectrumKind::Tma)];
const SPECTRUM_WORDS: [&str; 3] = [SPECTRA[0].0, SPECTRA[1].0, SPECTRA[2].0];
const SPREADS: [(&str, SpreadKind); 4] = [
    ("isotropic", SpreadKind::Isotropic),
    ("mitsuyasu", SpreadKind::Mitsuyasu),
    ("hasselmann", SpreadKind::Hasselmann),
    ("donelan-banner", SpreadKind::DonelanBanner),
];
const SPREAD_WORDS: [&str; 4] = [SPREADS[0].0, SPREADS[1].0, SPREADS[2].0, SPREADS[3].0];
const SIZES: [u32; 5] = [64, 128, 256, 512, 1024];

fn index_of<T: PartialEq>(table: &[(&str, T)], value: &T) -> f64 {
    table.iter().position(|(_, v)| v == value).unwrap_or(0) as f64
}

const fn number(min: f64, max: f64) -> Kind {
    Kind::Number { min, max, log: false }
}

const fn logarithmic(min: f64, max: f64) -> Kind {
    Kind::Number { min, max, log: true }
}

/// Builds a row; the accessor is a place inside `Params`.
macro_rules! row {
    ($key:literal, $label:literal, $unit:literal, $group:ident, $kind:expr, $($place:ident).+, $help:literal) => {
        row!($key, $label, $unit, $group, $kind, $help, |p| p.$($place).+, |p, v| p.$($place).+ = v)
    };
    ($key:literal, $label:literal, $unit:literal, $group:ident, $kind:expr, $help:literal, $get:expr, $set:expr) => {
        Field { key: $key, label: $label, unit: $unit, group: Group::$group, kind: $kind, help: $help, get: $get, set: $set }
    };
}

/// Every parameter, in the order in which the state string writes them.
#[rustfmt::skip]
pub static FIELDS: &[Field] = &[
    row!("spectrum", "Spectrum", "", Sea, Kind::Choice(&SPECTRUM_WORDS),
        "Frequency spectrum: pm is a fully developed sea, jonswap a fetch-limited one (Hasselmann et al. 1973), tma the same in shallow water (Bouws et al. 1985).",
        |p| index_of(&SPECTRA, &p.sea.spectrum), |p, v| p.sea.spectrum = SPECTRA[v as usize].1),
    row!("wind", "Wind", "m/s", Sea, number(0.0, 60.0), sea.wind_m_s,
        "Wind speed 10 m above the sea. Beaufort 4 is about 7, a gale (Beaufort 8) about 19, a hurricane above 33 m/s."),
    row!("fetch", "Fetch", "km", Sea, logarithmic(0.5, 2000.0), sea.fetch_km,
        "Distance over which the wind has blown: longer fetch, longer and higher waves (Hasselmann et al. 1973)."),
    row!("dir", "Wind from", "deg", Sea, Kind::Heading, sea.from_deg,
        "Direction the wind comes from, clockwise from north, as in a forecast. The waves run the other way."),
    row!("depth", "Depth", "m", Sea, logarithmic(1.0, 11000.0), sea.depth_m,
        "Water depth: slows and steepens long waves (omega^2 = g k tanh(k h)); with tma it also limits their energy."),
    row!("gamma", "Peak gamma", "", Sea, number(1.0, 10.0), sea.gamma,
        "Peak enhancement of jonswap and tma: 1 is a broad peak, 3.3 the mean of the JONSWAP experiment, 7 a young sea."),
    row!("spread", "Spreading", "", Sea, Kind::Choice(&SPREAD_WORDS),
        "How the energy spreads over directions around the wind (Mitsuyasu 1975, Hasselmann 1980, Donelan 1985 with Banner 1990).",
        |p| index_of(&SPREADS, &p.sea.spread), |p, v| p.sea.spread = SPREADS[v as usize].1),
    row!("swell", "Swell", "", Sea, number(0.0, 1.0), sea.swell,
        "Narrows the direction of the long waves into parallel swell; the height stays (Horvath 2015)."),
    row!("chop", "Chop", "", Sea, number(0.0, 2.0), sea.chop,
        "Horizontal displacement: 1 is what linear theory gives and sharpens the crests, 0 leaves a sum of sines."),
    row!("height", "Height scale", "", Sea, logarithmic(0.1, 4.0), sea.height,
        "Scale on all displacements: 1 is the physical height. For those who want drama."),
    row!("g", "Gravity", "m/s2", Sea, logarithmic(0.5, 30.0), sea.gravity_m_s2,
        "Acceleration of gravity: Earth 9.81, Titan 1.35, Mars 3.71."),
    row!("seed", "Seed", "", Sea, Kind::Integer { min: 0, max: 4_294_967_295 },
        "Chooses one sea among all those of the same statistics.",
        |p| f64::from(p.sea.seed), |p, v| p.sea.seed = v as u32),
    row!("loop", "Loop", "s", Clock, number(0.0, 3600.0), sea.loop_s,
        "Period after which the sea repeats exactly; 0 means never (a day). Every wave's frequency is rounded to fit."),
    row!("foam", "Foam shown", "", Foam, number(0.0, 2.0), look.foam,
        "Visible amount of foam; 1 shows the coverage that was computed."),
    row!("foamdecay", "Foam decay", "s", Foam, logarithmic(0.5, 30.0), sea.foam_decay_s,
        "Time in which foam fades to 1/e. Whitecap patches last 2 to 10 s (Monahan 1971)."),
    row!("foamrate", "Foam growth", "1/s", Foam, logarithmic(0.1, 10.0), sea.foam_rate_per_s,
        "How fast foam forms where a crest breaks."),
    row!("sun", "Sun height", "deg", Look, number(-8.0, 90.0), look.sun_deg,
        "Elevation of the sun above the horizon."),
    row!("sunaz", "Sun azimuth", "deg", Look, Kind::Heading, look.sun_azimuth_deg,
        "Azimuth of the sun, clockwise from north."),
    row!("haze", "Haze", "", Look, number(0.0, 10.0), look.haze,
        "Aerosols relative to a clear maritime day: whiter horizon, redder sunsets."),
    row!("overcast", "Overcast", "", Look, number(0.0, 1.0), look.overcast,
        "Share of the light that passes through a uniform cloud deck instead of a clear sky."),
    row!("turbidity", "Turbid water", "", Look, number(0.0, 1.0), look.turbidity,
        "0 is the clear blue of the open ocean, 1 the green of coastal water."),
    row!("exposure", "Exposure", "EV", Look, number(-4.0, 4.0), look.exposure_ev,
        "Brighter or darker than the automatic exposure, in stops."),
    row!("mesh", "Mesh detail", "", Look, number(0.25, 2.0), look.mesh,
        "Density of the water mesh relative to the default."),
    row!("x", "East", "m", Camera, number(-1e6, 1e6), camera.x_m,
        "Position of the camera east of the origin."),
    row!("y", "Height", "m", Camera, logarithmic(1.0, 5000.0), camera.y_m,
        "Height of the camera above the still water; it is kept above the highest crests."),
    row!("z", "South", "m", Camera, number(-1e6, 1e6), camera.z_m,
        "Position of the camera south of the origin."),
    row!("heading", "Heading", "deg", Camera, Kind::Heading, camera.heading_deg,
        "Viewing direction, clockwise from north."),
    row!("pitch", "Pitch", "deg", Camera, number(-89.0, 60.0), camera.pitch_deg,
        "Viewing direction above (+) or below (-) the horizontal."),
    row!("fov", "Field of view", "deg", Camera, number(10.0, 100.0), camera.fov_deg,
        "Vertical field of view; kept when the window changes shape."),
    row!("t", "Time", "s", Clock, number(0.0, 1e7), clock.t_s,
        "Simulated time since the start of the sea."),
    row!("speed", "Speed", "x", Clock, number(0.0, 10.0), clock.speed,
        "Simulated seconds per second."),
    row!("pause", "Paused", "", Clock, Kind::Flag,
        "Stops the time.",
        |p| f64::from(u8::from(p.clock.paused)), |p, v| p.clock.paused = v != 0.0),
    row!("n", "FFT size", "", Grid, Kind::Choice(&["64", "128", "256", "512", "1024"]),
        "Samples along one side of a cascade. More adds shorter waves, and never changes those already there.",
        |p| SIZES.iter().position(|&n| n == p.grid.n).unwrap_or(2) as f64, |p, v| p.grid.n = SIZES[v as usize]),
    row!("cascades", "Cascades", "", Grid, Kind::Integer { min: 0, max: 4 },
        "Number of patches whose sum is the sea; 0 chooses for the sea at hand.",
        |p| f64::from(p.grid.cascades), |p, v| p.grid.cascades = v as u32),
];
