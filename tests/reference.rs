//! The picture against its reference: many unfiltered samples a pixel, averaged in linear light. What takes minutes is
//! marked `ignore` and run by `cargo test --test reference -- --ignored --nocapture`; pictures go to
//! target/tmp/reference.

mod common;

use common::{gpu, params, random_params};
use seastate::gpu::Gpu;
use seastate::lab::flip::{PIXELS_PER_DEGREE, SrgbPicture, flip_errors, mean_error};
use seastate::lab::reference::{self, SamplingSettings};
use seastate::ocean::still::{PICTURE_FORMAT, draw_ocean_picture};
use seastate::ocean::{Ocean, OutputKind};
use seastate::state::{Params, query};
use seastate::waves::Plan;
use std::path::PathBuf;

/// A sea and the pictures of it, one sample a pixel as a page draws them, and the reference.
struct Viewer {
    gpu: Gpu,
    ocean: Ocean,
    size: [u32; 2],
}

impl Viewer {
    fn new(size: [u32; 2], p: &Params) -> Self {
        let gpu = gpu();
        let ocean = Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, p);
        Self { gpu, ocean, size }
    }

    fn set_named_view(&mut self, p: &Params) {
        self.ocean.set_params(p);
    }

    fn normal(&mut self) -> SrgbPicture {
        let bytes = pollster::block_on(draw_ocean_picture(&self.gpu, &mut self.ocean, self.size)).expect("a picture");
        SrgbPicture::from_rgba(self.size[0], &bytes)
    }

    /// The light of the reference of the normal picture that was drawn last.
    fn light(&mut self, samples: u32, seed: u32) -> Vec<[f32; 3]> {
        let made = reference::reference_light(
            &self.gpu,
            &mut self.ocean,
            self.size,
            SamplingSettings { min_samples_per_pixel: samples, seed },
        );
        pollster::block_on(made).expect("a reference")
    }

    fn displayed(&mut self, light: &[[f32; 3]]) -> SrgbPicture {
        let made = reference::expose_light(&self.gpu, &mut self.ocean, self.size, light);
        SrgbPicture::from_rgba(self.size[0], &pollster::block_on(made).expect("a picture"))
    }

    fn reference(&mut self, samples: u32, seed: u32) -> SrgbPicture {
        let light = self.light(samples, seed);
        self.displayed(&light)
    }

    /// Two references of independent samples and of as many as it takes for them to agree, and their mean.
    fn agreed(&mut self) -> Agreed {
        let mean = |a: &[[f32; 3]], b: &[[f32; 3]]| -> Vec<[f32; 3]> {
            a.iter().zip(b).map(|(a, b)| std::array::from_fn(|i| 0.5 * (a[i] + b[i]))).collect()
        };
        let (mut samples, mut a, mut b) = (256, self.light(256, 1), self.light(256, 2));
        loop {
            let noise = flip(&self.displayed(&a), &self.displayed(&b));
            if noise <= NOISE || samples >= 2048 {
                return Agreed { samples, noise, picture: self.displayed(&mean(&a, &b)) };
            }
            (a, b) = (mean(&a, &self.light(samples, samples + 1)), mean(&b, &self.light(samples, samples + 2)));
            samples *= 2;
        }
    }
}

/// Mean FLIP between references of different samples that is small enough.
const NOISE: f64 = 0.02;

struct Agreed {
    /// Of each of the two, a pixel.
    samples: u32,
    /// Mean FLIP between the two.
    noise: f64,
    /// Of the samples of both.
    picture: SrgbPicture,
}

fn flip(reference: &SrgbPicture, test: &SrgbPicture) -> f64 {
    mean_error(&flip_errors(reference, test, PIXELS_PER_DEGREE).expect("one size"))
}

fn magenta(picture: &SrgbPicture) -> usize {
    picture.pixels.iter().filter(|p| p[0] > 250 && p[1] < 5 && p[2] > 250).count()
}

/// Encoded luma, 0 to 1.
fn luma(p: [u8; 3]) -> f64 {
    (0.2126 * f64::from(p[0]) + 0.7152 * f64::from(p[1]) + 0.0722 * f64::from(p[2])) / 255.0
}

/// First row below the horizon of a camera that is not rolled.
fn horizon_row(p: &Params, height: u32) -> usize {
    let dip = (2.0 * p.camera.y_m / 6_371_000.0).sqrt();
    let down = (p.camera.pitch_deg.to_radians() + dip).tan() / (0.5 * p.camera.fov_deg.to_radians()).tan();
    ((0.5 + 0.5 * down) * f64::from(height)).ceil() as usize
}

