//! Where on the page a widget is, by what it is called: for tests that use the panel as a person does. It reads the tree
//! that screen readers get, which is made only once somebody has asked.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Widgets by label: x, y, width, height in points, and the value as text.
type Places = BTreeMap<String, ([f64; 4], String)>;

/// What is on the screen.
#[derive(Clone, Default)]
pub struct Finder(Arc<Mutex<Places>>);

impl Finder {
    /// The place of the widget with this label, once a frame has been drawn since the first question.
    pub fn place(&self, label: &str, ctx: &egui::Context) -> Option<[f64; 4]> {
        ctx.enable_accesskit();
        ctx.request_repaint();
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get(label).map(|(place, _)| *place)
    }

    /// All labels and values.
    pub fn labels(&self, ctx: &egui::Context) -> Vec<String> {
        ctx.enable_accesskit();
        ctx.request_repaint();
        let places = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        places.iter().map(|(label, (_, value))| format!("{label}: {value}")).collect()
    }
}

impl egui::Plugin for Finder {
    fn debug_name(&self) -> &'static str {
        "finder"
    }

    fn output_hook(&mut self, _ctx: &egui::Context, output: &mut egui::FullOutput) {
        let Some(update) = &output.platform_output.accesskit_update else { return };
        let mut places = Places::new();
        let name = |node: &egui::accesskit::Node| -> Option<String> {
            if let Some(label) = node.label() {
                return Some(label.to_owned());
            }
            let by = node.labelled_by().first()?;
            let (_, labelling) = update.nodes.iter().find(|(id, _)| id == by)?;
            labelling.label().or(labelling.value()).map(str::to_owned)
        };
        for (_, node) in &update.nodes {
            let (Some(label), Some(r)) = (name(node), node.bounds()) else { continue };
            let value = node
                .value()
                .map_or_else(|| node.numeric_value().map_or(String::new(), |v| v.to_string()), str::to_owned);
            places.insert(label, ([r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0], value));
        }
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = places;
    }
}
