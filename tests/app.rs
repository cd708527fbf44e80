//! The app under egui_kittest on a software adapter: the code that also runs in the window and on the page.

mod common;

use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use seastate::app::App;
use seastate::app::device_loss::{AppHost, ParkedApp};
use seastate::files::picture;
use seastate::state::presets;
use seastate::state::start::START;

fn open(state: &str) -> Harness<'static, App> {
    open_in(state, [900.0, 500.0])
}

fn open_in(state: &str, size: [f32; 2]) -> Harness<'static, App> {
    common::harness::open(state, size, 1.0)
}

/// Opens a tab of the panel; in a wide window the weather is open at first.
fn open_tab(harness: &mut Harness<'_, App>, name: &str) {
    harness.get_by_label(name).click();
    harness.run_steps(4);
}

#[test]
fn a_state_opens_and_shows_its_numbers() {
    let mut harness = open("wind=10&fetch=100&n=64&pause=1&t=5");
    harness.get_by_label("waves 2.1 m high and 61 m long, every 6 s");
    open_tab(&mut harness, "Study");
    let picture = harness.render().expect("a picture");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    assert_eq!(harness.state().state(), "wind=10&fetch=100&t=5&pause=1&n=64");
    // Significant wave height and peak period of this sea, from the literature.
    harness.get_by_label("2.14 m");
    harness.get_by_label("6.2 s");
    let first = picture.get_pixel(20, 250);
    assert!(picture.pixels().any(|p| p != first), "the picture is not one colour");
}

#[test]
fn time_runs_and_space_stops_it() {
    let mut harness = open("n=64");
    let time = |h: &Harness<'_, App>| seastate::state::query::parse(&h.state().state()).0.clock;
    harness.run_steps(30);
    assert!(time(&harness).t_s > 0.1);
    harness.key_press(egui::Key::Space);
    harness.run_steps(2);
    let at = time(&harness);
    assert!(at.paused);
    harness.run_steps(30);
    assert_eq!(time(&harness).t_s, at.t_s);
}

#[test]
fn the_panel_edits_the_state() {
    let mut harness = open("n=64&pause=1&wind=20");
    harness.get_by_label("Reset").click();
    harness.run_steps(2);
    assert_eq!(harness.state().state(), "");
}

/// The button switches on one system after the other; each has a section with a button that removes it.
#[test]
fn wave_systems_are_added_and_removed() {
    let mut harness = open_in("n=64&pause=1&wind=9", [900.0, 3000.0]);
    open_tab(&mut harness, "Study");
    let click = |harness: &mut Harness<'_, App>, label: &str| {
        harness.get_by_label(label).click_accesskit();
        harness.run_steps(6);
    };
    assert!(harness.query_by_label("Second system").is_none(), "off, so not shown");
    for state in ["scale2=1", "scale2=1&scale3=1", "scale2=1&scale3=1&scale4=1"] {
        click(&mut harness, "Add a wave system");
        assert_eq!(harness.state().state(), format!("wind=9&{state}&pause=1&n=64"));
    }
    // All four are on: the button is disabled, the new sections are open.
    click(&mut harness, "Add a wave system");
    for system in ["second", "third", "fourth"] {
        harness.get_by_label(&format!("Remove the {system} system"));
    }
    click(&mut harness, "Remove the third system");
    assert_eq!(harness.state().state(), "wind=9&scale2=1&scale4=1&pause=1&n=64");
    assert!(harness.query_by_label("Third system").is_none() && harness.query_by_label("Fourth system").is_some());
    click(&mut harness, "Add a wave system");
    assert_eq!(harness.state().state(), "wind=9&scale2=1&scale3=1&scale4=1&pause=1&n=64", "the free one in between");
    harness.state_mut().set_state("n=64&pause=1&hs3=2");
    harness.run_steps(3);
    harness.get_by_label("Third system");
    harness.get_by_label("Switched off: second swell.");
    click(&mut harness, "Switch on: second swell");
    assert_eq!(harness.state().state(), "scale3=1&hs3=2&pause=1&n=64");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

#[test]
fn v_goes_through_the_views() {
    let mut harness = open("n=64&pause=1");
    harness.key_press(egui::Key::V);
    harness.run_steps(2);
    assert_eq!(harness.state().state(), "view=h0&pause=1&n=64");
    harness.get_by_label("Initial spectrum |h0(k)|");
    harness.key_press(egui::Key::Num2);
    harness.key_press_modifiers(egui::Modifiers::SHIFT, egui::Key::V);
    harness.key_press_modifiers(egui::Modifiers::SHIFT, egui::Key::V);
    harness.run_steps(2);
    assert_eq!(harness.state().state(), "view=wireframe&viewcascade=2&pause=1&n=64");
    harness.render().expect("a picture");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    harness.key_press(egui::Key::Escape);
    harness.run_steps(2);
    assert_eq!(harness.state().state(), "pause=1&n=64");
}

#[test]
fn notices_of_the_state_are_shown() {
    let harness = open("n=64&pause=1&colour=red");
    harness.get_by_label_contains("unknown setting \"colour\"");
}