/// Side by side: reference, picture, difference.
fn write(name: &str, reference: &SrgbPicture, test: &SrgbPicture) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("reference");
    std::fs::create_dir_all(&folder).expect("a folder");
    let grey = flip_errors(reference, test, PIXELS_PER_DEGREE).expect("one size");
    let (w, h) = (test.width, test.height);
    let image = image::RgbImage::from_fn(3 * w as u32, h as u32, |x, y| {
        let (panel, at) = (x as usize / w, y as usize * w + x as usize % w);
        image::Rgb(match panel {
            0 => reference.pixels[at],
            1 => test.pixels[at],
            _ => [(255.0 * grey[at]).round() as u8; 3],
        })
    });
    image.save(folder.join(format!("{name}.png"))).expect("a picture is written");
}

/// The sky is not filtered, so picture and reference agree in it to a level or two: the same exposure and film. The
/// water is what differs, by less than two unlike pictures do.
#[test]
fn a_reference_is_the_picture_without_filtering() {
    let p = params("wind=10&n=64&t=20&sun=30&sunaz=90&heading=40&y=20");
    let mut viewer = Viewer::new([64, 40], &p);
    let normal = viewer.normal();
    let (a, b) = (viewer.reference(64, 1), viewer.reference(64, 2));
    assert_eq!((magenta(&normal), magenta(&a)), (0, 0));
    let sky = 64 * (horizon_row(&p, 40) - 2);
    for (n, r) in normal.pixels[..sky].iter().zip(&a.pixels) {
        assert!((0..3).all(|i| n[i].abs_diff(r[i]) <= 3), "{n:?} and {r:?}");
    }
    viewer.set_named_view(&params("wind=10&n=64&t=23&sun=30&sunaz=90&heading=40&y=20"));
    let (same, right, later) = (flip(&a, &b), flip(&a, &normal), flip(&a, &viewer.normal()));
    eprintln!(
        "mean FLIP of two references {same:.4}, of the picture {right:.4}, of one three seconds later {later:.4}"
    );
    assert!(a != b && same < 0.05, "{same}");
    assert!(same < right && right < later, "{same} {right} {later}");
}

const WEATHERS: [(&str, &str); 3] = [("calm", "wind=2"), ("breeze", "wind=10"), ("storm", "wind=25&fetch=500")];

#[test]
#[ignore = "takes minutes on a software GPU"]
fn the_picture_is_near_its_reference() {
    let head = "weather    eye  sun    samples      noise    picture\n";
    let (mut table, mut noisy, mut far) = (head.to_owned(), 0, 0);
    eprint!("{head}");
    for (weather, sea) in WEATHERS {
        let mut viewer: Option<Viewer> = None;
        for y in [2, 20, 200] {
            // To the side when high, in the picture when low.
            for (sun, azimuth) in [(50, 75), (8, 55)] {
                let pitch = if y == 200 { -12 } else { -4 };
                let p = params(&format!("{sea}&n=128&t=20&y={y}&pitch={pitch}&sun={sun}&sunaz={azimuth}"));
                let viewer = viewer.get_or_insert_with(|| Viewer::new([192, 108], &p));
                viewer.set_named_view(&p);
                let normal = viewer.normal();
                let Agreed { samples, noise, picture } = viewer.agreed();
                let right = flip(&picture, &normal);
                let line = format!("{weather:<8} {y:>5} {sun:>4} {samples:>10} {noise:>10.4} {right:>10.4}\n");
                eprint!("{line}");
                table += &line;
                noisy += usize::from(noise > NOISE);
                far += usize::from(right > 0.05);
                write(&format!("{weather}-eye{y}-sun{sun}"), &picture, &normal);
            }
        }
    }
    assert_eq!((noisy, far), (0, 0), "references that are noisy, and pictures that are far from theirs:\n{table}");
}

/// Names of the states whose references are noisy, or whose pictures are far from theirs. Pictures of a state are written
/// under `prefix` and its name.
fn far_from_their_references(prefix: &str, states: &[(&str, &str)]) -> Vec<String> {
    let mut far = Vec::new();
    for (name, state) in states {
        let p = params(&format!("{state}&n=128&t=20"));
        let mut viewer = Viewer::new([192, 108], &p);
        let normal = viewer.normal();
        let Agreed { noise, picture, .. } = viewer.agreed();
        let right = flip(&picture, &normal);
        eprintln!("{name:<14} noise {noise:.4}, picture {right:.4}");
        write(&format!("{prefix}-{name}"), &picture, &normal);
        if noise > NOISE || right > 0.08 {
            far.push((*name).to_owned());
        }
    }
    far
}

