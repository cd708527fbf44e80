//! What a user can set of the picture: light, water, film. Uniforms only; nothing here changes a map.

use super::optics::WaterType;
use super::views;

/// Everything of the picture but the place that it is taken from.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Sun and sky.
    pub sky: SkyLook,
    /// Water and foam.
    pub surface: Surface,
    /// Exposure and tone.
    pub film: Film,
    /// Vertices of the water mesh relative to the default.
    pub mesh: f64,
    /// How far the sea is drawn, km; 0 is to the horizon.
    pub extent_km: f64,
    /// What is shown instead of the picture.
    pub view: views::Choice,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            sky: SkyLook::default(),
            surface: Surface::default(),
            film: Film::default(),
            mesh: 1.0,
            extent_km: 0.0,
            view: views::Choice::default(),
        }
    }
}

/// Sun and sky.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyLook {
    /// Elevation of the sun above the horizon, degrees.
    pub sun_deg: f64,
    /// Azimuth of the sun, degrees clockwise from north.
    pub sun_azimuth_deg: f64,
    /// Aerosol amount relative to a clear maritime day.
    pub haze: f64,
    /// Share of the sky behind a uniform cloud deck, 0..1.
    pub overcast: f64,
}

impl Default for SkyLook {
    fn default() -> Self {
        Self { sun_deg: 28.0, sun_azimuth_deg: 75.0, haze: 1.0, overcast: 0.0 }
    }
}

/// Water and foam.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Surface {
    /// Light from inside the water.
    pub body: Body,
    /// Light mirrored by the surface.
    pub mirror: Mirror,
    /// The look of whitecaps.
    pub foam: FoamLook,
    /// The bed below shallow water.
    pub bed: Bed,
}

/// Light from inside the water. Strengths are relative to the physical ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Jerlov's type.
    pub water: WaterType,
    /// Share of the way to the next muddier type, 0..1.
    pub mix: f64,
    /// Colour that deep water scatters, 0xRRGGBB; 0 follows from the type.
    pub scatter_colour: f64,
    /// Colour of the bubbles that breaking beats under, 0xRRGGBB.
    pub bubble_colour: f64,
    /// Their density.
    pub bubbles: f64,
    /// Light through crests, by their height.
    pub height: f64,
    /// Dependence of the scattered light on the angle of view.
    pub view: f64,
    /// Scattered sunlight.
    pub diffuse: f64,
    /// Scattered skylight.
    pub ambient: f64,
}

impl Default for Body {
    fn default() -> Self {
        Self {
            water: WaterType::Ib,
            mix: 0.0,
            scatter_colour: 0.0,
            bubble_colour: f64::from(0x00ff_ffff),
            bubbles: 1.0,
            height: 1.0,
            view: 1.0,
            diffuse: 1.0,
            ambient: 1.0,
        }
    }
}

/// How Fresnel's reflectance is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fresnel {
    /// Of a dielectric, unpolarised.
    Exact,
    /// Schlick's approximation.
    Schlick,
}

/// Distribution of the slopes that the picture does not resolve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Specular {
    /// Normal, as Cox and Munk measured it (Beckmann's).
    Gaussian,
    /// Trowbridge and Reitz's.
    Ggx,
    /// Blinn and Phong's lobe of a given shininess.
    BlinnPhong,
}

/// Light mirrored by the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// Strength of the mirrored sky.
    pub reflection: f64,
    /// Refractive index of the water.
    pub index_water: f64,
    /// Refractive index of the air.
    pub index_air: f64,
    /// Fresnel's reflectance.
    pub fresnel: Fresnel,
    /// Exponent of Schlick's.
    pub fresnel_shine: f64,
    /// Scale on the reflectance.
    pub fresnel_scale: f64,
    /// Scale on the slope of the normal that it is taken at.
    pub fresnel_normals: f64,
    /// Distribution of the slopes.
    pub specular: Specular,
    /// Exponent of Blinn and Phong's.
    pub shininess: f64,
    /// Strength of the sun's glitter.
    pub glitter: f64,
    /// Scale on Fresnel's reflectance in it.
    pub glitter_fresnel: f64,
    /// Cosine to the normal below which sun or eye see none.
    pub glitter_cut: f64,
    /// Roughness in addition to that of the waves; alpha is its square.
    pub roughness: f64,
}

impl Default for Mirror {
    fn default() -> Self {
        Self {
            reflection: 1.0,
            index_water: 1.333,
            index_air: 1.0,
            fresnel: Fresnel::Exact,
            fresnel_shine: 5.0,
            fresnel_scale: 1.0,
            fresnel_normals: 1.0,
            specular: Specular::Gaussian,
            shininess: 200.0,
            glitter: 1.0,
            glitter_fresnel: 1.0,
            glitter_cut: 0.0,
            roughness: 0.0,
        }
    }
}

/// The look of whitecaps.
#[derive(Clone, Debug, PartialEq)]
pub struct FoamLook {
    /// Visible amount, 0..2.
    pub shown: f64,
    /// Colour, 0xRRGGBB.
    pub colour: f64,
    /// Roughness of its wet gloss.
    pub roughness: f64,
    /// Height of its relief.
    pub relief: f64,
}

impl Default for FoamLook {
    fn default() -> Self {
        Self { shown: 1.0, colour: f64::from(0x00ff_ffff), roughness: 0.8, relief: 1.0 }
    }
}

/// The bed below shallow water.
#[derive(Clone, Debug, PartialEq)]
pub struct Bed {
    /// Colour of the sand, 0xRRGGBB.
    pub colour: f64,
    /// Share of the light that the waves focus on it, 0..1.
    pub caustics: f64,
}

impl Default for Bed {
    fn default() -> Self {
        Self { colour: f64::from(0x00d8_ccb0), caustics: 0.0 }
    }
}

/// What the film does to light.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Film {
    /// Exposure relative to automatic, stops.
    pub exposure_ev: f64,
}
