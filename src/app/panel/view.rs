//! The panel's tab of the view: camera, time, and floating objects.

use super::super::App;
use super::super::accessible_names::with_accessible_name;
use super::{button_with_help, time};
use crate::app::language::{say, tr};
use crate::state::floats::FloatingObjectKind;
use crate::state::motion;

/// Adds the widgets of the tab.
pub fn show_view(app: &mut App, ui: &mut egui::Ui) {
    ui.strong(tr("Look from"));
    show_camera_views(app, ui);
    if app.visitor.slow_camera.is_allowed() {
        let mut moves = app.visitor.preferences.slow_camera;
        let switch = ui.checkbox(&mut moves, tr("Slow camera while nobody touches"));
        let help = tr("After some seconds without input the view turns a little to and fro. The link stays as it is.");
        if switch.on_hover_text(help).changed() {
            app.change_preferences(|preferences| preferences.slow_camera = moves);
        }
    }
    app.show_tilt_button(ui);
    ui.add_space(8.0);
    ui.strong(tr("Simulated time"));
    time::show_time_controls(app, ui);
    ui.add_space(8.0);
    ui.strong(tr("Afloat"));
    show_floating_objects(app, ui);
}

/// Adds a button for each named view of the camera.
fn show_camera_views(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        for view in motion::CAMERA_VIEWS {
            if button_with_help(ui, tr(view.name), tr(view.about)) {
                motion::set_named_view(&mut app.params, view);
            }
        }
    });
}

/// Adds the widgets that place, list and remove floating objects.
fn show_floating_objects(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        for kind in FloatingObjectKind::ALL {
            let on = app.placing == Some(kind);
            let help = tr("Then click on the sea where it shall be moored.");
            let button = egui::Button::new(say!("Moor a {object}", object = tr(kind.word()))).selected(on);
            if ui.add(button).on_hover_text(help).clicked() {
                app.placing = (!on).then_some(kind);
            }
        }
    });
    if app.placing.is_some() {
        ui.strong(tr("Now click the water where it shall float."));
    }
    let mut lifted = None;
    for (i, float) in app.params.floating_objects.iter().enumerate() {
        ui.horizontal(|ui| {
            let height = app.derived.strongest_waves().sample(float.x_m, float.z_m, app.params.clock.t_s).height_m;
            let metres = app.length_scale();
            let [east, south] = [float.x_m, float.z_m];
            let side =
                |x: f64, words: [&str; 2]| format!("{} {}", metres.format(x.abs(), 0), words[usize::from(x < 0.0)]);
            let (east, south) = (side(east, [tr("east"), tr("west")]), side(south, [tr("south"), tr("north")]));
            ui.label(say!(
                "{object} at {east}, {south}: {height}",
                object = tr(float.kind.word()),
                east = east,
                south = south,
                height = metres.format(height, 2)
            ));
            let cross = ui.small_button("×").on_hover_text(tr("Lifts it out of the water."));
            if with_accessible_name(
                cross,
                &say!("Lift {object} {number}", object = tr(float.kind.word()), number = i + 1),
            )
            .clicked()
            {
                lifted = Some(i);
            }
        });
    }
    if let Some(i) = lifted {
        app.params.floating_objects.remove(i);
    }
    if app.params.floating_objects.is_empty() {
        ui.weak(tr(
            "Or press B over the water. The first floating object keeps a record of the height: see the plots.",
        ));
    }
}
