//! What a user can set. Values are in the units that the state string shows; [`Plan`](crate::waves::Plan) converts to SI.
//!
//! The sub-structs are the levels of invalidation: `grid` reallocates, `sea` reruns the spectrum pass, the rest are
//! uniforms. There are no dirty flags: whoever owns a resource compares with the parameters it was made from.

pub use super::fields::spectrum::SpectrumKind;
use super::floats::Float;
pub use super::look::Look;
use crate::files::measured::Measured;
use std::sync::Arc;

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
    /// What floats on it.
    pub floats: Vec<Float>,
    /// How a window or a page shows it.
    pub screen: Screen,
}

/// Resolution of the simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Samples along one side of a cascade: a power of two from 64 to 1024.
    pub n: u32,
    /// Number of cascades, 1 to 4; 0 lets the plan choose.
    pub cascades: u32,
    /// Whether each cascade carries all the waves that it can, sharing them with its neighbours, instead of its own band.
    pub overlap: bool,
    /// Whether patches are blended from shifted copies, so that nothing repeats.
    pub untile: bool,
    /// What is set by hand, longest patch first.
    pub patches: [Patch; MAX_CASCADES],
}

/// Most cascades that a sea can have.
pub const MAX_CASCADES: usize = 4;

/// A cascade as set by hand; 0 leaves a value to the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Patch {
    /// Side of the square patch (the length scale of the cascade), m.
    pub side_m: f64,
    /// Low cut-off, rad/m, included.
    pub k_low: f64,
    /// High cut-off, rad/m, excluded.
    pub k_high: f64,
}

impl Default for Grid {
    fn default() -> Self {
        Self { n: 256, cascades: 0, overlap: false, untile: true, patches: [Patch::default(); MAX_CASCADES] }
    }
}

/// Family of the directional spreading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpreadKind {
    /// The same energy in every direction.
    Isotropic,
    /// cos^2 over the whole circle: as many waves run against the wind.
    Cos2,
    /// cos^2 over the half circle around the wind.
    Cos2Positive,
    /// cos^{2s}(theta/2), Mitsuyasu et al. 1975.
    Mitsuyasu,
    /// cos^{2s}(theta/2), Hasselmann, Dunckel and Ewing 1980.
    Hasselmann,
    /// sech^2(beta theta), Donelan, Hamilton and Hui 1985 with Banner 1990.
    DonelanBanner,
    /// 1 + Delta cos(2 theta), Elfouhaily et al. 1997.
    Elfouhaily,
}

/// Which waves the water allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DispersionKind {
    /// omega^2 = g k, whatever the depth.
    Deep,
    /// omega^2 = g k tanh(k h).
    Finite,
    /// omega^2 = (g k + sigma/rho k^3) tanh(k h).
    Capillary,
}

/// Form of Kitaigorodskii's depth factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthFactor {
    /// tanh^2(kh) / (1 + 2kh / sinh 2kh).
    Exact,
    /// Three branches in omega sqrt(h/g), Thompson and Vincent 1983.
    Branches,
}

/// Where the threshold of the foam comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whitecaps {
    /// From the whitecap coverage of the wind, Monahan and O'Muircheartaigh 1980.
    Monahan,
    /// As given.
    Fixed,
}

/// One wave system: a spectrum with its own wind.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// Frequency spectrum.
    pub spectrum: SpectrumKind,
    /// Scale on the height of this system; 0 switches it off.
    pub scale: f64,
    /// Wind speed 10 m above the sea, m/s.
    pub wind_m_s: f64,
    /// Distance over which the wind has blown, km.
    pub fetch_km: f64,
    /// Direction the waves come from, degrees clockwise from north.
    pub from_deg: f64,
    /// Peak enhancement of JONSWAP, TMA and Karaev.
    pub gamma: f64,
    /// Significant height, m; 0 follows from the wind.
    pub hs_m: f64,
    /// Peak period, s; 0 follows from the wind.
    pub tp_s: f64,
    /// A of the generalised (m^2/s^4) and of Tessendorf's spectrum (1); 0 follows from the wind.
    pub coefficient_a: f64,
    /// B of the generalised spectrum, s^-4; 0 follows from the wind.
    pub coefficient_b: f64,
    /// Length l of the short-wave fade exp(-(k l)^2), m.
    pub fade_m: f64,
    /// Directional spreading.
    pub spread: SpreadKind,
    /// Spreading that it is blended with.
    pub blend_to: SpreadKind,
    /// Share of `blend_to`, 0..1.
    pub blend: f64,
    /// Share of the energy that is spread evenly over all directions, 0..1.
    pub isotropic: f64,
    /// Swell xi, 0..1: narrows the direction of the long waves (Horvath 2015).
    pub swell: f64,
}

impl System {
    /// The local wind sea.
    fn local() -> Self {
        Self {
            spectrum: SpectrumKind::Jonswap,
            scale: 1.0,
            wind_m_s: 12.0,
            fetch_km: 150.0,
            from_deg: 240.0,
            gamma: 3.3,
            hs_m: 0.0,
            tp_s: 0.0,
            coefficient_a: 0.0,
            coefficient_b: 0.0,
            fade_m: 0.0,
            spread: SpreadKind::DonelanBanner,
            blend_to: SpreadKind::Isotropic,
            blend: 0.0,
            isotropic: 0.0,
            swell: 0.0,
        }
    }