/// A dropped file.
#[derive(Debug)]
struct File(std::path::PathBuf);

impl egui::DroppedFile for File {
    fn path(&self) -> &std::path::Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|e| e.to_string())
    }
}

fn drop_files(harness: &mut Harness<'_, App>, paths: &[std::path::PathBuf]) {
    for path in paths {
        harness.input_mut().dropped_files.push(std::sync::Arc::new(File(path.clone())));
    }
    harness.run_steps(2);
}

#[test]
fn a_dropped_buoy_becomes_the_sea() {
    let mut harness = open("n=64&pause=1");
    let sample = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/spectra/two-systems.txt");
    drop_files(&mut harness, &[sample]);
    let state = harness.state().state();
    assert!(state.starts_with("spectrum=measured&") && state.contains("&measured="), "{state}");
    open_tab(&mut harness, "Study");
    harness.get_by_label("2.33 m");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());

    // A bad file leaves the sea as it is and says why.
    let bad = std::env::temp_dir().join("seastate-bad-buoy.csv");
    std::fs::write(&bad, "0.1,2\n0.2,1\n0.15,1\n").expect("a temporary file");
    drop_files(&mut harness, &[bad]);
    assert_eq!(harness.state().state(), state);
    assert_told(&harness, "line 3");
}

#[test]
fn a_dropped_file_of_several_times_offers_them() {
    let mut harness = open_in("n=64&pause=1", [900.0, 900.0]);
    let sample = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/spectra/turning-wind.sp2");
    drop_files(&mut harness, &[sample]);
    harness.run_steps(4);
    let last = harness.state().state();
    assert!(last.contains("&measured=d*24*7.5_"), "{last}");
    harness.get_by_label("turning-wind.sp2: 3 spectra");
    harness.get_by_label_contains("20240301.000000").click();
    harness.run_steps(4);
    let first = harness.state().state();
    assert_ne!(first, last);
    harness.get_by_label_contains("20240301.120000").click();
    harness.run_steps(4);
    assert_eq!(harness.state().state(), last);
    harness.get_by_label("Close the list of spectra").click();
    harness.run_steps(4);
    assert!(harness.query_by_label("turning-wind.sp2: 3 spectra").is_none());
    assert_eq!(harness.state().state(), last);
}

#[test]
fn a_dropped_sky_is_shown_and_carried_by_name() {
    let folder = std::env::temp_dir().join("seastate-sky-test");
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    // A blue sky with a sun of 2 x 2 pixels, 45 degrees high in the east.
    let image = image::Rgb32FImage::from_fn(128, 64, |x, y| {
        let sun = (95..97).contains(&x) && (15..17).contains(&y);
        image::Rgb(if sun { [900.0; 3] } else { [0.3, 0.5, 1.0] })
    });
    let good = folder.join("made up.hdr");
    image.save(&good).expect("a file");
    let mut harness = open("n=64&pause=1");
    drop_files(&mut harness, std::slice::from_ref(&good));
    assert_eq!(harness.state().state(), "pause=1&n=64&sky=made+up.hdr");
    harness.get_by_label_contains("128 x 64, sun 45° high");

    // A truncated file leaves the sky as it is and says why.
    let bytes = std::fs::read(&good).expect("the file");
    let bad = folder.join("half.hdr");
    std::fs::write(&bad, &bytes[..bytes.len() / 2]).expect("a file");
    drop_files(&mut harness, &[bad]);
    assert_eq!(harness.state().state(), "pause=1&n=64&sky=made+up.hdr");
    assert_told(&harness, "half.hdr: it ends too early");

    // A link that names this sky shows it again; a link that names another sky reports that it is missing.
    harness.state_mut().set_state("n=64&pause=1&sky=made+up.hdr");
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("is not loaded").is_none());
    harness.state_mut().set_state("n=64&pause=1&sky=other.hdr");
    harness.run_steps(2);
    harness.get_by_label_contains("\"other.hdr\" is not loaded");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

/// Why a file was not opened stands in the panel, and over the sea for who has closed it.
fn assert_told(harness: &Harness<'_, App>, words: &str) {
    let count = harness.query_all_by_label_contains(words).count();
    assert_eq!(count, 2, "{words}: {}", harness.state().report_text());
}

