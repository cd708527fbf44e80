//! The panel: read-outs, every parameter of FIELDS, the spectrum, and what went wrong.

use super::{App, plots};
use crate::model::Params;
use crate::model::fields::{FIELDS, Field, Group, Kind};

/// Below this width the panel starts collapsed: a phone shows the sea first.
const NARROW_POINTS: f32 = 640.0;

/// Shows the panel over the sea.
pub fn show(app: &mut App, ctx: &egui::Context) {
    let screen = ctx.content_rect();
    egui::Window::new("Seastate")
        .default_pos(screen.right_top() + egui::vec2(-356.0, 12.0))
        .default_width(330.0)
        .default_open(screen.width() > NARROW_POINTS)
        .vscroll(true)
        .max_height(screen.height() - 60.0)
        .show(ctx, |ui| {
            read_outs(app, ui);
            notices(app, ui);
            for group in Group::ALL {
                egui::CollapsingHeader::new(group.label()).default_open(group == Group::Sea).show(ui, |ui| {
                    fields(&mut app.params, group, ui);
                    if group == Group::Sky {
                        sky_file(&mut app.params, ui);
                    }
                });
            }
            egui::CollapsingHeader::new("Spectrum").show(ui, |ui| plots::spectrum(&app.derived.plan, ui));
            egui::CollapsingHeader::new("This program").show(ui, |ui| about(app, ui));
        });
}

fn read_outs(app: &mut App, ui: &mut egui::Ui) {
    let t = &app.derived.theory;
    egui::Grid::new("read-outs").num_columns(4).show(ui, |ui| {
        let value = |ui: &mut egui::Ui, label: &str, text: String, help: &str| {
            ui.weak(label).on_hover_text(help);
            ui.strong(text).on_hover_text(help);
        };
        value(
            ui,
            "Hs",
            format!("{:.2} m", t.hs_m),
            "Significant wave height, 4 sqrt(m0): the mean of the highest third.",
        );
        value(ui, "Tp", format!("{:.1} s", t.tp_s), "Period of the peak of the spectrum.");
        ui.end_row();
        value(ui, "Length", format!("{:.0} m", t.lambda_p_m), "Wavelength of the peak.");
        value(ui, "Tz", format!("{:.1} s", t.tm02_s), "Mean zero-crossing period, 2 pi sqrt(m0 / m2).");
        ui.end_row();
        let from = t.mean_from_deg.map_or("none".to_owned(), |d| format!("{d:.0}°"));
        value(ui, "From", from, "Mean direction that the waves come from, clockwise from north.");
        value(
            ui,
            "Spread",
            format!("{:.0}°", t.spread_deg),
            "Directional spread sqrt(2 (1 - r1)), weighted by energy: 81° is no direction at all.",
        );
        ui.end_row();
    });
    egui::CollapsingHeader::new("More numbers").show(ui, |ui| more_numbers(app, ui));
    ui.horizontal(|ui| {
        let clock = &mut app.params.clock;
        if ui.button(if clock.paused { "Play" } else { "Pause" }).clicked() {
            clock.paused = !clock.paused;
        }
        ui.label(format!("t = {:.1} s", clock.t_s));
        if ui.button("Copy link").on_hover_text("Copies the state of this sea and camera.").clicked() {
            ui.ctx().copy_text(link(app));
        }
        if ui.button("Reset").on_hover_text("Every value back to its default.").clicked() {
            app.set_state("");
        }
    });
}

