//! Rows of the picture: sun and sky, the look of the water, film.

use super::super::look::{Fresnel, Specular};
use super::super::optics::WaterType;
use super::{Field, Group, Kind, index_of, logarithmic, number};

words!(WATERS, WATER_WORDS, WaterType,
    "i" => WaterType::I,
    "ia" => WaterType::Ia,
    "ib" => WaterType::Ib,
    "ii" => WaterType::Ii,
    "iii" => WaterType::Iii,
    "1c" => WaterType::C1,
    "3c" => WaterType::C3,
    "5c" => WaterType::C5,
    "7c" => WaterType::C7,
    "9c" => WaterType::C9,
);
words!(FRESNELS, FRESNEL_WORDS, Fresnel,
    "exact" => Fresnel::Exact,
    "schlick" => Fresnel::Schlick,
);
words!(SPECULARS, SPECULAR_WORDS, Specular,
    "gaussian" => Specular::Gaussian,
    "ggx" => Specular::Ggx,
    "blinn-phong" => Specular::BlinnPhong,
);

/// Sun and sky.
#[rustfmt::skip]
pub(super) fn sky() -> Vec<Field> { vec![
    row!("sun", "Sun height", "deg", Sky, number(-8.0, 90.0), [look.sky.sun_deg],
        "Elevation of the sun above the horizon."),
    row!("sunaz", "Sun azimuth", "deg", Sky, Kind::Heading, [look.sky.sun_azimuth_deg],
        "Azimuth of the sun, clockwise from north."),
    row!("haze", "Haze", "", Sky, number(0.0, 10.0), [look.sky.haze],
        "Aerosols relative to a clear maritime day: whiter horizon, redder sunsets."),
    row!("overcast", "Overcast", "", Sky, number(0.0, 1.0), [look.sky.overcast],
        "Share of the light that passes through a uniform cloud deck instead of a clear sky."),
]}

