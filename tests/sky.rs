//! Sun, sky, fog and film in whole pictures, rendered headless.

mod common;

use common::skies::made_up_sky;
use common::{Pictures, gpu, params};
use seastate::gpu::Gpu;
use seastate::ocean::still::{PICTURE_FORMAT, draw_ocean_picture, draw_picture};
use seastate::ocean::{Ocean, OutputKind};
use seastate::state::{Params, query};

const SIZE: [u32; 2] = [160, 96];

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
    let mut pictures = Pictures::default();
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
            let pixels = pictures.render(&params(&format!("{state}&{more}")), SIZE);
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
    let mut pictures = Pictures::default();
    let mut mean = |state: &str| {
        let pixels = pictures.render(&params(&format!("wind=8&n=64&t=5&{state}")), SIZE);
        assert_eq!(broken(&pixels), 0);
        let sum = pixels.iter().fold([0.0; 3], |s, p| std::array::from_fn(|i| s[i] + f64::from(p[i])));
        sum.map(|s| s / pixels.len() as f64)
    };
    let [noon, dusk, night] = ["sun=40", "sun=-7", "sun=-20"].map(&mut mean);
    assert!(night[2] > 1.5 * night[0] && night[2] > 12.0 && night[1] < 45.0, "{night:?}");
    assert!(dusk[1] > night[1] && noon[1] > dusk[1], "{noon:?} {dusk:?} {night:?}");
}

/// Means of the luminance over blocks of 16 x 16 pixels.
fn blocks(pixels: &[[u8; 4]]) -> Vec<f64> {
    let [width, height] = SIZE.map(|s| s as usize);
    let block = |x: usize, y: usize| {
        let rows = (16 * y..16 * y + 16).flat_map(|row| &pixels[row * width + 16 * x..row * width + 16 * x + 16]);
        rows.map(|p| luminance(*p)).sum::<f64>() / 256.0
    };
    (0..height / 16).flat_map(|y| (0..width / 16).map(move |x| block(x, y))).collect()
}

/// Clouds cover more of the sky the larger their cover is, and less light reaches the sea.
#[test]
fn clouds_cover_the_sky_and_dim_the_sea() {
    let mut pictures = Pictures::default();
    let base = "wind=4&fetch=20&n=64&t=5&dither=0&tone=agx&autoexposure=0&exposure=-0.82&sun=40";
    let up = format!("{base}&pitch=40&fov=100&heading=60");
    let down = format!("{base}&pitch=-30&y=800");
    let clear = pictures.render(&params(&up), SIZE);
    for kind in ["cumulus", "stratocumulus", "towering", "cirrus", "storm"] {
        let mut of = |cover: f64, view: &str| {
            pictures.render(&params(&format!("{view}&clouds={kind}&cloudcover={cover}")), SIZE)
        };
        let seen = [0.2, 0.8].map(|cover| {
            let pixels = of(cover, &up);
            assert_eq!(broken(&pixels), 0);
            let is_cloud = |(a, b): &(&[u8; 4], &[u8; 4])| a[0].abs_diff(b[0]) > 10;
            pixels.iter().zip(&clear).filter(is_cloud).count() as f64 / pixels.len() as f64
        });
        assert!(seen[1] > seen[0] + 0.1, "{kind}: {seen:?}");
        // Below others, the sea mirrors clouds that are brighter than the clear sky.
        if ["cumulus", "storm"].contains(&kind) {
            let [open, closed] = [0.2, 0.8].map(|cover| linear_mean(&of(cover, &down)));
            eprintln!("{kind}: light of the sea {open:.4} and {closed:.4}");
            assert!(closed < 0.9 * open, "{kind}: {open} {closed}");
        }
        eprintln!("{kind}: seen {seen:.2?}");
    }
}

