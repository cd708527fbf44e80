//! Every parameter has an effect: another value changes a map or the picture.

mod common;

use common::{Pictures, params};
use seastate::shaders::Shaders;
use seastate::sim::Simulation;
use seastate::state::Params;
use seastate::state::fields::{FIELDS, Field, FieldKind};
use seastate::state::look::SkyFile;
use seastate::waves::Plan;
use std::collections::BTreeMap;

/// The state on which parameters are tested.
const BASE: &str = "wind=18&fetch=300&n=64&t=5&overcast=0.3&depth=12&sun=25";

/// Parameters that have no, or too small an effect in the base state: key, settings to add to the base (a later value of
/// a key wins), and the value to test, or "" for one from the middle of the range. The lines of the second wave system
/// also count for the third and fourth. Settings without which a parameter has no effect at all are not listed: the
/// program names them itself ([`Field::inactive_because`]).
const NEEDS: &[(&str, &str, &str)] = &[
    ("hs", "", "2.5"),
    ("tp", "", "7"),
    ("gamma", "", "1"),
    ("coefa", "", "0.4"),
    ("coefb", "", "0.3"),
    ("fade", "", "1"),
    ("blendto", "", "hasselmann"),
    ("scale2", "", "1"),
    ("hs2", "scale2=1", "2.5"),
    ("tp2", "scale2=1", "9"),
    ("wind2", "scale2=1&hs2=0&tp2=0", ""),
    ("fetch2", "scale2=1&hs2=0&tp2=0", ""),
    ("coefa2", "scale2=1&spectrum2=ab&hs2=0&tp2=0", "0.4"),
    ("coefb2", "scale2=1&spectrum2=ab&hs2=0&tp2=0", "0.3"),
    ("fade2", "scale2=1", "6"),
    ("blendto2", "scale2=1&blend2=0.5", ""),
    // In shallow water the default limit by depth makes jonswap the spectrum tma.
    ("spectrum", "depthlimit=none", ""),
    ("spectrum2", "scale2=1&depthlimit=none", ""),
    ("tension", "dispersion=capillary&cascades=1&patch1=2&wind=5&fetch=1", ""),
    ("density", "dispersion=capillary&cascades=1&patch1=2&wind=5&fetch=1", ""),
    ("foamthreshold", "", "0.95"),
    ("loop", "", "60"),
    ("patch1", "", "400"),
    ("patch2", "", "60"),
    ("patch3", "", "10"),
    ("patch4", "", "2"),
    ("low1", "", "0.08"),
    ("low2", "", "0.5"),
    ("low3", "", "3"),
    ("low4", "", "20"),
    ("high1", "", "0.15"),
    ("high2", "", "0.4"),
    ("high3", "", "3"),
    ("high4", "", "15"),
    ("sunsize", "overcast=0&sun=12&sunaz=40&pitch=12&fov=10&autoexposure=0&exposure=-8", "3"),
    ("sunfalloff", "overcast=0&sun=12&sunaz=40&pitch=12&fov=10&sunsize=5&autoexposure=0&exposure=-8", ""),
    ("daylight", "sunby=date&t=60", ""),
    ("squalls", "clouds=storm&overcast=0", ""),
    ("spray", "wind=26&fetch=500&depth=4000&y=4&pitch=1", "1"),
    ("fogstart", "fog=2", "500"),
    ("fogfalloff", "fog=2", "300"),
    ("fogheight", "fog=2", "200"),
    ("fogcolour", "fog=2", "d09050"),
    ("skyturn", "sky=made-up.hdr", ""),
    ("skygain", "sky=made-up.hdr", ""),
    ("viewcascade", "", "2"),
    // The sun low before the camera.
    ("glittercut", "sunaz=40&sun=8&overcast=0", ""),
    ("glitter", "sunaz=40&sun=20&overcast=0", ""),
    ("glitterfresnel", "sunaz=40&sun=20&overcast=0", ""),
    ("foamroughness", "sunaz=40&sun=20&overcast=0", ""),
    ("foamrelief", "y=3&pitch=-30&wind=26&overcast=0", ""),
    ("extent", "", "0.5"),
    ("camera", "", "buoy"),
    // The beach lies 580 m east of the origin.
    ("coast", "x=560&heading=60&y=12", "beach"),
    ("coastx", "x=560&heading=60&y=12&coast=beach", "400"),
    ("coastz", "x=560&heading=60&y=12&coast=bar", "300"),
    ("coastturn", "x=560&heading=60&y=12&coast=beach", "40"),
    ("caustics", "sun=60&overcast=0&depth=4&wind=6&pitch=-30", ""),
    ("bedcover", "sun=60&overcast=0&depth=4&wind=6&pitch=-30", ""),
    ("bedcolour", "sun=60&overcast=0&depth=4&wind=6&pitch=-30", ""),
];

