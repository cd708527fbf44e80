//! Tables that the passes of a coast read, from its transfer functions.

use super::square::CoastSquare;
use super::uniform::CoastUniform;
use crate::coast::Transfer;
use crate::coast::transfer::{LatticeKey, SeaAtPoint};
use crate::waves::Plan;
use half::f16;
use std::f64::consts::TAU;

/// Number of texels along a side of the map of gains.
pub const GAINS_MAP_SIDE: u32 = 256;

/// Key of the lattice of a sea's first cascade; None for a sea without cascades.
pub fn lattice_key(plan: &Plan) -> Option<LatticeKey> {
    let cascade = plan.cascades.first()?;
    Some(LatticeKey { patch_m: cascade.patch_m, noise_key: cascade.noise_key, seed: plan.sea.seed })
}

/// Largest number of groups: WebGPU's base limit of the layers of a texture.
const MAX_GROUPS: usize = 256;

/// Whether the parts of transfer functions have the lengths that belong together.
pub fn is_consistent(transfer: &Transfer) -> bool {
    let points = transfer.columns * transfer.rows;
    transfer.columns.min(transfer.rows) >= 2
        && transfer.points.len() == points
        && transfer.envelopes.len() == points * transfer.waves.len()
        && transfer.groups.len() <= MAX_GROUPS
        && transfer.groups.iter().all(|group| {
            group.column_phase_rad.len() == transfer.columns
                && group.first_wave + group.wave_count <= transfer.waves.len()
        })
}

/// The wave vectors of the waves: signed indices along x and z, as two 16-bit numbers. A wave that a lattice of `n` x `n`
/// waves does not hold becomes the wave of index 0, which has no amplitude.
pub fn packed_waves(transfer: &Transfer, n: u32) -> Vec<u32> {
    let half = n as i32 / 2;
    let pack = |[x, z]: [i32; 2]| {
        let is_held = x.abs() < half && z.abs() < half;
        if is_held { u32::from(x as i16 as u16) | u32::from(z as i16 as u16) << 16 } else { 0 }
    };
    transfer.waves.iter().map(|wave| pack(wave.lattice_index)).collect()
}

/// For each group its first wave, its number of waves, and the turns of its carrier per metre along y (bits of f32).
pub fn groups(transfer: &Transfer) -> Vec<[u32; 4]> {
    let group = |g: &crate::coast::transfer::WaveGroup| {
        [g.first_wave as u32, g.wave_count as u32, ((g.ky_rad_m / TAU) as f32).to_bits(), 0]
    };
    transfer.groups.iter().map(group).collect()
}

/// For each group and column the phase of the carrier in units of 2^-32 turns, and the turns to the next column (bits of
/// f32); behind the last column the carrier goes on as before it.
pub fn carriers(transfer: &Transfer) -> Vec<[u32; 2]> {
    let mut out = Vec::with_capacity(transfer.groups.len() * transfer.columns);
    for group in &transfer.groups {
        let turns: Vec<f64> = group.column_phase_rad.iter().map(|phase| phase / TAU).collect();
        for column in 0..transfer.columns {
            let from = column.min(transfer.columns - 2);
            let to_next = turns[from + 1] - turns[from];
            let fraction = (turns[column].rem_euclid(1.0) * 4_294_967_296.0).round() as u64 as u32;
            out.push([fraction, (to_next as f32).to_bits()]);
        }
    }
    out
}

/// Texels (row by row) of the map in the coast's frame: set-up, m, the reciprocal of the breaking height, 1/m, and the
/// depth, m.
pub fn point_texels(transfer: &Transfer) -> Vec<[f16; 4]> {
    let texel = |point: &SeaAtPoint| {
        let reciprocal = if point.breaking_height_m > 0.0 { 1.0 / point.breaking_height_m } else { 0.0 };
        // Heights below a millimetre only occur at the waterline.
        [point.set_up_m, reciprocal.min(1000.0), point.depth_m, 0.0].map(f16::from_f32)
    };
    transfer.points.iter().map(texel).collect()
}

