//! Files and texts that are broken, make false claims or are malicious: each is refused with a message.

#[path = "common/hostile.rs"]
mod hostile;

use exr::prelude::*;
use hostile::CHECKS;
use seastate::files::panorama;
use seastate::waves::noise::pcg4d;
use std::path::PathBuf;

/// Runs every case that fuzzing (fuzz/) found or kept through the check of its target.
#[test]
fn kept_cases_do_no_harm() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let mut bytes = 0;
    for (target, check) in CHECKS {
        let files = std::fs::read_dir(folder.join(target)).unwrap_or_else(|e| panic!("tests/cases/{target}: {e}"));
        let mut paths: Vec<PathBuf> = files.map(|file| file.expect("a file").path()).collect();
        paths.sort();
        assert!(paths.len() > 20, "{target}: {}", paths.len());
        for path in paths {
            let case = std::fs::read(&path).expect("a case");
            bytes += case.len();
            // The test harness shows this only if the case fails.
            eprintln!("{}", path.display());
            check(&case);
        }
    }
    assert!(bytes < 1 << 20, "{bytes} bytes of cases: keep fewer");
}

/// Changes the kept cases of the spectrum readers at random, as many files each as CHANGED_FILES says: what fuzzing does,
/// without its tools and without coverage.
#[test]
#[ignore = "minutes: after a change of a reader of spectra, where cargo-fuzz cannot be had"]
fn changed_cases_do_no_harm() {
    let rounds: u32 = std::env::var("CHANGED_FILES").ok().and_then(|s| s.parse().ok()).unwrap_or(100_000);
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests");
    for (target, check) in
        CHECKS.iter().filter(|(name, _)| ["swan", "wavewatch", "spotter", "netcdf", "bathymetry"].contains(name))
    {
        let folders = [root.join("cases").join(target), root.join("spectra")];
        let paths =
            folders.iter().flat_map(|f| std::fs::read_dir(f).expect("a folder").map(|e| e.expect("a file").path()));
        let is_netcdf = |p: &PathBuf| p.extension().is_some_and(|e| e == "nc");
        let kept = |p: &PathBuf| p.parent() == Some(&folders[0]) || is_netcdf(p) == (*target == "netcdf");
        let cases: Vec<Vec<u8>> = paths.filter(kept).map(|p| std::fs::read(p).expect("a case")).collect();
        for round in 0..rounds {
            let mut bytes = cases[pcg4d([round, 1, 2, 3])[0] as usize % cases.len()].clone();
            for change in 0..1 + pcg4d([round, 4, 5, 6])[0] % 4 {
                let [at, kind, value, length] = pcg4d([round, change, 7, 8]);
                if bytes.is_empty() {
                    break;
                }
                // Headers are worth most.
                let reach = if value % 2 == 0 { bytes.len() } else { bytes.len().min(1500) };
                let at = at as usize % reach;
                match kind % 6 {
                    0 => bytes.truncate(at),
                    1 => drop(bytes.drain(at..bytes.len().min(at + length as usize % 30))),
                    2 => bytes
                        .splice(at..at, b"0123456789-eE.\n ".iter().copied().skip(length as usize % 16).take(2))
                        .for_each(drop),
                    3 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff, b'9', b'-', b'\n'][length as usize % 8],
                    _ => bytes[at] = value as u8,
                }
            }
            check(&bytes);
        }
        eprintln!("{target}: {rounds} changed files");
    }
}

/// A small sky in OpenEXR, as scanlines. Its attribute `chunkCount` is renamed, because changed sizes would disagree
/// with it.
fn exr() -> Vec<u8> {
    let rows =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let pixels = SpecificChannels::rgb(|at: Vec2<usize>| (at.x() as f32, 1f32, at.y() as f32));
    let mut bytes = std::io::Cursor::new(Vec::new());
    let image = Image::from_layer(Layer::new((64, 32), LayerAttributes::default(), rows, pixels));
    image.write().to_buffered(&mut bytes).expect("a file");
    let mut bytes = bytes.into_inner();
    let end = after(&bytes, b"chunkCount\0");
    bytes[end - 2] = b'_';
    bytes
}

