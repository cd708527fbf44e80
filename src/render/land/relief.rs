//! The heights of a coast as the picture shows them, on a grid that reaches to the horizon: fine within the coast's
//! rectangle, with the blocks of breakwaters and the edges of rocks, and coarser the farther it is from it.

use crate::coast::{Bathymetry, BuiltInCoast, PlacedCoast, Structure};
use crate::render::water::noise::NoiseLattice;

/// Number of points along each side of the coast's rectangle.
pub const INNER: usize = 768;
/// Number of cells of the whole grid along each side; a power of two.
pub const CELLS: usize = 1024;
/// Number of points of the whole grid along each side.
pub const POINTS: usize = CELLS + 1;
/// Index of the first point of the coast's rectangle.
const BEFORE: usize = 128;
/// Distance that the land goes on beyond the coast's rectangle, m.
const FAR_M: f64 = 30_000.0;
/// Slopes between which land becomes rock.
const ROCK_SLOPES: [f32; 2] = [0.42, 0.8];
/// Height of the edges and ledges of rock, m, and sides of the tiles of noise that shape them and blocks of rubble, m.
const LEDGES_M: f32 = 2.2;
const ROCK_TILE_M: f64 = 173.0;
const RUBBLE_TILE_M: f64 = 97.0;
/// Heights of the hummocks of dunes, m, the sides of the tiles of their noise, m, the heights of the ground between which
/// they begin, m, and the distance from the edges of the coast's rectangle, where there are none, m.
const HUMMOCKS: [(f32, f64); 3] = [(3.2, 410.0), (1.9, 173.0), (0.8, 71.0)];
const HUMMOCK_GROUND_M: [f32; 2] = [2.4, 5.0];
const NO_HUMMOCKS_M: f64 = 120.0;
/// Height by which the blocks of a breakwater differ, m.
const BLOCKS_M: f64 = 1.5;
/// Hills beyond the coast: their height, m, the distances inland over which they rise, m, and the tile of their noise, m.
const HILLS_M: f64 = 120.0;
const HILLS_FROM_M: [f64; 2] = [60.0, 3000.0];
const HILLS_TILE_M: f64 = 13_000.0;
/// Height of land, m, from which there are hills behind it.
const HILLS_BEHIND_M: f64 = 1.0;

/// What the land consists of, besides sand, rock and plants, which follow from height and slope.
pub const RUBBLE: f32 = -1.0;
/// As [`RUBBLE`]: concrete of a quay.
pub const CONCRETE: f32 = 1.0;

/// Positions of the points of the grid along one axis of the coast's frame, m.
pub struct Axis {
    pub at_m: Vec<f64>,
    /// Length of the coast's rectangle, m.
    pub side_m: f64,
}

/// Heights of the land at the points of the grid, whose values have the index row x [`POINTS`] + column.
pub struct Relief {
    /// The columns' x and the rows' y.
    pub axes: [Axis; 2],
    /// Height above the still water, m.
    pub height_m: Vec<f32>,
    /// Slopes along x and y.
    pub slope: Vec<[f32; 2]>,
    /// [`RUBBLE`], [`CONCRETE`], or 0 for land as nature made it.
    pub kind: Vec<f32>,
}

impl Axis {
    fn new(side_m: f64) -> Self {
        let step_m = side_m / (INNER - 1) as f64;
        let outer = |cells: usize| -> Vec<f64> {
            // The ratio of neighbouring cells with which they reach FAR_M.
            let reach = |ratio: f64| (1..=cells).map(|k| step_m * ratio.powi(k as i32)).sum::<f64>();
            let (mut low, mut high) = (1.0, 2.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if reach(middle) > FAR_M { high = middle } else { low = middle }
            }
            let mut at = 0.0;
            let mut step = |k: usize| {
                at += step_m * low.powi(k as i32);
                at
            };
            (1..=cells).map(&mut step).collect()
        };
        let mut at_m: Vec<f64> = outer(BEFORE).into_iter().rev().map(|at| -at).collect();
        at_m.extend((0..INNER).map(|i| i as f64 * step_m));
        at_m.extend(outer(POINTS - BEFORE - INNER).into_iter().map(|at| side_m + at));
        Self { at_m, side_m }
    }

