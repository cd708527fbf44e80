//! The triangles of the land: a grid of heights divided no finer than its relief needs (right-triangulated irregular
//! networks; Evans, Kirkpatrick and Townsend 2001). Neighbouring triangles share their corners, so that there are no cracks.

use super::relief::{CELLS, POINTS, Relief};
use crate::gpu::layout::gpu_struct;
use crate::state::camera::EARTH_RADIUS_M;
use half::f16;

/// Height, m, below which no land is drawn: the bed is drawn as part of the water.
pub const LOWEST_M: f32 = -4.0;
/// Largest error of the heights near the water, and what each metre above it and each metre of distance from the coast's
/// rectangle add, m.
const TOLERANCE_M: f64 = 0.03;
const TOLERANCE_PER_HEIGHT: f64 = 0.015;
const TOLERANCE_PER_DISTANCE: f64 = 8e-4;
/// Height, m, above which errors may be larger.
const SWASH_M: f64 = 3.0;

gpu_struct! {
    /// WGSL `LandVertex`: a corner of the triangles of the land.
    pub struct LandVertex as "LandVertex" {
        /// Position in the frame of the coast, m.
        place: [f32; 2],
        /// Height above the still water, m.
        height_m: f32,
        /// Slopes along both axes of that frame as half floats.
        slope: u32,
    }
}

/// Triangles of the land, three indices each.
pub struct LandMesh {
    pub vertices: Vec<LandVertex>,
    pub indices: Vec<u32>,
}

/// A right triangle of the grid: ends of its longest side, and the corner opposite, as column and row.
type Corners = [[usize; 2]; 3];

impl LandMesh {
    pub fn new(relief: &Relief) -> Self {
        let mesh = Self { vertices: Vec::new(), indices: Vec::new() };
        let mut division = Division { relief, errors: errors(relief), numbers: vec![u32::MAX; POINTS * POINTS], mesh };
        division.divide([[0, 0], [CELLS, CELLS], [CELLS, 0]]);
        division.divide([[CELLS, CELLS], [0, 0], [0, CELLS]]);
        division.mesh
    }
}

/// Index of a point of the grid.
fn index([column, row]: [usize; 2]) -> usize {
    row * POINTS + column
}

fn middle(a: [usize; 2], b: [usize; 2]) -> [usize; 2] {
    [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]
}

/// For each point where a triangle may be divided, the largest error of the heights without this division or those
/// within it, in units of the tolerance there.
fn errors(relief: &Relief) -> Vec<f32> {
    // On the round Earth, a long triangle would lie below the ground.
    let round: Vec<f64> = (0..POINTS * POINTS)
        .map(|i| {
            let [x, y] = [relief.axes[0].at_m[i % POINTS], relief.axes[1].at_m[i / POINTS]];
            f64::from(relief.height_m[i]) - (x * x + y * y) / (2.0 * EARTH_RADIUS_M)
        })
        .collect();
    let tolerance = |[column, row]: [usize; 2]| {
        let height_m = f64::from(relief.height_m[index([column, row])]);
        let beyond_m = relief.axes[0].beyond_m(column).abs().max(relief.axes[1].beyond_m(row).abs());
        TOLERANCE_M + TOLERANCE_PER_HEIGHT * (height_m.abs() - SWASH_M).max(0.0) + TOLERANCE_PER_DISTANCE * beyond_m
    };
    let mut errors = vec![0.0f32; POINTS * POINTS];
    // The triangles are numbered as a binary tree. The smallest ones come last.
    let count = 2 * CELLS * CELLS - 2;
    let parents = count - CELLS * CELLS;
    for number in (0..count).rev() {
        let [a, b, c] = corners_of(number);
        let at = middle(a, b);
        let error = 0.5 * (round[index(a)] + round[index(b)]) - round[index(at)];
        let mut largest = errors[index(at)].max((error.abs() / tolerance(at)) as f32);
        if number < parents {
            largest = largest.max(errors[index(middle(a, c))]).max(errors[index(middle(b, c))]);
        }
        errors[index(at)] = largest;
    }
    errors
}

