//! Tests of built-in presets, preset files, and the parameters that a preset sets or keeps.

use super::*;
use crate::coast::PlacedCoast;
use crate::files::bathymetry::{BathymetryFile, ElevationGrid};
use crate::files::measured::MeasuredSpectrum;
use crate::state::coast::{Coast, CoastFile, CoastName};
use crate::state::fields::{FieldKind, InvalidValue};
use crate::state::text::MAX_NOTICES;
use crate::waves::statistics::SpectrumStatistics;
use crate::waves::{Plan, noise};
use std::collections::HashSet;
use std::sync::Arc;

/// A small deterministic generator of random numbers.
struct Dice(u32);

impl Dice {
    fn next(&mut self) -> u32 {
        self.0 += 1;
        noise::pcg4d([self.0, 5, 6, 7])[0]
    }

    fn below(&mut self, end: usize) -> usize {
        self.next() as usize % end
    }
}

/// Parameters with random values in about half of the fields that `which` selects; all others have their defaults.
fn random(dice: &mut Dice, which: impl Fn(&Field) -> bool) -> Params {
    let mut p = Params::default();
    for field in FIELDS.iter().filter(|f| which(f)) {
        let u = f64::from(dice.next()) / f64::from(u32::MAX);
        if dice.below(2) == 0 {
            continue;
        }
        let value = match field.kind {
            FieldKind::Number { min, max, .. } => min + (max - min) * u,
            FieldKind::Integer { min, max } => f64::from(min) + (f64::from(max) - f64::from(min)) * u,
            FieldKind::Choice(words) => u * (words.len() as f64 - 1.0),
            FieldKind::Heading => 359.9 * u,
            FieldKind::Flag => u.round(),
            FieldKind::Colour => f64::from(0x00ff_ffff) * u,
        };
        // A whole number has its random value rounded, which `check_value` reports as clamped.
        let taken = match field.check_value(value) {
            Ok(v) | Err(InvalidValue::Clamped(v)) => v,
            Err(InvalidValue::Ignored) => continue,
        };
        (field.set)(&mut p, taken);
    }
    p
}

fn same(field: &Field, a: &Params, b: &Params) -> bool {
    (field.get)(a) == (field.get)(b)
}

/// Ranges of significant wave height, m, and peak period, s, that the description of each built-in preset claims.
const CLAIMS: [(&str, [f64; 2], [f64; 2]); 26] = [
    ("A fine day", [2.15, 2.3], [11.5, 12.5]),
    ("Calm open ocean", [0.85, 0.95], [9.5, 10.5]),
    ("Large swells", [5.5, 5.7], [9.5, 10.5]),
    ("North Sea gale", [5.5, 6.0], [10.5, 11.5]),
    ("Trade wind", [1.9, 2.1], [11.5, 12.5]),
    ("Sunset in the trades", [1.6, 1.8], [11.5, 12.5]),
    ("Southern Ocean", [4.0, 5.0], [12.5, 13.5]),
    ("Shallow Dutch coast", [1.0, 1.5], [5.0, 6.0]),
    ("Black Sea MarNeRo", [2.0, 2.5], [6.0, 7.0]),
    ("Crossing seas", [3.5, 4.0], [7.0, 9.0]),
    ("Pacific crossing", [2.85, 3.15], [12.0, 13.0]),
    ("Harbour morning", [0.045, 0.055], [0.5, 1.5]),
    ("Lake in a fresh breeze", [0.5, 0.6], [2.5, 3.5]),
    ("Mistral", [3.0, 4.0], [7.0, 8.0]),
    ("Arabian Sea in the monsoon", [4.0, 4.5], [9.0, 10.0]),
    ("Norwegian Sea storm", [8.5, 9.5], [12.0, 13.0]),
    ("Hurricane", [12.0, 13.0], [13.0, 14.0]),
    ("Dead calm with distant swell", [1.45, 1.55], [15.5, 16.5]),
    ("Ripples of a light breeze", [0.05, 0.15], [1.3, 1.5]),
    ("Shallow tropical water", [0.3, 0.4], [2.0, 3.0]),
    ("Swell on a beach", [2.1, 2.3], [9.5, 10.5]),
    ("Headland and bay", [1.7, 1.9], [10.5, 11.5]),
    ("Surf on a bar", [2.4, 2.6], [11.5, 12.5]),
    ("Around the island", [1.25, 1.35], [10.5, 11.5]),
    ("Harbour entrance", [0.75, 0.85], [7.5, 8.5]),
    ("Over the shoal", [1.45, 1.6], [6.8, 7.4]),
];