    /// Distance, m, of a point before the rectangle (negative) or behind it (positive); 0 within.
    pub fn beyond_m(&self, index: usize) -> f64 {
        let at = self.at_m[index];
        if at < 0.0 { at } else { (at - self.side_m).max(0.0) }
    }
}

/// Index of a point of the whole grid, limited to the points of the coast's rectangle.
fn nearest_inner(index: usize) -> usize {
    index.clamp(BEFORE, BEFORE + INNER - 1)
}

impl Relief {
    pub fn new(coast: &PlacedCoast) -> Self {
        let axes = coast.side_m().map(Axis::new);
        let mut height_m = vec![0.0; POINTS * POINTS];
        let mut kind = vec![0.0; POINTS * POINTS];
        let built_in = coast.built_in.and_then(BuiltInCoast::find);
        for (j, y) in inner_points(&axes[1]) {
            for (i, x) in inner_points(&axes[0]) {
                let depth_m = match built_in {
                    Some(built_in) => (built_in.depth_m)(x, y),
                    None => between_points(&coast.bathymetry, x, y),
                };
                height_m[j * POINTS + i] = -depth_m as f32;
            }
        }
        let mut relief = Self { axes, height_m, slope: vec![[0.0; 2]; POINTS * POINTS], kind: Vec::new() };
        relief.shape_dunes();
        relief.shape_rocks();
        if built_in.is_some() {
            coast.structures.iter().for_each(|structure| relief.build(structure, &mut kind));
        }
        relief.kind = kind;
        relief.go_on();
        relief.slope = relief.slopes(0..POINTS);
        relief
    }

    /// Slopes along x and y by differences between neighbours, of the points whose row and column are in a range.
    fn slopes(&self, range: std::ops::Range<usize>) -> Vec<[f32; 2]> {
        let mut slope = vec![[0.0; 2]; POINTS * POINTS];
        let (first, last) = (range.start, range.end - 1);
        let around = |i: usize| [i.max(first + 1) - 1, (i + 1).min(last)];
        for j in range.clone() {
            let [above, below] = around(j);
            let dy = (self.axes[1].at_m[below] - self.axes[1].at_m[above]) as f32;
            for i in range.clone() {
                let [left, right] = around(i);
                let dx = (self.axes[0].at_m[right] - self.axes[0].at_m[left]) as f32;
                let at = |j: usize, i: usize| self.height_m[j * POINTS + i];
                slope[j * POINTS + i] = [(at(j, right) - at(j, left)) / dx, (at(below, i) - at(above, i)) / dy];
            }
        }
        slope
    }

    /// Gives sandy land the hummocks and hollows that wind and grass make.
    fn shape_dunes(&mut self) {
        let slopes = self.slopes(BEFORE..BEFORE + INNER);
        let layers: [NoiseLattice; 3] = std::array::from_fn(|i| NoiseLattice::gradients(7, 101 + i as u32));
        let sides_m = [self.axes[0].side_m, self.axes[1].side_m];
        for (j, y) in inner_points(&self.axes[1]) {
            for (i, x) in inner_points(&self.axes[0]) {
                let index = j * POINTS + i;
                let [from, to] = HUMMOCK_GROUND_M;
                let [sx, sy] = slopes[index];
                let edge_m = (sides_m[0] - x).min(y).min(sides_m[1] - y);
                let share = smooth((self.height_m[index] - from) / (to - from))
                    * smooth((edge_m / NO_HUMMOCKS_M) as f32)
                    * (1.0 - smooth(4.0 * sx.hypot(sy) - 1.0));
                if share > 0.0 {
                    let noise: f32 = HUMMOCKS
                        .iter()
                        .zip(&layers)
                        .map(|((height_m, tile_m), layer)| {
                            // Crests are sharper than hollows.
                            let wave = layer.perlin_noise((x / tile_m) as f32, (y / tile_m) as f32);
                            height_m * (0.25 - wave.abs())
                        })
                        .sum();
                    self.height_m[index] += share * noise;
                }
            }
        }
    }