/// Position directly after a piece of a file.
fn after(bytes: &[u8], piece: &[u8]) -> usize {
    bytes.windows(piece.len()).position(|w| w == piece).expect("the piece is there") + piece.len()
}

/// The file of [`exr`] with other windows: x and y of the first and the last pixel.
fn with_windows(data: [i32; 4], display: [i32; 4]) -> Vec<u8> {
    let mut bytes = exr();
    for (name, window) in [("dataWindow", data), ("displayWindow", display)] {
        // Four bytes for the length of the value.
        let at = after(&bytes, format!("{name}\0box2i\0").as_bytes()) + 4;
        bytes[at..at + 16].copy_from_slice(&window.map(i32::to_le_bytes).concat());
    }
    bytes
}

fn refusal(bytes: &[u8]) -> String {
    panorama::read("sky.exr", bytes).map(drop).expect_err("refused")
}

#[test]
fn a_sky_that_claims_to_be_enormous_is_refused_before_memory_is_asked_for() {
    assert!(panorama::read("sky.exr", &exr()).is_ok());
    let whole = [0, 0, 63, 31];
    let huge = [0, 0, 1_000_000_000, 500_000_000];
    for (data, display) in [(huge, whole), (whole, huge), (huge, huge)] {
        let reason = refusal(&with_windows(data, display));
        let says = "sky.exr: 1000000001 x 500000001 pixels, but at most 16384 x 8193 are read: save it smaller";
        assert_eq!(reason, says);
    }
    // The size is within the limits, but the file has only some kilobytes.
    assert!(refusal(&with_windows([0, 0, 16_383, 8_191], [0, 0, 16_383, 8_191])).contains("ends too early"));
    for edge in [i32::MIN, i32::MIN / 2, -1, i32::MAX / 2, i32::MAX] {
        refusal(&with_windows([edge, edge, edge, edge], whole));
        refusal(&with_windows(whole, [edge, edge, edge, edge]));
        refusal(&with_windows([edge, 0, 63, 31], [0, edge, 63, 31]));
    }
}

#[test]
fn a_sky_of_a_single_enormous_block_is_refused() {
    // A thousand channels, with a compression that makes blocks of 256 rows.
    let mut bytes = exr();
    let at = after(&bytes, b"compression\0compression\0") + 4;
    bytes[at] = 9;
    let at = after(&bytes, b"channels\0chlist\0");
    let length = u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    let channel = |name: &str| {
        let [kind, one] = [2u32, 1].map(u32::to_le_bytes);
        [name.as_bytes(), &[0], &kind, &[0; 4], &one, &one].concat()
    };
    let names = (0..1000).map(|i| format!("{i:03}")).chain(["B", "G", "R"].map(str::to_owned));
    let mut list: Vec<u8> = names.flat_map(|name| channel(&name)).collect();
    list.push(0);
    bytes.splice(at + 4..at + 4 + length as usize, list.iter().copied());
    bytes[at..at + 4].copy_from_slice(&(list.len() as u32).to_le_bytes());
    refusal(&bytes);
    for name in ["dataWindow", "displayWindow"] {
        let at = after(&bytes, format!("{name}\0box2i\0").as_bytes()) + 4;
        bytes[at..at + 16].copy_from_slice(&[0, 0, 16_383, 8_191].map(i32::to_le_bytes).concat());
    }
    assert!(
        refusal(&bytes).contains("256 MiB: save it as scanlines with ZIP, or in smaller tiles"),
        "{}",
        refusal(&bytes)
    );
}

#[test]
fn skies_that_end_early_or_have_a_wrong_byte_are_refused_or_read() {
    let whole = exr();
    for end in 0..whole.len() {
        let reason = refusal(&whole[..end]);
        assert!(reason.starts_with("sky.exr: ") && reason.len() > 20 && reason.lines().count() == 1, "{reason}");
    }
    for i in 0..whole.len().min(1500) {
        for flip in [0x01, 0x80, 0xff] {
            let mut bytes = whole.clone();
            bytes[i] ^= flip;
            hostile::sky(&bytes);
        }
    }
}
