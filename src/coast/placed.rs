//! A coast at its place: depths on a square grid in the frame of the coast, turned as the user asks, from a built-in coast
//! or from a file.

use super::bathymetry::Bathymetry;
use super::built_in::BuiltInCoast;
use super::incident::Placement;
use super::seamark::Seamark;
use super::structure::Structure;
use crate::files::bathymetry::{BathymetryFile, ElevationGrid};
use crate::state::coast::{Coast, CoastName, MISSING_FILE_NOTICE};

/// Cells along the longer side, unless the user asks for another size of the cells.
const DEFAULT_CELLS: f64 = 200.0;
/// Largest number of cells along a side.
const MAX_CELLS: f64 = 600.0;
/// Longest side, m, that is cut out of a file unless the user asks for another.
const DEFAULT_SIDE_M: f64 = 4000.0;
/// Points along a side at which the slope of the sea floor is looked at.
const SLOPE_POINTS: usize = 96;
/// Distance of a view of the shore from the first land, m: seaward of the breakers of usual seas.
pub const SHORE_VIEW_BEFORE_M: f64 = 220.0;
/// Depths, m, between which the slope tells where the shore lies.
const SLOPE_DEPTHS_M: [f64; 2] = [0.5, 40.0];

/// How a coast is cut out, turned and divided into cells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlacingOptions {
    /// Bearing of the direction from the sea to the land, degrees clockwise from north; `None` lets the coast decide.
    pub toward_deg: Option<f64>,
    /// Side of the square that is cut out of a file, m.
    pub size_m: Option<f64>,
    /// Middle of that square, metres east and north of the middle of the file.
    pub centre_m: [f64; 2],
    /// Distance of two points of the grid, m.
    pub cell_m: Option<f64>,
}

/// Depths of a coast on a grid in its frame (see [`crate::coast`]), with its structures and its direction.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedCoast {
    /// Title of a built-in coast, or name of a file.
    pub title: String,
    /// Name of a built-in coast, whose depths are known between the points of the grid, too; None for a file.
    pub built_in: Option<&'static str>,
    /// What a built-in coast shows, or where a file lies.
    pub about: String,
    /// The depths.
    pub bathymetry: Bathymetry,
    /// Breakwaters and walls, which are built into the depths, too.
    pub structures: Vec<Structure>,
    /// Bearing of the x axis, which points from the sea to the land, degrees clockwise from north.
    pub toward_deg: f64,
    /// World position (x, z) of its middle, m.
    pub middle_m: [f64; 2],
    /// What was assumed, one sentence each.
    pub notices: Vec<String>,
}

impl PlacedCoast {
    /// Places a built-in coast.
    ///
    /// # Errors
    /// One sentence, if the options do not fit it.
    pub fn built_in(coast: &BuiltInCoast, options: &PlacingOptions) -> Result<Self, String> {
        if options.size_m.is_some() || options.centre_m != [0.0; 2] {
            return Err("a built-in coast has its own size: a size and a centre are for files".into());
        }
        let [wide, long] = coast.side_m;
        let cell_m = checked_cell_m(options.cell_m, wide.max(long))?;
        Ok(Self {
            title: coast.title.into(),
            built_in: Some(coast.name),
            about: coast.about.into(),
            bathymetry: coast.bathymetry(cell_m),
            structures: (coast.structures)(),
            toward_deg: options.toward_deg.unwrap_or(coast.toward_deg).rem_euclid(360.0),
            middle_m: [0.0; 2],
            notices: Vec::new(),
        })
    }

