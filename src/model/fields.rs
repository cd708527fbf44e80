//! One row per parameter. The query codec, the panel, the command-line help and the property tests are made from it.

use super::params::{DepthFactor, DispersionKind, Params, SpectrumKind, SpreadKind, Whitecaps};
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
    /// Light, sky and film.
    Look,
    /// Viewpoint.
    Camera,
    /// Simulated time.
    Clock,
}

impl Group {
    /// Every group, in the order of the panel.
    pub const ALL: [Self; 8] =
        [Self::Sea, Self::Swell, Self::Water, Self::Foam, Self::Look, Self::Camera, Self::Clock, Self::Grid];

    /// Heading in the panel.
    pub fn label(self) -> &'static str {
        match self {
            Self::Sea => "Sea",
            Self::Swell => "Second system",
            Self::Water => "Water",
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
    /// What 0 stands for where it is no quantity, such as "auto"; else "".
    pub zero: &'static str,
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
            Kind::Number { min, max, .. } if !self.zero.is_empty() => format!("{min} ({}) to {max}", self.zero),
            Kind::Integer { min, max } if !self.zero.is_empty() => format!("{min} ({}) to {max}", self.zero),
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

/// A table of words and what they stand for, and the words alone.
macro_rules! words {
    ($table:ident, $words:ident, $kind:ty, $($word:literal => $value:expr),+ $(,)?) => {
        const $table: &[(&str, $kind)] = &[$(($word, $value)),+];
        const $words: &[&str] = &[$($word),+];
    };
}

words!(SPECTRA, SPECTRUM_WORDS, SpectrumKind,
    "phillips" => SpectrumKind::Phillips,
    "tessendorf" => SpectrumKind::Tessendorf,
    "ab" => SpectrumKind::GeneralisedAb,
    "pm" => SpectrumKind::PiersonMoskowitz,
    "jonswap" => SpectrumKind::Jonswap,
    "tma" => SpectrumKind::Tma,
    "marnero" => SpectrumKind::Marnero,
    "karaev" => SpectrumKind::Karaev,
    "elfouhaily" => SpectrumKind::Elfouhaily,
    "donelan" => SpectrumKind::Donelan,
    "ochi-hubble" => SpectrumKind::OchiHubble,
    "torsethaugen" => SpectrumKind::Torsethaugen,
    "measured" => SpectrumKind::Measured,
);
words!(SPREADS, SPREAD_WORDS, SpreadKind,
    "isotropic" => SpreadKind::Isotropic,
    "cos2" => SpreadKind::Cos2,
    "cos2-positive" => SpreadKind::Cos2Positive,
    "mitsuyasu" => SpreadKind::Mitsuyasu,
    "hasselmann" => SpreadKind::Hasselmann,
    "donelan-banner" => SpreadKind::DonelanBanner,
    "elfouhaily" => SpreadKind::Elfouhaily,
);
words!(DISPERSIONS, DISPERSION_WORDS, DispersionKind,
    "deep" => DispersionKind::Deep,
    "finite" => DispersionKind::Finite,
    "capillary" => DispersionKind::Capillary,
);
words!(DEPTH_FACTORS, DEPTH_FACTOR_WORDS, DepthFactor,
    "exact" => DepthFactor::Exact,
    "branches" => DepthFactor::Branches,
);
words!(WHITECAPS, WHITECAP_WORDS, Whitecaps,
    "monahan" => Whitecaps::Monahan,
    "fixed" => Whitecaps::Fixed,
);
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

/// The rows of one wave system; the keys of the second end in 2.
macro_rules! system_rows {
    ($group:ident, $i:literal, $suffix:literal) => {
        [
            row!(concat!("spectrum", $suffix), "Spectrum", $group, SPECTRUM_WORDS of SPECTRA, [sea.systems[$i].spectrum],
                "Frequency spectrum. phillips: equilibrium range alone (1958); tessendorf: in wave numbers, with its own cos^2 in directions (2001); ab: A w^-5 exp(-B w^-4); pm: fully developed (Pierson and Moskowitz 1964); jonswap: fetch-limited (Hasselmann et al. 1973); tma: the same in shallow water (Bouws et al. 1985); marnero: Black Sea (Trusca 2007); karaev: with ripples (2000); elfouhaily: gravity and capillary waves (1997); donelan: w^-4 range (1985); ochi-hubble and torsethaugen: two peaks (1976, 2004); measured: a buoy's file."),
            row!(concat!("scale", $suffix), "Scale", "", $group, number(0.0, 5.0), [sea.systems[$i].scale],
                "Scale on the height of this system: 1 is the physical one, 0 switches it off.").zero("off"),
            row!(concat!("wind", $suffix), "Wind", "m/s", $group, number(0.0, 60.0), [sea.systems[$i].wind_m_s],
                "Wind speed 10 m above the sea. Beaufort 4 is about 7, a gale (Beaufort 8) about 19, a hurricane above 33 m/s."),
            row!(concat!("fetch", $suffix), "Fetch", "km", $group, logarithmic(0.5, 2000.0), [sea.systems[$i].fetch_km],
                "Distance over which the wind has blown: longer fetch, longer and higher waves (Hasselmann et al. 1973)."),
            row!(concat!("dir", $suffix), "From", "deg", $group, Kind::Heading, [sea.systems[$i].from_deg],
                "Direction that wind and waves come from, clockwise from north, as in a forecast. They run the other way."),
            row!(concat!("hs", $suffix), "Height Hs", "m", $group, number(0.0, 30.0), [sea.systems[$i].hs_m],
                "Significant wave height of this system; 0 lets it follow from wind and fetch. marnero: sqrt(2) times its rms height.").zero("auto"),
            row!(concat!("tp", $suffix), "Period Tp", "s", $group, number(0.0, 30.0), [sea.systems[$i].tp_s],
                "Peak period of this system; 0 lets it follow from wind and fetch. marnero: 1.2 times its mean period.").zero("auto"),
            row!(concat!("gamma", $suffix), "Peak gamma", "", $group, number(1.0, 10.0), [sea.systems[$i].gamma],
                "Peak enhancement of jonswap, tma and karaev: 1 is a broad peak, 3.3 the mean of the JONSWAP experiment, 7 a young sea."),
            row!(concat!("coefa", $suffix), "Coefficient A", "", $group, number(0.0, 10.0), [sea.systems[$i].coefficient_a],
                "A of the spectrum ab, m2/s4 (pm has 0.78), or of tessendorf, without unit (0.0013); 0 takes pm's.").zero("auto"),
            row!(concat!("coefb", $suffix), "Coefficient B", "1/s4", $group, number(0.0, 1000.0), [sea.systems[$i].coefficient_b],
                "B of the spectrum ab: 1.25 times the fourth power of the peak frequency; 0 takes pm's.").zero("auto"),
            row!(concat!("fade", $suffix), "Short-wave fade", "m", $group, number(0.0, 20.0), [sea.systems[$i].fade_m],
                "Waves much shorter than 2 pi times this length are left out: the spectrum is multiplied by exp(-(k l)^2).").zero("none"),
            row!(concat!("spread", $suffix), "Spreading", $group, SPREAD_WORDS of SPREADS, [sea.systems[$i].spread],
                "How the energy spreads over directions: isotropic; cos2, as many waves against the wind as with it; cos2-positive, the half with the wind; mitsuyasu (1975), hasselmann (1980), donelan-banner (1985, 1990), elfouhaily (1997, as many against the wind)."),
            row!(concat!("blendto", $suffix), "Blend to", $group, SPREAD_WORDS of SPREADS, [sea.systems[$i].blend_to],
                "Second spreading, for a blend of two."),
            row!(concat!("blend", $suffix), "Blend", "", $group, number(0.0, 1.0), [sea.systems[$i].blend],
                "Share of the second spreading."),
            row!(concat!("iso", $suffix), "Agitation", "", $group, number(0.0, 1.0), [sea.systems[$i].isotropic],
                "Share of the energy that goes evenly into all directions."),
            row!(concat!("swell", $suffix), "Swell", "", $group, number(0.0, 1.0), [sea.systems[$i].swell],
                "Narrows the direction of the long waves into parallel swell; the height stays (Horvath 2015)."),
        ]
    };
}

/// The rows of one cascade.
macro_rules! patch_rows {
    ($i:literal, $number:literal) => {
        [
            row!(concat!("patch", $number), concat!("Patch ", $number), "m", Grid, number(0.0, 1e5), [grid.patches[$i].side_m],
                "Length scale of this cascade: side of its square patch; 0 lets the plan choose.").zero("auto"),
            row!(concat!("low", $number), concat!("Low cut-off ", $number), "rad/m", Grid, number(0.0, 1e4), [grid.patches[$i].k_low],
                "Waves of this cascade begin at this wave number; 0 lets the plan choose.").zero("auto"),
            row!(concat!("high", $number), concat!("High cut-off ", $number), "rad/m", Grid, number(0.0, 1e4), [grid.patches[$i].k_high],
                "Waves of this cascade end below this wave number; 0 lets the plan choose. Where cascades overlap they share the energy.").zero("auto"),
        ]
    };
}

/// Every parameter, in the order in which the state string writes them.
pub static FIELDS: LazyLock<Vec<Field>> = LazyLock::new(|| {
    let mut fields = system_rows!(Sea, 0, "").to_vec();
    fields.extend(system_rows!(Swell, 1, "2"));
    fields.extend(rows());
    fields.extend(
        [patch_rows!(0, "1"), patch_rows!(1, "2"), patch_rows!(2, "3"), patch_rows!(3, "4")].into_iter().flatten(),
    );
    fields
});

#[rustfmt::skip]
fn rows() -> Vec<Field> { vec![
    row!("depth", "Depth", "m", Water, logarithmic(1.0, 11000.0), [sea.depth_m],
        "Water depth: slows and steepens long waves (omega^2 = g k tanh(k h)); with tma it also limits their energy."),
    row!("dispersion", "Dispersion", Water, DISPERSION_WORDS of DISPERSIONS, [sea.dispersion],
        "Speed of the waves: deep, w^2 = g k; finite, w^2 = g k tanh(k h); capillary, w^2 = (g k + sigma/rho k^3) tanh(k h)."),
    row!("tension", "Surface tension", "N/m", Water, number(0.0, 0.5), [sea.tension_n_m],
        "Surface tension of capillary waves: sea water 0.074, fresh water 0.072."),
    row!("density", "Density", "kg/m3", Water, number(500.0, 2000.0), [sea.density_kg_m3],
        "Density of the water, for capillary waves: sea water 1025, fresh water 1000, Black Sea 1012."),
    row!("g", "Gravity", "m/s2", Water, logarithmic(0.5, 30.0), [sea.gravity_m_s2],
        "Acceleration of gravity: Earth 9.81, Titan 1.35, Mars 3.71."),
    row!("tmafit", "TMA depth factor", Water, DEPTH_FACTOR_WORDS of DEPTH_FACTORS, [sea.depth_factor],
        "Kitaigorodskii's depth factor: exact, or the fit in three branches (Thompson and Vincent 1983)."),
    row!("bouws", "TMA alpha, gamma", Water, flag [sea.bouws],
        "tma takes alpha = 0.0078 kappa^0.49 and gamma = 2.47 kappa^0.39, kappa = U^2 k_p / g (Bouws et al. 1985), instead of jonswap's."),
    row!("karaevtma", "Karaev in the shallows", Water, flag [sea.karaev_tma],
        "The first branch of karaev carries the depth factor of tma."),
    row!("normsteps", "Quadrature steps", "", Water, Kind::Integer { min: 1, max: 64 },
        "Steps of the quadrature that normalises a spreading without a closed form, for each of its six pieces.",
        |p| f64::from(p.sea.norm_steps), |p, v| p.sea.norm_steps = v as u32),
    row!("chop", "Chop", "", Water, number(0.0, 2.0), [sea.chop],
        "Horizontal displacement: 1 is what linear theory gives and sharpens the crests, 0 leaves a sum of sines."),
    row!("chopx", "Chop east-west", "", Water, number(0.0, 2.0), [sea.chop_xz[0]],
        "Factor on the chop along x (east)."),
    row!("chopz", "Chop north-south", "", Water, number(0.0, 2.0), [sea.chop_xz[1]],
        "Factor on the chop along z (south)."),
    row!("height", "Height scale", "", Water, logarithmic(0.1, 4.0), [sea.height],
        "Scale on all displacements: 1 is the physical height. For those who want drama."),
    row!("level", "Water level", "m", Water, number(-100.0, 100.0), [sea.level_m],
        "Height of the still water in the world: the whole surface is lifted or lowered."),
    row!("seed", "Seed", "", Water, Kind::Integer { min: 0, max: 4_294_967_295 },
        "Chooses one sea among all those of the same statistics.",
        |p| f64::from(p.sea.seed), |p, v| p.sea.seed = v as u32),
    row!("loop", "Loop", "s", Clock, number(0.0, 3600.0), [sea.loop_s],
        "Period after which the sea repeats exactly; 0 means never (a day). Every wave's frequency is rounded to fit.").zero("none"),
    row!("foam", "Foam shown", "", Foam, number(0.0, 2.0), [look.foam],
        "Visible amount of foam; 1 shows the coverage that was computed."),
    row!("whitecaps", "Whitecaps", Foam, WHITECAP_WORDS of WHITECAPS, [sea.foam.whitecaps],
        "Where foam forms: monahan, so that the wind's whitecap coverage comes out (Monahan and O'Muircheartaigh 1980); fixed, below a Jacobian of your own."),
    row!("foamthreshold", "Foam threshold", "", Foam, number(-1.0, 1.0), [sea.foam.threshold],
        "Jacobian of the surface below which foam forms when whitecaps is fixed: 1 is unsqueezed water, 0 a folding crest."),
    row!("foambias", "Foam bias", "", Foam, number(-1.0, 1.0), [sea.foam.bias],
        "Added to the threshold, also to the one that follows from the wind: more foam (+) or less (-)."),
    row!("foamdecay", "Foam decay", "s", Foam, logarithmic(0.5, 30.0), [sea.foam.decay_s],
        "Time in which foam fades to 1/e. Whitecap patches last 2 to 10 s (Monahan 1971)."),
    row!("foamrate", "Foam growth", "1/s", Foam, logarithmic(0.1, 10.0), [sea.foam.rate_per_s],
        "How fast foam forms where a crest breaks."),
    row!("sun", "Sun height", "deg", Look, number(-8.0, 90.0), [look.sun_deg],
        "Elevation of the sun above the horizon."),
    row!("sunaz", "Sun azimuth", "deg", Look, Kind::Heading, [look.sun_azimuth_deg],
        "Azimuth of the sun, clockwise from north."),
    row!("haze", "Haze", "", Look, number(0.0, 10.0), [look.haze],
        "Aerosols relative to a clear maritime day: whiter horizon, redder sunsets."),
    row!("overcast", "Overcast", "", Look, number(0.0, 1.0), [look.overcast],
        "Share of the light that passes through a uniform cloud deck instead of a clear sky."),
    row!("turbidity", "Turbid water", "", Look, number(0.0, 1.0), [look.turbidity],
        "0 is the clear blue of the open ocean, 1 the green of coastal water."),
    row!("exposure", "Exposure", "EV", Look, number(-4.0, 4.0), [look.exposure_ev],
        "Brighter or darker than the automatic exposure, in stops."),
    row!("mesh", "Mesh detail", "", Look, logarithmic(0.1, 4.0), [look.mesh],
        "Number of vertices of the water mesh relative to the default, which follows the picture's pixels."),
    row!("extent", "Extent", "km", Look, number(0.0, 300.0), [look.extent_km],
        "How far from the camera the sea is drawn; 0 is to the horizon.").zero("horizon"),
    row!("x", "East", "m", Camera, number(-1e6, 1e6), [camera.x_m],
        "Position of the camera east of the origin."),
    row!("y", "Height", "m", Camera, logarithmic(1.0, 5000.0), [camera.y_m],
        "Height of the camera above the still water; it is kept above the highest crests."),
    row!("z", "South", "m", Camera, number(-1e6, 1e6), [camera.z_m],
        "Position of the camera south of the origin."),
    row!("heading", "Heading", "deg", Camera, Kind::Heading, [camera.heading_deg],
        "Viewing direction, clockwise from north."),
    row!("pitch", "Pitch", "deg", Camera, number(-89.0, 60.0), [camera.pitch_deg],
        "Viewing direction above (+) or below (-) the horizontal."),
    row!("fov", "Field of view", "deg", Camera, number(10.0, 100.0), [camera.fov_deg],
        "Vertical field of view; kept when the window changes shape."),
    row!("t", "Time", "s", Clock, number(0.0, 1e7), [clock.t_s],
        "Simulated time since the start of the sea."),
    row!("speed", "Speed", "x", Clock, number(0.0, 10.0), [clock.speed],
        "Simulated seconds per second."),
    row!("pause", "Paused", Clock, flag [clock.paused],
        "Stops the time."),
    row!("n", "FFT size", "", Grid, Kind::Choice(&["64", "128", "256", "512", "1024"]),
        "Samples along one side of a cascade. More adds shorter waves, and never changes those already there.",
        |p| SIZES.iter().position(|&n| n == p.grid.n).unwrap_or(2) as f64, |p, v| p.grid.n = SIZES[v as usize]),
    row!("cascades", "Cascades", "", Grid, Kind::Integer { min: 0, max: 4 },
        "Number of patches whose sum is the sea; 0 chooses for the sea at hand.",
        |p| f64::from(p.grid.cascades), |p, v| p.grid.cascades = v as u32).zero("auto"),
    row!("overlap", "Overlapping bands", Grid, flag [grid.overlap],
        "Each cascade carries all the waves that its lattice can, sharing their energy (amplitudes go with 1/sqrt(n)), instead of a band of its own."),
    row!("untile", "No repetition", Grid, flag [grid.untile],
        "The surface is blended from shifted copies of each patch, with weights that keep its statistics (Heitz and Neyret 2018); off shows the plainly periodic sum of patches."),
]}
