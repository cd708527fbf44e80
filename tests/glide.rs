//! From one sea to another: no jump on the way, the right height meanwhile, and exactly the sea of the state at the
//! end.

mod common;

use common::{gpu, params};
use seastate::gpu::Gpu;
use seastate::ocean::still::{PICTURE_FORMAT, draw_ocean_picture};
use seastate::ocean::{Ocean, OutputKind};
use seastate::point::StrongestWaves;
use seastate::sim::resources::MapKind;
use seastate::state::Params;
use seastate::waves::SeaChange;
use seastate::waves::second_order::BoundWaveTotals;
use std::sync::Arc;

const SIZE: [u32; 2] = [96, 64];
const FRAME_S: f64 = 1.0 / 60.0;
/// Frames after which a glide of 0.8 s is over.
const FRAMES: usize = 49;

/// A window without a window.
struct Window {
    gpu: Gpu,
    ocean: Ocean,
    params: Params,
}

impl Window {
    fn new(state: &str) -> Self {
        let gpu = gpu();
        let params = params(state);
        let ocean = Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &params);
        let mut window = Self { gpu, ocean, params };
        window.frame(0.0);
        window
    }

    /// The sea of a state; look, place and time stay.
    fn wish(&mut self, state: &str) {
        self.params.sea = params(state).sea;
    }

    /// One frame that comes `dt_s` after the last; time runs with it unless it stands.
    fn frame(&mut self, dt_s: f64) {
        let gpu = &self.gpu;
        if !self.params.clock.paused {
            self.params.clock.t_s += dt_s;
        }
        self.ocean.transition_to(&self.params, dt_s);
        let mut encoder = gpu.encoder("test");
        self.ocean.simulation().encode_with_f32_maps(gpu, &mut encoder, self.params.clock.t_s);
        gpu.submit(encoder);
    }

    /// The same at once.
    fn jump(&mut self) {
        self.ocean.set_params(&self.params);
    }

    fn picture(&mut self) -> Vec<u8> {
        pollster::block_on(draw_ocean_picture(&self.gpu, &mut self.ocean, SIZE)).expect("a picture")
    }

    /// Heights on the maps of every cascade that is drawn, with the side of its patch.
    fn heave_waves(&mut self) -> Vec<(f64, Vec<f64>)> {
        let gpu = &self.gpu;
        let mut encoder = gpu.encoder("test");
        let copy = self.ocean.simulation().resources.stage_maps(gpu, &mut encoder, MapKind::Displacement, 0);
        self.gpu.submit(encoder);
        let texels = pollster::block_on(copy.read_map(gpu)).expect("read-back");
        let n2 = (self.ocean.plan().n as usize).pow(2);
        let maps = self.ocean.simulation().maps();
        let layer = |layer: u32| texels[layer as usize * n2..][..n2].iter().map(|t| f64::from(t[1])).collect();
        maps.cascades.iter().map(|c| (c.patch_m, layer(c.layer))).collect()
    }

    /// The drawn sea at points of the plane, patches repeated: each cascade at its nearest texel.
    fn surface(&mut self) -> Vec<f64> {
        let n = self.ocean.plan().n as usize;
        let heights = self.heave_waves();
        (0..2000)
            .map(|i| {
                let at = [f64::from(i) * 37.17, f64::from(i) * 11.73];
                let texel = |patch: f64, axis: usize| ((at[axis] / patch).rem_euclid(1.0) * n as f64) as usize % n;
                heights.iter().map(|(patch, map)| map[texel(*patch, 1) * n + texel(*patch, 0)]).sum()
            })
            .collect()
    }

    /// Variance of the drawn sea: cascades are independent.
    fn variance(&mut self) -> f64 {
        self.heave_waves().iter().map(|(_, map)| mean(map.iter().map(|h| h * h))).sum()
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    mean(a.iter().zip(b).map(|(a, b)| (a - b).abs()))
}

/// Largest mean change from one frame to the next while time runs, over `frames` after `change`.
fn fastest(window: &mut Window, frames: usize, mut change: impl FnMut(&mut Window, usize)) -> f64 {
    let mut before = window.surface();
    let mut most = 0.0f64;
    for i in 0..frames {
        change(window, i);
        window.frame(FRAME_S);
        let now = window.surface();
        most = most.max(apart(&before, &now));
        before = now;
    }
    most
}

