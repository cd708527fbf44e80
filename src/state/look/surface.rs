//! Appearance of the water, its foam and the sea bed.

use crate::optics::water::WaterType;
use crate::state::field::FieldKind::{Choice, Colour, Flag};
use crate::state::field::{FieldValue, WHITE_RGB, choice_enum, logarithmic, number, parameters};

/// Appearance of the water, its foam and the sea bed.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct SurfaceLook {
    /// Parameters of the light that the water and its bubbles scatter back out.
    pub scattering: Scattering,
    /// Parameters of the light that the water surface reflects.
    pub reflection: Reflection,
    /// Appearance of whitecaps.
    pub foam: FoamLook,
    /// Appearance of the sea bed, which is visible through shallow water.
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
    /// Light that the water and its bubbles scatter back out. A factor of 1 is physical.
    pub struct Scattering {
        /// Jerlov's optical water type (1976), which sets absorption and scattering: i, the clearest blue ocean, to
        /// iii, fertile and greenish; 1c, the clearest coastal water, to 9c, the muddiest.
        water_type: WaterType = WaterType::Ib => ("water", "Water type", "", Choice(WaterType::NAMES)),
        /// Interpolation from the water type (0) to the next muddier water type (1).
        water_type_blend: f64 = 0.0 => ("watermix", "Towards the next type", "", number(0.0, 1.0)),
        /// Colour of the light that deep water scatters back: white scatters back a tenth of the light; auto derives
        /// the colour from the water type.
        scatter_colour: f64 = 0.0 => ("scattercolour", "Scatter colour", "", Colour, "auto"),
        /// Colour of the light that bubbles under breaking waves scatter, before the water absorbs part of its red.
        bubble_colour: f64 = WHITE_RGB => ("bubblecolour", "Bubble colour", "", Colour),
        /// Density of the bubbles that breaking waves leave under the surface; 1 is a typical plume.
        bubble_density: f64 = 1.0 => ("bubbles", "Bubble density", "", number(0.0, 10.0)),
        /// Brightness of the light that shines through wave crests, most of all through high and sharp ones; 1 is
        /// physical.
        crest_transmission: f64 = 1.0 => ("heightscatter", "Scattering by height", "", number(0.0, 10.0)),
        /// How much the light scattered out of the water depends on the viewing angle: 1 is single scattering, brighter
        /// towards flat angles; 0 is no dependence. The factor on cos^2 of view and normal in game shaders (k2), which
        /// brightens water seen from above, has this place, but not this meaning.
        scatter_view_dependence: f64 = 1.0 => ("viewscatter", "Scattering by view", "", number(0.0, 4.0)),
        /// Factor on the sunlight that the water scatters back; 1 is physical.
        diffuse_strength: f64 = 1.0 => ("diffuse", "Diffuse strength", "", number(0.0, 5.0)),
        /// Factor on the skylight that the water scatters back; 1 is physical.
        ambient_strength: f64 = 1.0 => ("ambient", "Ambient strength", "", number(0.0, 5.0)),
    }
}

choice_enum! {
    /// Formula for the Fresnel reflectance of the water.
    pub enum FresnelFormula {
        /// Exact Fresnel equations of a dielectric for unpolarised light.
        Exact = "exact",
        /// Schlick's approximation of the Fresnel reflectance, 1994.
        Schlick = "schlick",
    }
}

choice_enum! {
    /// Microfacet distribution: distribution of the wave slopes that a pixel does not resolve.
    pub enum MicrofacetDistribution {
        /// Gaussian slopes (Beckmann's distribution), as Cox and Munk measured them at sea in 1954.
        Gaussian = "gaussian",
        /// Slope distribution GGX of Trowbridge and Reitz 1975, with longer tails than a Gaussian.
        Ggx = "ggx",
        /// Blinn-Phong lobe, a power of the cosine of the tilt; the user sets the exponent (parameter `shininess`).
        BlinnPhong = "blinn-phong",
    }
}

