//! Rows of the camera, of time and of resolution.

use super::{Field, Group, Kind, index_of, logarithmic, number};
use crate::state::params::{CameraMode, Units};
use crate::state::views::VIEWS;
use std::sync::LazyLock;

words!(MODES, MODE_WORDS, CameraMode,
    "fly" => CameraMode::Fly,
    "orbit" => CameraMode::Orbit,
    "buoy" => CameraMode::Buoy,
);
words!(UNITS, UNIT_WORDS, Units, "metric" => Units::Metric, "nautical" => Units::Nautical);

const SIZES: [u32; 5] = [64, 128, 256, 512, 1024];

/// The rows of one cascade.
macro_rules! patch_rows {
    ($i:literal, $number:literal) => {
        [
            row!(concat!("patch", $number), concat!("Patch ", $number), "m", Grid, number(0.0, 1e5), [grid.patches[$i].side_m],
                "Length scale of this cascade: side of its square patch; 0 lets the plan choose.").zero("auto"),
            row!(concat!("low", $number), concat!("Low cut-off ", $number), "rad/m", Grid, number(0.0, 1e4), [grid.patches[$i].k_low],
                "Waves of this cascade begin at this wave number; 0 lets the plan choose.").zero("auto"),
            row!(concat!("high", $number), concat!("High cut-off ", $number), "rad/m", Grid, number(0.0, 1e4), [grid.patches[$i].k_high],
                "Waves of this cascade end below this wave number; 0 lets the plan choose. Where cascades overlap they share the energy.").zero("auto"),
        ]
    };
}

/// Camera and time.
#[rustfmt::skip]
pub(super) fn camera() -> Vec<Field> { vec![
    row!("x", "East", "m", Camera, number(-1e6, 1e6), [camera.x_m],
        "Position of the camera east of the origin."),
    row!("y", "Height", "m", Camera, logarithmic(1.0, 5000.0), [camera.y_m],
        "Height of the camera above the still water; waves that come lift it, so that it is never under water."),
    row!("z", "South", "m", Camera, number(-1e6, 1e6), [camera.z_m],
        "Position of the camera south of the origin."),
    row!("heading", "Heading", "deg", Camera, Kind::Heading, [camera.heading_deg],
        "Viewing direction, clockwise from north."),
    row!("pitch", "Pitch", "deg", Camera, number(-89.0, 60.0), [camera.pitch_deg],
        "Viewing direction above (+) or below (-) the horizontal."),
    row!("fov", "Field of view", "deg", Camera, number(10.0, 100.0), [camera.fov_deg],
        "Vertical field of view; kept when the window changes shape."),
    row!("camera", "Mode", Camera, MODE_WORDS of MODES, [camera.mode],
        "fly: dragging looks around, the keys fly; orbit: the camera turns around the sea in the middle of the picture; buoy: it rides on the water, its height counted from the water below it."),
    row!("loop", "Loop", "s", Clock, number(0.0, 3600.0), [sea.loop_s],
        "Period after which the sea repeats exactly; 0 means never (a day). Every wave's frequency is rounded to fit.").zero("none"),
    row!("t", "Time", "s", Clock, number(0.0, 1e7), [clock.t_s],
        "Simulated time since the start of the sea."),
    row!("speed", "Speed", "x", Clock, number(0.0, 10.0), [clock.speed],
        "Simulated seconds per second."),
    row!("pause", "Paused", Clock, flag [clock.paused],
        "Stops the time."),
]}

/// Detail of the drawn surface.
#[rustfmt::skip]
pub(super) fn detail() -> Vec<Field> { vec![
    row!("mesh", "Mesh detail", "", View, logarithmic(0.1, 4.0), [look.mesh],
        "Number of vertices of the water mesh relative to the default, which follows the picture's pixels."),
    row!("extent", "Extent", "km", View, number(0.0, 300.0), [look.extent_km],
        "How far from the camera the sea is drawn; 0 is to the horizon.").zero("horizon"),
]}

