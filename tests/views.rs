//! The views: each shows what it says, in numbers where theory or the twins of the passes give them.

mod common;

use common::{Pictures, params};
use seastate::oracle;
use seastate::state::Params;
use seastate::state::views::{DISPLAYED_VIEWS, DisplayedView, MapView, SurfaceView, ViewChoice};
use seastate::waves::Plan;
use seastate::waves::colour_scale::{ColourScale, Palette, STOPS};
use std::f64::consts::{PI, TAU};

type Pixels = Vec<[u8; 4]>;

fn view(state: &str, displayed: DisplayedView, cascade: u32) -> Params {
    let mut params = params(state);
    params.look.view = ViewChoice { displayed, cascade };
    params
}

fn map(state: &str, map: MapView, cascade: u32) -> Params {
    view(state, DisplayedView::Map(map), cascade)
}

fn magenta(pixels: &Pixels) -> usize {
    pixels.iter().filter(|p| p[0] > 250 && p[1] < 5 && p[2] > 250).count()
}

/// Pixels around a map of 64 texels.
const MARGIN: usize = 6;

/// The texels of a map of n = 64, in a picture where each is one pixel.
fn texels(pictures: &mut Pictures, params: &Params) -> Pixels {
    let side = 64 + 2 * MARGIN;
    let pixels = pictures.render(params, [side as u32; 2]);
    (0..64 * 64).map(|i| pixels[(MARGIN + i / 64) * side + MARGIN + i % 64]).collect()
}

/// The colour that stands for a value: the twin of shaders/views/common.wgsl.
fn colour(scale: &ColourScale, value: f64) -> [f64; 3] {
    let place = if scale.logarithmic {
        (value.max(1e-30) / scale.low).ln() / (scale.high / scale.low).ln()
    } else {
        (value - scale.low) / (scale.high - scale.low)
    };
    let at = place.clamp(0.0, 1.0) * (STOPS - 1) as f64;
    let below = (at as usize).min(STOPS - 2);
    let stops = scale.palette.stops().map(|c| c.map(f64::from));
    std::array::from_fn(|i| stops[below][i] + (at - below as f64) * (stops[below + 1][i] - stops[below][i]))
}

/// The share of texels that differ from their expected colours by more than a rounding of the map or of the screen.
fn wrong(pixels: &Pixels, expected: impl Fn(usize) -> [f64; 3]) -> f64 {
    let differs = |i: usize| {
        let want = expected(i);
        (0..3).any(|c| (f64::from(pixels[i][c]) - 255.0 * want[c]).abs() > 2.5)
    };
    (0..pixels.len()).filter(|&i| differs(i)).count() as f64 / pixels.len() as f64
}

#[test]
fn every_view_is_another_and_none_is_broken() {
    let mut pictures = Pictures::default();
    let mut seen: Vec<(&str, Pixels)> = Vec::new();
    for (word, displayed, _) in DISPLAYED_VIEWS {
        let pixels = pictures.render(&view("wind=18&fetch=300&n=64&t=20", *displayed, 0), [96, 54]);
        assert_eq!(magenta(&pixels), 0, "{word}");
        for (other, before) in &seen {
            let moved = pixels.iter().zip(before).filter(|(a, b)| a != b).count();
            assert!(moved > 96 * 54 / 50, "{word} looks like {other}: {moved} pixels differ");
        }
        seen.push((word, pixels));
    }
}

#[test]
fn every_view_of_strange_seas_is_whole() {
    let mut pictures = Pictures::default();
    for state in ["wind=0", "wind=60&fetch=2000&chop=2", "depth=1&wind=30&spectrum=tma", "cascades=1&height=4"] {
        for (word, displayed, _) in &DISPLAYED_VIEWS[1..] {
            for cascade in [1, 4] {
                let pixels = pictures.render(&view(&format!("{state}&n=64"), *displayed, cascade), [32, 18]);
                assert_eq!(magenta(&pixels), 0, "{state}: {word} of {cascade}");
            }
        }
    }
}

