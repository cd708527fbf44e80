//! The first minute of a visitor: hints, going from sea to sea, the day in time-lapse, and the camera that moves while
//! nobody touches anything.

mod common;

use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use seastate::app::App;
use seastate::state::presets;
use seastate::state::{Params, query};

fn open(state: &str) -> Harness<'static, App> {
    common::harness::open(state, [900.0, 700.0], 1.0)
}

fn params(harness: &Harness<'_, App>) -> Params {
    query::parse(&harness.state().state()).0
}

fn click(harness: &mut Harness<'_, App>, label: &str) {
    harness.get_by_label(label).click();
    harness.run_steps(6);
}

/// Drags the pointer from one place of the window to another.
fn drag(harness: &mut Harness<'_, App>, from: [f32; 2], to: [f32; 2]) {
    harness.drag_at(from.into());
    harness.run_steps(1);
    for share in [0.3, 0.7, 1.0] {
        let at = egui::lerp(from[0]..=to[0], share);
        harness.hover_at(egui::pos2(at, egui::lerp(from[1]..=to[1], share)));
        harness.run_steps(1);
    }
    harness.drop_at(to.into());
    harness.run_steps(3);
}

/// Name of the named sea that is shown.
fn shown_sea(harness: &Harness<'_, App>) -> Option<&'static str> {
    let now = params(harness);
    presets::built_in().iter().find(|sea| sea.shows_sea_of(&now)).map(|sea| sea.name.as_str())
}

#[test]
fn the_day_runs_from_the_sun_that_is_shown() {
    let mut harness = open("n=64&pause=1&t=100&sun=12&sunaz=20");
    let sun = |harness: &Harness<'_, App>| {
        let now = params(harness);
        now.look.sky.at_time(now.clock.t_s).sun_direction()
    };
    let apart_deg =
        |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>().min(1.0).acos().to_degrees();
    let start = sun(&harness);
    click(&mut harness, "View");
    click(&mut harness, "Time-lapse of the day");
    let state = harness.state().state();
    assert!(state.contains("sunby=date") && state.contains("daylight=4") && !state.contains("pause"), "{state}");
    assert!(apart_deg(sun(&harness), start) < 0.5, "{state}");
    harness.get_by_label_contains("The sun rises at");
    harness.run_steps(300);
    // Five seconds are a third of an hour, in which the sun moves by up to five degrees.
    let later = sun(&harness);
    assert!((2.0..5.6).contains(&apart_deg(later, start)), "{}", apart_deg(later, start));
    harness.key_press(egui::Key::Space);
    harness.run_steps(2);
    let stopped = sun(&harness);
    click(&mut harness, "Time-lapse of the day");
    let state = harness.state().state();
    assert!(state.contains("sunby=date") && !state.contains("daylight"), "{state}");
    assert!(apart_deg(sun(&harness), stopped) < 0.2, "the sun stays where the day ended");
    click(&mut harness, "Weather");
    harness.get_by_label("Place the sun by hand").scroll_to_me();
    harness.run_steps(6);
    click(&mut harness, "Place the sun by hand");
    assert!(!harness.state().state().contains("sunby"), "{}", harness.state().state());
    assert!(apart_deg(sun(&harness), stopped) < 0.3);
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

#[test]
fn arrows_and_swipes_go_from_sea_to_sea_and_the_camera_stays() {
    let mut harness = open("n=64&pause=1");
    let camera = params(&harness).camera;
    harness.key_press(egui::Key::ArrowRight);
    harness.run_steps(2);
    let flown = params(&harness).camera;
    assert!(flown != camera && shown_sea(&harness).is_none(), "in the weather tab the arrows fly");
    click(&mut harness, "Seas");
    let mut seen = Vec::new();
    for _ in presets::built_in() {
        harness.key_press(egui::Key::ArrowRight);
        harness.run_steps(3);
        seen.push(shown_sea(&harness).expect("a named sea"));
    }
    let names: Vec<&str> = presets::built_in().iter().map(|sea| sea.name.as_str()).collect();
    assert_eq!(seen, names, "from the first to the last");
    for expected in [names[names.len() - 2], names[names.len() - 3]] {
        harness.key_press(egui::Key::ArrowLeft);
        harness.run_steps(3);
        assert_eq!(shown_sea(&harness), Some(expected));
    }
    // A coast is seen from a place of its own. The other seas leave the camera where it is.
    let position = |harness: &Harness<'_, App>| [params(harness).camera.x_m, params(harness).camera.z_m];
    let is_coast = |harness: &Harness<'_, App>| params(harness).coast.is_on();
    while is_coast(&harness) {
        let before = position(&harness);
        harness.key_press(egui::Key::ArrowLeft);
        harness.run_steps(3);
        assert_eq!(position(&harness) != before, is_coast(&harness));
    }
    let before = position(&harness);
    harness.key_press(egui::Key::ArrowLeft);
    harness.run_steps(3);
    assert!(!is_coast(&harness));
    assert_eq!(position(&harness), before);

    // A swipe to the left goes on, one to the right back; a drag up or down and a short one leave the sea.
    harness.run_steps(20);
    let from = names.iter().position(|name| Some(*name) == shown_sea(&harness)).expect("a sea");
    // The message with the name has the same label.
    let is_card = |node: &egui_kittest::Node<'_>| node.accesskit_node().role() == egui::accesskit::Role::Button;
    let card = harness.get_all_by_label(names[from]).find(is_card).expect("a card").rect().center();
    let [x, y] = [card.x, card.y];
    drag(&mut harness, [x, y], [x - 90.0, y + 10.0]);
    assert_eq!(shown_sea(&harness), Some(names[from + 1]));
    harness.run_steps(20);
    drag(&mut harness, [x - 60.0, y], [x + 60.0, y]);
    assert_eq!(shown_sea(&harness), Some(names[from]));
    for to in [[x, y - 120.0], [x + 60.0, y + 60.0], [x - 30.0, y]] {
        drag(&mut harness, [x, y], to);
        assert_eq!(shown_sea(&harness), Some(names[from]), "{to:?}");
    }
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

#[test]
fn hints_end_by_what_they_ask_for() {
    let mut harness = open("n=64&pause=1");
    assert!(harness.query_by_label("Drag to look around").is_none(), "only who is new is offered hints");
    harness.state_mut().offer_first_steps();
    harness.run_steps(3);
    harness.get_by_label("Drag to look around");
    drag(&mut harness, [200.0, 500.0], [300.0, 480.0]);
    harness.get_by_label("Change the wind");
    assert!(harness.query_by_label("Drag to look around").is_none());
    let set_force = |harness: &mut Harness<'_, App>, force: f64| {
        let is_slider = |node: &egui_kittest::Node<'_>| node.accesskit_node().role() != egui::accesskit::Role::Label;
        harness.get_all_by_label("Beaufort").find(is_slider).expect("a slider").set_value_accesskit(force);
        harness.run_steps(4);
    };
    set_force(&mut harness, 5.0);
    harness.get_by_label("Try a storm");
    set_force(&mut harness, 9.0);
    harness.get_by_label("Share it");
    click(&mut harness, "Share");
    assert!(harness.query_by_label("Share it").is_none());
    harness.state_mut().offer_first_steps();
    harness.run_steps(3);
    assert!(harness.query_by_label("Drag to look around").is_none(), "they never come back");
}

#[test]
fn hints_go_on_by_a_button_and_can_be_skipped() {
    let mut harness = open("n=64&pause=1");
    harness.state_mut().offer_first_steps();
    harness.run_steps(3);
    for title in ["Drag to look around", "Change the wind", "Try a storm"] {
        harness.get_by_label(title);
        // By keyboard: focus, and the key that presses a button.
        harness.get_by_label("Next").focus();
        harness.run_steps(2);
        harness.key_press(egui::Key::Enter);
        harness.run_steps(3);
    }
    harness.get_by_label("Share it");
    assert!(harness.query_by_label("Skip the hints").is_none(), "the last hint is done, not skipped");
    click(&mut harness, "Done");
    assert!(harness.query_by_label("Share it").is_none());
    for skip in ["button", "Escape"] {
        let mut harness = open("n=64&pause=1");
        harness.state_mut().offer_first_steps();
        harness.run_steps(3);
        if skip == "button" {
            click(&mut harness, "Skip the hints");
        } else {
            harness.key_press(egui::Key::Escape);
            harness.run_steps(3);
        }
        assert!(harness.query_by_label("Drag to look around").is_none(), "{skip}");
        harness.state_mut().offer_first_steps();
        harness.run_steps(3);
        assert!(harness.query_by_label("Drag to look around").is_none(), "{skip}");
    }
    for interface in ["0", "mini"] {
        let mut harness = open(&format!("n=64&pause=1&ui={interface}"));
        harness.state_mut().offer_first_steps();
        harness.run_steps(3);
        assert!(harness.query_by_label("Drag to look around").is_none(), "ui={interface}");
    }
}

#[test]
fn a_drag_of_the_camera_is_undone_in_one_step() {
    let mut harness = open("n=64&pause=1&heading=40&wind=9");
    harness.run_steps(40);
    drag(&mut harness, [200.0, 500.0], [300.0, 480.0]);
    harness.run_steps(40);
    let turned = params(&harness).camera;
    assert!((turned.heading_deg - 40.0).abs() > 3.0, "{turned:?}");
    click(&mut harness, "Undo");
    assert_eq!(harness.state().state(), "wind=9&pause=1&n=64");
    click(&mut harness, "Redo");
    assert_eq!(params(&harness).camera, turned);
}

/// A window whose time runs with the speed 0, so that only the camera can change the picture.
fn open_left_alone(allows: bool) -> Harness<'static, App> {
    let mut harness = Harness::builder()
        .with_size(egui::vec2(900.0, 500.0))
        .with_pixels_per_point(1.0)
        .with_step_dt(0.1)
        .wgpu_setup(seastate::app::setup::wgpu_configuration().wgpu_setup)
        .build_eframe(|cc| App::new(cc, "n=64&speed=0&adaptive=0&renderscale=0.25").expect("a device"));
    if allows {
        harness.state_mut().allow_slow_camera();
    }
    while !harness.state().is_picture_complete() {
        harness.run_steps(1);
        harness.render().expect("a picture");
    }
    harness
}