#[test]
fn the_built_in_seas_are_what_they_say() {
    let (presets, notices) = read(include_str!("../../../assets/presets/seas.txt"));
    assert_eq!((presets.as_slice(), notices), (built_in(), vec![]));
    let names: Vec<&str> = presets.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, CLAIMS.map(|(name, ..)| name), "each has its line in the table, and no two share a name");
    assert_eq!(names.iter().collect::<HashSet<_>>().len(), names.len());
    let within = |x: f64, [low, high]: [f64; 2]| (low..=high).contains(&x);
    for (preset, (name, hs_m, tp_s)) in presets.iter().zip(CLAIMS) {
        let (params, notices) = preset.apply(&Params::default());
        assert_eq!(notices, Vec::<String>::new(), "{name}");
        let plan = Plan::new(&params);
        assert_eq!(plan.notices, Vec::<String>::new(), "{name}");
        let theory = SpectrumStatistics::new(&plan);
        assert!(within(theory.hs_m, hs_m) && within(theory.tp_s, tp_s), "{name}: {} {}", theory.hs_m, theory.tp_s);
        let texts = [&preset.about, &preset.source];
        assert!(texts.iter().all(|t| t.len() > 20 && t.ends_with('.')), "{name}");
        assert!(preset.about.contains("Hs ") && preset.about.contains("Tp "), "{name}");
    }
}

/// A yacht draws about 2 m. The picture of a sea does not show whether its water is as deep.
#[test]
fn what_floats_in_a_built_in_sea_is_not_aground() {
    const LEAST_DEPTH_M: f64 = 2.5;
    let mut afloat = 0;
    for sea in built_in() {
        let (params, _) = sea.apply(&Params::default());
        let Some(coast) = PlacedCoast::of_state(&params.coast, None).expect("a built-in coast") else { continue };
        for object in &params.floating_objects {
            let depth_m = coast.depth_at_m([object.x_m, object.z_m]);
            assert!(depth_m > LEAST_DEPTH_M, "{}: {object:?} in {depth_m:.1} m of water", sea.name);
            afloat += 1;
        }
    }
    assert!(afloat >= 4, "{afloat} objects are afloat");
}

#[test]
fn the_built_in_seas_survive_being_carried() {
    for preset in built_in() {
        let (params, _) = preset.apply(&Params::default());
        let again = Preset::from_params(&preset.name, &params);
        // The camera and the floating objects are not carried.
        let now = Params {
            camera: params.camera.clone(),
            floating_objects: params.floating_objects.clone(),
            ..Params::default()
        };
        assert_eq!(again.apply(&now), (params, vec![]), "{}", preset.name);
    }
}

#[test]
fn files_come_back_as_they_were_written() {
    assert_eq!(read(&write(built_in())), (built_in().to_vec(), vec![]));
    let mut dice = Dice(0);
    let text = |dice: &mut Dice, most: usize| -> String {
        let letters = ['a', 'Z', ' ', '#', '[', ']', ':', '=', '&', '%', 'é', '🌊', '\u{2028}', '\u{feff}', '"'];
        (0..dice.below(most)).map(|_| letters[dice.below(letters.len())]).collect()
    };
    for _ in 0..2000 {
        let presets: Vec<Preset> = (0..dice.below(5))
            .map(|i| Preset {
                name: format!("{}{i}", text(&mut dice, 50)),
                about: text(&mut dice, 200),
                source: text(&mut dice, 200),
                state: text(&mut dice, 200),
            })
            .map(Preset::sanitised)
            .collect();
        let (again, notices) = read(&write(&presets));
        let unique = presets.iter().map(|p| &p.name).collect::<HashSet<_>>().len() == presets.len();
        assert!(!unique || again == presets, "{presets:?}");
        assert_eq!(notices, Vec::<String>::new(), "{presets:?}");
    }
    let dirty = [Preset { name: " a\nb\t".into(), about: "x\r\n[y]\nstate: wind=3".into(), ..Preset::default() }];
    let (clean, notices) = read(&write(&dirty));
    assert_eq!((clean.len(), clean[0].name.as_str(), clean[0].state.as_str()), (1, "ab", ""));
    assert_eq!((clean[0].about.as_str(), notices), ("x[y]state: wind=3", vec![]));
}