/// Clouds, their shadows on the sea, gusts, and glints, whose mean the reference shows.
#[test]
#[ignore = "takes minutes on a software GPU"]
fn the_picture_with_clouds_is_near_its_reference() {
    let far = far_from_their_references(
        "clouds",
        &[
            ("stratocumulus", "wind=10&clouds=stratocumulus&cloudcover=0.6&sun=8&sunaz=55&y=2&pitch=-4"),
            ("cumulus", "wind=10&clouds=cumulus&sun=50&sunaz=75&y=200&pitch=-12"),
            ("storm", "wind=25&fetch=500&clouds=storm&cloudcover=0.9&sun=30&sunaz=45&y=5&pitch=-2"),
            ("towering", "wind=8&gusts=1&clouds=towering&sun=20&sunaz=90&y=20&pitch=-6"),
            ("glints", "wind=10&glints=1&sun=25&sunaz=45&y=5&pitch=-4"),
        ],
    );
    assert_eq!(far, Vec::<String>::new(), "noisy references, or pictures that are far from theirs");
}

/// The eye under water: Snell's window with the mirror around it, a bed with caustics, and a lens that the water's
/// surface crosses.
#[test]
#[ignore = "takes minutes on a software GPU"]
fn the_picture_under_water_is_near_its_reference() {
    let far = far_from_their_references(
        "under-water",
        &[
            ("window", "wind=5&fetch=25&sun=42&sunaz=40&dive=6&pitch=38&fov=85"),
            ("bed", "wind=4&fetch=8&depth=6&sun=52&sunaz=70&bedcover=0.4&caustics=1&dive=2&pitch=-10"),
            ("waterline", "wind=3&fetch=10&depth=3&sun=38&sunaz=56&dive=0.03&heading=110&fov=75"),
        ],
    );
    assert_eq!(far, Vec::<String>::new(), "noisy references, or pictures that are far from theirs");
}

/// Over a second, the luma of the far half of the water varies about as much as that of the reference does.
#[test]
#[ignore = "takes minutes on a software GPU"]
fn the_picture_flickers_no_more_than_its_reference() {
    const FRAMES: u32 = 60;
    const SIZE: [u32; 2] = [96, 54];
    let mut table =
        format!("{:<8} {:>5} {:>4} {:>12} {:>12} {:>7}\n", "weather", "eye", "sun", "reference", "picture", "ratio");
    let mut worse = 0;
    for (weather, sea, y, sun, azimuth) in [
        ("breeze", "wind=10", 2, 50, 75),
        ("breeze", "wind=10", 20, 8, 55),
        ("storm", "wind=25&fetch=500", 20, 50, 75),
        ("calm", "wind=2", 20, 8, 55),
    ] {
        let at = |i: u32| {
            let t = 20.0 + f64::from(i) / 60.0;
            params(&format!("{sea}&n=128&t={t}&y={y}&sun={sun}&sunaz={azimuth}"))
        };
        let mut viewer = Viewer::new(SIZE, &at(0));
        let first = horizon_row(&at(0), SIZE[1]);
        let rows = first..first + (SIZE[1] as usize - first) / 2;
        let pixels = rows.start * SIZE[0] as usize..rows.end * SIZE[0] as usize;
        let mut films: [Vec<Vec<f64>>; 3] = Default::default();
        for i in 0..FRAMES {
            viewer.set_named_view(&at(i));
            let pictures = [viewer.normal(), viewer.reference(64, 1 + 2 * i), viewer.reference(64, 2 + 2 * i)];
            for (film, picture) in films.iter_mut().zip(&pictures) {
                film.push(picture.pixels[pixels.clone()].iter().map(|&p| luma(p)).collect());
            }
        }
        // The noise of two references is independent: what they have in common is the sea.
        let (sea_itself, picture) = (covariance(&films[1], &films[2]), covariance(&films[0], &films[0]));
        let ratio = picture / sea_itself;
        let line = format!("{weather:<8} {y:>5} {sun:>4} {sea_itself:>12.3e} {picture:>12.3e} {ratio:>7.3}\n");
        eprint!("{line}");
        table += &line;
        worse += usize::from(ratio > 1.5);
    }
    assert_eq!(worse, 0, "pictures that flicker more than 1.5 times as much as the sea does:\n{table}");
}

