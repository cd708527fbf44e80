//! Tests of the files of wave models.

use super::super::{MeasuredSpectrum, SpectrumList};
use super::{Lcg, check, message, read};
use std::f64::consts::TAU;

pub(super) fn list(name: &str, text: &str) -> SpectrumList {
    MeasuredSpectrum::read_list(&[(name.into(), text.into())]).unwrap_or_else(|e| panic!("{e}"))
}

/// Bearing that the waves of a frequency come from, degrees, and their density S(f), m^2/Hz.
fn bearing_and_density(sea: &MeasuredSpectrum, f_hz: f64) -> (f64, f64) {
    let omega = TAU * f_hz;
    let [x, z] = sea.tabulated_distribution(omega).expect("directions").first_moment();
    ((-x).atan2(z).to_degrees().rem_euclid(360.0), TAU * sea.density(omega))
}

/// A 2D file of SWAN with two times and two places. The waves come from 270 degrees at the first place.
const SWAN_2D: &str = "\
SWAN   1                                Swan standard spectral file, version
$   Data produced by SWAN version 41.31
TIME                                    time-dependent data
     1                                  time coding option
LONLAT                                  locations in spherical coordinates
     2                                  number of locations
      4.0000     52.5000
      4.1000     52.6000
AFREQ                                   absolute frequencies in Hz
     3                                  number of frequencies
    0.0500
    0.1000
    0.2000
NDIR                                    spectral nautical directions in degr
     4                                  number of directions
   270.0
   180.0
    90.0
     0.0
QUANT
     1                                  number of quantities in table
VaDens                                  variance densities in m2/Hz/degr
m2/Hz/degr                              unit
   -0.9900E+02                          exception value
20240101.000000                         date and time
FACTOR
    0.1E-02
   10  0  0  0
  100  0  0  0
   50  0  -99  0
NODATA
20240101.030000
FACTOR
    0.2E-02
   10  0  0  0
  100  0  0  0
   50  0  0  0
ZERO
";

#[test]
fn swan_spectra_are_read() {
    let all = list("a.sp2", SWAN_2D);
    let labels: Vec<&str> = all.records.iter().map(|r| r.label.as_str()).collect();
    assert_eq!(labels[0].split(',').next_back(), Some(" 4.0000 52.5000"));
    assert_eq!((all.records.len(), all.default_index), (2, 1));
    assert_eq!(all.notices, ["a.sp2: 2 spectra without data or waves are left out"]);
    let (bearing, density) = bearing_and_density(&all.records[0].spectrum, 0.1);
    assert!((bearing - 270.0).abs() < 1e-6 && (density - 0.1 * 90.0).abs() < 1e-9, "{bearing} {density}");
    let (_, density) = bearing_and_density(&all.records[1].spectrum, 0.1);
    assert!((density - 0.2 * 90.0).abs() < 1e-9);
    // The spectrum with the most energy is used; others can be chosen.
    let (sea, notices) = read(&[("a.sp2", SWAN_2D)]).expect("a sea");
    assert_eq!(sea, all.records[1].spectrum);
    assert!(notices[0].starts_with("a.sp2: number 1 of 2 spectra is used (20240101.030000,"), "{notices:?}");
    assert_eq!(all.clone().choose(Some(0)).expect("a sea").spectrum, all.records[0].spectrum);
    assert_eq!(
        all.choose(Some(2)).map(|f| f.title),
        Err("a.sp2: it holds 2 spectra, numbered from 0: there is no number 2".into())
    );

    // Cartesian directions of travel: 0 is to the east, so from the west.
    let cartesian = SWAN_2D.replace("NDIR  ", "CDIR  ").replace("   270.0", "     0.0").replace("   180.0", "    90.0");
    let cartesian = cartesian.replacen("    90.0\n     0.0\nQUANT", "   180.0\n   270.0\nQUANT", 1);
    let sea = &list("b.sp2", &cartesian).records[0].spectrum;
    assert!((bearing_and_density(sea, 0.1).0 - 270.0).abs() < 1e-6, "{cartesian}");
    // Energy in joules.
    let joules = SWAN_2D.replace("VaDens  ", "EnDens  ").replace("m2/Hz/degr   ", "J/m2/Hz/degr ");
    let (_, density) = bearing_and_density(&list("c.sp2", &joules).records[0].spectrum, 0.1);
    assert!((density * 1025.0 * 9.81 / 9.0 - 1.0).abs() < 1e-3, "{density}");
    for r in &list("a.sp2", SWAN_2D).records {
        check(&r.spectrum);
    }
}

#[test]
fn swan_spectra_without_directions_are_read() {
    let head = SWAN_2D.split("NDIR").next().expect("a head").replace("TIME                                    time-dependent data\n     1                                  time coding option\n", "");
    let text = format!(
        "{head}QUANT\n 3\nVaDens\nm2/Hz\n -99\nCDIR\ndegr\n -999\nDSPRDEGR\ndegr\n -9\n\
         LOCATION 1\n 0.5 0. 20.\n 2. -90. 25.\n 0.25 -999. -9.\nNODATA\n"
    );
    let all = list("a.spc", &text);
    let sea = &all.records[0].spectrum;
    assert_eq!(sea.bands(), [(0.05, 0.5), (0.1, 2.0), (0.2, 0.25)]);
    let directions = sea.directions().expect("directions");
    assert_eq!(directions.iter().map(|d| d.alpha1_deg).collect::<Vec<_>>(), [270.0, 0.0, 0.0]);
    check(sea);
}