    /// Gives steep land the edges and ledges of rock.
    fn shape_rocks(&mut self) {
        let slopes = self.slopes(BEFORE..BEFORE + INNER);
        let cracks = [NoiseLattice::feature_points(17, 81, 0.4), NoiseLattice::feature_points(43, 82, 0.3)];
        let bends = [NoiseLattice::gradients(11, 83), NoiseLattice::gradients(11, 84)];
        for j in BEFORE..BEFORE + INNER {
            for i in BEFORE..BEFORE + INNER {
                let index = j * POINTS + i;
                let [sx, sy] = slopes[index];
                let rock = smooth((sx.hypot(sy) - ROCK_SLOPES[0]) / (ROCK_SLOPES[1] - ROCK_SLOPES[0]));
                if rock > 0.0 && self.height_m[index] > -4.0 {
                    let [u, v] = [self.axes[0].at_m[i], self.axes[1].at_m[j]].map(|at| (at / ROCK_TILE_M) as f32);
                    let (x, y) = (u + 0.03 * bends[0].perlin_noise(u, v), v + 0.03 * bends[1].perlin_noise(u, v));
                    let noise = cracks[0].ridge_noise(x, y) + 0.5 * cracks[1].ridge_noise(x, y);
                    self.height_m[index] += rock * LEDGES_M * (0.7 - noise);
                }
            }
        }
    }

    /// Builds a breakwater or a quay onto the land.
    fn build(&mut self, structure: &Structure, kind: &mut [f32]) {
        let blocks = [NoiseLattice::feature_points(37, 91, 0.35), NoiseLattice::feature_points(61, 92, 0.35)];
        let is_rubble = structure.side_slope > 0.0;
        for (j, y) in inner_points(&self.axes[1]) {
            for (i, x) in inner_points(&self.axes[0]) {
                let index = j * POINTS + i;
                let Some(top_m) = structure.height_m(structure.distance_m(x, y), 0.0) else { continue };
                let mut top_m = top_m as f32;
                if top_m < self.height_m[index] - BLOCKS_M as f32 {
                    continue;
                }
                if is_rubble {
                    let [u, v] = [x, y].map(|at| (at / RUBBLE_TILE_M) as f32);
                    let noise = blocks[0].ridge_noise(u, v) + 0.4 * blocks[1].ridge_noise(u, v);
                    top_m += BLOCKS_M as f32 * (0.45 - noise);
                }
                if top_m > self.height_m[index] {
                    self.height_m[index] = top_m;
                    kind[index] = if is_rubble { RUBBLE } else { CONCRETE };
                }
            }
        }
    }

