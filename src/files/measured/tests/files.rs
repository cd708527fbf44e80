//! Tests of files that are read as measured spectra.

use super::super::{DefaultSpectrum, DirectionalParameters, MeasuredSpectrum};
use super::{BANDS, SPEC, message, read, realtime_set, sea, title};

#[test]
fn realtime_files_make_one_sea() {
    let mut files = realtime_set();
    let whole = sea(&files);
    assert_eq!(whole.bands(), [(0.05, 0.5), (0.1, 2.0), (0.2, 0.3)]);
    let last = DirectionalParameters { alpha1_deg: 99.0, alpha2_deg: 100.0, r1: 0.7, r2: 0.3 };
    assert_eq!(whole.directions().map(|d| d[2]), Some(last), "99 degrees are a direction");
    assert_eq!(title(&files), "44025.data_spec, 2026-11-21 06:00 UTC");

    // The files in reverse order, joined in one file, with a path and Windows line ends, and r2 under the header of r1.
    files.reverse();
    assert_eq!(sea(&files), whole);
    files.reverse();
    let joined: String = files.iter().map(|f| f.1.as_str()).collect();
    assert_eq!(sea(&[("all.txt", &joined)]), whole);
    assert_eq!(sea(&[("C:\\buoys\\all.txt", &format!("\u{feff}{}", joined.replace('\n', "\r\n")))]), whole);
    files[4].1 = files[4].1.replace("r2_1", "r1_1");
    assert_eq!(sea(&files), whole);
}

#[test]
fn incomplete_directions_are_left_out_with_a_notice() {
    let files = realtime_set();
    let plain = sea(&[("44025.data_spec", &files[0].1)]);
    assert!(plain.directions().is_none());
    // The notice where a directional file is missing, has another time, or has values in too few bands.
    let (got, notices) = read(&files[..4]).expect("a sea");
    assert_eq!(got, plain);
    assert_eq!(notices, ["there is no r2 of 2026-11-21 06:00 UTC: the spectrum is used without directions"]);
    let mut other = realtime_set();
    other[3].1 = other[3].1.replace(" 06 00 ", " 05 00 ");
    let (got, notices) = read(&other).expect("a sea");
    assert_eq!(got, plain);
    assert_eq!(notices, ["there is no r1 of 2026-11-21 06:00 UTC: the spectrum is used without directions"]);
    let mut few = realtime_set();
    few[1].1 = few[1].1.replace("240.0", "999.0").replace("250.0", "MM");
    few[2].1 = few[2].1.replace("100.0", "999.0");
    let (got, notices) = read(&few).expect("a sea");
    assert_eq!(got, plain);
    assert_eq!(notices, ["only 0 of 3 bands have a direction: the spectrum is used without directions"]);
    // One band of three is enough: its direction fills all bands.
    few[2].1 = realtime_set()[2].1.clone();
    let got = sea(&few);
    let last = DirectionalParameters { alpha1_deg: 99.0, alpha2_deg: 100.0, r1: 0.7, r2: 0.3 };
    assert_eq!(got.directions(), Some([last; 3].as_slice()));
}

#[test]
fn the_newest_complete_record_counts() {
    let rows = |a: &str, b: &str| format!("{SPEC}2026 11 21 06 00 0.2 {a}\n2026 11 21 07 30 0.2 {b}\n");
    let (one, two) = ("1 (0.05) 2 (0.1) 3 (0.2)", "4 (0.05) 5 (0.1) 6 (0.2)");
    let (got, notices) = read(&[("a", &rows(one, two))]).expect("a sea");
    assert_eq!(got.bands(), [(0.05, 4.0), (0.1, 5.0), (0.2, 6.0)]);
    assert_eq!(notices, ["a: number 1 of 2 spectra is used (2026-11-21 07:30 UTC), the newest complete one"]);
    for bad in ["4 (0.05) 999.00 (0.1) 6 (0.2)", "4 (0.05) MM (0.1) 6 (0.2)", "0 (0.05) 0.00 (0.1) 0 (0.2)"] {
        let (got, notices) = read(&[("a", &rows(one, bad))]).expect("a sea");
        assert_eq!(got.bands(), [(0.05, 1.0), (0.1, 2.0), (0.2, 3.0)]);
        let want = "a: the newest record (2026-11-21 07:30 UTC) has no complete variance density: \
                    2026-11-21 06:00 UTC is used";
        assert_eq!(notices, [want]);
        let none = message("a", &rows(bad, bad));
        let want = "a: no record has a complete variance density with waves in it: choose other files of the buoy";
        assert_eq!(none, want);
    }
}

