//! What a user can set of the picture: light, water, film. Uniforms only; nothing here changes a map.

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
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Biological and mineral load of the water, 0 (clear ocean) .. 1 (coastal).
    pub turbidity: f64,
    /// Visible amount of foam, 0..2.
    pub foam: f64,
}

impl Default for Surface {
    fn default() -> Self {
        Self { turbidity: 0.15, foam: 1.0 }
    }
}

/// What the film does to light.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Film {
    /// Exposure relative to automatic, stops.
    pub exposure_ev: f64,
}