/// Theory beside what the cascades hold.
fn more_numbers(app: &App, ui: &mut egui::Ui) {
    let (t, r) = (&app.derived.theory, app.derived.resolved());
    egui::Grid::new("more numbers").num_columns(3).striped(true).show(ui, |ui| {
        let mut row = |label: &str, theory: String, resolved: String, help: &str| {
            ui.weak(label).on_hover_text(help);
            ui.label(theory).on_hover_text(help);
            ui.label(resolved).on_hover_text(help);
            ui.end_row();
        };
        let none = String::new;
        row("", "theory".into(), "computed".into(), "What the spectrum promises, and what the waves on the grid hold.");
        row("Hs", format!("{:.3} m", t.hs_m), format!("{:.3} m", r.hs_m), "Significant wave height, 4 sqrt(m0).");
        row("Tm01", format!("{:.2} s", t.tm01_s), format!("{:.2} s", r.tm01_s), "Mean period, 2 pi m0 / m1.");
        row("Tm02", format!("{:.2} s", t.tm02_s), format!("{:.2} s", r.tm02_s), "Mean zero-crossing period.");
        row("Mean length", format!("{:.1} m", t.lambda_mean_m), none(), "Wavelength of the mean period Tm01.");
        row(
            "Steepness",
            format!("{:.4}", t.steepness),
            none(),
            "Hs over the wavelength of the peak; waves break near 0.07.",
        );
        row(
            "Slopes",
            format!("{:.4}", t.mss),
            format!("{:.4}", r.mss),
            &format!("Mean square slope of waves longer than {:.2} m.", std::f64::consts::TAU / t.k_max.max(1e-9)),
        );
        row("Spread", format!("{:.1}°", t.spread_deg), format!("{:.1}°", r.spread_deg), "Directional spread.");
        row(
            "Benjamin-Feir",
            format!("{:.2}", t.benjamin_feir),
            none(),
            "Benjamin-Feir index: near 1 freak waves become likely in a narrow, long-crested sea (Janssen 2003).",
        );
        row(
            "Whitecaps",
            format!("{:.2} %", 100.0 * t.whitecap_fraction),
            none(),
            "Coverage by whitecaps at this wind (Monahan and O'Muircheartaigh 1980).",
        );
        row("Energy held", none(), format!("{:.2} %", 100.0 * r.m0_fraction), "Share of the variance on the grid.");
    });
}

/// The page's address with the state, or on the desktop the bare state string.
fn link(app: &App) -> String {
    #[cfg(target_arch = "wasm32")]
    return super::web::link(&app.state());
    #[cfg(not(target_arch = "wasm32"))]
    app.state()
}

fn notices(app: &App, ui: &mut egui::Ui) {
    let missing = app.params.look.sky.missing_file();
    for text in app.notices.iter().chain(&app.derived.plan.notices).chain(&missing) {
        ui.colored_label(egui::Color32::from_rgb(240, 200, 110), text);
    }
    for text in app.errors() {
        ui.colored_label(egui::Color32::from_rgb(255, 130, 120), text);
    }
}

/// The sky's file by name, and the way back to the built sky.
fn sky_file(params: &mut Params, ui: &mut egui::Ui) {
    let Some(file) = &params.look.sky.file else {
        ui.weak("Drop a .hdr or .exr file for another sky.");
        return;
    };
    let name = file.name.clone();
    ui.horizontal(|ui| {
        ui.label(name);
        if ui.small_button("×").on_hover_text("Back to the built sky.").clicked() {
            params.look.sky.file = None;
        }
    });
}

fn fields(params: &mut Params, group: Group, ui: &mut egui::Ui) {
    egui::Grid::new(group.label()).num_columns(3).show(ui, |ui| {
        for field in FIELDS.iter().filter(|f| f.group == group) {
            let unit = if field.unit.is_empty() { String::new() } else { format!(" {}", field.unit) };
            let help = format!("{}\n{} = {}{unit}", field.help, field.key, field.range());
            let label = ui.label(field.label).on_hover_text(&help);
            let before = (field.get)(params);
            let mut value = before;
            edit(field, &mut value, ui).labelled_by(label.id).on_hover_text(&help);
            let default = field.default_value();
            let undo = egui::Button::new("×").small().frame(false);
            if ui.add_enabled(value != default, undo).on_hover_text("Back to the default.").clicked() {
                value = default;
            }
            if value != before {
                // A slider stays in the range; what a typed value was clamped to is seen in the slider itself.
                let (Ok(v) | Err(crate::model::fields::Refusal::Clamped(v))) = field.accept(value) else { continue };
                (field.set)(params, v);
            }
            ui.end_row();
        }
    });
}

