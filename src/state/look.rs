//! What a user can set of the picture: light, water, film. Uniforms only; nothing here changes a map.

use super::views;
use crate::files::panorama::Panorama;
use crate::optics::sun;
use crate::optics::water::WaterType;
use std::sync::Arc;

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

/// What the sun's place follows from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SunBy {
    /// Elevation and azimuth as given.
    Direction,
    /// Date, time and latitude.
    Date,
}

/// Sun and sky.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyLook {
    /// What the sun's place follows from.
    pub sun_by: SunBy,
    /// Elevation of the sun above the horizon, degrees.
    pub sun_deg: f64,
    /// Azimuth of the sun, degrees clockwise from north.
    pub sun_azimuth_deg: f64,
    /// Day of the year, 1 is the first of January.
    pub day: f64,
    /// True solar time, h.
    pub hour: f64,
    /// Geographic latitude, degrees, north positive.
    pub latitude_deg: f64,
    /// Tint of the sunlight, 0xRRGGBB.
    pub sun_colour: f64,
    /// Angular diameter of the sun at a distance of one astronomical unit, degrees.
    pub sun_size_deg: f64,
    /// Distance of the sun, astronomical units.
    pub sun_distance_au: f64,
    /// Exponent of the limb darkening.
    pub sun_falloff: f64,
    /// Aerosol amount relative to a clear maritime day.
    pub haze: f64,
    /// Share of the sky behind a uniform cloud deck, 0..1.
    pub overcast: f64,
    /// Height fog.
    pub fog: Fog,
    /// A sky from a file in place of the built one.
    pub file: Option<SkyFile>,
    /// Heading of the middle of the file, degrees clockwise from north.
    pub turn_deg: f64,
    /// Brightness of the file, stops.
    pub gain_ev: f64,
}

impl Default for SkyLook {
    fn default() -> Self {
        Self {
            sun_by: SunBy::Direction,
            sun_deg: 24.0,
            sun_azimuth_deg: 340.0,
            day: 172.0,
            hour: 9.0,
            latitude_deg: 45.0,
            sun_colour: f64::from(0x00ff_ffff),
            sun_size_deg: 0.53,
            sun_distance_au: 1.0,
            sun_falloff: 0.45,
            haze: 1.0,
            overcast: 0.0,
            fog: Fog::default(),
            file: None,
            turn_deg: 0.0,
            gain_ev: 0.0,
        }
    }
}

impl SkyLook {
    /// The file's sky, if it is at hand.
    pub fn panorama(&self) -> Option<&Arc<Panorama>> {
        self.file.as_ref()?.image.as_ref()
    }

    /// Elevation and azimuth of the sun that lights the sea, degrees: that of the file, if it shows one.
    pub fn sun_place_deg(&self) -> [f64; 2] {
        if let Some(sun) = self.panorama().and_then(|p| p.sun.as_ref()) {
            return [sun.elevation_deg, (sun.azimuth_deg + self.turn_deg).rem_euclid(360.0)];
        }
        match self.sun_by {
            SunBy::Direction => [self.sun_deg, self.sun_azimuth_deg],
            SunBy::Date => sun::position(self.day, self.hour, self.latitude_deg),
        }
    }

    /// Unit vector to the sun: x east, y up, z south.
    pub fn sun_direction(&self) -> [f64; 3] {
        let [elevation, azimuth] = self.sun_place_deg().map(f64::to_radians);
        [azimuth.sin() * elevation.cos(), elevation.sin(), -azimuth.cos() * elevation.cos()]
    }

    /// Half of the angle under which the sun's disc is seen, rad.
    pub fn sun_radius_rad(&self) -> f64 {
        (0.5 * self.sun_size_deg.to_radians() / self.sun_distance_au).min(1.0)
    }

    /// Gives the sky that a link names its image, if this is the one.
    pub fn attach(&mut self, loaded: Option<&SkyFile>) {
        if let (Some(wanted), Some(loaded)) = (&mut self.file, loaded)
            && wanted.name == loaded.name
        {
            wanted.image.clone_from(&loaded.image);
        }
    }

    /// What to say when a link names a sky that is not at hand.
    pub fn missing_file(&self) -> Option<String> {
        let file = self.file.as_ref().filter(|f| f.image.is_none())?;
        Some(format!(
            "the sky \"{}\" is not loaded, the built one is shown: drop the file on the sea, or give it by --sky",
            file.name
        ))
    }
}

/// A sky's file: a link carries its name alone.
#[derive(Clone, Debug)]
pub struct SkyFile {
    /// Name without folders, printable and short.
    pub name: String,
    /// What it shows, once it has been read.
    pub image: Option<Arc<Panorama>>,
}

impl PartialEq for SkyFile {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.image.as_ref().map(Arc::as_ptr) == other.image.as_ref().map(Arc::as_ptr)
    }
}

/// Longest name of a sky's file, characters.
const MAX_NAME: usize = 80;

impl SkyFile {
    /// A file by its name or path; none if nothing of it can be printed.
    pub fn named(path: &str) -> Option<Self> {
        let last = path.rsplit(['/', '\\']).next().unwrap_or_default();
        let name: String = last.chars().filter(|c| !c.is_control()).take(MAX_NAME).collect();
        let name = name.trim().to_owned();
        (!name.is_empty()).then_some(Self { name, image: None })
    }
}

/// Height fog.
#[derive(Clone, Debug, PartialEq)]
pub struct Fog {
    /// Extinction up to the top, 1/km; 0 is no fog.
    pub extinction_per_km: f64,
    /// Distance from the eye at which it begins, m.
    pub start_m: f64,
    /// e-folding height above the top, m.
    pub falloff_m: f64,
    /// Height of the top of full density above the water, m.
    pub height_m: f64,
}

impl Default for Fog {
    fn default() -> Self {
        Self { extinction_per_km: 0.0, start_m: 0.0, falloff_m: 30.0, height_m: 20.0 }
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

/// The curve from light to the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// AgX, Sobotka 2022.
    Agx,
    /// ACES, reference and output transform as fitted by Hill 2016.
    Aces,
    /// x / (1 + x), Reinhard et al. 2002.
    Reinhard,
    /// Khronos PBR Neutral, 2024.
    Neutral,
    /// None but the limits of the screen.
    Linear,
}

/// What the film does to light.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Whether the exposure follows the light.
    pub auto_exposure: bool,
    /// Exposure relative to automatic, or to that of a clear noon, stops.
    pub exposure_ev: f64,
    /// Tone curve.
    pub tone: Tone,
    /// Share of the light that the lens spreads around bright things.
    pub bloom: f64,
    /// Whether noise hides the steps of eight bits.
    pub dither: bool,
}

impl Default for Film {
    fn default() -> Self {
        Self { auto_exposure: true, exposure_ev: 0.0, tone: Tone::Agx, bloom: 0.0, dither: true }
    }
}
