//! All parameters that a user can set. Values are in the units of the state string; [`Plan`](crate::waves::Plan)
//! converts them to SI.
//!
//! The members of [`Params`] are the levels of invalidation: `grid` reallocates, `sea` reruns the spectrum pass, the
//! rest are uniforms. There are no dirty flags: the owner of a resource compares with the parameters it was made from.

use super::field::FieldKind::{Choice, Flag, Heading};
use super::field::{integer, logarithmic, number, parameters, words};
use super::floats::Float;
pub use super::look::Look;
pub use super::sea::{DepthFactor, DispersionKind, Foam, Sea, SpectrumKind, SpreadKind, System, Whitecaps};

/// Everything that a link can carry. Values that were set through [`fields`](super::fields) are always valid.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Params {
    /// Resolution of the simulation.
    pub grid: Grid,
    /// Sea state.
    pub sea: Sea,
    /// Light, water and film.
    pub look: Look,
    /// Viewpoint.
    pub camera: Camera,
    /// Simulated time.
    pub clock: Clock,
    /// Moored buoys and boats.
    pub floats: Vec<Float>,
    /// Display settings, such as the resolution scale and the open panel. They do not change the sea.
    pub screen: Screen,
}

/// Largest number of cascades.
pub const MAX_CASCADES: usize = 4;

parameters! {
    /// Resolution of the simulation.
    pub struct Grid {
        /// Samples along one side of a cascade: a power of two from 64 to 1024. The field is in `fields.rs`.
        n: u32 = 256,
        /// Number of cascades, whose sum is the sea; 0 lets the plan choose.
        cascades: u32 = 0 => ("cascades", "Cascades", "", integer(0, MAX_CASCADES as u32), "auto"),
        /// Each cascade carries all the waves that its lattice can hold, instead of a band of its own. Where n cascades
        /// hold the same waves they share the energy: each amplitude is scaled by 1/sqrt(n).
        overlap: bool = false => ("overlap", "Overlapping bands", "", Flag),
        /// Blends the surface from shifted copies of each patch, with weights that keep its statistics (Heitz and
        /// Neyret 2018); 0 shows the periodic sum of patches.
        untile: bool = true => ("untile", "No repetition", "", Flag),
        /// Settings of the cascades by hand, longest patch first.
        patches: [PatchOverride; MAX_CASCADES] = [PatchOverride::default(); MAX_CASCADES],
    }
}

parameters! {
    /// A cascade as set by hand; 0 leaves a value to the plan.
    #[derive(Copy)]
    pub struct PatchOverride {
        /// Side of this cascade's square patch, its length scale; 0 lets the plan choose.
        side_m: f64 = 0.0 => ("patch", "Patch", "m", number(0.0, 1e5), "auto"),
        /// Wave number at which the waves of this cascade begin; 0 lets the plan choose.
        k_low: f64 = 0.0 => ("low", "Low cut-off", "rad/m", number(0.0, 1e4), "auto"),
        /// Wave number below which the waves of this cascade end; 0 lets the plan choose. Overlaps share energy.
        k_high: f64 = 0.0 => ("high", "High cut-off", "rad/m", number(0.0, 1e4), "auto"),
    }
}

words! {
    /// Movement of the camera.
    pub enum CameraMode {
        /// The camera looks around from its place, and flies.
        Fly = "fly",
        /// The camera turns around the point of the sea in the middle of the picture.
        Orbit = "orbit",
        /// The camera rides on the water; its height counts from the water below it.
        Buoy = "buoy",
    }
}

parameters! {
    /// Viewpoint. World axes: +x east, +y up, -z north.
    pub struct Camera {
        /// Position of the camera east of the origin.
        x_m: f64 = 0.0 => ("x", "East", "m", number(-1e6, 1e6)),
        /// Height of the camera above the still water; passing waves lift it, so that it is never under water.
        y_m: f64 = 7.0 => ("y", "Height", "m", logarithmic(1.0, 5000.0)),
        /// Position of the camera south of the origin.
        z_m: f64 = 0.0 => ("z", "South", "m", number(-1e6, 1e6)),
        /// Viewing direction, clockwise from north.
        heading_deg: f64 = 40.0 => ("heading", "Heading", "deg", Heading),
        /// Viewing direction above (+) or below (-) the horizontal.
        pitch_deg: f64 = -4.0 => ("pitch", "Pitch", "deg", number(-89.0, 60.0)),
        /// Vertical field of view; it stays when the window changes shape.
        fov_deg: f64 = 50.0 => ("fov", "Field of view", "deg", number(10.0, 100.0)),
        /// fly: dragging looks around, the keys fly; orbit: the camera turns around the sea in the middle of the
        /// picture; buoy: the camera rides on the water, its height counts from the water below it.
        mode: CameraMode = CameraMode::Fly => ("camera", "Mode", "", Choice(CameraMode::WORDS)),
    }
}

parameters! {
    /// Simulated time.
    pub struct Clock {
        /// Simulated time since the start of the sea.
        t_s: f64 = 0.0 => ("t", "Time", "s", number(0.0, 1e7)),
        /// Simulated seconds per second.
        speed: f64 = 1.0 => ("speed", "Speed", "x", number(0.0, 10.0)),
        /// Stops the simulated time.
        paused: bool = false => ("pause", "Paused", "", Flag),
    }
}

words! {
    /// Units of the panel; the state string is always metric.
    pub enum Units {
        /// Metres, kilometres, metres per second.
        Metric = "metric",
        /// Feet, nautical miles, knots.
        Nautical = "nautical",
    }
}

parameters! {
    /// Presentation in the window or on the page; it changes neither the sea nor its light nor the view.
    pub struct Screen {
        /// Shows the panel; 0 suits a page that is embedded in another. Key H.
        panel: bool = true => ("ui", "Panel", "", Flag),
        /// Units of the panel: metric, or feet, nautical miles and knots. The state string is always metric.
        units: Units = Units::Metric => ("units", "Units", "", Choice(Units::WORDS)),
        /// Pixels of the picture per pixel of the window, along a side: less is faster and softer, more is smoother.
        render_scale: f64 = 1.0 => ("renderscale", "Render scale", "", number(0.25, 2.0)),
        /// Lowers the resolution of the picture, and at its limit the FFT size, while frames take long; raises both
        /// again when there is time. The waves that remain never change.
        adaptive: bool = true => ("adaptive", "Adaptive quality", "", Flag),
        /// Largest number of picture pixels per point of the window, along a side. Phones and dense screens have more
        /// pixels than the eye resolves.
        max_pixel_ratio: f64 = 2.0 => ("maxdpr", "Pixel ratio, at most", "", number(0.5, 4.0)),
    }
}
