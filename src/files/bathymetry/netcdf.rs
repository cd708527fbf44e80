//! Bathymetry in NetCDF files: GEBCO, ETOPO, EMODnet, and grids of GMT and other programs that follow the CF conventions.
//!
//! The values are a variable over two dimensions, or over more of which the others have one entry. It is chosen by its name
//! or its CF standard name; else the file has only one. The positions along a dimension are the variable of its name.

use super::checked_count;
use super::grid::{Axis, RawGrid};
use crate::files::netcdf::{Dataset, Variable};

/// Names of variables of elevations and depths, the most likely first.
const NAMES: [&str; 12] = [
    "elevation",
    "z",
    "topo",
    "altitude",
    "bathymetry",
    "depth",
    "deptho",
    "band1",
    "bathy",
    "bottom_topography",
    "h",
    "height",
];
/// CF standard names of elevations and depths, or the beginning of them.
const STANDARD_NAMES: [&str; 5] =
    ["height_above", "surface_altitude", "sea_floor_depth", "bedrock_altitude", "altitude"];

/// Reads a grid.
///
/// # Errors
/// One sentence, without the file's name.
pub(super) fn read(bytes: &[u8]) -> Result<RawGrid, String> {
    let file = Dataset::open(bytes)?;
    let index = find_values(&file)?;
    let variable = &file.variables[index];
    let axes: Vec<usize> = (0..variable.shape.len()).filter(|a| variable.shape[*a] != 1).collect();
    let [first, second] = axes[..] else {
        return Err(format!("the variable {} is no grid of two dimensions", variable.name));
    };
    checked_count(variable.shape[second], variable.shape[first])?;
    let (first, second) = (Coordinates::read(&file, variable, first)?, Coordinates::read(&file, variable, second)?);
    let is_transposed = first.is_along_x() && !second.is_along_x();
    let stored = file.numbers(index)?;
    let missing: Vec<f64> = ["_FillValue", "missing_value"].iter().filter_map(|name| variable.number(name)).collect();
    let [scale, offset] =
        [("scale_factor", 1.0), ("add_offset", 0.0)].map(|(name, v)| variable.number(name).unwrap_or(v));
    let value = |v: f64| if missing.contains(&v) { f32::NAN } else { (v * scale + offset) as f32 };
    let (rows, columns) = (first.axis.count, second.axis.count);
    let mut grid = if is_transposed {
        let turned = (0..rows * columns).map(|i| value(stored[(i % rows) * columns + i / rows])).collect();
        RawGrid::new(first.axis, second.axis, turned)
    } else {
        RawGrid::new(second.axis, first.axis, stored.into_iter().map(value).collect())
    };
    let (x, y) = if is_transposed { (&first, &second) } else { (&second, &first) };
    if x.descends {
        grid.turn_left_to_right();
    }
    if y.descends {
        grid.turn_upside_down();
    }
    grid.words = ["standard_name", "long_name"].map(|name| variable.text(name)).join(" ") + " " + &variable.name;
    grid.is_positive_up = match variable.text("positive") {
        "up" => Some(true),
        "down" => Some(false),
        _ => None,
    };
    grid.is_in_degrees = Some(x.is_in_degrees);
    grid.unit_m = [unit_m(variable.text("units"), &mut grid.notices), x.unit_m];
    Ok(grid)
}

/// Index of the variable of elevations or depths.
fn find_values(file: &Dataset<'_>) -> Result<usize, String> {
    let is_grid = |v: &Variable| v.shape.iter().filter(|n| **n != 1).count() == 2;
    let grids: Vec<usize> = (0..file.variables.len()).filter(|i| is_grid(&file.variables[*i])).collect();
    let standard = |i: &&usize| {
        let name = file.variables[**i].text("standard_name");
        STANDARD_NAMES.iter().any(|known| name.starts_with(known))
    };
    let by_name = || {
        let rank = |i: &usize| NAMES.iter().position(|n| file.variables[*i].name.eq_ignore_ascii_case(n));
        grids.iter().filter_map(|i| Some((rank(i)?, *i))).min().map(|found| found.1)
    };
    let only = || if let [only] = grids[..] { Some(only) } else { None };
    grids.iter().find(standard).copied().or_else(by_name).or_else(only).ok_or_else(|| {
        let names: Vec<&str> = file.variables.iter().map(|v| v.name.as_str()).take(8).collect();
        format!("there is no grid called elevation, z or depth among {}", names.join(", "))
    })
}

/// Positions along a dimension of the grid.
struct Coordinates {
    axis: Axis,
    descends: bool,
    is_in_degrees: bool,
    /// Name, standard name and unit, in lower case.
    words: String,
    /// Metres of a unit, if it is no degree.
    unit_m: f64,
}

impl Coordinates {
    fn read(file: &Dataset<'_>, grid: &Variable, dimension: usize) -> Result<Self, String> {
        let (name, count) = (&grid.dimensions[dimension], grid.shape[dimension]);
        let along = |v: &&Variable| v.shape == [count];
        let variable = file.variables.iter().filter(along).find(|v| v.name == *name).or_else(|| {
            // A variable with another name than its dimension.
            file.variables.iter().filter(along).find(|v| v.dimensions == [name.clone()] && !name.is_empty())
        });
        let variable = variable.ok_or_else(|| format!("there are no coordinates along the dimension {name}"))?;
        let index = file.find(&variable.name).unwrap_or_default();
        let [scale, offset] =
            [("scale_factor", 1.0), ("add_offset", 0.0)].map(|(name, v)| variable.number(name).unwrap_or(v));
        let values: Vec<f64> = file.numbers(index)?.into_iter().map(|v| v * scale + offset).collect();
        let (axis, descends) = Axis::of_coordinates(&values, &variable.name)?;
        let units = variable.text("units").to_ascii_lowercase();
        let words = format!("{} {} {units}", variable.name, variable.text("standard_name")).to_ascii_lowercase();
        let is_in_degrees = units.starts_with("degree") || words.starts_with("lat") || words.starts_with("lon");
        let unit_m = if units == "km" || units.starts_with("kilomet") { 1000.0 } else { 1.0 };
        Ok(Self { axis, descends, is_in_degrees, words, unit_m })
    }

    /// Whether the positions run from west to east.
    fn is_along_x(&self) -> bool {
        ["lon", "x", "east"].iter().any(|start| self.words.starts_with(start))
            || ["degrees_east", "projection_x"].iter().any(|word| self.words.contains(word))
    }
}

/// Metres of the unit of the values; an unknown one counts as metres, which is said.
fn unit_m(units: &str, notices: &mut Vec<String>) -> f64 {
    match units.trim().to_ascii_lowercase().as_str() {
        "" | "m" | "meter" | "meters" | "metre" | "metres" => 1.0,
        "km" => 1000.0,
        "cm" => 0.01,
        "feet" | "foot" | "ft" => 0.3048,
        "fathom" | "fathoms" => 1.8288,
        other => {
            notices.push(format!("the unit {other:?} of the values is unknown: they are read as metres"));
            1.0
        }
    }
}