parameters! {
    /// Light reflected by the water surface: sky, sun glitter and the Fresnel reflectance of both.
    pub struct Reflection {
        /// Factor on the sky that the water reflects; 1 is physical.
        sky_strength: f64 = 1.0 => ("reflection", "Reflection of the sky", "", number(0.0, 2.0)),
        /// Refractive index of the water: fresh water 1.333, sea water 1.34.
        index_water: f64 = 1.333 => ("nwater", "Index of water", "", number(1.0, 3.0)),
        /// Refractive index of the air.
        index_air: f64 = 1.0 => ("nair", "Index of air", "", number(1.0, 3.0)),
        /// Formula for the Fresnel reflectance. exact: for unpolarised light; schlick: Schlick's approximation (1994).
        fresnel: FresnelFormula = FresnelFormula::Exact => ("fresnel", "Fresnel", "", Choice(FresnelFormula::WORDS)),
        /// With fresnel=schlick: exponent of Schlick's approximation, originally 5.
        schlick_exponent: f64 = 5.0 => ("fresnelshine", "Fresnel shine", "", number(0.0, 20.0)),
        /// Factor on the Fresnel reflectance of the water; the product is limited to 1.
        fresnel_scale: f64 = 1.0 => ("fresnelscale", "Fresnel scale", "", number(0.0, 4.0)),
        /// Factor on the slope of the surface normal from which the Fresnel reflectance is computed; 1 is physical.
        fresnel_slope_factor: f64 = 1.0 => ("fresnelnormals", "Fresnel normals scale", "", number(0.0, 4.0)),
        /// Microfacet distribution, that of wave slopes within a pixel. gaussian: as measured at sea (Cox and Munk
        /// 1954); ggx: longer tails (Trowbridge and Reitz 1975); blinn-phong: a lobe of the given shininess.
        specular: MicrofacetDistribution = MicrofacetDistribution::Gaussian
            => ("specular", "Microfacets", "", Choice(MicrofacetDistribution::WORDS)),
        /// With specular=blinn-phong: exponent of the lobe; a larger one makes a sharper highlight.
        shininess: f64 = 200.0 => ("shininess", "Shininess", "", logarithmic(1.0, 10000.0)),
        /// Factor on the sun glitter, the sun's specular reflection; 1 is physical.
        glitter_strength: f64 = 1.0 => ("glitter", "Specular scale", "", number(0.0, 10.0)),
        /// Additional factor on the Fresnel reflectance for the sun glitter only; the product is limited to 1.
        glitter_fresnel_scale: f64 = 1.0 => ("glitterfresnel", "Specular Fresnel scale", "", number(0.0, 50.0)),
        /// Grazing-angle cut-off of the sun glitter: where the cosine between the surface normal and the direction of
        /// the sun or the eye falls below this value, it fades, to nothing at half of it.
        glitter_min_cosine: f64 = 0.0 => ("glittercut", "Specular low cut-off", "", number(0.0, 1.0)),
        /// Roughness r of the water in addition to the unresolved waves: adds r^4 / 2 to the slope variance along each
        /// axis.
        roughness: f64 = 0.0 => ("roughness", "Water roughness", "", number(0.0, 1.0)),
        /// Shows the sun's glitter as separate glints, whose number in a pixel is random (Longuet-Higgins 1960); the mean
        /// light does not change.
        glints: bool = false => ("glints", "Separate glints", "", Flag),
        /// How much gusts and slicks vary the slope variance of the short waves from place to place: 1 is typical of a
        /// steady wind. The mean over the sea does not change.
        gusts: f64 = 0.0 => ("gusts", "Gusts and slicks", "", number(0.0, 1.0), "even"),
    }
}

parameters! {
    /// Sea bed, visible through shallow water.
    pub struct BedLook {
        /// Colour of the sand on the sea bed, visible in water of a few metres.
        colour: f64 = 0x00a6_9c89 as f64 => ("bedcolour", "Bed colour", "", Colour),
        /// Fraction of the bed under seagrass and coral reefs, in patches of many sizes; 0 is bare sand.
        cover: f64 = 0.25 => ("bedcover", "Seagrass and reefs", "", number(0.0, 1.0), "sand"),
        /// Strength of caustics, sunlight focused on the sea bed by waves: 1 is physical; 0 lights the bed evenly and
        /// costs no time.
        caustics: f64 = 0.0 => ("caustics", "Caustics", "", number(0.0, 1.0), "off"),
    }
}

parameters! {
    /// Appearance of whitecaps.
    pub struct FoamLook {
        /// Factor on the visible foam; 1 shows the coverage that the simulation computes. It changes what is seen, not what
        /// breaks (foambias, foamrate): 0 hides the foam and leaves the bubbles under it (bubbles).
        coverage_factor: f64 = 1.0 => ("foam", "Foam shown", "", number(0.0, 2.0)),
        /// Colour of the foam.
        colour: f64 = WHITE_RGB => ("foamcolour", "Foam colour", "", Colour),
        /// Roughness r of the specular reflection of wet foam, GGX with alpha = r^2.
        roughness: f64 = 0.8 => ("foamroughness", "Foam roughness", "", number(0.0, 1.0)),
        /// Height of the relief (bumps) of nearby foam; 1 is a few centimetres.
        relief: f64 = 1.0 => ("foamrelief", "Foam relief", "", number(0.0, 4.0), "flat"),
        /// Spray that the wind tears off breaking crests, above 12 m/s and more in a stronger wind, and that surf and
        /// waves on stone throw up at a coast; 1 is typical. A camera under water sees none.
        spray: f64 = 0.0 => ("spray", "Spray", "", number(0.0, 1.0), "none"),
    }
}
