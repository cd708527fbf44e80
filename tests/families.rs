//! Theory against the waves on the lattices for every spectrum with every spreading, from calm to hurricane and from
//! deep water to 3 m, on the CPU. `tests/ensembles.rs` measures a covering subset on the GPU.

use seastate::lab::validate::choice_parameter_values;
use seastate::state::query;
use seastate::waves::Plan;
use seastate::waves::statistics::{LatticeStatistics, SpectrumStatistics};
use seastate::waves::table::SpectrumTable;

/// The thirteen sea states: wind (m/s), fetch (km), depth (m), from calm to hurricane and from deep water to 3 m.
const STATES: [(f64, f64, f64); 13] = [
    (1.5, 2.0, 4000.0),
    (3.0, 10.0, 4000.0),
    (5.0, 20.0, 100.0),
    (7.0, 50.0, 30.0),
    (10.0, 100.0, 4000.0),
    (10.0, 100.0, 20.0),
    (10.0, 100.0, 5.0),
    (10.0, 300.0, 3.0),
    (15.0, 300.0, 4000.0),
    (20.0, 500.0, 50.0),
    (25.0, 50.0, 10.0),
    (32.0, 1000.0, 4000.0),
    (45.0, 800.0, 200.0),
];

/// Whether opposite directions have the same variance density.
fn is_symmetric(spectrum: &str, spread: &str) -> bool {
    spectrum == "tessendorf" || ["isotropic", "cos2", "elfouhaily"].contains(&spread)
}

/// The failed checks of a state.
fn faults(state: &str, symmetric: bool) -> Vec<String> {
    let plan = Plan::new(&query::parse(state).0);
    let t = SpectrumStatistics::new(&plan);
    let r = LatticeStatistics::new(&plan, t.variance_m2);
    let captured = plan.resolved_variance_fraction();
    let mut faults = Vec::new();
    let mut check = |what: &str, holds: bool| {
        if !holds {
            faults.push(format!("{state}: {what}; captured {captured}\n  {t:?}\n  {r:?}\n  {:?}", plan.notices));
        }
    };
    check("resolved m0 within 1 % of the captured m0", (r.m0_fraction - captured).abs() < 0.01);
    check("nearly all variance is captured", captured > 0.99);
    check("mss within 2 %", (r.mss / t.mss - 1.0).abs() < 0.02);
    check(
        "Tm01 and Tm02 within 1 %",
        (r.tm01_s / t.tm01_s - 1.0).abs() < 0.01 && (r.tm02_s / t.tm02_s - 1.0).abs() < 0.01,
    );
    check("spread within 5 %", (r.spread_deg / t.spread_deg - 1.0).abs() < 0.05);
    if symmetric {
        check(
            "no direction",
            r.first_directional_moment < 0.01 && t.mean_from_deg.is_none() && r.mean_from_deg.is_none(),
        );
    } else {
        let from = plan.sea.first_system().from_deg;
        let off = |deg: Option<f64>| deg.map_or(f64::NAN, |d| ((d - from + 540.0) % 360.0 - 180.0).abs());
        check("theoretical direction is that of the wind", off(t.mean_from_deg) < 1e-6);
        check("resolved direction within 2 degrees", off(r.mean_from_deg) < 2.0);
    }
    faults
}

