//! The web page as the app sees it: events for its scripts, its links, and objects of JavaScript.

use super::screen_readers::AccessibleItem;
use crate::bench::PassTiming;
use crate::state::start::DEFAULT_SEA;
use wasm_bindgen::prelude::*;

/// Sends an event to the page's scripts.
pub fn tell_page(event: &str) {
    if let (Some(window), Ok(event)) = (web_sys::window(), web_sys::Event::new(event)) {
        // A listener that fails leaves the app as it is.
        let _ = window.dispatch_event(&event);
    }
}

/// Whether the page is shown in a frame of another page.
pub fn is_framed() -> bool {
    let parent = web_sys::window().and_then(|w| w.parent().ok().flatten());
    parent.zip(web_sys::window()).is_some_and(|(parent, window)| parent != window)
}

/// Whether a program controls the browser, as in tests: no visitor is there to be shown anything.
pub fn is_automated() -> bool {
    let navigator = web_sys::window().map(|window| window.navigator());
    let flag = navigator.and_then(|n| js_sys::Reflect::get(&n, &"webdriver".into()).ok());
    flag.is_some_and(|flag| flag.is_truthy())
}

/// Address (URL) of this web page with the given state string as its query; an empty one is the default sea.
pub fn page_link(state: &str) -> String {
    let location = eframe::web::web_location();
    let base = location.url.split(['?', '#']).next().unwrap_or_default().to_owned();
    format!("{base}?{}", if state.is_empty() { DEFAULT_SEA } else { state })
}

/// A JavaScript object with the given property names and values.
pub fn js_object<const N: usize>(properties: [(&str, JsValue); N]) -> JsValue {
    let object = js_sys::Object::new();
    for (key, value) in properties {
        // Setting a property of a new object cannot fail.
        let _ = js_sys::Reflect::set(&object, &key.into(), &value);
    }
    object.into()
}

/// The GPU time of a pass as an object of JavaScript.
pub fn pass_timing_object(row: &PassTiming) -> JsValue {
    js_object([
        ("pass", row.pass.into()),
        ("n", row.fft_size_and_cascades.map(|[n, _]| n).into()),
        ("cascades", row.fft_size_and_cascades.map(|[_, cascades]| cascades).into()),
        ("width", row.picture_size.map(|[width, _]| width).into()),
        ("height", row.picture_size.map(|[_, height]| height).into()),
        ("ms", row.timing.gpu_or_median_wall_ms().into()),
    ])
}

/// A widget or text for screen readers as an object of JavaScript.
pub fn accessible_item_object(item: &AccessibleItem) -> JsValue {
    let [least, greatest, step] = item.number.map_or([None; 3], |(_, range)| range);
    js_object([
        ("id", item.id.as_str().into()),
        ("role", item.role.as_str().into()),
        ("label", item.label.as_str().into()),
        ("value", item.value.as_str().into()),
        ("now", item.number.map(|(now, _)| now).into()),
        ("least", least.into()),
        ("greatest", greatest.into()),
        ("step", step.into()),
        ("on", item.checked.into()),
        ("open", item.expanded.into()),
        ("disabled", item.disabled.into()),
        ("clickable", item.clickable.into()),
    ])
}
