//! Colours of maps: bands of equal width in values, and land by height.

/// A colour: red, green, blue.
pub type Colour = [u8; 3];

/// A row of colours for the values of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    /// Light to dark blue, for depths.
    Water,
    /// Dark violet over green to yellow, for heights of waves.
    Heights,
    /// Dark blue to white, for the elevation of the surface.
    Surface,
    /// White to dark red, for breaking waves.
    Breaking,
}

/// Colours of the land at heights, m: wet sand, sand, dune grass, heath, rock.
const LAND: [(f64, Colour); 6] = [
    (0.0, [222, 205, 164]),
    (2.0, [240, 226, 188]),
    (5.0, [205, 209, 158]),
    (9.0, [170, 186, 128]),
    (18.0, [160, 160, 124]),
    (28.0, [176, 168, 152]),
];
/// Steps of height, m, and of shading in which the land is coloured.
const LAND_STEPS: usize = 8;
const SHADES: usize = 3;

impl Palette {
    /// Colour at a fraction, 0 to 1.
    fn at(self, fraction: f64) -> Colour {
        let stops: &[Colour] = match self {
            Self::Water => &[[226, 244, 246], [164, 214, 228], [96, 172, 208], [48, 122, 176], [24, 74, 128]],
            Self::Heights => &[[68, 20, 92], [60, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 60]],
            Self::Surface => &[[22, 62, 98], [66, 124, 164], [150, 192, 214], [236, 244, 248]],
            Self::Breaking => &[[236, 244, 248], [254, 221, 170], [244, 165, 82], [214, 96, 40], [140, 30, 24]],
        };
        let at = fraction.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
        let low = (at as usize).min(stops.len() - 2);
        mixed(stops[low], stops[low + 1], at - low as f64)
    }
}

fn mixed(a: Colour, b: Colour, t: f64) -> Colour {
    [0, 1, 2].map(|c| (f64::from(a[c]) + t * (f64::from(b[c]) - f64::from(a[c]))).round() as u8)
}

/// Bands of values with their colours.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourScale {
    /// Lower end of the first band.
    pub low: f64,
    /// Width of a band.
    pub step: f64,
    /// Number of bands.
    pub bands: usize,
    /// Their colours.
    pub palette: Palette,
    /// Whether a colour bar says the values.
    pub has_bar: bool,
}

impl ColourScale {
    /// A scale from `low` to at least `high` with bands of a round width, about `bands` of them.
    pub fn nice(low: f64, high: f64, bands: usize, palette: Palette) -> Self {
        let rough = ((high - low) / bands as f64).max(1e-6);
        let unit = 10_f64.powf(rough.log10().floor());
        let step =
            [1.0, 2.0, 2.5, 5.0, 10.0].map(|m| m * unit).into_iter().find(|s| *s >= rough - 1e-9).unwrap_or(rough);
        let low = (low / step + 1e-9).floor() * step;
        let bands = (((high - low) / step - 1e-6).ceil() as usize).max(1);
        Self { low, step, bands, palette, has_bar: true }
    }

    /// Upper end of the last band.
    pub fn high(&self) -> f64 {
        self.low + self.step * self.bands as f64
    }

    /// Index of the band of a value; values beyond the ends belong to the last and the first band.
    pub(super) fn band(&self, value: f64) -> usize {
        (((value - self.low) / self.step + 1e-9).max(0.0) as usize).min(self.bands - 1)
    }

    /// Colour of a band.
    pub(super) fn colour(&self, band: usize) -> Colour {
        self.palette.at(if self.bands > 1 { band as f64 / (self.bands - 1) as f64 } else { 0.5 })
    }

    /// Colours of all bands, and after them those of the land: see [`land_index`].
    pub(super) fn colours(&self) -> Vec<Colour> {
        let water = (0..self.bands).map(|band| self.colour(band));
        let land = (0..LAND_STEPS * SHADES).map(|index| {
            let height_m = LAND[LAND.len() - 1].0 * ((index / SHADES) as f64 / (LAND_STEPS - 1) as f64).powi(2);
            let above = LAND.iter().position(|stop| stop.0 > height_m).unwrap_or(LAND.len() - 1).max(1);
            let (low, high) = (LAND[above - 1], LAND[above]);
            let colour = mixed(low.1, high.1, ((height_m - low.0) / (high.0 - low.0)).clamp(0.0, 1.0));
            let light = 0.9 + 0.1 * (index % SHADES) as f64;
            colour.map(|c| (f64::from(c) * light).min(255.0) as u8)
        });
        water.chain(land).collect()
    }

    /// Index among [`Self::colours`] of land of a height (m) whose slope towards the light, height over length, is `lit`.
    pub(super) fn land_index(&self, height_m: f64, lit: f64) -> usize {
        let fraction = (height_m.max(0.0) / LAND[LAND.len() - 1].0).sqrt();
        let step = ((fraction * (LAND_STEPS - 1) as f64).round() as usize).min(LAND_STEPS - 1);
        let shade = if lit > 0.04 { 2 } else { usize::from(lit > -0.04) };
        self.bands + step * SHADES + shade
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_round() {
        for (low, high, bands, step) in
            [(0.0, 13.2, 14, 1.0), (0.0, 2.3, 12, 0.2), (0.0, 1.0, 10, 0.1), (-3.1, 3.1, 12, 1.0)]
        {
            let scale = ColourScale::nice(low, high, bands, Palette::Heights);
            assert!((scale.step - step).abs() < 1e-9, "{scale:?}");
            assert!(scale.low <= low && scale.high() >= high - 1e-9 && scale.high() < high + scale.step, "{scale:?}");
            assert_eq!((scale.band(f64::MIN), scale.band(f64::MAX)), (0, scale.bands - 1));
            assert_eq!(scale.colours().len(), scale.bands + LAND_STEPS * SHADES);
            assert!(scale.land_index(1e3, 9.0) < scale.colours().len());
        }
    }
}
