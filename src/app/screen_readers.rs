//! Access for screen readers on the web page. eframe passes no accessibility tree to a browser. So web/readers.js
//! mirrors AccessKit's tree as HTML elements, and user actions on these elements come back as AccessKit requests.
//!
//! egui builds the tree only after the first request for it. Browser tests use the tree to find widgets, too.

use egui::accesskit::{Action, ActionData, ActionRequest, Node, NodeId, Role, Toggled, TreeId, TreeUpdate};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A widget or a text of egui's accessibility tree, as the web page passes it to screen readers and browser tests.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AccessibleItem {
    /// AccessKit's 64-bit node id, written as a decimal number.
    pub id: String,
    /// AccessKit's name of the widget's role, such as `Slider`.
    pub role: String,
    /// Accessible name: the text by which a screen reader announces the widget.
    pub label: String,
    /// Current value of the widget as text.
    pub value: String,
    /// Numeric value of a slider or number field, then its minimum, maximum and step where they exist.
    pub number: Option<(f64, [Option<f64>; 3])>,
    /// Whether a check box or other toggle is on; `None` for other widgets.
    pub checked: Option<bool>,
    /// Whether a collapsible section is expanded; `None` for other widgets.
    pub expanded: Option<bool>,
    pub disabled: bool,
    /// Whether a click does something.
    pub clickable: bool,
    /// Bounds of the widget in points: x and y of its top left corner, width, height.
    pub bounds: [f64; 4],
}

/// egui plugin that keeps the accessibility tree of the last frame for the web page, and passes the page's requests
/// (clicks, typed text) to egui.
#[derive(Clone, Default)]
pub struct ScreenReaders(Arc<Mutex<AccessibilityState>>);

#[derive(Default)]
struct AccessibilityState {
    /// Widgets and texts of the last frame, in reading order.
    items: Vec<AccessibleItem>,
    /// Input events, made from actions of screen readers, that egui will get: one batch in each of the next frames.
    requests: VecDeque<Vec<egui::Event>>,
    tree: Option<TreeId>,
}

impl ScreenReaders {
    fn lock(&self) -> MutexGuard<'_, AccessibilityState> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Installs the plugin in `ctx`, the new egui context after a device loss, and switches its accessibility tree on
    /// if it was in use before.
    pub fn install_in_context(&self, ctx: &egui::Context) {
        ctx.add_plugin(self.clone());
        if self.lock().tree.is_some() {
            ctx.enable_accesskit();
        }
    }

    /// Widgets and texts of the last frame. The first call enables the tree, so the list stays empty until the next
    /// frame.
    pub fn items(&self, ctx: &egui::Context) -> Vec<AccessibleItem> {
        if self.lock().tree.is_none() {
            ctx.enable_accesskit();
            ctx.request_repaint();
        }
        self.lock().items.clone()
    }

    /// Applies an action to the widget with the given `id`: `click`, `focus`, `more` or `less` (one step of its value),
    /// `set` (to the number `value`), or `type` (enters the string `text` and confirms it).
    pub fn perform_widget_action(&self, ctx: &egui::Context, id: &str, action: &str, value: f64, text: &str) {
        let mut inner = self.lock();
        let (Ok(id), Some(target_tree)) = (id.parse().map(NodeId), inner.tree) else { return };
        let ask = |action, data| {
            egui::Event::AccessKitActionRequest(ActionRequest { action, target_tree, target_node: id, data })
        };
        let key = |key, modifiers| {
            [true, false].map(|pressed| egui::Event::Key { key, physical_key: None, pressed, repeat: false, modifiers })
        };
        let batches = match action {
            "click" => vec![vec![ask(Action::Click, None)]],
            "more" => vec![vec![ask(Action::Increment, None)]],
            "less" => vec![vec![ask(Action::Decrement, None)]],
            "focus" => vec![vec![ask(Action::Focus, None)]],
            "set" => vec![vec![ask(Action::SetValue, Some(ActionData::NumericValue(value)))]],
            "type" => {
                let mut keys = key(egui::Key::A, egui::Modifiers::COMMAND).to_vec();
                // An empty text event would leave the selected text, so Backspace deletes it.
                if text.is_empty() {
                    keys.extend(key(egui::Key::Backspace, egui::Modifiers::NONE));
                } else {
                    keys.push(egui::Event::Text(text.to_owned()));
                }
                let confirm = key(egui::Key::Enter, egui::Modifiers::NONE).to_vec();
                vec![vec![ask(Action::Focus, None)], keys, confirm]
            }
            _ => return,
        };
        inner.requests.extend(batches);
        ctx.request_repaint();
    }
}

impl egui::Plugin for ScreenReaders {
    fn debug_name(&self) -> &'static str {
        "readers"
    }

    fn input_hook(&mut self, ctx: &egui::Context, input: &mut egui::RawInput) {
        let mut inner = self.lock();
        if let Some(batch) = inner.requests.pop_front() {
            input.events.extend(batch);
        }
        if !inner.requests.is_empty() {
            ctx.request_repaint();
        }
    }

    fn output_hook(&mut self, _ctx: &egui::Context, output: &mut egui::FullOutput) {
        let Some(update) = &output.platform_output.accesskit_update else { return };
        let items = items(update);
        let mut inner = self.lock();
        (inner.items, inner.tree) = (items, Some(update.tree_id));
    }
}

/// Widgets and texts of an accessibility tree, in reading order.
fn items(update: &TreeUpdate) -> Vec<AccessibleItem> {
    let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
    let mut items = Vec::new();
    let mut waiting: Vec<NodeId> = update.tree.iter().map(|tree| tree.root).collect();
    while let Some(id) = waiting.pop() {
        let Some(node) = nodes.get(&id) else { continue };
        waiting.extend(node.children().iter().rev());
        items.extend(accessible_item(id, node, &nodes));
    }
    items
}

fn accessible_item(id: NodeId, node: &Node, nodes: &HashMap<NodeId, &Node>) -> Option<AccessibleItem> {
    let by = || nodes.get(node.labelled_by().first()?).and_then(|by| by.label().or(by.value()));
    let label = node.label().or_else(by).unwrap_or_default().to_owned();
    let value = node.value().unwrap_or_default().to_owned();
    // Splitters are the edges by which a pointer resizes a window.
    let is_silent = matches!(node.role(), Role::GenericContainer | Role::Splitter);
    if label.is_empty() && value.is_empty() || is_silent {
        return None;
    }
    let known = |end: Option<f64>| end.filter(|x| x.is_finite());
    let about = [node.min_numeric_value(), node.max_numeric_value(), node.numeric_value_step()].map(known);
    let number = node.numeric_value().map(|value| (value, about));
    let bounds = node.bounds().map_or([0.0; 4], |r| [r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0]);
    Some(AccessibleItem {
        id: id.0.to_string(),
        role: format!("{:?}", node.role()),
        label,
        value,
        number,
        checked: node.toggled().map(|t| t == Toggled::True),
        expanded: node.is_expanded(),
        disabled: node.is_disabled(),
        clickable: node.supports_action(Action::Click),
        bounds,
    })
}
