//! A sky from an equirectangular picture in linear light: made safe, its sun found and taken out of what the sea mirrors.
//!
//! Columns go around clockwise from the south of the file's own north, its middle; rows go down from the zenith.

#[cfg(feature = "files")]
mod hdr;
#[cfg(feature = "files")]
mod openexr;
mod pack;
#[cfg(feature = "files")]
mod read;
mod sun;
#[cfg(test)]
mod tests;

#[cfg(feature = "files")]
pub use read::{MAX_BYTES, is_sky, read, read_within};
pub use sun::Sun;

use std::f64::consts::{PI, TAU};

/// Widest picture that is kept; wider ones are reduced by a whole number.
pub const MAX_WIDTH: usize = 8192;
/// Narrowest picture that shows a sky.
pub const MIN_WIDTH: usize = 16;
/// Size of the copy without the sun that the mirrored environment is made from.
pub const CALM: [usize; 2] = [512, 256];
/// What the horizontal irradiance of any file is taken to be: that of a clear noon, in the scale of `atmosphere.wgsl`.
const NOON: f64 = 16.0;

/// A sky from a file.
#[derive(Clone, Debug)]
pub struct Panorama {
    /// Columns of the picture.
    pub width: usize,
    /// Rows of the picture.
    pub height: usize,
    /// Linear sRGB as RGB9E5, row by row from the zenith, and its mips, each half the size of the one before, rounded down.
    pub mips: Vec<Vec<u32>>,
    /// [`CALM`] pixels of linear sRGB without the sun.
    pub calm: Vec<[f32; 3]>,
    /// The sun, if the picture shows a compact one.
    pub sun: Option<Sun>,
    /// Irradiance of the rest of the sky on the horizontal.
    pub irradiance: [f64; 3],
    /// What one unit of the file was multiplied by: light is in the scale of `atmosphere.wgsl`.
    pub gain: f64,
    /// What was not taken as it stood.
    pub notices: Vec<String>,
}

impl Panorama {
    /// A sky from the pixels of an equirectangular picture.
    ///
    /// # Errors
    /// One sentence, when this is no picture of a sky.
    pub fn new(width: usize, height: usize, pixels: Vec<[f32; 3]>) -> Result<Self, String> {
        Self::check_shape(width, height)?;
        if pixels.len() != width * height {
            return Err(format!("{} pixels are no picture of {width} x {height}", pixels.len()));
        }
        let mut notices = Vec::new();
        let mut pixels = pixels;
        let broken = sanitise(&mut pixels);
        if broken > 0 {
            notices.push(format!("{broken} pixels were not finite or negative: mended"));
        }
        let by = width.div_ceil(MAX_WIDTH);
        let (width, height, mut pixels) =
            if by > 1 { reduce(width, height, &pixels, by) } else { (width, height, pixels) };
        if by > 1 {
            notices.push(format!("reduced to {width} x {height}"));
        }
        let found = sun::find(width, height, &pixels);
        let mut sunless = pixels.clone();
        if let Some((_, removed)) = &found {
            for &(i, behind) in removed {
                sunless[i] = behind;
            }
        }
        let irradiance = horizontal(width, height, &sunless);
        let sun = found.map(|(sun, _)| sun);
        let whole = luminance64(irradiance)
            + sun.as_ref().map_or(0.0, |s| luminance64(s.irradiance) * s.elevation_deg.to_radians().sin().max(0.0));
        if whole <= 0.0 {
            return Err("its upper half, the sky, is black: is it upside down?".to_owned());
        }
        if sun.is_none() {
            notices.push("no compact sun: the sky alone lights the sea".to_owned());
        }
        let gain = NOON / whole;
        // What is vast beside the light of the sky, below the horizon say, stays a number.
        let scaled = |v: f32| (f64::from(v) * gain).min(f64::from(pack::MOST)) as f32;
        let scale = |pixels: &mut Vec<[f32; 3]>| pixels.iter_mut().flatten().for_each(|v| *v = scaled(*v));
        let mut calm = resample(width, height, &sunless, CALM);
        scale(&mut calm);
        drop(sunless);
        scale(&mut pixels);
        let sun = sun.map(|s| Sun { irradiance: s.irradiance.map(|e| e * gain), ..s });
        let irradiance = irradiance.map(|e| e * gain);
        Ok(Self { width, height, mips: mips(width, height, pixels), calm, sun, irradiance, gain, notices })
    }

    /// Refuses what cannot be the picture of a whole sky.
    fn check_shape(width: usize, height: usize) -> Result<(), String> {
        if height < MIN_WIDTH / 2 {
            return Err(format!("{width} x {height} pixels are too few for a sky"));
        }
        // A row more or less is no reason to refuse.
        if (width as f64 / height as f64 - 2.0).abs() > 0.1 {
            return Err(format!("{width} x {height}: a sky all around (equirectangular) is twice as wide as high"));
        }
        Ok(())
    }
}