    /// Continues the heights beyond the coast's rectangle: by those at its edges, and inland with hills.
    fn go_on(&mut self) {
        let last = BEFORE + INNER - 1;
        let edge: Vec<f64> = (0..POINTS).map(|j| f64::from(self.height_m[nearest_inner(j) * POINTS + last])).collect();
        let inner_edge = &edge[BEFORE..=last];
        let mean_m = inner_edge.iter().sum::<f64>() / INNER as f64;
        let is_land = inner_edge.iter().all(|height| *height > HILLS_BEHIND_M);
        let octaves: [NoiseLattice; 5] = std::array::from_fn(|o| NoiseLattice::gradients(3 << o, 95 + o as u32));
        for j in 0..POINTS {
            for i in 0..POINTS {
                let inner = nearest_inner(j) * POINTS + nearest_inner(i);
                if inner == j * POINTS + i {
                    continue;
                }
                let inland_m = self.axes[0].beyond_m(i);
                let mut height_m = f64::from(self.height_m[inner]);
                if inland_m > 0.0 && is_land {
                    let smoothed = f64::from(smooth((inland_m / 500.0) as f32));
                    let [from, to] = HILLS_FROM_M;
                    let rise = f64::from(smooth(((inland_m - from) / (to - from)) as f32));
                    let [u, v] = [self.axes[0].at_m[i], self.axes[1].at_m[j]].map(|at| (at / HILLS_TILE_M) as f32);
                    let mut weight = 1.0;
                    let noise = octaves.iter().fold(0.0, |sum, octave| {
                        let part = weight * octave.perlin_noise(u, v);
                        weight *= 0.5;
                        sum + part
                    });
                    height_m += smoothed * (mean_m - height_m) + HILLS_M * rise * f64::from(0.7 + 1.1 * noise).max(0.0);
                }
                self.height_m[j * POINTS + i] = height_m as f32;
            }
        }
    }

    /// Height, m, at a place in the coast's rectangle, by linear interpolation.
    pub fn height_at_m(&self, place_m: [f64; 2]) -> f32 {
        self.between(place_m, |i| [self.height_m[i], 0.0])[0]
    }

    /// Slopes along x and y at a place in the coast's rectangle, by linear interpolation.
    pub fn slope_at(&self, place_m: [f64; 2]) -> [f32; 2] {
        self.between(place_m, |i| self.slope[i])
    }

    /// Material of the ground, as in `kind`, at the grid point that is nearest to a place in the coast's rectangle.
    pub fn kind_at(&self, place_m: [f64; 2]) -> f32 {
        let [column, row] = self.inner_place(place_m).map(|at| at.round() as usize);
        self.kind[Self::inner_index(column, row)]
    }

    /// Column and row of a place in the coast's rectangle, as fractions between its points.
    fn inner_place(&self, place_m: [f64; 2]) -> [f64; 2] {
        let last = (INNER - 1) as f64;
        [0, 1].map(|axis| (place_m[axis] / self.axes[axis].side_m * last).clamp(0.0, last))
    }

    fn between(&self, place_m: [f64; 2], value: impl Fn(usize) -> [f32; 2]) -> [f32; 2] {
        let at = self.inner_place(place_m);
        let [column, row] = at.map(|at| (at as usize).min(INNER - 2));
        let [u, v] = [at[0] - column as f64, at[1] - row as f64].map(|part| part as f32);
        let corner = |i: usize, j: usize| value(Self::inner_index(column + i, row + j));
        let mix = |a: [f32; 2], b: [f32; 2], t: f32| [0, 1].map(|c: usize| a[c] + t * (b[c] - a[c]));
        mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v)
    }

    /// Index of the point of the coast's rectangle in this column and row of it.
    pub fn inner_index(column: usize, row: usize) -> usize {
        (BEFORE + row) * POINTS + BEFORE + column
    }
}

/// Indices and positions, m, of the points along an axis that lie in the coast's rectangle.
fn inner_points(axis: &Axis) -> Vec<(usize, f64)> {
    (BEFORE..BEFORE + INNER).map(|i| (i, axis.at_m[i])).collect()
}

