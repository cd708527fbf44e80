//! Tests of sky images, with synthetic skies whose sun is known.

use super::*;
use std::f64::consts::TAU;

/// Pixels of a sky that is brighter near the horizon, with a sun of the given azimuth and elevation (degrees), radius
/// (rad) and irradiance (red, green, blue).
fn sky(width: usize, azimuth: f64, elevation_deg: f64, radius: f64, irradiance: [f64; 3]) -> Vec<[f32; 3]> {
    let height = width / 2;
    let image = SkyImage { width, height, pixels: Vec::new() };
    let (a, e) = (azimuth.to_radians(), elevation_deg.to_radians());
    let to_sun = [a.sin() * e.cos(), e.sin(), -a.cos() * e.cos()];
    // A grid of points in each pixel gives the fraction of the pixel that the disc covers.
    const POINTS: usize = 8;
    let radiance = 1.0 / (TAU * (1.0 - radius.cos()));
    let pixel = |x: usize, y: usize| {
        let mut inside = 0;
        for i in 0..POINTS * POINTS {
            let at = [i % POINTS, i / POINTS].map(|k| (k as f64 + 0.5) / POINTS as f64);
            let d = image.pixel_direction(x as f64 + at[0], y as f64 + at[1]);
            let cosine = d.iter().zip(&to_sun).map(|(a, b)| a * b).sum::<f64>();
            inside += usize::from(cosine > radius.cos());
        }
        let share = inside as f64 / (POINTS * POINTS) as f64;
        let up = image.row_elevation_rad(y as f64 + 0.5).sin();
        let air = if up > 0.0 { [0.5 + 0.6 * (1.0 - up), 0.7 + 0.4 * (1.0 - up), 1.0] } else { [0.05, 0.08, 0.1] };
        std::array::from_fn(|i| (air[i] + share * radiance * irradiance[i]) as f32)
    };
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect()
}

#[test]
fn the_sun_is_found() {
    for (width, azimuth, elevation_deg, radius_deg) in
        [(512, 30.0, 40.0, 0.6), (1024, 359.9, 12.0, 0.27), (512, 200.0, 75.0, 1.5), (2048, 123.4, 3.0, 0.27)]
    {
        let irradiance = [9.0, 8.0, 6.5];
        let radius = f64::to_radians(radius_deg);
        let pixels = sky(width, azimuth, elevation_deg, radius, irradiance);
        let sky = Panorama::new(width, width / 2, pixels).unwrap();
        let sun = sky.sun.expect("a sun");
        let pixel = 360.0 / width as f64;
        let off = (sun.azimuth_deg - azimuth + 180.0).rem_euclid(360.0) - 180.0;
        assert!((off * elevation_deg.to_radians().cos()).abs() < 0.5 * pixel, "{width}: azimuth {}", sun.azimuth_deg);
        assert!((sun.elevation_deg - elevation_deg).abs() < 0.5 * pixel, "{width}: elevation {}", sun.elevation_deg);
        for (found, given) in sun.irradiance.iter().zip(irradiance) {
            let found = found / sky.gain;
            assert!((found / given - 1.0).abs() < 0.05, "{width}: irradiance {found} for {given}");
        }
        assert!((sun.radius_rad / radius - 1.0).abs() < 0.35, "{width}: radius {}", sun.radius_rad);
        // The sun was removed from the reflected environment, so nothing there is brighter than the sky.
        let brightest = sky.sunless.iter().map(|c| luminance(*c)).fold(0.0, f64::max);
        assert!(brightest / sky.gain < 1.3, "{width}: {}", brightest / sky.gain);
        let total = luminance(sky.irradiance) + luminance(sun.irradiance) * elevation_deg.to_radians().sin();
        assert!((total / NOON_IRRADIANCE - 1.0).abs() < 0.01, "lights like noon: {total}");
    }
}

#[test]
fn an_overcast_sky_has_no_sun() {
    // A glow ten times brighter than the sky and ten degrees wide, like the sun behind a thin cloud deck.
    let (width, height) = (512, 256);
    let glow = |x: usize, y: usize| {
        let (dx, dy) = (x as f64 - 200.0, y as f64 - 60.0);
        [(1.0 + 9.0 * (-(dx * dx + dy * dy) / 200.0).exp()) as f32; 3]
    };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| glow(x, y))).collect();
    let sky = Panorama::new(width, height, pixels).unwrap();
    assert_eq!(sky.sun, None);
    assert!((luminance(sky.irradiance) / NOON_IRRADIANCE - 1.0).abs() < 0.01);
}

#[test]
fn a_hot_pixel_is_no_sun_and_broken_ones_are_mended() {
    let (width, height) = (2048, 1024);
    let mut pixels = vec![[1f32; 3]; width * height];
    pixels[300 * width + 700] = [50.0; 3];
    pixels[10] = [f32::NAN, 1.0, 1.0];
    pixels[11] = [f32::INFINITY, 1.0, 1.0];
    pixels[12] = [-5.0, 1.0, 1.0];
    let sky = Panorama::new(width, height, pixels).unwrap();
    assert_eq!(sky.sun, None);
    assert!(sky.notices.iter().any(|n| n.starts_with("3 pixels")), "{:?}", sky.notices);
    assert!(sky.sunless.iter().flatten().all(|v| v.is_finite() && *v >= 0.0));
}

