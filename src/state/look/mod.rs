//! Appearance of the picture: sky, water, film. Only uniforms depend on it; nothing here changes a map.
//!
//! A new parameter is one member in `sky.rs`, `surface.rs` or here; its field follows from the declaration.

mod sky;
mod surface;

pub use sky::{SkyFile, SkyLook, SunPlacement};
pub use surface::{BedLook, FoamLook, Fresnel, Reflection, Scattering, Specular, SurfaceLook};

use super::field::FieldKind::{Choice, Flag};
use super::field::{logarithmic, number, parameters, words};
use super::views::ViewChoice;

parameters! {
    /// Everything about the picture except the viewpoint.
    pub struct Look {
        /// Sun and sky.
        sky: SkyLook = SkyLook::default(),
        /// Water, foam and bed.
        surface: SurfaceLook = SurfaceLook::default(),
        /// Exposure and tone curve.
        film: FilmLook = FilmLook::default(),
        /// Number of vertices of the water mesh relative to the default, which follows the pixels of the picture.
        mesh_detail: f64 = 1.0 => ("mesh", "Mesh detail", "", logarithmic(0.1, 4.0)),
        /// Distance from the camera to which the sea is drawn; 0 is the horizon.
        extent_km: f64 = 0.0 => ("extent", "Extent", "km", number(0.0, 300.0), "horizon"),
        /// View that replaces the picture.
        view: ViewChoice = ViewChoice::default(),
    }
}

words! {
    /// Tone curve: from scene light to the values of the display.
    pub enum Tone {
        /// AgX, Sobotka 2022.
        Agx = "agx",
        /// ACES reference and output transform, as fitted by Hill 2016.
        Aces = "aces",
        /// x / (1 + x), Reinhard et al. 2002.
        Reinhard = "reinhard",
        /// Khronos PBR Neutral, 2024.
        Neutral = "neutral",
        /// No curve; light is cut off at the limits of the display.
        Linear = "linear",
    }
}

parameters! {
    /// Exposure and tone curve.
    pub struct FilmLook {
        /// The exposure follows the light, but not completely: dusk stays darker than noon.
        auto_exposure: bool = true => ("autoexposure", "Automatic exposure", "", Flag),
        /// Stops over the automatic exposure. Without automatic exposure: stops over the exposure of a clear noon (sun
        /// at 60 degrees); a sunset needs about 3, dusk 8, a moonless night 20.
        exposure_ev: f64 = 0.0 => ("exposure", "Exposure", "EV", number(-8.0, 24.0)),
        /// Curve from scene light to the display. agx: Sobotka (2022), with added contrast and saturation; aces:
        /// Hill's fit (2016); reinhard: x/(1+x) (2002); neutral: Khronos PBR Neutral (2024); linear: cut off at white.
        tone: Tone = Tone::Agx => ("tone", "Tone curve", "", Choice(Tone::WORDS)),
        /// Share of the light that the lens spreads around bright objects (Jimenez 2014); the total stays. 0.04 is a
        /// clean lens, 0.3 a misted one.
        bloom: f64 = 0.0 => ("bloom", "Bloom", "", number(0.0, 1.0), "off"),
        /// Adds noise of one 8-bit step, which hides bands in smooth skies.
        dither: bool = true => ("dither", "Dither", "", Flag),
    }
}
