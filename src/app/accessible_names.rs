//! Accessible names, for screen readers and for tests, of widgets that show only a symbol or a value.

/// Sets the accessible name of a button whose label is only a symbol.
pub fn with_accessible_name(response: egui::Response, name: &str) -> egui::Response {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, response.enabled(), name));
    response
}

/// Sets the accessible name and value of a slider or number field.
pub fn with_accessible_value(response: egui::Response, name: &str, value: f64) -> egui::Response {
    response.widget_info(|| egui::WidgetInfo::slider(response.enabled(), value, name));
    response
}