    /// The coast of a state; `None` for the open sea. `file` is the bathymetry that the user has opened, if the state does
    /// not hold it itself.
    ///
    /// # Errors
    /// One sentence, if the state asks for a file that is not open, or the file does not fit.
    pub fn of_state(coast: &Coast, file: Option<&BathymetryFile>) -> Result<Option<Self>, String> {
        let placed = match (coast.name, coast.file.as_ref().map(|file| &*file.0).or(file)) {
            (CoastName::None, _) => return Ok(None),
            (CoastName::File, None) => return Err(MISSING_FILE_NOTICE.into()),
            (CoastName::File, Some(file)) => Self::from_file(file, &PlacingOptions::default())?,
            (name, _) => {
                let built_in = BuiltInCoast::find(name.word()).ok_or_else(|| format!("no coast {}", name.word()))?;
                Self::built_in(built_in, &PlacingOptions::default())?
            }
        };
        let toward_deg = (placed.toward_deg + coast.turn_deg).rem_euclid(360.0);
        Ok(Some(Self { toward_deg, middle_m: [coast.x_m, coast.z_m], ..placed }))
    }

    /// Cuts a coast out of a file.
    ///
    /// # Errors
    /// One sentence, if the options do not fit the file, or there is no sea at the side that faces it.
    pub fn from_file(file: &BathymetryFile, options: &PlacingOptions) -> Result<Self, String> {
        let mut notices = file.notices.clone();
        let [file_wide, file_high] = file.grid.side_m();
        let fault = |what: String| format!("{}: {what}", file.name);
        let shorter_m = file_wide.min(file_high);
        if options.size_m.is_some_and(|size_m| !(10.0..=100_000.0).contains(&size_m)) {
            return Err(fault("the side of a coast is 10 m to 100 km".into()));
        }
        let square_m = options.size_m.unwrap_or(shorter_m.min(DEFAULT_SIDE_M));
        let toward_deg = match options.toward_deg {
            Some(toward_deg) => toward_deg,
            None => {
                let found = shoreward_deg(&file.grid, options.centre_m, square_m);
                let toward_deg = found.unwrap_or(90.0).round();
                notices.push(match found {
                    Some(_) => format!("the sea floor rises towards {toward_deg}°, so the shore is taken to lie there"),
                    None => {
                        "the sea floor rises in no clear direction: the land is taken to lie in the east; --toward \
                             turns the coast"
                            .into()
                    }
                });
                toward_deg
            }
        };
        // A turned square inside the file is smaller.
        let (sin, cos) = toward_deg.to_radians().sin_cos();
        let inside_m = shorter_m / (sin.abs() + cos.abs());
        let side_m = options.size_m.unwrap_or(inside_m.min(DEFAULT_SIDE_M));
        if options.size_m.is_none() && side_m < 0.9 * inside_m {
            notices.push(format!(
                "{side_m:.0} m of the {file_wide:.0} m x {file_high:.0} m of the file are used: --size and --centre choose"
            ));
        }
        let reach_m =
            [options.centre_m[0].abs(), options.centre_m[1].abs()].map(|c| c + 0.5 * side_m * (sin.abs() + cos.abs()));
        if reach_m[0] > 0.5 * file_wide + 1.0 || reach_m[1] > 0.5 * file_high + 1.0 {
            notices.push("the coast reaches beyond the file: there the depth of its nearest edge is taken".into());
        }
        let cell_m = checked_cell_m(options.cell_m, side_m).map_err(fault)?;
        let bathymetry = cut_out(&file.grid, options.centre_m, side_m, cell_m, toward_deg);
        let dry = (0..bathymetry.rows).filter(|j| bathymetry.at(0, *j) <= 0.5).count();
        if 2 * dry > bathymetry.rows {
            return Err(fault(format!(
                "the side that should face the open sea is land or less than half a metre deep: the land is taken to lie \
                 towards {toward_deg}°; --toward turns the coast, --centre moves it"
            )));
        }
        if dry > 0 {
            notices.push("a part of the side that faces the open sea is land: no waves come from there".into());
        }
        let place = file.grid.middle_deg.map_or_else(String::new, |[latitude, longitude]| {
            format!(" around {latitude:.4}° north, {longitude:.4}° east")
        });
        Ok(Self {
            title: file.name.clone(),
            built_in: None,
            about: format!("{side_m:.0} m of the file{place}."),
            bathymetry,
            structures: Vec::new(),
            toward_deg: toward_deg.rem_euclid(360.0),
            middle_m: [0.0; 2],
            notices,
        })
    }

