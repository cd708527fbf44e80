//! Grids of elevations: as a file has them, and in metres.

use super::{MAX_ELEVATION_M, ReadAs, fill, words};

/// Semi-major axis of the ellipsoid WGS 84, m, and its squared eccentricity.
const WGS84_AXIS_M: f64 = 6_378_137.0;
const WGS84_ECCENTRICITY_SQUARED: f64 = 6.694_379_990_14e-3;
/// Largest cell, degrees, and longest side, degrees, of a grid whose file does not say that its coordinates are degrees.
const MAX_GUESSED_DEGREES: [f64; 2] = [0.1, 20.0];
/// Greatest latitude, degrees, of the middle of a grid.
const MAX_LATITUDE_DEG: f64 = 85.0;

/// Elevations on a regular grid in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct ElevationGrid {
    /// Number of points from west to east, at least 2.
    pub columns: usize,
    /// Number of points from south to north, at least 2.
    pub rows: usize,
    /// Distance between neighbouring points to the east and to the north, m.
    pub cell_m: [f64; 2],
    /// Height above the still water, m; negative in water. The point in column i (from the west) and row j (from the
    /// south) has the index j `columns` + i.
    pub elevation_m: Vec<f32>,
    /// Latitude and longitude of the middle, degrees; `None` for a file in metres.
    pub middle_deg: Option<[f64; 2]>,
}

impl ElevationGrid {
    /// Lengths of the grid to the east and to the north, between its outermost points, m.
    pub fn side_m(&self) -> [f64; 2] {
        [(self.columns - 1) as f64 * self.cell_m[0], (self.rows - 1) as f64 * self.cell_m[1]]
    }

    /// Elevation (m) at a point `east_m` and `north_m` (m) of the middle, bilinear between the points of the grid; beyond
    /// its edge that of the nearest point on the edge.
    pub fn at(&self, east_m: f64, north_m: f64) -> f64 {
        let [wide, high] = self.side_m();
        let place = |at_m: f64, side_m: f64, cell_m: f64, count: usize| {
            let at = ((at_m + 0.5 * side_m) / cell_m).clamp(0.0, (count - 1) as f64);
            let low = (at as usize).min(count - 2);
            (low, at - low as f64)
        };
        let (i, u) = place(east_m, wide, self.cell_m[0], self.columns);
        let (j, v) = place(north_m, high, self.cell_m[1], self.rows);
        let value = |i: usize, j: usize| f64::from(self.elevation_m[j * self.columns + i]);
        let south = value(i, j) * (1.0 - u) + value(i + 1, j) * u;
        let north = value(i, j + 1) * (1.0 - u) + value(i + 1, j + 1) * u;
        south * (1.0 - v) + north * v
    }
}

/// Positions of the columns or the rows of a grid, in the unit of the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    /// Coordinate of the first column or row.
    pub first: f64,
    /// Distance between two of them, positive.
    pub step: f64,
    /// Number of them.
    pub count: usize,
}

impl Axis {
    /// The axis of evenly spaced coordinates, and whether they descend. Coordinates that were rounded by up to a fifth of
    /// a step count as even. Longitudes may pass from 180 to -180 degrees or from 360 to 0.
    #[cfg(feature = "files")]
    pub(super) fn of_coordinates(values: &[f64], name: &str) -> Result<(Self, bool), String> {
        let [first, second, ..] = *values else { return Err(format!("{name} has fewer than two values")) };
        // Coordinates that rise or fall throughout need no unwrapping: metres may pass 180, too.
        let is_monotone = values.is_sorted() || values.iter().rev().is_sorted();
        let unwrapped = |v: f64| {
            let wraps = !is_monotone && (v - first).abs() > 180.0 && v.abs() <= 360.0 && first.abs() <= 360.0;
            if wraps { v + 360.0 * (first - v).signum() } else { v }
        };
        let step = (unwrapped(values[values.len() - 1]) - first) / (values.len() - 1) as f64;
        let step = if step == 0.0 { second - first } else { step };
        let is_even =
            values.iter().enumerate().all(|(i, v)| (unwrapped(*v) - first - i as f64 * step).abs() < 0.2 * step.abs());
        if !is_even {
            return Err(format!("the values of {name} are not evenly spaced: put the file onto a regular grid"));
        }
        let count = values.len();
        let lowest = if step < 0.0 { first + step * (count - 1) as f64 } else { first };
        Ok((Self { first: lowest, step: step.abs(), count }, step < 0.0))
    }

    fn middle(&self) -> f64 {
        self.first + 0.5 * self.length()
    }

    fn length(&self) -> f64 {
        self.step * (self.count - 1) as f64
    }
}

/// A grid as a file has it: values in the file's own sign, coordinates in its own unit, points without data as NaN.
#[derive(Clone, Debug)]
pub(super) struct RawGrid {
    /// Columns, from west to east.
    pub x: Axis,
    /// Rows, from south to north.
    pub y: Axis,
    /// Values: row by row from the south, each from west to east.
    pub values: Vec<f32>,
    /// What the file says about the values and the coordinates: names, titles, first lines.
    pub words: String,
    /// Whether the file says by itself that values are positive up.
    pub is_positive_up: Option<bool>,
    /// Whether the file says by itself that coordinates are degrees.
    pub is_in_degrees: Option<bool>,
    /// Metres of a unit of the values, and of a unit of the coordinates if they are no degrees.
    pub unit_m: [f64; 2],
    /// What the reader has to say, one sentence each.
    pub notices: Vec<String>,
}

