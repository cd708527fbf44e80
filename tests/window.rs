//! The desktop window under real input: Xvfb is the display, xdotool moves pointer and keys, and the tests read the
//! state in the pictures that the program saves. `scripts/test.sh --only window` installs both tools and runs `cargo
//! test --test window -- --ignored --test-threads 1`.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use seastate::app::App;
use seastate::state::params::{CameraMode, Interface};
use seastate::state::{Params, query};
use seastate::waves::noise::pcg4d;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A sea with few pixels in a window of the usual size.
const STATE: &str = "n=64&pause=1&t=20&mesh=0.1&renderscale=0.25&adaptive=0";
const SIZE: [f32; 2] = [1280.0, 720.0];
/// File with the program's stderr.
const SAID: &str = "said.txt";
const PATIENCE: Duration = Duration::from_secs(60);

/// A process that is killed when this is dropped.
struct Process(Child);

impl Drop for Process {
    fn drop(&mut self) {
        // The process may have ended already.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The program on a virtual display. A test that fails prints what the program said and did.
struct Desk {
    program: Process,
    _display: Process,
    name: String,
    folder: PathBuf,
    window: String,
}

impl Drop for Desk {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            return;
        }
        let said = std::fs::read_to_string(self.folder.join(SAID)).unwrap_or_default();
        let windows = self.hand(&["search", "--name", ".*"]);
        eprintln!("ended: {:?}\nwindows: {windows:?}\nstderr: {said}", self.program.0.try_wait());
        // Linux lists a process' threads with the kernel function that each waits in.
        let threads = std::fs::read_dir(format!("/proc/{}/task", self.program.0.id()));
        for thread in threads.into_iter().flatten().flatten() {
            let read = |file: &str| std::fs::read_to_string(thread.path().join(file)).unwrap_or_default();
            let stat = read("stat");
            let times: Vec<_> = stat.split(' ').skip(13).take(2).collect();
            eprintln!("thread {} in {}, CPU ticks {times:?}", read("comm").trim(), read("wchan"));
        }
    }
}

#[expect(clippy::disallowed_methods, reason = "another process is waited for")]
fn until<T>(what: &str, mut try_it: impl FnMut() -> Option<T>) -> T {
    let begun = Instant::now();
    loop {
        if let Some(found) = try_it() {
            return found;
        }
        assert!(begun.elapsed() < PATIENCE, "{what}: nothing within {} s", PATIENCE.as_secs());
        std::thread::sleep(Duration::from_millis(50));
    }
}