    /// Seamarks of a built-in coast: lighthouses, harbour lights and beacons. A coast from a file has none.
    pub fn seamarks(&self) -> &'static [Seamark] {
        self.built_in.and_then(BuiltInCoast::find).map_or(&[], |coast| coast.seamarks)
    }

    /// Angle (rad) by which the coast's x axis is turned from the world's +x (east) towards +z (south).
    pub fn turn_rad(&self) -> f64 {
        (self.toward_deg - 90.0).to_radians()
    }

    /// Place of its frame in the world.
    pub fn placement(&self) -> Placement {
        let turn_rad = self.turn_rad();
        let (sin, cos) = turn_rad.sin_cos();
        let [x, y] = self.side_m().map(|side_m| 0.5 * side_m);
        let [east, south] = self.middle_m;
        Placement { origin_m: [east - (x * cos - y * sin), south - (x * sin + y * cos)], turn_rad }
    }

    /// Depth (m, negative on land) at a world position (x, z), m, between the points of the grid. Beyond the grid that of
    /// its nearest point holds.
    pub fn depth_at_m(&self, world_m: [f64; 2]) -> f64 {
        let [x, y] = self.placement().in_frame_m(world_m);
        let grid = &self.bathymetry;
        let place = |at_m: f64, count: usize| {
            let at = (at_m / grid.cell_m).clamp(0.0, (count - 1) as f64);
            let whole = at.floor().min((count - 2) as f64);
            (whole as usize, at - whole)
        };
        let ((i, u), (j, v)) = (place(x, grid.columns), place(y, grid.rows));
        let row = |j: usize| (1.0 - u) * grid.at(i, j) + u * grid.at(i + 1, j);
        (1.0 - v) * row(j) + v * row(j + 1)
    }

    /// Mean depth of the water at the edge that faces the open sea, m: the waves there are those of a sea of this depth.
    pub fn seaward_depth_m(&self) -> f64 {
        let rows = self.bathymetry.rows;
        (0..rows).map(|row| self.bathymetry.at(0, row)).sum::<f64>() / rows as f64
    }

    /// Place from which the whole shore is seen: world x and z (m), [`SHORE_VIEW_BEFORE_M`] before the first land in the
    /// middle of the coast, or in its middle if there is none; and the heading towards the land, degrees.
    pub fn shore_view(&self) -> ([f64; 2], f64) {
        let grid = &self.bathymetry;
        let row = grid.rows / 2;
        let land = (0..grid.columns).find(|column| grid.at(*column, row) <= 0.0);
        let x =
            land.map_or(0.5 * self.side_m()[0], |column| (column as f64 * grid.cell_m - SHORE_VIEW_BEFORE_M).max(0.0));
        let y = row as f64 * grid.cell_m;
        (self.placement().world_m([x, y]), self.toward_deg)
    }

    /// Lengths of the grid along x and along y, m.
    pub fn side_m(&self) -> [f64; 2] {
        [self.bathymetry.columns, self.bathymetry.rows].map(|count| (count - 1) as f64 * self.bathymetry.cell_m)
    }
}

/// Distance of two points of the grid, m, of a coast whose longer side is `side_m`.
fn checked_cell_m(asked_m: Option<f64>, side_m: f64) -> Result<f64, String> {
    let cell_m = asked_m.unwrap_or(side_m / DEFAULT_CELLS);
    let cells = side_m / cell_m;
    if !(cell_m > 0.0 && (8.0..=MAX_CELLS).contains(&cells)) {
        let (least, most) = (side_m / MAX_CELLS, side_m / 8.0);
        return Err(format!("cells of {cell_m} m: a coast of {side_m:.0} m has cells of {least:.2} m to {most:.0} m"));
    }
    Ok(cell_m)
}

