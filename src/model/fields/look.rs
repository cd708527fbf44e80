//! Rows of the picture: sun and sky, the look of the water, film.

use super::super::look::{SunBy, Tone};
use super::{Field, Group, Kind, index_of, logarithmic, number};

words!(SUN_BY, SUN_BY_WORDS, SunBy,
    "direction" => SunBy::Direction,
    "date" => SunBy::Date,
);
words!(TONES, TONE_WORDS, Tone,
    "agx" => Tone::Agx,
    "aces" => Tone::Aces,
    "reinhard" => Tone::Reinhard,
    "neutral" => Tone::Neutral,
    "linear" => Tone::Linear,
);

/// Sun and sky.
#[rustfmt::skip]
pub(super) fn sky() -> Vec<Field> { vec![
    row!("sunby", "Sun by", Sky, SUN_BY_WORDS of SUN_BY, [look.sky.sun_by],
        "What the sun's place follows from: direction, its height and azimuth as given; date, the day, the hour and the latitude."),
    row!("sun", "Sun height", "deg", Sky, number(-24.0, 90.0), [look.sky.sun_deg],
        "Elevation of the sun above the horizon: from -6 it is dusk, below -18 night."),
    row!("sunaz", "Sun azimuth", "deg", Sky, Kind::Heading, [look.sky.sun_azimuth_deg],
        "Azimuth of the sun, clockwise from north."),
    row!("day", "Day of the year", "", Sky, Kind::Integer { min: 1, max: 366 }, [look.sky.day],
        "With sunby=date: 1 is the first of January, 80 the March equinox, 172 the June solstice, 355 that of December (Spencer 1971)."),
    row!("hour", "Solar time", "h", Sky, number(0.0, 24.0), [look.sky.hour],
        "With sunby=date: true solar time, the sun is highest at 12."),
    row!("lat", "Latitude", "deg", Sky, number(-90.0, 90.0), [look.sky.latitude_deg],
        "With sunby=date: geographic latitude, north of the equator positive."),
    row!("suncolour", "Sun colour", "", Sky, Kind::Colour, [look.sky.sun_colour],
        "Tint of the sunlight above the air, and so of all light of the day; white is our sun's."),
    row!("sunsize", "Sun size", "deg", Sky, logarithmic(0.1, 10.0), [look.sky.sun_size_deg],
        "Angular diameter of the sun's disc at a distance of one astronomical unit; its irradiance stays."),
    row!("sundistance", "Sun distance", "au", Sky, logarithmic(0.1, 10.0), [look.sky.sun_distance_au],
        "Distance of the sun in astronomical units: its irradiance falls with the square, its apparent size with the first power. Venus 0.72, Mars 1.52."),
    row!("sunfalloff", "Limb darkening", "", Sky, number(0.0, 4.0), [look.sky.sun_falloff],
        "Radiance over the sun's disc is the cosine to this power: 0 an even disc, 0.45 the sun in green light (Hestroffer and Magnan 1998), more a soft ball; its irradiance stays."),
    row!("haze", "Haze", "", Sky, number(0.0, 10.0), [look.sky.haze],
        "Aerosols relative to a clear maritime day: whiter horizon, redder sunsets."),
    row!("overcast", "Overcast", "", Sky, number(0.0, 1.0), [look.sky.overcast],
        "Share of the light that passes through a uniform cloud deck instead of a clear sky."),
    row!("fog", "Fog", "1/km", Sky, number(0.0, 100.0), [look.sky.fog.extinction_per_km],
        "Extinction of the fog below its top: one sees about 4 km divided by it; 1 is mist, 4 fog, 40 thick fog.").zero("none"),
    row!("fogstart", "Fog begins", "m", Sky, number(0.0, 10000.0), [look.sky.fog.start_m],
        "Distance from the eye at which the fog begins."),
    row!("fogfalloff", "Fog falls off", "m", Sky, logarithmic(1.0, 2000.0), [look.sky.fog.falloff_m],
        "Height above its top over which the fog thins to 1/e."),
    row!("fogheight", "Fog top", "m", Sky, number(0.0, 2000.0), [look.sky.fog.height_m],
        "Height above the water up to which the fog has its full density."),
    row!("skyturn", "Turn the sky", "deg", Sky, Kind::Heading, [look.sky.turn_deg],
        "Heading of the middle of a sky from a file, clockwise from north."),
    row!("skygain", "Sky brightness", "EV", Sky, number(-8.0, 8.0), [look.sky.gain_ev],
        "Brighter or darker than a sky from a file is taken to be, in stops: at 0 it lights the sea like a clear noon."),
]}

/// The look of water and foam.
#[rustfmt::skip]
pub(super) fn surface() -> Vec<Field> { vec![
    row!("turbidity", "Turbid water", "", Surface, number(0.0, 1.0), [look.surface.turbidity],
        "0 is the clear blue of the open ocean, 1 the green of coastal water."),
    row!("foam", "Foam shown", "", Foam, number(0.0, 2.0), [look.surface.foam],
        "Visible amount of foam; 1 shows the coverage that was computed."),
]}

/// What film does to light.
#[rustfmt::skip]
pub(super) fn film() -> Vec<Field> { vec![
    row!("autoexposure", "Automatic exposure", Film, flag [look.film.auto_exposure],
        "The exposure follows the light, though not wholly: dusk stays darker than noon, and night is night."),
    row!("exposure", "Exposure", "EV", Film, number(-8.0, 24.0), [look.film.exposure_ev],
        "Stops over the automatic exposure; without that, over what a clear noon (sun at 60 degrees) needs: a sunset wants about 3, dusk 8, a moonless night 20."),
    row!("tone", "Tone curve", Film, TONE_WORDS of TONES, [look.film.tone],
        "From light to the screen: agx (Sobotka 2022), with a little contrast and saturation added; aces, as fitted by Hill (2016); reinhard, x/(1+x) (2002); neutral, Khronos PBR Neutral (2024); linear, cut off at white."),
    row!("bloom", "Bloom", "", Film, number(0.0, 1.0), [look.film.bloom],
        "Share of the light that the lens spreads around bright things (Jimenez 2014); none is lost. 0.04 is a clean lens, 0.3 a misted one.").zero("off"),
    row!("dither", "Dither", Film, flag [look.film.dither],
        "Noise of one step of eight bits hides the bands of smooth skies."),
]}
