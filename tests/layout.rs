//! The layout of the interface at the sizes of phones, tablets and screens: no text is cut, lies over another text, or
//! leaves the window. The ignored test saves a picture of each state of the interface to look at.

mod common;

use common::harness::open;
use egui::epaint::{ClippedShape, Shape};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use seastate::app::language::tr;
use seastate::app::{App, SafeArea};
use seastate::state::params::Language;

/// Sizes of windows, points, and pixels per point.
const SIZES: [([f32; 2], f32); 9] = [
    ([360.0, 640.0], 1.0),
    ([390.0, 844.0], 2.0),
    ([390.0, 844.0], 3.0),
    ([640.0, 360.0], 1.0),
    ([844.0, 390.0], 1.0),
    ([768.0, 1024.0], 1.0),
    ([1280.0, 720.0], 1.0),
    ([1920.0, 1080.0], 1.0),
    ([3840.0, 2160.0], 1.0),
];
/// Factors of the text's size that are checked, as browsers and systems zoom.
const ZOOMS: [f32; 2] = [1.0, 1.5];
/// Parts of the interface that are opened in turn.
const TABS: [&str; 5] = ["Seas", "Weather", "View", "Study", "Share"];
/// Most by which texts may touch: bounds of letters are a little larger than what one sees, points.
const TOUCH_POINTS: f32 = 2.0;

/// The sentence about a spectrum.
const ENERGY_BY_PERIOD: &str =
    "Energy by wave period, m²/Hz: each peak is one group of waves, long waves at the left, short ones at the right.";

/// The visible texts of a frame: each with its bounds and the rectangle to which it is clipped.
fn texts(shapes: &[ClippedShape]) -> Vec<(String, egui::Rect, egui::Rect)> {
    let mut found = Vec::new();
    let mut add = |shape: &Shape, clip: egui::Rect| {
        if let Shape::Text(text) = shape {
            let bounds = text.visual_bounding_rect();
            if bounds.is_positive() && bounds.intersects(clip.shrink(1.0)) {
                found.push((text.galley.text().to_owned(), bounds, clip));
            }
        }
    };
    for shape in shapes {
        match &shape.shape {
            Shape::Vec(parts) => parts.iter().for_each(|part| add(part, shape.clip_rect)),
            one => add(one, shape.clip_rect),
        }
    }
    found
}

/// What is wrong with the layout of a frame's texts.
fn faults(shapes: &[ClippedShape], window: egui::Rect) -> Vec<String> {
    let texts = texts(shapes);
    let mut faults = Vec::new();
    for (i, (text, bounds, clip)) in texts.iter().enumerate() {
        // Lists scroll up and down, so only what is cut at the sides is a fault.
        let room = clip.intersect(window).expand(TOUCH_POINTS);
        if bounds.left() < room.left() || bounds.right() > room.right() {
            faults.push(format!("{text:?} is cut: {bounds} of {room}"));
        }
        let seen = bounds.intersect(*clip).shrink(TOUCH_POINTS / 2.0);
        for (other, at, other_clip) in &texts[i + 1..] {
            if seen.is_positive() && at.intersect(*other_clip).shrink(TOUCH_POINTS / 2.0).intersects(seen) {
                faults.push(format!("{text:?} at {bounds} lies over {other:?} at {at}"));
            }
        }
    }
    faults
}

/// An error text if the panel of a wide window reaches below the window's lower edge: rows below that edge cannot be
/// scrolled into view.
fn panel_outside(harness: &Harness<'static, App>) -> Option<String> {
    let window = harness.ctx.content_rect();
    let panel = harness.ctx.memory(|m| m.area_rect(egui::Id::unique("panel")))?;
    let is_outside = window.width() >= 640.0 && !window.expand(0.5).contains_rect(panel);
    is_outside.then(|| format!("the panel {panel} leaves the window {window}"))
}

