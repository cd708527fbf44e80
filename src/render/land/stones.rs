//! Stones on the land: the blocks of breakwaters, and what has fallen from steep rock near the water. They are chosen
//! once, when the land is uploaded, from a hash of their places.

use super::relief::{RUBBLE, Relief};
use crate::gpu::layout::gpu_struct;
use crate::render::water::noise::NoiseLattice;
use crate::waves::noise::pcg4d;
use glam::Vec3;
use half::f16;
use std::collections::BTreeMap;
use std::ops::Range;

/// Sides of the squares of the ground with at most one stone each, m: on breakwaters, and below rock.
const BLOCK_CELL_M: f64 = 1.4;
const FALLEN_CELL_M: f64 = 2.3;
/// Smallest and largest length of a stone, m.
const BLOCK_M: [f32; 2] = [1.0, 2.5];
const FALLEN_M: [f32; 2] = [0.7, 2.5];
/// Heights of the ground between which stones lie, m.
const BLOCK_GROUND_M: Range<f32> = -1.4..9.0;
const FALLEN_GROUND_M: Range<f32> = -1.2..4.5;
/// Slopes of rock between which more and more stones have fallen from it, and how far they roll, m.
const FALLEN_SLOPES: [f32; 2] = [0.45, 0.85];
const ROLL_M: [f64; 2] = [4.0, 9.0];
/// Side of the squares in which stones are drawn together, m.
pub const TILE_M: f64 = 44.0;
/// Share of the stones of a tile, its longest ones, that are drawn far from the eye.
const LONG_SHARE: f64 = 0.5;

gpu_struct! {
    /// WGSL `LandStone`: a stone on the land.
    pub struct LandStone as "LandStone" {
        /// Position of the stone's middle in the frame of the coast, m, and its height above the still water, m.
        place: [f32; 2],
        height_m: f32,
        /// Length of the stone, m.
        size_m: f32,
        /// Orientation of the stone: a quaternion as four 8-bit signed fractions.
        turn: u32,
        /// Slopes of the ground below it as half floats.
        slope: u32,
        /// Kind of the stone: 1 to 2 for a block of a breakwater, 2 to 3 for rock. The fraction is the tone of its colour,
        /// from dark to light.
        look: f32,
        /// Random number, which gives each stone corners of its own.
        seed: u32,
    }
}

/// The stones of a square of the ground.
pub struct StoneTile {
    /// Middle in the frame of the coast, m.
    pub middle_m: [f64; 2],
    /// Indices of its stones, which are sorted from the longest to the shortest.
    pub stones: Range<u32>,
    /// Number of those that are drawn far from the eye.
    pub long: u32,
}

/// All stones of a coast, tile by tile.
pub struct Stones {
    pub stones: Vec<LandStone>,
    pub tiles: Vec<StoneTile>,
}

impl Stones {
    pub fn new(relief: &Relief) -> Self {
        let mut tiles: BTreeMap<[i32; 2], Vec<LandStone>> = BTreeMap::new();
        let mut add = |[x, y]: [f64; 2], stone: LandStone| {
            tiles.entry([x, y].map(|at| (at / TILE_M).floor() as i32)).or_default().push(stone);
        };
        for at in cells(relief, BLOCK_CELL_M) {
            if relief.kind_at(at) == RUBBLE && BLOCK_GROUND_M.contains(&relief.height_at_m(at)) {
                let random = Random::new(at, 1);
                let at = random.beside(at, BLOCK_CELL_M);
                add(at, random.stone(relief, at, 1.0, BLOCK_M));
            }
        }
        let clumps = NoiseLattice::gradients(97, 93);
        for at in cells(relief, FALLEN_CELL_M) {
            let height_m = relief.height_at_m(at);
            if relief.kind_at(at) != 0.0 || !FALLEN_GROUND_M.contains(&height_m) {
                continue;
            }
            let steep = steepest_around(relief, at);
            if steep > FALLEN_SLOPES[0] {
                let random = Random::new(at, 2);
                let [from, to] = FALLEN_SLOPES;
                let low = 1.0 - (height_m - 1.0).max(0.0) / (FALLEN_GROUND_M.end - 1.0);
                let [u, v] = at.map(|at| (at / 1400.0) as f32);
                let share = ((steep - from) / (to - from)).min(1.0) * low * (0.8 + clumps.perlin_noise(u, v));
                if random.part(3) < share {
                    let at = random.beside(at, FALLEN_CELL_M);
                    add(at, random.stone(relief, at, 2.0, FALLEN_M));
                }
            }
        }
        let mut all = Self { stones: Vec::new(), tiles: Vec::new() };
        for (tile, mut stones) in tiles {
            stones.sort_by(|a, b| b.size_m.total_cmp(&a.size_m));
            let first = all.stones.len() as u32;
            all.tiles.push(StoneTile {
                middle_m: tile.map(|at| (f64::from(at) + 0.5) * TILE_M),
                stones: first..first + stones.len() as u32,
                long: (LONG_SHARE * stones.len() as f64).ceil() as u32,
            });
            all.stones.append(&mut stones);
        }
        all
    }
}

