//! What a user can set. Values are in the units that the state string shows; [`Plan`](super::Plan) converts to SI.
//!
//! The sub-structs are the levels of invalidation: `grid` reallocates, `sea` reruns the spectrum pass, the rest are
//! uniforms. There are no dirty flags: whoever owns a resource compares with the parameters it was made from.

/// Everything that a link can carry, always valid once it went through [`fields`](super::fields).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Params {
    /// FFT size and number of cascades.
    pub grid: Grid,
    /// The sea state.
    pub sea: Sea,
    /// Light, sky and film.
    pub look: Look,
    /// Where the picture is taken from.
    pub camera: Camera,
    /// Simulated time.
    pub clock: Clock,
}

/// Resolution of the simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Samples along one side of a cascade: a power of two from 64 to 1024.
    pub n: u32,
    /// Number of cascades, 1 to 4; 0 lets the plan choose.
    pub cascades: u32,
}

impl Default for Grid {
    fn default() -> Self {
        Self { n: 256, cascades: 0 }
    }
}

/// Family of the frequency spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpectrumKind {
    /// Fully developed sea, Pierson and Moskowitz 1964.
    PiersonMoskowitz,
    /// Fetch-limited sea, Hasselmann et al. 1973.
    Jonswap,
    /// JONSWAP times the Kitaigorodskii depth factor, Bouws et al. 1985 as used by Horvath 2015.
    Tma,
}

/// Family of the directional spreading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpreadKind {
    /// The same energy in every direction.
    Isotropic,
    /// cos^{2s}(theta/2), Mitsuyasu et al. 1975.
    Mitsuyasu,
    /// cos^{2s}(theta/2), Hasselmann, Dunckel and Ewing 1980.
    Hasselmann,
    /// sech^2(beta theta), Donelan, Hamilton and Hui 1985 with Banner 1990.
    DonelanBanner,
}

/// A sea state.
#[derive(Clone, Debug, PartialEq)]
pub struct Sea {
    /// Frequency spectrum.
    pub spectrum: SpectrumKind,
    /// Wind speed 10 m above the sea, m/s.
    pub wind_m_s: f64,
    /// Distance over which the wind has blown, km.
    pub fetch_km: f64,
    /// Direction the wind comes from, degrees clockwise from north.
    pub from_deg: f64,
    /// Water depth, m.
    pub depth_m: f64,
    /// Peak enhancement of JONSWAP and TMA.
    pub gamma: f64,
    /// Directional spreading.
    pub spread: SpreadKind,
    /// Swell xi, 0..1: narrows the direction of the long waves (Horvath 2015).
    pub swell: f64,
    /// Horizontal displacement lambda; 1 is the linear (Lagrangian) theory.
    pub chop: f64,
    /// Scale on all displacements; 1 is the physical height.
    pub height: f64,
    /// Acceleration of gravity, m/s^2.
    pub gravity_m_s2: f64,
    /// Seed of the random phases and amplitudes.
    pub seed: u32,
    /// Period after which the sea repeats, s; 0 means none (a day).
    pub loop_s: f64,
    /// e-folding time of foam, s.
    pub foam_decay_s: f64,
    /// Foam injected at full source, per second.
    pub foam_rate_per_s: f64,
}

impl Default for Sea {
    fn default() -> Self {
        Self {
            spectrum: SpectrumKind::Jonswap,
            wind_m_s: 12.0,
            fetch_km: 250.0,
            from_deg: 240.0,
            depth_m: 4000.0,
            gamma: 3.3,
            spread: SpreadKind::DonelanBanner,
            swell: 0.0,
            chop: 1.0,
            height: 1.0,
            gravity_m_s2: 9.81,
            seed: 1,
            loop_s: 0.0,
            foam_decay_s: 4.0,
            foam_rate_per_s: 2.0,
        }
    }
}

/// Light, sky and film.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Elevation of the sun above the horizon, degrees.
    pub sun_deg: f64,
    /// Azimuth of the sun, degrees clockwise from north.
    pub sun_azimuth_deg: f64,
    /// Aerosol amount relative to a clear maritime day.
    pub haze: f64,
    /// Share of the sky behind a uniform cloud deck, 0..1.
    pub overcast: f64,
    /// Exposure relative to automatic, stops.
    pub exposure_ev: f64,
    /// Visible amount of foam, 0..2.
    pub foam: f64,
    /// Biological and mineral load of the water, 0 (clear ocean) .. 1 (coastal).
    pub turbidity: f64,
    /// Vertices of the water mesh relative to the default.
    pub mesh: f64,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            sun_deg: 28.0,
            sun_azimuth_deg: 75.0,
            haze: 1.0,
            overcast: 0.0,
            exposure_ev: 0.0,
            foam: 1.0,
            turbidity: 0.15,
            mesh: 1.0,
        }
    }
}

/// Where the picture is taken from. World axes: +x east, +y up, -z north.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// East of the origin, m.
    pub x_m: f64,
    /// Above the still water, m.
    pub y_m: f64,
    /// South of the origin, m.
    pub z_m: f64,
    /// Viewing direction, degrees clockwise from north.
    pub heading_deg: f64,
    /// Viewing direction above the horizontal, degrees.
    pub pitch_deg: f64,
    /// Vertical field of view, degrees.
    pub fov_deg: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self { x_m: 0.0, y_m: 7.0, z_m: 0.0, heading_deg: 40.0, pitch_deg: -4.0, fov_deg: 50.0 }
    }
}

/// Simulated time.
#[derive(Clone, Debug, PartialEq)]
pub struct Clock {
    /// Simulated time, s.
    pub t_s: f64,
    /// Simulated seconds per second.
    pub speed: f64,
    /// Whether time stands still.
    pub paused: bool,
}

impl Default for Clock {
    fn default() -> Self {
        Self { t_s: 0.0, speed: 1.0, paused: false }
    }
}