/// Every complete record of a buoy can be chosen, with the directions of its own time. The two files have other orders
/// of time.
#[test]
fn every_time_of_a_buoy_is_listed() {
    let mut files = realtime_set();
    let earlier = [
        "2026 11 21 05 00 9.999 1 (0.050) 4 (0.100) 1 (0.200)\n2026 11 21 04 00 9.999 MM (0.050) 4 (0.100) 1 (0.200)\n",
        "2026 11 21 05 00 100 (0.050) 110 (0.100) 120 (0.200)\n",
        "2026 11 21 05 00 100 (0.050) 110 (0.100) 120 (0.200)\n",
        "2026 11 21 05 00 0.9 (0.050) 0.9 (0.100) 0.9 (0.200)\n",
        "2026 11 21 05 00 0.5 (0.050) 0.5 (0.100) 0.5 (0.200)\n",
    ];
    let newest = sea(&files);
    for (i, (file, rows)) in files.iter_mut().zip(earlier).enumerate() {
        let (header, record) = file.1.split_once('\n').expect("a header");
        file.1 = if i == 1 { format!("{header}\n{rows}{record}") } else { format!("{header}\n{record}{rows}") };
    }
    let bytes: Vec<_> = files.iter().map(|(name, text)| ((*name).to_owned(), text.clone().into_bytes())).collect();
    let list = MeasuredSpectrum::read_list(&bytes).expect("a list");
    let labels: Vec<_> = list.records.iter().map(|r| r.label.as_str()).collect();
    assert_eq!(labels, ["2026-11-21 05:00 UTC", "2026-11-21 06:00 UTC"]);
    assert_eq!((list.default_index, list.default_choice), (1, DefaultSpectrum::Newest));
    assert_eq!(list.notices, ["44025.data_spec: older records that are left out because they are incomplete: 1"]);
    assert_eq!(list.records[1].spectrum, newest);
    let file = list.choose(Some(0)).expect("the first");
    assert_eq!(file.title, "44025.data_spec, 2026-11-21 05:00 UTC");
    assert_eq!(file.spectrum.bands(), [(0.05, 1.0), (0.1, 4.0), (0.2, 1.0)]);
    assert_eq!(file.spectrum.directions().map(|d| d[1].alpha1_deg), Some(110.0));

    // Without directions of its time, an older record is listed with a notice. With impossible ones it is left out.
    let mut gap = bytes;
    gap[1].1 = realtime_set()[1].1.clone().into_bytes();
    let older = MeasuredSpectrum::read_list(&gap).expect("a list").records.swap_remove(0);
    assert!(older.spectrum.directions().is_none());
    assert_eq!(older.notices, ["there is no alpha1 of 2026-11-21 05:00 UTC: the spectrum is used without directions"]);
    gap[1].1 = files[1].1.replace("110 (", "361 (").into_bytes();
    let list = MeasuredSpectrum::read_list(&gap).expect("a list");
    assert_eq!((list.records.len(), list.default_index), (1, 0));
    assert_eq!(list.notices, ["44025.data_spec: older records that are left out because they are incomplete: 2"]);
}

