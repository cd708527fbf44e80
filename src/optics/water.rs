//! Absorption and scattering of natural waters at the red, green and blue of the display, by Jerlov's water types.
//!
//! Jerlov (1976) tabulates the diffuse attenuation Kd of each type. Chlorophyll follows from Kd at 490 nm, scattering
//! and backscattering from chlorophyll (Morel and Maritorena 2001), absorption from Kd and backscattering. The colour of
//! deep water is that of its whole spectrum of reflectance, seen with the CIE 1931 observer: the reflectance at three
//! wavelengths would be 8 degrees of hue too purple in blue water.

use super::colour;

/// Shortest wavelength of Jerlov's attenuation table, nm.
const FIRST_WAVELENGTH_NM: f64 = 400.0;
/// Difference between successive wavelengths of Jerlov's attenuation table, nm.
const WAVELENGTH_STEP_NM: f64 = 25.0;
/// Wavelengths, nm, at which the tables of optical properties are read for the display's red, green and blue.
const PRIMARY_WAVELENGTHS_NM: [f64; 3] = [610.0, 550.0, 465.0];
/// Absorption coefficients of pure water at [`PRIMARY_WAVELENGTHS_NM`] (red, green, blue), 1/m (Pope and Fry 1997).
const PURE_WATER_ABSORPTION_PER_M: [f64; 3] = [0.2644, 0.0565, 0.0101];
/// Mean cosine of the angle of downwelling light to the vertical. Absorption plus backscattering is this value times
/// the diffuse attenuation coefficient Kd.
const DOWNWELLING_MEAN_COSINE: f64 = 0.9;
/// Backward part of the light scattered by the mineral particles of coastal water, as a fraction of all light that they
/// scatter (Petzold 1972).
const COASTAL_BACKSCATTER_RATIO: f64 = 0.013;
/// Factor of backscattering over absorption in the irradiance reflectance of deep water (Morel and Prieur 1977).
const REFLECTANCE_PER_BACKSCATTER: f64 = 0.33;
/// Smallest irradiance reflectance of deep water in a channel of the display.
const MIN_REFLECTANCE: f64 = 2e-4;

/// Jerlov's optical types of ocean (I to III) and coastal water (1C to 9C), clearest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WaterType {
    /// Jerlov type I: the clearest ocean water.
    I,
    /// Jerlov type IA: clear tropical ocean.
    Ia,
    /// Jerlov type IB: subtropical ocean.
    Ib,
    /// Jerlov type II: mid-latitude ocean.
    Ii,
    /// Jerlov type III: fertile, greenish ocean.
    Iii,
    /// Jerlov type 1C: clear coastal water.
    C1,
    /// Jerlov type 3C: ordinary coastal water.
    C3,
    /// Jerlov type 5C: turbid coastal water.
    C5,
    /// Jerlov type 7C: turbid water of a bay.
    C7,
    /// Jerlov type 9C: muddy water of an estuary.
    C9,
}

impl WaterType {
    /// All of Jerlov's water types, clearest first.
    pub const ALL: [Self; 10] =
        [Self::I, Self::Ia, Self::Ib, Self::Ii, Self::Iii, Self::C1, Self::C3, Self::C5, Self::C7, Self::C9];

    /// Jerlov's name of each water type in the order of `ALL`, in lower case, as in the query string (`water=1c`).
    pub const NAMES: &[&str] = &["i", "ia", "ib", "ii", "iii", "1c", "3c", "5c", "7c", "9c"];

    /// Diffuse attenuation coefficient Kd of downwelling light, 1/m, at the 13 wavelengths 400, 425 ... 700 nm (Jerlov
    /// 1976, tables XXVI and XXVII).
    #[rustfmt::skip]
    fn diffuse_attenuation_per_m(self) -> [f64; 13] {
        match self {
            Self::I => [0.028, 0.022, 0.019, 0.018, 0.027, 0.043, 0.063, 0.089, 0.235, 0.305, 0.36, 0.42, 0.56],
            Self::Ia => [0.038, 0.031, 0.026, 0.025, 0.032, 0.048, 0.067, 0.094, 0.24, 0.31, 0.37, 0.43, 0.57],
            Self::Ib => [0.051, 0.042, 0.036, 0.033, 0.042, 0.054, 0.072, 0.099, 0.245, 0.315, 0.375, 0.435, 0.58],
            Self::Ii => [0.096, 0.081, 0.068, 0.062, 0.070, 0.076, 0.089, 0.115, 0.26, 0.335, 0.40, 0.465, 0.61],
            Self::Iii => [0.185, 0.16, 0.135, 0.116, 0.115, 0.116, 0.12, 0.148, 0.295, 0.375, 0.445, 0.52, 0.66],
            Self::C1 => [0.51, 0.36, 0.25, 0.17, 0.14, 0.13, 0.12, 0.15, 0.30, 0.37, 0.45, 0.51, 0.65],
            Self::C3 => [0.78, 0.54, 0.39, 0.29, 0.22, 0.20, 0.19, 0.21, 0.33, 0.40, 0.46, 0.56, 0.71],
            Self::C5 => [1.10, 0.78, 0.56, 0.43, 0.36, 0.31, 0.30, 0.33, 0.40, 0.48, 0.54, 0.65, 0.80],
            Self::C7 => [1.60, 1.20, 0.89, 0.71, 0.58, 0.49, 0.46, 0.46, 0.48, 0.54, 0.63, 0.78, 0.92],
            Self::C9 => [2.40, 1.90, 1.60, 1.23, 0.99, 0.78, 0.63, 0.58, 0.60, 0.65, 0.76, 0.92, 1.10],
        }
    }