#[test]
fn vast_and_faint_light_stays_a_number() {
    let (width, height) = (64, 32);
    for (sky, ground) in [(1e-45, f32::MAX), (1e-45, 0.0), (f32::MAX, 1e-45), (1e-30, 1e30)] {
        let half = width * height / 2;
        let pixels = [vec![[sky; 3]; half], vec![[ground; 3]; half]].concat();
        let panorama = Panorama::new(width, height, pixels).unwrap();
        assert!(panorama.sunless.iter().flatten().all(|v| v.is_finite() && *v >= 0.0), "{sky} {ground}");
        assert!((luminance(panorama.irradiance) / NOON_IRRADIANCE - 1.0).abs() < 0.01, "{sky} {ground}");
    }
}

#[test]
fn what_is_no_sky_is_refused() {
    let grey = |w: usize, h: usize| Panorama::new(w, h, vec![[0.5; 3]; w * h]);
    assert!(grey(100, 100).unwrap_err().contains("twice as wide"));
    assert!(grey(8, 4).unwrap_err().contains("too few"));
    assert!(Panorama::new(64, 32, vec![[0.0; 3]; 64 * 32]).unwrap_err().contains("is black"));
    assert!(Panorama::new(64, 32, vec![[f32::NAN; 3]; 64 * 32]).unwrap_err().contains("is black"));
    assert!(Panorama::new(64, 32, vec![[1.0; 3]; 5]).is_err());
    let wide = grey(2 * MAX_WIDTH, 256);
    assert!(wide.unwrap_err().contains("twice as wide"));
}

#[test]
fn a_wide_picture_is_reduced() {
    let image = SkyImage { width: 6, height: 4, pixels: (0..24).map(|i| [i as f32; 3]).collect() }.downsampled(2);
    assert_eq!((image.width, image.height), (3, 2));
    assert_eq!(image.pixels[0], [3.5; 3], "mean of 0, 1, 6, 7");
    let mips = mips(SkyImage { width: 8, height: 4, pixels: vec![[1.0, 0.5, 0.25]; 32] });
    assert_eq!(mips.iter().map(Vec::len).collect::<Vec<_>>(), [32, 8, 2]);
    assert!(mips.iter().flatten().all(|v| *v == mips[0][0]));
}

#[cfg(feature = "desktop")]
mod files {
    use super::*;
    use image::{ImageFormat, Rgb, Rgb32FImage};

    fn file(format: ImageFormat, width: usize, pixels: &[[f32; 3]]) -> Vec<u8> {
        let mut image = Rgb32FImage::new(width as u32, (pixels.len() / width) as u32);
        image.pixels_mut().zip(pixels).for_each(|(to, from)| *to = Rgb(*from));
        let mut bytes = std::io::Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).expect("encoded");
        bytes.into_inner()
    }

    #[test]
    fn both_formats_are_read() {
        let pixels = sky(256, 77.0, 30.0, 0.02, [8.0; 3]);
        for format in [ImageFormat::Hdr, ImageFormat::OpenExr] {
            let bytes = file(format, 256, &pixels);
            assert!(is_sky_file("anything", &bytes));
            let sky = read("a.hdr", &bytes).unwrap();
            assert_eq!((sky.width, sky.height), (256, 128));
            let sun = sky.sun.expect("a sun");
            assert!((sun.azimuth_deg - 77.0).abs() < 0.7 && (sun.elevation_deg - 30.0).abs() < 0.7, "{sun:?}");
        }
    }

    #[test]
    fn bad_files_are_refused_by_name() {
        let whole = file(ImageFormat::Hdr, 64, &[[1.0; 3]; 64 * 32]);
        let exr = file(ImageFormat::OpenExr, 64, &[[1.0; 3]; 64 * 32]);
        let enormous = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000 +X 2000000\n".to_vec();
        let none = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n".to_vec();
        let cases: Vec<Vec<u8>> = vec![
            vec![],
            b"not a picture".to_vec(),
            whole[..whole.len() / 2].to_vec(),
            whole[..20].to_vec(),
            exr[..exr.len() / 2].to_vec(),
            exr[..6].to_vec(),
            enormous,
            none,
        ];
        for bytes in cases {
            let reason = read("bad.hdr", &bytes).unwrap_err();
            assert!(reason.starts_with("bad.hdr: ") && reason.len() > 12 && !reason.contains('\n'), "{reason}");
        }
        // Reading a file with a wrong byte does not panic.
        for i in (0..whole.len()).step_by(7) {
            let mut bytes = whole.clone();
            bytes[i] ^= 0x55;
            let _ = read("odd.hdr", &bytes);
        }
        for i in (0..exr.len()).step_by(41) {
            let mut bytes = exr.clone();
            bytes[i] ^= 0x55;
            let _ = read("odd.exr", &bytes);
        }
    }
}