/// Parameters without an effect on a single picture, and the reason.
const UNSEEN: &[(&str, &str)] = &[
    ("speed", "how fast the time runs: tests/app.rs lets it run"),
    ("normsteps", "one step is exact to the seventh digit: few_steps_are_felt in waves/spreading.rs"),
    ("pause", "whether it runs: tests/app.rs stops it"),
    ("ui", "the panel and captions alone: tests/app.rs hides it"),
    ("textsize", "the panel alone: tests/app.rs enlarges it"),
    ("units", "the panel alone: tests/app.rs changes them"),
    ("lang", "the panel alone: tests/languages.rs changes it"),
    ("renderscale", "a window's pixels: tests/app.rs counts them"),
    ("adaptive", "a window's pixels: tests/app.rs lets it follow the time"),
    ("detail", "the light of a running sea: tests/app.rs lets it run"),
    ("maxdpr", "a window's pixels: tests/app.rs counts them"),
];

/// Least mean difference of pictures, of 255, that counts: one step in one channel of a tenth of the pixels.
const LEAST_PICTURE: f64 = 0.03;
/// Least difference of the maps, relative to their rms.
const LEAST_MAPS: f64 = 1e-3;
const SIZE: [u32; 2] = [96, 54];

/// Settings to add to the base so that a parameter acts, and the value of the parameter to test. The third and fourth
/// wave systems need what the second needs, with their own number in the keys.
fn need(field: &Field) -> (String, &'static str) {
    let number = field.group.further_system_index().filter(|i| *i > 1).map(|i| i + 1);
    let key = number.map_or(field.key.to_owned(), |n| field.key.trim_end_matches(&n.to_string()).to_owned() + "2");
    let (_, settings, value) = need_of_key(&key).copied().unwrap_or_default();
    (number.map_or(settings.to_owned(), |n| settings.replace("2=", &format!("{n}="))), value)
}

fn need_of_key(key: &str) -> Option<&'static (&'static str, &'static str, &'static str)> {
    NEEDS.iter().find(|(needy, ..)| *needy == key)
}

/// The state on which a parameter is tested, and the tested value: the base with the settings of [`NEEDS`], and with
/// those that the program itself says would wake the parameter.
fn awake(field: &Field, sky: &SkyFile) -> (String, Params, &'static str) {
    let (more, value) = need(field);
    let mut state = later_wins(&format!("{BASE}&{more}"));
    loop {
        let mut base = params(&state);
        base.look.sky.adopt_loaded_image(Some(sky));
        match field.inactive_because(&base) {
            Some(why) if why.waking.is_empty() => panic!("{} sleeps in {state}: {}", field.key, why.reason),
            Some(why) => state = later_wins(&format!("{state}&{}", why.waking)),
            None => return (state, base, value),
        }
    }
}

/// A value from the middle of the range that differs from the base value.
fn other(field: &Field, base: f64) -> f64 {
    let candidates = match field.kind {
        FieldKind::Number { min, max, log: false } => vec![0.3 * min + 0.7 * max, 0.7 * min + 0.3 * max],
        FieldKind::Number { min, max, log: true } => vec![(min * max).sqrt(), (min * max * max).cbrt()],
        FieldKind::Heading => vec![(base + 140.0).rem_euclid(360.0)],
        FieldKind::Integer { min, max } => {
            vec![(f64::from(min) + f64::from(max)) / 2.0, f64::from(max), f64::from(min)]
        }
        FieldKind::Choice(words) => vec![(base + 1.0) % words.len() as f64],
        FieldKind::Flag => vec![1.0 - base],
        FieldKind::Colour => vec![f64::from(0x00ff_7010)],
    };
    let whole = |v: f64| if matches!(field.kind, FieldKind::Integer { .. }) { v.round() } else { v };
    let accepted = candidates.into_iter().filter_map(|v| field.check_value(whole(v)).ok());
    accepted.into_iter().find(|v| *v != base).unwrap_or_else(|| panic!("{} has one value only", field.key))
}

#[derive(Default)]
struct Lab {
    pictures: Pictures,
    sim: Option<Simulation>,
    /// Maps and pictures by state string.
    maps: BTreeMap<String, Vec<[f32; 4]>>,
    known: BTreeMap<String, Vec<[u8; 4]>>,
}

impl Lab {
    fn maps(&mut self, params: &Params) -> Vec<[f32; 4]> {
        let gpu = &self.pictures.gpu;
        let (plan, shaders) = (Plan::new(params), Shaders::default());
        let sim = self.sim.get_or_insert_with(|| Simulation::new(gpu, plan.clone(), &shaders));
        sim.set_plan(gpu, plan, &shaders);
        common::read(gpu, sim, params.clock.t_s).texels
    }

