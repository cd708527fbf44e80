//! Coasts in the app under egui_kittest on a software adapter: chosen in the panel, opened from files, solved beside
//! the running sea.

mod common;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use seastate::app::App;
use seastate::state::coast::CoastName;
use seastate::state::{Params, query};
use std::path::PathBuf;

/// A window in which the tab of the weather has room to its end.
const SIZE: [f32; 2] = [900.0, 1700.0];
const SEA: &str = "wind=6&fetch=20&n=64&pause=1&mesh=0.1&renderscale=0.25";

fn open(state: &str) -> Harness<'static, App> {
    common::harness::open(state, SIZE, 1.0)
}

fn params(harness: &Harness<'_, App>) -> Params {
    query::parse(&harness.state().state()).0
}

/// A dropped file.
#[derive(Debug)]
struct File(PathBuf);

impl egui::DroppedFile for File {
    fn path(&self) -> &std::path::Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|e| e.to_string())
    }
}

/// Writes a file of this name and content, and returns its path.
fn write_file(name: &str, content: &[u8]) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("coast-page");
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join(name);
    std::fs::write(&path, content).expect("a file");
    path
}

/// Drops a file of this name and content on the window.
fn drop_file(harness: &mut Harness<'_, App>, name: &str, content: &[u8]) {
    harness.input_mut().dropped_files.push(std::sync::Arc::new(File(write_file(name, content))));
    harness.run_steps(3);
}

/// Draws frames until the waves near the coast are solved.
fn solve(harness: &mut Harness<'_, App>) {
    for _ in 0..6000 {
        harness.run_steps(1);
        if harness.state().is_coast_shown() {
            return;
        }
        std::thread::park_timeout(std::time::Duration::from_millis(10));
    }
    panic!("the coast was not solved");
}

/// Elevations of a beach that rises by 1 in 50 to the east, as an ESRI ASCII grid with cells of 10 m.
fn beach_grid() -> String {
    let (columns, rows) = (61, 51);
    let row: String = (0..columns).map(|i| format!("{:.1} ", 0.2 * f64::from(i) - 9.0)).collect();
    let header = format!("ncols {columns}\nnrows {rows}\nxllcorner 0\nyllcorner 0\ncellsize 10\nnodata_value -9999\n");
    header + &format!("{row}\n").repeat(rows)
}

#[test]
fn a_coast_of_the_panel_is_chosen_solved_and_undone() {
    let mut harness = open(&format!("{SEA}&scale2=1&hs2=1&tp2=9&dir2=240"));
    let before = harness.state().state();
    harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Coast").click();
    harness.run_steps(3);
    harness.get_by_label("Bar and channel").click();
    harness.run_steps(3);
    let now = params(&harness);
    assert_eq!((now.coast.name, now.sea.depth_m), (CoastName::Bar, 11.4));
    assert!(now.camera.x_m.hypot(now.camera.z_m) > 100.0, "the camera is before the shore: {:?}", now.camera);
    harness.get_by_label_contains("A sand bar along a beach");
    // A message tells the new depth and view. The progress of the solution stands in one place only.
    harness
        .get_by_label("Bar and channel: the water is 11.4 m deep instead of 4000 m, and you stand before the shore.");
    assert_eq!(harness.query_all_by_label_contains("Waves find their way ashore").count(), 1);
    assert!(!harness.state().is_picture_complete());
    solve(&mut harness);
    assert!(harness.query_by_label_contains("Waves find their way ashore").is_none());
    for _ in 0..400 {
        harness.run_steps(1);
        if harness.query_by_label_contains("They begin to break about").is_some() {
            break;
        }
    }
    harness.get_by_label_contains("They begin to break about");
    // A sea that jumps where the coast begins is told, and mended by one click.
    assert!(harness.query_by_label_contains("the waves jump").is_none());
    let deep = harness.state().state().replace("depth=11.4", "depth=40");
    harness.state_mut().set_state(&deep);
    harness.run_steps(3);
    harness.get_by_label_contains("the waves jump");
    harness.get_by_label("Make the sea 11.4 m deep").click();
    harness.run_steps(3);
    assert_eq!(params(&harness).sea.depth_m, 11.4);
    // Everything is undone.
    for _ in 0..10 {
        harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
        harness.run_steps(2);
    }
    assert_eq!(harness.state().state(), before);
}

