//! All parameters that a user can set, in the units of the state string. [`Plan`](crate::waves::Plan) converts them to
//! SI.
//!
//! A change of `grid` reallocates GPU resources, of `sea` reruns the spectrum pass, of the rest mostly changes uniform
//! buffers. There are no dirty flags: the owner of a resource compares with the parameters it was made from.

use super::coast::Coast;
use super::field::FieldKind::{Choice, Flag, Heading};
use super::field::{choice_enum, integer, logarithmic, number, parameters};
use super::floats::FloatingObject;
pub use super::look::Look;
pub use super::sea::{
    DEEP_WATER_DEPTH_M, DepthFactor, DepthLimit, DispersionKind, FoamSettings, MAX_WAVE_SYSTEMS, Sea, SpectrumKind,
    SpreadKind, WAVE_SYSTEM_NAMES, WaveSystemParams, WhitecapRule,
};

/// All parameters of the simulator: the whole state that a link can carry. Values set with the functions of
/// [`fields`](super::fields) are always within their ranges.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Params {
    /// Resolution of the simulation: FFT size and cascades.
    pub grid: Grid,
    /// Sea state: wave systems, water, displacement and whitecaps.
    pub sea: Sea,
    /// Appearance: sky, water, exposure and tone mapping.
    pub look: Look,
    /// Position, direction, field of view and control mode of the camera.
    pub camera: Camera,
    /// Simulated time and its speed.
    pub clock: Clock,
    /// The coast that the sea runs up to, if any.
    pub coast: Coast,
    /// Floating objects: moored buoys, boats and yachts.
    pub floating_objects: Vec<FloatingObject>,
    /// Display settings, such as the resolution scale and the open panel. They do not change the sea.
    pub screen: Screen,
}

/// Largest number of cascades, the patches of different sizes whose sum is the sea.
pub const MAX_CASCADES: usize = 4;

parameters! {
    /// Resolution of the simulation: FFT size and cascades (patches of sea, each with its own FFT).
    pub struct Grid {
        /// FFT size: samples along one side of a cascade, a power of two from 64 to 1024. Its key in links is `n`.
        n: u32 = 256,
        /// Number of cascades, the patches of different sizes whose sum is the sea; 0 chooses it automatically.
        cascades: u32 = 0 => ("cascades", "Cascades", "", integer(0, MAX_CASCADES as u32), "auto"),
        /// Each cascade carries all the waves that its lattice can hold, instead of a wave-number band of its own.
        /// Waves that n cascades hold have their amplitude scaled by 1/sqrt(n) in each, which keeps their energy.
        overlap: bool = false => ("overlap", "Overlapping bands", "", Flag),
        /// Hides the repetition of the patches: blends shifted copies of each patch, with weights that keep its
        /// statistics (Heitz and Neyret 2018). 0 shows the periodic patches.
        hide_tiling: bool = true => ("untile", "No repetition", "", Flag),
        /// Manual settings of each cascade (patch of sea with its own FFT), the longest patch first.
        patches: [CascadeSettings; MAX_CASCADES] = [CascadeSettings::default(); MAX_CASCADES],
    }
}

parameters! {
    /// Manual settings of one cascade (patch of sea with its own FFT). A value of 0 is replaced by an automatic choice.
    #[derive(Copy)]
    pub struct CascadeSettings {
        /// Side of this cascade's square patch; 0 chooses it automatically.
        side_m: f64 = 0.0 => ("patch", "Patch", "m", number(0.0, 1e5), "auto"),
        /// Smallest wave number of the waves in this cascade; 0 chooses it automatically.
        k_low: f64 = 0.0 => ("low", "Low cut-off", "rad/m", number(0.0, 1e4), "auto"),
        /// Upper limit of the wave numbers of the waves in this cascade; 0 chooses it automatically. Where two cascades
        /// hold the same waves, each gets a part of their energy.
        k_high: f64 = 0.0 => ("high", "High cut-off", "rad/m", number(0.0, 1e4), "auto"),
    }
}

choice_enum! {
    /// Control mode of the camera: what dragging with the pointer and the keys do.
    pub enum CameraMode {
        /// Control mode in which dragging turns the viewing direction and the keys move the camera.
        Fly = "fly",
        /// Control mode in which dragging moves the camera around the point of the sea in the middle of the picture.
        Orbit = "orbit",
        /// Control mode in which the camera rides on the waves; its height counts from the water surface below it.
        Buoy = "buoy",
    }
}

