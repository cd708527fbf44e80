//! Sun, sky, fog and film in whole pictures, rendered headless.

#[path = "common/skies.rs"]
mod skies;

use seastate::gpu::Gpu;
use seastate::ocean::still::draw_picture;
use seastate::state::{Params, query};
use skies::made_up_sky;

const SIZE: [u32; 2] = [160, 96];

fn gpu() -> Gpu {
    pollster::block_on(Gpu::request()).expect("a GPU adapter; install mesa-vulkan-drivers")
}

fn render(gpu: &Gpu, state: &str) -> Vec<[u8; 4]> {
    let (params, notices) = query::parse(state);
    assert_eq!(notices, Vec::<String>::new());
    render_params(gpu, &params)
}

fn render_params(gpu: &Gpu, params: &Params) -> Vec<[u8; 4]> {
    let pixels = pollster::block_on(draw_picture(gpu, params, SIZE)).expect("a picture");
    pixels.chunks(4).map(|p| [p[0], p[1], p[2], p[3]]).collect()
}

fn luminance(p: [u8; 4]) -> f64 {
    0.2126 * f64::from(p[0]) + 0.7152 * f64::from(p[1]) + 0.0722 * f64::from(p[2])
}

fn broken(pixels: &[[u8; 4]]) -> usize {
    pixels.iter().filter(|p| p[0] > 250 && p[1] < 5 && p[2] > 250).count()
}

/// Mean difference of neighbours in the rows of the water.
fn texture(pixels: &[[u8; 4]]) -> f64 {
    let rows = pixels[50 * SIZE[0] as usize..].chunks(SIZE[0] as usize);
    let steps: Vec<f64> =
        rows.flat_map(|row| row.windows(2).map(|w| (luminance(w[0]) - luminance(w[1])).abs())).collect();
    steps.iter().sum::<f64>() / steps.len() as f64
}

/// Column of the brightest tenth of the water, -1 (left) to 1.
fn glitter_column(pixels: &[[u8; 4]]) -> f64 {
    let width = SIZE[0] as usize;
    let water = &pixels[60 * width..];
    let mut bright: Vec<f64> = water.iter().map(|p| luminance(*p)).collect();
    bright.sort_by(f64::total_cmp);
    let cut = bright[bright.len() * 95 / 100];
    let columns: Vec<f64> =
        (0..water.len()).filter(|&i| luminance(water[i]) > cut).map(|i| (i % width) as f64).collect();
    columns.iter().sum::<f64>() / columns.len() as f64 / (0.5 * width as f64) - 1.0
}

#[test]
fn the_sun_of_a_file_glitters_below_it() {
    let gpu = gpu();
    // Half the width of the picture is 37.8 degrees.
    for (sun, turn, expected) in [(40.0, 0.0, 0.0), (20.0, 0.0, -0.47), (350.0, 70.0, 0.47)] {
        let mut params =
            query::parse(&format!("wind=5&fetch=20&n=64&t=5&heading=40&pitch=0&sky=made-up.hdr&skyturn={turn}")).0;
        params.look.sky.adopt_loaded_image(Some(&made_up_sky(sun)));
        let pixels = render_params(&gpu, &params);
        assert_eq!(broken(&pixels), 0);
        let column = glitter_column(&pixels);
        assert!((column - expected).abs() < 0.2, "sun at {sun}, turned by {turn}: {column}, expected {expected}");
    }
}

#[test]
fn a_sky_that_is_not_at_hand_is_the_built_one() {
    let gpu = gpu();
    let wanted = query::parse("n=64&t=5&sky=elsewhere.exr").0;
    assert!(wanted.look.sky.missing_file_notice().is_some());
    assert_eq!(render_params(&gpu, &wanted), render(&gpu, "n=64&t=5"));
}

/// Linear light of a picture that was taken with tone=linear.
fn linear_mean(pixels: &[[u8; 4]]) -> f64 {
    let linear = |v: u8| {
        let c = f64::from(v) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    pixels.iter().map(|p| 0.2126 * linear(p[0]) + 0.7152 * linear(p[1]) + 0.0722 * linear(p[2])).sum::<f64>()
        / pixels.len() as f64
}

#[test]
fn bloom_loses_no_light() {
    let gpu = gpu();
    // Nothing reaches the white of the screen, where light would be lost.
    let base = "wind=14&n=64&t=20&overcast=1&tone=linear&exposure=-0.6&pitch=-12&dither=0";
    let sharp = render(&gpu, base);
    assert!(sharp.iter().all(|p| p[0].max(p[1]).max(p[2]) < 250));
    let spread = render(&gpu, &format!("{base}&bloom=1"));
    let (a, b) = (linear_mean(&sharp), linear_mean(&spread));
    eprintln!("mean {a:.5}, with bloom {b:.5}");
    assert!((b / a - 1.0).abs() < 0.01, "{a} {b}");
    let (a, b) = (texture(&sharp), texture(&spread));
    assert!(b < 0.3 * a, "it spreads: {b} of {a}");
}

/// Just above and just below a horizon in fog that hides the sea there, the picture is the same.
#[test]
fn fog_has_no_seam_at_the_horizon() {
    let gpu = gpu();
    const TIMES_S: [f64; 4] = [5.0, 25.0, 45.0, 65.0];
    for state in [
        "y=2&pitch=0",
        "y=20&pitch=0&sun=5",
        "y=60&pitch=0&sun=60&overcast=0.5",
        "y=20&pitch=0&sun=-3",
        "y=400&pitch=1",
    ] {
        // Waves that the fog lets through come and go with the time; a seam would stay.
        let width = SIZE[0] as usize;
        let mut rows = vec![0.0; SIZE[1] as usize];
        for t_s in TIMES_S {
            let more = format!("wind=5&fetch=20&n=64&t={t_s}&fov=10&fog=20&fogheight=500&dither=0");
            let pixels = render(&gpu, &format!("{state}&{more}"));
            for (row, line) in rows.iter_mut().zip(pixels.chunks(width)) {
                *row += line.iter().map(|p| luminance(*p)).sum::<f64>() / (width * TIMES_S.len()) as f64;
            }
        }
        for y in 30..62 {
            assert!((rows[y] - rows[y + 1]).abs() < 1.5, "{state}: rows {y}: {} and {}", rows[y], rows[y + 1]);
        }
    }
}

/// Night: darker than dusk, dark blue, and neither black nor lifted to day.
#[test]
fn night_is_night() {
    let gpu = gpu();
    let mean = |state: &str| {
        let pixels = render(&gpu, &format!("wind=8&n=64&t=5&{state}"));
        assert_eq!(broken(&pixels), 0);
        let sum = pixels.iter().fold([0.0; 3], |s, p| std::array::from_fn(|i| s[i] + f64::from(p[i])));
        sum.map(|s| s / pixels.len() as f64)
    };
    let [noon, dusk, night] = ["sun=40", "sun=-7", "sun=-20"].map(mean);
    assert!(night[2] > 1.5 * night[0] && night[2] > 12.0 && night[1] < 45.0, "{night:?}");
    assert!(dusk[1] > night[1] && noon[1] > dusk[1], "{noon:?} {dusk:?} {night:?}");
}
