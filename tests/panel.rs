//! Every parameter of FIELDS is set by the panel and carried by the state string.

mod common;

use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use seastate::app::App;
use seastate::state::fields::{FIELDS, Field, FieldKind};
use seastate::state::params::Interface;
use seastate::state::{Params, query};

/// Two values that differ from the default; twice the same if there is only one.
fn others(field: &Field) -> [f64; 2] {
    let default = field.default_value();
    let candidates: Vec<f64> = match field.kind {
        FieldKind::Number { min, max, .. } => [0.3, 0.6, 0.45].map(|s: f64| min + s * (max - min)).to_vec(),
        FieldKind::Heading => [70.0, 200.5, 311.0].to_vec(),
        FieldKind::Integer { min, max } => (min..=max).take(4).map(f64::from).chain([f64::from(max)]).collect(),
        FieldKind::Choice(words) => (0..words.len()).map(|i| i as f64).collect(),
        FieldKind::Flag => vec![0.0, 1.0],
        FieldKind::Colour => [0x0012_3456, 0x00fe_dcba].map(f64::from).to_vec(),
    };
    let mut taken = candidates.into_iter().filter_map(|v| field.check_value(v).ok()).filter(|v| *v != default);
    let first = taken.next().unwrap_or_else(|| panic!("{} has one value only", field.key));
    [first, taken.next().unwrap_or(first)]
}

#[test]
fn the_state_string_carries_every_parameter_exactly() {
    for field in FIELDS.iter() {
        for value in others(field) {
            let mut params = Params::default();
            (field.set)(&mut params, value);
            assert_eq!((field.get)(&params), value, "{}", field.key);
            let state = query::write(&params);
            let without_version = state.strip_prefix("v=2&").unwrap_or(&state);
            assert_eq!(without_version, format!("{}={}", field.key, field.format(value)));
            let (read, notices) = query::parse(&state);
            assert_eq!((read, notices), (params, Vec::new()), "{state}");
        }
    }
}

fn params(harness: &Harness<'_, App>) -> Params {
    query::parse(&harness.state().state()).0
}

/// The widget of a row: it has the row's label as its name and the height of the row's reset button.
fn widget<'a>(harness: &'a Harness<'_, App>, field: &Field) -> egui_kittest::Node<'a> {
    let row = harness.get_by_label(&cross(field)).rect().center().y;
    let far = |node: &egui_kittest::Node<'_>| (node.rect().center().y - row).abs();
    let mut named = harness.query_all_by_label(field.label);
    named
        .find(|node| node.accesskit_node().role() != egui::accesskit::Role::Label && far(node) < 12.0)
        .unwrap_or_else(|| panic!("{} is not in the panel", field.key))
}

/// Name of a row's reset button; labels alone are not unique, because all wave systems have the same ones.
fn cross(field: &Field) -> String {
    format!("{}, {}: back to the default", field.group.label(), field.label)
}

/// A sea that is quick to compute, with stopped time.
const BASE: &str = "pause=1&n=64&cascades=1";

#[test]
fn the_panel_sets_every_parameter_and_takes_it_back() {
    let mut harness = Harness::builder()
        .with_size(egui::vec2(900.0, 6000.0))
        .with_pixels_per_point(1.0)
        .wgpu_setup(seastate::app::setup::wgpu_configuration().wgpu_setup)
        .build_eframe(|cc| App::with_sky(cc, BASE, Some(common::skies::made_up_sky(40.0))).expect("a device"));
    harness.run_steps(3);
    harness.get_by_label("Study").click();
    harness.run_steps(3);
    for field in FIELDS.iter() {
        // A row without effect is grey: first comes what the program says would wake it.
        let mut base = BASE.to_owned();
        while let Some(why) = field.inactive_because(&query::parse(&base).0) {
            // Only a sky from a file wakes the parameters that no setting can wake.
            let waking = if why.waking.is_empty() { "sky=made-up.hdr" } else { why.waking };
            base = format!("{base}&{waking}");
            if why.waking.is_empty() {
                break;
            }
        }
        harness.state_mut().set_state(&base);
        harness.run_steps(2);
        harness.get_by_label("Clear the search").click();
        harness.run_steps(2);
        harness.get_by_label("Search").focus();
        harness.run_steps(2);
        harness.get_by_label("Search").type_text(field.key);
        harness.run_steps(3);
        let [value, _] = others(field);
        let before = (field.get)(&params(&harness));
        let value = if value == before { others(field)[1] } else { value };
        match field.kind {
            FieldKind::Number { .. } | FieldKind::Integer { .. } | FieldKind::Heading => {
                widget(&harness, field).set_value_accesskit(value);
                harness.run_steps(2);
                let now = (field.get)(&params(&harness));
                // A slider rounds the value to the digits that it shows.
                assert!((now - value).abs() <= 0.01 * value.abs().max(0.1), "{}: {now} instead of {value}", field.key);
            }
            FieldKind::Flag => {
                widget(&harness, field).click_accesskit();
                harness.run_steps(2);
                assert_eq!((field.get)(&params(&harness)), 1.0 - before, "{}", field.key);
            }
            FieldKind::Choice(words) => {
                widget(&harness, field).click_accesskit();
                harness.run_steps(4);
                let word = words[value as usize];
                let chosen = harness.get_all_by_label(word).last().expect("a word");
                chosen.click_accesskit();
                harness.run_steps(4);
                assert_eq!((field.get)(&params(&harness)), value, "{}", field.key);
            }
            FieldKind::Colour => {
                // The colour picker belongs to egui: the test only opens it.
                widget(&harness, field).click_accesskit();
                harness.run_steps(3);
                harness.key_press(egui::Key::Escape);
                harness.run_steps(3);
                let mut with = params(&harness);
                (field.set)(&mut with, value);
                harness.state_mut().set_state(&query::write(&with));
                harness.run_steps(2);
            }
        }
        if params(&harness).screen.interface != Interface::Panel {
            continue;
        }
        // A link to the state opens exactly this value.
        let set = params(&harness);
        harness.state_mut().set_state(&query::write(&set));
        harness.run_steps(2);
        let mut now = params(&harness);
        if !now.clock.paused {
            now.clock.t_s = set.clock.t_s;
        }
        assert_eq!(now, set, "{}", field.key);
        harness.get_by_label(&cross(field)).click_accesskit();
        harness.run_steps(2);
        assert_eq!((field.get)(&params(&harness)), field.default_value(), "{}", field.key);
    }
}