impl Desk {
    /// Starts the program in a folder called `name`.
    fn open(name: &str, state: &str) -> Self {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
        // Removes the files of an earlier run.
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("a folder");
        let mut display = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1400x800x24", "-noreset", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb; scripts/test.sh installs it");
        let mut number = String::new();
        BufReader::new(display.stdout.take().expect("its output")).read_line(&mut number).expect("a display");
        let display = Process(display);
        let name = format!(":{}", number.trim());
        let program = Command::new(env!("CARGO_BIN_EXE_seastate"))
            .arg(state)
            .current_dir(&folder)
            .env("DISPLAY", &name)
            .env("HOME", &folder)
            .env("XDG_RUNTIME_DIR", &folder)
            .env("SEASTATE_REHEARSE_LOSS", "1")
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .env_remove("XDG_CONFIG_HOME")
            .stderr(std::fs::File::create(folder.join(SAID)).expect("a file"))
            .spawn()
            .expect("the program");
        let mut desk = Self { program: Process(program), _display: display, name, folder, window: String::new() };
        desk.find();
        desk
    }

    /// Destroys the GPU device with F12 (at a frame's start) or F11 (at its end), and waits for the new window.
    fn lose(&mut self, key: &str) {
        let losses = || {
            let said = std::fs::read_to_string(self.folder.join(SAID)).unwrap_or_default();
            said.matches("going on with another device").count()
        };
        let before = losses();
        self.key(key);
        until("the loss", || (losses() > before).then_some(()));
        self.find();
    }

    /// Finds the program's window, moves it to the corner and focuses it.
    fn find(&mut self) {
        let window = until("a window", || {
            let found = self.hand(&["search", "--onlyvisible", "--name", "^Seastate$"]);
            found.lines().next().map(str::to_owned)
        });
        self.hand(&["windowmove", "--sync", &window, "0", "0"]);
        self.hand(&["windowfocus", "--sync", &window]);
        self.window = window;
    }

    /// Runs xdotool.
    fn hand(&self, words: &[&str]) -> String {
        let out = Command::new("xdotool").args(words).env("DISPLAY", &self.name).output();
        String::from_utf8_lossy(&out.expect("xdotool; scripts/test.sh installs it").stdout).into_owned()
    }

    fn key(&self, key: &str) {
        self.hand(&["key", key]);
    }

    fn to(&self, [x, y]: [f32; 2]) {
        self.hand(&["mousemove", &x.round().to_string(), &y.round().to_string()]);
    }

    fn click(&self, at: [f32; 2]) {
        self.to(at);
        self.hand(&["sleep", "0.3", "click", "1", "sleep", "0.3"]);
    }

    fn drag(&self, from: [f32; 2], to: [f32; 2]) {
        self.to(from);
        self.hand(&["sleep", "0.3", "mousedown", "1", "sleep", "0.2"]);
        for i in 1u8..=6 {
            let share = f32::from(i) / 6.0;
            self.to([from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]);
            self.hand(&["sleep", "0.15"]);
        }
        self.hand(&["mouseup", "1", "sleep", "0.3"]);
    }

    /// Saves a picture and returns its state.
    fn look(&self) -> Params {
        self.picture().0
    }

    /// Saves a picture and returns its state and pixels.
    fn picture(&self) -> (Params, image::RgbaImage) {
        self.key("p");
        let path = until("a picture", || {
            let mut files = std::fs::read_dir(&self.folder).ok()?.flatten().map(|f| f.path());
            files.find(|path| path.extension().is_some_and(|e| e == "png"))
        });
        // The file may not be complete yet.
        let (state, picture) = until("a whole picture", || {
            let bytes = std::fs::read(&path).ok()?;
            let picture = image::load_from_memory(&bytes).ok()?;
            seastate::files::picture::state_from_png(&bytes).ok().map(|state| (state, picture))
        });
        std::fs::remove_file(&path).expect("the picture is ours");
        let (params, notices) = query::parse(&state);
        assert_eq!(notices, Vec::<String>::new(), "{state}");
        (params, picture.to_rgba8())
    }

    /// Saves pictures until the state is as wanted. Then saves one more, because a picture shows the frame before the
    /// key, in which a drag may still be in progress.
    fn look_for(&self, what: &str, wanted: impl Fn(&Params) -> bool) -> Params {
        until(what, || Some(self.look()).filter(&wanted));
        self.look()
    }
}

/// Centres of widgets while a tab of the panel is open, found in a test window of the same size.
fn places(state: &str, tab: &str, labels: &[&str]) -> Vec<[f32; 2]> {
    let state = state.to_owned();
    let mut harness = Harness::builder()
        .with_size(egui::vec2(SIZE[0], SIZE[1]))
        .with_pixels_per_point(1.0)
        .wgpu_setup(seastate::app::setup::wgpu_configuration().wgpu_setup)
        .build_eframe(move |cc| {
            let mut app = App::new(cc, &state).expect("a device");
            // As in the window, where the tab of the view has a row for it.
            app.allow_slow_camera();
            app
        });
    harness.run_steps(4);
    if tab != "Weather" {
        harness.get_by_label(tab).click();
        harness.run_steps(4);
    }
    // The first widget of a name is the slider, the second its number.
    let first = |label: &&str| harness.get_all_by_label(label).next().expect("a widget").rect().center();
    labels.iter().map(first).map(|at| [at.x, at.y]).collect()
}

