//! Simulated seas against theory over 64 seeds: a subset that covers every spectrum, every spreading and every
//! dispersion relation, from calm to hurricane and from deep water to 3 m.

mod common;

use common::{gpu, params};
use seastate::lab::estimate::EstimateWithError;
use seastate::lab::stats;
use seastate::lab::validate::choice_parameter_values;

const SEEDS: u32 = 64;

/// Spectrum, spreading, wind (m/s), fetch (km), depth (m), and what else there is.
type State = (&'static str, &'static str, f64, f64, f64, &'static str);
const SEAS: [State; 19] = [
    ("phillips", "hasselmann", 10.0, 100.0, 4000.0, ""),
    ("tessendorf", "donelan-banner", 15.0, 300.0, 4000.0, ""),
    ("ab", "cos2", 7.0, 50.0, 30.0, "&coefb=1.5"),
    ("pm", "cos2-positive", 20.0, 500.0, 50.0, "&dispersion=deep"),
    ("jonswap", "donelan-banner", 1.5, 2.0, 4000.0, "&dispersion=capillary"),
    ("tma", "mitsuyasu", 10.0, 300.0, 3.0, "&tmafit=branches"),
    ("tma", "hasselmann", 10.0, 100.0, 5.0, "&bouws=1"),
    ("marnero", "elfouhaily", 5.0, 20.0, 100.0, "&hs=0.8&tp=5"),
    ("karaev", "isotropic", 10.0, 100.0, 20.0, "&karaevtma=1"),
    ("elfouhaily", "elfouhaily", 3.0, 10.0, 4000.0, "&dispersion=capillary&swell=0.4"),
    ("donelan", "hasselmann", 25.0, 50.0, 10.0, "&blend=0.5&blendto=cos2-positive&iso=0.1"),
    ("ochi-hubble", "mitsuyasu", 32.0, 1000.0, 4000.0, "&fade=2"),
    ("torsethaugen", "donelan-banner", 45.0, 800.0, 200.0, "&swell=0.8"),
    ("jonswap", "hasselmann", 12.0, 250.0, 4000.0, "&scale2=1&hs2=2&tp2=13&dir2=330&spread2=mitsuyasu"),
    ("jonswap", "donelan-banner", 12.0, 250.0, 4000.0, "&overlap=1"),
    ("pm", "hasselmann", 12.0, 250.0, 4000.0, "&cascades=3&patch1=700&patch2=97&patch3=11.3&high1=1.1&low2=0.6"),
    (
        "jonswap",
        "donelan-banner",
        11.0,
        120.0,
        4000.0,
        "&scale2=1&dir2=310&scale3=1&hs3=1.2&tp3=10&dir3=150&scale4=1&spectrum4=pm&spread4=elfouhaily",
    ),
    // The depth limit at kp h of 1 and 1.2.
    ("jonswap", "hasselmann", 10.0, 100.0, 8.0, "&v=2"),
    ("pm", "donelan-banner", 12.0, 250.0, 20.0, "&v=2&scale2=1&dir2=230"),
];

/// The table above, and a usual sea for every spectrum that it does not have.
fn seas() -> Vec<State> {
    let others = choice_parameter_values("spectrum").into_iter().filter(|w| SEAS.iter().all(|s| s.0 != *w));
    SEAS.into_iter().chain(others.map(|w| (w, "donelan-banner", 10.0, 100.0, 4000.0, ""))).collect()
}

#[test]
fn the_subset_covers_everything() {
    assert!(choice_parameter_values("spectrum").iter().all(|w| seas().iter().any(|s| s.0 == *w)));
    assert!(choice_parameter_values("spread").iter().all(|w| SEAS.iter().any(|s| s.1 == *w && s.0 != "tessendorf")));
    assert!(
        choice_parameter_values("dispersion").iter().all(|w| *w == "finite" || SEAS.iter().any(|s| s.5.contains(w)))
    );
}

fn assert_sea((spectrum, spread, wind, fetch, depth, more): State) {
    let state =
        format!("n=128&spectrum={spectrum}&spread={spread}&wind={wind}&fetch={fetch}&depth={depth}&dir=205{more}");
    let report = pollster::block_on(stats::run(&gpu(), &params(&state), SEEDS, None)).expect("statistics");
    let (r, m) = (&report.resolved, &report.measured);
    eprintln!("{state}\n{report}");
    let within = |what: &str, measured: &EstimateWithError, resolved: f64| {
        let error = measured.standard_error.expect("64 seeds have a standard error");
        let off = (measured.value - resolved).abs();
        // With few waves the standard error may be smaller than the rounding error of f32.
        assert!(off < 5.0 * error + 1e-6 * resolved.abs(), "{what}: off by {off}, error {error}\n{state}\n{report}");
    };
    assert!((m.hs_m.value / r.hs_m - 1.0).abs() < 0.03, "{state}\n{report}");
    assert!(m.parseval_error < 1e-4, "{state}\n{report}");
    within("Hs", &m.hs_m, r.hs_m);
    within("mss", &m.mss, r.mss);
    within("Tm01", &m.tm01_s, r.tm01_s);
    within("Tm02", &m.tm02_s, r.tm02_s);
    within("mean", &m.mean_elevation_m, 0.0);
    match (r.mean_from_deg, &m.mean_from_deg) {
        (Some(from), Some(measured)) => {
            let error = measured.standard_error.expect("64 seeds have a standard error");
            let off = ((measured.value - from + 540.0).rem_euclid(360.0) - 180.0).abs();
            assert!(off < 5.0 * error && off < 2.0, "from {from}, measured {measured:?}\n{state}\n{report}");
            within("r1", &m.r1, r.first_directional_moment);
            within("spread", &m.spread_deg, r.spread_deg);
        }
        // Maps at two times separate opposite directions, here with equal variances.
        (None, _) => assert!(m.r1.value < 0.01 + 5.0 * m.r1.standard_error.unwrap_or(0.0), "{state}\n{report}"),
        (from, measured) => panic!("from {from:?}, measured {measured:?}\n{state}\n{report}"),
    }
}

#[test]
fn first_half() {
    SEAS[..8].iter().for_each(|sea| assert_sea(*sea));
}

#[test]
fn second_half() {
    seas()[8..].iter().for_each(|sea| assert_sea(*sea));
}
