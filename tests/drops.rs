//! Spray, rain and squalls: rings of raindrops by the picture's own WGSL functions against their mean square slope, the
//! rainbow against ray optics, and what drops do in whole pictures.

mod common;

use common::wgsl::{self, Kernel};
use common::{Pictures, params};
use seastate::optics::{rain, rainbow};

const SIZE: [u32; 2] = [160, 90];
const MODULE: &str = "water/light";

/// Mean square of the slopes that pixels of a length show, and mean of the variance that they do not show, for rings
/// with the mean square slope `square` in `share` of the cells, among other slopes with the variance 0.01.
fn ring_slopes(shaders: &seastate::shaders::Shaders, length_m: f32, square: f32, share: f32) -> [f64; 2] {
    let text = "fn answer(q: Question) -> Answer {
        material.ring_slope_variance = q[0].w;
        material.ring_share = q[1].x;
        material.ring_moment = 7u;
        material.ring_moment_fraction = 0.3;
        var slope: WaterSlope;
        slope.variance = vec3f(vec2f(0.005 + 0.5 * q[0].w), 0.0);
        let seen = ring_add(slope, q[0].xy, q[0].z);
        return Answer(vec4f(seen.mean, seen.variance.xy));
    }";
    let shaders = shaders.clone().patched(
        MODULE,
        "@group(0) @binding(9) var<uniform> material: Material;",
        "var<private> material: Material;",
    );
    let kernel = Kernel::<2, 1>::new(&common::gpu(), &shaders, MODULE, text);
    // Points of a lattice that has no ratio to the cells.
    let at = |i: u32| [(i % 200) as f32 * 0.0617 - 6.0, (i / 200) as f32 * 0.0593 - 6.0];
    let questions: Vec<_> =
        (0..40_000).map(at).map(|[x, z]| [[x, z, length_m, square], [share, 0.0, 0.0, 0.0]]).collect();
    let answers = kernel.ask(&questions);
    let n = answers.len() as f64;
    let shown = answers.iter().map(|[a]| a[0] * a[0] + a[1] * a[1]).sum::<f64>() / n;
    [shown, answers.iter().map(|[a]| a[2] + a[3]).sum::<f64>() / n]
}

/// Whatever the size of the pixels, the slopes that they show and the variance that they do not show are those of the
/// published spectrum together. Without the share that moves from one to the other, they would not be.
#[test]
fn rings_keep_their_mean_square_slope_at_every_pixel_size() {
    let shaders = wgsl::shaders();
    let wanted = 0.01 + rain::ring_slope_variance(10.0);
    for share in [1.0, 0.5] {
        for length_m in [0.0, 0.01, 0.02, 0.04, 0.08, 0.3] {
            let [shown, rest] = ring_slopes(&shaders, length_m, rain::ring_slope_variance(10.0) as f32, share);
            let sum = shown + rest;
            eprintln!("{length_m} m, share {share}: {shown:.5} + {rest:.5}, expected {wanted:.5}");
            assert!((sum / wanted - 1.0).abs() < 0.03, "{length_m} m: {sum}, expected {wanted}");
            assert!(length_m > 0.0 || (shown / (wanted - 0.01) - 1.0).abs() < 0.08, "small pixels show all rings");
            assert!(length_m < 0.3 || shown == 0.0, "large pixels show none");
        }
    }
    let faulty = shaders.patched(MODULE, "vec3f(vec2f(drawn), 0.0)", "vec3f(0.0)");
    let [shown, rest] = ring_slopes(&faulty, 0.0, rain::ring_slope_variance(10.0) as f32, 1.0);
    assert!((shown + rest) / wanted > 1.2, "the fault is found");
}