/// A part of the picture that neither the panel nor the text at the top left covers.
fn sea(harness: &mut Harness<'_, App>) -> Vec<u8> {
    harness.run_steps(2);
    let picture = harness.render().expect("a picture");
    image::imageops::crop_imm(&picture, 20, 200, 380, 280).to_image().into_raw()
}

#[test]
fn the_camera_moves_while_nobody_touches_and_the_state_stays() {
    let mut harness = open_left_alone(true);
    let (state, at_rest) = (harness.state().state(), sea(&mut harness));
    harness.run_steps(150);
    assert!(sea(&mut harness) == at_rest, "it waits");
    harness.run_steps(250);
    assert!(sea(&mut harness) != at_rest, "it moves");
    assert_eq!(harness.state().state(), state);
    harness.key_press(egui::Key::F9);
    harness.run_steps(12);
    assert!(sea(&mut harness) == at_rest, "it returns");
    // The pointer rests on the panel, where a click has switched it off; then it leaves.
    click(&mut harness, "View");
    click(&mut harness, "Slow camera while nobody touches");
    harness.run_steps(400);
    assert!(sea(&mut harness) == at_rest, "switched off");
    click(&mut harness, "Slow camera while nobody touches");
    harness.run_steps(400);
    assert!(sea(&mut harness) == at_rest, "the panel is used");
    // Beside the part that is compared, because pictures of the test show the pointer.
    harness.hover_at(egui::pos2(440.0, 400.0));
    harness.run_steps(400);
    assert!(sea(&mut harness) != at_rest, "switched on again");
    harness.key_press(egui::Key::Space);
    harness.run_steps(30);
    let stopped = sea(&mut harness);
    harness.run_steps(400);
    assert!(
        sea(&mut harness) == stopped && harness.state().state().contains("pause=1"),
        "not while the time stands still"
    );
    let mut harness = open_left_alone(false);
    harness.run_steps(400);
    assert!(sea(&mut harness) == at_rest, "only where a shell allows it");
    harness.key_press(egui::Key::Space);
    harness.run_steps(30);
    assert!(sea(&mut harness) == stopped, "the camera has returned to that of the state");
}