/// Middles (x, y) of the squares with sides of `cell_m` that cover the coast's rectangle, m.
fn cells(relief: &Relief, cell_m: f64) -> impl Iterator<Item = [f64; 2]> {
    let [columns, rows] = [0, 1].map(|axis| (relief.axes[axis].side_m / cell_m) as usize);
    (0..columns * rows).map(move |i| [i % columns, i / columns].map(|at| (at as f64 + 0.5) * cell_m))
}

/// The steepest slope around a place.
fn steepest_around(relief: &Relief, [x, y]: [f64; 2]) -> f32 {
    let around = (0..16).map(|i| {
        let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 8.0).sin_cos();
        let far_m = ROLL_M[i as usize / 8];
        let [sx, sy] = relief.slope_at([x + far_m * cos, y + far_m * sin]);
        sx.hypot(sy)
    });
    around.fold(0.0, f32::max)
}

/// Random numbers of a place.
struct Random([[u32; 4]; 2]);

impl Random {
    fn new([x, y]: [f64; 2], key: u32) -> Self {
        let [x, y] = [x, y].map(|at| (at * 8.0) as u32);
        Self([0, 1].map(|half| pcg4d([x, y, key, 0x57 + half])))
    }

    /// The random number with an index of 0 to 7, from 0 to 1.
    fn part(&self, index: usize) -> f32 {
        (self.0[index / 4][index % 4] >> 8) as f32 / 16_777_216.0
    }

    /// A place in the square with sides of `cell_m` around another one.
    fn beside(&self, [x, y]: [f64; 2], cell_m: f64) -> [f64; 2] {
        let off = |index| 0.8 * cell_m * (f64::from(self.part(index)) - 0.5);
        [x + off(0), y + off(1)]
    }

    /// A stone, half buried, with a length in a range. Short ones are more frequent.
    fn stone(&self, relief: &Relief, at: [f64; 2], kind: f32, [shortest_m, longest_m]: [f32; 2]) -> LandStone {
        let size_m = shortest_m + (longest_m - shortest_m) * self.part(2).powf(1.7);
        let [sx, sy] = relief.slope_at(at).map(|slope| u32::from(f16::from_f32(slope).to_bits()));
        // A point of the unit sphere in four dimensions, nearly evenly distributed.
        let parts = [4, 5, 6, 7].map(|index| self.part(index) - 0.5);
        let length = parts.iter().map(|part| part * part).sum::<f32>().sqrt().max(1e-3);
        let bytes = parts.map(|part| (127.0 * part / length).round() as i8 as u8);
        LandStone {
            place: at.map(|at| at as f32),
            height_m: relief.height_at_m(at) + 0.1 * size_m,
            size_m,
            turn: u32::from_le_bytes(bytes),
            slope: sx | sy << 16,
            look: kind + 0.99 * ((self.0[1][1] >> 4 & 0xffff) as f32 / 65_536.0),
            seed: self.0[1][2],
        }
    }
}

/// Planes that bound a block: directions of their normals, which need not have length 1, and distances from its middle as
/// parts of its length. The first six are the sides of a bent box, the others break off some of its corners.
const PLANES: [([f32; 3], f32); 10] = [
    ([1.0, 0.12, -0.10], 0.50),
    ([-1.0, 0.10, 0.14], 0.48),
    ([0.08, 1.0, 0.13], 0.36),
    ([0.10, -1.0, 0.05], 0.34),
    ([-0.13, 0.07, 1.0], 0.40),
    ([0.09, 0.15, -1.0], 0.41),
    ([0.9, 0.8, 0.5], 0.50),
    ([-0.7, 0.9, -0.8], 0.51),
    ([0.6, -0.9, -0.9], 0.50),
    ([-0.9, 0.3, 0.9], 0.49),
];

/// A convex body whose faces are flat: its corners, and three indices of them for each triangle.
pub struct Block {
    pub corners: Vec<[f32; 4]>,
    pub indices: Vec<u32>,
}

impl Block {
    /// A stone seen from near, with a length of about 1.
    pub fn near() -> Self {
        Self::between(&PLANES)
    }

    /// A stone seen from afar.
    pub fn far() -> Self {
        Self::between(&PLANES[..6])
    }

