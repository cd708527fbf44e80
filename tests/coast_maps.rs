//! The map of the coast and its gauges: the records of the drawn sea against the statistics of its transfer, and the
//! panel under egui_kittest, which shows the map, places gauges and saves files.

mod common;

use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable};
use seastate::app::App;
use seastate::coast::transfer::StatisticsSolver;
use seastate::files::netcdf::Dataset;
use seastate::point::StrongestWaves;
use seastate::waves::Plan;
use std::path::{Path, PathBuf};

/// Records of half an hour of the drawn sea have the wave height that its statistics give, on the way up to the shore.
/// The open sea's height would be wrong near the shore.
#[test]
fn records_of_the_drawn_sea_have_the_height_of_the_map() {
    const SEEDS: u32 = 6;
    // Depths, m, of two gauges in the middle row.
    let depths_m = [7.0, 1.2];
    let (mut drawn, mut expected, mut open) = ([0.0; 2], [0.0; 2], 0.0);
    for seed in 0..SEEDS {
        let state = format!("coast=beach&depth=12&hs=2&tp=9&dir=255&n=64&order=1&chop=0&seed={seed}");
        let params = common::params(&state);
        let plan = Plan::new(&params);
        let transfer = common::coast_transfer(&params, 120, 64);
        let found = StatisticsSolver::new(transfer.clone(), &plan).expect("the same lattice").finish();
        let sea = StrongestWaves::new(&plan, 1500).with_coast(&plan, &transfer);
        open += found.open_hs_m().powi(2) / f64::from(SEEDS);
        for (gauge, depth_m) in depths_m.into_iter().enumerate() {
            let row = transfer.rows / 2;
            let column = (0..transfer.columns).rfind(|i| found.bathymetry.at(*i, row) >= depth_m).expect("water");
            let place = transfer.world_m([column, row].map(|index| index as f64 * transfer.cell_m));
            let record = sea.height_record(place, 500.0, 1.5, 1200);
            let mean = record.iter().sum::<f64>() / record.len() as f64;
            let variance = record.iter().map(|h| (h - mean).powi(2)).sum::<f64>() / record.len() as f64;
            drawn[gauge] += 16.0 * variance / f64::from(SEEDS);
            let hs_m = f64::from(found.maps.hs_m[row * transfer.columns + column]);
            expected[gauge] += hs_m * hs_m / f64::from(SEEDS);
        }
    }
    eprintln!("squares of Hs, m^2: open {open:.3}, drawn {drawn:.3?}, expected {expected:.3?}");
    for gauge in 0..2 {
        // Each seed has about 60 waves of similar strength, and a record of 200 waves: their variance has a standard
        // error of 18 %, that of six seeds one of 7 %.
        let ratio = drawn[gauge] / expected[gauge];
        assert!((ratio - 1.0).abs() < 0.2, "gauge {gauge}: {ratio}");
    }
    assert!(drawn[1] < 0.6 * open, "waves break before the second gauge: {drawn:?} {open}");
}

/// The number that follows `before` in `words`, up to a space.
fn number_after(words: &str, before: &str) -> f64 {
    let at = words.split(before).nth(1).expect(words);
    at.split(' ').next().and_then(|number| number.parse().ok()).expect(at)
}

/// A window in which the tab of the weather has room to its end.
const SIZE: [f32; 2] = [900.0, 2200.0];
const SEA: &str = "coast=beach&depth=12&hs=1.5&tp=9&dir=255&n=64&pause=1&mesh=0.1&renderscale=0.25";

/// Draws frames until `is_done`.
fn run_until(harness: &mut Harness<'_, App>, what: &str, is_done: impl Fn(&Harness<'_, App>) -> bool) {
    for _ in 0..6000 {
        harness.run_steps(1);
        if is_done(harness) {
            return;
        }
        if !harness.state().is_coast_shown() {
            std::thread::park_timeout(std::time::Duration::from_millis(10));
        }
    }
    panic!("never: {what}");
}

fn click_at(harness: &mut Harness<'_, App>, at: egui::Pos2) {
    harness.hover_at(at);
    harness.run_steps(1);
    harness.drag_at(at);
    harness.run_steps(1);
    harness.drop_at(at);
    harness.run_steps(2);
}