/// The text over the sea tells of the sea alone. What concerns the machine is a click away, and measured waves are
/// explained as such.
#[test]
fn the_sea_in_words_explains_itself() {
    let mut harness = open("n=64&pause=1");
    harness.get_by_label_contains("high and ");
    assert!(
        harness.query_by_label_contains("points, ").is_none(),
        "the points of the grids are the machine's business"
    );
    harness.get_by_label_contains("ms a frame").click();
    harness.run_steps(60);
    let points = harness.get_by_label_contains("points, ").rect();
    assert!(points.top() > 0.0 && points.bottom() < 700.0, "the tab scrolls to it: {points}");
    click(&mut harness, "Share");
    click(&mut harness, "Try a spectrum");
    let headline = harness.get_by_label("Measured waves").rect().center();
    harness.hover_at(headline);
    harness.run_steps(90);
    harness.get_by_label_contains("a buoy has measured them");
    assert!(harness.query_by_label_contains("Wind speed 10 m above").is_none());
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

/// A spectrum stands over the period of the waves, and over what a visitor has chosen before.
#[test]
fn the_axis_of_spectra_is_chosen_and_kept() {
    let folder = std::env::temp_dir().join(format!("seastate-axis-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut captions = Vec::new();
    for chosen in ["Hz", "rad/s", "Period"] {
        let mut harness = open("n=64&pause=1");
        harness.state_mut().set_save_folder(folder.clone());
        harness.state_mut().load_preferences();
        click(&mut harness, "Study");
        click(&mut harness, "Spectrum and other plots");
        harness.run_steps(20);
        let shown = ["Energy by wave period", "over the frequency f, Hz", "over ω, rad/s"];
        let shown: Vec<_> = shown.iter().filter(|c| harness.query_by_label_contains(c).is_some()).copied().collect();
        captions.extend(shown);
        let has_text = |words: &str| {
            let texts = harness.output().shapes.iter().filter_map(|shape| match &shape.shape {
                egui::Shape::Text(text) => Some(text.galley.text().to_owned()),
                _ => None,
            });
            texts.into_iter().any(|text| text == words)
        };
        // The sea of 12 m/s over 150 km peaks at 7.6 s, 0.13 Hz, 0.83 rad/s.
        let numbers = [["10 s", "5 s"], ["0.1", "0.2"], ["0.5", "1"]];
        for number in numbers[captions.len() - 1] {
            assert!(has_text(number), "{number} stands at the axis");
        }
        click(&mut harness, chosen);
        assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    }
    assert_eq!(captions, ["Energy by wave period", "over the frequency f, Hz", "over ω, rad/s"]);
    let kept = std::fs::read_to_string(folder.join("preferences.txt")).expect("the choice is kept");
    assert!(kept.contains("spectrum-axis=period\n"), "{kept}");
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}