    fn between(planes: &[([f32; 3], f32)]) -> Self {
        let planes: Vec<(Vec3, f32)> =
            planes.iter().map(|(normal, far)| (Vec3::from(*normal).normalize(), *far)).collect();
        // Each corner lies on three planes, and not beyond any.
        let mut corners: Vec<(Vec3, [usize; 3])> = Vec::new();
        for a in 0..planes.len() {
            for b in a + 1..planes.len() {
                for c in b + 1..planes.len() {
                    let [(na, da), (nb, db), (nc, dc)] = [a, b, c].map(|i| planes[i]);
                    let volume = na.dot(nb.cross(nc));
                    let corner = (da * nb.cross(nc) + db * nc.cross(na) + dc * na.cross(nb)) / volume;
                    if volume.abs() > 1e-4 && planes.iter().all(|(normal, far)| normal.dot(corner) < far + 1e-4) {
                        corners.push((corner, [a, b, c]));
                    }
                }
            }
        }
        let mut indices = Vec::new();
        for (plane, (normal, _)) in planes.iter().enumerate() {
            let mut around: Vec<usize> = (0..corners.len()).filter(|i| corners[*i].1.contains(&plane)).collect();
            let middle = around.iter().map(|i| corners[*i].0).sum::<Vec3>() / around.len().max(1) as f32;
            let (u, v) = normal.any_orthonormal_pair();
            let angle = |i: &usize| (corners[*i].0 - middle).dot(v).atan2((corners[*i].0 - middle).dot(u));
            around.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
            for pair in around.windows(2).skip(1) {
                indices.extend([around[0], pair[0], pair[1]].map(|i| i as u32));
            }
        }
        Self { corners: corners.iter().map(|(at, _)| at.extend(0.0).to_array()).collect(), indices }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::placed::PlacingOptions;
    use crate::coast::{BuiltInCoast, PlacedCoast};

    fn stones(name: &str) -> (Relief, Stones) {
        let coast = BuiltInCoast::find(name).expect("a coast");
        let relief = Relief::new(&PlacedCoast::built_in(coast, &PlacingOptions::default()).expect("placed"));
        let stones = Stones::new(&relief);
        (relief, stones)
    }

    #[test]
    fn breakwaters_and_cliffs_have_stones_and_beaches_none() {
        assert!(stones("beach").1.stones.is_empty());
        let (_, headland) = stones("headland");
        assert!((300..6000).contains(&headland.stones.len()), "{}", headland.stones.len());
        assert!(headland.stones.iter().all(|stone| stone.look >= 2.0));
        let (relief, harbour) = stones("harbour");
        assert!((8_000..20_000).contains(&harbour.stones.len()), "{}", harbour.stones.len());
        let mut next = 0;
        for tile in &harbour.tiles {
            assert!(tile.stones.start == next && tile.long <= tile.stones.len() as u32);
            next = tile.stones.end;
            let of_tile = &harbour.stones[tile.stones.start as usize..tile.stones.end as usize];
            assert!(of_tile.is_sorted_by(|a, b| a.size_m >= b.size_m));
            for stone in of_tile {
                let at = stone.place.map(f64::from);
                assert!(tile.middle_m.iter().zip(at).all(|(middle, at)| (middle - at).abs() < 0.5 * TILE_M + 2.0));
                // Its middle is above the ground, and its lower half below.
                let above_m = stone.height_m - relief.height_at_m(at);
                assert!((0.0..0.3 * stone.size_m).contains(&above_m), "{above_m}");
            }
        }
        assert_eq!(next as usize, harbour.stones.len());
        eprintln!("harbour: {} stones in {} tiles, headland: {}", next, harbour.tiles.len(), headland.stones.len());
    }

    #[test]
    fn blocks_are_closed_and_convex() {
        for (block, corners, triangles) in [(Block::near(), 16, 28), (Block::far(), 8, 12)] {
            assert_eq!((block.corners.len(), block.indices.len() / 3), (corners, triangles));
            let at = |i: u32| Vec3::from_slice(&block.corners[i as usize][..3]);
            let mut volume = 0.0;
            for triangle in block.indices.chunks(3) {
                let [a, b, c] = [0, 1, 2].map(|i| at(triangle[i]));
                let normal = (b - a).cross(c - a);
                volume += a.dot(normal) / 6.0;
                for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                    let back = |t: &&[u32]| (0..3).any(|i| t[i] == triangle[to] && t[(i + 1) % 3] == triangle[from]);
                    assert_eq!(block.indices.chunks(3).filter(back).count(), 1, "an edge has two sides");
                }
                assert!((0..corners as u32).all(|i| normal.dot(at(i) - a) < 1e-4), "all corners lie behind each face");
            }
            assert!((0.2..0.6).contains(&volume), "{volume}");
        }
    }
}