/// Shadows of clouds mottle the sea; without clouds it is even.
#[test]
fn clouds_mottle_the_sea() {
    let mut pictures = Pictures::default();
    let base = "wind=4&fetch=20&n=64&t=5&dither=0&sun=50&sunaz=200&pitch=-20&y=800&heading=30";
    let mut spread = |state: &str| {
        let [dark, bright] = blocks(&pictures.render(&params(state), SIZE))
            .into_iter()
            .fold([f64::MAX, 0.0], |[low, high], b| [f64::min(low, b), f64::max(high, b)]);
        bright / dark
    };
    let [even, mottled] = [base.to_owned(), format!("{base}&clouds=cumulus&cloudcover=0.4")].map(|s| spread(&s));
    eprintln!("brightest block / darkest: {even:.3}, with clouds {mottled:.3}");
    assert!(mottled > even + 0.1, "{even} {mottled}");
}

/// The air and the rain before a cloud that hides the sun have no glow around it: the cloud shades them, too.
#[test]
fn no_glow_lies_before_a_cloud_that_hides_the_sun() {
    let mut pictures = Pictures::default();
    // The sun is in the middle of the picture.
    let view = "n=64&wind=6&dir=300&t=300&dither=0&bloom=0&exposure=-2&y=3&sun=7&sunaz=20&heading=20&pitch=7&fov=35";
    let mut glow = |sky: &str| {
        let pixels = pictures.render(&params(&format!("{view}&{sky}")), SIZE);
        let [width, height] = SIZE.map(|s| s as usize);
        let degree = height as f64 / 35.0;
        let around = |turn_deg: f64| {
            let column = (width as f64 / 2.0 + turn_deg * degree) as usize;
            let half = degree as usize;
            let rows = height / 2 - half..height / 2 + half;
            let lights = rows.flat_map(|y| &pixels[y * width + column - half..y * width + column + half]);
            lights.map(|p| luminance(*p)).sum::<f64>() / (4 * half * half) as f64
        };
        2.0 * around(0.0) / (around(-5.0) + around(5.0))
    };
    let deck = "clouds=stratocumulus&cloudcover=0.8";
    let [clear, cloudy, rain, shafts] =
        ["clouds=none", deck, &format!("{deck}&rain=3"), &format!("{deck}&rain=3&squalls=1")].map(&mut glow);
    eprintln!(
        "light at the sun, relative to that beside it: clear {clear:.2}, deck {cloudy:.2}, rain {rain:.2}, shafts {shafts:.2}"
    );
    assert!(clear > 1.15, "{clear}");
    assert!([cloudy, rain, shafts].iter().all(|glow| *glow < 1.08), "{cloudy} {rain} {shafts}");
}

/// A storm deck is thick: a low sun does not light the bumps of its base from below; they would be orange then.
#[test]
fn a_low_sun_does_not_light_the_base_of_a_storm_deck() {
    let gpu = gpu();
    let view = "n=64&wind=10&t=5&dither=0&bloom=0&y=3&sun=8&sunaz=30&heading=10&pitch=40&fov=50";
    let pixels = render(&gpu, &format!("{view}&clouds=storm&cloudcover=0.8"));
    let orange = pixels.iter().filter(|p| f64::from(p[0]) > 1.1 * f64::from(p[2])).count();
    let [least, most] = blocks(&pixels).iter().fold([f64::MAX, 0.0], |m, b| [b.min(m[0]), b.max(m[1])]);
    eprintln!("{orange} of {} pixels are orange; luminance {least:.0} to {most:.0}", pixels.len());
    assert_eq!(orange, 0);
    // It has light and dark parts, because it holds more water in some places than in others.
    assert!(most > 1.2 * least, "{least} {most}");
}