/// Every map that the f32 copy holds, texel by texel: the right channel of the right cascade in the right place.
#[test]
fn maps_are_shown_as_they_are() {
    let mut pictures = Pictures::default();
    let state = "wind=12&n=64&t=33&chopx=0.7&dir=200";
    let plan = Plan::new(&params(state));
    let maps = common::maps(&pictures.gpu, state, 33.0);
    let chop = plan.sea.choppiness_xz();
    for cascade in 0..plan.cascades.len() {
        let (d, g) = (maps.displacement(cascade), maps.gradients(cascade));
        let d = |i: usize, c: usize| f64::from(d[i][c]);
        let g = |i: usize, c: usize| f64::from(g[i][c]);
        let moment = |i: usize, a: usize, b: usize| {
            let corner = i / 128 * 128 + i % 64 / 2 * 2;
            [0, 1, 64, 65].map(|o| g(corner + o, a) * g(corner + o, b)).iter().sum::<f64>() / 4.0
        };
        let value = |map: MapView, i: usize| match map {
            MapView::Dx => d(i, 0),
            MapView::Height => d(i, 1),
            MapView::Dz => d(i, 2),
            MapView::DxDz => d(i, 3),
            MapView::SlopeX => g(i, 0),
            MapView::SlopeZ => g(i, 1),
            MapView::DxDx => g(i, 2),
            MapView::DzDz => g(i, 3),
            MapView::MomentXx => moment(i, 0, 0),
            MapView::MomentZz => moment(i, 1, 1),
            MapView::MomentXz => moment(i, 0, 1),
            _ => (1.0 + chop[0] * g(i, 2)) * (1.0 + chop[1] * g(i, 3)) - chop[0] * chop[1] * d(i, 3).powi(2),
        };
        for (word, displayed, _) in DISPLAYED_VIEWS {
            let DisplayedView::Map(kind) = *displayed else { continue };
            if matches!(kind, MapView::InitialSpectrum | MapView::Spectrum | MapView::Foam | MapView::Source) {
                continue;
            }
            let scale = ColourScale::new(*displayed, &plan, cascade);
            let pixels = texels(&mut pictures, &map(state, kind, cascade as u32 + 1));
            let share = wrong(&pixels, |i| colour(&scale, value(kind, i)));
            assert!(share < 0.002, "{word} of cascade {cascade}: {share} of the texels are off");
            let clipped = (0..64 * 64).map(|i| value(kind, i)).filter(|v| *v < scale.low || *v > scale.high).count();
            assert!(clipped < 64 * 64 / 8, "{word} of cascade {cascade}: {clipped} values are off the scale");
        }
    }
}

/// Both spectra against the f64 twin: magnitude, and phase as hue. |h0| stands still; h(k, t) goes as theory says.
#[test]
fn spectra_are_those_of_the_oracle() {
    let mut pictures = Pictures::default();
    let state = |t: f64| format!("wind=12&n=64&t={t}");
    let plan = Plan::new(&params(&state(0.0)));
    let middle = |i: usize| ((i / 64 + 32) % 64) * 64 + (i % 64 + 32) % 64;
    for cascade in 0..plan.cascades.len() {
        let h0 = oracle::spectrum::initial_spectrum(&plan, &plan.cascades[cascade]);
        let scale = ColourScale::new(DisplayedView::Map(MapView::InitialSpectrum), &plan, cascade);
        let first = texels(&mut pictures, &map(&state(5.0), MapView::InitialSpectrum, cascade as u32 + 1));
        let share = wrong(&first, |i| colour(&scale, h0[middle(i)][0].hypot(h0[middle(i)][1])));
        assert!(share < 0.002, "h0 of cascade {cascade}: {share} of the waves are off");
        assert_eq!(first, texels(&mut pictures, &map(&state(77.5), MapView::InitialSpectrum, cascade as u32 + 1)));

        let scale = ColourScale::new(DisplayedView::Map(MapView::Spectrum), &plan, cascade);
        assert_eq!(scale.palette, Palette::Phase);
        for t in [5.0, 77.5] {
            let h = oracle::maps::evolved_spectrum(&plan, &plan.cascades[cascade], &h0, t);
            let pixels = texels(&mut pictures, &map(&state(t), MapView::Spectrum, cascade as u32 + 1));
            let share = wrong(&pixels, |i| {
                let [re, im] = h[middle(i)];
                let (grey, phase) = (colour(&scale, re.hypot(im)), im.atan2(re));
                std::array::from_fn(|c| grey[c] * (0.6 + 0.6 * (phase - TAU * c as f64 / 3.0).cos()).min(1.0))
            });
            assert!(share < 0.005, "cascade {cascade} at {t} s: {share} of the waves are off");
        }
    }
}