/// Opens each part of the interface at each size, and passes it to `look` with its name.
fn visit(zooms: &[f32], languages: &[&str], mut look: impl FnMut(&mut Harness<'static, App>, &str)) {
    for (size, pixels_per_point) in SIZES {
        for zoom in zooms.iter().copied() {
            for language in languages {
                let [width, height] = size;
                let place = format!("{width}x{height}-at-{pixels_per_point}-zoom-{zoom}-{language}");
                let mut harness = open(&format!("n=64&pause=1&lang={language}"), size, pixels_per_point * zoom);
                harness.set_size(egui::vec2(width / zoom, height / zoom));
                harness.ctx.all_styles_mut(|style| style.animation_time = 0.0);
                harness.run_steps(4);
                look(&mut harness, &format!("{place}-start"));
                harness.state_mut().offer_first_steps();
                for number in 1.. {
                    harness.run_steps(4);
                    let buttons = ["Next", "Done"].map(tr);
                    let button = buttons.into_iter().find_map(|name| harness.query_by_label(name));
                    let Some(button) = button else { break };
                    button.click_accesskit();
                    look(&mut harness, &format!("{place}-hint-{number}"));
                }
                for tab in TABS {
                    if let Some(button) = harness.query_by_label(tr(tab)) {
                        button.click_accesskit();
                        harness.run_steps(6);
                        look(&mut harness, &format!("{place}-{}", tab.to_lowercase()));
                    }
                    let plots = harness.query_by_label(tr("Spectrum and other plots")).filter(|_| tab == "Study");
                    if let Some(header) = plots {
                        header.click_accesskit();
                        harness.run_steps(6);
                        look(&mut harness, &format!("{place}-plots"));
                    }
                }
                harness.key_press(egui::Key::F1);
                harness.run_steps(4);
                look(&mut harness, &format!("{place}-keys"));
            }
        }
    }
}

#[test]
fn no_text_is_cut_or_covered() {
    let mut found = Vec::new();
    let (mut looks, mut hints) = (0, 0);
    let mut look = |harness: &mut Harness<'static, App>, place: &str| {
        looks += 1;
        hints += usize::from(place.contains("-hint-"));
        // The list of keys lies over everything else.
        if place.ends_with("keys") {
            return;
        }
        let window = harness.ctx.content_rect();
        found.extend(panel_outside(harness).map(|fault| format!("{place}: {fault}")));
        found.extend(faults(&harness.output().shapes, window).into_iter().map(|fault| format!("{place}: {fault}")));
    };
    visit(&ZOOMS, &["en"], &mut look);
    visit(&[1.0], Language::WORDS, &mut look);
    // Only windows that are short and large of text at the same time may lack the room for a hint.
    let windows = SIZES.len() * (ZOOMS.len() + Language::WORDS.len());
    assert!(hints >= 4 * (windows - 2), "{hints} hints in {windows} windows");
    assert!(looks >= SIZES.len() * ZOOMS.len() * (TABS.len() + 2), "{looks}");
    assert!(found.is_empty(), "{} faults:\n{}", found.len(), found.join("\n"));
}

