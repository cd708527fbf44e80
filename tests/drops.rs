//! Spray, rain and squalls: rings of raindrops by the picture's own WGSL functions against their mean square slope, and
//! what drops do in whole pictures.

mod common;

use common::wgsl::{self, Kernel};
use common::{Pictures, params};
use seastate::optics::rain;

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