/// Mean over the pixels of the covariance in time of two films.
fn covariance(a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    let (frames, pixels) = (a.len() as f64, a[0].len());
    let mean = |film: &[Vec<f64>], i: usize| film.iter().map(|f| f[i]).sum::<f64>() / frames;
    let of = |i: usize| {
        let (ma, mb) = (mean(a, i), mean(b, i));
        a.iter().zip(b).map(|(x, y)| (x[i] - ma) * (y[i] - mb)).sum::<f64>() / (frames - 1.0)
    };
    (0..pixels).map(of).sum::<f64>() / pixels as f64
}

/// Mean product of the differences of luma along the given rows of two pictures.
fn contrast(a: &SrgbPicture, b: &SrgbPicture, rows: std::ops::Range<usize>) -> f64 {
    let differences = |picture: &SrgbPicture| -> Vec<f64> {
        let line = |row: usize| &picture.pixels[row * picture.width..(row + 1) * picture.width];
        rows.clone().flat_map(|row| line(row).windows(3).map(|p| luma(p[2]) - luma(p[0]))).collect()
    };
    let (a, b) = (differences(a), differences(b));
    a.iter().zip(&b).map(|(a, b)| a * b).sum::<f64>() / a.len() as f64
}

/// Waves far smaller than a pixel is long on the water still show, because the eye sees the few facets that face it. A
/// mean over all of them would make the distant sea smooth: in the far bands of the first sea, it had 0.1 to 0.2 of the
/// variance of the reference.
#[test]
fn the_distant_sea_has_the_contrast_of_its_reference() {
    const SIZE: [u32; 2] = [256, 144];
    let mut table = format!("{:<16} {:>12} {:>10} {:>10} {:>6}\n", "sea", "rows", "reference", "picture", "ratio");
    let mut wrong = 0;
    for (sea, view) in [("wind=4.5&fetch=20", "y=5&fov=30"), ("wind=9&fetch=60", "y=4&fov=45")] {
        let p = params(&format!("{sea}&n=128&dir=200&sun=20&sunaz=150&{view}&heading=20&t=40"));
        let mut viewer = Viewer::new(SIZE, &p);
        let picture = viewer.normal();
        // The noise of two references is independent: what they have in common is the sea.
        let references = [1, 2].map(|seed| viewer.reference(64, seed));
        let first = horizon_row(&p, SIZE[1]);
        for rows in [4..12, 12..30, 30..60] {
            let rows = first + rows.start..first + rows.end;
            let (sea_itself, shown) =
                (contrast(&references[0], &references[1], rows.clone()), contrast(&picture, &picture, rows.clone()));
            let ratio = shown / sea_itself;
            table += &format!("{sea:<16} {rows:>12?} {sea_itself:>10.3e} {shown:>10.3e} {ratio:>6.2}\n");
            wrong += usize::from(!(0.4..2.5).contains(&ratio));
        }
    }
    eprint!("{table}");
    assert_eq!(wrong, 0, "bands of rows with less than 0.4 or more than 2.5 of the variance:\n{table}");
}

/// Draws many states with as few allocations as possible; the tone pass paints magenta what is not a number.
fn broken_pixels(states: std::ops::Range<u32>) -> Vec<String> {
    const SIZE: [u32; 2] = [48, 32];
    let gpu = gpu();
    let mut oceans: [Option<Ocean>; 5] = Default::default();
    let mut broken = Vec::new();
    for i in states {
        let p = random_params("n=64", i);
        let ocean = oceans[Plan::new(&p).cascades.len()]
            .get_or_insert_with(|| Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &p));
        ocean.set_params(&p);
        // The foam begins far from its end: a few steps of it are enough to break a picture.
        let mut encoder = gpu.encoder("test");
        ocean.record_frame(&mut encoder, SIZE, 3);
        let drawn = seastate::ocean::still::present_and_read_back(&gpu, encoder, SIZE, |pass| ocean.present(pass));
        let count = magenta(&SrgbPicture::from_rgba(SIZE[0], &pollster::block_on(drawn).expect("a picture")));
        if count > 0 {
            broken.push(format!("{count} pixels of state {i}: {}", query::write(&p)));
        }
    }
    broken
}

#[test]
fn no_pixel_is_broken_in_many_random_states() {
    assert_eq!(broken_pixels(0..75), Vec::<String>::new());
}

#[test]
#[ignore = "takes minutes on a software GPU"]
fn no_pixel_is_broken_in_two_thousand_random_states() {
    assert_eq!(broken_pixels(150..2150), Vec::<String>::new());
}
