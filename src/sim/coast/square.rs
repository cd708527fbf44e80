//! The square of the world in which the maps hold the waves at a coast.

use crate::coast::Transfer;

/// Length of the shortest waves of a transfer in the open sea, in texels of the square.
pub const SHORTEST_COASTAL_WAVE_TEXELS: f64 = 4.0;
/// Least distance of the coast's grid from the edges of the square, in texels: differences and filters of the maps reach
/// beyond the edges to the opposite side.
const MARGIN_TEXELS: f64 = 4.5;

/// A square of the world, parallel to its axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CoastSquare {
    /// World position (x, z) of the corner with the lowest x and z, m: a whole number of texels from the world origin.
    pub corner_m: [f64; 2],
    /// Side, m.
    pub side_m: f64,
}

impl CoastSquare {
    /// The smallest square that holds the grid of a transfer, for maps of `n` x `n` texels.
    pub fn around(transfer: &Transfer, n: u32) -> Self {
        let [wide, long] = [transfer.columns, transfer.rows].map(|count| (count - 1) as f64 * transfer.cell_m);
        let corners = [[0.0, 0.0], [wide, 0.0], [0.0, long], [wide, long]].map(|at| transfer.placement.world_m(at));
        let low = [0, 1].map(|axis| corners.iter().map(|c| c[axis]).fold(f64::INFINITY, f64::min));
        let high = [0, 1].map(|axis| corners.iter().map(|c| c[axis]).fold(f64::NEG_INFINITY, f64::max));
        let n = f64::from(n);
        let side_m = (high[0] - low[0]).max(high[1] - low[1]) * n / (n - 2.0 * MARGIN_TEXELS);
        let texel_m = side_m / n;
        let corner_m = [0, 1].map(|axis| {
            let middle = 0.5 * (low[axis] + high[axis]);
            ((middle - 0.5 * side_m) / texel_m).round() * texel_m
        });
        Self { corner_m, side_m }
    }

    /// Position of a world point (x, z), m, in the square: 0 to 1 along both axes.
    pub fn uv(&self, at_m: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (at_m[axis] - self.corner_m[axis]) / self.side_m)
    }

    /// Texel (column, row) of maps of `n` x `n` texels that stands for the corner. As in all maps, texel i stands for the
    /// coordinates i side / n plus any multiple of the side.
    pub fn corner_texel(&self, n: u32) -> [u32; 2] {
        self.corner_m.map(|x| (x / self.side_m * f64::from(n)).round().rem_euclid(f64::from(n)) as u32)
    }

    /// World position (x, z), m, in the square, of a texel (column, row) of maps of `n` x `n` texels.
    pub fn texel_position_m(&self, texel: [u32; 2], n: u32) -> [f64; 2] {
        let first = self.corner_texel(n);
        let steps = [0, 1].map(|axis| (texel[axis] + n - first[axis]) % n);
        [0, 1].map(|axis| self.corner_m[axis] + f64::from(steps[axis]) * self.side_m / f64::from(n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::incident::Placement;
    use crate::coast::transfer::LatticeKey;

    #[test]
    fn the_square_holds_a_turned_grid_and_keeps_its_texels_in_the_world() {
        for (turn_rad, n) in [(0.0, 64), (0.7, 128), (-2.0, 256)] {
            let placement = Placement { origin_m: [-5000.0, 321.0], turn_rad };
            let transfer = Transfer {
                placement,
                columns: 41,
                rows: 71,
                cell_m: 10.0,
                open_from_m: 0.0,
                lattice: LatticeKey::default(),
                waves: Vec::new(),
                groups: Vec::new(),
                envelopes: Vec::new(),
                points: Vec::new(),
            };
            let square = CoastSquare::around(&transfer, n);
            let margin = MARGIN_TEXELS / f64::from(n) - 0.51 / f64::from(n);
            for at in [[0.0, 0.0], [400.0, 0.0], [0.0, 700.0], [400.0, 700.0]] {
                let world = placement.world_m(at);
                assert!(square.uv(world).iter().all(|u| (margin..1.0 - margin).contains(u)), "{turn_rad}: {world:?}");
                let back = placement.in_frame_m(world);
                assert!((0..2).all(|axis| (back[axis] - at[axis]).abs() < 1e-9));
            }
            let texel_m = square.side_m / f64::from(n);
            let [x, z] = square.texel_position_m([3, 60], n);
            for (at, texel) in [(x, 3.0), (z, 60.0)] {
                let beyond = (at / texel_m - texel).rem_euclid(f64::from(n));
                assert!(beyond.min(f64::from(n) - beyond) < 1e-6, "{at} {texel}");
            }
        }
    }
}
