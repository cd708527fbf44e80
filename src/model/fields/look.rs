//! Rows of the picture: sun and sky, the look of the water, film.

use super::{Field, Group, Kind, number};

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
    row!("turbidity", "Turbid water", "", Surface, number(0.0, 1.0), [look.surface.turbidity],
        "0 is the clear blue of the open ocean, 1 the green of coastal water."),
    row!("foam", "Foam shown", "", Foam, number(0.0, 2.0), [look.surface.foam],
        "Visible amount of foam; 1 shows the coverage that was computed."),
]}

/// What film does to light.
#[rustfmt::skip]
pub(super) fn film() -> Vec<Field> { vec![
    row!("exposure", "Exposure", "EV", Film, number(-4.0, 4.0), [look.film.exposure_ev],
        "Brighter or darker than the automatic exposure, in stops."),
]}
