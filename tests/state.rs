//! The state string: reading never fails, and a state that was read is written and read back unchanged.

use seastate::files::measured::{DirectionalParameters, MAX_BANDS, MeasuredSpectrum};
use seastate::state::fields::{FIELDS, Field, FieldKind};
use seastate::state::floats::{FloatingObject, FloatingObjectKind, MAX_FLOATING_OBJECTS};
use seastate::state::look::SkyFile;
use seastate::state::{Params, query};
use seastate::waves::table::SpectrumTable;
use seastate::waves::{Plan, noise};

/// Deterministic random numbers from the hash of the crate.
struct Dice(u32);

impl Dice {
    fn next(&mut self) -> u32 {
        self.0 += 1;
        noise::pcg4d([self.0, 1, 2, 3])[0]
    }

    fn below(&mut self, end: usize) -> usize {
        self.next() as usize % end
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }
}

const HOSTILE: &[&str] = &[
    "NaN",
    "-NaN",
    "inf",
    "-inf",
    "infinity",
    "1e999",
    "-1e999",
    "1e-400",
    "-0",
    "0x10",
    "1_000",
    "１２",
    "9",
    "99999999999999999999999999",
    "4294967295",
    "4294967296",
    "-1",
    "",
    " ",
    "%",
    "%2",
    "%zz",
    "%00",
    "\0",
    "\u{feff}",
    "🌊",
    "ä",
    "a=b",
    "&&",
    "=",
    "?",
    "#",
    "://",
    "+",
    "%2B",
    "%26",
    "true",
    "false",
    "<script>",
    "'; drop",
    "\n",
    "\r\n\t",
];

fn value(dice: &mut Dice) -> String {
    match dice.below(6) {
        0 => dice.pick(HOSTILE).to_owned(),
        1 => format!("{}", f64::from_bits(u64::from(dice.next()) << 32 | u64::from(dice.next()))),
        2 => format!("{}", (f64::from(dice.next()) / 4e7) - 20.0),
        3 => format!("{}", dice.next()),
        4 => {
            let words: Vec<&str> = FIELDS
                .iter()
                .filter_map(|f| if let FieldKind::Choice(words) = f.kind { Some(words) } else { None })
                .flatten()
                .copied()
                .collect();
            dice.pick(&words).to_owned()
        }
        _ => (0..dice.below(20)).map(|_| char::from_u32(dice.next() % 0x500).unwrap_or('?')).collect(),
    }
}

fn string(dice: &mut Dice) -> String {
    let mut out = dice.pick(&["", "?", "https://example.org/?", "#", "x://", "??"]).to_owned();
    for _ in 0..dice.below(8) {
        let key = if dice.below(8) == 0 { value(dice) } else { FIELDS[dice.below(FIELDS.len())].key.to_owned() };
        out += &key;
        out += dice.pick(&["=", "", "==", "%3D"]);
        out += &value(dice);
        out += dice.pick(&["&", "&", "&", "&&", ";", ""]);
    }
    out
}

#[test]
fn a_hundred_thousand_hostile_strings() {
    let mut dice = Dice(0);
    for i in 0..100_000 {
        let text = string(&mut dice);
        let (params, notices) = query::parse(&text);
        assert!(notices.len() <= 25, "{text:?}");
        let written = query::write(&params);
        let (again, complaints) = query::parse(&written);
        assert_eq!(again, params, "{text:?} -> {written}");
        assert_eq!(complaints, Vec::<String>::new(), "{text:?} -> {written}");
        assert_eq!(query::write(&again), written);
        for field in FIELDS.iter() {
            let v = (field.get)(&params);
            assert_eq!(field.check_value(v), Ok(v), "{} = {v} from {text:?}", field.key);
        }
        // Every sea has a plan, even a strange one.
        if i % 50 == 0 {
            let plan = Plan::new(&params);
            assert!((1..=4).contains(&plan.cascades.len()), "{written}");
            assert!(
                plan.hs_m().is_finite() && plan.resolved_variance_fraction().is_finite() && plan.k_max().is_finite(),
                "{written}"
            );
        }
    }
}

