//! The sun in a picture of the sky: the brightest source, if it is compact and stands out.

use super::{direction, luminance, luminance64, solid_angle};
use std::f64::consts::PI;

/// Half the side of the piece of sky that the sun is looked for in once its place is known, rad.
const REACH: f64 = 6.0 * PI / 180.0;
/// What surrounds the sun is measured outside this angle from its middle, rad.
const AROUND: f64 = 4.0 * PI / 180.0;
/// The sun is at least so many times brighter than the sky around it.
const CONTRAST: f64 = 15.0;
/// Largest radius of a compact source, rad: some files show the sun bloomed.
const LARGEST: f64 = 3.0 * PI / 180.0;
/// Least share of the sky's own light, else it is a lamp or a reflection.
const LEAST_SHARE: f64 = 0.02;
/// Cells across a full turn in which the brightest place is looked for: a hot pixel alone is no sun.
const CELLS: usize = 512;

/// A sun in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Sun {
    /// Clockwise from the picture's middle, degrees.
    pub azimuth_deg: f64,
    /// Above the horizon, degrees.
    pub elevation_deg: f64,
    /// Radius of a disc of the same solid angle, rad.
    pub radius_rad: f64,
    /// On a plane that faces it, over the sky around it, in the file's unit.
    pub irradiance: [f64; 3],
}

/// The sun, and the pixels that show it with what the sky behind them would be.
pub(super) fn find(width: usize, height: usize, pixels: &[[f32; 3]]) -> Option<(Sun, Vec<(usize, [f32; 3])>)> {
    let middle = brightest(width, height, pixels)?;
    let near = within(middle, REACH, width, height);
    // The median of a ring is the sky behind the sun, whatever clouds or glare stand there.
    let mut ring: Vec<(f64, [f32; 3])> =
        near.iter().filter(|p| p.angle > AROUND).map(|p| (luminance(pixels[p.index]), pixels[p.index])).collect();
    if ring.is_empty() {
        return None;
    }
    ring.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (behind_lum, behind) = ring[ring.len() / 2];
    let peak = near.iter().map(|p| luminance(pixels[p.index])).fold(0.0, f64::max);
    if peak < CONTRAST * behind_lum.max(1e-12) {
        return None;
    }
    // What is far above the sky behind and not negligible beside the peak belongs to the sun, its own glare included.
    let cut = (4.0 * behind_lum).max(3e-3 * peak);
    let sun_pixels: Vec<&Near> = near.iter().filter(|p| p.angle < AROUND && luminance(pixels[p.index]) > cut).collect();
    let (mut irradiance, mut at, mut solid) = ([0.0; 3], [0.0; 3], 0.0);
    for p in &sun_pixels {
        let excess: [f64; 3] =
            std::array::from_fn(|i| (f64::from(pixels[p.index][i]) - f64::from(behind[i])).max(0.0) * p.solid);
        for i in 0..3 {
            irradiance[i] += excess[i];
            at[i] += luminance64(excess) * p.direction[i];
        }
        solid += if luminance(pixels[p.index]) > 0.3 * peak { p.solid } else { 0.0 };
    }
    let radius_rad = (solid / PI).sqrt();
    let sky: f64 = pixels
        .chunks(width)
        .take(height / 2)
        .enumerate()
        .map(|(y, row)| solid_angle(y, width, height) * row.iter().map(|p| luminance(*p)).sum::<f64>())
        .sum();
    if luminance64(irradiance) < LEAST_SHARE * sky || radius_rad > LARGEST {
        return None;
    }
    let sun = Sun {
        azimuth_deg: at[0].atan2(-at[2]).to_degrees().rem_euclid(360.0),
        elevation_deg: at[1].atan2(at[0].hypot(at[2])).to_degrees(),
        radius_rad,
        irradiance,
    };
    Some((sun, sun_pixels.iter().map(|p| (p.index, behind)).collect()))
}

/// Middle of the brightest cell above the horizon.
fn brightest(width: usize, height: usize, pixels: &[[f32; 3]]) -> Option<[f64; 3]> {
    let side = width.div_ceil(CELLS);
    let mut best = (0.0, [0, 0]);
    for y in (0..height / 2).step_by(side) {
        for x in (0..width).step_by(side) {
            let (x1, y1) = ((x + side).min(width), (y + side).min(height));
            let sum: f64 = (y..y1).flat_map(|v| &pixels[v * width + x..v * width + x1]).map(|p| luminance(*p)).sum();
            let mean = sum / ((x1 - x) * (y1 - y)) as f64;
            if mean > best.0 {
                best = (mean, [x, y]);
            }
        }
    }
    let half = 0.5 * side as f64;
    (best.0 > 0.0).then(|| direction(best.1[0] as f64 + half, best.1[1] as f64 + half, width, height))
}

/// A pixel near a place.
struct Near {
    index: usize,
    angle: f64,
    solid: f64,
    direction: [f64; 3],
}

/// The pixels within an angle of a direction, above the horizon.
fn within(middle: [f64; 3], reach: f64, width: usize, height: usize) -> Vec<Near> {
    let least = reach.cos();
    let mut out = Vec::new();
    for y in 0..height / 2 {
        let sine = direction(0.0, y as f64 + 0.5, width, height)[1];
        if (sine.asin() - middle[1].clamp(-1.0, 1.0).asin()).abs() > reach {
            continue;
        }
        for x in 0..width {
            let d = direction(x as f64 + 0.5, y as f64 + 0.5, width, height);
            let cosine = d[0] * middle[0] + d[1] * middle[1] + d[2] * middle[2];
            if cosine >= least {
                let (angle, solid) = (cosine.min(1.0).acos(), solid_angle(y, width, height));
                out.push(Near { index: y * width + x, angle, solid, direction: d });
            }
        }
    }
    out
}
