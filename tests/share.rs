//! Sharing a sea, and opening files by a button: the app under egui_kittest on a software adapter.

mod common;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use seastate::app::App;
use seastate::files::picture;
use std::path::{Path, PathBuf};

fn open(state: &str, size: [f32; 2]) -> Harness<'static, App> {
    common::harness::open(state, size, 1.0)
}

fn click(harness: &mut Harness<'_, App>, label: &str) {
    harness.get_by_label(label).click();
    harness.run_steps(2);
}

/// Clicks a button and returns the text that it copies.
fn copied(harness: &mut Harness<'_, App>, label: &str) -> String {
    harness.get_by_label(label).click();
    let text = |command: &egui::OutputCommand| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    };
    let found = (0..4).find_map(|_| {
        harness.run_steps(1);
        harness.output().platform_output.commands.iter().find_map(text)
    });
    found.unwrap_or_else(|| panic!("{label} copies nothing"))
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("seastate-share-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Draws frames until a file called `name` is saved in `folder`, and returns its contents.
fn saved(harness: &mut Harness<'_, App>, folder: &Path, name: &str) -> Vec<u8> {
    for _ in 0..400 {
        harness.run_steps(1);
        harness.render().expect("a picture");
        if harness.query_by_label_contains(&format!("Saved: {}", folder.join(name).display())).is_some() {
            return std::fs::read(folder.join(name)).expect("the file");
        }
        std::thread::park_timeout(std::time::Duration::from_millis(20));
    }
    panic!("{name} was not saved");
}

#[test]
fn links_frames_and_films_are_copied() {
    let mut harness = open("wind=10&fetch=100&n=64&pause=1&t=5", [900.0, 900.0]);
    click(&mut harness, "Share");
    let state = "wind=10&fetch=100&t=5&pause=1&n=64";
    assert_eq!(copied(&mut harness, "Copy link with words"), format!("Force 5 sea, waves 2.1 m high: {state}"));
    let frame = copied(&mut harness, "Copy frame");
    assert!(frame.contains("&amp;ui=mini\" title=\"Force 5 sea, waves 2.1 m high\""), "{frame}");
    let element = copied(&mut harness, "Copy element");
    assert!(
        element.contains("seastate/sea-state.js\"></script>\n<sea-state state=\"v=2&amp;wind=10&amp;"),
        "{element}"
    );
    assert_eq!(
        copied(&mut harness, "Copy film command"),
        format!("seastate render \"{state}\" --frames 300 --fps 30 --output frames")
    );
    // A sea that repeats makes a film of one period.
    harness.state_mut().set_state(&format!("{state}&loop=20"));
    harness.run_steps(2);
    assert!(copied(&mut harness, "Copy film command").ends_with("--frames 600 --fps 30 --output frames"));
}

/// On a software adapter a running sea begins with a quarter of its pixels a side.
#[test]
fn a_saved_picture_is_whole_on_a_slow_machine() {
    let folder = folder("whole");
    let mut harness = open("wind=17&n=64&t=3&mesh=0.1&speed=0&ui=0", [400.0, 300.0]);
    harness.state_mut().set_save_folder(folder.clone());
    while !harness.state().is_picture_complete() {
        harness.run_steps(1);
        harness.render().expect("a picture");
    }
    let reduced = harness.state().picture_size();
    assert!(reduced[0] < 300, "{reduced:?}");
    harness.key_press(egui::Key::P);
    harness.run_steps(1);
    // A picture that takes long can be given up.
    harness.get_by_label("The picture is being drawn in full.");
    harness.get_by_label("Cancel");
    let bytes = saved(&mut harness, &folder, "seastate-wind17-t3.png");
    let image = image::load_from_memory(&bytes).expect("a picture").to_rgb8();
    assert_eq!(image.dimensions(), (400, 300));
    let state = harness.state().state();
    assert_eq!(picture::state_from_png(&bytes).map(|s| s.replace("v=2&", "")).as_deref(), Ok(state.as_str()));
    harness.run_steps(3);
    assert!(harness.state().picture_size()[0] < 400, "the running sea goes on with fewer pixels");
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}

#[test]
fn a_saved_picture_has_the_chosen_size_and_caption() {
    let folder = folder("caption");
    let mut harness = open("wind=17&n=64&t=3&mesh=0.1&pause=1", [900.0, 900.0]);
    harness.state_mut().set_save_folder(folder.clone());
    harness.render().expect("a picture");
    click(&mut harness, "Share");
    click(&mut harness, "Caption");
    click(&mut harness, "Size of the picture");
    click(&mut harness, "1920 x 1080");
    harness.get_by_label("Picture").click();
    let bytes = saved(&mut harness, &folder, "seastate-wind17-t3.png");
    let image = image::load_from_memory(&bytes).expect("a picture").to_rgb8();
    assert_eq!(image.dimensions(), (1920, 1080));
    // Letters are white on the band at the lower edge.
    let letters = image.enumerate_pixels().filter(|(_, y, p)| *y > 1020 && p.0.iter().all(|c| *c > 235)).count();
    assert!((500..30_000).contains(&letters), "{letters} white pixels");
    if let Some(place) = std::env::var_os("SEASTATE_PICTURES") {
        std::fs::write(Path::new(&place).join("caption.png"), &bytes).expect("a file");
    }
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}

#[test]
fn the_small_interface_says_what_is_seen_and_stops_the_time() {
    let mut harness = open("wind=22&n=64&t=3&ui=mini", [480.0, 270.0]);
    harness.get_by_label_contains("Force 9 sea, waves");
    assert!(harness.query_by_label("Weather").is_none(), "the panel is not there");
    click(&mut harness, "Pause");
    assert!(harness.state().state().contains("pause=1"), "{}", harness.state().state());
    harness.get_by_label("Play");
    harness.get_by_label("Open in Seastate").click();
    let address = (0..4).find_map(|_| {
        harness.run_steps(1);
        let commands = &harness.output().platform_output.commands;
        commands.iter().find_map(|command| match command {
            egui::OutputCommand::OpenUrl(open) => Some(open.url.clone()),
            _ => None,
        })
    });
    let address = address.expect("a page is opened");
    assert!(address.contains("wind=22") && !address.contains("ui="), "{address}");
    if let Some(place) = std::env::var_os("SEASTATE_PICTURES") {
        harness.render().expect("a picture").save(Path::new(&place).join("mini.png")).expect("a file");
    }
}

#[test]
fn samples_are_opened_and_files_have_a_button() {
    let mut harness = open("n=64&pause=1&mesh=0.1&scale2=1&hs2=1.8", [900.0, 900.0]);
    harness.get_by_label_contains("swell 1.8 m high");
    click(&mut harness, "Share");
    harness.get_by_label("Open a file…");
    if let Some(place) = std::env::var_os("SEASTATE_PICTURES") {
        harness.render().expect("a picture").save(Path::new(&place).join("share.png")).expect("a file");
    }
    click(&mut harness, "Try a spectrum");
    let state = harness.state().state();
    assert!(state.contains("spectrum=measured") && !state.contains("scale2"), "no swell comes on top: {state}");
    harness.get_by_label("Measured waves");
    click(&mut harness, "Try a sky");
    assert!(harness.state().state().ends_with("sky=sample-dusk.hdr"), "{}", harness.state().state());
    harness.get_by_label_contains("sample-dusk.hdr: 256 x 128, sun 1");
    assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    if let Some(place) = std::env::var_os("SEASTATE_PICTURES") {
        while !harness.state().is_picture_complete() {
            harness.run_steps(1);
            harness.render().expect("a picture");
        }
        harness.render().expect("a picture").save(Path::new(&place).join("sample-sky.png")).expect("a file");
    }
}

/// On a phone a file is opened from the first row of any tab, and the sea itself says what came of it.
#[test]
fn a_phone_opens_files_and_tells_it_over_the_sea() {
    let folder = folder("phone");
    let strange = folder.join("strange.txt");
    std::fs::write(&strange, "neither waves nor depths").expect("a file");
    for size in [[360.0, 640.0], [390.0, 844.0]] {
        let mut harness = open("n=64&pause=1&mesh=0.1", size);
        harness.ctx.all_styles_mut(|style| style.animation_time = 0.0);
        let window = egui::Rect::from_min_size(egui::Pos2::ZERO, size.into());
        for tab in ["Weather", "Study", "Share"] {
            click(&mut harness, tab);
            harness.run_steps(4);
            let button = harness.get_by_label("Open a file").rect();
            assert!(window.contains_rect(button), "{tab}: {button}");
            assert!(button.width() >= 44.0 && button.height() >= 44.0, "{tab}: {button}");
        }
        let told = |harness: &Harness<'static, App>, words: &str| {
            let sheet = harness.get_by_label("Height of the sheet").rect();
            let texts: Vec<_> = harness.query_all_by_label_contains(words).map(|node| node.rect()).collect();
            let summary = harness.ctx.memory(|m| m.area_rect(egui::Id::unique("summary"))).expect("a summary");
            let is_over_sea = |text: &egui::Rect| {
                window.contains_rect(*text) && text.bottom() <= sheet.top() && !text.intersects(summary)
            };
            assert!(texts.iter().any(is_over_sea), "{words}: {texts:?}, the sheet begins at {}", sheet.top());
        };
        harness.state_mut().answer_file_dialogs(vec!["assets/spectra/two-systems.txt".into()]);
        click(&mut harness, "Open a file");
        harness.run_steps(4);
        assert!(harness.state().state().contains("spectrum=measured"), "{}", harness.state().state());
        told(&harness, "The sea has the waves of two-systems.txt now");
        harness.get_by_label("Measured waves");
        if let Some(place) = std::env::var_os("SEASTATE_PICTURES") {
            let name = format!("phone-opened-{}.png", size[0]);
            harness.render().expect("a picture").save(Path::new(&place).join(name)).expect("a file");
        }
        let state = harness.state().state();
        harness.state_mut().answer_file_dialogs(vec![strange.clone()]);
        click(&mut harness, "Open a file");
        harness.run_steps(4);
        assert_eq!(harness.state().state(), state);
        told(&harness, "strange.txt");
        assert!(harness.state().errors().is_empty(), "{:?}", harness.state().errors());
    }
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}