#[test]
#[ignore = "needs Xvfb and xdotool: scripts/test.sh has them"]
fn the_window_is_used_as_a_person_does() {
    let widgets = places(STATE, "Weather", &["Beaufort", "Play", "Reset", "View"]);
    let [beaufort, play, reset, view_tab] = widgets[..] else { panic!("{widgets:?}") };
    let time = places(STATE, "View", &["Time"])[0];
    let mut desk = Desk::open("window", STATE);
    let first = desk.look();
    assert_eq!(first, query::parse(STATE).0);

    // A slider is dragged, and undone.
    desk.drag(beaufort, [beaufort[0] + 40.0, beaufort[1]]);
    let windy = desk.look_for("more wind", |p| p.sea.first_system().wind_m_s > first.sea.first_system().wind_m_s);
    desk.key("ctrl+z");
    desk.look_for("the old wind", |p| p.sea.first_system().wind_m_s == first.sea.first_system().wind_m_s);
    desk.key("ctrl+shift+z");
    desk.look_for("the new wind", |p| p.sea.first_system().wind_m_s == windy.sea.first_system().wind_m_s);

    // The left button looks around over the sea, but not over the panel.
    desk.drag([300.0, 300.0], [420.0, 330.0]);
    let turned = desk.look_for("a turn", |p| p.camera.heading_deg != first.camera.heading_deg);
    assert_eq!(turned.camera.mode, CameraMode::Fly);
    desk.drag([beaufort[0], 400.0], [beaufort[0] + 60.0, 430.0]);
    assert_eq!(desk.look().camera, turned.camera);
    // The wheel goes closer.
    desk.to([300.0, 300.0]);
    desk.hand(&["sleep", "0.2", "click", "--repeat", "3", "--delay", "120", "4"]);
    let closer = desk.look_for("a step ahead", |p| p.camera != turned.camera);
    // Keys fly.
    desk.hand(&["keydown", "w", "sleep", "1.0", "keyup", "w"]);
    desk.look_for("a flight", |p| p.camera.z_m != closer.camera.z_m || p.camera.x_m != closer.camera.x_m);

    // Time is scrubbed, runs, and stands.
    desk.click(view_tab);
    desk.drag(time, [time[0] + 30.0, time[1]]);
    let later = desk.look_for("another time", |p| p.clock.t_s != first.clock.t_s);
    desk.click(play);
    desk.look_for("a sea that runs", |p| !p.clock.paused && p.clock.t_s > later.clock.t_s);
    desk.key("space");
    let stood = desk.look_for("a sea that stands", |p| p.clock.paused);
    assert_eq!(desk.look().clock, stood.clock);

    // H hides and shows the panel; V shows a view, and Escape leaves the view before it closes the window.
    desk.key("h");
    desk.look_for("no panel", |p| p.screen.interface == Interface::None);
    desk.key("h");
    desk.look_for("a panel", |p| p.screen.interface == Interface::Panel);
    desk.key("v");
    desk.look_for("a view", |p| p.look.view != first.look.view);
    desk.key("Escape");
    desk.look_for("the picture again", |p| p.look.view == first.look.view);

    desk.click(reset);
    desk.look_for("the default sea", |p| p.sea == Params::default().sea);

    // Another window size keeps the state.
    desk.key("space");
    let before = desk.look_for("a sea that stands", |p| p.clock.paused);
    for [width, height] in [["640", "480"], ["1280", "720"]] {
        desk.hand(&["windowsize", "--sync", &desk.window, width, height]);
        assert_eq!(desk.look(), before);
    }
    desk.key("Escape");
    let status = until("the end", || desk.program.0.try_wait().ok().flatten());
    assert!(status.success(), "{status}");
}

