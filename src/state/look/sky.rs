//! Parameters of sun, sky and fog, and the sky image that the user may load from a file.

use crate::files::panorama::Panorama;
use crate::optics::sun;
use crate::state::field::FieldKind::{Choice, Colour, Heading};
use crate::state::field::{WHITE_RGB, choice_enum, integer, logarithmic, number, parameters};
use crate::state::text::printable_prefix;
use std::sync::Arc;

choice_enum! {
    /// How the user gives the position of the sun.
    pub enum SunPlacement {
        /// The user gives elevation and azimuth of the sun (parameters `sun` and `sunaz`).
        Direction = "direction",
        /// The user gives day of the year, solar time and latitude (parameters `day`, `hour` and `lat`).
        Date = "date",
    }
}

choice_enum! {
    /// Kind of the volumetric clouds.
    pub enum CloudKind {
        /// No volumetric clouds.
        None = "none",
        /// Fair-weather cumulus: separate heaps with flat bases.
        Cumulus = "cumulus",
        /// A broken layer of low rolls and pancakes.
        Stratocumulus = "stratocumulus",
        /// Cumulus congestus: towers kilometres high.
        Towering = "towering",
        /// Thin fibrous ice clouds 9 km high, combed by the wind.
        Cirrus = "cirrus",
        /// The low, thick and dark deck of a storm.
        Storm = "storm",
    }
}

parameters! {
    /// Parameters of sun, sky and fog.
    pub struct SkyLook {
        /// How the position of the sun is given. direction: by elevation and azimuth; date: by day, hour and latitude.
        sun_placement: SunPlacement = SunPlacement::Direction => ("sunby", "Sun by", "", Choice(SunPlacement::WORDS)),
        /// Elevation of the sun above the horizon: 0 to -12 is dusk or dawn, below -12 it is night.
        sun_elevation_deg: f64 = 24.0 => ("sun", "Sun height", "deg", number(-24.0, 90.0)),
        /// Azimuth of the sun, clockwise from north.
        sun_azimuth_deg: f64 = 340.0 => ("sunaz", "Sun azimuth", "deg", Heading),
        /// With sunby=date: day of the year. 1 is 1 January, 80 the March equinox, 172 the June solstice, 355 the
        /// December solstice (Spencer 1971).
        day: f64 = 172.0 => ("day", "Day of the year", "", integer(1, 366)),
        /// With sunby=date: true solar time; the sun is highest at 12.
        hour: f64 = 9.0 => ("hour", "Solar time", "h", number(0.0, 24.0)),
        /// With sunby=date: geographic latitude, north positive.
        latitude_deg: f64 = 45.0 => ("lat", "Latitude", "deg", number(-90.0, 90.0)),
        /// With sunby=date: hours by which the day runs on in each minute of the simulated time; `hour` is that at time 0.
        /// At 4 a day takes six minutes.
        daylight_h_per_min: f64 = 0.0 => ("daylight", "Running day", "h/min", number(0.0, 60.0), "off"),
        /// Tint of the sunlight above the atmosphere, and so of all daylight; white is our sun.
        sun_colour: f64 = WHITE_RGB => ("suncolour", "Sun colour", "", Colour),
        /// Angular diameter of the sun at a distance of one astronomical unit; it does not change the irradiance.
        sun_size_deg: f64 = 0.53 => ("sunsize", "Sun size", "deg", logarithmic(0.1, 10.0)),
        /// Distance of the sun. Irradiance falls with its square, apparent diameter with its first power. Venus 0.72,
        /// Mars 1.52.
        sun_distance_au: f64 = 1.0 => ("sundistance", "Sun distance", "au", logarithmic(0.1, 10.0)),
        /// Exponent of the limb darkening: the cosine of the emission angle to this power is the relative radiance. 0
        /// is an even disc, 0.45 the sun in green light (Hestroffer and Magnan 1998); the irradiance does not change.
        limb_darkening_exponent: f64 = 0.45 => ("sunfalloff", "Limb darkening", "", number(0.0, 4.0)),
        /// Amount of aerosol relative to a clear maritime day: more gives a whiter horizon and redder sunsets.
        haze: f64 = 1.0 => ("haze", "Haze", "", number(0.0, 10.0)),
        /// Cloud cover: blends from a clear sky (0) to a uniform cloud layer (1).
        overcast: f64 = 0.0 => ("overcast", "Overcast", "", number(0.0, 1.0)),
        /// Kind of the clouds: none; cumulus of fair weather; stratocumulus, a broken low layer; towering cumulus; cirrus,
        /// high and thin; storm, a low dark deck. They drift with the wind and shade the sea. With clouds, the cover
        /// `overcast` is a veil behind them.
        clouds: CloudKind = CloudKind::None => ("clouds", "Clouds", "", Choice(CloudKind::WORDS)),
        /// Fraction of the sky that the clouds cover, if there are any.
        cloud_cover: f64 = 0.35 => ("cloudcover", "Cloud cover", "", number(0.0, 1.0)),
        /// Extinction coefficient of the fog below its top. The visibility in km is about 4 divided by this value: 1 is
        /// mist, 4 fog, 40 thick fog.
        fog_extinction_per_km: f64 = 0.0 => ("fog", "Fog", "1/km", number(0.0, 100.0), "none"),
        /// Distance from the eye at which the fog begins; nearer air has no fog.
        fog_start_m: f64 = 0.0 => ("fogstart", "Fog begins", "m", number(0.0, 10000.0)),
        /// Height over which the fog above its top thins to 1/e.
        fog_scale_height_m: f64 = 30.0 => ("fogfalloff", "Fog falls off", "m", logarithmic(1.0, 2000.0)),
        /// Height of the fog's top above the still water; below it the fog has its full density.
        fog_top_m: f64 = 20.0 => ("fogheight", "Fog top", "m", number(0.0, 2000.0)),
        /// Colour of the light that the fog scatters: white is a fog of droplets, brown one of dust or smoke. It does not
        /// change how far one sees, nor the colour of rain.
        fog_colour: f64 = WHITE_RGB => ("fogcolour", "Fog colour", "", Colour),
        /// Rain on the sea and in the air above it: 1 is light, 10 heavy, 50 a cloudburst. It hides what is far away and
        /// roughens the water, but makes no clouds: `clouds=storm` or `overcast=1` suit it. A camera under water sees no
        /// drops.
        rain_mm_h: f64 = 0.0 => ("rain", "Rain", "mm/h", number(0.0, 100.0), "none"),
        /// Fraction of the area below clouds in which shafts of rain fall, seen at a distance; for clouds other than
        /// cirrus.
        squalls: f64 = 0.0 => ("squalls", "Squalls", "", number(0.0, 1.0), "none"),
        /// Sky image from a file, which replaces the computed sky; `None` for the computed sky.
        file: Option<SkyFile> = None,
        /// Heading to which the middle column of a sky image points, clockwise from north.
        file_heading_deg: f64 = 0.0 => ("skyturn", "Turn the sky", "deg", Heading),
        /// Brightness of a sky image, in stops: at 0 it lights the sea like a clear noon, +1 doubles the light.
        file_gain_ev: f64 = 0.0 => ("skygain", "Sky brightness", "EV", number(-8.0, 8.0)),
    }
}