/// Differences between the picture's rainbow and ray optics, for the primary and the secondary bow and each channel: the
/// mean difference, relative to the mean light, and the angle between the brightest places, degrees.
fn rainbow_differences(shaders: &seastate::shaders::Shaders) -> [[[f64; 2]; 3]; 2] {
    let text = "fn answer(q: Question) -> Answer { return Answer(vec4f(rainbow_phase(q[0].x), 0.0)); }";
    let kernel = Kernel::<1, 1>::new(&common::gpu(), shaders, MODULE, text);
    [(1, 31.0..46.0), (2, 46.0..61.0)].map(|(reflections, inside)| {
        let rays: Vec<_> = rainbow::bow(reflections).into_iter().filter(|(deg, _)| inside.contains(deg)).collect();
        let questions: Vec<_> = rays.iter().map(|(deg, _)| [[-deg.to_radians().cos() as f32, 0.0, 0.0, 0.0]]).collect();
        let answers = kernel.ask(&questions);
        std::array::from_fn(|c| {
            let drawn: Vec<f64> = answers.iter().map(|[a]| a[c] * 4.0 * std::f64::consts::PI).collect();
            // A channel outside of the display's gamut is black.
            let wanted: Vec<f64> = rays.iter().map(|(_, colour)| colour[c].max(0.0)).collect();
            let off: f64 = wanted.iter().zip(&drawn).map(|(a, b)| (a - b).abs()).sum();
            let brightest = |of: &[f64]| (0..of.len()).max_by(|a, b| of[*a].total_cmp(&of[*b])).expect("angles");
            let apart = rays[brightest(&wanted)].0 - rays[brightest(&drawn)].0;
            [off / wanted.iter().sum::<f64>(), apart.abs()]
        })
    })
}

/// Both bows lie where ray optics puts them. The primary bow has the light of the rays within an eighth. The secondary
/// one, which has an eighth of the light, falls off more slowly than theirs: within 35 %.
#[test]
fn the_rainbow_is_that_of_ray_optics() {
    let shaders = wgsl::shaders();
    let bows = rainbow_differences(&shaders);
    eprintln!("mean differences, and degrees between the brightest places: {bows:.3?}");
    for (bow, most) in bows.iter().zip([0.125, 0.35]) {
        assert!(bow.iter().all(|[off, apart]| *off < most && *apart <= 0.15), "{bow:?}");
    }
    let faulty = shaders.patched(MODULE, "vec3f(42.22, 41.80, 41.05)", "vec3f(41.05, 41.80, 42.22)");
    let [reversed, _] = rainbow_differences(&faulty);
    assert!(reversed[0][1] > 0.5 && reversed[2][1] > 0.5, "reversed colours are found: {reversed:?}");
}

fn luminance(p: [u8; 4]) -> f64 {
    0.2126 * f64::from(p[0]) + 0.7152 * f64::from(p[1]) + 0.0722 * f64::from(p[2])
}

/// Mean luminance of the rows from `first` to `last`.
fn rows(pixels: &[[u8; 4]], first: usize, last: usize) -> f64 {
    let part = &pixels[first * SIZE[0] as usize..last * SIZE[0] as usize];
    part.iter().map(|p| luminance(*p)).sum::<f64>() / part.len() as f64
}

/// Number of pixels that spray changes, in a wind.
fn sprayed(pictures: &mut Pictures, wind_m_s: f64) -> usize {
    let state = format!("wind={wind_m_s}&fetch=400&n=64&t=20&y=4&pitch=1&heading=265&dir=270&dither=0");
    let without = pictures.render(&params(&state), SIZE);
    let with = pictures.render(&params(&format!("{state}&spray=1")), SIZE);
    without.iter().zip(&with).filter(|(a, b)| (luminance(**a) - luminance(**b)).abs() > 1.0).count()
}

#[test]
fn spray_grows_with_the_wind_from_nothing() {
    let mut pictures = Pictures::default();
    let counts = [8.0, 12.0, 18.0, 26.0].map(|wind| sprayed(&mut pictures, wind));
    eprintln!("pixels with spray {counts:?}");
    assert_eq!(counts[..2], [0, 0]);
    assert!(counts[3] > counts[2] && counts[3] > 200, "{counts:?}");
}