#[test]
fn very_long_strings_are_cut() {
    let long = format!("wind=14&{}", "fetch=3&".repeat(1_000_000));
    let (params, notices) = query::parse(&long);
    assert_eq!(params.sea.first_system().wind_m_s, 14.0);
    assert!(notices.iter().any(|n| n.contains("longer")));
    let (_, notices) = query::parse(&"ä".repeat(1_000_000));
    assert!(!notices.is_empty());
}

#[test]
fn corners_of_every_range_give_a_finite_plan() {
    for field in FIELDS.iter() {
        let corners = match field.kind {
            FieldKind::Number { min, max, .. } => vec![min, max],
            FieldKind::Heading => vec![0.0, 359.99],
            FieldKind::Integer { min, max } => vec![f64::from(min), f64::from(max)],
            FieldKind::Choice(words) => (0..words.len()).map(|i| i as f64).collect(),
            FieldKind::Flag => vec![0.0, 1.0],
            FieldKind::Colour => vec![0.0, f64::from(0x00ff_ffff)],
        };
        for corner in corners {
            let mut params = Params::default();
            (field.set)(&mut params, corner);
            assert_eq!((field.get)(&params), corner, "{}", field.key);
            let plan = Plan::new(&params);
            for cascade in &plan.cascades {
                assert!(
                    cascade.patch_m > 0.0 && cascade.k_low <= cascade.k_high,
                    "{} = {corner}: {cascade:?}",
                    field.key
                );
                let table = SpectrumTable::new(&plan, cascade);
                let finite = table.term_vectors.iter().flatten().all(|v| v.is_finite() && (*v as f32).is_finite());
                assert!(
                    finite && table.waves.iter().all(|w| w.orbit_width_over_height.is_finite()),
                    "{} = {corner}",
                    field.key
                );
            }
        }
    }
}

/// Values of a field: the ends of its range, small values, and random values with all digits.
fn values(field: &Field, dice: &mut Dice) -> Vec<f64> {
    let unit = |dice: &mut Dice| f64::from(dice.next()) / f64::from(u32::MAX);
    let mut some = |make: &dyn Fn(f64) -> f64| (0..20).map(|_| make(unit(dice))).collect::<Vec<_>>();
    match field.kind {
        FieldKind::Number { min, max, .. } => {
            let tiny = if min <= 0.0 { [0.0, 1e-300, f64::MIN_POSITIVE, 1e-7] } else { [min; 4] };
            [vec![min, max], tiny.to_vec(), some(&|u| min + (max - min) * u), some(&|u| min + (max - min) * u.powi(30))]
                .concat()
        }
        FieldKind::Heading => [vec![0.0, 359.999_999_999], some(&|u| 359.9 * u)].concat(),
        FieldKind::Integer { min, max } => {
            let (low, high) = (f64::from(min), f64::from(max));
            [vec![low, high], some(&|u| (low + (high - low) * u).round())].concat()
        }
        FieldKind::Choice(words) => (0..words.len()).map(|i| i as f64).collect(),
        FieldKind::Flag => vec![0.0, 1.0],
        FieldKind::Colour => {
            [vec![0.0, f64::from(0x00ff_ffff)], some(&|u| (u * f64::from(0x00ff_ffff)).round())].concat()
        }
    }
}

#[test]
fn every_value_of_every_field_comes_back() {
    let mut dice = Dice(7);
    for field in FIELDS.iter() {
        for value in values(field, &mut dice) {
            assert_eq!(field.check_value(value), Ok(value), "{}", field.key);
            let mut params = Params::default();
            (field.set)(&mut params, value);
            assert_eq!((field.get)(&params), value, "{}", field.key);
            let state = query::write(&params);
            assert_eq!(query::parse(&state), (params, vec![]), "{state}");
            assert!(state.len() < 60, "{state}");
        }
    }
}