/// A file or link that cannot be read adds a notice and changes nothing else.
#[test]
fn what_cannot_be_read_changes_nothing() {
    let folder = std::env::temp_dir().join(format!("seastate-hostile-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let state = "wind=17&t=3&pause=1&n=64";
    let mut harness = open(state);
    let lost = picture::encode([1, 1], &[0; 4], "hello & goodbye", "").expect("a picture");
    let plain = picture::encode([1, 1], &[0; 4], "", "").expect("a picture");
    let cases: [(&str, &[u8], &str); 9] = [
        ("a.png", b"\x89PNG\r\n\x1a\nnonsense", "not a picture"),
        ("b.png", &lost[..lost.len() / 2], "not a picture"),
        ("c.png", &lost, "that is no sea"),
        ("d.exr", b"\x76\x2f\x31\x01nonsense", "d.exr: "),
        ("e.hdr", b"#?RADIANCE\n\n-Y 500000 +X 1000000\n", "save it smaller"),
        ("f.jpg", b"\xff\xd8\xff\xe0\0\x10JFIF", "no text"),
        ("g.txt", b"", "empty"),
        ("h.csv", b"0.1,1,1e999\n", "columns"),
        ("i.txt", b"[a]\nabout: without a state\n", "no state"),
    ];
    for (name, bytes, says) in cases {
        let path = folder.join(name);
        std::fs::write(&path, bytes).expect("a file");
        drop_files(&mut harness, &[path]);
        assert_eq!(harness.state().state(), state, "{name}");
        assert_told(&harness, says);
    }
    // The picture of the default sea has an empty state string and opens, too.
    let path = folder.join("plain.png");
    std::fs::write(&path, plain).expect("a file");
    drop_files(&mut harness, &[path]);
    assert_eq!(harness.state().state(), "");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}

#[test]
fn the_report_says_what_runs_on_what_and_is_copied() {
    let mut harness = open_in("wind=17&t=3&pause=1&n=64&nonsense=1", [900.0, 1400.0]);
    open_tab(&mut harness, "Study");
    harness.get_by_label_contains(concat!("Seastate ", env!("CARGO_PKG_VERSION")));
    harness.get_by_label("This program").scroll_to_me();
    harness.run_steps(4);
    harness.get_by_label("This program").click();
    harness.run_steps(30);
    let info = harness.state().render_state().adapter.get_info();
    assert!(harness.query_all_by_label_contains(&info.name).next().is_some(), "{}", info.name);
    harness.get_by_label("Copy report").scroll_to_me();
    harness.run_steps(4);
    harness.get_by_label("Copy report").click();
    let copied = |command: &egui::OutputCommand| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    };
    let report = (0..4).find_map(|_| {
        harness.run_steps(1);
        harness.output().platform_output.commands.iter().find_map(copied)
    });
    let report = report.expect("something is copied");
    harness.run_steps(2);
    harness.get_by_label_contains("Report copied");
    for line in [
        "state: wind=17&t=3&pause=1&n=64\n",
        "last error: none\n",
        "notice: unknown setting \"nonsense\"",
        "picture: 900 x 1400",
        "texture side: ",
    ] {
        assert!(report.contains(line), "{line}: {report}");
    }
}

#[test]
fn keys_fly_the_camera() {
    let mut harness = open("n=64&pause=1&heading=90&x=0");
    harness.key_down(egui::Key::W);
    harness.run_steps(10);
    harness.key_up(egui::Key::W);
    harness.run_steps(1);
    let camera = seastate::state::query::parse(&harness.state().state()).0.camera;
    assert!(camera.x_m > 0.5 && camera.z_m.abs() < 0.2, "east: {camera:?}");
}

fn params(h: &Harness<'_, App>) -> seastate::state::Params {
    seastate::state::query::parse(&h.state().state()).0
}

#[test]
fn beaufort_and_named_seas_set_the_sea_and_undo_takes_it_back() {
    let mut harness = open("n=64&pause=1&seed=9&y=12");
    harness.get_by_label("Seas").click();
    harness.run_steps(30);
    harness.get_by_label("North Sea gale").click();
    harness.run_steps(40);
    let gale = params(&harness);
    assert!(gale.sea.first_system().wind_m_s > 15.0, "{:?}", gale.sea.first_system());
    assert_eq!((gale.sea.seed, gale.camera.y_m, gale.grid.n), (9, 12.0, 64), "a named sea is a sea");
    harness.get_by_label("Undo").click();
    harness.run_steps(2);
    assert_eq!(harness.state().state(), "seed=9&y=12&pause=1&n=64");
    harness.get_by_label("Redo").click();
    harness.run_steps(2);
    assert_eq!(params(&harness), gale);
}

/// A named sea brings its own light: nothing of a lagoon's water is left in the open ocean.
#[test]
fn named_seas_change_the_light_and_keep_the_window() {
    let mut harness = open("n=64&pause=1&water=3c&fog=4&units=nautical&textsize=1.2");
    harness.get_by_label("Seas").click();
    harness.run_steps(30);
    harness.get_by_label("Calm open ocean").click();
    harness.run_steps(40);
    let now = params(&harness);
    let sea = presets::built_in().iter().find(|sea| sea.name == "Calm open ocean").expect("a named sea");
    assert_eq!(now.look, sea.apply(&seastate::state::Params::default()).0.look);
    assert!(harness.state().state().contains("units=nautical&textsize=1.2"), "{}", harness.state().state());
}

#[test]
fn rows_without_effect_are_disabled() {
    let mut harness = open_in("n=64&pause=1", [900.0, 900.0]);
    open_tab(&mut harness, "Study");
    let is_grey = |harness: &mut Harness<'_, App>, state: &str| {
        harness.state_mut().set_state(state);
        harness.get_by_label("Search").focus();
        harness.run_steps(2);
        harness.get_by_label("Search").type_text("shininess");
        harness.run_steps(4);
        let row = harness.query_all_by_label("Shininess").find(|n| n.accesskit_node().numeric_value().is_some());
        let is_grey = row.expect("a slider").accesskit_node().is_disabled();
        harness.get_by_label("Clear the search").click();
        harness.run_steps(4);
        is_grey
    };
    assert!(is_grey(&mut harness, "n=64&pause=1"));
    assert!(!is_grey(&mut harness, "n=64&pause=1&specular=blinn-phong"));
}

