//! Tests of measured spectra as text in links.

use super::super::{DirectionalParameters, MAX_BANDS, MAX_TEXT_BYTES, MIN_BANDS, MeasuredSpectrum};
use super::samples::TWO_SYSTEMS;
use super::{Lcg, check, read, sea};

#[test]
fn states_come_back_bit_for_bit() {
    let mut random = Lcg(3);
    for i in 0..300 {
        let n = MIN_BANDS + random.below(MAX_BANDS - MIN_BANDS + 1);
        let bands: Vec<(f64, f64)> = (1..=n)
            .map(|i| (2.0 * i as f64 / n as f64, 10f64.powf(16.0 * random.unit() - 11.1).min(99_994.0)))
            .collect();
        let directions: Vec<DirectionalParameters> = (0..n)
            .map(|_| DirectionalParameters {
                alpha1_deg: 2000.0 * random.unit() - 1000.0,
                alpha2_deg: 360.0 * random.unit() - 0.02,
                r1: 1.2 * random.unit() - 0.1,
                r2: random.unit(),
            })
            .collect();
        let sea = MeasuredSpectrum::new(&bands, (i % 2 == 0).then_some(directions.as_slice())).expect("a sea");
        check(&sea);
        let bits = |sea: &MeasuredSpectrum| -> Vec<u64> {
            let all = sea.directions().unwrap_or_default();
            let parts = all.iter().flat_map(|d| [d.alpha1_deg, d.alpha2_deg, d.r1, d.r2]);
            sea.bands().iter().flat_map(|b| [b.0, b.1]).chain(parts).map(f64::to_bits).collect()
        };
        assert_eq!(bits(&MeasuredSpectrum::from_state(&sea.to_state()).expect("a sea")), bits(&sea));
    }
    let short = sea(&[("b", "0.05,0.50\n0.1,12.3456\n0.2,0.0000123\n0.3,0\n")]);
    assert_eq!(short.to_state(), ".05*.5_.1*12.35_.2*1.23e-5_.3*0");
    assert_eq!(MeasuredSpectrum::from_state(".05*.5_.1*12.35_.2*1.23e-5_.3*0"), Ok(short));
}

#[test]
fn a_buoys_sea_fits_in_a_link() {
    let (sea, _) = read(&[("two-systems.txt", TWO_SYSTEMS)]).expect("a sample");
    assert!(sea.to_state().len() < 1400, "{}", sea.to_state().len());
    // The longest spectrum: all its numbers have all their digits.
    let worst = DirectionalParameters { alpha1_deg: 123.4, alpha2_deg: 234.5, r1: 0.123, r2: 0.456 };
    let densities = [0.1234, 1.234, 12.34].into_iter().cycle();
    let bands: Vec<_> = sea.bands().iter().map(|b| b.0).zip(densities).collect();
    let sea = MeasuredSpectrum::new(&bands, Some(&[worst; 47])).expect("a sea");
    assert!(sea.to_state().len() < 1650, "{}", sea.to_state().len());
}

#[test]
fn hostile_states_are_refused() {
    let bands = |n: u32| (1..=n).map(|i| format!("{}*1", f64::from(i) / 1000.0)).collect::<Vec<_>>().join("_");
    let long = "1".repeat(MAX_TEXT_BYTES + 1);
    for (text, want) in [
        ("", "band 1 of the measured spectrum: \"\" is not a number"),
        ("_", "band 1 of the measured spectrum: \"\" is not a number"),
        (".1*1_.2*1", "the measured spectrum: 2 frequency bands, but 3 to 256 are needed"),
        (".1*1_.2*NaN_.3*1", "band 2 of the measured spectrum: \"NaN\" is not a number"),
        (".1*1_.2*1e999_.3*1", "band 2 of the measured spectrum: \"1e999\" is not a number"),
        (".1*1_.2*1*3_.3*1", "band 2 of the measured spectrum: it has neither 2 nor 6 numbers"),
        (".1*1_.2*1*3*4*5*6*7_.3*1", "band 2 of the measured spectrum: it has neither 2 nor 6 numbers"),
        (".1*1*1*1*0*0_.2*1_.3*1", "band 2 of the measured spectrum: some bands have directions and some have none"),
        (".1*1_.2*1*1*1*0*0_.3*1", "band 2 of the measured spectrum: some bands have directions and some have none"),
        (".1*1*361*1*0*0_", "band 1 of the measured spectrum: a direction is not within 0 to 360 degrees"),
        (".1*1*1*1*2*0_", "band 1 of the measured spectrum: r1 or r2 is not within 0 to 1"),
        (".2*1_.1*1_.3*1", "the measured spectrum: the frequency 0.1 Hz follows 0.2 Hz: frequencies must ascend"),
        (".1*0_.2*0_.3*0", "the measured spectrum: the variance density is zero in every band: there are no waves"),
        (&bands(257), "the measured spectrum: 257 frequency bands, but 3 to 256 are needed"),
        (&bands(1500), "the measured spectrum: 257 frequency bands, but 3 to 256 are needed"),
        (&long, "the measured spectrum is longer than 16384 bytes"),
    ] {
        assert_eq!(MeasuredSpectrum::from_state(text).expect_err(text), want, "{text:.60}");
    }
    let mut random = Lcg(5);
    let state = read(&[("two-systems.txt", TWO_SYSTEMS)]).expect("a sample").0.to_state();
    for _ in 0..3000 {
        let mut bytes = state.clone().into_bytes();
        for _ in 0..1 + random.below(3) {
            let at = random.below(bytes.len());
            bytes[at] = b"0123456789*_-.e\xe9x"[random.below(17)];
        }
        if let Ok(sea) = MeasuredSpectrum::from_state(&String::from_utf8_lossy(&bytes)) {
            check(&sea);
        }
    }
}