/// Corners of the triangle with a number in the binary tree of divisions: after the first, the bits of the number plus 2
/// tell which half was taken.
fn corners_of(number: usize) -> Corners {
    let mut id = number + 2;
    let (mut a, mut b, mut c) =
        if id & 1 == 1 { ([0, 0], [CELLS, CELLS], [CELLS, 0]) } else { ([CELLS, CELLS], [0, 0], [0, CELLS]) };
    id >>= 1;
    while id > 1 {
        let m = middle(a, b);
        if id & 1 == 1 {
            (b, a) = (a, c);
        } else {
            (a, b) = (b, c);
        }
        c = m;
        id >>= 1;
    }
    [a, b, c]
}

struct Division<'a> {
    relief: &'a Relief,
    errors: Vec<f32>,
    /// Number of the vertex at each point of the grid that has one.
    numbers: Vec<u32>,
    mesh: LandMesh,
}

impl Division<'_> {
    /// Adds a triangle, divided as finely as its errors demand.
    fn divide(&mut self, [a, b, c]: Corners) {
        let m = middle(a, b);
        if a[0].abs_diff(c[0]) + a[1].abs_diff(c[1]) > 1 && self.errors[index(m)] > 1.0 {
            self.divide([c, a, m]);
            self.divide([b, c, m]);
        } else if [a, b, c].iter().any(|at| self.relief.height_m[index(*at)] > LOWEST_M) {
            let numbers = [a, b, c].map(|at| self.vertex(at));
            self.mesh.indices.extend(numbers);
        }
    }

    fn vertex(&mut self, at: [usize; 2]) -> u32 {
        let (relief, next) = (self.relief, self.mesh.vertices.len() as u32);
        let number = &mut self.numbers[index(at)];
        if *number == u32::MAX {
            *number = next;
            let [x, y] = relief.slope[index(at)].map(|slope| u32::from(f16::from_f32(slope).to_bits()));
            self.mesh.vertices.push(LandVertex {
                place: [0, 1].map(|axis| relief.axes[axis].at_m[at[axis]] as f32),
                height_m: relief.height_m[index(at)],
                slope: x | y << 16,
            });
        }
        *number
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::placed::PlacingOptions;
    use crate::coast::{BuiltInCoast, PlacedCoast};
    use std::collections::HashMap;

    #[test]
    fn the_mesh_has_no_cracks_and_keeps_its_tolerance() {
        for name in ["beach", "harbour"] {
            let coast = BuiltInCoast::find(name).expect("a coast");
            let relief = Relief::new(&PlacedCoast::built_in(coast, &PlacingOptions::default()).expect("placed"));
            let mesh = LandMesh::new(&relief);
            let triangles = mesh.indices.len() / 3;
            eprintln!("{name}: {triangles} triangles, {} vertices", mesh.vertices.len());
            assert!((2_000..200_000).contains(&triangles), "{triangles}");
            // An edge inside the land has a triangle on either side. With a crack, some edge on dry land has one.
            let mut sides: HashMap<[u32; 2], u32> = HashMap::new();
            for triangle in mesh.indices.chunks(3) {
                for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                    let (a, b) = (triangle[from], triangle[to]);
                    *sides.entry([a.min(b), a.max(b)]).or_default() += 1;
                }
            }
            let border = |v: &LandVertex| v.place.iter().any(|at| !(-29_000.0..31_000.0).contains(at));
            for ([a, b], count) in sides {
                let [a, b] = [a, b].map(|i| &mesh.vertices[i as usize]);
                let is_border = (border(a) && border(b)) || a.height_m.min(b.height_m) <= LOWEST_M;
                assert!(count == 2 || is_border, "{count} triangles at {a:?} {b:?}");
            }
        }
    }

    #[test]
    fn numbers_and_divisions_name_the_same_triangles() {
        assert_eq!(corners_of(1), [[0, 0], [CELLS, CELLS], [CELLS, 0]]);
        assert_eq!(corners_of(0), [[CELLS, CELLS], [0, 0], [0, CELLS]]);
        let [a, b, c] = corners_of(0);
        let halves = [[c, a, middle(a, b)], [b, c, middle(a, b)]];
        let found: Vec<Corners> = (2..6).map(corners_of).collect();
        assert!(halves.iter().all(|half| found.contains(half)), "{found:?}");
    }
}