/// The look of water and foam.
#[rustfmt::skip]
pub(super) fn surface() -> Vec<Field> { vec![
    row!("water", "Water type", Surface, WATER_WORDS of WATERS, [look.surface.body.water],
        "Absorption and scattering by Jerlov's optical types (1976): i, the clearest blue ocean, over iii, fertile and greenish, to the coast, 1c to 9c."),
    row!("watermix", "Towards the next type", "", Surface, number(0.0, 1.0), [look.surface.body.mix],
        "Share of the way from the water type to the next muddier one."),
    row!("scattercolour", "Scatter colour", "", Surface, Kind::Colour, [look.surface.body.scatter_colour],
        "Colour of the light that deep water scatters back: white is a tenth of the light; auto follows from the water type.").zero("auto"),
    row!("bubblecolour", "Bubble colour", "", Surface, Kind::Colour, [look.surface.body.bubble_colour],
        "Colour that the bubbles under breaking waves scatter; the water takes the red out of it."),
    row!("bubbles", "Bubble density", "", Surface, number(0.0, 10.0), [look.surface.body.bubbles],
        "Density of the bubbles that breaking waves leave under the surface; 1 is a usual plume."),
    row!("heightscatter", "Scattering by height", "", Surface, number(0.0, 10.0), [look.surface.body.height],
        "Height attenuation factor: strength of the light through crests, which grows with their height and sharpness."),
    row!("viewscatter", "Scattering by view", "", Surface, number(0.0, 4.0), [look.surface.body.view],
        "Reflection strength of the scattering: how much the light from the water depends on the angle of view."),
    row!("diffuse", "Diffuse strength", "", Surface, number(0.0, 5.0), [look.surface.body.diffuse],
        "Strength of the sunlight that the water scatters back."),
    row!("ambient", "Ambient strength", "", Surface, number(0.0, 5.0), [look.surface.body.ambient],
        "Strength of the skylight that the water scatters back."),
    row!("reflection", "Reflection of the sky", "", Surface, number(0.0, 2.0), [look.surface.mirror.reflection],
        "Strength of the mirrored environment."),
    row!("nwater", "Index of water", "", Surface, number(1.0, 3.0), [look.surface.mirror.index_water],
        "Refractive index of the water: 1.333 fresh, 1.34 sea water."),
    row!("nair", "Index of air", "", Surface, number(1.0, 3.0), [look.surface.mirror.index_air],
        "Refractive index of the air."),
    row!("fresnel", "Fresnel", Surface, FRESNEL_WORDS of FRESNELS, [look.surface.mirror.fresnel],
        "exact: of a dielectric, for unpolarised light; schlick: his approximation (1994)."),
    row!("fresnelshine", "Fresnel shine", "", Surface, number(0.0, 20.0), [look.surface.mirror.fresnel_shine],
        "Exponent of Schlick's approximation; he has 5."),
    row!("fresnelscale", "Fresnel scale", "", Surface, number(0.0, 4.0), [look.surface.mirror.fresnel_scale],
        "Scale on Fresnel's reflectance, which stays below 1."),
    row!("fresnelnormals", "Fresnel normals scale", "", Surface, number(0.0, 4.0), [look.surface.mirror.fresnel_normals],
        "Scale on the slope of the normal at which Fresnel's reflectance is taken."),
    row!("specular", "Microfacets", Surface, SPECULAR_WORDS of SPECULARS, [look.surface.mirror.specular],
        "Distribution of the slopes that a pixel does not resolve. gaussian: as measured at sea (Cox and Munk 1954); ggx: longer tails (Trowbridge and Reitz 1975); blinn-phong: a lobe of the shininess below, whatever the waves."),
    row!("shininess", "Shininess", "", Surface, logarithmic(1.0, 10000.0), [look.surface.mirror.shininess],
        "Exponent of blinn-phong."),
    row!("glitter", "Specular scale", "", Surface, number(0.0, 10.0), [look.surface.mirror.glitter],
        "Strength of the sun's glitter."),
    row!("glitterfresnel", "Specular Fresnel scale", "", Surface, number(0.0, 50.0), [look.surface.mirror.glitter_fresnel],
        "Scale on Fresnel's reflectance in the glitter, which stays below 1."),
    row!("glittercut", "Specular low cut-off", "", Surface, number(0.0, 1.0), [look.surface.mirror.glitter_cut],
        "No glitter where sun or eye stand lower over the surface than this cosine."),
    row!("roughness", "Water roughness", "", Surface, number(0.0, 1.0), [look.surface.mirror.roughness],
        "Roughness in addition to the waves that are not drawn; alpha is its square, the variance of the slope alpha^2 / 2."),
    row!("bedcolour", "Bed colour", "", Surface, Kind::Colour, [look.surface.bed.colour],
        "Colour of the sand on the bed; it is seen in water of a few metres."),
    row!("caustics", "Caustics", "", Surface, number(0.0, 1.0), [look.surface.bed.caustics],
        "Light that the waves focus on the bed: 1 is the physical amount, 0 leaves it evenly lit and costs nothing.").zero("off"),
    row!("foam", "Foam shown", "", Foam, number(0.0, 2.0), [look.surface.foam.shown],
        "Visible amount of foam; 1 shows the coverage that was computed."),
    row!("foamcolour", "Foam colour", "", Foam, Kind::Colour, [look.surface.foam.colour],
        "Colour of foam."),
    row!("foamroughness", "Foam roughness", "", Foam, number(0.0, 1.0), [look.surface.foam.roughness],
        "Roughness of the wet gloss of foam; alpha is its square."),
    row!("foamrelief", "Foam relief", "", Foam, number(0.0, 4.0), [look.surface.foam.relief],
        "Height of the lumps and bubbles of foam close by; 1 is a few centimetres.").zero("flat"),
]}

/// What film does to light.
#[rustfmt::skip]
pub(super) fn film() -> Vec<Field> { vec![
    row!("exposure", "Exposure", "EV", Film, number(-4.0, 4.0), [look.film.exposure_ev],
        "Brighter or darker than the automatic exposure, in stops."),
]}
