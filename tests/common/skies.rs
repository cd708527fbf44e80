//! Synthetic skies for tests.

use seastate::files::panorama::Panorama;
use seastate::state::look::SkyFile;
use std::sync::Arc;

/// A sky that is blue above and white at the horizon, with its sun at an elevation of 30 degrees and the given azimuth.
pub fn made_up_sky(sun_azimuth_deg: f64) -> SkyFile {
    let (width, height) = (512, 256);
    let (a, e) = (sun_azimuth_deg.to_radians(), 30f64.to_radians());
    let pixel = |x: usize, y: usize| {
        let azimuth = ((x as f64 + 0.5) / width as f64 - 0.5) * std::f64::consts::TAU;
        let elevation = (0.5 - (y as f64 + 0.5) / height as f64) * std::f64::consts::PI;
        let cosine = e.sin() * elevation.sin() + e.cos() * elevation.cos() * (azimuth - a).cos();
        if cosine > 0.012f64.cos() {
            return [9e3, 8.5e3, 8e3];
        }
        let up = elevation.sin().max(0.0) as f32;
        if elevation > 0.0 { [0.9 - 0.7 * up, 0.9 - 0.5 * up, 1.0] } else { [0.1; 3] }
    };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| pixel(x, y))).collect();
    let image = Panorama::new(width, height, pixels).expect("a sky");
    SkyFile { image: Some(Arc::new(image)), ..SkyFile::from_path("made-up.hdr").expect("a name") }
}