/// The message about the new coast has a button that takes back all that came with it.
#[test]
fn the_message_about_a_coast_takes_it_back() {
    let mut harness = open(SEA);
    let before = harness.state().state();
    harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Coast").click();
    harness.run_steps(3);
    harness.get_by_label("Straight beach").click();
    // The history takes a change as a step once it has rested for 0.4 s.
    harness.run_steps(40);
    assert_ne!(harness.state().state(), before);
    harness.get_by_label("Back to the sea before").click();
    harness.run_steps(3);
    assert_eq!(harness.state().state(), before);
    assert!(harness.query_by_label("Back to the sea before").is_none());
    // Going back is itself a step of the history.
    harness.run_steps(40);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    harness.run_steps(2);
    assert_eq!(params(&harness).coast.name, CoastName::Beach);
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

#[test]
fn a_dropped_bathymetry_becomes_the_coast() {
    let mut harness = open(&format!("{SEA}&coast=file"));
    harness.get_by_label_contains("the coast is a file, which a link cannot carry");
    assert!(harness.state().is_coast_shown(), "without the file the sea is open");
    drop_file(&mut harness, "beach.asc", beach_grid().as_bytes());
    let state = harness.state().state();
    let now = params(&harness);
    // A square of 500 m lies 50 m within the long side.
    assert_eq!((now.coast.name, now.sea.depth_m), (CoastName::File, 8.0), "{state}");
    harness.get_by_label_contains("beach.asc: 61 x 51");
    assert!(harness.query_by_label_contains("a link cannot carry").is_none());
    assert!(!harness.state().is_coast_shown());
    // The file is known as long as the program runs.
    harness.state_mut().set_state("n=64&pause=1");
    harness.run_steps(2);
    harness.state_mut().set_state(&state);
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("a link cannot carry").is_none());
    solve(&mut harness);
    // Points x, y, z in a file that could as well hold a spectrum.
    let points: String =
        (0..1200).map(|i| format!("{} {} {}\n", i % 40 * 20, i / 40 * 20, f64::from(i % 40) / 4.0 - 8.0)).collect();
    drop_file(&mut harness, "points.txt", points.as_bytes());
    harness.get_by_label_contains("points.txt: ");
    let depth_m = params(&harness).sea.depth_m;
    assert!((6.0..8.0).contains(&depth_m), "{depth_m}");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

/// Whoever chooses a coast from a file before one was opened is asked for the file, in the tab of the weather as in
/// that of study. Until then, and if no file is chosen, all stays as it is.
#[test]
fn the_coast_of_a_file_is_asked_for_in_both_tabs() {
    let path = write_file("asked.asc", beach_grid().as_bytes());
    for (tab, word) in [("Weather", "From a file"), ("Study", "file")] {
        let mut harness = open(&format!("{SEA}&depth=30"));
        let before = harness.state().state();
        if tab == "Study" {
            harness.get_by_label("Study").click();
            harness.run_steps(3);
            harness.get_by_label("Search").focus();
            harness.run_steps(2);
            harness.get_by_label("Search").type_text("coast");
            harness.run_steps(3);
        }
        let choose = |harness: &mut Harness<'static, App>| {
            harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Coast").click();
            harness.run_steps(4);
            harness.get_all_by_label(word).last().expect("a word").click();
            harness.run_steps(4);
        };
        harness.state_mut().answer_file_dialogs(Vec::new());
        choose(&mut harness);
        assert_eq!(harness.state().state(), before, "{tab}: no file was chosen");
        harness.state_mut().answer_file_dialogs(vec![path.clone()]);
        choose(&mut harness);
        let now = params(&harness);
        assert_eq!((now.coast.name, now.sea.depth_m), (CoastName::File, 8.0), "{tab}");
        harness.get_by_label("asked.asc is the coast now.");
        assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    }
}

#[test]
fn hostile_bathymetries_change_nothing() {
    let mut harness = open(&format!("{SEA}&coast=bar&depth=11.4"));
    let state = harness.state().state();
    let whole = beach_grid();
    // Land with a single pond.
    let land = whole.replace('-', "").replace("nodata_value 9999", "nodata_value -9999").replacen("9.0 ", "-0.1 ", 1);
    let cases: [(&str, &[u8]); 6] = [
        ("cut.asc", &whole.as_bytes()[..whole.len() / 2]),
        ("huge.asc", b"ncols 99999999\nnrows 99999999\ncellsize 1\nxllcorner 0\nyllcorner 0\n1 2 3\n"),
        ("noise.tif", b"II*\0\xff\xff\xff\xff\xff\xff"),
        ("land.asc", land.as_bytes()),
        ("words.xyz", b"this is no place\n"),
        ("half.nc", b"CDF\x01\0\0\0\x05"),
    ];
    for (name, content) in cases {
        drop_file(&mut harness, name, content);
        assert_eq!(harness.state().state(), state, "{name}");
        // In the panel, and over the sea for who has closed it.
        assert_eq!(harness.query_all_by_label_contains(name).count(), 2, "{name}");
    }
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

/// Whoever changes the wind keeps the coast in sight: the land stays, and the waves follow when they are solved.
#[test]
fn the_coast_follows_the_wind() {
    let mut harness = open(&format!("{SEA}&coast=bar&depth=11.4"));
    solve(&mut harness);
    let windier = harness.state().state().replace("wind=6", "wind=9");
    harness.state_mut().set_state(&windier);
    harness.run_steps(2);
    assert!(!harness.state().is_coast_shown());
    solve(&mut harness);
    harness.render().expect("a picture");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}