/// The program survives two hundred window sizes down to one pixel, some of them while hidden, and keeps its state.
#[test]
#[ignore = "needs Xvfb and xdotool: scripts/test.sh has them"]
fn the_window_survives_any_size() {
    let mut desk = Desk::open("window-sizes", STATE);
    let before = desk.look();
    for i in 0..200_u32 {
        let dice = pcg4d([i, 1, 2, 3]);
        let [width, height] = match i % 10 {
            0 => [1, 1],
            1 => [1, 1 + dice[0] % 800],
            2 => [1 + dice[0] % 1400, 1],
            _ => [1 + dice[0] % 1400, 1 + dice[1] % 800],
        };
        // Without a window manager, unmapping and mapping stand for minimising and restoring.
        if i % 25 == 12 {
            desk.hand(&["windowunmap", &desk.window, "sleep", "0.1"]);
        }
        desk.hand(&["windowsize", &desk.window, &width.to_string(), &height.to_string(), "sleep", "0.05"]);
        if i % 25 == 14 {
            desk.hand(&["windowmap", &desk.window, "sleep", "0.1"]);
        }
        let ended = desk.program.0.try_wait().expect("a process");
        assert!(ended.is_none(), "{width} x {height}, the {i}th: {ended:?}");
    }
    desk.hand(&["windowsize", "--sync", &desk.window, "1280", "720"]);
    desk.hand(&["windowfocus", "--sync", &desk.window]);
    assert_eq!(desk.look(), before);
    desk.key("Escape");
    let status = until("the end", || desk.program.0.try_wait().ok().flatten());
    assert!(status.success(), "{status}");
}

/// Mean difference of two pictures of equal size, 0 to 1.
fn apart(a: &image::RgbaImage, b: &image::RgbaImage) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions());
    let sum: u64 = a.iter().zip(b.iter()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / (255.0 * a.len() as f64)
}

/// The state survives a device loss while time is stopped, while it runs, during a drag and during a change of size.
#[test]
#[ignore = "needs Xvfb and xdotool: scripts/test.sh has them"]
fn the_window_outlives_its_gpu() {
    let mut desk = Desk::open("window-losses", &format!("{STATE}&wind=17&heading=20&afloat=buoy*4*-30"));
    for moment in ["still", "running", "turning", "resized", "painted", "still"] {
        // Waits until the foam no longer changes.
        let mut last = desk.picture();
        let (before, picture) = until("a picture that stays", || {
            let earlier = std::mem::replace(&mut last, desk.picture());
            (earlier == last).then(|| last.clone())
        });
        match moment {
            "running" => desk.hand(&["key", "space", "sleep", "0.4"]),
            "turning" => {
                desk.hand(&["mousemove", "300", "300", "mousedown", "1", "mousemove", "330", "300", "sleep", "0.1"])
            }
            "resized" => desk.hand(&["windowsize", &desk.window, "700", "420"]),
            _ => String::new(),
        };
        desk.lose(if moment == "painted" { "F11" } else { "F12" });
        match moment {
            "running" => {
                desk.key("space");
                let mut after = desk.look_for("a sea that stands", |p| p.clock.paused);
                let seconds = after.clock.t_s - before.clock.t_s;
                assert!(seconds > 0.0 && seconds < 30.0, "{seconds} s");
                after.clock = before.clock.clone();
                assert_eq!(after, before);
                continue;
            }
            "turning" => {
                desk.hand(&["mouseup", "1"]);
                let mut after = desk.look();
                after.camera = before.camera.clone();
                assert_eq!(after, before);
                continue;
            }
            _ => {}
        };
        until(&format!("the picture of before, {moment}"), || {
            desk.hand(&["windowsize", &desk.window, "1280", "720", "sleep", "0.2"]);
            let (after, again) = desk.picture();
            assert_eq!(after, before, "{moment}");
            (again.dimensions() == picture.dimensions() && apart(&again, &picture) < 0.01).then_some(())
        });
    }
    desk.key("Escape");
    let status = until("the end", || desk.program.0.try_wait().ok().flatten());
    assert!(status.success(), "{status}");
}