#[test]
fn a_glide_ends_exactly_on_the_state() {
    // Amplitudes, another rung, other frequencies, another number of cascades, no waves at all, and back.
    let start = "wind=9&n=64&t=20&pause=1";
    let mut window = Window::new(start);
    // Pictures at once depend on the state alone (tests/picture.rs).
    let mut still = Window::new(start);
    for sea in [
        "wind=9&height=1.2&chop=0.8",
        "wind=14&fetch=300",
        "wind=14&fetch=300&depth=6&level=1",
        "wind=2&fetch=5",
        "wind=0",
        "wind=9&loop=60&seed=5",
        "wind=9",
    ] {
        window.wish(&format!("{sea}&n=64"));
        still.params = window.params.clone();
        still.jump();
        let mut frames = 0;
        window.frame(FRAME_S);
        let mut between = Vec::new();
        while window.ocean.in_transition() {
            if frames == 20 {
                between = window.picture();
            }
            window.frame(FRAME_S);
            frames += 1;
        }
        assert!((45..=FRAMES).contains(&frames), "{sea}: {frames} frames");
        assert_eq!(window.ocean.still_water_level_m(), window.params.sea.still_water_level_m, "{sea}");
        let (got, want) = (window.picture(), still.picture());
        assert!(between != want, "{sea}: it takes its time");
        assert!(got == want, "{sea}: {} of 255 from the picture of the state", difference(&got, &want));
        let maps =
            [&mut window, &mut still].map(|w| common::read(&w.gpu, w.ocean.simulation(), w.params.clock.t_s).texels);
        assert!(maps[0] == maps[1], "{sea}: the maps");
    }
    let mut fresh = Window::new(&format!("{start}&fetch=100"));
    fresh.params = window.params.clone();
    fresh.ocean = Ocean::new(&fresh.gpu, PICTURE_FORMAT, OutputKind::Screen, &fresh.params);
    assert!(fresh.picture() == window.picture(), "a sea that was never another");
}

#[test]
fn bound_waves_go_from_one_sea_to_the_other() {
    // The second sea has another number of cascades.
    for to in ["wind=14&fetch=300&n=64", "wind=2&fetch=5&n=64", "wind=9&height=1.2&chop=0.8&n=64"] {
        let mut window = Window::new("wind=9&n=64&t=20&pause=1");
        let totals = |window: &mut Window| window.ocean.simulation().maps().bound_wave_totals();
        let goal = seastate::waves::Plan::new(&params(to)).bound_waves().totals;
        let before = totals(&mut window);
        // Part of the way that gain and factor have gone.
        let gone = |now: BoundWaveTotals| {
            [
                (now.elevation_gain - before.elevation_gain) / (goal.elevation_gain - before.elevation_gain),
                (now.mean.elevation - before.mean.elevation) / (goal.mean.elevation - before.mean.elevation),
            ]
        };
        window.wish(to);
        let mut last = [0.0; 2];
        while {
            window.frame(FRAME_S);
            window.ocean.in_transition()
        } {
            let now = gone(totals(&mut window));
            for (now, last) in now.iter().zip(last) {
                assert!(*now >= last && now - last < 0.07, "{to}: from {last} to {now} in a frame");
            }
            last = now;
        }
        assert!(last.iter().all(|part| *part > 0.9), "{to}: {last:?}");
        assert_eq!(totals(&mut window), goal, "{to}");
    }
}

