//! The legend of a plot, below it: inside, it would cover the curves.

use egui::{Color32, FontId, Sense, Stroke, Ui, pos2, vec2};

/// Width of the sample of a curve, and its distance from the name, points.
const SAMPLE_POINTS: [f32; 2] = [20.0, 5.0];
/// Size of the letters, points.
const TEXT_POINTS: f32 = 11.5;
/// Height of an entry, points.
const HEIGHT_POINTS: f32 = 16.0;

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sample {
    Line,
    Dashed,
    Dotted,
    Bars,
}

/// The entries of a legend: name, colour and sample of each curve, each name once.
#[derive(Default)]
pub struct Legend(Vec<(String, Color32, Sample)>);

impl Legend {
    /// Adds a curve; nothing, if there is one of this name.
    pub fn add(&mut self, name: &str, colour: Color32, sample: Sample) {
        if self.0.iter().all(|(known, ..)| known != name) {
            self.0.push((name.to_owned(), colour, sample));
        }
    }

    /// Adds the legend to the panel, in as many lines as it needs.
    pub fn show(&self, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(12.0, 0.0);
            for (name, colour, sample) in &self.0 {
                show_entry(ui, name, *colour, *sample);
            }
        });
    }
}

/// Adds an entry: a widget of its own, so that a line never ends between a sample and its name.
fn show_entry(ui: &mut Ui, name: &str, colour: Color32, sample: Sample) {
    let [sample_width, gap] = SAMPLE_POINTS;
    let text =
        ui.painter().layout_no_wrap(name.to_owned(), FontId::proportional(TEXT_POINTS), ui.visuals().text_color());
    let (rect, entry) = ui.allocate_exact_size(vec2(sample_width + gap + text.size().x, HEIGHT_POINTS), Sense::hover());
    entry.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, name));
    let (painter, y, stroke) = (ui.painter(), rect.center().y, Stroke::new(2.0, colour));
    let ends = [pos2(rect.left(), y), pos2(rect.left() + sample_width, y)];
    match sample {
        Sample::Line => {
            painter.line_segment(ends, stroke);
        }
        Sample::Dashed => painter.extend(egui::Shape::dashed_line(&ends, stroke, 6.0, 4.0)),
        Sample::Dotted => painter.extend(egui::Shape::dotted_line(&ends, colour, 5.0, 1.2)),
        Sample::Bars => {
            let bar = egui::Rect::from_min_max(ends[0] - vec2(0.0, 5.0), ends[1] + vec2(0.0, 5.0));
            painter.rect_filled(bar, 1.0, colour);
        }
    }
    painter.galley(pos2(ends[1].x + gap, y - 0.5 * text.size().y), text, colour);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_appears_once() {
        let mut legend = Legend::default();
        for (name, sample) in [("edge", Sample::Dotted), ("edge", Sample::Dotted), ("sea", Sample::Line)] {
            legend.add(name, Color32::WHITE, sample);
        }
        assert_eq!(legend.0.len(), 2);
    }
}