/// Air, haze and sea salt below a storm deck have its light: below a low sun, the horizon is as grey and as bright as
/// beside it.
#[test]
fn no_glow_of_a_low_sun_lies_below_a_storm_deck() {
    let mut pictures = Pictures::default();
    let view = "n=64&wind=20&t=5&dither=0&bloom=0&autoexposure=0&exposure=2&y=5&sun=5&sunaz=30&haze=0.6&pitch=4&fov=40\
                &clouds=storm&cloudcover=0.8";
    let mut horizon = |heading: u32| {
        let pixels = pictures.render(&params(&format!("{view}&heading={heading}")), SIZE);
        let [width, height] = SIZE.map(|s| s as usize);
        // From 1 to 3 degrees above the horizon, which lies 4 degrees below the middle.
        let degree = height as f64 / 40.0;
        let rows = |up: f64| (height as f64 / 2.0 + (4.0 - up) * degree) as usize * width;
        let low = &pixels[rows(3.0)..rows(1.0)];
        [0, 1, 2].map(|c| low.iter().map(|p| f64::from(p[c])).sum::<f64>() / low.len() as f64)
    };
    let [below_sun, beside] = [30, 150].map(&mut horizon);
    eprintln!("colour of the horizon below the sun {below_sun:.0?}, beside it {beside:.0?}");
    assert!((0..3).all(|c| (below_sun[c] / beside[c] - 1.0).abs() < 0.1), "{below_sun:.0?} {beside:.0?}");
    assert!(beside[2] < 1.4 * beside[0], "{beside:.0?}");
}

/// Rays of the sun come down from a gap in a deck: shafts of rain are bright there, and dark in the shade beside it.
#[test]
fn the_sun_lights_rain_below_a_gap() {
    let gpu = gpu();
    let pixels = render(
        &gpu,
        "n=64&wind=6&fetch=20&dir=300&t=785&dither=0&bloom=0&y=3&sun=7&sunaz=20&heading=28&pitch=4&fov=35&rain=3\
         &clouds=stratocumulus&cloudcover=0.8&squalls=1",
    );
    // Blocks of 16 pixels in the row above the horizon, from the left: rays fill the first and the third. Without
    // sunlight on rain and air they would be 1.3 and 1.1 times as bright as the deck in the sixth.
    let row: Vec<f64> = blocks(&pixels)[2 * (SIZE[0] / 16) as usize..].iter().take(10).copied().collect();
    eprintln!("light above the horizon {row:.0?}");
    assert!(row[0] > 1.8 * row[5] && row[2] > 1.45 * row[5], "{row:.0?}");
}

/// A picture with clouds depends on its state alone, and without clouds it is as if there were no such parameters.
#[test]
fn clouds_depend_on_the_state_alone() {
    let gpu = gpu();
    let state = "wind=9&n=64&t=30&sun=20&pitch=10&clouds=cumulus&cloudcover=0.4";
    let check = |a: &[[u8; 4]], b: &[[u8; 4]], what: &str| {
        let rows: Vec<usize> = (0..a.len()).filter(|&i| a[i] != b[i]).map(|i| i / SIZE[0] as usize).collect();
        assert!(rows.is_empty(), "{what}: {} pixels differ, in rows {:?} to {:?}", rows.len(), rows[0], rows.last());
    };
    let alone = render(&gpu, state);
    check(&alone, &render(&gpu, state), "drawn twice");
    let params = |state: &str| query::parse(state).0;
    let mut ocean = Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &params("wind=9&n=64&t=30&clouds=storm"));
    let mut draw = |state: &str| {
        ocean.set_params(&params(state));
        let bytes = pollster::block_on(draw_ocean_picture(&gpu, &mut ocean, SIZE)).expect("a picture");
        bytes.chunks(4).map(|p| [p[0], p[1], p[2], p[3]]).collect::<Vec<_>>()
    };
    draw("wind=9&n=64&t=30&clouds=storm");
    draw("wind=9&n=64&t=55&sun=20&pitch=10&clouds=cumulus&cloudcover=0.4");
    check(&draw(state), &alone, "drawn after others");
    let clear = "wind=9&n=64&t=30&sun=20&pitch=10";
    check(&draw(clear), &render(&gpu, &format!("{clear}&clouds=none&cloudcover=0.9")), "without clouds");
}

/// The picture of a running sea.
fn frame(gpu: &Gpu, ocean: &mut Ocean, params: &Params) -> Vec<[u8; 4]> {
    ocean.set_params(params);
    let bytes = pollster::block_on(draw_ocean_picture(gpu, ocean, SIZE)).expect("a picture");
    bytes.chunks(4).map(|p| [p[0], p[1], p[2], p[3]]).collect()
}

