//! The coast in the panel's tab of the weather: which one, and what it does to the waves.

use super::super::App;
use super::super::coast::COAST_NAMES;
use super::super::units::UnitScale;
use super::{button_with_help, coast_map, rows};
use crate::app::language::{say, text, tr};
use crate::coast::built_in::BuiltInCoast;
use crate::coast::effect::CoastEffect;
use crate::state::coast::CoastName;
use crate::state::presets;

/// Ratio of the highest to the arriving waves from which they are said to grow.
const GROWTH_TO_TELL: f64 = 1.05;
/// Ratio of the arriving waves to those of the sea below which it is told that others run elsewhere.
const SHARE_TO_TELL: f64 = 0.9;
/// Ratio of the arriving waves to those of the sea below which nothing else is worth telling.
const SHARE_TO_COUNT: f64 = 0.05;

/// Effects of a coast on waves, such as shoaling: the name of each, its explanation, and the named sea that shows it.
const EFFECTS: [(&str, &str, &str); 6] = [
    (
        text!("Shoaling"),
        text!(
            "In shallow water waves slow down. They draw together and grow, because their energy comes on as before."
        ),
        "Swell on a beach",
    ),
    (
        text!("Refraction"),
        text!(
            "The part of a crest in deeper water runs ahead. So crests turn towards the shore, and gather at headlands."
        ),
        "Headland and bay",
    ),
    (
        text!("Breaking"),
        text!("A wave that is nearly as high as the water is deep breaks, and rolls ashore as foam."),
        "Surf on a bar",
    ),
    (
        text!("Diffraction"),
        text!("Crests bend around an end into the calm behind it. Behind an island, waves from both sides cross."),
        "Around the island",
    ),
    (
        text!("Reflection"),
        text!("A steep wall throws waves back, and they stand before it. Rubble swallows most of them."),
        "Harbour entrance",
    ),
    (
        text!("Focusing"),
        text!("A hill under water bends waves together, as a lens bends light: behind it they are the highest."),
        "Over the shoal",
    ),
];

/// Adds the choice of the coast, and what it makes of the waves.
pub fn show_coast(app: &mut App, ui: &mut egui::Ui) {
    let now = app.params.coast.name;
    let mut chosen = now;
    ui.horizontal(|ui| {
        let label = ui.label(tr("Coast"));
        let name_of = |name: CoastName| COAST_NAMES.iter().find(|(each, _)| *each == name).map_or("", |(_, n)| tr(n));
        let list = egui::ComboBox::from_id_salt("coast").selected_text(name_of(now)).width(rows::slider_width(ui));
        let list = list.show_ui(ui, |ui| {
            for (name, _) in COAST_NAMES {
                ui.selectable_value(&mut chosen, name, name_of(name));
            }
        });
        list.response.labelled_by(label.id);
    });
    if chosen != now {
        app.choose_coast(chosen);
    }
    match (&app.params.coast.file, BuiltInCoast::find(now.word())) {
        (Some(file), _) => drop(ui.weak(&file.0.name)),
        (None, Some(coast)) => drop(ui.weak(tr(coast.about))),
        (None, None) => {}
    }
    if app.params.coast.is_on() {
        show_effect(app, ui);
    }
    ui.horizontal_wrapped(|ui| {
        if let Some(depth_m) = app.unlike_depth_m() {
            let depth = app.length_scale().format(depth_m, 1);
            let help = tr("Gives the sea the depth with which the coast begins, so that the waves go on as they come.");
            if button_with_help(ui, &say!("Make the sea {depth} deep", depth = depth), help) {
                app.params.sea.depth_m = depth_m;
            }
        }
        show_open_button(app, ui);
    });
}

/// Adds a sentence about what the coast makes of the waves, or how far its solution is.
fn show_effect(app: &App, ui: &mut egui::Ui) {
    app.coast.maps.is_visible.set(true);
    if let Some(progress) = app.coast_progress() {
        // The sea in words tells it already.
        if !app.panel.summary_is_shown {
            ui.label(progress);
        }
    } else if let Some(done) = app.coast.maps.progress() {
        ui.weak(say!("The map is being made: {percent} %", percent = (100.0 * done).floor()));
    } else if let Some(effect) = app.coast.maps.effect() {
        let hs_m = app.derived.theoretical_statistics.hs_m;
        ui.strong(effect_in_words(effect, hs_m, app.length_scale()));
    }
}

