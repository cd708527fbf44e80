//! The sun in an image of the sky: the brightest source, if it is compact and much brighter than the sky around it.

use super::sky_image::{SkyImage, luminance};
use std::f64::consts::PI;

/// Angular radius around the brightest search cell (block of pixels) within which the sun is looked for, rad.
const SUN_SEARCH_RADIUS_RAD: f64 = 6.0 * PI / 180.0;
/// Inner radius, rad, of the ring that gives the colour of the sky around the sun; the outer one is
/// [`SUN_SEARCH_RADIUS_RAD`].
const SKY_RING_INNER_RADIUS_RAD: f64 = 4.0 * PI / 180.0;
/// A bright spot can be the sun only if the luminance of its brightest pixel is at least this multiple of that of the
/// sky around it.
const MIN_SUN_CONTRAST: f64 = 15.0;
/// Largest angular radius of a bright spot that is taken as the sun, rad. Bloom enlarges the sun in some files.
const MAX_SUN_RADIUS_RAD: f64 = 3.0 * PI / 180.0;
/// Smallest ratio of the sun's light (luminance x solid angle) to that of the whole sky, sun included; a bright spot
/// with less is a lamp or a reflection.
const MIN_SUN_LIGHT_RATIO: f64 = 0.02;
/// Largest number of search cells (blocks of pixels) across 360 degrees of azimuth. The sun is looked for around the
/// brightest cell, not the brightest pixel, because single pixels can be faulty.
const SUN_SEARCH_CELLS_PER_TURN: usize = 512;

/// Direction, size and irradiance of the sun that was found in an image of the sky.
#[derive(Clone, Debug, PartialEq)]
pub struct Sun {
    /// Azimuth of the sun's centre, degrees clockwise from the middle column of the image, 0 to 360.
    pub azimuth_deg: f64,
    /// Elevation of the sun's centre above the horizon, degrees.
    pub elevation_deg: f64,
    /// Angular radius, rad, of a disc with the solid angle of the sun's pixels above 0.3 of its peak luminance.
    pub radius_rad: f64,
    /// Irradiance (red, green, blue) by the sun alone of a plane that faces it, in the unit of the image x sr; in a
    /// [`Panorama`](super::Panorama), 1 is 6400 lux.
    pub irradiance: [f64; 3],
}

/// Finds the sun in the image and sets its pixels to the colour of the sky around it. If no sun is found, returns None
/// and leaves the image as it is.
pub(super) fn extract_sun(image: &mut SkyImage) -> Option<Sun> {
    let near = pixels_within_angle(SUN_SEARCH_RADIUS_RAD, brightest_direction(image)?, image);
    // The median pixel of the ring stands for the sky behind the sun, despite clouds and glare.
    let mut ring: Vec<&NearPixel> = near.iter().filter(|p| p.angle > SKY_RING_INNER_RADIUS_RAD).collect();
    ring.sort_by(|a, b| a.luminance.total_cmp(&b.luminance));
    let behind = ring.get(ring.len() / 2)?;
    let sky = image.pixels[behind.index];
    let peak = near.iter().map(|p| p.luminance).fold(0.0, f64::max);
    if peak < MIN_SUN_CONTRAST * behind.luminance.max(1e-12) {
        return None;
    }
    // Glare much brighter than the sky behind it, and not negligible beside the sun's peak, belongs to the sun.
    let cut = (4.0 * behind.luminance).max(3e-3 * peak);
    let sun_pixels: Vec<&NearPixel> =
        near.iter().filter(|p| p.angle < SKY_RING_INNER_RADIUS_RAD && p.luminance > cut).collect();
    let (mut irradiance, mut at, mut solid_angle) = ([0.0; 3], [0.0; 3], 0.0);
    for p in &sun_pixels {
        let colour = image.pixels[p.index];
        let excess: [f64; 3] =
            std::array::from_fn(|i| (f64::from(colour[i]) - f64::from(sky[i])).max(0.0) * p.solid_angle);
        for i in 0..3 {
            irradiance[i] += excess[i];
            at[i] += luminance(excess) * p.direction[i];
        }
        solid_angle += if p.luminance > 0.3 * peak { p.solid_angle } else { 0.0 };
    }
    let radius_rad = (solid_angle / PI).sqrt();
    let rows = image.pixels.chunks(image.width).take(image.height / 2).enumerate();
    let light =
        |(y, row): (usize, &[[f32; 3]])| image.pixel_solid_angle_sr(y) * row.iter().map(|p| luminance(*p)).sum::<f64>();
    let sky_light: f64 = rows.map(light).sum();
    if luminance(irradiance) < MIN_SUN_LIGHT_RATIO * sky_light || radius_rad > MAX_SUN_RADIUS_RAD {
        return None;
    }
    for p in &sun_pixels {
        image.pixels[p.index] = sky;
    }
    Some(Sun {
        azimuth_deg: at[0].atan2(-at[2]).to_degrees().rem_euclid(360.0),
        elevation_deg: at[1].atan2(at[0].hypot(at[2])).to_degrees(),
        radius_rad,
        irradiance,
    })
}

/// Unit vector (east, up, south) to the search cell (block of pixels) above the horizon with the largest mean
/// luminance; None if the sky is black.
fn brightest_direction(image: &SkyImage) -> Option<[f64; 3]> {
    let SkyImage { width, height, ref pixels } = *image;
    let side = width.div_ceil(SUN_SEARCH_CELLS_PER_TURN);
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
    let [x, y] = best.1.map(|corner| corner as f64 + 0.5 * side as f64);
    (best.0 > 0.0).then(|| image.pixel_direction(x, y))
}

/// A pixel near the brightest search cell (block of pixels) of the sky, which is examined for the sun.
struct NearPixel {
    index: usize,
    luminance: f64,
    /// Angle between the pixel and the middle of the brightest search cell, rad.
    angle: f64,
    /// Solid angle of the pixel, sr.
    solid_angle: f64,
    direction: [f64; 3],
}

/// Pixels above the horizon within the angle `reach` (rad) of the direction `middle`.
fn pixels_within_angle(reach: f64, middle: [f64; 3], image: &SkyImage) -> Vec<NearPixel> {
    let least = reach.cos();
    let mut out = Vec::new();
    for y in 0..image.height / 2 {
        let sine = image.pixel_direction(0.0, y as f64 + 0.5)[1];
        if (sine.asin() - middle[1].clamp(-1.0, 1.0).asin()).abs() > reach {
            continue;
        }
        for x in 0..image.width {
            let direction = image.pixel_direction(x as f64 + 0.5, y as f64 + 0.5);
            let cosine = direction[0] * middle[0] + direction[1] * middle[1] + direction[2] * middle[2];
            if cosine >= least {
                let (index, angle) = (y * image.width + x, cosine.min(1.0).acos());
                let (luminance, solid_angle) = (luminance(image.pixels[index]), image.pixel_solid_angle_sr(y));
                out.push(NearPixel { index, luminance, angle, solid_angle, direction });
            }
        }
    }
    out
}