fn all_pairs(spectra: &[&str]) {
    let spreads = choice_parameter_values("spread");
    let mut wrong = Vec::new();
    for spectrum in spectra {
        for &spread in &spreads {
            for (wind, fetch, depth) in STATES {
                let state =
                    format!("v=2&spectrum={spectrum}&spread={spread}&wind={wind}&fetch={fetch}&depth={depth}&dir=205");
                wrong.extend(faults(&state, is_symmetric(spectrum, spread)));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {}:\n{}",
        wrong.len(),
        spectra.len() * spreads.len() * STATES.len(),
        wrong.join("\n")
    );
}

/// A list that lost a word would test less.
#[test]
fn all_spectra_are_covered() {
    assert_eq!(halves().concat(), choice_parameter_values("spectrum"));
    assert_eq!(
        (choice_parameter_values("spectrum").len(), choice_parameter_values("spread").len(), STATES.len()),
        (12, 7, 13)
    );
}

/// All spectra in two halves, so that two tests share the work.
fn halves() -> [Vec<&'static str>; 2] {
    let mut first = choice_parameter_values("spectrum");
    let second = first.split_off(first.len() / 2);
    [first, second]
}

#[test]
fn first_half_of_the_spectra_with_every_spreading() {
    all_pairs(&halves()[0]);
}

#[test]
fn second_half_of_the_spectra_with_every_spreading() {
    all_pairs(&halves()[1]);
}

/// At the default depth the depth limit changes no bit of what the GPU gets.
#[test]
fn the_depth_limit_changes_nothing_in_deep_water() {
    for state in ["", "wind=20&fetch=500&spectrum=karaev", "scale2=1&scale3=1&scale4=1&spectrum4=pm"] {
        let tables = |limit: &str| {
            let plan = Plan::new(&query::parse(&format!("{state}&n=64&depthlimit={limit}")).0);
            let tables = SpectrumTable::for_all_cascades(&plan);
            let bits = |v: &[f64; 4]| v.map(f64::to_bits);
            (plan.cascades, tables.iter().flat_map(|t| t.term_vectors.iter().map(bits)).collect::<Vec<_>>())
        };
        assert!(tables("tma") == tables("none"), "{state}");
    }
}

/// The variances of wave systems add, in theory and on the lattices: the square of the height of four systems is the sum
/// of the squares of their heights.
#[test]
fn squared_heights_of_four_systems_add() {
    const SYSTEMS: [&str; 4] = [
        "wind=11&fetch=120&dir=250",
        "scale2=1&hs2=1.8&tp2=13&dir2=310",
        "scale3=1&spectrum3=donelan&hs3=0&tp3=0&wind3=7&fetch3=60&dir3=190&fade3=0",
        "scale4=0.7&hs4=1.5&tp4=9&swell4=1",
    ];
    let heights = |state: &str| {
        let plan = Plan::new(&query::parse(&format!("n=512&{state}")).0);
        let theory = SpectrumStatistics::new(&plan);
        (plan.systems.len(), theory.hs_m, LatticeStatistics::new(&plan, theory.variance_m2).hs_m)
    };
    let alone = |i: usize| if i == 0 { SYSTEMS[0].to_owned() } else { format!("scale=0&{}", SYSTEMS[i]) };
    let squares: f64 = (0..4).map(|i| heights(&alone(i)).1.powi(2)).sum();
    let (count, theory_m, resolved_m) = heights(&SYSTEMS.join("&"));
    eprintln!("theory {theory_m} m, resolved {resolved_m} m, sum of squares {squares} m2");
    assert_eq!(count, 4);
    assert!((theory_m * theory_m / squares - 1.0).abs() < 1e-6, "{theory_m} m, squares {squares} m2");
    assert!((resolved_m * resolved_m / squares - 1.0).abs() < 0.01, "{resolved_m} m, squares {squares} m2");
}

/// The plan chooses cascades that hold the sea, for every wind, fetch and depth.
#[test]
fn every_sea_is_captured() {
    for wind in [0.5, 2.0, 5.0, 10.0, 20.0, 35.0, 60.0] {
        for fetch in [0.5, 5.0, 50.0, 500.0, 2000.0] {
            for spectrum in ["pm", "jonswap", "tma"] {
                for depth in [3.0, 20.0, 4000.0] {
                    let state = format!("wind={wind}&fetch={fetch}&spectrum={spectrum}&depth={depth}");
                    let captured = Plan::new(&query::parse(&state).0).resolved_variance_fraction();
                    assert!(captured > 0.99, "{state}: {captured}");
                }
            }
        }
    }
}
