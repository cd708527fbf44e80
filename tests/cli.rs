//! The command line: its output and its errors.

use std::path::PathBuf;
use std::process::{Command, Output};

fn seastate(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_seastate")).args(args).output().expect("the program runs")
}

fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    // The folder may be left from an earlier run.
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder");
    path
}

/// Lines of stderr without the messages of the Vulkan loader.
fn complaints(output: &Output) -> Vec<String> {
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    text.lines().filter(|l| !l.contains("XDG_RUNTIME_DIR")).map(str::to_owned).collect()
}

#[test]
fn bad_arguments_are_one_line_and_exit_code_2() {
    for args in [
        &["render", "wind=10", "--size", "big"][..],
        &["render", "wind=10", "--size", "0x10"],
        &["render", "wind=10", "--size", "99999x10"],
        &["stats", "wind=10", "--seeds", "0"],
        &["stats", "wind=10", "--seeds", "many"],
        &["stats", "wind=10", "--hours", "2"],
        &["stats", "wind=10", "--crests", "a.csv", "--hours", "25"],
        &["export", "wind=10"],
        &["record", "wind=10", "-o", "a.csv"],
        &["record", "wind=10", "--at", "1", "-o", "a.csv"],
        &["record", "n=64", "--at", "1,2", "--hours", "0.001", "-o", "a.txt"],
        &["stats", "--spectrum-index", "1"],
        &["export", "wind=10", "--spectrum-to", "a.txt"],
        &["spectra", "/nonexistent.sp2"],
        &["wind=10", "wind=11"],
        &["check", "--nonsense"],
        &["coast", "wind=10"],
        &["coast", "wind=10", "--coast", "/nonexistent.tif"],
        &["coast", "wind=10", "--coast", "beach", "--gauges", "1"],
        &["coast", "wind=10", "--coast", "beach", "-o", "a.txt"],
        &["bench", "--repeat", "-1"],
    ] {
        let output = seastate(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {output:?}");
        assert_eq!(complaints(&output).len(), 1, "{args:?}: {output:?}");
        assert!(output.stdout.is_empty(), "{args:?}");
    }
}

#[test]
fn a_bad_sky_is_one_line_that_names_it() {
    let folder = folder("skies");
    let text = folder.join("notes.hdr");
    std::fs::write(&text, "no picture").expect("a file");
    for path in [text.to_str().expect("a path"), "/nonexistent/sky.exr"] {
        let output = seastate(&["render", "n=64", "--size", "8x8", "--sky", path]);
        let said = complaints(&output);
        assert_eq!((output.status.code(), said.len()), (Some(2), 1), "{output:?}");
        assert!(said[0].contains(if path.ends_with(".exr") { "sky.exr" } else { "notes.hdr: neither" }), "{said:?}");
    }
}

/// Files that claim to be far larger unpacked are refused by name, in an address space of 4 GB.
#[cfg(target_os = "linux")]
#[test]
fn bombs_are_refused_with_little_memory() {
    let folder = folder("bombs");
    let exr = {
        let image = image::Rgb32FImage::from_pixel(64, 32, image::Rgb([1.0; 3]));
        let mut bytes = std::io::Cursor::new(Vec::new());
        image.write_to(&mut bytes, image::ImageFormat::OpenExr).expect("a file");
        let mut bytes = bytes.into_inner();
        // Renames the block count, with which the window sizes would have to agree.
        let count = bytes.windows(11).position(|w| w == b"chunkCount\0").expect("a count");
        bytes[count] = b'C';
        for name in ["dataWindow\0box2i\0", "displayWindow\0box2i\0"] {
            let at = bytes.windows(name.len()).position(|w| w == name.as_bytes()).expect("a window") + name.len() + 4;
            bytes[at + 8..at + 16].copy_from_slice(&[99_999i32, 49_999].map(i32::to_le_bytes).concat());
        }
        bytes
    };
    let hdr = [&b"#?RADIANCE\n\n-Y 8000 +X 16000\n"[..], &[9; 4096]].concat();
    let files = [
        ("--sky", "vast.exr", exr, "save it smaller"),
        ("--sky", "short.hdr", hdr, "ends too early"),
        ("--sky", "size.hdr", b"#?RADIANCE\n\n-Y 500000 +X 1000000\n".to_vec(), "save it smaller"),
        ("--spectrum", "long.csv", b"0.1,1\n".repeat(3 << 20), "larger than 16 MiB"),
        ("--spectrum", "packed.txt", b"\x1f\x8b\x08\0\0".to_vec(), "unpack it first"),
        ("--spectrum", "film.mp4", b"\0\0\0\x18ftypmp42\xff\xfe".repeat(100), "no text"),
    ];
    for (option, name, bytes, reason) in files {
        let path = folder.join(name);
        std::fs::write(&path, bytes).expect("a file");
        let script = format!(
            "ulimit -v 4000000; exec '{}' render n=64 {option} '{}'",
            env!("CARGO_BIN_EXE_seastate"),
            path.display()
        );
        let output = Command::new("sh").args(["-c", &script]).output().expect("a shell");
        let said = complaints(&output);
        assert_eq!((output.status.code(), said.len()), (Some(2), 1), "{output:?}");
        assert!(said[0].contains(name) && said[0].contains(reason), "{said:?}");
    }
    // A device file without an end, and a folder.
    for (option, path, reason) in
        [("--spectrum", "/dev/zero", "larger than"), ("--sky", "/dev/zero", "neither"), ("--sky", "/", "cannot read")]
    {
        let output = seastate(&["render", "n=64", option, path]);
        let said = complaints(&output);
        assert!(output.status.code() == Some(2) && said.len() == 1 && said[0].contains(reason), "{said:?}");
    }
}

#[test]
fn odd_arguments_are_refused_or_read() {
    let long = format!("wind=14&n=64&{}", "fetch=3&".repeat(8000));
    let folder = folder("odd");
    let png = folder.join("a.png");
    std::fs::write(&png, b"\x89PNG\r\n\x1a\nnonsense").expect("a file");
    let png = png.to_string_lossy().into_owned();
    for args in [
        &["render", "wind=10", "--frames", "0"][..],
        &["render", "wind=10", "--frames", "2", "--fps", "NaN", "-o", &png],
        &["render", "wind=10", "--size", "8193x1"],
        &["render", "wind=10", "--size", "-1x-1"],
        &["render", "wind=10", "--size", "18446744073709551617x1"],
        &["render", "wind=10", "--reference", "--samples", "0"],
        &["compare", &png, &png],
        &["compare", &png, &png, "--ppd", "NaN"],
        &["compare", "/", "/"],
        &["bench", "--repeat", "99999999999"],
        &["info", "--yaml"],
    ] {
        let output = seastate(args);
        assert_eq!((output.status.code(), complaints(&output).len()), (Some(2), 1), "{args:?}: {output:?}");
    }
    let output = seastate(&["stats", &long, "--json"]);
    assert!(output.status.success(), "{output:?}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("is longer than"), "{output:?}");
}

#[test]
fn info_says_what_runs_on_what() {
    let output = seastate(&["info", "--json"]);
    assert!(output.status.success(), "{output:?}");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(json["seastate"], env!("CARGO_PKG_VERSION"));
    let lock = include_str!("../Cargo.lock");
    let locked = lock.split("name = \"wgpu\"\nversion = \"").nth(1).and_then(|rest| rest.split('"').next());
    assert_eq!(json["wgpu"].as_str(), locked, "the version that is told is the one that is built");
    assert!(json["adapter"].as_str().is_some_and(|name| !name.is_empty()), "{json}");
    assert!(json["system"].as_str().is_some_and(|system| system.contains(std::env::consts::ARCH)));
    let limit = |name: &str| json["limits"][name]["adapter"].as_u64().unwrap_or_else(|| panic!("{name}: {json}"));
    assert!(limit("texture_side") >= 8192 && limit("workgroup_memory_bytes") >= 16_384, "{json}");
    let software = json["kind"] == "Cpu";
    let way = json["ways"]["transform"].as_str().expect("a way");
    let expected = if software { "unrolled" } else { "workgroup" };
    assert!(way.starts_with(expected), "{way}");
    let output = seastate(&["info"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    for name in ["Seastate", "wgpu", "adapter", "backend", "driver", "features", "texture side"] {
        assert!(text.lines().any(|line| line.starts_with(name)), "{name}: {text}");
    }
}

#[test]
fn help_and_version_are_no_errors() {
    for args in [&["--help"][..], &["--version"], &["render", "--help"], &["keys"]] {
        let output = seastate(args);
        assert_eq!(output.status.code(), Some(0), "{args:?}");
        assert!(!output.stdout.is_empty(), "{args:?}");
    }
}

#[test]
fn a_missing_adapter_names_the_package() {
    let output = Command::new(env!("CARGO_BIN_EXE_seastate"))
        .args(["check", "n=128"])
        .env("VK_DRIVER_FILES", "/nonexistent")
        .env("VK_ICD_FILENAMES", "/nonexistent")
        .env_remove("WGPU_ADAPTER_NAME")
        .output()
        .expect("the program runs");
    if cfg!(target_os = "linux") {
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        let said = complaints(&output);
        assert!(said.len() == 1 && said[0].contains("mesa-vulkan-drivers"), "{said:?}");
    }
}

#[test]
fn an_unknown_adapter_is_an_error_that_lists_the_known() {
    let output = Command::new(env!("CARGO_BIN_EXE_seastate"))
        .args(["check", "n=128"])
        .env("WGPU_ADAPTER_NAME", "no such thing")
        .output()
        .expect("the program runs");
    assert_eq!(output.status.code(), Some(2));
    assert!(complaints(&output)[0].contains("there are:"), "{output:?}");
}

#[test]
fn render_writes_a_picture_of_the_asked_size() {
    let path = folder("render").join("sea.png");
    let file = path.to_str().expect("utf-8");
    let output = seastate(&["render", "wind=12&n=64&t=5&nonsense=1", "--size", "160x96", "-o", file]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert!(complaints(&output).iter().any(|l| l.contains("nonsense")), "unknown keys are said: {output:?}");
    let picture = image::open(&path).expect("a PNG").to_rgba8();
    assert_eq!(picture.dimensions(), (160, 96));
}

#[test]
fn an_unwritable_output_is_one_line() {
    let output = seastate(&["render", "n=128", "--size", "16x16", "-o", "/nonexistent/folder/sea.png"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(complaints(&output).len(), 1, "{output:?}");
}

#[test]
fn export_writes_named_float_channels() {
    use exr::prelude::*;
    let folder = folder("export");
    let output = seastate(&["export", "wind=12&n=64&t=5&chop=0.5", "-o", folder.to_str().expect("utf-8"), "--raw"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let plan: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.join("plan.json")).expect("plan.json")).expect("JSON");
    let cascades = plan["cascades"].as_array().expect("cascades").len();
    assert!((1..=4).contains(&cascades));
    let channels = |file: &str| {
        let image = read_all_flat_layers_from_file(folder.join(file)).expect(file);
        let layer = image.layer_data.into_iter().next().expect("a layer");
        layer.channel_data.list.into_iter().map(|c| (c.name.to_string(), c.sample_data)).collect::<Vec<_>>()
    };
    for c in 0..cascades {
        let displacement = channels(&format!("cascade{c}_displacement.exr"));
        assert_eq!(displacement.iter().map(|(n, _)| n.as_str()).collect::<Vec<_>>(), ["X", "Y", "Z"]);
        let gradients = channels(&format!("cascade{c}_gradients.exr"));
        let names: Vec<_> = gradients.iter().map(|(n, _)| n.as_str()).collect();
        assert_eq!(names, ["dDx_dx", "dDx_dz", "dDz_dz", "deta_dx", "deta_dz"]);
        // The heights equal those of heights.f32, bit for bit.
        let raw = std::fs::read(folder.join("heights.f32")).expect("heights.f32");
        let raw: Vec<f32> = bytemuck::pod_collect_to_vec(&raw);
        let FlatSamples::F32(heights) = &displacement[1].1 else { panic!("32-bit floats") };
        assert_eq!(heights[..], raw[c * 64 * 64..][..64 * 64]);
        assert!(heights.iter().any(|h| *h != 0.0));
    }
    let foam = channels("foam.exr");
    assert_eq!(foam[0].0, "foam");
    assert!(plan["foam"]["side_m"].as_f64().expect("a side") > 0.0);
}

#[test]
fn stats_have_the_promised_shape() {
    let output = seastate(&["stats", "wind=10&fetch=100&n=64&nonsense=1", "--seeds", "2", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    for (part, keys) in [
        ("theory", &["m0_m2", "hs_m", "tp_s", "tm02_s", "lambda_p_m", "mss", "mean_from_deg", "spread_deg"][..]),
        ("resolved", &["m0_m2", "hs_m", "mss", "m0_fraction"]),
        ("measured", &["hs_m", "mean_m", "mss", "skewness", "kurtosis", "from_deg", "whitecap_fraction", "seeds"]),
    ] {
        for key in keys {
            assert!(json[part][key].is_number(), "{part}.{key}: {json}");
        }
    }
    for key in ["n", "patch_m", "k_low", "k_high"] {
        assert!(json["cascades"][0][key].is_number(), "cascades.{key}");
    }
    assert_eq!(json["state"], "wind=10&fetch=100&n=64");
    assert!(json["notices"][0].as_str().expect("a notice").contains("nonsense"));
}

#[test]
fn stats_measure_crests() {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("crests.csv");
    let name = file.to_str().expect("a path");
    let output = seastate(&["stats", "hs=2&tp=7&n=64", "--crests", name, "--hours", "0.3", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(json["theory"]["skewness"].as_f64() > Some(0.1), "{json}");
    let crests = &json["crests"];
    let hundredth = &crests["exceeded"][0];
    assert_eq!(hundredth["probability"], 0.01);
    let value = |key: &str| hundredth[key].as_f64().unwrap_or_else(|| panic!("{key}: {json}"));
    assert!(value("rayleigh_crest_m") < value("forristall_3d_crest_m"));
    assert!(value("forristall_3d_crest_m") < value("forristall_2d_crest_m"));
    assert!(value("boccotti_height_m") < value("rayleigh_height_m"));
    assert!((value("measured_crest_m") / value("forristall_3d_crest_m") - 1.0).abs() < 0.25);
    let waves = crests["record"]["waves"].as_u64().expect("waves");
    assert!((100..300).contains(&waves), "{waves}");
    assert!(crests["groups"]["run_length"].as_f64() > Some(1.0));
    let table = std::fs::read_to_string(&file).expect("the table");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "# Seastate hs=2&tp=7&n=64");
    assert!(lines[1].starts_with("probability,crest (m),trough (m),height (m),"), "{}", lines[1]);
    let rows: Vec<Vec<f64>> =
        lines[2..].iter().map(|l| l.split(',').map(|x| x.parse().expect("a number")).collect()).collect();
    assert!(rows.len() > 90 && rows.iter().all(|row| row.len() == 10), "{table}");
    assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0] && pair[0][1] >= pair[1][1]), "{table}");
}

#[test]
fn check_says_that_all_is_well() {
    let output = seastate(&["check", "wind=10&n=64"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("all within tolerance"));
}

#[test]
fn bench_times_every_pass() {
    let output = seastate(&["bench", "n=64&cascades=2", "--size", "64x64", "--repeat", "2", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let passes = json["passes"].as_array().expect("passes");
    let row = |pass: &str| passes.iter().find(|row| row["pass"] == pass).unwrap_or_else(|| panic!("{pass}"));
    let sim = ["spectrum", "rows", "columns", "waves", "mips", "foam", "step"];
    for pass in sim.iter().chain(&["sky tables", "background", "mesh", "water", "tone", "present", "frame"]) {
        let ms = |which: &str| row(pass)[which].as_f64().expect(pass);
        assert!(ms("least_ms") > 0.0 && ms("least_ms") <= ms("median_ms"), "{pass}");
    }
    for pass in &sim[1..] {
        assert_eq!((&row(pass)["n"], &row(pass)["cascades"]), (&64.into(), &2.into()), "{pass}");
        assert!(row(pass)["bytes"].as_f64() > Some(1e5) && row(pass)["flops"].as_f64() > Some(1e4), "{pass}");
    }
    assert!(row("step")["dispatches"].as_u64() > Some(3));
    assert_eq!(row("water")["size"], serde_json::json!([64, 64]));
    assert!(["copy_gb_s", "launch_ms", "shading_gflop_s", "reads_g_s"].iter().all(|c| json[c].as_f64() > Some(0.0)));
    assert!(json["adapter"].is_string());
}

#[test]
fn a_budget_needs_no_gpu() {
    let output = Command::new(env!("CARGO_BIN_EXE_seastate"))
        .args(["bench", "--budget", "n=64&cascades=2", "--size", "640x360"])
        .env("WGPU_ADAPTER_NAME", "none such")
        .output()
        .expect("the program");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let text = String::from_utf8_lossy(&output.stdout);
    let parts = ["frame of 640x360", "2 cascades of 64^2", "columns", "light", "UHD 620", "at 824x1560", "Gop/s"];
    assert!(parts.iter().all(|part| text.contains(part)), "{text}");
}

#[test]
fn a_sequence_is_pictures_in_time_with_layers() {
    let folder = folder("frames");
    let text = folder.to_string_lossy().into_owned();
    let args = [
        "render",
        "wind=12&n=64&t=5&y=10&pitch=-15",
        "--frames",
        "2",
        "--fps",
        "4",
        "--layers",
        "--size",
        "48x32",
        "-o",
        &text,
    ];
    let output = seastate(&args);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && said.contains("2 pictures and layers"), "{output:?}");
    let picture = |i: u32| image::open(folder.join(format!("frame-{i:05}.png"))).expect("a picture").to_rgb8();
    assert_ne!(picture(0), picture(1), "time goes on");
    let layers = exr::prelude::read_first_flat_layer_from_file(folder.join("frame-00000.exr")).expect("layers");
    let channel = |name: &str| -> Vec<f32> {
        let found =
            layers.layer_data.channel_data.list.iter().find(|c| c.name.eq(name)).expect("a channel of that name");
        found.sample_data.values_as_f32().collect()
    };
    let (distance, up) = (channel("Z"), channel("N.Y"));
    let row = |values: &[f32], y: usize| values[y * 48..][..48].iter().sum::<f32>() / 48.0;
    // The top row shows sky. The lowest rays, 40 degrees down from a height of 10 m, meet the water after about 15 m.
    assert!(row(&distance, 0) > 1e9, "{}", row(&distance, 0));
    assert!((8.0..25.0).contains(&row(&distance, 31)), "{}", row(&distance, 31));
    assert!((0.8..=1.0).contains(&row(&up, 31)), "{}", row(&up, 31));
}

#[test]
fn spectra_are_listed_chosen_and_written() {
    let folder = folder("spectra");
    let sample = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/spectra/turning-wind.sp2");
    let listing = seastate(&["spectra", sample]);
    let text = String::from_utf8_lossy(&listing.stdout).into_owned();
    assert_eq!((listing.status.code(), text.lines().count()), (Some(0), 4), "{listing:?}");
    assert!(text.lines().nth(3).is_some_and(|l| l.contains("20240301.120000") && l.contains("default")), "{text}");
    for ending in ["csv", "sp2", "nc"] {
        let path = folder.join(format!("sea.{ending}"));
        let path = path.to_str().expect("utf-8");
        let output = seastate(&["export", "--spectrum", sample, "--spectrum-index", "1", "--spectrum-to", path]);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let again = seastate(&["spectra", path]);
        let text = String::from_utf8_lossy(&again.stdout).into_owned();
        // Hs and Tp of the second spectrum: the heights 1.5 m and 1.8 m of two systems.
        assert!(text.contains("    2.3") && text.lines().count() == 2, "{text}");
    }
    let beyond = seastate(&["export", "--spectrum", sample, "--spectrum-index", "3", "--spectrum-to", "a.csv"]);
    assert_eq!(beyond.status.code(), Some(2));
    assert!(complaints(&beyond)[0].contains("it holds 3 spectra, numbered from 0"), "{beyond:?}");
}

#[test]
fn a_record_is_written() {
    let folder = folder("record");
    for name in ["sea.csv", "sea.nc"] {
        let path = folder.join(name);
        let file = path.to_str().expect("utf-8");
        let args = [
            "record",
            "wind=10&n=64",
            "--at",
            "0,0",
            "--at",
            "-5,10,-3",
            "--hours",
            "0.01",
            "--waves",
            "500",
            "-o",
            file,
        ];
        let output = seastate(&args);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let bytes = std::fs::read(&path).expect("a record");
        if name == "sea.csv" {
            let text = String::from_utf8(bytes).expect("text");
            assert_eq!(text.lines().filter(|l| !l.starts_with('#')).count(), 1 + 144);
        } else {
            assert!(bytes.starts_with(b"CDF\x02"));
        }
    }
}

#[test]
fn a_coast_is_told_and_written() {
    let folder = folder("coasts");
    let files = ["maps.svg", "fields.nc", "gauges.csv"].map(|name| folder.join(name));
    let mut args = vec!["coast", "hs=2&tp=9&dir=270", "--coast", "beach", "--cell", "25", "--gauges", "400,700"];
    files.iter().for_each(|file| args.extend(["-o", file.to_str().expect("a path")]));
    let output = seastate(&args);
    assert_eq!((output.status.code(), complaints(&output)), (Some(0), vec![]), "{output:?}");
    let said = String::from_utf8_lossy(&output.stdout);
    for part in ["Straight beach", "open sea", "5 m of water", "gauge 1", "run-up"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let bytes = files.map(|file| std::fs::read(file).expect("a file"));
    assert!(bytes[0].starts_with(b"<svg") || bytes[0].starts_with(b"<?xml"));
    assert!(bytes[1].starts_with(b"CDF"));
    assert!(String::from_utf8_lossy(&bytes[2]).lines().count() > 10);
}
