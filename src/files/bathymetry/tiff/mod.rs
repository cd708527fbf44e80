//! GeoTIFF: the first image of a TIFF file (TIFF 6.0, Adobe 1992) of one band of whole or floating-point numbers, with the
//! tags that say where it lies (OGC GeoTIFF 1.1).
//!
//! Read are strips and tiles, uncompressed or packed by Deflate, LZW or PackBits, with both predictors: what GDAL and
//! QGIS write for elevations. JPEG, LERC and the like, BigTIFF, and turned images are refused with the way out.

mod pieces;
mod tags;
mod unpack;

use super::checked_count;
use super::grid::{Axis, RawGrid};
use pieces::Layout;
use tags::Directory;

const GEO_KEYS: u16 = 34_735;
const PIXEL_SCALE: u16 = 33_550;
const TIE_POINT: u16 = 33_922;
const TRANSFORMATION: u16 = 34_264;
const DESCRIPTION: u16 = 270;
const GDAL_METADATA: u16 = 42_112;
const GDAL_NO_DATA: u16 = 42_113;

/// Reads a grid.
///
/// # Errors
/// One sentence, without the file's name.
pub(super) fn read(bytes: &[u8]) -> Result<RawGrid, String> {
    let directory = Directory::read(bytes)?;
    let layout = Layout::read(&directory)?;
    checked_count(layout.columns, layout.rows)?;
    let place = Place::read(&directory)?;
    let no_data: Option<f32> = directory.text(GDAL_NO_DATA).trim_matches([' ', '\0']).parse().ok();
    let mut values = layout.values(bytes)?;
    if let Some(no_data) = no_data {
        values.iter_mut().filter(|v| **v == no_data).for_each(|v| *v = f32::NAN);
    }
    let axis = |first: f64, step: f64, count: usize| {
        let lowest = if step < 0.0 { first + step * (count - 1) as f64 } else { first };
        Axis { first: lowest, step: step.abs(), count }
    };
    let (x, y) =
        (axis(place.first[0], place.step[0], layout.columns), axis(place.first[1], place.step[1], layout.rows));
    let mut grid = RawGrid::new(x, y, values);
    if place.step[0] < 0.0 {
        grid.turn_left_to_right();
    }
    if place.step[1] < 0.0 {
        grid.turn_upside_down();
    }
    grid.words = format!("{} {}", directory.text(DESCRIPTION), directory.text(GDAL_METADATA));
    grid.is_in_degrees = place.is_in_degrees;
    grid.unit_m[1] = place.unit_m;
    Ok(grid)
}

/// Where the points of an image lie.
struct Place {
    /// Coordinates x, y of the middle of the first pixel.
    first: [f64; 2],
    /// Steps along x from column to column, and along y from row to row; in most files the latter is negative.
    step: [f64; 2],
    is_in_degrees: Option<bool>,
    /// Metres of a unit, if it is no degree.
    unit_m: f64,
}

impl Place {
    fn read(directory: &Directory<'_>) -> Result<Self, String> {
        let keys = directory.numbers(GEO_KEYS)?;
        // Entries of four numbers: key, where its value stands (0: here), count, value.
        let key = |number: f64| keys.chunks_exact(4).skip(1).find(|k| k[0] == number && k[1] == 0.0).map(|k| k[3]);
        let (scale, tie, matrix) =
            (directory.numbers(PIXEL_SCALE)?, directory.numbers(TIE_POINT)?, directory.numbers(TRANSFORMATION)?);
        let (mut first, step) = match (&scale[..], &tie[..], &matrix[..]) {
            ([sx, sy, ..], [i, j, _, x, y, _, ..], _) => ([x - i * sx, y + j * sy], [*sx, -*sy]),
            (_, _, [a, b, _, x, c, d, _, y, ..]) => {
                if *b != 0.0 || *c != 0.0 {
                    return Err("the image is turned against its coordinates: straighten it with gdalwarp".into());
                }
                ([*x, *y], [*a, *d])
            }
            _ => {
                return Err("it does not say where its pixels lie (ModelPixelScale and ModelTiepoint): save it as \
                            GeoTIFF"
                    .into());
            }
        };
        if !first.iter().chain(&step).all(|v| v.abs() < 1e12) || step.contains(&0.0) {
            return Err("the place or the size of its pixels is no usable number: save it again".into());
        }
        // Unless a pixel stands for a point, the first coordinates are those of its corner.
        if key(1025.0) != Some(2.0) {
            first = [first[0] + 0.5 * step[0], first[1] + 0.5 * step[1]];
        }
        let is_in_degrees = match key(1024.0) {
            Some(1.0) => Some(false),
            Some(2.0) => Some(true),
            _ => None,
        };
        let unit_m = match key(3076.0) {
            Some(9002.0) => 0.3048,
            Some(9003.0) => 1200.0 / 3937.0,
            _ => 1.0,
        };
        Ok(Self { first, step, is_in_degrees, unit_m })
    }
}
