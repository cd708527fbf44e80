//! Properties that hold for any bytes that are read. Each fuzz target (fuzz/) runs one of these checks;
//! `tests/hostile.rs` runs all of them over the kept cases.
#![allow(dead_code, reason = "each fuzz target runs one check")]

use seastate::coast::placed::{PlacedCoast, PlacingOptions};
use seastate::files::bathymetry::{self as bathymetry_files, MAX_ELEVATION_M, ReadAs};
use seastate::files::measured::{MAX_TEXT_BYTES, MeasuredSpectrum};
use seastate::files::{panorama, picture};
use seastate::state::fields::FIELDS;
use seastate::state::{Params, presets, query};
use seastate::waves::Plan;

/// Most columns and rows of a sky image; small ones are read faster.
const SKY: [usize; 2] = [256, 129];
/// Separator between the files of one buoy.
const NEXT_FILE: u8 = 0x1c;

/// Name of a fuzz target, which is the folder of its cases too, and its check.
type Check = (&'static str, fn(&[u8]));

/// All checks.
pub const CHECKS: [Check; 10] = [
    ("state", state),
    ("sky", sky),
    ("buoy", buoy),
    ("seas", seas),
    ("picture", picture),
    ("swan", spectra),
    ("wavewatch", spectra),
    ("spotter", spectra),
    ("netcdf", spectra),
    ("bathymetry", bathymetry),
];

/// Reads a state string. Reading never fails, and the result is written in a form that is read back as the same state.
pub fn state(bytes: &[u8]) {
    let (params, notices) = query::parse(&String::from_utf8_lossy(bytes));
    assert!(notices.len() <= 25);
    is_canonical(&params);
}

/// Reads a sky file, which may be truncated or make false claims.
pub fn sky(bytes: &[u8]) {
    let Ok(sky) = panorama::read_with_max_size("a.exr", bytes, SKY) else { return };
    assert!(sky.width <= SKY[0] && sky.height <= SKY[1]);
    assert_eq!(sky.mips[0].len(), sky.width * sky.height);
    assert_eq!(sky.sunless.len(), panorama::SUNLESS_SIZE[0] * panorama::SUNLESS_SIZE[1]);
    assert!(sky.sunless.iter().flatten().all(|v| v.is_finite() && *v >= 0.0));
    assert!(sky.irradiance.iter().all(|v| v.is_finite()) && sky.gain > 0.0 && sky.gain.is_finite());
    if let Some(sun) = sky.sun {
        assert!(sun.irradiance.iter().all(|v| v.is_finite()) && (-90.0..=90.0).contains(&sun.elevation_deg));
    }
}

/// Reads the files of one buoy, each with its name on the first line; then reads the same bytes as text of a link.
pub fn buoy(bytes: &[u8]) {
    let named = |file: &[u8]| {
        let end = file.iter().position(|b| *b == b'\n').unwrap_or(0);
        (String::from_utf8_lossy(&file[..end]).into_owned(), file[end..].to_vec())
    };
    let files: Vec<_> = bytes.split(|b| *b == NEXT_FILE).map(named).collect();
    let read = MeasuredSpectrum::read(&files).map(|file| file.spectrum);
    let carried = MeasuredSpectrum::from_state(&String::from_utf8_lossy(bytes));
    read.into_iter().chain(carried).for_each(is_a_sea);
}

/// Reads a file of a wave model or a Spotter buoy, which may hold several spectra.
pub fn spectra(bytes: &[u8]) {
    match MeasuredSpectrum::read_list(&[("a".to_owned(), bytes.to_vec())]) {
        Ok(list) => {
            assert!(list.default_index < list.records.len() && list.notices.len() < 3);
            let last = list.records.len() - 1;
            for index in [0, list.default_index, last] {
                assert!(list.title(index).chars().count() <= 80);
                is_a_sea(list.records[index].spectrum.clone());
            }
        }
        Err(reason) => assert!(reason.starts_with('a') && reason.lines().count() == 1, "{reason}"),
    }
}

/// Reads a bathymetry in each way in which a user may have it read, and places it as a coast.
pub fn bathymetry(bytes: &[u8]) {
    for is_positive_up in [None, Some(true), Some(false)] {
        let read_as = ReadAs { is_positive_up, is_in_degrees: is_positive_up };
        match bathymetry_files::read("a", bytes, read_as) {
            Ok(file) => {
                let grid = &file.grid;
                assert!(grid.columns >= 2 && grid.rows >= 2 && file.notices.len() < 6);
                assert_eq!(grid.elevation_m.len(), grid.columns * grid.rows);
                let limit = MAX_ELEVATION_M as f32 * 1.01;
                assert!(grid.elevation_m.iter().all(|v| v.abs() <= limit));
                assert!(grid.cell_m.iter().all(|c| (1e-3..1e6).contains(c)));
                match PlacedCoast::from_file(&file, &PlacingOptions::default()) {
                    Ok(coast) => {
                        assert!(coast.bathymetry.depth_m.iter().all(|d| d.is_finite()));
                        assert!((0.0..360.0).contains(&coast.toward_deg));
                    }
                    Err(reason) => assert!(reason.starts_with("a: ") && reason.lines().count() == 1, "{reason}"),
                }
            }
            Err(reason) => assert!(reason.starts_with("a: ") && reason.lines().count() == 1, "{reason}"),
        }
    }
}

/// Checks that a spectrum survives a link, and that a sea can be planned from it.
fn is_a_sea(sea: MeasuredSpectrum) {
    let text = sea.to_state();
    assert!(text.len() <= MAX_TEXT_BYTES, "{} bytes", text.len());
    assert_eq!(MeasuredSpectrum::from_state(&text).as_ref(), Ok(&sea));
    assert!(sea.hs_m().is_finite() && sea.omega_p() > 0.0 && sea.lowest_omega() > 0.0);
    let mut params = Params::default();
    params.sea.set_measured_spectrum(sea);
    is_canonical(&params);
    let plan = Plan::new(&params);
    assert!((1..=4).contains(&plan.cascades.len()));
    assert!(plan.hs_m().is_finite() && plan.resolved_variance_fraction().is_finite() && plan.k_max().is_finite());
}

/// Reads a file of named seas.
pub fn seas(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    presets::is_preset_file(&text);
    let (seas, notices) = presets::read(&text);
    assert!(seas.len() <= presets::MAX_PRESETS && notices.len() <= 25);
    assert_eq!(presets::read(&presets::write(&seas)), (seas.clone(), vec![]));
    for sea in &seas {
        let (params, notices) = sea.apply(&Params::default());
        assert!(notices.len() <= 26);
        is_canonical(&params);
    }
}

/// Reads a picture that may carry a state, and writes and reads a picture with any text as its state.
pub fn picture(bytes: &[u8]) {
    if let Ok(found) = picture::state_from_png(bytes) {
        state(found.as_bytes());
    }
    let text = String::from_utf8_lossy(bytes);
    let made = picture::encode([1, 1], &[0; 4], &text, "");
    let found = made.and_then(|png| picture::state_from_png(&png));
    assert_eq!(found.ok().as_deref(), (text.len() <= seastate::files::MAX_STATE_BYTES).then_some(&*text));
}

/// Checks that all parameters are valid and that a link brings them back unchanged.
pub fn is_canonical(params: &Params) {
    for field in FIELDS.iter() {
        let value = (field.get)(params);
        assert_eq!(field.check_value(value), Ok(value), "{}", field.key);
    }
    let written = query::write(params);
    assert!(written.len() <= seastate::files::MAX_STATE_BYTES, "{} bytes: {written}", written.len());
    let (again, notices) = query::parse(&written);
    assert_eq!(notices, Vec::<String>::new(), "{written}");
    assert_eq!(&again, params, "{written}");
    assert_eq!(query::write(&again), written);
}
