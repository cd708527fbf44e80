//! What nature does to the heights of a coast: dunes, the cusps of a beach, and rocks.

use super::relief::{BEFORE, INNER, POINTS, Relief, inner_points, smooth};
use crate::render::water::noise::NoiseLattice;

/// Slopes between which land becomes rock.
const ROCK_SLOPES: [f32; 2] = [0.42, 0.8];
/// Height of the edges and ledges of rock, m, and the side of the tile of noise that shapes them, m.
const LEDGES_M: f32 = 2.2;
const ROCK_TILE_M: f64 = 173.0;
/// Heights of the hummocks of dunes, m, the sides of the tiles of their noise, m, the heights of the ground between which
/// they begin, m, and the distance from the edges of the coast's rectangle, where there are none, m.
const HUMMOCKS: [(f32, f64); 3] = [(3.2, 410.0), (1.9, 173.0), (0.8, 71.0)];
const HUMMOCK_GROUND_M: [f32; 2] = [2.4, 5.0];
const NO_HUMMOCKS_M: f64 = 120.0;
/// Heights of the cusps and lobes that waves build on a beach, m, the sides of the tiles of their noise, m, the height
/// above and below the still water up to which they are found, m, and the slope from which the ground has none.
const CUSPS: [(f32, f64); 2] = [(0.7, 431.0), (0.5, 181.0)];
const CUSPS_UP_TO_M: f32 = 1.8;
const CUSPS_SLOPE: f32 = 0.3;

impl Relief {
    /// Gives sandy land the hummocks and hollows that wind and grass make.
    pub(super) fn shape_dunes(&mut self) {
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

    /// Gives the sand that waves wash the cusps and lobes that they build there, so that the edge of the water is no
    /// straight line. The solver of the waves does not know them: they are smaller than its cells.
    pub(super) fn shape_cusps(&mut self) {
        let slopes = self.slopes(BEFORE..BEFORE + INNER);
        let layers: [NoiseLattice; 2] = std::array::from_fn(|i| NoiseLattice::gradients(7, 111 + i as u32));
        for (j, y) in inner_points(&self.axes[1]) {
            for (i, x) in inner_points(&self.axes[0]) {
                let index = j * POINTS + i;
                let [sx, sy] = slopes[index];
                let share = smooth(1.0 - self.height_m[index].abs() / CUSPS_UP_TO_M)
                    * smooth(2.0 - 2.0 * sx.hypot(sy) / CUSPS_SLOPE);
                if share > 0.0 {
                    let [u, v] = [x, y].map(|at| at as f32);
                    let noise: f32 = CUSPS
                        .iter()
                        .zip(&layers)
                        .map(|((height_m, tile_m), layer)| {
                            height_m * layer.perlin_noise(u / *tile_m as f32, v / *tile_m as f32)
                        })
                        .sum();
                    self.height_m[index] += share * noise;
                }
            }
        }
    }

    /// Gives steep land the edges and ledges of rock.
    pub(super) fn shape_rocks(&mut self) {
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
}