    /// Difference of the maps, relative to their rms; infinite for maps of different sizes.
    fn maps_change(&mut self, state: &str, a: &Params, b: &Params) -> f64 {
        let b = self.maps(b);
        if !self.maps.contains_key(state) {
            let maps = self.maps(a);
            self.maps.insert(state.to_owned(), maps);
        }
        let a = &self.maps[state];
        if a.len() != b.len() {
            return f64::INFINITY;
        }
        let pairs = || a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| (f64::from(*x), f64::from(*y)));
        let size: f64 = pairs().map(|(x, _)| x * x).sum();
        (pairs().map(|(x, y)| (x - y).powi(2)).sum::<f64>() / size).sqrt()
    }

    /// Mean difference of the pictures, of 255; `state` is the key of the first one.
    fn picture_change(&mut self, state: &str, a: &Params, b: &Params) -> f64 {
        if !self.known.contains_key(state) {
            let picture = self.pictures.render(a, SIZE);
            self.known.insert(state.to_owned(), picture);
        }
        let other = self.pictures.render(b, SIZE);
        let pairs = self.known[state].iter().flatten().zip(other.iter().flatten());
        pairs.map(|(x, y)| f64::from(x.abs_diff(*y))).sum::<f64>() / (3 * other.len()) as f64
    }
}

#[test]
fn every_parameter_changes_a_map_or_the_picture() {
    let mut lab = Lab::default();
    let mut unseen = Vec::new();
    let file = common::skies::made_up_sky(40.0);
    for field in FIELDS.iter().filter(|f| UNSEEN.iter().all(|(key, _)| *key != f.key)) {
        let (state, base, value) = awake(field, &file);
        let old = (field.get)(&base);
        let value = match value {
            "" => other(field, old),
            text => field.parse(text).unwrap_or_else(|_| panic!("{}={text}", field.key)),
        };
        assert_ne!(value, old, "{}", field.key);
        let mut changed = base.clone();
        (field.set)(&mut changed, value);
        let sea = (&changed.sea, &changed.grid) != (&base.sea, &base.grid);
        let maps = if sea { lab.maps_change(&state, &base, &changed) } else { 0.0 };
        if maps > LEAST_MAPS {
            continue;
        }
        let picture = lab.picture_change(&state, &base, &changed);
        if picture < LEAST_PICTURE {
            unseen.push(format!(
                "{} = {} instead of {}: maps {maps:.1e}, picture {picture:.3}",
                field.key,
                field.format(value),
                field.format(old)
            ));
        }
    }
    assert!(unseen.is_empty(), "\n{}", unseen.join("\n"));
}

/// States in which parameters sleep; together they cover each condition of src/state/inactive.rs.
const SLEEPY: &[&str] = &[
    "",
    "sky=made-up.hdr&clouds=cumulus&fog=1",
    "sunby=date&foam=0&blend=1&clouds=cirrus",
    "spectrum=pm&depth=4000",
    "spectrum=elfouhaily&depthlimit=none",
];

/// What the panel greys changes nothing: neither a map nor the picture.
#[test]
fn parameters_that_are_said_to_be_inactive_have_no_effect() {
    let mut lab = Lab::default();
    let mut seen = Vec::new();
    let file = common::skies::made_up_sky(40.0);
    for sleepy in SLEEPY {
        let state = later_wins(&format!("{BASE}&{sleepy}"));
        let mut base = params(&state);
        base.look.sky.adopt_loaded_image(Some(&file));
        // The third and fourth wave systems have the rules of the second.
        let is_like_second = |f: &Field| f.group.further_system_index().is_some_and(|i| i > 1);
        for field in FIELDS.iter().filter(|f| !is_like_second(f)) {
            if field.inactive_because(&base).is_none() {
                continue;
            }
            let mut changed = base.clone();
            (field.set)(&mut changed, other(field, (field.get)(&base)));
            let maps = if changed.sea == base.sea { 0.0 } else { lab.maps_change(&state, &base, &changed) };
            let is_of_waves = field.group.further_system_index().is_some();
            let picture = if is_of_waves { 0.0 } else { lab.picture_change(&state, &base, &changed) };
            if maps > 0.0 || picture > 0.0 {
                seen.push(format!("{} in \"{sleepy}\": maps {maps:.1e}, picture {picture:.3}", field.key));
            }
        }
    }
    assert!(seen.is_empty(), "\n{}", seen.join("\n"));
}

/// A state string with each key once, with its last value.
fn later_wins(state: &str) -> String {
    let pairs: Vec<(&str, &str)> = state.split('&').filter_map(|pair| pair.split_once('=')).collect();
    let last = |i: usize| pairs[i + 1..].iter().all(|(key, _)| *key != pairs[i].0);
    let kept = (0..pairs.len()).filter(|&i| last(i)).map(|i| format!("{}={}", pairs[i].0, pairs[i].1));
    kept.collect::<Vec<_>>().join("&")
}

#[test]
fn the_tables_name_parameters_that_exist() {
    for key in NEEDS.iter().map(|n| n.0).chain(UNSEEN.iter().map(|u| u.0)) {
        assert!(FIELDS.iter().any(|f| f.key == key), "{key}");
    }
}