/// The numbers of a line of the CSV about a gauge: x, y, depth, Hs, Tp, from, breaking.
fn numbers(line: &str) -> Vec<f64> {
    let words = line.split_once(':').expect("a colon").1.split(|c: char| !(c.is_ascii_digit() || "+-.".contains(c)));
    words.filter_map(|word| word.parse().ok()).collect()
}

/// The texts of the interface that contain `part`.
fn texts(harness: &Harness<'_, App>, part: &str) -> Vec<String> {
    let nodes = harness.query_all_by_label_contains(part).map(|node| node.accesskit_node());
    nodes.filter_map(|node| node.label().or_else(|| node.value())).collect()
}

fn saved(folder: &Path, ending: &str) -> PathBuf {
    let files = std::fs::read_dir(folder).expect("the folder").map(|entry| entry.expect("an entry").path());
    files.into_iter().find(|path| path.extension().is_some_and(|e| e == ending)).expect("a saved file")
}

#[test]
fn the_map_is_shown_and_its_gauges_tell_the_same_sea() {
    let folder = std::env::temp_dir().join(format!("seastate-coast-maps-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut harness = common::harness::open(SEA, SIZE, 1.0);
    harness.state_mut().set_save_folder(folder.clone());
    run_until(&mut harness, "the map", |h| h.query_by_label("Map: Wave height").is_some());
    // `seastate coast` finds 4 % of the waves breaking in 2.5 m, and 9 % in 1.7 m. The drawn waves are 3 % higher.
    let words = harness.get_by_label_contains("waves grow to 1.7 m on their way ashore.").accesskit_node().value();
    let words = words.expect("words");
    assert_eq!(number_after(&words, "Your "), 1.5, "{words}");
    let depth_m = number_after(&words, " off the shore, in ");
    assert!((1.7..2.9).contains(&depth_m), "{words}");
    // Dean's profile of the beach is 0.1 (x/m)^(2/3) m deep at the distance x from the shore. The depth is told in
    // steps of 0.25 m, which are 15 % of the distance.
    let distance_m = number_after(&words, "They begin to break about ");
    let by_profile_m = (depth_m / 0.1).powf(1.5);
    assert!((distance_m / by_profile_m - 1.0).abs() < 0.25, "{words} {by_profile_m}");
    harness.render().expect("a picture").save(pictures().join("map-height.png")).expect("a file");
    // Land is at the top: no gauge there.
    let map = harness.get_by_label("Map: Wave height").rect();
    click_at(&mut harness, map.lerp_inside(egui::vec2(0.5, 0.01)));
    harness.get_by_label_contains("There is no water there.");
    assert!(harness.query_by_label("Gauge 1").is_none());
    click_at(&mut harness, map.lerp_inside(egui::vec2(0.3, 0.7)));
    harness.get_by_label("Gauge 1");
    harness.get_by_label("Gauge at the camera").click();
    harness.run_steps(2);
    harness.get_by_label("Gauge 2");
    // A screen reader's click on the map, which points at no place, does the same; there is room for four.
    for number in 3..6 {
        harness.get_by_label("Map: Wave height").click_accesskit();
        harness.run_steps(2);
        assert_eq!(harness.query_by_label(&format!("Gauge {number}")).is_some(), number < 5, "{number}");
    }
    harness.get_by_label_contains("There is no room for more.");
    for number in [4, 3] {
        harness.get_by_label(&format!("Remove gauge {number}")).click();
        harness.run_steps(2);
    }
    // The place of the first gauge is that of the click.
    let value = |h: &Harness<'_, App>, name: &str| {
        let field = h.query_all_by_label(name).find_map(|node| node.accesskit_node().numeric_value());
        field.expect("a number")
    };
    let along = value(&harness, "Gauge 1, along the shore");
    for button in ["Save the fields (NetCDF)", "Save the gauges (CSV)"] {
        harness.get_by_label(button).click();
        harness.run_steps(3);
    }
    // The saved files can be read, and the gauges have the numbers of the map.
    let bytes = std::fs::read(saved(&folder, "nc")).expect("the fields");
    let file = Dataset::open(&bytes).expect("a NetCDF file");
    let values = |name: &str| file.numbers(file.find(name).expect(name)).expect("values");
    let ([x, y], [hs, depth, tp]) = (["x", "y"].map(values), ["hs", "depth", "tp"].map(values));
    let csv = std::fs::read_to_string(saved(&folder, "csv")).expect("the gauges");
    let lines: Vec<&str> = csv.lines().filter(|line| line.starts_with("# gauge")).collect();
    assert_eq!(lines.len(), 2, "{csv}");
    for line in &lines {
        let n = numbers(line);
        let nearest = |axis: &[f64], at: f64| {
            (0..axis.len()).min_by(|a, b| (axis[*a] - at).abs().total_cmp(&(axis[*b] - at).abs())).expect("a point")
        };
        let point = nearest(&y, n[1]) * x.len() + nearest(&x, n[0]);
        assert!((hs[point] - n[3]).abs() < 1e-3 && (depth[point] - n[2]).abs() < 0.01, "{line} {}", hs[point]);
        assert!((tp[point] - n[4]).abs() < 0.01 && n[3] > 0.3, "{line}");
        // The panel shows the same, with fewer digits.
        let is_same = |text: &String| {
            let shown = numbers(&format!(":{text}"));
            [0, 1, 2, 3].iter().all(|i| (shown[*i] - n[2 + i]).abs() <= [0.051, 0.0051, 0.051, 0.51][*i])
        };
        let texts = texts(&harness, "depth ");
        assert!(texts.iter().any(is_same), "{line}: {texts:?}");
    }
    let first = numbers(lines[0]);
    let length = y.last().expect("points");
    assert!((along - first[1]).abs() < 1.0 && (first[1] / length - 0.3).abs() < 0.02, "{along} {first:?} {length}");
    // Spectra: the variance under the curve is that of the height.
    let table: Vec<Vec<f64>> = csv.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit())).map(row).collect();
    let m0: f64 = table.windows(2).map(|w| 0.5 * (w[0][2] + w[1][2]) * (w[1][0] - w[0][0])).sum();
    assert!((4.0 * m0.sqrt() / first[3] - 1.0).abs() < 0.08, "{} {}", 4.0 * m0.sqrt(), first[3]);
    check_record(&mut harness, first[3]);
    // Gauges are removed, and go with their coast.
    harness.get_by_label("Remove gauge 2").click();
    harness.run_steps(2);
    assert!(harness.query_by_label("Gauge 2").is_none());
    let other = harness.state().state().replace("coast=beach", "coast=bar");
    harness.state_mut().set_state(&other);
    harness.run_steps(3);
    assert!(harness.query_by_label("Gauge 1").is_none() && harness.query_by_label("Map: Wave height").is_none());
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}