/// The panel of a wide window covers nothing at either side of it and at any width, and what the user chose is kept.
#[test]
fn the_panel_moves_and_changes_its_width_without_covering_anything() {
    let folder = std::env::temp_dir().join(format!("seastate-panel-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    for size in [[844.0, 390.0], [768.0, 1024.0], [1280.0, 720.0]] {
        let mut harness = open("n=64&pause=1&view=heights", size, 1.0);
        harness.state_mut().set_save_folder(folder.clone());
        // Older versions stored the place and the width of the panel in panel.txt, which is still read.
        std::fs::remove_file(folder.join("preferences.txt")).ok();
        std::fs::write(folder.join("panel.txt"), "side=left width=390").expect("a file");
        harness.state_mut().load_preferences();
        harness.run_steps(3);
        let press = |harness: &mut Harness<'static, App>, handle: &str, key: egui::Key, times: usize| {
            harness.get_by_label(handle).focus();
            harness.run_steps(2);
            for _ in 0..times {
                harness.key_press(key);
                harness.run_steps(2);
            }
        };
        let panel = |harness: &Harness<'static, App>| {
            harness.ctx.memory(|m| m.area_rect(egui::Id::unique("panel"))).expect("a panel")
        };
        assert!(panel(&harness).center().x < 0.5 * size[0], "{}", panel(&harness));
        press(&mut harness, "Width of the panel", egui::Key::ArrowLeft, 1);
        assert!(!folder.join("panel.txt").exists(), "the older file is not needed any more");
        press(&mut harness, "Side of the panel", egui::Key::ArrowRight, 1);
        let usual = panel(&harness);
        assert!(usual.center().x > 0.5 * size[0], "{usual}");
        let check = |harness: &mut Harness<'static, App>, what: &str| {
            let window = harness.ctx.content_rect();
            let found: Vec<_> =
                panel_outside(harness).into_iter().chain(faults(&harness.output().shapes, window)).collect();
            assert!(found.is_empty(), "{size:?}, {what}: {found:?}");
            let summary = harness.ctx.memory(|m| m.area_rect(egui::Id::unique("summary"))).expect("a summary");
            assert!(!summary.intersects(panel(harness)), "{size:?}, {what}: {summary} {}", panel(harness));
        };
        press(&mut harness, "Side of the panel", egui::Key::ArrowLeft, 1);
        assert!(panel(&harness).center().x < 0.5 * size[0], "{}", panel(&harness));
        check(&mut harness, "left");
        press(&mut harness, "Width of the panel", egui::Key::ArrowRight, 4);
        let wide = panel(&harness);
        assert!((wide.width() - usual.width() - 80.0).abs() < 1.0, "{size:?}: {usual} {wide}");
        check(&mut harness, "left and wide");
        let kept = std::fs::read_to_string(folder.join("preferences.txt")).expect("the place is kept");
        assert!(kept.ends_with("side=left\nwidth=450\n"), "{kept}");
        press(&mut harness, "Width of the panel", egui::Key::ArrowLeft, 20);
        check(&mut harness, "left and narrow");
        press(&mut harness, "Side of the panel", egui::Key::ArrowRight, 1);
        check(&mut harness, "right and narrow");
        // A drag of the handle takes the panel along and leaves it at the nearer edge.
        let grip = harness.get_by_label("Side of the panel").rect().center();
        harness.drag_at(grip);
        harness.run_steps(2);
        for x in [0.7, 0.5, 0.3] {
            harness.hover_at(egui::pos2(x * size[0], grip.y));
            harness.run_steps(2);
        }
        harness.drop_at(egui::pos2(0.1 * size[0], grip.y));
        harness.run_steps(4);
        assert!(panel(&harness).left() < 20.0, "{}", panel(&harness));
        check(&mut harness, "dragged");
        assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    }
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}

/// A notch and the system's bar cover nothing but the picture, which fills the screen.
#[test]
fn the_safe_area_keeps_text_away_from_the_edges() {
    let phone = SafeArea { top: 47.0, right: 0.0, bottom: 34.0, left: 0.0 };
    let on_its_side = SafeArea { top: 0.0, right: 47.0, bottom: 21.0, left: 47.0 };
    for (size, safe) in [([390.0, 844.0], phone), ([844.0, 390.0], on_its_side)] {
        let mut harness = open("n=64&pause=1", size, 1.0);
        harness.ctx.all_styles_mut(|style| style.animation_time = 0.0);
        let whole = harness.state().picture_size();
        harness.state_mut().set_safe_area(safe);
        // The harness has no host that calls the hook.
        let (ctx, mut input) = (harness.ctx.clone(), egui::RawInput::default());
        eframe::App::raw_input_hook(harness.state_mut(), &ctx, &mut input);
        harness.input_mut().safe_area_insets = input.safe_area_insets;
        harness.run_steps(4);
        let inside = egui::Rect::from_min_max(
            egui::pos2(safe.left, safe.top),
            egui::pos2(size[0] - safe.right, size[1] - safe.bottom),
        );
        for tab in ["", "Weather", "Study"] {
            if let Some(button) = harness.query_by_label(tab).filter(|_| !tab.is_empty()) {
                button.click_accesskit();
                harness.run_steps(6);
            }
            for (text, bounds, clip) in texts(&harness.output().shapes) {
                let seen = bounds.intersect(clip);
                assert!(inside.expand(1.0).contains_rect(seen), "{tab}: {text:?} at {seen} of {inside}");
            }
            let picture = harness.state().picture_size();
            assert_eq!(picture[0], whole[0], "{tab}: the picture has the screen's width");
            if size[0] > size[1] || tab.is_empty() {
                let taken = if size[0] > size[1] { 0 } else { safe.bottom as u32 };
                assert_eq!(picture[1], whole[1] - taken, "{tab}: the picture reaches under the notch");
            }
        }
    }
}

