//! The picture, rendered headless: it depends on the state alone, is a sea and not a plane, and holds no broken pixel.

mod common;

use common::{Pictures, gpu, params};
use seastate::gpu::Gpu;
use seastate::gpu::map_format::MapFormat;
use seastate::lab::flip::{PIXELS_PER_DEGREE, SrgbPicture, flip_errors, mean_error};
use seastate::ocean::still::{PICTURE_FORMAT, draw_ocean_picture, draw_picture, present_and_read_back};
use seastate::ocean::{Ocean, OutputKind};
use seastate::point::StrongestWaves;
use seastate::sim::MAX_FOAM_STEPS;
use seastate::state::{Params, query};
use seastate::waves::Plan;

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

/// Root mean square of what is left of the rows from `from` to `to` after taking away each row's own linear trend: 0
/// for a flat plane and for any smooth gradient.
fn texture(pixels: &[[u8; 4]], from: usize, to: usize) -> f64 {
    let width = SIZE[0] as usize;
    let mut sum = 0.0;
    for y in from..to {
        let row: Vec<f64> = pixels[y * width..][..width].iter().map(|p| luminance(*p)).collect();
        // Second differences see neither a constant nor a slope.
        sum += row.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).powi(2)).sum::<f64>() / width as f64;
    }
    (sum / (to - from) as f64).sqrt()
}

fn broken(pixels: &[[u8; 4]]) -> usize {
    pixels.iter().filter(|p| p[0] > 250 && p[1] < 5 && p[2] > 250).count()
}

#[test]
fn the_measure_sees_no_texture_in_planes_and_gradients() {
    let image = |f: &dyn Fn(f64, f64) -> f64| -> Vec<[u8; 4]> {
        let at = |i: u32| (f64::from(i % SIZE[0]), f64::from(i / SIZE[0]));
        (0..SIZE[0] * SIZE[1]).map(|i| [f(at(i).0, at(i).1).round() as u8; 4]).collect()
    };
    assert_eq!(texture(&image(&|_, _| 90.0), 40, 96), 0.0);
    assert!(texture(&image(&|x, y| 20.0 + 0.5 * x + y), 40, 96) < 1.5, "rounding alone");
}

#[test]
fn a_sea_is_seen_in_every_weather() {
    let mut pictures = Pictures::default();
    for state in [
        "wind=3&fetch=30&n=64&t=20",
        "wind=10&n=64&t=20",
        "wind=22&fetch=600&n=64&t=20&overcast=0.9",
        "wind=10&n=64&t=20&sun=4&sunaz=40",
    ] {
        let pixels = pictures.render(&params(state), SIZE);
        assert_eq!(broken(&pixels), 0, "{state}");
        let (sky, water) = (texture(&pixels, 2, 30), texture(&pixels, 50, 95));
        assert!(water > 2.5, "{state}: the water has texture ({water})");
        assert!(water > 1.5 * sky, "{state}: more than the sky ({water} against {sky})");
        let mean = pixels.iter().map(|p| luminance(*p)).sum::<f64>() / pixels.len() as f64;
        assert!((30.0..220.0).contains(&mean), "{state}: exposed ({mean})");
    }
}

#[test]
fn a_picture_depends_on_the_state_alone() {
    let gpu = gpu();
    let state = "wind=14&n=64&t=20";
    let first = render(&gpu, state);
    assert_eq!(first, render(&gpu, state), "the same twice");
    let later = render(&gpu, "wind=14&n=64&t=20.5");
    let moved = first.iter().zip(&later).filter(|(a, b)| (luminance(**a) - luminance(**b)).abs() > 4.0).count();
    assert!(moved > first.len() / 20, "half a second moves the sea ({moved} pixels)");
    assert_ne!(first, render(&gpu, "wind=14&n=64&t=20&seed=2"));
}