#[test]
fn what_is_out_of_range_becomes_the_nearest_value_and_a_notice() {
    for field in FIELDS.iter() {
        let (low, high) = match field.kind {
            FieldKind::Number { min, max, .. } => (min, max),
            FieldKind::Integer { min, max } => (f64::from(min), f64::from(max)),
            FieldKind::Heading | FieldKind::Choice(_) | FieldKind::Flag | FieldKind::Colour => continue,
        };
        for (text, want) in
            [("-1e300".to_owned(), low), ("1e300".to_owned(), high), (format!("{}", high * 1.001 + 1.0), high)]
        {
            let (params, notices) = query::parse(&format!("{}={text}", field.key));
            assert_eq!(((field.get)(&params), notices.len()), (want, 1), "{}={text}: {notices:?}", field.key);
        }
        for text in ["NaN", "inf", "-inf", "", "one", "0x1", "1,5"] {
            let (params, notices) = query::parse(&format!("{}={text}", field.key));
            assert_eq!((params, notices.len()), (Params::default(), 1), "{}={text}", field.key);
        }
    }
}

/// Writes the longest state: all fields with all digits, a buoy with the most bands, the most floats, a long sky name.
#[test]
fn no_state_is_too_long_to_be_read() {
    let mut params = Params::default();
    for field in FIELDS.iter() {
        // The value with the longest text.
        let values = values(field, &mut Dice(3));
        let longest = values.into_iter().max_by_key(|v| field.format(*v).len()).expect("a value");
        (field.set)(&mut params, longest);
    }
    let bands: Vec<_> = (0..MAX_BANDS).map(|i| (1.001e-3 * (i + 100) as f64, 1.234e-7 + 1e-10 * i as f64)).collect();
    let direction = DirectionalParameters { alpha1_deg: 234.5, alpha2_deg: 123.4, r1: 0.123, r2: 0.234 };
    let buoy = MeasuredSpectrum::new(&bands, Some(&vec![direction; MAX_BANDS])).expect("a sea");
    params.sea.measured = Some(std::sync::Arc::new(buoy));
    let far = FloatingObject {
        kind: FloatingObjectKind::Buoy,
        x_m: -123_456.789_012_345_67,
        z_m: -1.234_567_890_123_456_7e-101,
    };
    params.floating_objects = vec![far; MAX_FLOATING_OBJECTS];
    params.look.sky.file = SkyFile::from_path(&"🌊".repeat(200));
    let state = query::write(&params);
    assert!((10_000..=seastate::files::MAX_STATE_BYTES).contains(&state.len()), "{}", state.len());
    assert_eq!(query::parse(&state), (params, vec![]));
}

#[test]
fn a_sky_name_without_printable_characters_is_noticed() {
    let (params, notices) = query::parse("sky=%00&wind=14");
    assert_eq!(params.look.sky.file, None);
    assert!(notices.len() == 1 && notices[0].starts_with("sky: "), "{notices:?}");
}

#[test]
fn a_repeated_special_key_is_noticed() {
    for (pair, key) in [("sky=a.hdr", "sky"), ("afloat=buoy*12*-30", "afloat")] {
        let (_, notices) = query::parse(&format!("{pair}&{pair}"));
        assert_eq!(notices, [format!("{key} appears more than once: the last one counts")]);
    }
    // The text of a buoy's spectrum is not valid here, but the repetition is noticed all the same.
    let (_, notices) = query::parse("measured=1&measured=1");
    assert!(notices.iter().any(|n| n.starts_with("measured appears more than once")), "{notices:?}");
}

#[test]
fn keys_are_unique_and_documented() {
    for (i, field) in FIELDS.iter().enumerate() {
        assert!(FIELDS[..i].iter().all(|f| f.key != field.key), "{} twice", field.key);
        assert!(field.key.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit()), "{}", field.key);
        assert!(field.help.ends_with('.') && field.help.len() > 10, "{}", field.key);
        assert_eq!(field.check_value(field.default_value()), Ok(field.default_value()), "{}", field.key);
    }
    for key in [
        "spectrum", "wind", "fetch", "dir", "depth", "gamma", "spread", "swell", "chop", "height", "g", "seed", "n",
        "cascades", "t", "loop",
    ] {
        assert!(FIELDS.iter().any(|f| f.key == key), "the fixed key {key} is missing");
    }
}
