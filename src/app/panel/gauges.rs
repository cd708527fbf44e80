//! The gauges on the map of the coast: where they stand, the sea there, their plots, and the buttons that save.

use super::super::App;
use super::super::accessible_names::with_accessible_name;
use super::super::coast_maps::{MAX_GAUGES, sea_at};
use super::super::plots::gauge::{in_words, show_record, show_spectrum};
use super::button_with_help;
use crate::app::language::{say, tr};

/// Places a gauge at (x, y), m, of the coast's frame. A message says why if it cannot be placed.
pub fn place(app: &mut App, at_m: [f64; 2]) {
    if let Err(why) = app.coast.maps.place(at_m) {
        app.show_brief_message(tr(why));
    }
}

/// Adds the gauges and the buttons below the map.
pub fn show_gauges(app: &mut App, ui: &mut egui::Ui) {
    let Some(statistics) = app.coast.maps.statistics().cloned() else { return };
    ui.weak(tr("Land is at the top. A click places a gauge."));
    ui.horizontal_wrapped(|ui| {
        let has_room = app.coast.maps.gauges.len() < MAX_GAUGES;
        let help = tr("Places a gauge in the water below the camera.");
        let button = ui.add_enabled(has_room, egui::Button::new(tr("Gauge at the camera")));
        if button.on_hover_text(help).clicked() {
            let camera = &app.params.camera;
            let at_m = statistics.transfer().in_frame_m([camera.x_m, camera.z_m]);
            place(app, at_m);
        }
        let help = tr("Depth, height, direction, period and breaking at all points, as a file of the CF conventions.");
        if button_with_help(ui, tr("Save the fields (NetCDF)"), help) {
            app.save_coast_fields();
        }
        let has_any = !app.coast.maps.gauges.is_empty();
        let button = ui.add_enabled(has_any, egui::Button::new(tr("Save the gauges (CSV)")));
        if button.on_hover_text(tr("The sea at the gauges, with its spectra.")).clicked() {
            app.save_coast_gauges();
        }
    });
    let mut removed = None;
    for index in 0..app.coast.maps.gauges.len() {
        let number = index + 1;
        ui.horizontal(|ui| {
            ui.strong(say!("Gauge {number}", number = number));
            show_place(app, index, ui);
            let button = ui.small_button("×");
            if with_accessible_name(button, &say!("Remove gauge {number}", number = number)).clicked() {
                removed = Some(index);
            }
        });
        let sea = sea_at(&statistics, app.coast.maps.gauges[index].point);
        ui.label(in_words(app, &sea));
        let header = egui::CollapsingHeader::new(say!("Plots of gauge {number}", number = number));
        header.id_salt(("plots of gauge", number)).show(ui, |ui| {
            let gauge = (number, &app.coast.maps.gauges[index]);
            show_spectrum(app, gauge, ui);
            show_record(app, gauge, &sea, ui);
        });
    }
    if let Some(index) = removed {
        app.coast.maps.gauges.remove(index);
    }
}

/// Adds two number fields for the place of a gauge, from the sea to the land and along the shore. The gauge stays in the
/// water.
fn show_place(app: &mut App, index: usize, ui: &mut egui::Ui) {
    let (scale, number) = (app.length_scale(), index + 1);
    let Some(statistics) = app.coast.maps.statistics().cloned() else { return };
    let grid = &statistics.bathymetry;
    let before = app.coast.maps.gauges[index].point;
    let mut at_m = before.map(|index| index as f64 * grid.cell_m);
    let names = [
        say!("Gauge {number}, from the sea to the land", number = number),
        say!("Gauge {number}, along the shore", number = number),
    ];
    let mut is_changed = false;
    for (axis, count) in [grid.columns, grid.rows].into_iter().enumerate() {
        let mut shown = at_m[axis] * scale.factor;
        let most = (count - 1) as f64 * grid.cell_m * scale.factor;
        let field = egui::DragValue::new(&mut shown).range(0.0..=most).max_decimals(0).suffix(scale.suffix());
        let field = ui.add(field.speed(grid.cell_m * scale.factor));
        field.widget_info(|| egui::WidgetInfo::slider(true, shown, &names[axis]));
        let field = field.on_hover_text(&names[axis]);
        if field.changed() {
            (at_m[axis], is_changed) = (shown / scale.factor, true);
        }
    }
    if let Some(point) = app.coast.maps.wet_point(at_m).filter(|point| is_changed && *point != before) {
        let gauge = &mut app.coast.maps.gauges[index];
        gauge.point = point;
        gauge.record.clear();
    }
}