#[test]
fn other_waves_fade_in_at_equal_power_and_without_a_jump() {
    // Other rungs; and the same rungs with other frequencies, late enough for all phases to be others.
    for (from, to) in [
        ("wind=9&fetch=100&n=64", "wind=12&fetch=200&n=64"),
        ("wind=9&fetch=100&n=64&depth=12", "wind=9&fetch=100&n=64&depth=9"),
        ("wind=9&fetch=100&n=64", "wind=9&fetch=100&n=64&seed=2"),
    ] {
        let state = format!("{from}&t=5000");
        let mut window = Window::new(&state);
        let rest = fastest(&mut window, 20, |_, _| {});
        let ends =
            [window.ocean.plan().hs_m(), seastate::waves::Plan::new(&params(to)).hs_m()].map(|hs| hs * hs / 16.0);
        let mut variances = Vec::new();
        let most = fastest(&mut window, FRAMES, |window, i| {
            if i == 0 {
                window.wish(to);
            } else {
                variances.push(window.variance());
            }
        });
        assert!(!window.ocean.in_transition());
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let (least, largest) = variances.iter().fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(*v), b.max(*v)));
        let mut other = Window::new(&state);
        let jump = fastest(&mut other, 1, |window, _| {
            window.wish(to);
            window.jump();
        });
        let rest = rest.max(fastest(&mut window, 20, |_, _| {}));
        eprintln!(
            "{from} to {to}: at rest {rest:.4} m a frame, gliding {most:.4}, at once {jump:.4}; variance {low:.4} to \
             {high:.4}, \
             seen {least:.4} to {largest:.4}"
        );
        assert!(least > 0.8 * low && largest < 1.2 * high, "{from} to {to}: {least} {largest}, {low} {high}");
        assert!(most < 3.0 * rest, "{from} to {to}: {most} against {rest}");
        assert!(jump > 5.0 * rest, "{from} to {to}: the measure sees a jump: {jump} against {rest}");
    }
}

#[test]
fn the_same_waves_grow_in_place() {
    let mut window = Window::new("hs=2&tp=8&n=64&t=30&pause=1");
    let start = window.surface();
    window.wish("hs=3&tp=8&n=64");
    let mut before = 1.0;
    for _ in 0..FRAMES {
        window.frame(FRAME_S);
        assert_eq!(window.ocean.simulation().maps().fading_cascade_count, 0, "one sea");
        let now = window.surface();
        // One factor for every height.
        let scale = start.iter().zip(&now).map(|(a, b)| a * b).sum::<f64>() / start.iter().map(|a| a * a).sum::<f64>();
        assert!(scale >= before - 1e-4 && scale < 1.5 + 1e-3 && scale - before < 0.05, "{before} to {scale}");
        let off = apart(&now, &start.iter().map(|a| a * scale).collect::<Vec<_>>());
        assert!(off < 2e-3, "{scale}: {off} m");
        before = scale;
    }
    assert!(!window.ocean.in_transition() && (before - 1.5).abs() < 1e-3, "{before}");
}

#[test]
fn a_drag_costs_one_spectrum_a_frame() {
    let mut window = Window::new("hs=2&tp=8&n=64&t=30");
    let rest = fastest(&mut window, 20, |_, _| {});
    let spectrum_pass_count = window.ocean.simulation().spectrum_pass_count();
    let allocations = window.ocean.simulation().resources.allocation_count;
    let generation = window.ocean.simulation().maps().view_generation;
    let most =
        fastest(&mut window, 30, |window, i| window.wish(&format!("hs={}&tp=8&n=64", 2.0 + 0.04 * (i + 1) as f64)));
    assert_eq!(window.ocean.simulation().spectrum_pass_count() - spectrum_pass_count, 30);
    // It follows while it is dragged, and comes to its end after the last change.
    let sea = window.ocean.scene(SIZE).sea;
    assert!(sea.hs_m > 2.5 && sea.hs_m < 3.2, "{}", sea.hs_m);
    for _ in 0..FRAMES {
        window.frame(FRAME_S);
    }
    assert!(!window.ocean.in_transition());
    let after = window.ocean.simulation().spectrum_pass_count();
    window.frame(FRAME_S);
    assert_eq!(window.ocean.simulation().spectrum_pass_count(), after, "at rest there is nothing to draw");
    assert_eq!(window.ocean.simulation().resources.allocation_count, allocations);
    assert_eq!(window.ocean.simulation().maps().view_generation, generation);
    let rest = rest.max(fastest(&mut window, 20, |_, _| {}));
    assert!(most < 1.5 * rest, "{most} against {rest}");
}