#[test]
fn archive_files_are_known_by_their_names() {
    let file = |row: &str| format!("{BANDS}2023 06 01 00 40 {row}\n");
    let files = [
        ("44025w2023.txt", file("0.50 2.00 0.30")),
        ("44025d2023.txt", file("240 250 999")),
        ("44025i2023.txt", file("241 251 999")),
        ("44025j2023.txt", file("80 90 99")),
        ("44025k2023.txt", file("40 60 99")),
    ];
    let got = sea(&files);
    assert_eq!(got.bands(), [(0.05, 0.5), (0.1, 2.0), (0.2, 0.3)]);
    let second = DirectionalParameters { alpha1_deg: 250.0, alpha2_deg: 251.0, r1: 0.9, r2: 0.6 };
    assert_eq!(got.directions().map(|d| (d[1], d[2])), Some((second, second)));

    // Values of r1 and r2 that are not in hundredths are kept. A comment has precedence over the file name.
    let mut plain = files.clone();
    plain[3].1 = file("0.80 0.90 99");
    plain[4].1 = file("# not a row").replace("2023 06 01 00 40 #", "#") + "2023 06 01 00 40 0.40 0.60 99\n";
    assert_eq!(sea(&plain), got);
    let named: String = ["density", "kind: alpha1", "alpha2", "kind = r1", "swr2"]
        .iter()
        .zip(&files)
        .map(|(kind, file)| format!("# {kind}\n{}", file.1))
        .collect();
    assert_eq!(sea(&[("44025w2023.txt", &named)]), got);

    // Old headers have no minutes, no '#', and years of two digits.
    let old = "YYYY MM DD hh   .05  .10  .20\n1999 01 02 03  1.0 2.0 3.0\n";
    assert_eq!(title(&[("44025w1999.txt", old)]), "44025w1999.txt, 1999-01-02 03:00 UTC");
    let old = "YY MM DD hh .05 .10 .20\n96 01 02 03 1.0 2.0 3.0\n";
    assert_eq!(title(&[("44025w1996.txt", old)]), "44025w1996.txt, 1996-01-02 03:00 UTC");

    // A single section whose kind nothing tells is read as the variance density.
    let (got, notices) = read(&[("4402512023.txt", &files[0].1)]).expect("a sea");
    assert_eq!(got.bands(), [(0.05, 0.5), (0.1, 2.0), (0.2, 0.3)]);
    assert_eq!(notices, ["4402512023.txt: the file does not say what it holds: it is read as variance density"]);
}

#[test]
fn archive_bands_meet_realtime_bands() {
    let density = "#YY MM DD hh mm .0325 .0375 .0425\n2026 11 21 06 00 1 2 3\n";
    let row = |column: &str, v: &str| {
        format!("#YY MM DD hh mm {column}\n2026 11 21 06 00 {v}1 (0.033) {v}2 (0.038) {v}3 (0.043) {v}4 (0.048)\n")
    };
    let directional = [("alpha1_1", "9"), ("alpha2_1", "9"), ("r1_1", "0."), ("r2_1", "0.")].map(|(c, v)| row(c, v));
    let got = sea(&[("44025w2026.txt", density), ("44025.all", &directional.concat())]);
    let third = DirectionalParameters { alpha1_deg: 93.0, alpha2_deg: 93.0, r1: 0.3, r2: 0.3 };
    assert_eq!(got.directions().map(|d| d[2]), Some(third));
}

#[test]
fn tables_are_read_in_every_dress() {
    let file = [("buoy.csv", "0.05,0.5\n0.1,2\n0.2,0.3\n")];
    let plain = sea(&file);
    assert!(plain.directions().is_none() && title(&file) == "buoy.csv");
    for text in [
        "\u{feff}# a comment\r\nf,S\r\n0.05,0.5\r\n\r\n0.1,2\r\n0.2,0.3",
        "\"f\";\"S\"\n0,05;0,5\n0,1;2\n0,2;0,3\n",
        "f\tS\n.05\t5e-1\n.1\t2\n.2\t.3\n",
        " 0.05 , 0.5 \n# between\n 0.1 , 2.0\n0.2,+0.3\n\n\n",
    ] {
        assert_eq!(sea(&[("buoy.csv", text)]), plain, "{text}");
    }
    let spread = 0.4_f64.sqrt().to_degrees();
    let rows = ["0.05,0.5,-90,W", "0.1,2,,30", "0.2,0.3,270,999", "0.3,0.1,10,W"].join("\n");
    let full = format!("f,S,direction,spread\n{}", rows.replace('W', &spread.to_string()));
    let got = sea(&[("buoy.csv", &full)]);
    // The spread gives r1 = 0.8, so s = 4 and r2 = 4 x 3 / (5 x 6) = 0.4.
    let west = DirectionalParameters { alpha1_deg: 270.0, alpha2_deg: 270.0, r1: 0.8, r2: 0.4 };
    let north = DirectionalParameters { alpha1_deg: 10.0, alpha2_deg: 10.0, ..west };
    assert_eq!(got.directions(), Some([west, west, north, north].as_slice()));
    let (got, notices) = read(&[("b", "0.1,1,,\n0.2,1,MM,MM\n0.3,1,9,9\n0.4,1,NaN,9\n")]).expect("a sea");
    assert!(got.directions().is_none());
    assert_eq!(notices, ["only 1 of 4 bands have a direction: the spectrum is used without directions"]);
}