/// Mean difference of two pictures in luminance.
fn difference(a: &[[u8; 4]], b: &[[u8; 4]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (luminance(*a) - luminance(*b)).abs()).sum::<f64>() / a.len() as f64
}

/// The clouds of a running sea are those of its time, although their dome is filled bit by bit, and nothing leaps.
#[test]
fn clouds_of_a_running_sea_follow_its_time() {
    let gpu = gpu();
    // The view to the south is full of clouds.
    let view = "sun=30&heading=180&pitch=35&clouds=cumulus&cloudcover=0.4";
    let state = |t_s: f64| format!("wind=15&n=64&t={t_s}&{view}&dither=0");
    let params = |t_s: f64| query::parse(&state(t_s)).0;
    let mut ocean = Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &params(30.0));
    ocean.set_may_keep_pipelines(true);
    let mut frames: Vec<Vec<[u8; 4]>> = Vec::new();
    let times_s: Vec<f64> = (0..40).map(|i| 30.0 + 0.1 * f64::from(i)).collect();
    for &t_s in &times_s {
        frames.push(frame(&gpu, &mut ocean, &params(t_s)));
    }
    let steps: Vec<f64> = frames.windows(2).map(|pair| difference(&pair[0], &pair[1])).collect();
    let still = render(&gpu, &state(times_s[39]));
    let (last, moved) = (difference(&frames[39], &still), difference(&frames[0], &still));
    eprintln!("from the still {last:.2}, moved by {moved:.2}, steps {steps:.3?}");
    assert!(moved > 3.0, "there are no clouds in the view: {moved}");
    assert!(last < 0.45 * moved, "{last} {moved}");
    let mean = steps.iter().sum::<f64>() / steps.len() as f64;
    assert!(steps.iter().all(|step| *step < 4.0 * mean), "{steps:.3?}");
}

/// When a running sea is turned round, the dome that is being filled is begun again for the new view, and the picture
/// shows it alone after as many frames as it takes to fill two domes.
#[test]
fn a_turned_running_sea_has_a_fine_sky_again_soon() {
    let gpu = gpu();
    let params = |heading_deg: u32| {
        let view = format!("heading={heading_deg}&pitch=35&clouds=cumulus&cloudcover=0.4");
        query::parse(&format!("wind=15&n=64&t=30&sun=30&{view}&dither=0")).0
    };
    let mut ocean = Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &params(0));
    ocean.set_may_keep_pipelines(true);
    // A dome for these few pixels has eight parts. The sea is turned while the picture fades from one to the next.
    (0..12).for_each(|_| drop(frame(&gpu, &mut ocean, &params(0))));
    let still = frame(&gpu, &mut Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &params(180)), &params(180));
    let frames: Vec<_> = (0..16).map(|_| frame(&gpu, &mut ocean, &params(180))).collect();
    let left: Vec<f64> = frames.iter().map(|picture| difference(picture, &still)).collect();
    let steps: Vec<f64> = frames.windows(2).map(|pair| difference(&pair[0], &pair[1])).collect();
    eprintln!("from the still {left:.3?}, steps {steps:.3?}");
    assert!(left[0] > 0.5, "{left:.3?}");
    assert!(left[15] < 0.1 * left[0], "{left:.3?}");
    // The picture fades to the fine sky in eight equal steps, and goes back to no older one.
    assert!(steps.iter().all(|step| *step < 0.2 * left[0]), "{steps:.3?}");
    // A view that is turned round again and again gets new domes, too.
    let turns: Vec<_> = (0..32).map(|i| frame(&gpu, &mut ocean, &params(180 * (i / 4 % 2)))).collect();
    let late = difference(&turns[24], &turns[0]) + difference(&turns[28], &turns[4]);
    eprintln!("after turns {late:.3}");
    assert!(late > 0.1, "{late}");
}