#[test]
fn a_change_costs_what_its_level_needs() {
    let start = "wind=16&n=64&t=30&pause=1&pitch=-15";
    for (key, values, level) in [
        ("foamdecay", [8.0, 12.0, 20.0], SeaChange::Foam),
        ("foambias", [0.05, 0.1, 0.2], SeaChange::Foam),
        ("chop", [0.9, 0.8, 0.7], SeaChange::Surface),
        ("level", [0.2, 0.5, 1.0], SeaChange::Surface),
        ("height", [0.9, 0.8, 0.7], SeaChange::Waves),
        ("depth", [30.0, 20.0, 10.0], SeaChange::Waves),
    ] {
        for at_once in [false, true] {
            let mut window = Window::new(start);
            let first = window.picture();
            let (plan, drawn) = (window.ocean.plan().clone(), window.ocean.drawn_seas()[0].plan.clone());
            let work = |window: &mut Window| {
                let sim = window.ocean.simulation();
                (sim.spectrum_pass_count(), sim.resources.wave_table_count)
            };
            let before = work(&mut window);
            for value in values {
                window.wish(&format!("wind=16&n=64&{key}={value}"));
                if at_once {
                    window.jump();
                }
                window.frame(FRAME_S);
            }
            while window.ocean.in_transition() {
                window.frame(FRAME_S);
            }
            let after = work(&mut window);
            let is_new = level == SeaChange::Waves;
            assert_eq!(after.0 > before.0, is_new, "{key}: spectrum passes");
            assert_eq!(after.1 > before.1, is_new, "{key}: tables");
            assert_eq!(
                !Arc::ptr_eq(&window.ocean.plan().spectrum_integrals, &plan.spectrum_integrals),
                is_new,
                "{key}: integrals of the spectrum"
            );
            if !at_once {
                let same = Arc::ptr_eq(&window.ocean.drawn_seas()[0].plan, &drawn);
                assert_eq!(same, level == SeaChange::Foam, "{key}: heights on the CPU");
            }
            let picture = window.picture();
            assert!(picture != first, "{key} is visible");
            let mut fresh = Window::new(start);
            fresh.params = window.params.clone();
            fresh.ocean = Ocean::new(&fresh.gpu, PICTURE_FORMAT, OutputKind::Screen, &fresh.params);
            assert!(fresh.picture() == picture, "{key}: the picture of an ocean that was never another");
            let maps = [&mut window, &mut fresh]
                .map(|w| common::read(&w.gpu, w.ocean.simulation(), w.params.clock.t_s).texels);
            assert!(maps[0] == maps[1], "{key}: the maps");
        }
    }
}

#[test]
fn foam_during_other_transitions_lets_them_end() {
    for waves in ["wind=9&n=64&height=1.3", "wind=14&fetch=300&n=64"] {
        let mut window = Window::new("wind=9&n=64&t=30&pause=1");
        window.wish(waves);
        for i in 0..5 {
            window.frame(FRAME_S);
            window.wish(&format!("{waves}&foamdecay={}", 5 + i));
        }
        // A third sea waits for the end of the cross-fade, and its foam with it.
        window.wish(&format!("{waves}&foamdecay=9&seed=3"));
        window.frame(FRAME_S);
        window.wish(&format!("{waves}&foamdecay=12&seed=3"));
        for _ in 0..3 * FRAMES {
            window.frame(FRAME_S);
        }
        assert!(!window.ocean.in_transition());
        let mut fresh = Window::new("wind=9&n=64&t=30&pause=1");
        fresh.params = window.params.clone();
        fresh.ocean = Ocean::new(&fresh.gpu, PICTURE_FORMAT, OutputKind::Screen, &fresh.params);
        assert_eq!(window.ocean.plan(), fresh.ocean.plan(), "{waves}");
        assert!(fresh.picture() == window.picture(), "{waves}");
    }
}

#[test]
fn a_drag_over_rungs_and_depths_has_no_jump() {
    for (from, to) in [
        // Twice around the ladder, and frequencies that change in every frame.
        (
            "wind=6&fetch=100&n=64&t=3000",
            Box::new(|i: usize| format!("wind={}&fetch=100&n=64", 6.0 + 0.1 * i as f64))
                as Box<dyn Fn(usize) -> String>,
        ),
        (
            "wind=9&fetch=100&n=64&t=3000&depth=20",
            Box::new(|i: usize| format!("wind=9&fetch=100&n=64&depth={}", 20.0 - 0.2 * i as f64)),
        ),
    ] {
        let mut window = Window::new(from);
        let before = fastest(&mut window, 20, |_, _| {});
        let most = fastest(&mut window, 60, |window, i| window.wish(&to(i)));
        let mut allocations = window.ocean.simulation().resources.allocation_count;
        for _ in 0..3 * FRAMES {
            window.frame(FRAME_S);
        }
        assert!(!window.ocean.in_transition());
        let after = fastest(&mut window, 20, |_, _| {});
        eprintln!("{from}: {before:.4} m a frame before, {most:.4} at most, {after:.4} after");
        assert!(most < 3.0 * before.max(after), "{from}: {before} {most} {after}");
        // A second room is made once.
        for state in [from, &to(5)] {
            window.wish(&state.replace("&t=3000", ""));
            allocations = allocations.max(window.ocean.simulation().resources.allocation_count);
            for _ in 0..FRAMES {
                window.frame(FRAME_S);
            }
        }
        assert!(window.ocean.simulation().resources.allocation_count <= allocations + 1);
    }
}