#[test]
fn seas_and_light_come_back() {
    let mut dice = Dice(1);
    for _ in 0..300 {
        let saved = random(&mut dice, |_| true);
        let now = random(&mut dice, |_| true);
        let preset = Preset::from_params("one", &saved);
        let (next, notices) = preset.apply(&now);
        assert_eq!(notices, Vec::<String>::new(), "{}", preset.state);
        for field in FIELDS.iter() {
            let default_seed = field.key == SEED_KEY && (field.get)(&saved) == field.default_value();
            let from = match apply_rule(field.group) {
                ApplyRule::SeaAndLight if !default_seed => &saved,
                _ => &now,
            };
            assert!(same(field, &next, from), "{} of {}", field.key, preset.state);
        }
        assert_eq!(preset.apply(&next), (next.clone(), vec![]), "applied twice is applied once");
        let mut other_seed = next.clone();
        other_seed.sea.seed ^= 1;
        assert!(preset.shows_sea_of(&next) && preset.shows_sea_of(&other_seed));
    }
}

#[test]
fn a_sea_changes_what_is_its_own() {
    let parse = |state: &str| query::parse(state).0;
    let applied = |state: &str, now: &str| {
        let preset = Preset { name: "one".into(), state: state.into(), ..Preset::default() };
        let (next, notices) = preset.apply(&parse(now));
        (query::write(&next), notices)
    };
    let now = "wind=20&hs2=3&scale2=1&depth=50&seed=7&foamdecay=9&foam=0.5\
        &sun=5&haze=3&tone=aces&mesh=2&y=30&heading=10&t=9&n=128";
    let is = |state: &str, wanted: &str| {
        assert_eq!(applied(state, now), (query::write(&parse(wanted)), vec![]), "{state}");
    };
    is("", "seed=7&mesh=2&y=30&heading=10&t=9&n=128");
    is("wind=8&seed=3", "wind=8&seed=3&mesh=2&y=30&heading=10&t=9&n=128");
    is("seed=1", "mesh=2&y=30&heading=10&t=9&n=128");
    is("overcast=1", "seed=7&overcast=1&mesh=2&y=30&heading=10&t=9&n=128");
    is("sun=24", "seed=7&mesh=2&y=30&heading=10&t=9&n=128");
    is("heading=90", "seed=7&mesh=2&y=30&heading=90&t=9&n=128");
    let afloat = |state: &str| applied(state, "afloat=buoy*1*2_boat*3*4").0;
    assert_eq!(afloat("wind=8"), query::write(&parse("wind=8&afloat=buoy*1*2_boat*3*4")));
    assert_eq!(afloat("wind=8&afloat=yacht*5*6"), query::write(&parse("wind=8&afloat=yacht*5*6")));
    assert_eq!(afloat("wind=8&afloat="), query::write(&parse("wind=8")));
    assert_eq!(afloat("wind=8&afloat=raft"), afloat("wind=8"), "what cannot be read takes nothing off the water");
    let (state, notices) = applied("n=512&t=3&mesh=1&wind=8", now);
    assert_eq!(state, query::write(&parse("wind=8&seed=7&mesh=2&y=30&heading=10&t=9&n=128")));
    assert_eq!(notices.len(), 1, "{notices:?}");
    // A key whose value cannot be read does not count as named by the preset.
    let (state, notices) = applied("heading=north&sun=low", now);
    assert_eq!(state, query::write(&parse("seed=7&mesh=2&y=30&heading=10&t=9&n=128")));
    assert_eq!(notices.len(), 2, "{notices:?}");
}