/// Depths of a square of a file in the frame of a coast. Cells that are larger than those of the file take their mean.
fn cut_out(grid: &ElevationGrid, centre_m: [f64; 2], side_m: f64, cell_m: f64, toward_deg: f64) -> Bathymetry {
    let count = (side_m / cell_m).round() as usize + 1;
    let (sin, cos) = toward_deg.to_radians().sin_cos();
    let half_m = 0.5 * (count - 1) as f64 * cell_m;
    // East and north along x and along y: y is 90 degrees clockwise from x.
    let at = |x: f64, y: f64| {
        let (u, v) = (x - half_m, y - half_m);
        -grid.at(centre_m[0] + u * sin + v * cos, centre_m[1] + u * cos - v * sin)
    };
    let samples = (cell_m / grid.cell_m[0].min(grid.cell_m[1])).ceil().clamp(1.0, 16.0);
    let mean = |x: f64, y: f64| {
        let offset = |s: f64| ((s + 0.5) / samples - 0.5) * cell_m;
        let steps = || (0..samples as u32).map(f64::from);
        let sum: f64 =
            steps().flat_map(|i| steps().map(move |j| (i, j))).map(|(i, j)| at(x + offset(i), y + offset(j))).sum();
        sum / (samples * samples)
    };
    Bathymetry::from_fn(count, count, cell_m, mean)
}