/// A still depends on its state alone: not on what was drawn before, nor on the device.
#[test]
fn drops_depend_on_the_state_alone() {
    let mut pictures = Pictures::default();
    let state = "wind=24&fetch=300&n=64&t=31.7&y=3&clouds=storm&spray=1&rain=20&squalls=0.4";
    let first = pictures.render(&params(state), SIZE);
    for other in ["n=64&t=3", &state.replace("31.7", "33.9"), &format!("{state}&afloat=buoy*3*-9")] {
        assert!(pictures.render(&params(other), SIZE) != first, "{other} is another picture");
        assert!(pictures.render(&params(state), SIZE) == first, "after {other}");
    }
    assert!(Pictures::default().render(&params(state), SIZE) == first, "on another device");
}

/// In rain, opposite a low sun, a bow of 42 degrees around the point opposite the sun crosses the sky, red outside.
#[test]
fn rain_before_a_low_sun_shows_a_bow() {
    let mut pictures = Pictures::default();
    // The camera looks at the level of the bow's top: 42 degrees less the sun's elevation.
    let state = "wind=5&n=64&t=40&sunaz=180&y=4&heading=0&pitch=30&fov=20&dither=0";
    let mut hue = |more: &str| {
        let pixels = pictures.render(&params(&format!("{state}{more}")), SIZE);
        // Red less blue in the middle column, from the top row to the bottom one.
        let middle = |row: u32| pixels[(row * SIZE[0] + SIZE[0] / 2) as usize];
        (0..SIZE[1]).map(|row| f64::from(middle(row)[0]) - f64::from(middle(row)[2])).collect::<Vec<_>>()
    };
    let (dry, wet, high) = (hue("&sun=12"), hue("&sun=12&rain=8"), hue("&sun=50&rain=8"));
    // Largest fall of red less blue from a row to that six rows (1.3 degrees) lower.
    let fall = |hues: &[f64]| (0..84).map(|row| hues[row] - hues[row + 6]).fold(0.0, f64::max);
    let reddest = (0..90).max_by(|a, b| (wet[*a] - dry[*a]).total_cmp(&(wet[*b] - dry[*b]))).expect("rows");
    let reddest_deg = 30.0 + 10.0 - 20.0 * (reddest as f64 + 0.5) / 90.0;
    eprintln!("falls {:.1} {:.1} {:.1}, reddest at {reddest_deg:.2} degrees", fall(&dry), fall(&wet), fall(&high));
    assert!(fall(&wet) > 8.0 * fall(&dry).max(fall(&high)), "the bow is there only before a low sun");
    assert!((reddest_deg - (42.2 - 12.0)).abs() < 0.4, "{reddest_deg}");
}

/// Rain hides the horizon; shafts below the clouds darken the sky above it.
#[test]
fn rain_hides_the_horizon_and_squalls_darken_it() {
    let mut pictures = Pictures::default();
    let state = "wind=9&fetch=80&n=64&t=40&sun=40&sunaz=330&clouds=storm&cloudcover=0.9&y=4&pitch=0&heading=110";
    let mut contrast = |more: &str| {
        let pixels = pictures.render(&params(&format!("{state}{more}")), SIZE);
        let (above, below) = (rows(&pixels, 41, 44), rows(&pixels, 46, 49));
        eprintln!("{more}: {above:.1} above the horizon, {below:.1} below");
        (above, above - below)
    };
    let (clear, clear_edge) = contrast("");
    let (_, rainy_edge) = contrast("&rain=30");
    let (dark, _) = contrast("&squalls=0.6");
    assert!(rainy_edge < 0.6 * clear_edge, "{rainy_edge} {clear_edge}");
    assert!(dark < 0.9 * clear, "{dark} {clear}");
}