fn edit(field: &'static Field, value: &mut f64, ui: &mut egui::Ui) -> egui::Response {
    match field.kind {
        Kind::Number { min, max, log } => {
            ui.add(with_zero(field, egui::Slider::new(value, min..=max).logarithmic(log).smart_aim(true)))
        }
        Kind::Heading => ui.add(egui::Slider::new(value, 0.0..=360.0).suffix("°").max_decimals(1)),
        Kind::Integer { min, max } if max > 1000 => {
            ui.add(egui::DragValue::new(value).range(f64::from(min)..=f64::from(max)).max_decimals(0))
        }
        Kind::Integer { min, max } => {
            ui.add(with_zero(field, egui::Slider::new(value, f64::from(min)..=f64::from(max)).integer()))
        }
        Kind::Choice(words) => {
            let mut index = *value as usize;
            let response = egui::ComboBox::from_id_salt(field.key)
                .selected_text(words[index.min(words.len() - 1)])
                .show_ui(ui, |ui| {
                    for (i, word) in words.iter().enumerate() {
                        ui.selectable_value(&mut index, i, *word);
                    }
                })
                .response;
            *value = index as f64;
            response
        }
        Kind::Flag => {
            let mut on = *value != 0.0;
            let response = ui.checkbox(&mut on, "");
            *value = f64::from(u8::from(on));
            response
        }
        Kind::Colour => colour(field, value, ui),
    }
}

/// A colour picker; a colour that stands for a word is set by touching it and goes back by the row's cross.
fn colour(field: &Field, value: &mut f64, ui: &mut egui::Ui) -> egui::Response {
    let bits = *value as u32;
    let mut rgb = [16, 8, 0].map(|shift| (bits >> shift) as u8);
    ui.horizontal(|ui| {
        let response = ui.color_edit_button_srgb(&mut rgb);
        ui.weak(field.format(*value));
        *value = rgb.iter().fold(0.0, |sum, &c| 256.0 * sum + f64::from(c));
        response
    })
    .inner
}

/// A slider that shows, and takes, the word that stands for 0.
fn with_zero<'a>(field: &'static Field, slider: egui::Slider<'a>) -> egui::Slider<'a> {
    let unit = suffix(field);
    if field.zero.is_empty() {
        return slider.suffix(unit);
    }
    // From nothing to a hundred kilometres: without a scale of its own a slider could only jump.
    let most = if let Kind::Number { max, .. } = field.kind { max } else { 0.0 };
    let slider = if most > 100.0 { slider.logarithmic(true).smallest_positive(1e-6 * most) } else { slider };
    slider
        .custom_formatter(move |value, digits| match value {
            0.0 => field.zero.to_owned(),
            _ => format!("{}{unit}", egui::emath::format_with_decimals_in_range(value, digits)),
        })
        .custom_parser(move |text| {
            let text = text.trim();
            let number = text.trim_end_matches(|c: char| !c.is_ascii_digit() && c != '.');
            if text.eq_ignore_ascii_case(field.zero) { Some(0.0) } else { number.parse().ok() }
        })
}

fn suffix(field: &Field) -> String {
    match field.unit {
        "" => String::new(),
        "deg" => "°".to_owned(),
        unit => format!(" {unit}"),
    }
}

fn about(app: &App, ui: &mut egui::Ui) {
    let plan = &app.derived.plan;
    let dt = ui.ctx().input(|i| i.stable_dt);
    ui.label(format!("Seastate {}, {:.0} frames a second", env!("CARGO_PKG_VERSION"), 1.0 / dt.max(1e-3)));
    let info = app.render_state.adapter.get_info();
    let name = if info.name.is_empty() { "GPU" } else { &info.name };
    ui.label(format!("{name} ({})", info.backend));
    ui.label(format!("{} x {} points in {} cascades:", plan.n, plan.n, plan.cascades.len()));
    for c in &plan.cascades {
        let longest = if c.k_low > 0.0 { std::f64::consts::TAU / c.k_low } else { c.patch_m };
        ui.label(format!(
            "patch {:.1} m: waves of {:.2} to {:.1} m",
            c.patch_m,
            std::f64::consts::TAU / c.k_high,
            longest
        ));
    }
    ui.label(format!("{:.1} % of the sea's energy is computed", 100.0 * plan.captured().min(1.0)));
    ui.separator();
    ui.weak("Drag to look, scroll or pinch to zoom, WASD or arrows to fly, Q and E for height, space to pause. V goes through views of the maps and the mesh (shift: back, 0 to 4: cascade, Escape: picture).");
}