parameters! {
    /// Camera: position, direction, field of view and control mode. World axes: +x east, +y up, -z north.
    pub struct Camera {
        /// Distance of the camera east of the world origin.
        x_m: f64 = 0.0 => ("x", "East", "m", number(-1e6, 1e6)),
        /// Height of the camera above the still water. Waves that reach the camera lift it; only a depth (dive) takes it
        /// under water.
        y_m: f64 = 7.0 => ("y", "Height", "m", logarithmic(1.0, 5000.0)),
        /// Depth of the camera below the still water, in buoy mode below the moving water. It replaces the height, and
        /// waves do not lift the camera: near 0, the surface crosses the lens.
        dive_m: f64 = 0.0 => ("dive", "Depth under water", "m", number(0.0, 60.0), "off"),
        /// Distance of the camera south of the world origin.
        z_m: f64 = 0.0 => ("z", "South", "m", number(-1e6, 1e6)),
        /// Compass heading of the viewing direction, clockwise from north.
        heading_deg: f64 = 40.0 => ("heading", "Heading", "deg", Heading),
        /// Angle of the viewing direction above (+) or below (-) the horizontal.
        pitch_deg: f64 = -4.0 => ("pitch", "Pitch", "deg", number(-89.0, 89.0)),
        /// Vertical field of view; it does not depend on the shape of the window.
        fov_deg: f64 = 50.0 => ("fov", "Field of view", "deg", number(10.0, 100.0)),
        /// Control mode. fly: dragging turns the view, the keys move the camera; orbit: dragging moves the camera
        /// around the sea in the middle of the picture; buoy: the camera rides on the waves, its height counts from the
        /// water.
        mode: CameraMode = CameraMode::Fly => ("camera", "Mode", "", Choice(CameraMode::WORDS)),
    }
}

parameters! {
    /// Simulated time and its speed.
    pub struct Clock {
        /// Simulated time; at 0 the waves have their initial phases.
        t_s: f64 = 0.0 => ("t", "Time", "s", number(0.0, 1e7)),
        /// Speed of the simulated time: simulated seconds per second of real time.
        speed: f64 = 1.0 => ("speed", "Speed", "x", number(0.0, 10.0)),
        /// Pauses the simulated time.
        paused: bool = false => ("pause", "Paused", "", Flag),
    }
}

choice_enum! {
    /// Units that the control panel shows; the state string is always metric.
    pub enum Units {
        /// Lengths in metres and kilometres, speeds in metres per second.
        Metric = "metric",
        /// Lengths in feet and nautical miles, speeds in knots.
        Nautical = "nautical",
    }
}

choice_enum! {
    /// Language of the interface.
    pub enum Language {
        /// The system's or the browser's language, if there is a translation, else English.
        Auto = "auto",
        /// English.
        English = "en",
        /// German.
        German = "de",
        /// French.
        French = "fr",
        /// Spanish.
        Spanish = "es",
        /// Portuguese.
        Portuguese = "pt",
        /// Japanese.
        Japanese = "ja",
        /// Simplified Chinese.
        Chinese = "zh",
    }
}

choice_enum! {
    /// Tier of the light of a running sea's water. A still and a reference always have the full one.
    pub enum Detail {
        /// The full tier, and the lean one while a GPU is too slow for 70 % of the picture's width and height.
        Auto = "auto",
        /// All that the program knows about the light of water.
        Full = "full",
        /// A third of the work in each pixel: fewer samples of waves, foam and mirrored sky.
        Lean = "lean",
    }
}

choice_enum! {
    /// What is shown over the sea.
    pub enum Interface {
        /// Nothing.
        None = "0",
        /// The panel, and the sea in words.
        Panel = "1",
        /// A caption that opens the whole page, and a button for the time: for a sea in a frame of another page.
        Mini = "mini",
    }
}

parameters! {
    /// Display settings of the window or web page. They change neither the sea nor its light nor the camera.
    pub struct Screen {
        /// What is shown over the sea: 1, the control panel (key H); 0, nothing; mini, a caption with a link to the whole
        /// page and a button that stops the time, as suits a small frame in another page.
        interface: Interface = Interface::Panel => ("ui", "Interface", "", Choice(Interface::WORDS)),
        /// Units of the control panel: metric, or feet, nautical miles and knots. The state string is always metric.
        units: Units = Units::Metric => ("units", "Units", "", Choice(Units::WORDS)),
        /// Language of the interface; auto is that of the system or the browser.
        language: Language = Language::Auto => ("lang", "Language", "", Choice(Language::WORDS)),
        /// Size of text and controls of the panel, relative to the usual one. Large windows enlarge them in addition.
        text_size: f64 = 1.0 => ("textsize", "Text size", "", number(0.7, 2.5)),
        /// Rendered pixels per window pixel along each axis: below 1 is faster and softer, above 1 is smoother.
        render_scale: f64 = 1.0 => ("renderscale", "Render scale", "", number(0.25, 2.0)),
        /// Lowers the render resolution, and at its limit the FFT size, while frames take too long; raises both again
        /// when there is time. A smaller FFT size leaves out the shortest waves; longer waves stay the same.
        adaptive: bool = true => ("adaptive", "Adaptive quality", "", Flag),
        /// Light of the running water: full, lean (a third of the work in each pixel, with fewer samples of waves, foam
        /// and mirrored sky), or auto, lean only if it lets a slow GPU keep more pixels. A still always has full light.
        detail: Detail = Detail::Auto => ("detail", "Detail", "", Choice(Detail::WORDS)),
        /// Largest number of rendered pixels per logical pixel (point) of the window, along each axis. Phones and dense
        /// screens have more pixels than the eye resolves.
        max_pixel_ratio: f64 = 2.0 => ("maxdpr", "Pixel ratio, at most", "", number(0.5, 4.0)),
    }
}
