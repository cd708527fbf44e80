//! Accessible names, for screen readers and for tests, of widgets that show only a symbol or a value.

/// Sets the name that a screen reader announces for the button of `response`, whose label is only a symbol.
pub fn with_accessible_name(response: egui::Response, name: &str) -> egui::Response {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, response.enabled(), name));
    response
}

/// Sets the name and the value that a screen reader announces for the slider or number field of `response`.
pub fn with_accessible_value(response: egui::Response, name: &str, value: f64) -> egui::Response {
    response.widget_info(|| egui::WidgetInfo::slider(response.enabled(), value, name));
    response
}