/// How high the waves of a sea with the significant height `hs_m` come to a coast, how high they grow, and where they
/// break.
fn effect_in_words(effect: &CoastEffect, hs_m: f64, scale: UnitScale) -> String {
    let metres = |m: f64| scale.format(m, 1);
    let (arriving, highest) = (effect.offshore_hs_m, metres(effect.highest_hs_m));
    if arriving < SHARE_TO_COUNT * hs_m {
        return say!("Hardly any of your {height} waves run towards this coast.", height = metres(hs_m));
    }
    let grow = effect.highest_hs_m >= GROWTH_TO_TELL * arriving;
    let come = if arriving >= SHARE_TO_TELL * hs_m {
        let height = metres(hs_m);
        if grow {
            say!("Your {height} waves grow to {highest} on their way ashore.", height = height, highest = highest)
        } else {
            say!("Your {height} waves hardly grow on their way ashore.", height = height)
        }
    } else {
        let part = say!(
            "Of your {height} waves, {part} run towards this coast.",
            height = metres(hs_m),
            part = metres(arriving)
        );
        let growth =
            if grow { say!("They grow to {highest}.", highest = highest) } else { tr("They hardly grow.").into() };
        format!("{part} {growth}")
    };
    let breaking = match (effect.breaking_depth_m, effect.breaking_distance_m) {
        (Some(depth_m), Some(distance_m)) => say!(
            "They begin to break about {distance} off the shore, in {depth} of water.",
            distance = rounded_distance(distance_m, scale),
            depth = metres(depth_m)
        ),
        (Some(depth_m), None) => say!("They begin to break in {depth} of water.", depth = metres(depth_m)),
        (None, _) => tr("They break nowhere.").to_owned(),
    };
    format!("{come} {breaking}")
}

/// A distance in tens of the shown unit; in single ones if it is short.
fn rounded_distance(distance_m: f64, scale: UnitScale) -> String {
    let step = if distance_m * scale.factor < 25.0 { 1.0 } else { 10.0 } / scale.factor;
    scale.format((distance_m / step).round() * step, 0)
}

/// Adds the map of the coast, and what coasts do to waves.
pub fn show_map_and_effects(app: &mut App, ui: &mut egui::Ui) {
    if app.params.coast.is_on() {
        let header = egui::CollapsingHeader::new(tr("Map of the coast")).default_open(true);
        header.show(ui, |ui| coast_map::show_map(app, ui));
    }
    egui::CollapsingHeader::new(tr("What coasts do to waves")).show(ui, |ui| show_effects(app, ui));
}

/// Adds the button that opens a coast's file.
pub fn show_open_button(app: &App, ui: &mut egui::Ui) {
    let help = tr("Depths and heights: GeoTIFF, NetCDF, ESRI ASCII grid, or text of x, y, z. Dropping works, too.");
    if button_with_help(ui, tr("Open a coast…"), help) {
        app.choose_files();
    }
}

/// Adds a line about each effect, with the named sea that shows it.
fn show_effects(app: &mut App, ui: &mut egui::Ui) {
    for (effect, meaning, sea) in EFFECTS {
        ui.horizontal_wrapped(|ui| {
            ui.strong(tr(effect));
            let Some(preset) = presets::built_in().iter().find(|preset| preset.name == sea) else { return };
            let example = say!("Example: {sea}", sea = tr(sea));
            if ui.small_button(example).on_hover_text(tr(&preset.about)).clicked() {
                app.open_preset(preset);
            }
        });
        ui.label(tr(meaning));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::Params;
    use crate::state::params::Units;

    #[test]
    fn the_effect_is_told_as_far_as_there_is_one() {
        let metric = UnitScale::for_unit("m", Units::Metric);
        let effect = CoastEffect {
            offshore_hs_m: 2.18,
            highest_hs_m: 2.61,
            highest_depth_m: 5.0,
            breaking_depth_m: Some(4.25),
            breaking_distance_m: Some(88.0),
        };
        assert_eq!(
            effect_in_words(&effect, 2.2, metric),
            "Your 2.2 m waves grow to 2.6 m on their way ashore. They begin to break about 90 m off the shore, in \
             4.2 m of water."
        );
        let calm = CoastEffect { highest_hs_m: 2.19, breaking_depth_m: None, breaking_distance_m: None, ..effect };
        assert_eq!(
            effect_in_words(&calm, 2.2, metric),
            "Your 2.2 m waves hardly grow on their way ashore. They break nowhere."
        );
        let oblique = CoastEffect { offshore_hs_m: 1.5, breaking_distance_m: None, ..effect };
        assert_eq!(
            effect_in_words(&oblique, 2.2, metric),
            "Of your 2.2 m waves, 1.5 m run towards this coast. They grow to 2.6 m. They begin to break \
             in 4.2 m of water."
        );
        let away = CoastEffect { offshore_hs_m: 0.04, ..effect };
        assert_eq!(effect_in_words(&away, 2.2, metric), "Hardly any of your 2.2 m waves run towards this coast.");
        let feet = UnitScale::for_unit("m", Units::Nautical);
        assert_eq!([rounded_distance(88.0, feet), rounded_distance(7.2, metric)], ["290 ft", "7 m"]);
    }

    #[test]
    fn each_effect_has_a_named_sea_with_a_coast() {
        for (effect, _, sea) in EFFECTS {
            let preset = presets::built_in().iter().find(|preset| preset.name == sea).expect(sea);
            assert!(preset.apply(&Params::default()).0.coast.is_on(), "{effect}");
            assert!(preset.about.to_lowercase().contains(&effect.to_lowercase()), "{sea} says nothing of {effect}");
        }
    }
}