    fn is_coastal(self) -> bool {
        matches!(self, Self::C1 | Self::C3 | Self::C5 | Self::C7 | Self::C9)
    }

    /// The next muddier water type; for the muddiest type, 9C, the type itself.
    fn next(self) -> Self {
        Self::ALL[(self as usize + 1).min(Self::ALL.len() - 1)]
    }
}

/// Inherent optical properties of sea water: coefficients at the red, green and blue of the display, 1/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterOptics {
    /// Absorption coefficient a of red, green and blue light, 1/m.
    pub absorption: [f64; 3],
    /// Total scattering coefficient b of red, green and blue light, 1/m.
    pub scattering: [f64; 3],
    /// Backscattering coefficient bb of red, green and blue light, 1/m.
    pub backscatter: [f64; 3],
    /// Diffuse attenuation coefficient Kd of downwelling red, green and blue light, 1/m.
    pub diffuse_attenuation: [f64; 3],
}

impl WaterOptics {
    /// Optical properties of one of Jerlov's water types.
    pub fn of_type(water_type: WaterType) -> Self {
        let table = water_type.diffuse_attenuation_per_m();
        let kd = |nm: f64| {
            let x = (nm - FIRST_WAVELENGTH_NM) / WAVELENGTH_STEP_NM;
            let i = (x as usize).min(table.len() - 2);
            table[i] + (x - i as f64) * (table[i + 1] - table[i])
        };
        // Morel and Maritorena 2001, equations 5 and 13 to 15.
        let chlorophyll = ((kd(490.0) - 0.0166).max(1e-4) / 0.07242).powf(1.0 / 0.68955);
        let log = chlorophyll.log10();
        let particles_550 = 0.416 * chlorophyll.powf(0.766);
        let slope = if chlorophyll < 2.0 { 0.5 * (log - 0.3) } else { 0.0 };
        let sea_water = |nm: f64| 0.00288 * (nm / 500.0).powf(-4.32);
        let backscatter = |nm: f64| {
            let share = 0.002 + 0.01 * (0.5 - 0.25 * log) * (nm / 550.0).powf(slope);
            let share = if water_type.is_coastal() { COASTAL_BACKSCATTER_RATIO } else { share };
            0.5 * sea_water(nm) + share * particles_550
        };
        let absorption: [f64; 3] = std::array::from_fn(|i| {
            let nm = PRIMARY_WAVELENGTHS_NM[i];
            (DOWNWELLING_MEAN_COSINE * kd(nm) - backscatter(nm)).max(PURE_WATER_ABSORPTION_PER_M[i])
        });
        let colour = colour::linear_srgb_of_reflectance(|nm| {
            let bb = backscatter(nm);
            irradiance_reflectance(DOWNWELLING_MEAN_COSINE * kd(nm) - bb, bb)
        });
        Self {
            absorption,
            scattering: PRIMARY_WAVELENGTHS_NM.map(|nm| sea_water(nm) + particles_550),
            // The backscattering with which a shader's three channels show this colour. Blue water is outside of the
            // display's gamut: the negative red becomes almost black.
            backscatter: std::array::from_fn(|i| {
                let r = colour[i].max(MIN_REFLECTANCE);
                absorption[i] * r / (REFLECTANCE_PER_BACKSCATTER * (1.0 - r))
            }),
            diffuse_attenuation: PRIMARY_WAVELENGTHS_NM.map(kd),
        }
    }

