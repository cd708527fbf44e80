//! What screen readers, and the tests that find widgets as they do, are told of a widget whose face is no name.

/// Names a button that shows a sign.
pub fn named(response: egui::Response, name: &str) -> egui::Response {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, response.enabled(), name));
    response
}

/// Names a value.
pub fn named_value(response: egui::Response, name: &str, value: f64) -> egui::Response {
    response.widget_info(|| egui::WidgetInfo::slider(response.enabled(), value, name));
    response
}