    /// The swell of a distant storm, switched off: lower and longer than that storm's own sea.
    fn distant() -> Self {
        Self {
            scale: 0.0,
            wind_m_s: 15.0,
            fetch_km: 300.0,
            from_deg: 300.0,
            hs_m: 1.5,
            tp_s: 12.0,
            gamma: 5.0,
            fade_m: 2.0,
            spread: SpreadKind::Hasselmann,
            swell: 0.5,
            ..Self::local()
        }
    }
}

/// A sea state.
#[derive(Clone, Debug, PartialEq)]
pub struct Sea {
    /// The local wind sea and the swell; their spectra add.
    pub systems: [System; 2],
    /// The buoy's spectrum for systems whose spectrum is `measured`.
    pub measured: Option<Arc<Measured>>,
    /// Water depth, m.
    pub depth_m: f64,
    /// Dispersion relation.
    pub dispersion: DispersionKind,
    /// Surface tension sigma, N/m, for capillary waves.
    pub tension_n_m: f64,
    /// Density of the water, kg/m^3, for capillary waves.
    pub density_kg_m3: f64,
    /// Acceleration of gravity, m/s^2.
    pub gravity_m_s2: f64,
    /// Depth factor of TMA.
    pub depth_factor: DepthFactor,
    /// Whether TMA takes alpha and gamma from Bouws et al. 1985 instead of JONSWAP.
    pub bouws: bool,
    /// Whether the first branch of Karaev's spectrum carries the depth factor.
    pub karaev_tma: bool,
    /// Panels, of 15 points, of each piece of the quadrature that normalises a spreading without a closed form.
    pub norm_steps: u32,
    /// Horizontal displacement lambda; 1 is the linear (Lagrangian) theory.
    pub chop: f64,
    /// Factors on it along x (east) and z (south).
    pub chop_xz: [f64; 2],
    /// Scale on all displacements; 1 is the physical height.
    pub height: f64,
    /// Height of the still water in the world, m.
    pub level_m: f64,
    /// Seed of the random phases and amplitudes.
    pub seed: u32,
    /// Period after which the sea repeats, s; 0 means none (a day).
    pub loop_s: f64,
    /// Whitecaps.
    pub foam: Foam,
}

impl Sea {
    /// The local wind sea: its wind is the wind of the picture.
    pub fn local(&self) -> &System {
        &self.systems[0]
    }

    /// Shows a buoy's spectrum as the local sea.
    pub fn show_measured(&mut self, measured: Measured) {
        self.measured = Some(Arc::new(measured));
        self.systems[0].spectrum = SpectrumKind::Measured;
    }

    /// Horizontal displacement along x and z.
    pub fn lambda(&self) -> [f64; 2] {
        self.chop_xz.map(|c| c * self.chop)
    }
}

impl Default for Sea {
    fn default() -> Self {
        Self {
            systems: [System::local(), System::distant()],
            measured: None,
            depth_m: 4000.0,
            dispersion: DispersionKind::Finite,
            tension_n_m: 0.074,
            density_kg_m3: 1025.0,
            gravity_m_s2: 9.81,
            depth_factor: DepthFactor::Exact,
            bouws: false,
            karaev_tma: false,
            norm_steps: 2,
            chop: 1.0,
            chop_xz: [1.0, 1.0],
            height: 1.0,
            level_m: 0.0,
            seed: 1,
            loop_s: 0.0,
            foam: Foam::default(),
        }
    }
}

/// How whitecaps form and fade.
#[derive(Clone, Debug, PartialEq)]
pub struct Foam {
    /// Where the threshold comes from.
    pub whitecaps: Whitecaps,
    /// Jacobian below which foam forms, when it is given.
    pub threshold: f64,
    /// Added to the threshold in either case.
    pub bias: f64,
    /// e-folding time, s.
    pub decay_s: f64,
    /// Foam injected at full source, per second.
    pub rate_per_s: f64,
}

impl Default for Foam {
    fn default() -> Self {
        Self { whitecaps: Whitecaps::Monahan, threshold: 0.5, bias: 0.0, decay_s: 4.0, rate_per_s: 2.0 }
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
    /// What dragging and the keys do, and whether the eye rides on the water.
    pub mode: CameraMode,
}

/// How the camera is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CameraMode {
    /// It looks around where it is, and flies.
    Fly,
    /// It turns around the point of the sea in the middle of the picture.
    Orbit,
    /// It rides on the water, its height above the water below it.
    Buoy,
}

impl Default for Camera {
    fn default() -> Self {
        Self { x_m: 0.0, y_m: 7.0, z_m: 0.0, heading_deg: 40.0, pitch_deg: -4.0, fov_deg: 50.0, mode: CameraMode::Fly }
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

/// Units of the panel; the state string is always metric.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// Metres, kilometres, metres a second.
    Metric,
    /// Feet, nautical miles, knots.
    Nautical,
}

/// How a window or a page shows the sea: nothing of this changes the sea, its light or the view.
#[derive(Clone, Debug, PartialEq)]
pub struct Screen {
    /// Whether the panel is there; a page that is embedded does without.
    pub panel: bool,
    /// Units of the panel.
    pub units: Units,
    /// Pixels of the picture along a side, over those of the window.
    pub render_scale: f64,
    /// Whether the picture gets coarser where frames take long.
    pub adaptive: bool,
    /// Most pixels of the picture per point of the window, along a side.
    pub most_dpr: f64,
}

impl Default for Screen {
    fn default() -> Self {
        Self { panel: true, units: Units::Metric, render_scale: 1.0, adaptive: true, most_dpr: 2.0 }
    }
}
