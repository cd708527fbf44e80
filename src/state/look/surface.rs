//! Appearance of the water, its foam and the bed.

use crate::optics::water::WaterType;
use crate::state::field::FieldKind::{Choice, Colour};
use crate::state::field::{FieldValue, WHITE, logarithmic, number, parameters, words};

/// Appearance of the water, its foam and the bed.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct SurfaceLook {
    /// Light from inside the water.
    pub scattering: Scattering,
    /// Light reflected by the surface.
    pub reflection: Reflection,
    /// Whitecaps.
    pub foam: FoamLook,
    /// The bed below shallow water.
    pub bed: BedLook,
}

impl FieldValue for WaterType {
    fn to_f64(self) -> f64 {
        f64::from(self as u8)
    }

    fn from_f64(value: f64) -> Self {
        Self::ALL[value as usize]
    }
}

parameters! {
    /// Light from inside the water. Strengths are relative to the physical ones.
    pub struct Scattering {
        /// Absorption and scattering by Jerlov's optical water types (1976): i, the clearest blue ocean, to iii,
        /// fertile and greenish; 1c, the clearest coast, to 9c, the muddiest.
        water_type: WaterType = WaterType::Ib => ("water", "Water type", "", Choice(WaterType::NAMES)),
        /// Share of the way from the water type to the next muddier one.
        next_type_share: f64 = 0.0 => ("watermix", "Towards the next type", "", number(0.0, 1.0)),
        /// Colour of the light that deep water scatters back: white scatters back a tenth of the light, auto follows
        /// from the water type.
        scatter_colour: f64 = 0.0 => ("scattercolour", "Scatter colour", "", Colour, "auto"),
        /// Colour of the light that the bubbles under breaking waves scatter; the water absorbs its red.
        bubble_colour: f64 = WHITE => ("bubblecolour", "Bubble colour", "", Colour),
        /// Density of the bubbles that breaking waves leave under the surface; 1 is a typical plume.
        bubbles: f64 = 1.0 => ("bubbles", "Bubble density", "", number(0.0, 10.0)),
        /// Height attenuation factor: strength of the light through crests; it grows with height and sharpness.
        height_scatter: f64 = 1.0 => ("heightscatter", "Scattering by height", "", number(0.0, 10.0)),
        /// Reflection strength of the scattering: how much the light from the water depends on the viewing angle.
        view_scatter: f64 = 1.0 => ("viewscatter", "Scattering by view", "", number(0.0, 4.0)),
        /// Strength of the sunlight that the water scatters back.
        diffuse: f64 = 1.0 => ("diffuse", "Diffuse strength", "", number(0.0, 5.0)),
        /// Strength of the skylight that the water scatters back.
        ambient: f64 = 1.0 => ("ambient", "Ambient strength", "", number(0.0, 5.0)),
    }
}

words! {
    /// Formula of the Fresnel reflectance.
    pub enum Fresnel {
        /// Dielectric in unpolarised light.
        Exact = "exact",
        /// Schlick's approximation.
        Schlick = "schlick",
    }
}

words! {
    /// Distribution of the slopes that a pixel does not resolve.
    pub enum Specular {
        /// Gaussian slopes (Beckmann's distribution), as Cox and Munk measured them.
        Gaussian = "gaussian",
        /// Trowbridge and Reitz's distribution.
        Ggx = "ggx",
        /// Blinn-Phong lobe of a given shininess.
        BlinnPhong = "blinn-phong",
    }
}

parameters! {
    /// Light reflected by the surface.
    pub struct Reflection {
        /// Strength of the reflected sky.
        sky_strength: f64 = 1.0 => ("reflection", "Reflection of the sky", "", number(0.0, 2.0)),
        /// Refractive index of the water: fresh water 1.333, sea water 1.34.
        index_water: f64 = 1.333 => ("nwater", "Index of water", "", number(1.0, 3.0)),
        /// Refractive index of the air.
        index_air: f64 = 1.0 => ("nair", "Index of air", "", number(1.0, 3.0)),
        /// Formula of the Fresnel reflectance. exact: unpolarised light on a dielectric; schlick: approximation (1994).
        fresnel: Fresnel = Fresnel::Exact => ("fresnel", "Fresnel", "", Choice(Fresnel::WORDS)),
        /// With fresnel=schlick: exponent of the approximation, originally 5.
        fresnel_shine: f64 = 5.0 => ("fresnelshine", "Fresnel shine", "", number(0.0, 20.0)),
        /// Scale on the Fresnel reflectance, which stays below 1.
        fresnel_scale: f64 = 1.0 => ("fresnelscale", "Fresnel scale", "", number(0.0, 4.0)),
        /// Scale on the slope of the normal in the Fresnel reflectance.
        fresnel_normals: f64 = 1.0 => ("fresnelnormals", "Fresnel normals scale", "", number(0.0, 4.0)),
        /// Distribution of the slopes that a pixel does not resolve. gaussian: as measured at sea (Cox and Munk 1954);
        /// ggx: longer tails (Trowbridge and Reitz 1975); blinn-phong: a lobe of the given shininess.
        specular: Specular = Specular::Gaussian => ("specular", "Microfacets", "", Choice(Specular::WORDS)),
        /// With specular=blinn-phong: exponent of the lobe.
        shininess: f64 = 200.0 => ("shininess", "Shininess", "", logarithmic(1.0, 10000.0)),
        /// Strength of the sun's glitter.
        glitter: f64 = 1.0 => ("glitter", "Specular scale", "", number(0.0, 10.0)),
        /// Scale on the Fresnel reflectance in the glitter, which stays below 1.
        glitter_fresnel: f64 = 1.0 => ("glitterfresnel", "Specular Fresnel scale", "", number(0.0, 50.0)),
        /// Cosine to the surface normal: no glitter where the sun or the eye has a smaller one.
        glitter_cut: f64 = 0.0 => ("glittercut", "Specular low cut-off", "", number(0.0, 1.0)),
        /// Roughness in addition to the unresolved waves: alpha is its square, the slope variance alpha^2 / 2.
        roughness: f64 = 0.0 => ("roughness", "Water roughness", "", number(0.0, 1.0)),
    }
}

parameters! {
    /// The bed below shallow water.
    pub struct BedLook {
        /// Colour of the sand on the bed, visible in water of a few metres.
        colour: f64 = 0x00d8_ccb0 as f64 => ("bedcolour", "Bed colour", "", Colour),
        /// Share of the light that the waves focus on the bed: 1 is physical, 0 lights it evenly and costs nothing.
        caustics: f64 = 0.0 => ("caustics", "Caustics", "", number(0.0, 1.0), "off"),
    }
}

parameters! {
    /// Appearance of whitecaps.
    pub struct FoamLook {
        /// Visible amount of foam; 1 shows the computed coverage.
        amount: f64 = 1.0 => ("foam", "Foam shown", "", number(0.0, 2.0)),
        /// Colour of the foam.
        colour: f64 = WHITE => ("foamcolour", "Foam colour", "", Colour),
        /// Roughness of the wet gloss of the foam; alpha is its square.
        roughness: f64 = 0.8 => ("foamroughness", "Foam roughness", "", number(0.0, 1.0)),
        /// Height of the relief of nearby foam; 1 is a few centimetres.
        relief: f64 = 1.0 => ("foamrelief", "Foam relief", "", number(0.0, 4.0), "flat"),
    }
}