/// Mends what is not light: not-a-number and negative become 0, infinite the brightest finite value. Returns how many.
fn sanitise(pixels: &mut [[f32; 3]]) -> usize {
    let most = pixels.iter().flatten().copied().filter(|v| v.is_finite()).fold(0f32, f32::max).min(1e30);
    let mut broken = 0;
    for pixel in pixels {
        let before = *pixel;
        for v in pixel.iter_mut() {
            // Also turns -0 into 0; f32::max ignores what is not a number.
            *v = v.max(0.0).min(most);
        }
        let off = |(a, b): (&f32, &f32)| a.is_nan() || (*a < 0.0) || (*a > *b);
        broken += usize::from(before.iter().zip(pixel.iter()).any(off));
    }
    broken
}

/// Means over squares of `by` pixels; a remainder at the right and the bottom is left out.
fn reduce(width: usize, height: usize, pixels: &[[f32; 3]], by: usize) -> (usize, usize, Vec<[f32; 3]>) {
    let (w, h) = (width / by, height / by);
    let mean = |x: usize, y: usize| {
        let mut sum = [0f64; 3];
        for row in pixels.chunks(width).skip(y * by).take(by) {
            for pixel in &row[x * by..(x + 1) * by] {
                sum.iter_mut().zip(pixel).for_each(|(s, v)| *s += f64::from(*v));
            }
        }
        sum.map(|s| (s / (by * by) as f64) as f32)
    };
    (w, h, (0..h).flat_map(|y| (0..w).map(move |x| mean(x, y))).collect())
}

/// Another size: means over the pixels that a new one covers, the nearest where it covers none.
fn resample(width: usize, height: usize, pixels: &[[f32; 3]], [w, h]: [usize; 2]) -> Vec<[f32; 3]> {
    let range = |i: usize, to: usize, from: usize| {
        let start = i * from / to;
        start..((i + 1) * from / to).max(start + 1)
    };
    let mean = |x: usize, y: usize| {
        let mut sum = [0f64; 3];
        let (columns, rows) = (range(x, w, width), range(y, h, height));
        let count = columns.len() * rows.len();
        for row in rows {
            for pixel in &pixels[row * width..][columns.clone()] {
                sum.iter_mut().zip(pixel).for_each(|(s, v)| *s += f64::from(*v));
            }
        }
        sum.map(|s| (s / count as f64) as f32)
    };
    (0..h).flat_map(|y| (0..w).map(move |x| mean(x, y))).collect()
}

/// All mips down to one row, packed.
fn mips(width: usize, height: usize, pixels: Vec<[f32; 3]>) -> Vec<Vec<u32>> {
    let (mut size, mut level, mut out) = ([width, height], pixels, Vec::new());
    loop {
        out.push(level.iter().map(|c| pack::rgb9e5(*c)).collect());
        if size[1] == 1 {
            return out;
        }
        let next = size.map(|s| (s / 2).max(1));
        level = resample(size[0], size[1], &level, next);
        size = next;
    }
}

/// Irradiance of the upper half on the horizontal.
fn horizontal(width: usize, height: usize, pixels: &[[f32; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (y, row) in pixels.chunks(width).enumerate() {
        let weight = elevation(y as f64 + 0.5, height).sin() * solid_angle(y, width, height);
        if weight <= 0.0 {
            break;
        }
        for pixel in row {
            sum.iter_mut().zip(pixel).for_each(|(s, v)| *s += weight * f64::from(*v));
        }
    }
    sum
}

/// Elevation at a height in the picture, rad; rows are counted down from the top edge.
fn elevation(y: f64, height: usize) -> f64 {
    PI * (0.5 - y / height as f64)
}

/// Solid angle of a pixel, sr.
fn solid_angle(y: usize, width: usize, height: usize) -> f64 {
    (elevation(y as f64, height).sin() - elevation(y as f64 + 1.0, height).sin()) * TAU / width as f64
}

/// Unit vector (east, up, south) of a point of the picture; the middle looks north.
fn direction(x: f64, y: f64, width: usize, height: usize) -> [f64; 3] {
    let (sin_a, cos_a) = (TAU * (x / width as f64 - 0.5)).sin_cos();
    let (sin_e, cos_e) = elevation(y, height).sin_cos();
    [sin_a * cos_e, sin_e, -cos_a * cos_e]
}

fn luminance64(c: [f64; 3]) -> f64 {
    0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]
}

fn luminance(c: [f32; 3]) -> f64 {
    luminance64(c.map(f64::from))
}
