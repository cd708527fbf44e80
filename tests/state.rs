//! The state string: whatever it is given, reading never fails, and writing what was read is stable.

use seastate::model::fields::{FIELDS, Kind};
use seastate::model::table::Table;
use seastate::model::{Params, Plan, noise, query};

/// A small deterministic generator on the crate's own hash.
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
                .filter_map(|f| if let Kind::Choice(words) = f.kind { Some(words) } else { None })
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
            assert_eq!(field.accept(v), Ok(v), "{} = {v} from {text:?}", field.key);
        }
        // The plan is total: some of these seas are strange.
        if i % 50 == 0 {
            let plan = Plan::new(&params);
            assert!((1..=4).contains(&plan.cascades.len()), "{written}");
            assert!(plan.hs_m().is_finite() && plan.captured().is_finite() && plan.k_max().is_finite(), "{written}");
        }
    }
}

#[test]
fn very_long_strings_are_cut() {
    let long = format!("wind=14&{}", "fetch=3&".repeat(1_000_000));
    let (params, notices) = query::parse(&long);
    assert_eq!(params.sea.local().wind_m_s, 14.0);
    assert!(notices.iter().any(|n| n.contains("longer")));
    let (_, notices) = query::parse(&"ä".repeat(1_000_000));
    assert!(!notices.is_empty());
}

#[test]
fn corners_of_every_range_give_a_finite_plan() {
    for field in FIELDS.iter() {
        let corners = match field.kind {
            Kind::Number { min, max, .. } => vec![min, max],
            Kind::Heading => vec![0.0, 359.99],
            Kind::Integer { min, max } => vec![f64::from(min), f64::from(max)],
            Kind::Choice(words) => (0..words.len()).map(|i| i as f64).collect(),
            Kind::Flag => vec![0.0, 1.0],
            Kind::Colour => vec![0.0, f64::from(0x00ff_ffff)],
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
                let table = Table::new(&plan, cascade);
                let finite = table.values.iter().flatten().all(|v| v.is_finite() && (*v as f32).is_finite());
                assert!(finite && table.waves.iter().all(|w| w.orbit.is_finite()), "{} = {corner}", field.key);
            }
        }
    }
}

#[test]
fn keys_are_unique_and_documented() {
    for (i, field) in FIELDS.iter().enumerate() {
        assert!(FIELDS[..i].iter().all(|f| f.key != field.key), "{} twice", field.key);
        assert!(field.key.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit()), "{}", field.key);
        assert!(field.help.ends_with('.') && field.help.len() > 10, "{}", field.key);
        assert_eq!(field.accept(field.default_value()), Ok(field.default_value()), "{}", field.key);
    }
    for key in [
        "spectrum", "wind", "fetch", "dir", "depth", "gamma", "spread", "swell", "chop", "height", "g", "seed", "n",
        "cascades", "t", "loop",
    ] {
        assert!(FIELDS.iter().any(|f| f.key == key), "the fixed key {key} is missing");
    }
}