/// A sea of one wave, eight of it to the patch, running east: its length and its period are seen.
#[test]
fn the_height_of_a_single_wave() {
    let mut pictures = Pictures::default();
    let patch_m = 100.0;
    let dk = TAU / patch_m;
    let sea = format!(
        "spread=cos2-positive&dir=270&dispersion=deep&n=64&cascades=1&patch1={patch_m}&low1={}&high1={}",
        7.99 * dk,
        8.05 * dk
    );
    let mut crests = |t: f64| -> Vec<bool> {
        let pixels = texels(&mut pictures, &map(&format!("{sea}&t={t}"), MapView::Height, 1));
        pixels.iter().map(|p| p[0] > p[2]).collect()
    };
    let start = crests(0.0);
    for row in start.chunks(64) {
        let changes = (0..64).filter(|&x| row[x] != row[(x + 1) % 64]).count();
        assert_eq!(changes, 16, "eight crests in a row");
        assert_eq!(row, &start[..64], "crests run north and south");
    }
    let period_s = TAU / (9.81 * 8.0 * dk).sqrt();
    let mut same = |t: f64| crests(t).iter().zip(&start).filter(|(a, b)| a == b).count();
    assert!(same(period_s) > 64 * 64 * 99 / 100);
    assert!(same(0.5 * period_s) < 64 * 64 / 100);
    // A quarter of a period later the crests have gone two texels of eight to the east.
    let later = crests(0.25 * period_s);
    let moved = (0..64 * 64).filter(|i| later[i / 64 * 64 + (i % 64 + 2) % 64] == start[*i]).count();
    assert!(moved > 64 * 64 * 99 / 100, "{moved}");
}

#[test]
fn normals_of_a_flat_sea_point_up() {
    let mut pictures = Pictures::default();
    let pixels = pictures.render(&view("wind=0&n=64", DisplayedView::Surface(SurfaceView::Normals), 0), [96, 54]);
    let up = |p: &[u8; 4]| p[0].abs_diff(128) <= 1 && p[1].abs_diff(128) <= 1 && p[2] == 255;
    let water = pixels.iter().filter(|p| up(p)).count();
    let sky = pixels.iter().filter(|p| p[..3] == [0; 3]).count();
    assert_eq!(water + sky, pixels.len());
    assert!(water > pixels.len() / 2, "{water}");
}

/// From straight above, the level is the logarithm of a tap's size in texels: a pixel over the square root of 3,
/// because a mip read with interpolation blurs as much as a box of the square root of 3 times its texel.
#[test]
fn mips_follow_the_height_of_the_eye() {
    let mut pictures = Pictures::default();
    for y_m in [200.0, 400.0] {
        let state = format!("wind=3&cascades=1&patch1=64&n=64&y={y_m}&pitch=-89&fov=50");
        let plan = Plan::new(&params(&state));
        let displayed = DisplayedView::Surface(SurfaceView::Mips);
        let scale = ColourScale::new(displayed, &plan, 0);
        let pixels = pictures.render(&view(&state, displayed, 1), [60, 60]);
        let levels = (0..1000).map(|i| scale.high * f64::from(i) / 999.0).collect::<Vec<_>>();
        let distance = |p: &[u8; 4], level: f64| {
            (0..3).map(|c| (f64::from(p[c]) - 255.0 * colour(&scale, level)[c]).powi(2)).sum::<f64>()
        };
        let level = |p: &[u8; 4]| {
            levels.iter().copied().min_by(|a, b| distance(p, *a).total_cmp(&distance(p, *b))).expect("levels")
        };
        // The mean over the middle of the picture, because the chop stretches and squeezes the water in each pixel.
        let middle = (0..400).map(|i| level(&pixels[(20 + i / 20) * 60 + 20 + i % 20]));
        let seen = middle.sum::<f64>() / 400.0;
        let pixel_m = 2.0 * (25.0 * PI / 180.0).tan() * y_m / 60.0;
        let tap_m = pixel_m / 3f64.sqrt();
        let expected = (tap_m * 64.0 / plan.cascades[0].patch_m).log2().clamp(0.0, scale.high);
        assert!(expected > 0.0 && (seen - expected).abs() < 0.15, "{y_m} m: {seen}, not {expected}");
        eprintln!("{y_m} m: {seen}, expected {expected}");
    }
}

/// Twice as fine a mesh has more lines in the picture.
#[test]
fn the_wireframe_shows_the_mesh() {
    let mut pictures = Pictures::default();
    let mut bright = |mesh: f64| {
        let state = format!("wind=5&n=64&pitch=-35&mesh={mesh}");
        let pixels = pictures.render(&view(&state, DisplayedView::Surface(SurfaceView::Wireframe), 0), [480, 270]);
        pixels.iter().map(|p| f64::from(p[1])).sum::<f64>() / pixels.len() as f64
    };
    let (coarse, fine) = (bright(0.1), bright(0.4));
    assert!(fine > 1.3 * coarse, "{coarse} {fine}");
}