/// Texels (row by row) of the map of gains over a square: factors of ordinary cascades, of offshore waves, and of the waves
/// at the coast, which are 0 outside the coast's grid; and the height above the still water that the waves run up, m.
pub fn gain_texels(transfer: &Transfer, square: &CoastSquare) -> Vec<[f16; 4]> {
    let side = GAINS_MAP_SIDE as usize;
    let texel = |i: usize| {
        let uv = [i % side, i / side].map(|index| (index as f64 + 0.5) / side as f64);
        let world = [0, 1].map(|axis| square.corner_m[axis] + uv[axis] * square.side_m);
        let grid = transfer.placement.in_frame_m(world).map(|x| x / transfer.cell_m);
        let last = [transfer.columns, transfer.rows].map(|count| (count - 1) as f64);
        let is_inside = (0..2).all(|axis| (0.0..=last[axis]).contains(&grid[axis]));
        let [short, weight, run_up_m] = interpolated(transfer, [0, 1].map(|axis| grid[axis].clamp(0.0, last[axis])));
        let at_coast = if is_inside { weight } else { 0.0 };
        [short, (1.0 - weight) * short, at_coast, run_up_m].map(|x| f16::from_f32(x as f32))
    };
    (0..side * side).map(texel).collect()
}

/// Short gain, weight and run-up between the points of the grid, at a position in cells.
fn interpolated(transfer: &Transfer, [x, y]: [f64; 2]) -> [f64; 3] {
    let [column, row] = [(x, transfer.columns), (y, transfer.rows)].map(|(at, count)| (at as usize).min(count - 2));
    let (fx, fy) = (x - column as f64, y - row as f64);
    let mut sum = [0.0; 3];
    for (dx, dy, share) in
        [(0, 0, (1.0 - fx) * (1.0 - fy)), (1, 0, fx * (1.0 - fy)), (0, 1, (1.0 - fx) * fy), (1, 1, fx * fy)]
    {
        let point = &transfer.points[(row + dy) * transfer.columns + column + dx];
        let values = [point.short_gain, point.weight, point.run_up_m()];
        sum = std::array::from_fn(|i| sum[i] + share * f64::from(values[i]));
    }
    sum
}

/// The uniform of the passes, for maps of `n` x `n` texels.
pub fn uniform(transfer: &Transfer, square: &CoastSquare, n: u32) -> CoastUniform {
    let (sin, cos) = transfer.placement.turn_rad.sin_cos();
    let corner = [0, 1].map(|axis| square.corner_m[axis] - transfer.placement.origin_m[axis]);
    CoastUniform {
        turn: [cos, sin].map(|x| x as f32),
        corner: corner.map(|x| x as f32),
        corner_texel: square.corner_texel(n),
        texel_m: (square.side_m / f64::from(n)) as f32,
        n,
        columns: transfer.columns as u32,
        rows: transfer.rows as u32,
        inverse_cell: (1.0 / transfer.cell_m) as f32,
        wave_count: transfer.waves.len() as u32,
        group_count: transfer.groups.len() as u32,
        unused: [0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The map of gains has the run-up of the drawn waves at each place, which a point says.
    #[test]
    fn the_map_of_gains_has_the_run_up() {
        // Set-up and deviation grow shoreward. The formula of Stockdon et al. 2006 with S = 4 deviations: 1.1 (0.4 + 0.6).
        let point = |column: usize| {
            let part = column as f32 / 4.0;
            SeaAtPoint { set_up_m: 0.4 * part, level_deviation_m: 0.3 * part, weight: 1.0, ..SeaAtPoint::default() }
        };
        let transfer = Transfer {
            columns: 5,
            rows: 5,
            cell_m: 20.0,
            points: (0..25).map(|i| point(i % 5)).collect(),
            ..Transfer::default()
        };
        assert!((transfer.points[4].run_up_m() - 1.1).abs() < 1e-6);
        let square = CoastSquare::around(&transfer, 64);
        let side = GAINS_MAP_SIDE as usize;
        for (i, texel) in gain_texels(&transfer, &square).iter().enumerate() {
            let x = square.corner_m[0]
                + (i % side) as f64 / side as f64 * square.side_m
                + 0.5 * square.side_m / side as f64;
            let want = 1.1 * (x / 80.0).clamp(0.0, 1.0);
            assert!((f64::from(texel[3]) - want).abs() < 1e-3, "{} at {x} m, not {want}", texel[3]);
        }
    }
}
