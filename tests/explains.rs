//! Sentences of the panel that explain the height of the waves, and words that a visitor can type in place of numbers.

mod common;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use seastate::app::App;
use seastate::state::{Params, query};

fn open(state: &str, size: [f32; 2]) -> Harness<'static, App> {
    common::harness::open(state, size, 1.0)
}

fn params(harness: &Harness<'_, App>) -> Params {
    query::parse(&harness.state().state()).0
}

fn click(harness: &mut Harness<'_, App>, label: &str) {
    harness.get_by_label(label).click();
    harness.run_steps(6);
}

/// Text of the only label that contains `words`.
fn text_with(harness: &Harness<'_, App>, words: &str) -> String {
    harness.get_by_label_contains(words).value().expect(words)
}

/// The number that follows `before` in `text`.
fn number_after(text: &str, before: &str) -> f64 {
    let rest = text.split(before).nth(1).expect(text);
    let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
    rest[..end].parse().expect(text)
}

#[test]
fn heights_of_wave_systems_add_up_before_the_visitors_eyes() {
    let mut harness = open("wind=15.5&fetch=20&scale2=1&hs2=1.8&tp2=12&n=64&pause=1", [900.0, 1500.0]);
    let why = text_with(&harness, "The wind has blown over only 20 km of water");
    assert!(why.contains("In a fully grown sea of this force they are 4.0 m high"), "{why}");
    let sum = text_with(&harness, "heights add as squares");
    let ([wind, swell], all) = (["√(", "² + "].map(|before| number_after(&sum, before)), number_after(&sum, "= "));
    assert!((wind.hypot(swell) - all).abs() < 0.11 && swell == 1.8, "{sum}");
    assert_eq!(number_after(&why, "its waves are "), wind, "{why} {sum}");
    click(&mut harness, "Study");
    // In deep water, waves of 12 s are 225 m long.
    harness.get_by_label("swell: 1.8 m high, 225 m long, every 12.0 s");
    harness.get_by_label_contains(&format!("wind sea: {wind:.1} m high, "));
    // The wind over the fetch of the textbook has nothing to explain, and one system no sum.
    harness.state_mut().set_state("wind=15.5&fetch=150&n=64&pause=1");
    click(&mut harness, "Weather");
    harness.get_by_label_contains("Textbook height 4.0 m, this sea 4.");
    for words in ["has blown over", "add as squares"] {
        assert!(harness.query_by_label_contains(words).is_none(), "{words}");
    }
    // Over a fetch far beyond the textbook's, the waves are higher.
    harness.state_mut().set_state("wind=15.5&fetch=1000&n=64&pause=1");
    harness.run_steps(3);
    harness.get_by_label_contains("The wind has blown over 1000 km of water, so its waves are ");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

/// A swell that is off says so in the words of the panel, and comes back by a button.
#[test]
fn a_system_that_is_off_is_switched_on_again() {
    let mut harness = open("scale2=1&hs2=3&n=64&pause=1", [900.0, 1500.0]);
    assert!(harness.query_by_label("Switch on: swell").is_none());
    click(&mut harness, "No swell");
    assert!(harness.query_by_label_contains("scale2").is_none(), "keys of links are not for visitors");
    harness.get_by_label("Switched off: swell.");
    click(&mut harness, "Switch on: swell");
    assert_eq!(harness.state().state(), "scale2=1&hs2=3&pause=1&n=64");
    assert!(harness.query_by_label("Switch on: swell").is_none());
}

/// Types a text into the number field of this name.
fn type_into(harness: &mut Harness<'static, App>, field: &str, text: &str) {
    let place = harness.get_by_label(field).rect().center();
    harness.drag_at(place);
    harness.drop_at(place);
    harness.run_steps(3);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    harness.run_steps(2);
    harness.event(egui::Event::Text(text.to_owned()));
    harness.run_steps(2);
    harness.key_press(egui::Key::Enter);
    harness.run_steps(3);
}

#[test]
fn a_force_may_be_typed_into_the_field_of_the_wind() {
    let mut harness = open("wind=8&n=64&pause=1", [900.0, 1500.0]);
    for (text, wind_m_s) in [("F9", 22.6), ("force 4", 6.7), ("Stärke 7", 15.5), ("12", 12.0)] {
        type_into(&mut harness, "Wind speed", text);
        assert_eq!(params(&harness).sea.first_system().wind_m_s, wind_m_s, "{text}");
    }
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
}

/// The line about frames is at hand on a screen, and behind dots on a phone. The wind's slider of a phone has a name.
#[test]
fn a_phone_hides_the_line_about_frames_until_it_is_asked_for() {
    let mut harness = open("wind=8&n=64&pause=1", [390.0, 844.0]);
    harness.get_by_label("Wind 8.0 m/s, force 5");
    assert!(harness.query_by_label_contains("ms a frame").is_none());
    click(&mut harness, "Time of a frame");
    let line = text_with(&harness, "ms a frame");
    assert!(line.contains("frames/s, n = 64, ") && line.contains("pixels"), "{line}");
    let harness = open("wind=8&n=64&pause=1", [1280.0, 720.0]);
    harness.get_by_label_contains("ms a frame");
}

/// "Link copied." appears beside the button that copies. The text over the sea names the file of a measured spectrum.
#[test]
fn the_panel_says_what_was_copied_and_whence_waves_are() {
    let mut harness = open("wind=8&n=64&pause=1", [900.0, 900.0]);
    click(&mut harness, "Share");
    assert!(harness.query_by_label("Link copied.").is_none());
    click(&mut harness, "Copy link");
    // Over the sea and beside the button.
    let [sea, beside] = [0, 1].map(|i| harness.query_all_by_label("Link copied.").nth(i).expect("twice").rect());
    let button = harness.get_by_label("Copy link").rect();
    let far = |text: egui::Rect| (text.center() - button.center()).length();
    assert!(far(sea).min(far(beside)) < 90.0, "{sea} {beside} {button}");
    click(&mut harness, "Try a spectrum");
    let summary = harness.ctx.memory(|m| m.area_rect(egui::Id::unique("summary"))).expect("a summary");
    let mut titles = harness.query_all_by_label_contains("two-systems.txt, ");
    assert!(titles.any(|title| summary.contains_rect(title.rect())), "whence they are stands over the sea");
}

/// A click on a number below the slider of the wind sets its force.
#[test]
fn the_marks_of_the_wind_can_be_clicked() {
    let mut harness = open("wind=5&n=64&pause=1", [900.0, 1500.0]);
    for (force, wind_m_s) in [(7.0, 15.5), (5.0, 9.3)] {
        let slider = harness.get_by_label("Beaufort").rect();
        // The middle of the handle keeps its radius away from both ends.
        let range = slider.x_range().shrink(slider.height() / 2.5);
        let place = egui::pos2(range.min + range.span() * force / 12.0, slider.bottom() + 8.0);
        harness.drag_at(place);
        harness.drop_at(place);
        harness.run_steps(6);
        assert_eq!(params(&harness).sea.first_system().wind_m_s, wind_m_s, "force {force}");
    }
}

/// A button gives the light of a time of the day, whether the sun stands by hand or by hour and date.
#[test]
fn a_button_makes_it_dusk() {
    for (state, has_sun) in [("sun=30&n=64&pause=1", true), ("sunby=date&day=80&lat=45&hour=9&n=64&pause=1", false)] {
        let mut harness = open(state, [900.0, 1500.0]);
        click(&mut harness, "Dusk");
        let sky = params(&harness).look.sky;
        let [elevation_deg, _] = sky.sun_elevation_azimuth_deg();
        assert!((elevation_deg + 4.0).abs() < 0.02, "{state}: {elevation_deg}");
        assert_eq!(harness.state().state().contains("sun=-4"), has_sun, "{}", harness.state().state());
        assert!(harness.query_by_label_contains("dusk or dawn").is_some());
    }
}
