//! Appearance of the picture: sky, water, exposure and tone mapping. It never changes the maps of the simulation.
//!
//! A new parameter is one member of a struct in `sky.rs`, `surface.rs` or here; the macro makes its field.

mod day;
mod sky;
mod surface;

pub use sky::{CloudKind, SkyFile, SkyLook, SunPlacement};
pub use surface::{BedLook, FoamLook, FresnelFormula, MicrofacetDistribution, Reflection, Scattering, SurfaceLook};

use super::field::FieldKind::{Choice, Flag};
use super::field::{choice_enum, logarithmic, number, parameters};
use super::views::ViewChoice;

parameters! {
    /// Appearance of the picture: sky, water, foam, exposure, water mesh and view. It does not change the waves.
    pub struct Look {
        /// Sun, sky and fog.
        sky: SkyLook = SkyLook::default(),
        /// Appearance of the water, its foam and the sea bed.
        surface: SurfaceLook = SurfaceLook::default(),
        /// Exposure, tone mapping, bloom and dither.
        film: FilmLook = FilmLook::default(),
        /// Number of vertices of the water mesh relative to the default, which depends on the number of pixels.
        mesh_detail: f64 = 1.0 => ("mesh", "Mesh detail", "", logarithmic(0.1, 4.0)),
        /// Distance from the camera up to which the sea is drawn; 0 draws it to the horizon.
        extent_km: f64 = 0.0 => ("extent", "Extent", "km", number(0.0, 300.0), "horizon"),
        /// The picture, or a false-colour view that replaces it.
        view: ViewChoice = ViewChoice::default(),
    }
}

choice_enum! {
    /// Tone-mapping curve from scene light to display values.
    pub enum ToneMapping {
        /// Film curve of this program, with a long shoulder, which keeps half of the hue of bright colours.
        Film = "film",
        /// AgX tone mapping, Sobotka 2022.
        Agx = "agx",
        /// Tone-mapping curve of the ACES reference and output transform, as fitted by Hill 2016.
        Aces = "aces",
        /// Tone-mapping curve x / (1 + x) of the exposed scene light x, Reinhard et al. 2002.
        Reinhard = "reinhard",
        /// Khronos PBR Neutral tone mapping, 2024.
        Neutral = "neutral",
        /// No tone-mapping curve; exposed light above display white is clipped.
        Linear = "linear",
    }
}

parameters! {
    /// Exposure, tone mapping, bloom and dither.
    pub struct FilmLook {
        /// Adapts the exposure to the scene light, but not completely: dusk stays darker than noon. A picture that faces
        /// the sun is exposed less.
        auto_exposure: bool = true => ("autoexposure", "Automatic exposure", "", Flag),
        /// Exposure in stops, relative to the automatic exposure or, without it, to the exposure of a clear noon (sun
        /// at 60 degrees); then a sunset needs about 3, dusk 8, a moonless night 20.
        exposure_ev: f64 = 0.0 => ("exposure", "Exposure", "EV", number(-8.0, 24.0)),
        /// Tone-mapping curve from scene light to display. film: highlights that fade slowly to white and keep their
        /// hue; agx: Sobotka (2022), with added contrast and saturation; aces: Hill's fit (2016); reinhard: x/(1+x)
        /// (2002); neutral: Khronos PBR Neutral (2024); linear: clipped at white.
        tone: ToneMapping = ToneMapping::Film => ("tone", "Tone curve", "", Choice(ToneMapping::WORDS)),
        /// Fraction of the light that the lens scatters around bright objects (Jimenez 2014); the total light does not
        /// change. 0.04 is a clean lens, 0.3 a misted one.
        bloom: f64 = 0.0 => ("bloom", "Bloom", "", number(0.0, 1.0), "off"),
        /// Share by which bright areas of the picture are exposed less, so that the sky around the sun keeps its clouds:
        /// 0 exposes all areas alike, 1 shows all bright ones alike.
        local_exposure: f64 = 0.0 => ("localexposure", "Local exposure", "", number(0.0, 1.0), "off"),
        /// Adds noise of one 8-bit step, which hides banding in smooth skies.
        dither: bool = true => ("dither", "Dither", "", Flag),
    }
}