#[test]
fn a_boat_stays_on_the_water() {
    for (from, to) in [
        ("wind=9&n=64&untile=0&order=1", "wind=9&n=64&height=1.5&untile=0&order=1"),
        ("wind=9&n=64&untile=0&order=1", "wind=14&n=64&untile=0&order=1"),
    ] {
        let mut window = Window::new(&format!("{from}&t=40&pause=1"));
        window.wish(to);
        for _ in 0..17 {
            window.frame(FRAME_S);
        }
        let seas = window.ocean.drawn_seas();
        assert_eq!(seas.len(), 2, "{to}");
        // Each cascade alone, on its own texels.
        let n = window.ocean.plan().n as usize;
        let mut maps = window.heave_waves();
        let fades = window.ocean.simulation().maps().fading_cascade_count > 0;
        if !fades {
            maps.truncate(seas[0].amplitude_factors.len());
        }
        for (c, (patch, map)) in maps.iter().enumerate() {
            for at in [[3, 5], [40, 17], [22, 60]] {
                let place = at.map(|i| i as f64 / n as f64 * patch);
                let want: f64 = (seas.iter().enumerate())
                    .filter_map(|(s, sea)| {
                        let first = if fades && s == 1 { seas[0].amplitude_factors.len() } else { 0 };
                        let own = c.checked_sub(first).filter(|own| *own < sea.amplitude_factors.len())?;
                        let mut plan = (*sea.plan).clone();
                        plan.cascades = vec![plan.cascades[own].clone()];
                        let level = plan.sea.still_water_level_m;
                        let sample =
                            StrongestWaves::new(&plan, usize::MAX).sample_undisplaced(place[0], place[1], 40.0);
                        Some(sea.amplitude_factors[own] * (sample.height_m - level))
                    })
                    .sum();
                let got = map[at[1] * n + at[0]];
                assert!((got - want).abs() < 2e-3 * seas[0].plan.hs_m(), "{to}: cascade {c} at {at:?}: {got} {want}");
            }
        }
        for _ in 0..FRAMES {
            window.frame(FRAME_S);
        }
        let rest = window.ocean.drawn_seas();
        assert_eq!((rest.len(), &rest[0].amplitude_factors), (1, &vec![1.0; rest[0].amplitude_factors.len()]));
        assert_eq!(&*rest[0].plan, window.ocean.plan());
    }
}

#[test]
fn the_picture_does_not_jump_either() {
    // Depth, colours of the water over a bed, roughness: the largest change between neighbouring stills of a glide is a
    // small part of the whole way.
    for (from, to) in
        [("wind=8&n=64&depth=30&pitch=-25", "wind=8&n=64&depth=4&pitch=-25"), ("wind=8&n=64", "wind=20&fetch=400&n=64")]
    {
        let mut window = Window::new(&format!("{from}&t=20&pause=1"));
        let first = window.picture();
        window.wish(to);
        let mut before = first.clone();
        let mut most = 0.0f64;
        for _ in 0..FRAMES - 2 {
            window.frame(FRAME_S);
            let now = window.picture();
            most = most.max(difference(&before, &now));
            before = now;
        }
        let whole = difference(&first, &before).max(4.0);
        eprintln!("{from} to {to}: {most:.2} of {whole:.2}");
        assert!(most < 0.15 * whole, "{from} to {to}: {most} of {whole}");
    }
}

/// Mean difference of the pixels' bytes.
fn difference(a: &[u8], b: &[u8]) -> f64 {
    mean(a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b))))
}
