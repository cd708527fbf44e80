//! Readers of bathymetry: files that say how high the land is and how deep the water, on a grid or at points.
//!
//! [`read`] recognises the format by the content: ESRI ASCII grid, text of x, y, z, and with the feature `files` NetCDF
//! (as GEBCO gives it) and GeoTIFF. Every format becomes an [`ElevationGrid`] in metres, with notices about everything
//! that the file does not say itself.
//!
//! - **Up or down**: the file's own words decide (names and attributes of the variable, the first line of a table, the
//!   file's name). Without words, values of which none is above zero or some are on each side are elevations (positive
//!   up), and values of which none is below zero are depths (positive down): a file without any water is no coast.
//! - **Latitude and longitude** become metres east and north of the middle of the grid, by the radii of curvature of the
//!   ellipsoid WGS 84 there.
//! - **Points without data** take the value of the nearest point with data. Where a file holds no land and that nearest
//!   point is shallower than 3 m, the gap is taken for the missing land and rises from the shore.

mod ascii;
mod fill;
mod grid;
#[cfg(feature = "files")]
mod netcdf;
#[cfg(feature = "files")]
mod scattered;
#[cfg(all(test, feature = "files"))]
mod tests;
#[cfg(feature = "files")]
mod tiff;
mod words;
mod xyz;

pub use grid::ElevationGrid;

use super::measured::text::{printable_prefix, short_name};
use grid::RawGrid;

/// Largest file of a bathymetry that is read, bytes.
pub const MAX_FILE_BYTES: usize = 64 << 20;
/// Largest number of points of a grid.
pub const MAX_POINTS: usize = 8 << 20;
/// Greatest height and depth, m, of a value: more than those of the Earth.
pub const MAX_ELEVATION_M: f64 = 12_000.0;

/// What the user says about a file that does not say it itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReadAs {
    /// Whether values are positive upwards (elevations) or downwards (depths); `None` lets the file and the rule decide.
    pub is_positive_up: Option<bool>,
    /// Whether coordinates are degrees of longitude and latitude, or metres; `None` lets the file and the rule decide.
    pub is_in_degrees: Option<bool>,
}

/// A bathymetry that was read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct BathymetryFile {
    /// Name of the file without folders, cut to 60 printable characters.
    pub name: String,
    /// Its elevations.
    pub grid: ElevationGrid,
    /// What was assumed and filled, one sentence each.
    pub notices: Vec<String>,
}

/// Reads a bathymetry from the content of a file.
///
/// # Errors
/// One sentence that names the file and says what is wrong and what to do.
pub fn read(name: &str, bytes: &[u8], read_as: ReadAs) -> Result<BathymetryFile, String> {
    let short = short_name(name);
    let fault = |what: String| format!("{short}: {}", printable_prefix(&what, 400));
    if bytes.len() > MAX_FILE_BYTES {
        let limit = MAX_FILE_BYTES >> 20;
        return Err(fault(format!(
            "the file is larger than {limit} MiB: cut out the coast, for example with gdal_translate -projwin"
        )));
    }
    let raw = read_raw(bytes, read_as).map_err(fault)?;
    let (grid, notices) = raw.finish(&short, read_as).map_err(fault)?;
    Ok(BathymetryFile { name: short, grid, notices })
}

/// Whether a file can be nothing but a bathymetry: by its content a TIFF or an ESRI ASCII grid, or by its name text of x,
/// y, z. NetCDF and text under other names may also hold a spectrum.
pub fn is_bathymetry_file(name: &str, bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(256)]);
    is_tiff(bytes) || ascii::is_ascii_grid(&head) || name.to_ascii_lowercase().ends_with(".xyz")
}

fn is_tiff(bytes: &[u8]) -> bool {
    bytes.starts_with(b"II") && bytes.get(3) == Some(&0) || bytes.starts_with(b"MM\0")
}

fn read_raw(bytes: &[u8], read_as: ReadAs) -> Result<RawGrid, String> {
    if bytes.starts_with(&[0x1f, 0x8b]) || bytes.starts_with(b"PK\x03\x04") {
        return Err("the file is compressed: unpack it first".into());
    }
    let is_tiff = is_tiff(bytes);
    let is_netcdf = bytes.starts_with(b"CDF") || bytes.starts_with(b"\x89HDF\r\n\x1a\n");
    #[cfg(feature = "files")]
    if is_tiff {
        return tiff::read(bytes);
    } else if is_netcdf {
        return netcdf::read(bytes);
    }
    #[cfg(not(feature = "files"))]
    if is_tiff || is_netcdf {
        return Err(
            "this program was built without readers of GeoTIFF and NetCDF: save it as an ESRI ASCII grid".into()
        );
    }
    let text = std::str::from_utf8(bytes).map_err(|_| {
        "it is no bathymetry that can be read: give an ESRI ASCII grid, text of x, y, z, NetCDF or GeoTIFF".to_owned()
    })?;
    if ascii::is_ascii_grid(text) { ascii::read(text) } else { xyz::read(text, read_as) }
}

/// Number of points of a grid; an error if it is too small to interpolate in or has more than [`MAX_POINTS`].
fn checked_count(columns: usize, rows: usize) -> Result<usize, String> {
    if columns < 2 || rows < 2 {
        return Err(format!("{columns} x {rows} points, but a bathymetry has at least two on each side"));
    }
    columns.checked_mul(rows).filter(|count| *count <= MAX_POINTS).ok_or_else(|| {
        format!("{columns} x {rows} points, but at most {MAX_POINTS} are read: cut out the coast or use larger cells")
    })
}