#[test]
fn text_grows_and_the_picture_keeps_its_pixels() {
    let usual = open("n=64&pause=1");
    let large = open("n=64&pause=1&textsize=1.2");
    assert_eq!((usual.ctx.zoom_factor(), large.ctx.zoom_factor()), (1.0, 1.2));
    assert_eq!(large.state().picture_size(), usual.state().picture_size());
}

#[test]
fn a_key_says_what_the_camera_does_now() {
    let mut harness = open("n=64&pause=1");
    harness.key_press(egui::Key::C);
    harness.run_steps(2);
    harness.get_by_label("Camera: orbit. A drag turns around the sea in the middle.");
}

/// A finger that scrolls the panel does not move the slider on which it came down; a finger that moves sideways does.
#[test]
fn a_finger_scrolls_over_sliders_and_moves_them_sideways() {
    let mut harness = open("n=64&pause=1&units=metric");
    let drag = |harness: &mut Harness<'_, App>, by: egui::Vec2| {
        let slider = harness.query_all_by_label("Blowing over").find(|n| n.accesskit_node().numeric_value().is_some());
        let from = slider.expect("a slider").rect().left_center() + egui::vec2(30.0, 0.0);
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        let touch = |phase, pos| egui::Event::Touch {
            device_id: egui::TouchDeviceId(0),
            id: egui::TouchId(1),
            phase,
            pos,
            force: None,
        };
        let press = |pressed, pos| egui::Event::PointerButton { pos, button, pressed, modifiers };
        harness.event(touch(egui::TouchPhase::Start, from));
        harness.event(egui::Event::PointerMoved(from));
        harness.event(press(true, from));
        harness.run_steps(2);
        for i in 1..=10 {
            let at = from + by * (i as f32 / 10.0);
            harness.event(touch(egui::TouchPhase::Move, at));
            harness.event(egui::Event::PointerMoved(at));
            harness.run_steps(1);
        }
        harness.event(touch(egui::TouchPhase::End, from + by));
        harness.event(press(false, from + by));
        harness.event(egui::Event::PointerGone);
        harness.run_steps(4);
        params(harness).sea.first_system().fetch_km
    };
    let before = params(&harness).sea.first_system().fetch_km;
    assert_eq!(drag(&mut harness, egui::vec2(3.0, -60.0)), before, "it scrolled");
    assert_ne!(drag(&mut harness, egui::vec2(60.0, 3.0)), before, "it moved the slider");
}

#[test]
fn a_search_finds_parameters_and_units_change() {
    let mut harness = open("n=64&pause=1&units=nautical&wind=10");
    // The wind of 10 m/s in knots, and the wave height in feet.
    assert!(harness.query_all_by_label_contains("19.4 kn").next().is_some());
    open_tab(&mut harness, "Study");
    let hs = format!("{:.2} ft", seastate::waves::Plan::new(&params(&harness)).hs_m() / 0.3048);
    assert!(harness.query_all_by_label(&hs).next().is_some(), "{hs}");
    assert!(harness.query_by_label("Bloom").is_none());
    harness.get_by_label("Search").click();
    harness.get_by_label("Search").type_text("bloom");
    harness.run_steps(30);
    assert!(harness.query_all_by_label("Bloom").next().is_some());
}

#[test]
fn keys_hide_the_panel_step_the_time_and_open_the_help() {
    let mut harness = open("n=64&pause=1&t=5");
    harness.key_press(egui::Key::H);
    harness.run_steps(2);
    assert_eq!(harness.state().state(), "t=5&pause=1&n=64&ui=0");
    assert!(harness.query_by_label("Weather").is_none() && harness.query_by_label("Undo").is_none());
    harness.key_press(egui::Key::H);
    for _ in 0..6 {
        harness.key_press(egui::Key::Period);
        harness.run_steps(1);
    }
    assert!((params(&harness).clock.t_s - 5.1).abs() < 1e-9);
    harness.key_press(egui::Key::F1);
    harness.run_steps(2);
    harness.get_by_label("fly over the water; with Shift faster");
    // Escape closes the list, not the window.
    harness.key_press(egui::Key::Escape);
    harness.run_steps(2);
    assert!(harness.query_by_label("fly over the water; with Shift faster").is_none());
    harness.key_press(egui::Key::C);
    harness.run_steps(2);
    assert_eq!(params(&harness).camera.mode, seastate::state::params::CameraMode::Orbit);
}