    /// Optical properties of water between `water_type` (`share` 0) and the next muddier type (`share` 1), by geometric
    /// interpolation of each coefficient.
    pub fn blend_with_next_type(water_type: WaterType, share: f64) -> Self {
        let (a, b) = (Self::of_type(water_type), Self::of_type(water_type.next()));
        let mix = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| a[i].powf(1.0 - share) * b[i].powf(share));
        Self {
            absorption: mix(a.absorption, b.absorption),
            scattering: mix(a.scattering, b.scattering),
            backscatter: mix(a.backscatter, b.backscatter),
            diffuse_attenuation: mix(a.diffuse_attenuation, b.diffuse_attenuation),
        }
    }

    /// Returns the same water with its absorption changed so that deep water scatters back the linear RGB colour
    /// `colour`, each channel 0 to 1. The value 1 stands for a reflectance of 10 %.
    #[must_use]
    pub fn with_reflectance_colour(self, colour: [f64; 3]) -> Self {
        let absorption = std::array::from_fn(|i| {
            let r = (0.1 * colour[i]).max(MIN_REFLECTANCE);
            REFLECTANCE_PER_BACKSCATTER * self.backscatter[i] * (1.0 - r) / r
        });
        let diffuse_attenuation =
            std::array::from_fn(|i| (absorption[i] + self.backscatter[i]) / DOWNWELLING_MEAN_COSINE);
        Self { absorption, diffuse_attenuation, ..self }
    }

    /// Irradiance reflectance (upward over downward light, 0 to 1) of deep water just below its surface, in red, green
    /// and blue; shaders/water/body.wgsl uses the same formula.
    pub fn reflectance(&self) -> [f64; 3] {
        std::array::from_fn(|i| irradiance_reflectance(self.absorption[i], self.backscatter[i]))
    }

    /// Fraction of vertical light (red, green, blue) that the water lets through on the way down to a sea bed at the
    /// depth `depth_m` (m) and back up.
    pub fn two_way_transmittance(&self, depth_m: f64) -> [f64; 3] {
        std::array::from_fn(|i| (-2.0 * (self.absorption[i] + self.backscatter[i]) * depth_m).exp())
    }
}

/// Irradiance reflectance (upward over downward light, 0 to 1) of deep water with the absorption and backscattering
/// coefficients `absorption` and `backscatter` (1/m), after Morel and Prieur (1977).
fn irradiance_reflectance(absorption: f64, backscatter: f64) -> f64 {
    let up = REFLECTANCE_PER_BACKSCATTER * backscatter;
    up / (absorption + up)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clear_ocean_is_blue_and_the_coast_green() {
        // Morel and Prieur 1977: 4 to 6 % in the blue of the clearest ocean, almost none in the red.
        let [r, g, b] = WaterOptics::of_type(WaterType::I).reflectance();
        assert!((0.04..0.07).contains(&b) && g < 0.2 * b && r < 0.03 * b, "{r} {g} {b}");
        let [r, g, b] = WaterOptics::of_type(WaterType::C3).reflectance();
        assert!(g > b && g > r, "{r} {g} {b}");
        let [r, g, b] = WaterOptics::of_type(WaterType::C9).reflectance();
        assert!(r > b && g > b, "{r} {g} {b}");
    }

    #[test]
    fn every_step_is_muddier() {
        for pair in WaterType::ALL.windows(2) {
            let (a, b) = (WaterOptics::of_type(pair[0]), WaterOptics::of_type(pair[1]));
            assert!(a.absorption[2] < b.absorption[2] && a.scattering[1] < b.scattering[1], "{pair:?}");
            let half = WaterOptics::blend_with_next_type(pair[0], 0.5);
            assert!(a.absorption[2] < half.absorption[2] && half.absorption[2] < b.absorption[2], "{pair:?}");
            assert_eq!(pair[0].next(), pair[1]);
        }
        assert_eq!(WaterOptics::blend_with_next_type(WaterType::Ii, 0.0), WaterOptics::of_type(WaterType::Ii));
    }

    #[test]
    fn attenuation_comes_out_again() {
        // a + bb = 0.9 Kd unless pure water alone absorbs more. Backscattering carries the colour of the whole spectrum.
        for water_type in WaterType::ALL {
            let water = WaterOptics::of_type(water_type);
            let kd_550 = water_type.diffuse_attenuation_per_m()[6];
            let sum = water.absorption[1] + water.backscatter[1];
            assert!((sum / (0.9 * kd_550) - 1.0).abs() < 0.05, "{water_type:?}: {sum} for {kd_550}");
        }
    }

    #[test]
    fn a_colour_comes_back_as_asked() {
        let got = WaterOptics::of_type(WaterType::Ib).with_reflectance_colour([0.1, 0.5, 1.0]).reflectance();
        for (got, want) in got.into_iter().zip([0.01, 0.05, 0.1]) {
            assert!((got - want).abs() < 1e-9);
        }
    }
}