/// Graphics cards keep maps and tables in half floats, some software adapters in floats.
#[test]
fn half_floats_draw_the_same_picture() {
    let [floats, halves] = [MapFormat::Float, MapFormat::Half].map(common::gpu_with);
    for state in ["t=40", "wind=18&fetch=400&sun=5&overcast=0.4&bloom=0.5&t=90"] {
        let [a, b] = [&floats, &halves].map(|gpu| render(gpu, state));
        let off = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| f64::from(a.abs_diff(*b)));
        let mean = off.clone().sum::<f64>() / off.count() as f64;
        assert!(mean > 0.0 && mean < 1.0, "{state}: {mean} of 255");
    }
}

#[test]
fn a_picture_does_not_depend_on_how_one_came_there() {
    let gpu = gpu();
    let at = |t: f64| query::parse(&format!("wind=16&fetch=300&n=64&t={t}")).0;
    let cold = render_params(&gpu, &at(30.0));
    // Twelve seconds, three decay times, at thirty frames a second.
    let mut ocean = Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &at(18.0));
    for i in 0..360 {
        ocean.set_params(&at(18.0 + f64::from(i) / 30.0));
        let mut encoder = gpu.encoder("test");
        ocean.record_frame(&mut encoder, [16, 8], MAX_FOAM_STEPS);
        gpu.submit(encoder);
    }
    ocean.set_params(&at(30.0));
    let pixels = pollster::block_on(draw_ocean_picture(&gpu, &mut ocean, SIZE)).expect("a picture");
    let difference = |other: &[[u8; 4]]| {
        let sum: f64 = cold.iter().zip(other).map(|(a, b)| (luminance(*a) - luminance(*b)).abs()).sum();
        sum / cold.len() as f64
    };
    let run: Vec<[u8; 4]> = pixels.chunks(4).map(|p| [p[0], p[1], p[2], p[3]]).collect();
    let (same, other) = (difference(&run), difference(&render_params(&gpu, &at(30.5))));
    eprintln!("mean difference {same:.3} of 255, half a second later {other:.3}");
    assert!(same < 1.0 && same < 0.1 * other, "mean difference {same}, half a second later {other}");
}

#[test]
fn no_pixel_is_broken_at_the_corners() {
    let mut pictures = Pictures::default();
    for state in [
        "wind=0",
        "wind=60&fetch=2000",
        "depth=1&wind=30&spectrum=tma",
        "chop=2&wind=25",
        "height=4&wind=30",
        "sun=-8",
        "sun=-24",
        "sundistance=0.1&sun=90",
        "sunsize=10&sun=1",
        "fog=100",
        "fog=100&fogfalloff=1&fogheight=0&y=5000",
        "fog=0.1&fogfalloff=2000&fogheight=2000&y=1000&pitch=60",
        "bloom=1&sun=20&sunaz=40&sunfalloff=4",
        "sunby=date&day=355&hour=0&lat=90",
        "sun=90",
        "haze=10",
        "haze=0",
        "overcast=1",
        "water=9c&depth=2",
        "water=i&depth=1&caustics=1&wind=25",
        "depth=20&caustics=1&sun=-5",
        "nwater=1&nair=1",
        "nwater=1&nair=3&depth=3&caustics=1",
        "nwater=3&specular=ggx&roughness=1",
        "specular=ggx&wind=0",
        "specular=blinn-phong&shininess=10000&wind=30",
        "fresnel=schlick&fresnelshine=0&fresnelnormals=4",
        "scattercolour=000001&bubblecolour=000000&bubbles=10&wind=30",
        "foamroughness=0&foamrelief=4&wind=30",
        "glittercut=1",
        "y=5000&pitch=-60",
        "y=1&wind=0&pitch=-89",
        "pitch=60",
        "fov=10",
        "fov=100",
        "x=1000000&z=-1000000",
        "t=10000000",
        "foam=2&wind=30",
        "mesh=0.25",
        "g=0.5",
    ] {
        assert_eq!(broken(&pictures.render(&params(&format!("{state}&n=64")), SIZE)), 0, "{state}");
    }
}