/// A coast belongs to its sea: another sea is open again, unless it names a coast of its own.
#[test]
fn coasts_come_and_go_with_their_seas() {
    let applied = |state: &str, now: &Params| {
        Preset { name: "one".into(), state: state.into(), ..Preset::default() }.apply(now).0
    };
    let mut now = query::parse("coast=file&coastturn=40").0;
    let grid = ElevationGrid { columns: 2, rows: 2, cell_m: [1.0; 2], elevation_m: vec![0.0; 4], middle_deg: None };
    let opened = CoastFile(Arc::new(BathymetryFile { name: "a.tif".into(), grid, notices: vec![] }));
    now.coast.adopt_file(Some(&opened));
    assert!(now.coast.is_on() && now.coast.missing_file_notice().is_none());
    assert_eq!(applied("wind=8", &now).coast, Coast::default());
    let beach = applied("coast=beach", &now).coast;
    assert_eq!((beach.name, beach.turn_deg, beach.file), (CoastName::Beach, 0.0, None));
    assert_eq!(applied("coast=file", &now).coast.file, Some(opened));
    let missing = query::parse("coast=file").0.coast;
    assert!(!missing.is_on() && missing.missing_file_notice().is_some());
    let beach = Preset { state: "coast=beach".into(), ..Preset::default() };
    assert!(beach.shows_sea_of(&applied("coast=beach", &now)) && !beach.shows_sea_of(&Params::default()));
}

/// What a visitor sees first: a storm's clouds and a lagoon's water do not stay for the sea that is chosen next.
#[test]
fn named_seas_do_not_depend_on_the_sea_before() {
    let fresh = Params::default();
    for (before, after) in built_in().iter().flat_map(|a| built_in().iter().map(move |b| (a, b))) {
        let earlier = before.apply(&fresh).0;
        let mut later = after.apply(&earlier).0;
        // Floating objects stay where the sea names none, so both begin with the same ones.
        let afloat = Params { floating_objects: earlier.floating_objects, ..fresh.clone() };
        let direct = after.apply(&afloat).0;
        (later.camera, later.sea.seed) = (direct.camera.clone(), direct.sea.seed);
        assert_eq!(later, direct, "{} after {}", after.name, before.name);
    }
}

#[test]
fn buoys_and_skies_come_along() {
    let bands: Vec<(f64, f64)> = (1..40).map(|i| (0.02 * f64::from(i), 1.0 / f64::from(i))).collect();
    let measured = MeasuredSpectrum::new(&bands, None).expect("a sea");
    let mut now = query::parse("sky=a.hdr&skyturn=30").0;
    now.sea.set_measured_spectrum(measured);
    let preset = Preset::from_params("buoy", &now);
    assert_eq!(preset.apply(&Params::default()), (now.clone(), vec![]));
    let (next, _) = Preset { state: "wind=8".into(), ..Preset::default() }.apply(&now);
    assert_eq!((next.sea.measured.is_none(), next.look), (true, Params::default().look), "buoy and sky go");
    let (next, _) = Preset { state: "sun=3".into(), ..Preset::default() }.apply(&now);
    assert_eq!(next.look.sky.file, None);
    let (next, _) = Preset { state: "sky=a.hdr".into(), ..Preset::default() }.apply(&now);
    assert_eq!((next.look.sky.file, next.look.sky.file_heading_deg), (now.look.sky.file, 0.0));
}