/// The numbers of a line of a table.
fn row(line: &str) -> Vec<f64> {
    line.split(',').map(|cell| cell.parse().expect("a number")).collect()
}

/// The record of the first gauge grows to half an hour, and has the height `hs_m` of theory within its sampling error.
fn check_record(harness: &mut Harness<'_, App>, hs_m: f64) {
    for quantity in ["Depth", "Wave direction", "Breaking"] {
        harness.get_by_role_and_label(egui::accesskit::Role::Button, quantity).click();
        harness.run_steps(3);
        harness.get_by_label(&format!("Map: {quantity}"));
        let name = quantity.to_lowercase().replace(' ', "-");
        harness.render().expect("a picture").save(pictures().join(format!("map-{name}.png"))).expect("a file");
    }
    harness.get_by_label("Plots of gauge 1").click();
    run_until(harness, "a record", |h| h.query_by_label_contains("Hs of 30 min of record").is_some());
    harness.render().expect("a picture").save(pictures().join("gauge.png")).expect("a file");
    let text = texts(harness, "Hs of 30 min of record").remove(0);
    let number = |after: &str| -> f64 {
        let rest = text.split(after).nth(1).and_then(|rest| rest.split(' ').next()).expect("a word");
        rest.parse().expect("a height")
    };
    let [measured, theory] = ["record ", "theory "].map(number);
    // About 60 waves of similar strength: a standard error of 9 % of the height.
    assert!((measured / hs_m - 1.0).abs() < 0.25, "{text}");
    assert!((theory - hs_m).abs() < 0.0051, "{text}");
}

fn pictures() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("coast-maps");
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}