impl SkyLook {
    /// Decoded sky image; `None` if these parameters name no sky file, or its image is not loaded.
    pub fn panorama(&self) -> Option<&Arc<Panorama>> {
        self.file.as_ref()?.image.as_ref()
    }

    /// Whether there is fog or rain in the air, which hide what is far away.
    pub fn has_fog(&self) -> bool {
        self.fog_extinction_per_km > 0.0 || self.rain_mm_h > 0.0
    }

    /// Fraction of the area below the clouds in which shafts of rain are drawn.
    pub fn drawn_squalls(&self) -> f64 {
        if matches!(self.drawn_clouds(), CloudKind::None | CloudKind::Cirrus) { 0.0 } else { self.squalls }
    }

    /// Kind of the volumetric clouds that are drawn: none with a sky image, which has its own clouds.
    pub fn drawn_clouds(&self) -> CloudKind {
        if self.panorama().is_some() { CloudKind::None } else { self.clouds }
    }

    /// Elevation and azimuth (clockwise from north) of the sun that lights the sea, degrees: those of the sun in the
    /// sky image, if one is loaded and shows a sun, else those of the parameters.
    pub fn sun_elevation_azimuth_deg(&self) -> [f64; 2] {
        if let Some(sun) = self.panorama().and_then(|p| p.sun.as_ref()) {
            return [sun.elevation_deg, (sun.azimuth_deg + self.file_heading_deg).rem_euclid(360.0)];
        }
        match self.sun_placement {
            SunPlacement::Direction => [self.sun_elevation_deg, self.sun_azimuth_deg],
            SunPlacement::Date => sun::elevation_azimuth_deg(self.day, self.hour, self.latitude_deg),
        }
    }

    /// Unit vector towards the sun that lights the sea (x east, y up, z south): the sun of the sky image, if one is
    /// loaded and shows a sun, else that of the parameters.
    pub fn sun_direction(&self) -> [f64; 3] {
        let [elevation, azimuth] = self.sun_elevation_azimuth_deg().map(f64::to_radians);
        [azimuth.sin() * elevation.cos(), elevation.sin(), -azimuth.cos() * elevation.cos()]
    }

    /// Angular radius of the computed sun (not that of a sky image), rad, from the parameters `sunsize` and
    /// `sundistance`.
    pub fn sun_radius_rad(&self) -> f64 {
        (0.5 * self.sun_size_deg.to_radians() / self.sun_distance_au).min(1.0)
    }

    /// Copies the decoded image of `loaded`, an earlier sky file, to the sky file of these parameters, if both have the
    /// same name. Changes nothing if the names differ or either file is None.
    pub fn adopt_loaded_image(&mut self, loaded: Option<&SkyFile>) {
        if let (Some(wanted), Some(loaded)) = (&mut self.file, loaded)
            && wanted.name == loaded.name
        {
            wanted.image.clone_from(&loaded.image);
        }
    }

    /// Notice for the user if these parameters name a sky file whose image is not loaded, else `None`.
    pub fn missing_file_notice(&self) -> Option<String> {
        let file = self.file.as_ref().filter(|f| f.image.is_none())?;
        Some(format!(
            "the sky \"{}\" is not loaded, the computed sky is shown: drop the file on the sea, or name it with --sky",
            file.name
        ))
    }
}

/// Sky image from a file. A state string carries only the name of the file.
#[derive(Clone, Debug)]
pub struct SkyFile {
    /// File name of the sky image that the user opened, without folders: at most 80 printable characters. It stands
    /// in the state string, from which the image itself cannot be loaded.
    pub name: String,
    /// Decoded image; `None` until the file is loaded.
    pub image: Option<Arc<Panorama>>,
}

impl PartialEq for SkyFile {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.image.as_ref().map(Arc::as_ptr) == other.image.as_ref().map(Arc::as_ptr)
    }
}

impl SkyFile {
    /// Makes a sky file with the name at the end of `path` and no image; `None` if the name has no printable character.
    pub fn from_path(path: &str) -> Option<Self> {
        let name = printable_prefix(path.rsplit(['/', '\\']).next().unwrap_or_default(), 80);
        (!name.is_empty()).then_some(Self { name, image: None })
    }
}