/// The map of a coast with a gauge and its plots, in windows as wide as a phone and as a screen, and high enough to
/// show all of it, in every language.
#[test]
fn the_map_of_the_coast_is_not_cut() {
    let sea = "coast=beach&depth=12&hs=1.5&tp=9&dir=255&n=64&pause=1&mesh=0.1&renderscale=0.25";
    for size in [[390.0, 6400.0], [1280.0, 2000.0]] {
        let mut harness = open(sea, size, 1.0);
        harness.ctx.all_styles_mut(|style| style.animation_time = 0.0);
        for _ in 0..6000 {
            harness.run_steps(1);
            if harness.state().is_coast_shown() {
                break;
            }
            std::thread::park_timeout(std::time::Duration::from_millis(10));
        }
        for language in Language::WORDS {
            harness.state_mut().set_state(&format!("{sea}&lang={language}"));
            harness.run_steps(4);
            // The names of the headers are those of the language, so each map is made anew.
            if harness.query_by_label(tr("Map of the coast")).is_none() {
                harness.get_by_label(tr("Weather")).click_accesskit();
                harness.run_steps(6);
            }
            let map = tr("Map: {quantity}").replace("{quantity}", tr("Wave height"));
            if harness.query_by_label(&map).is_none() {
                harness.run_steps(200);
            }
            harness.get_by_label(&map);
            let number = |text: &str| tr(text).replace("{number}", "1");
            if harness.query_by_label(&number("Gauge {number}")).is_none() {
                harness.get_by_label(tr("Gauge at the camera")).click_accesskit();
                harness.run_steps(3);
            }
            harness.get_by_label(&number("Gauge {number}"));
            if harness.query_by_label_contains(tr(ENERGY_BY_PERIOD)).is_none() {
                harness.get_by_label(&number("Plots of gauge {number}")).click_accesskit();
                harness.run_steps(50);
            }
            let found = faults(&harness.output().shapes, harness.ctx.content_rect());
            assert!(found.is_empty(), "{size:?} {language}: {found:#?}");
        }
        assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    }
}

/// The check finds a planted fault of each kind.
#[test]
fn the_check_finds_faults() {
    let context = egui::Context::default();
    let mut output = context.run_ui(egui::RawInput::default(), |ui| {
        let painter = ui.painter();
        let colour = egui::Color32::WHITE;
        for at in [[10.0, 10.0], [20.0, 12.0], [-10.0, 90.0]] {
            painter.text(at.into(), egui::Align2::LEFT_TOP, "planted", egui::FontId::default(), colour);
        }
    });
    let found = faults(&output.shapes, egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(200.0, 200.0)));
    output.textures_delta.clear();
    assert_eq!(found.len(), 2, "{found:?}");
}

#[test]
#[ignore = "saves pictures to look at"]
fn pictures_of_every_state() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("interface");
    std::fs::create_dir_all(&folder).expect("a folder");
    visit(&[1.0], &["en"], |harness, place| {
        let picture = harness.render().expect("a picture");
        picture.save(folder.join(format!("{place}.png"))).expect("a file");
    });
}