/// 0 for x <= 0, 1 for x >= 1, with a smooth step between.
fn smooth(x: f32) -> f32 {
    let t = x.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Depth, m, between the points of a grid: a cubic spline (Catmull-Rom) through them.
fn between_points(grid: &Bathymetry, x: f64, y: f64) -> f64 {
    let place = |at: f64, count: usize| {
        let at = (at / grid.cell_m).clamp(0.0, (count - 1) as f64);
        let whole = at.floor().min((count - 2) as f64);
        (whole as isize, at - whole)
    };
    let ((i, u), (j, v)) = (place(x, grid.columns), place(y, grid.rows));
    let weights = |t: f64| {
        let (square, cube) = (t * t, t * t * t);
        [
            0.5 * (2.0 * square - t - cube),
            1.0 + 0.5 * (3.0 * cube - 5.0 * square),
            0.5 * (t + 4.0 * square - 3.0 * cube),
            0.5 * (cube - square),
        ]
    };
    let (along, across) = (weights(u), weights(v));
    let at = |i: isize, j: isize| {
        grid.at(i.clamp(0, grid.columns as isize - 1) as usize, j.clamp(0, grid.rows as isize - 1) as usize)
    };
    let row = |j: isize| (-1..3).zip(along).map(|(di, weight)| weight * at(i + di, j)).sum::<f64>();
    (-1..3).zip(across).map(|(dj, weight)| weight * row(j + dj)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::placed::PlacingOptions;

    fn relief(name: &str) -> Relief {
        let coast = BuiltInCoast::find(name).expect("a coast");
        Relief::new(&PlacedCoast::built_in(coast, &PlacingOptions::default()).expect("placed"))
    }

    #[test]
    fn within_its_rectangle_a_beach_has_its_heights_and_beyond_those_of_the_edge() {
        let relief = relief("beach");
        let beach = BuiltInCoast::find("beach").expect("a beach").depth_m;
        for (column, row) in [(0, 0), (400, 300), (690, 5), (767, 767)] {
            let index = Relief::inner_index(column, row);
            let [x, y] = [column, row].map(|at| at as f64 * 1500.0 / 767.0);
            assert!((f64::from(relief.height_m[index]) + beach(x, y)).abs() < 0.02, "{column} {row}");
        }
        // 30 km along the shore.
        let shore = Relief::inner_index(680, 0);
        assert_eq!(relief.height_m[shore - BEFORE * POINTS], relief.height_m[shore]);
        assert!((relief.axes[1].at_m[0] + FAR_M).abs() < 1.0);
        // Far inland the land is higher than at the edge, and nowhere does it break off.
        let far = relief.height_m[Relief::inner_index(0, 0) + POINTS - 1 - BEFORE];
        assert!(far > 10.0, "{far}");
        let steepest = relief.slope.iter().flatten().fold(0.0f32, |steepest, slope| steepest.max(slope.abs()));
        assert!(steepest < 1.0, "{steepest}");
    }

    #[test]
    fn a_quay_is_a_wall_and_a_breakwater_has_blocks() {
        let relief = relief("harbour");
        let concrete = relief.kind.iter().zip(&relief.height_m).filter(|(kind, _)| **kind == CONCRETE);
        let (count, wrong) = concrete
            .fold((0, 0), |(count, wrong), (_, height)| (count + 1, wrong + usize::from((height - 3.5).abs() > 1e-3)));
        assert!(count > 1000 && wrong == 0, "{count} {wrong}");
        let steepest = relief.slope.iter().map(|[x, _]| x.abs()).fold(0.0, f32::max);
        assert!(steepest > 2.0, "{steepest}");
        let tops: Vec<f32> = relief
            .kind
            .iter()
            .zip(&relief.height_m)
            .filter(|(kind, height)| **kind == RUBBLE && **height > 3.0)
            .map(|(_, height)| *height)
            .collect();
        let (low, high) = tops.iter().fold((9.0f32, 0.0f32), |(low, high), top| (low.min(*top), high.max(*top)));
        assert!(tops.len() > 300 && high - low > 1.0 && high < 6.0, "{} {low} {high}", tops.len());
    }

    #[test]
    fn a_file_is_as_smooth_as_a_spline_through_its_points() {
        let plane = Bathymetry::from_fn(9, 7, 20.0, |x, y| 0.05 * x - 0.02 * y + 3.0);
        for (x, y) in [(40.0, 60.0), (55.0, 33.3), (103.7, 90.1)] {
            assert!((between_points(&plane, x, y) - (0.05 * x - 0.02 * y + 3.0)).abs() < 1e-5);
        }
    }
}
