//! Accessible names of widgets that show only a symbol or a value, for screen readers and for tests.

/// Names a button that shows a symbol.
pub fn named(response: egui::Response, name: &str) -> egui::Response {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, response.enabled(), name));
    response
}

/// Names a slider and tells its value.
pub fn named_value(response: egui::Response, name: &str, value: f64) -> egui::Response {
    response.widget_info(|| egui::WidgetInfo::slider(response.enabled(), value, name));
    response
}