#[test]
fn a_picture_is_saved_with_its_sea_and_brings_it_back() {
    let folder = std::env::temp_dir().join(format!("seastate-picture-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut harness = open("wind=17&n=64&pause=1&t=3");
    harness.state_mut().set_save_folder(folder.clone());
    harness.render().expect("a picture");
    harness.key_press(egui::Key::P);
    for _ in 0..100 {
        harness.run_steps(1);
        // The picture is drawn whole over some frames before it is saved.
        harness.render().expect("a picture");
        if harness.query_by_label_contains("seastate-wind17").is_some() {
            break;
        }
        std::thread::park_timeout(std::time::Duration::from_millis(50));
    }
    let path = folder.join("seastate-wind17-t3.png");
    let image = image::open(&path).expect("a picture").to_rgb8();
    assert_eq!(image.dimensions(), (900, 500));
    let first = image.get_pixel(5, 5);
    assert!(image.pixels().any(|p| p != first), "the picture is not one colour");
    harness.state_mut().set_state("n=64&pause=1");
    drop_files(&mut harness, std::slice::from_ref(&path));
    assert_eq!(harness.state().state(), "wind=17&t=3&pause=1&n=64");
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}

#[test]
fn the_maps_are_saved_as_layers_of_one_file() {
    let folder = std::env::temp_dir().join(format!("seastate-maps-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut harness = open_in("wind=17&n=64&pause=1&t=3", [900.0, 1400.0]);
    harness.state_mut().set_save_folder(folder.clone());
    for label in ["Share", "Save maps"] {
        harness.get_by_label(label).click();
        harness.run_steps(30);
    }
    for _ in 0..200 {
        harness.run_steps(1);
        if harness.query_by_label_contains("seastate-maps.exr").is_some() {
            break;
        }
        std::thread::park_timeout(std::time::Duration::from_millis(50));
    }
    let image = exr::prelude::read_all_flat_layers_from_file(folder.join("seastate-maps.exr")).expect("maps");
    let plan = seastate::waves::Plan::new(&params(&harness));
    assert_eq!(image.layer_data.len(), plan.cascades.len());
    // The variance of the heights of all cascades is that of the sea.
    let variance = |layer: &exr::prelude::Layer<exr::prelude::AnyChannels<exr::prelude::FlatSamples>>| {
        let heights = layer.channel_data.list.iter().find(|c| c.name.eq("Y")).expect("heights");
        heights.sample_data.values_as_f32().map(|h| f64::from(h).powi(2)).sum::<f64>() / (64.0 * 64.0)
    };
    let hs = 4.0 * image.layer_data.iter().map(variance).sum::<f64>().sqrt();
    assert!((hs / plan.hs_m() - 1.0).abs() < 0.25, "{hs} of {}", plan.hs_m());
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}

#[test]
fn the_smallest_windows_are_drawn() {
    let mut harness = open("n=64&pause=1&renderscale=0.25&afloat=buoy*5*-9");
    harness.key_press(egui::Key::F1);
    // Waits for the first picture.
    while !harness.state().is_picture_complete() {
        harness.run_steps(1);
        harness.render().expect("a picture");
    }
    for size in [
        [1.0, 1.0],
        [1.0, 500.0],
        [900.0, 1.0],
        [99.0, 99.0],
        [101.0, 101.0],
        [639.0, 101.0],
        [641.0, 101.0],
        [900.0, 500.0],
    ] {
        harness.set_size(egui::vec2(size[0], size[1]));
        harness.run_steps(3);
        harness.render().expect("a picture");
    }
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    harness.get_by_label("Undo");
}

#[test]
fn buoys_are_moored_where_the_sea_is_clicked() {
    let mut harness = open("n=64&pause=1&heading=90&pitch=-20");
    open_tab(&mut harness, "View");
    harness.get_by_label("Moor a buoy").click();
    harness.run_steps(2);
    harness.drag_at(egui::pos2(300.0, 250.0));
    harness.drop_at(egui::pos2(300.0, 250.0));
    harness.run_steps(3);
    let floats = params(&harness).floating_objects;
    assert_eq!(floats.len(), 1, "{}", harness.state().state());
    // Twenty degrees below the horizon from seven metres, a little to the left of east.
    assert!((5.0..40.0).contains(&floats[0].x_m) && floats[0].z_m < 0.0, "{floats:?}");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

#[test]
fn the_picture_has_as_many_pixels_as_asked_for() {
    let harness = open("n=64&pause=1&renderscale=0.5");
    assert_eq!(harness.state().picture_size(), [450, 250]);
    let harness = open("n=64&pause=1&maxdpr=0.5");
    assert_eq!(harness.state().picture_size(), [450, 250]);
    let harness = open("n=64&pause=1");
    assert_eq!(harness.state().picture_size(), [900, 500]);
    // Every frame takes a quarter of a second.
    let slow = |state: &'static str| {
        let mut harness = Harness::builder()
            .with_size(egui::vec2(900.0, 500.0))
            .with_step_dt(0.25)
            .wgpu_setup(seastate::app::setup::wgpu_configuration().wgpu_setup)
            .build_eframe(move |cc| App::new(cc, state).expect("a device"));
        harness.run_steps(24);
        harness.state().picture_size()[0]
    };
    assert!(slow("n=64") < 700);
    assert_eq!(slow("n=64&adaptive=0"), 900);
}

#[test]
fn a_running_sea_has_the_light_asked_for_and_a_still_the_full_one() {
    let drawn = |state: &str| open(&format!("n=64&t=5&ui=0&adaptive=0&{state}")).render().expect("a picture");
    let [lean, full] = ["speed=0&detail=lean", "speed=0&detail=full"].map(drawn);
    let differing = lean.pixels().zip(full.pixels()).filter(|(a, b)| a != b).count();
    assert!(differing > 20_000, "{differing} of 450,000 pixels show the lean light");
    let [still_lean, still_full] = ["pause=1&detail=lean", "pause=1&detail=full"].map(drawn);
    assert!(still_lean == still_full, "a still has full light");
}

#[test]
fn the_sea_is_measured_and_its_passes_are_timed() {
    let mut harness = open_in("wind=10&fetch=100&n=128&pause=1&t=5&renderscale=0.3", [700.0, 1400.0]);
    for section in ["Study", "Spectrum and other plots", "More numbers", "Time of a frame"] {
        harness.get_by_label(section).click();
        harness.run_steps(8);
    }
    let until_measured = |harness: &mut Harness<'static, App>| {
        for frame in 0.. {
            harness.render().expect("a frame");
            harness.run_steps(1);
            if harness.query_by_label("Measured: mean of one moment.").is_some() {
                return;
            }
            assert!(frame < 200, "nothing is measured");
        }
    };
    until_measured(&mut harness);
    let features = harness.state().render_state().device.features();
    let timed = if features.contains(wgpu::Features::TIMESTAMP_QUERY) { "columns" } else { "no timestamps" };
    assert!(harness.query_by_label_contains(timed).is_some(), "{timed}");
    // The row of Hs has the only lengths with three decimals: by theory, computed and measured.
    let measured = |harness: &Harness<'_, App>| {
        let texts = harness.query_all_by_label_contains(" m").filter_map(|node| node.value());
        let metres = |text: String| text.strip_suffix(" m").filter(|n| n.len() == 5)?.parse::<f64>().ok();
        texts.filter_map(metres).nth(2).expect("a measured height")
    };
    let first = measured(&harness);
    assert!((first / 2.139 - 1.0).abs() < 0.08, "{first}");
    // Another sea is measured again after its cross-fade, also while time is stopped.
    harness.state_mut().set_state("wind=14&n=128&pause=1&t=5&renderscale=0.3");
    harness.run_steps(2);
    assert!(harness.query_by_label("Measured: mean of one moment.").is_none());
    until_measured(&mut harness);
    let theory = seastate::waves::Plan::new(&params(&harness)).hs_m();
    assert!((measured(&harness) / theory - 1.0).abs() < 0.08, "{} {theory}", measured(&harness));
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

#[test]
fn the_sheet_of_a_phone_opens_and_closes_with_a_tap_and_leaves_the_sea_visible() {
    let mut harness = open_in("wind=8&n=64&pause=1", [390.0, 844.0]);
    assert!(harness.query_by_label("Undo").is_none(), "the sea comes first");
    let closed = harness.state().picture_size();
    assert!(f64::from(closed[1]) > 0.8 * 844.0, "{closed:?}");
    for _ in 0..2 {
        open_tab(&mut harness, "Weather");
        harness.run_steps(30);
        // The widgets of the sheet are at least 44 points high, so that fingers hit them.
        for label in ["Weather", "Undo", "Reset", "Beaufort", "Wind speed"] {
            let rect = harness.get_by_label(label).rect();
            assert!(rect.height() >= 44.0 && rect.top() > 0.5 * 844.0, "{label}: {rect:?}");
        }
        // The whole sea is drawn above the sheet, in at least half of the window.
        let open = harness.state().picture_size();
        assert!(open[0] == closed[0] && open[1] >= 422 && open[1] < closed[1] - 250, "{open:?} {closed:?}");
        open_tab(&mut harness, "Weather");
        harness.run_steps(30);
        assert!(harness.query_by_label("Undo").is_none());
        assert_eq!(harness.state().picture_size(), closed);
    }
}

#[test]
fn the_handle_of_the_sheet_is_dragged_tapped_and_moved_by_keys() {
    let mut harness = open_in("wind=8&n=64&pause=1", [390.0, 844.0]);
    let handle = "Height of the sheet";
    let sea = |harness: &Harness<'_, App>| harness.state().picture_size()[1];
    let closed = sea(&harness);
    // Keys: one height after the other, and back.
    harness.get_by_label(handle).focus();
    harness.run_steps(2);
    let mut heights = vec![closed];
    for key in [egui::Key::ArrowUp, egui::Key::ArrowUp, egui::Key::ArrowDown, egui::Key::ArrowDown] {
        harness.key_press(key);
        harness.run_steps(40);
        heights.push(sea(&harness));
    }
    let [third, full] = [heights[1], heights[2]];
    assert!(closed > third + 250 && third > full + 250 && full >= 100, "{heights:?}");
    assert_eq!(heights, [closed, third, full, third, closed]);
    // Taps: open, open further, close.
    for want in [third, full, closed] {
        harness.get_by_label(handle).click();
        harness.run_steps(40);
        assert_eq!(sea(&harness), want);
    }
    // A slow drag follows the finger, and the sheet goes on to the nearest height.
    let from = harness.get_by_label(handle).rect().center();
    harness.drag_at(from);
    harness.run_steps(2);
    for way in [20.0, 100.0, 180.0, 220.0] {
        harness.hover_at(from - egui::vec2(0.0, way));
        harness.run_steps(20);
    }
    let held = sea(&harness);
    assert!(held.abs_diff(closed - 220) < 30, "{held} of {closed}");
    harness.drop_at(from - egui::vec2(0.0, 220.0));
    harness.run_steps(40);
    assert_eq!(sea(&harness), third);
    harness.get_by_label("Beaufort");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

#[test]
fn a_held_device_turns_the_view_only_after_the_user_has_asked_for_it() {
    let mut harness = open_in("wind=8&n=64&pause=1&heading=200&pitch=-10", [390.0, 844.0]);
    let view = |harness: &Harness<'_, App>| {
        let camera = params(harness).camera;
        [camera.heading_deg, camera.pitch_deg]
    };
    open_tab(&mut harness, "View");
    harness.run_steps(30);
    assert!(harness.query_by_label("Tilt to look").is_none(), "this device has no sensors");
    harness.state_mut().offer_tilt();
    harness.run_steps(2);
    harness.state_mut().follow_tilt([0.0, 95.0, 0.0]);
    harness.run_steps(2);
    assert_eq!(view(&harness), [200.0, -10.0], "nothing moves unasked");
    harness.get_by_label("Tilt to look").click();
    harness.run_steps(3);
    harness.state_mut().follow_tilt([0.0, 95.0, 0.0]);
    harness.state_mut().follow_tilt([350.0, 95.0, 0.0]);
    harness.run_steps(2);
    assert_eq!(view(&harness), [210.0, 5.0]);
    harness.get_by_label("Tilt to look").click();
    harness.run_steps(3);
    assert_eq!(view(&harness), [200.0, -10.0], "switched off, the view returns");
    // Refused by the browser: the view stays, and a message says why.
    harness.get_by_label("Tilt to look").click();
    harness.run_steps(3);
    harness.state_mut().refuse_tilt();
    harness.run_steps(3);
    harness.get_by_label("The browser does not tell the page how the device is held.");
    harness.state_mut().follow_tilt([350.0, 95.0, 0.0]);
    harness.run_steps(2);
    assert_eq!(view(&harness), [200.0, -10.0]);
}

#[test]
fn the_weather_tab_sets_wind_swell_and_sun() {
    let mut harness = open_in("n=64&pause=1", [900.0, 1400.0]);
    let set = |harness: &mut Harness<'_, App>, label: &str, value: f64| {
        let is_slider = |node: &egui_kittest::Node<'_>| node.accesskit_node().role() != egui::accesskit::Role::Label;
        harness.get_all_by_label(label).find(is_slider).expect("a slider").set_value_accesskit(value);
        harness.run_steps(3);
    };
    set(&mut harness, "Beaufort", 8.0);
    set(&mut harness, "Sun height", 5.0);
    assert_eq!(harness.state().state(), "wind=18.9&sun=5&pause=1&n=64");
    harness.get_by_label("As high as the textbook").click();
    harness.run_steps(3);
    assert_eq!(harness.state().state(), "wind=18.9&fetch=200&sun=5&pause=1&n=64");
    // Whoever sets a swell's height gets a swell, and can have none again.
    set(&mut harness, "Swell height", 3.0);
    assert_eq!(harness.state().state(), "wind=18.9&fetch=200&scale2=1&hs2=3&sun=5&pause=1&n=64");
    harness.get_by_label("No swell").click();
    harness.run_steps(3);
    assert_eq!(harness.state().state(), "wind=18.9&fetch=200&hs2=3&sun=5&pause=1&n=64");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

/// Not a test: writes pictures of the program in several sizes for visual inspection (`cargo test --test app --
/// --ignored`).
#[test]
#[ignore = "writes pictures to target/tmp/app"]
fn pictures_to_look_at() {
    let folder = std::path::PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("app");
    std::fs::create_dir_all(&folder).expect("a folder");
    let bright = "wind=3&sun=50&sunaz=20&heading=0&n=128&t=30&adaptive=0";
    let busy = "wind=12&n=128&t=30&adaptive=0&afloat=buoy*20*-25_boat*32*-30";
    let record = "wind=12&n=128&t=30&speed=16&adaptive=0&afloat=buoy*20*-25_boat*32*-30";
    let storm = "wind=28&fetch=600&sun=12&n=128&t=30&adaptive=0";
    for (name, state, size, open) in [
        ("wide", bright, [1920.0, 1080.0], &[][..]),
        ("wide-busy", busy, [1920.0, 1080.0], &["Study", "Spectrum and other plots"][..]),
        ("usual", busy, [1280.0, 720.0], &["Seas"][..]),
        ("weather", START, [1280.0, 720.0], &[][..]),
        ("view", START, [1280.0, 720.0], &["View"][..]),
        ("study", START, [1280.0, 720.0], &["Study"][..]),
        ("share", START, [1280.0, 720.0], &["Share"][..]),
        ("phone-start", START, [390.0, 844.0], &[][..]),
        ("phone-weather", START, [390.0, 844.0], &["Weather"][..]),
        ("phone-seas", START, [390.0, 844.0], &["Seas"][..]),
        ("usual-bright", bright, [1280.0, 720.0], &[][..]),
        ("numbers", storm, [1280.0, 900.0], &["Study", "More numbers", "Time of a frame", "This program"][..]),
        (
            "plots",
            record,
            [1280.0, 900.0],
            &[
                "Study",
                "Spectrum and other plots",
                "Directions",
                "Sea at a buoy",
                "Cut through the sea",
                "Crests at a buoy",
            ][..],
        ),
        ("phone", bright, [390.0, 844.0], &[][..]),
        ("phone-open", storm, [390.0, 844.0], &["Weather"][..]),
        ("phone-plots", busy, [390.0, 844.0], &["Study", "Spectrum and other plots"][..]),
        ("help", storm, [1280.0, 720.0], &["keys"][..]),
    ] {
        if std::env::var("ONLY").is_ok_and(|only| !name.contains(&only)) {
            continue;
        }
        let mut harness = Harness::builder()
            .with_size(egui::vec2(size[0], size[1]))
            .with_step_dt(0.25)
            .wgpu_setup(seastate::app::setup::wgpu_configuration().wgpu_setup)
            .build_eframe(move |cc| App::new(cc, state).expect("a device"));
        harness.run_steps(12);
        for label in open {
            match *label {
                "keys" => harness.key_press(egui::Key::F1),
                _ => {
                    harness.get_by_label(label).scroll_to_me();
                    harness.run_steps(4);
                    harness.get_by_label(label).click();
                }
            }
            harness.run_steps(4);
        }
        for _ in 0..6 {
            harness.render().expect("a picture");
            harness.run_steps(4);
        }
        harness.render().expect("a picture").save(folder.join(format!("{name}.png"))).expect("a file");
        assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    }
}

/// The app in its host, which can park it.
fn open_host(parked: &ParkedApp, state: &str) -> Harness<'static, AppHost> {
    let (parked, state) = (parked.clone(), state.to_owned());
    let mut harness = Harness::builder()
        .with_size(egui::vec2(300.0, 170.0))
        .with_pixels_per_point(1.0)
        .with_step_dt(1.0 / 60.0)
        .wgpu_setup(seastate::app::setup::wgpu_configuration().wgpu_setup)
        .build_eframe(move |cc| AppHost::new(cc, &parked, |cc| App::new(cc, &state)).expect("a device"));
    harness.run_steps(3);
    harness
}

/// The picture after the foam's replay and the cross-fade; a frame is recorded when it is rendered.
fn settle(harness: &mut Harness<'_, AppHost>) -> image::RgbaImage {
    loop {
        harness.run_steps(1);
        let picture = harness.render().expect("a picture");
        if harness.state_mut().app().expect("an app").is_picture_complete() {
            return picture;
        }
    }
}

#[test]
fn the_app_outlives_its_device() {
    let parked = ParkedApp::default();
    let mut harness = open_host(&parked, "n=64&wind=20&pause=1&t=20&ui=0");
    let before = settle(&mut harness);
    let app = harness.state_mut().app().expect("an app");
    app.set_state("n=64&wind=9&pause=1&t=20&ui=0");
    harness.run_steps(60);
    harness.key_press(egui::Key::Period);
    harness.run_steps(2);
    let app = harness.state_mut().app().expect("an app");
    let (state, device) = (app.state(), app.render_state().device.clone());
    device.destroy();
    let _ = device.poll(wgpu::PollType::Poll);
    assert!(app.device_lost().is_some());
    harness.state_mut().park(&parked);
    assert!(harness.state_mut().app().is_none());
    drop(harness);

    let mut harness = open_host(&parked, "wind=3");
    let app = harness.state_mut().app().expect("the app of before");
    assert_eq!((app.state(), app.device_lost()), (state, None));
    harness.key_press(egui::Key::Comma);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    let after = settle(&mut harness);
    let app = harness.state_mut().app().expect("an app");
    assert!(app.errors().is_empty(), "{:?}", app.errors());
    assert!(app.state().contains("wind=20"), "what was set before the loss can be undone: {}", app.state());
    let apart = before.iter().zip(after.iter()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum::<u64>();
    assert!((apart as f64) < 0.001 * 255.0 * before.len() as f64, "{apart}");
}