impl RawGrid {
    pub(super) fn new(x: Axis, y: Axis, values: Vec<f32>) -> Self {
        let unit_m = [1.0; 2];
        let (words, notices) = (String::new(), Vec::new());
        Self { x, y, values, words, is_positive_up: None, is_in_degrees: None, unit_m, notices }
    }

    /// Turns the order of the rows, for files that begin in the north.
    pub(super) fn turn_upside_down(&mut self) {
        let (columns, rows) = (self.x.count, self.y.count);
        for j in 0..rows / 2 {
            let (south, north) = self.values.split_at_mut((rows - 1 - j) * columns);
            south[j * columns..(j + 1) * columns].swap_with_slice(&mut north[..columns]);
        }
    }

    /// Turns the order of the columns, for files that begin in the east.
    #[cfg(feature = "files")]
    pub(super) fn turn_left_to_right(&mut self) {
        self.values.chunks_mut(self.x.count).for_each(<[f32]>::reverse);
    }

    /// Makes elevations in metres, and the notices about what was assumed and filled.
    pub(super) fn finish(mut self, name: &str, read_as: ReadAs) -> Result<(ElevationGrid, Vec<String>), String> {
        let mut notices = std::mem::take(&mut self.notices);
        let known = self.values.iter().copied().filter(|v| !v.is_nan());
        let (low, high) = known.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if low > high {
            return Err("no point has data: choose another file".into());
        }
        let limit = MAX_ELEVATION_M / self.unit_m[0];
        if f64::from(low) < -limit || f64::from(high) > limit {
            return Err(format!(
                "the values reach from {low} to {high}, but no place on Earth is more than {MAX_ELEVATION_M} m high or \
                 deep: name the value of points without data in the file"
            ));
        }
        let said = self.is_positive_up.or_else(|| words::says_positive_up(&self.words));
        let is_positive_up = read_as.is_positive_up.or(said).or_else(|| words::says_positive_up(name)).unwrap_or_else(|| {
            let is_up = low < 0.0;
            notices.push(if is_up {
                "the file does not say whether its values are heights or depths: some are negative, so they are read as \
                 elevations, positive up"
            } else {
                "the file does not say whether its values are heights or depths: none is negative, so they are read as \
                 depths, positive down"
            }.into());
            is_up
        });
        let factor = self.unit_m[0] as f32 * if is_positive_up { 1.0 } else { -1.0 };
        self.values.iter_mut().for_each(|v| *v *= factor);
        let (cell_m, middle_deg) = self.metres(read_as)?;
        notices.extend(fill::fill(&mut self.values, self.x.count, cell_m));
        if !self.values.iter().any(|v| *v < 0.0) {
            return Err("all of it is land: if its values are depths, say so with --read-as down".into());
        }
        let (columns, rows) = (self.x.count, self.y.count);
        Ok((ElevationGrid { columns, rows, cell_m, elevation_m: self.values, middle_deg }, notices))
    }

    /// Size of a cell to the east and to the north, m; and the latitude and longitude of the middle, if the file has them.
    fn metres(&self, read_as: ReadAs) -> Result<([f64; 2], Option<[f64; 2]>), String> {
        let said = self.is_in_degrees.or_else(|| words::says_degrees(&self.words));
        let [most_step, most_side] = MAX_GUESSED_DEGREES;
        let looks_like = || {
            let is_small = |axis: &Axis| axis.step < most_step && axis.length() < most_side;
            let is_within = |axis: &Axis, most: f64| axis.first >= -most && axis.first + axis.length() <= most;
            is_small(&self.x) && is_small(&self.y) && is_within(&self.x, 360.0) && is_within(&self.y, 90.0)
        };
        let in_degrees = read_as.is_in_degrees.or(said).unwrap_or_else(looks_like);
        if !in_degrees {
            let cell_m = [self.x.step * self.unit_m[1], self.y.step * self.unit_m[1]];
            let is_usable = |c: f64| (1e-3..1e6).contains(&c);
            return match cell_m.iter().all(|c| is_usable(*c)) {
                true => Ok((cell_m, None)),
                false => Err("the distance of two points is not between a millimetre and 1000 km".into()),
            };
        }
        let (latitude, longitude) = (self.y.middle(), self.x.middle());
        if latitude.abs() > MAX_LATITUDE_DEG || longitude.abs() > 720.0 {
            return Err(format!("its middle is at latitude {latitude}: latitudes up to {MAX_LATITUDE_DEG} are read"));
        }
        let (sin, cos) = latitude.to_radians().sin_cos();
        let root = 1.0 - WGS84_ECCENTRICITY_SQUARED * sin * sin;
        let radius_east_m = WGS84_AXIS_M / root.sqrt() * cos;
        let radius_north_m = WGS84_AXIS_M * (1.0 - WGS84_ECCENTRICITY_SQUARED) / root.powf(1.5);
        let cell_m = [self.x.step.to_radians() * radius_east_m, self.y.step.to_radians() * radius_north_m];
        if cell_m.iter().any(|c| !(1e-3..1e6).contains(c)) {
            return Err("the distance of two points is not between a millimetre and 1000 km".into());
        }
        let longitude = (longitude + 180.0).rem_euclid(360.0) - 180.0;
        Ok((cell_m, Some([latitude, longitude])))
    }
}
