//! What must hold whatever bytes are read. The fuzz targets run these (fuzz/), and `tests/hostile.rs` over the kept cases.
#![allow(dead_code, reason = "each target runs one of them")]

use seastate::files::measured::{MAX_STATE_BYTES, Measured};
use seastate::files::{panorama, picture};
use seastate::state::fields::FIELDS;
use seastate::state::{Params, presets, query};
use seastate::waves::Plan;

/// Most columns and rows of a sky here: large ones only take longer.
const SKY: [usize; 2] = [256, 129];
/// Stands between the files of one buoy.
const NEXT_FILE: u8 = 0x1c;

/// A target, which is the folder of its cases, too, and its check.
type Check = (&'static str, fn(&[u8]));

/// Every check.
pub const CHECKS: [Check; 5] = [("state", state), ("sky", sky), ("buoy", buoy), ("seas", seas), ("picture", picture)];

/// A state string: reading never fails, and what was read is written in a form that is read back to the same.
pub fn state(bytes: &[u8]) {
    let (params, notices) = query::parse(&String::from_utf8_lossy(bytes));
    assert!(notices.len() <= 25);
    is_canonical(&params);
}

/// A file of a sky, cut short, lying or neither.
pub fn sky(bytes: &[u8]) {
    let Ok(sky) = panorama::read_within("a.exr", bytes, SKY) else { return };
    assert!(sky.width <= SKY[0] && sky.height <= SKY[1]);
    assert_eq!(sky.mips[0].len(), sky.width * sky.height);
    assert_eq!(sky.calm.len(), panorama::CALM[0] * panorama::CALM[1]);
    assert!(sky.calm.iter().flatten().all(|v| v.is_finite() && *v >= 0.0));
    assert!(sky.irradiance.iter().all(|v| v.is_finite()) && sky.gain > 0.0 && sky.gain.is_finite());
    if let Some(sun) = sky.sun {
        assert!(sun.irradiance.iter().all(|v| v.is_finite()) && (-90.0..=90.0).contains(&sun.elevation_deg));
    }
}

/// Files of a buoy, each a line with its name and what it holds; and the same bytes as a link carries them.
pub fn buoy(bytes: &[u8]) {
    let named = |file: &[u8]| {
        let end = file.iter().position(|b| *b == b'\n').unwrap_or(0);
        (String::from_utf8_lossy(&file[..end]).into_owned(), file[end..].to_vec())
    };
    let files: Vec<_> = bytes.split(|b| *b == NEXT_FILE).map(named).collect();
    let read = Measured::read(&files).map(|(sea, _)| sea);
    let carried = Measured::from_state(&String::from_utf8_lossy(bytes));
    for sea in read.into_iter().chain(carried) {
        let text = sea.to_state();
        assert!(text.len() <= MAX_STATE_BYTES, "{} bytes", text.len());
        assert_eq!(Measured::from_state(&text).as_ref(), Ok(&sea));
        assert!(sea.hs_m().is_finite() && sea.omega_p() > 0.0 && sea.tail_m2().is_finite());
        let mut params = Params::default();
        params.sea.show_measured(sea);
        is_canonical(&params);
        let plan = Plan::new(&params);
        assert!((1..=4).contains(&plan.cascades.len()));
        assert!(plan.hs_m().is_finite() && plan.captured().is_finite() && plan.k_max().is_finite());
    }
}

/// A file of seas.
pub fn seas(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    presets::is_file(&text);
    let (seas, notices) = presets::read(&text);
    assert!(seas.len() <= presets::MAX_PRESETS && notices.len() <= 25);
    assert_eq!(presets::read(&presets::write(&seas)), (seas.clone(), vec![]));
    for sea in &seas {
        let (params, notices) = sea.apply(&Params::default());
        assert!(notices.len() <= 26);
        is_canonical(&params);
    }
}

/// A picture that may carry a state; and a state that a picture carries, whatever it says.
pub fn picture(bytes: &[u8]) {
    if let Ok(found) = picture::state_of(bytes) {
        state(found.as_bytes());
    }
    let text = String::from_utf8_lossy(bytes);
    let made = picture::encode([1, 1], &[0; 4], &text, "");
    let found = made.and_then(|png| picture::state_of(&png));
    assert_eq!(found.ok().as_deref(), (text.len() <= query::MAX_BYTES).then_some(&*text));
}

/// Valid throughout, and the same again after a link.
pub fn is_canonical(params: &Params) {
    for field in FIELDS.iter() {
        let value = (field.get)(params);
        assert_eq!(field.accept(value), Ok(value), "{}", field.key);
    }
    let written = query::write(params);
    assert!(written.len() <= query::MAX_BYTES, "{} bytes: {written}", written.len());
    let (again, notices) = query::parse(&written);
    assert_eq!(notices, Vec::<String>::new(), "{written}");
    assert_eq!(&again, params, "{written}");
    assert_eq!(query::write(&again), written);
}