/// Mean colour of the lower half, where the water is close.
fn water(pixels: &[[u8; 4]]) -> [f64; 3] {
    let near = &pixels[pixels.len() / 2..];
    [0, 1, 2].map(|c| near.iter().map(|p| f64::from(p[c])).sum::<f64>() / near.len() as f64)
}

#[test]
fn the_bed_shows_through_shallow_water_only() {
    let mut pictures = Pictures::default();
    let mut at =
        |more: &str| pictures.render(&params(&format!("wind=4&fetch=15&n=64&t=20&sun=60&pitch=-25{more}")), SIZE);
    let off =
        |a: &[[u8; 4]], b: &[[u8; 4]]| water(a).iter().zip(water(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (shallow, deep) = (at("&depth=3&water=ia"), at("&depth=200&water=ia"));
    assert!(off(&shallow, &at("&depth=3&water=ia&bedcolour=400000")) > 20.0, "the sand's colour is seen at 3 m");
    assert!(off(&shallow, &deep) > 20.0, "3 m of water are not 200");
    assert_eq!(deep, at("&depth=200&water=ia&bedcolour=400000&caustics=1"), "no bed is seen at 200 m");
    let [red, green, blue] = water(&shallow);
    assert!(green > red && blue > red, "water takes the red out: {red} {green} {blue}");
    // Muddy water hides it.
    let mut muddy = |more: &str| at(&format!("&depth=10&water=9c{more}"));
    assert!(off(&muddy(""), &muddy("&bedcolour=400000")) < 3.0);
}

#[test]
fn the_ocean_is_blue_and_the_coast_green() {
    let mut pictures = Pictures::default();
    let mut at =
        |water_type: &str| {
            water(&pictures.render(
                &params(&format!("wind=5&fetch=20&n=64&t=20&sun=60&pitch=-40&sunaz=220&water={water_type}")),
                SIZE,
            ))
        };
    let ([_, green, blue], [_, coast_green, coast_blue]) = (at("i"), at("3c"));
    assert!(blue > 1.5 * green, "{blue} over {green}");
    assert!(coast_green > coast_blue, "{coast_green} over {coast_blue}");
}

/// The eye of a storm: never in the water, nor is a hole seen in it. What is not water shows the bright horizon's sky.
#[test]
fn an_eye_near_the_water_rides_over_the_waves() {
    let mut pictures = Pictures::default();
    for (t, heading) in [(40, 30), (43, 120), (46, 210), (49, 300), (52, 0)] {
        let look = "overcast=1&foam=0&tone=agx&exposure=-0.73&y=1&pitch=-35";
        let state = format!("wind=26&fetch=800&n=64&{look}&t={t}&heading={heading}");
        let brightest = pictures.render(&params(&state), SIZE).into_iter().map(luminance).fold(0.0, f64::max);
        // Water stays below 100, the horizon is at 143.
        assert!(brightest < 120.0, "{state}: sky below the eye, or air in the water ({brightest})");
    }
}

/// A camera on a buoy keeps its height above the water, however high it is: the picture is that of a camera at rest
/// which is higher by the height of the water below it.
#[test]
fn a_camera_far_above_the_water_rides_on_it() {
    let gpu = gpu();
    let state = "spectrum=pm&wind=4&scale2=1&hs2=5&tp2=14&n=64&t=40&foam=0&pitch=-20";
    let params = |more: &str| query::parse(&format!("{state}{more}")).0;
    let height_m = StrongestWaves::new(&Plan::new(&params("")), usize::MAX).sample(0.0, 0.0, 40.0).height_m;
    assert!(height_m.abs() > 0.5, "the water is {height_m} m high: too near its mean for this test");
    let riding = render_params(&gpu, &params("&camera=buoy&y=40"));
    let off = |y_m: f64| {
        let pixels = render_params(&gpu, &params(&format!("&y={y_m}")));
        pixels.iter().zip(&riding).map(|(a, b)| (luminance(*a) - luminance(*b)).abs()).sum::<f64>()
            / riding.len() as f64
    };
    let (at_rest, raised) = (off(40.0), off(40.0 + height_m));
    assert!(raised < 0.2 * at_rest, "differences: {raised} at the raised height, {at_rest} at rest");
}

/// Away from the sun a calm sea has no glints: a covariance of slopes that is none would strew them everywhere.
#[test]
fn no_sparks_fly_away_from_the_sun() {
    let gpu = gpu();
    let pixels = render(&gpu, "wind=3&n=128&t=40&sunaz=220&foam=0&pitch=-15");
    let brightest = pixels[pixels.len() / 3..].iter().map(|p| luminance(*p)).fold(0.0, f64::max);
    assert!(brightest < 150.0, "{brightest}");
}

/// Pictures drawn smaller than the canvas are enlarged to something nearer to the picture drawn at full size than
/// linear interpolation makes of them.
#[test]
fn an_enlarged_picture_is_nearer_to_a_large_one_than_an_interpolated_one() {
    let gpu = gpu();
    let size = [320u32, 180];
    let flip = |a: &SrgbPicture, b: &SrgbPicture| mean_error(&flip_errors(a, b, PIXELS_PER_DEGREE).expect("FLIP"));
    for state in ["wind=10&n=64&t=20", "wind=20&fetch=500&n=64&t=40&sun=12&sunaz=40&afloat=buoy*0*-14_boat*6*-25"] {
        let (params, notices) = query::parse(state);
        assert_eq!(notices, Vec::<String>::new());
        let mut ocean = Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &params);
        let mut show = |drawn: [u32; 2], canvas: [u32; 2]| {
            let mut encoder = gpu.encoder("test");
            ocean.record_frame_with_complete_foam(&mut encoder, drawn);
            let pixels = present_and_read_back(&gpu, encoder, canvas, |pass| ocean.present(pass));
            SrgbPicture::from_rgba(canvas[0], &pollster::block_on(pixels).expect("a picture"))
        };
        let full = show(size, size);
        for small in [[160, 90], [192, 108], [246, 139]] {
            let enlarged = flip(&full, &show(small, size));
            let interpolated = flip(&full, &interpolated(&show(small, small), size));
            eprintln!("{state}, {small:?}: {enlarged:.4}, interpolated {interpolated:.4}");
            assert!(enlarged < interpolated, "{state}, {small:?}: {enlarged}, interpolated {interpolated}");
        }
    }
}

/// A picture scaled to `size` by linear interpolation.
fn interpolated(small: &SrgbPicture, size: [u32; 2]) -> SrgbPicture {
    let own = [small.width, small.height];
    let axis = |i: usize, at: usize| {
        let place = (at as f64 + 0.5) * own[i] as f64 / f64::from(size[i]) - 0.5;
        let first = place.floor();
        let [a, b] = [first, first + 1.0].map(|p| p.clamp(0.0, own[i] as f64 - 1.0) as usize);
        (a, b, place - first)
    };
    let pixel = |i: usize| {
        let ((left, right, fx), (top, bottom, fy)) = (axis(0, i % size[0] as usize), axis(1, i / size[0] as usize));
        let at = |x: usize, y: usize, c: usize| f64::from(small.pixels[y * own[0] + x][c]);
        std::array::from_fn(|c| {
            let row = |y: usize| at(left, y, c) + (at(right, y, c) - at(left, y, c)) * fx;
            (row(top) + (row(bottom) - row(top)) * fy).round() as u8
        })
    };
    let [width, height] = size.map(|s| s as usize);
    SrgbPicture { width, height, pixels: (0..width * height).map(pixel).collect() }
}