/// Direction in which the sea floor rises: the bearing (degrees clockwise from north) of the sum of the slopes between two
/// depths; `None` if the slopes cancel each other, as around an island.
fn shoreward_deg(grid: &ElevationGrid, centre_m: [f64; 2], side_m: f64) -> Option<f64> {
    let step_m = side_m / (SLOPE_POINTS - 1) as f64;
    let at = |i: usize, j: usize| {
        let [east, north] = [i, j].map(|index| index as f64 * step_m - 0.5 * side_m);
        grid.at(centre_m[0] + east, centre_m[1] + north)
    };
    let ([mut east, mut north], mut size) = ([0.0; 2], 0.0);
    for i in 1..SLOPE_POINTS - 1 {
        for j in 1..SLOPE_POINTS - 1 {
            if (SLOPE_DEPTHS_M[0]..SLOPE_DEPTHS_M[1]).contains(&-at(i, j)) {
                let slope = [at(i + 1, j) - at(i - 1, j), at(i, j + 1) - at(i, j - 1)];
                (east, north) = (east + slope[0], north + slope[1]);
                size += slope[0].hypot(slope[1]);
            }
        }
    }
    (east.hypot(north) > 0.15 * size).then(|| east.atan2(north).to_degrees().rem_euclid(360.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file whose elevation rises by 1 in 40 towards the bearing 120 degrees; the shore is 200 m beyond the middle.
    fn file() -> BathymetryFile {
        let (columns, rows, cell_m) = (161, 121, [10.0, 12.0]);
        let (sin, cos) = 120.0_f64.to_radians().sin_cos();
        let at = |index: usize| {
            let east = ((index % columns) as f64 - 80.0) * cell_m[0];
            let north = ((index / columns) as f64 - 60.0) * cell_m[1];
            ((east * sin + north * cos - 200.0) / 40.0) as f32
        };
        let elevation_m = (0..columns * rows).map(at).collect();
        let grid = ElevationGrid { columns, rows, cell_m, elevation_m, middle_deg: None };
        BathymetryFile { name: "slope.asc".into(), grid, notices: Vec::new() }
    }

    #[test]
    fn a_file_is_turned_so_that_the_land_lies_ahead() {
        let coast = PlacedCoast::from_file(&file(), &PlacingOptions::default()).expect("a coast");
        assert_eq!(coast.toward_deg, 120.0);
        let grid = &coast.bathymetry;
        let middle_m = 0.5 * coast.side_m()[0];
        assert!(coast.side_m()[0] < 1440.0 && coast.side_m()[0] > 1000.0, "inside the file");
        for j in [0, 50, grid.rows - 1] {
            for i in [0, 70, grid.columns - 1] {
                let want = (200.0 - (i as f64 * grid.cell_m - middle_m)) / 40.0;
                assert!((grid.at(i, j) - want).abs() < 0.02, "{i} {j}: {}, not {want}", grid.at(i, j));
            }
        }
        // Moved 100 m towards the shore, which then lies 100 m beyond the middle, with cells larger than those of the file.
        let (sin, cos) = 120.0_f64.to_radians().sin_cos();
        let options = PlacingOptions {
            size_m: Some(600.0),
            centre_m: [100.0 * sin, 100.0 * cos],
            cell_m: Some(30.0),
            ..PlacingOptions::default()
        };
        let coast = PlacedCoast::from_file(&file(), &options).expect("a coast");
        assert_eq!((coast.bathymetry.columns, coast.bathymetry.rows), (21, 21));
        assert!((coast.bathymetry.at(10, 3) - 2.5).abs() < 0.02, "{}", coast.bathymetry.at(10, 3));
    }

    #[test]
    fn the_frame_is_that_of_the_waves() {
        // A coast towards the east is not turned; one towards the south is turned by 90 degrees.
        let beach = BuiltInCoast::find("beach").expect("a beach");
        let toward = |toward_deg: f64| PlacingOptions { toward_deg: Some(toward_deg), ..PlacingOptions::default() };
        let east = PlacedCoast::built_in(beach, &toward(90.0)).expect("a coast");
        assert_eq!((east.turn_rad(), east.placement().origin_m), (0.0, [-750.0, -750.0]));
        let south = PlacedCoast::built_in(beach, &toward(180.0)).expect("a coast");
        let [x, z] = south.placement().origin_m;
        assert!((x - 750.0).abs() < 1e-9 && (z + 750.0).abs() < 1e-9, "{x} {z}");
        assert_eq!(east.bathymetry, south.bathymetry);
        // The waterline lies 580 m ahead of the middle, and the bed goes on beyond the grid as at its edge.
        for (coast, ahead) in [(&east, [1.0, 0.0]), (&south, [0.0, 1.0])] {
            let at = |m: f64| coast.depth_at_m([m * ahead[0], m * ahead[1]]);
            assert!(at(560.0) > 0.5 && at(600.0) < -0.5 && at(-900.0) == at(-750.0), "{} {}", at(560.0), at(600.0));
            assert!((at(-300.0) - (beach.depth_m)(450.0, 750.0)).abs() < 0.02);
        }
        assert_eq!((east.bathymetry.columns, east.bathymetry.cell_m), (201, 7.5));
    }

    #[test]
    fn the_view_of_the_shore_looks_at_the_land_from_the_water() {
        for coast in &super::super::built_in::BUILT_IN {
            let placed = PlacedCoast::built_in(coast, &PlacingOptions::default()).expect("a coast");
            assert!((8.0..25.0).contains(&placed.seaward_depth_m()), "{}", coast.name);
            let ([east, south], heading_deg) = placed.shore_view();
            let (sin, cos) = heading_deg.to_radians().sin_cos();
            // Depth at the point of the grid that is nearest to a point ahead of the eye.
            let (placement, grid) = (placed.placement(), &placed.bathymetry);
            let depth = |ahead_m: f64| {
                let at = placement.in_frame_m([east + ahead_m * sin, south - ahead_m * cos]);
                let [column, row] = at.map(|m| (m / grid.cell_m).round() as usize);
                grid.at(column, row)
            };
            assert!(depth(0.0) > 1.0, "{}: {}", coast.name, depth(0.0));
            assert!(depth(SHORE_VIEW_BEFORE_M) < 0.2 && depth(SHORE_VIEW_BEFORE_M - 30.0) > 0.0, "{}", coast.name);
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let refused =
            |options: PlacingOptions| PlacedCoast::from_file(&file(), &options).map(drop).expect_err("refused");
        let none = PlacingOptions::default();
        assert!(refused(PlacingOptions { toward_deg: Some(300.0), ..none }).contains("--toward turns the coast"));
        assert!(refused(PlacingOptions { size_m: Some(1e9), ..none }).contains("10 m to 100 km"));
        assert!(refused(PlacingOptions { cell_m: Some(0.01), ..none }).contains("cells of 0.01 m"));
        assert!(refused(PlacingOptions { cell_m: Some(f64::NAN), ..none }).contains("cells of"));
        let beach = BuiltInCoast::find("beach").expect("a beach");
        assert!(PlacedCoast::built_in(beach, &PlacingOptions { size_m: Some(500.0), ..none }).is_err());
    }
}