/// Views of the maps and of the surface. What they are stands in `state/views.rs`.
pub(super) fn views() -> Vec<Field> {
    static WORDS: LazyLock<Vec<&str>> = LazyLock::new(|| VIEWS.iter().map(|(word, ..)| *word).collect());
    vec![
        row!("view", "View", "", View, Kind::Choice(WORDS.as_slice()),
            "What is shown instead of the picture (key V). Maps of the simulation, texel by texel: h0, initial spectrum; spectrum at this time; dx, height, dz, displacement; dxdz, dxdx, dzdz, its derivatives; slopex, slopez; momentxx, momentzz, momentxz, slope moments; jacobian of one cascade; foam and its source. On the surface: normals; folding, the Jacobian of the sum; roughness, slope variance within the pixel; mips; coverage of foam; wireframe.",
            |p| VIEWS.iter().position(|(_, shown, _)| *shown == p.look.view.shown).unwrap_or(0) as f64,
            |p, v| p.look.view.shown = VIEWS[v as usize].1),
        row!("viewcascade", "View of cascade", "", View, Kind::Integer { min: 0, max: 4 },
            "Cascade that a view shows, or level of the foam, the longest waves (the finest foam) first; 0 shows all side by side, and mips of the finest.",
            |p| f64::from(p.look.view.cascade), |p, v| p.look.view.cascade = v as u32).zero("all"),
    ]
}

/// How a window or a page shows it.
#[rustfmt::skip]
pub(super) fn screen() -> Vec<Field> { vec![
    row!("ui", "Panel", Screen, flag [screen.panel],
        "Whether the panel is shown; 0 for a page that is embedded in another. Key H."),
    row!("units", "Units", Screen, UNIT_WORDS of UNITS, [screen.units],
        "Units of the panel: metric, or feet, nautical miles and knots. The state string is always metric."),
    row!("renderscale", "Render scale", "", Screen, number(0.25, 2.0), [screen.render_scale],
        "Pixels of the picture along a side, over those of the window: less is faster and softer, more is smoother."),
    row!("adaptive", "Adaptive quality", Screen, flag [screen.adaptive],
        "Where frames take long the picture gets fewer pixels, and more again when there is time. The sea itself never changes by that."),
    row!("maxdpr", "Pixel ratio, at most", "", Screen, number(0.5, 4.0), [screen.most_dpr],
        "Most pixels of the picture per point of the window, along a side: phones and dense screens have more than anyone sees."),
]}

/// FFT size and cascades.
#[rustfmt::skip]
pub(super) fn grid() -> Vec<Field> { vec![
    row!("n", "FFT size", "", Grid, Kind::Choice(&["64", "128", "256", "512", "1024"]),
        "Samples along one side of a cascade. More adds shorter waves, and never changes those already there.",
        |p| SIZES.iter().position(|&n| n == p.grid.n).unwrap_or(2) as f64, |p, v| p.grid.n = SIZES[v as usize]),
    row!("cascades", "Cascades", "", Grid, Kind::Integer { min: 0, max: 4 },
        "Number of patches whose sum is the sea; 0 chooses for the sea at hand.",
        |p| f64::from(p.grid.cascades), |p, v| p.grid.cascades = v as u32).zero("auto"),
    row!("overlap", "Overlapping bands", Grid, flag [grid.overlap],
        "Each cascade carries all the waves that its lattice can, sharing their energy (amplitudes go with 1/sqrt(n)), instead of a band of its own."),
    row!("untile", "No repetition", Grid, flag [grid.untile],
        "The surface is blended from shifted copies of each patch, with weights that keep its statistics (Heitz and Neyret 2018); off shows the plainly periodic sum of patches."),
]}

/// The cascades as set by hand.
pub(super) fn patches() -> Vec<Field> {
    [patch_rows!(0, "1"), patch_rows!(1, "2"), patch_rows!(2, "3"), patch_rows!(3, "4")].concat()
}