/// Two times and two points of WAVEWATCH III. The waves of the first point travel towards 90 degrees.
fn ww3_text() -> String {
    let block = |towards: usize, s: f64| -> String {
        (0..36)
            .map(|d| {
                (0..3)
                    .map(|f| format!(" {:.3E}", if d == towards { s * f64::from(f + 1) } else { 0.0 }))
                    .collect::<String>()
                    + "\n"
            })
            .collect()
    };
    let directions: String = (0..36)
        .map(|i| {
            format!(" {:.3E}{}", (f64::from((45 - i) % 36) * 10.0).to_radians(), if i % 7 == 6 { "\n" } else { "" })
        })
        .collect();
    format!(
        "'WAVEWATCH III SPECTRA'     3    36     2 'a grid                         '\n 0.412E-01 0.900E-01\n 0.300E+00\n{directions}\n\
         20130101 000000\n'46025     '  33.75-119.05  881.3   2.04 258.5   0.00 270.0\n{}'b\t         '  33 1 1 1 1 0 1\n{}\
         20130101 010000\n'46025     '  33.75-119.05  881.3   2.04 258.5   0.00 270.0\n{}'b         '  33 1 1 1 1 0 1\n{}",
        block(0, 1.0),
        block(9, 3.0),
        block(0, 2.0),
        block(35, 0.5)
    )
}

#[test]
fn wavewatch_spectra_are_read() {
    let text = ww3_text();
    let all = list("a.spec", &text);
    assert_eq!((all.records.len(), all.default_index), (4, 1));
    assert_eq!(all.records[0].label, "20130101 000000, 46025");
    // The first direction is 450 - 0 = 90 degrees, towards which the waves travel: they come from 270.
    let (bearing, density) = bearing_and_density(&all.records[0].spectrum, 0.09);
    assert!((bearing - 270.0).abs() < 0.5, "{bearing}");
    assert!((density - 2.0 * 10_f64.to_radians()).abs() < 1e-3 * density, "{density}");
    let (bearing, _) = bearing_and_density(&all.records[1].spectrum, 0.09);
    assert!((bearing - 180.0).abs() < 0.5, "{bearing}");
    for r in &all.records {
        check(&r.spectrum);
    }
}

#[test]
fn tables_of_directions_are_read() {
    let text = "# from, degrees\nf_hz,0,90,180,270\n0.1,0,0,0.5,0\n0.2,0,0,1,0\n0.3,0,0,.25,0\n";
    for text in [text.to_owned(), text.replace(',', ";"), text.replace(',', "\t")] {
        let sea = list("a.csv", &text).records.remove(0).spectrum;
        let (bearing, density) = bearing_and_density(&sea, 0.2);
        assert!((bearing - 180.0).abs() < 1e-6 && (density - 90.0).abs() < 1e-9, "{bearing} {density}");
    }
    assert_eq!(message("a.csv", "f,0,90,180,270\n.1,1,1,1\n"), "a.csv, line 2: 4 columns, but the first line has 5");
    assert_eq!(message("a.csv", "f,0,90,180,270\n.1,1,1,1,x\n"), "a.csv, line 2: \"x\" is not a number");
}

#[test]
fn broken_files_of_models_are_refused_in_one_sentence() {
    for (from, to, says) in [
        ("FACTOR\n    0.1E-02", "FACTOR\n    x", "the factor \"x\" is not a number"),
        ("FACTOR\n    0.2E-02", "FACTER\n", "is none of FACTOR, ZERO and NODATA"),
        ("  100  0  0  0\n   50", "  100  0  0\n   50", "\"NODATA\" in the densities is not a number"),
        ("  100  0  0  0\n   50", "  -3  0  0  0\n   50", "must be at least 0"),
        ("    0.1000\n", "    0.0400\n", "frequencies must ascend"),
        ("     2                                  number of loc", "  99999999 ", "the number of places, 1 to 20000"),
        (
            "     3                                  number of freq",
            "  99999999 ",
            "the number of frequencies, 1 to 256",
        ),
        ("     4                                  number of dir", "  99999999 ", "the number of directions, 1 to 1440"),
        ("VaDens ", "Depth  ", "\"Depth\" is neither VaDens nor EnDens"),
        ("AFREQ", "NFREQ", "\"NFREQ\" is no line of a SWAN header"),
    ] {
        let reason = message("a.sp2", &SWAN_2D.replacen(from, to, 1));
        assert!(reason.starts_with("a.sp2, line ") && reason.contains(says) && reason.lines().count() == 1, "{reason}");
    }
    let ww3 = ww3_text();
    for (from, to, says) in [
        (" 3    36     2 ", " 3    36 ", "are missing"),
        (" 3    36     2 ", " 3 99999 2 ", "99999 directions, but 1 to 1440"),
        (" 3    36     2 ", " 3 0 2 ", "0 directions, but 1 to 1440"),
        ("20130101 000000", "on monday", "\"on monday\" is no date"),
        ("'46025", "46025", "no name of a point"),
        ("0.412E-01", "0.412E-0x", "\"0.412E-0x\" in the frequencies is not a number"),
    ] {
        let reason = message("a.spec", &ww3.replacen(from, to, 1));
        assert!(reason.starts_with("a.spec, line ") && reason.contains(says), "{reason}");
    }
    // Files that end early, and files with wrong letters.
    let mut random = Lcg(41);
    for text in [SWAN_2D, &ww3] {
        for _ in 0..400 {
            let end = random.below(text.len());
            if let Err(reason) = read(&[("a", &text[..end])]) {
                assert!(reason.starts_with('a') && reason.lines().count() == 1, "{reason}");
            }
        }
        for _ in 0..1500 {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..1 + random.below(3) {
                let at = random.below(bytes.len());
                bytes[at] = b"0123456789-.eE \n\t'"[random.below(18)];
            }
            if let Ok(all) = MeasuredSpectrum::read_list(&[("a".into(), bytes)]) {
                all.records.iter().for_each(|r| check(&r.spectrum));
            }
        }
    }
}