#[test]
fn what_is_wrong_becomes_a_notice() {
    let of = |text: &str| {
        let (presets, notices) = read(text);
        (presets.into_iter().map(|p| (p.name, p.state)).collect::<Vec<_>>(), notices.len())
    };
    let one = |name: &str, state: &str| vec![(name.to_owned(), state.to_owned())];
    assert_eq!(of(""), (vec![], 0));
    assert_eq!(
        of("\u{feff}# a comment\r\n\r\n[a]\r\nstate: wind=3\r\n state : sun=4\r\n"),
        (one("a", "wind=3&sun=4"), 0)
    );
    assert_eq!(of("[a]\nstate:\n"), (one("a", ""), 0));
    assert_eq!(of("[a]\nabout: no state\n"), (vec![], 1));
    assert_eq!(of("[ ]\nstate: wind=3\n"), (vec![], 1));
    assert_eq!(of("wind=3\nstate: wind=3\n[a]\nstate: wind=4"), (one("a", "wind=4"), 1));
    assert_eq!(of("[a]\nstate: wind=3\nhello\nworld: 3\n"), (one("a", "wind=3"), 1));
    assert_eq!(of("[a]\nstate: wind=3\n[a]\nstate: wind=4\n"), (one("a", "wind=4"), 0));
    assert_eq!(of(&format!("[{}]\nstate: wind=3", "x".repeat(70))), (one(&"x".repeat(60), "wind=3"), 1));
    assert_eq!(of(&format!("[a]\nstate: {}", "x".repeat(crate::files::MAX_STATE_BYTES + 1))), (vec![], 1));
    assert_eq!(of("[a\u{7}\u{85}b]\nstate: wi\0nd=3"), (one("ab", "wind=3"), 0));
    let many: String = (0..MAX_PRESETS + 5).map(|i| format!("[{i}]\nstate: wind=3\n")).collect();
    assert_eq!((of(&many).0.len(), of(&many).1), (MAX_PRESETS, 1));
    let long = format!("[a]\nstate: wind=3\nabout: {}\n[b]\nstate: wind=4", "x".repeat(MAX_FILE_BYTES));
    assert_eq!(of(&long), (one("a", "wind=3"), 1));
    assert_eq!(of(&"é".repeat(MAX_FILE_BYTES)), (vec![], 1));
    assert!(read(&"[]\n".repeat(60_000)).1.len() <= MAX_NOTICES + 1);
}

#[test]
fn more_than_a_file_holds_is_not_added() {
    let sea = |name: usize, state: &str| Preset { name: name.to_string(), state: state.into(), ..Preset::default() };
    let mut own: Vec<Preset> = (0..MAX_PRESETS).map(|i| sea(i, "wind=3")).collect();
    let before = own.clone();
    assert!(add(&mut own, vec![sea(0, "wind=4"), sea(MAX_PRESETS, "wind=5")]).is_err_and(|e| e.contains("200 seas")));
    assert_eq!(own, before, "all or nothing");
    assert_eq!((add(&mut own, vec![sea(7, "wind=4")]), own.len(), own[7].state.as_str()), (Ok(()), 200, "wind=4"));
    let long = "x".repeat(crate::files::MAX_STATE_BYTES);
    let mut own = Vec::new();
    for i in 0.. {
        if add(&mut own, vec![sea(i, &long)]).is_err() {
            break;
        }
    }
    assert_eq!(read(&write(&own)), (own.clone(), vec![]), "all that is kept is read again");
    assert!(own.len() > 20, "{}", own.len());
}

#[test]
fn hostile_files_do_no_harm() {
    let whole = include_str!("../../../assets/presets/seas.txt");
    for end in (0..whole.len()).step_by(7).filter(|&i| whole.is_char_boundary(i)) {
        read(&whole[..end]);
    }
    let mut seed = 1_u32;
    let mut byte = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 24) as u8
    };
    for i in 0..400 {
        let mut bytes = whole.as_bytes().to_vec();
        if i % 2 == 0 {
            for b in &mut bytes {
                *b = byte();
            }
        } else {
            for _ in 0..200 {
                let at = usize::from(byte()) * usize::from(byte()) % bytes.len();
                bytes[at] = byte();
            }
        }
        let (presets, notices) = read(&String::from_utf8_lossy(&bytes));
        assert!(presets.len() <= MAX_PRESETS && notices.len() <= MAX_NOTICES + 1);
        for preset in &presets {
            assert_eq!(*preset, preset.clone().sanitised());
            let (params, notices) = preset.apply(&Params::default());
            assert!(notices.len() <= 26);
            for field in FIELDS.iter() {
                assert_eq!(field.check_value((field.get)(&params)), Ok((field.get)(&params)), "{}", field.key);
            }
        }
        assert_eq!(read(&write(&presets)).0, presets);
    }
}
