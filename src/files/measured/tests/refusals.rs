//! Tests of files that are refused as measured spectra, and of the error messages.

use super::super::{DirectionalParameters, MAX_FILE_BYTES, MeasuredSpectrum};
use super::samples::{JONSWAP, PIERSON_MOSKOWITZ, TWO_SYSTEMS};
use super::{BANDS, Lcg, SPEC, check, message, read, realtime_set, sea};

#[test]
fn malformed_tables_say_where_and_why() {
    let long = format!("0.1,{}\n", "1,".repeat(5000));
    let many: String = (1..=257).map(|i| format!("{},1\n", f64::from(i) / 1000.0)).collect();
    for (text, want) in [
        ("0.05,1\n0.06,1\n0.05,1\n", "b.csv, line 3: the frequency 0.05 Hz follows 0.06 Hz: frequencies must ascend"),
        ("0.1,1\n0.10001,1\n", "b.csv, line 2: the frequency 0.10001 Hz follows 0.1 Hz: frequencies must ascend"),
        ("f,S\n0,1\n", "b.csv, line 2: the frequency 0 Hz must be above 0 and at most 2 Hz"),
        ("-0.1,1\n", "b.csv, line 1: the frequency -0.1 Hz must be above 0 and at most 2 Hz"),
        ("2.1,1\n", "b.csv, line 1: the frequency 2.1 Hz must be above 0 and at most 2 Hz"),
        ("0.1,-1\n", "b.csv, line 1: the variance density -1 m^2/Hz must be at least 0 and below 100000 m^2/Hz"),
        ("\n0.1,1e5\n", "b.csv, line 2: the variance density 100000 m^2/Hz must be at least 0 and below 100000 m^2/Hz"),
        ("0.1,1\n0.2,inf\n", "b.csv, line 2: the variance density \"inf\" is not a number"),
        ("0.1,\n", "b.csv, line 1: the variance density \"\" is not a number"),
        ("0.1,1e300\n", "b.csv, line 1: the variance density 1e300 m^2/Hz must be at least 0 and below 100000 m^2/Hz"),
        ("0.1,1e999\n", "b.csv, line 1: the variance density \"1e999\" is not a number"),
        ("0.o5,1\n", "b.csv, line 1: the frequency \"0.o5\" is not a number"),
        ("f,S\ng,T\n", "b.csv, line 2: the frequency \"g\" is not a number"),
        ("0.1,1,2\n", "b.csv, line 1: 3 columns, but 2 (f, S) or 4 (f, S, direction, spread) are needed"),
        ("0.1,1\n0.2,1,2,3\n", "b.csv, line 2: 4 columns, but the lines before have 2"),
        ("0.1 1\n", "b.csv, line 1: no columns were found: separate them by comma, semicolon or tab"),
        ("0.1,1,west,3\n", "b.csv, line 1: the direction \"west\" is not a number"),
        ("0.1,1,400,3\n", "b.csv, line 1: the direction 400 is not within -360 to 360 degrees"),
        ("0.1,1,40,181\n", "b.csv, line 1: the spread 181 is not within 0 to 180 degrees"),
        ("0.1,1\n0.2,1\n", "b.csv: 2 frequency bands, but 3 to 256 are needed"),
        ("0.1,0\n0.2,0\n0.3,1e-12\n", "b.csv: the variance density is zero in every band: there are no waves"),
        ("", "b.csv: the file is empty: choose another one"),
        ("\u{feff}\r\n \n", "b.csv: the file is empty: choose another one"),
        (&long, "b.csv, line 1: more than 4096 columns"),
        (&many, "b.csv, line 257: more than 256 frequency bands"),
    ] {
        assert_eq!(message("b.csv", text), want);
    }
}

#[test]
fn malformed_buoy_files_say_where_and_why() {
    let row = |row: &str| format!("{SPEC}{row}\n");
    let bands: String = (1..=257).map(|i| format!(" 1 ({})", f64::from(i) / 1000.0)).collect();
    let many = row(&format!("2026 11 21 06 00 9.999{bands}"));
    let columns = format!("{BANDS}2026 11 21 06 00{}\n", " 1".repeat(5000));
    let headers = BANDS.repeat(65);
    for (text, want) in [
        (row("2026 13 21 06 00 9 1 (0.1)"), "line 2: \"13\" is not a valid month"),
        (row("2026 11 32 06 00 9 1 (0.1)"), "line 2: \"32\" is not a valid day"),
        (row("2026 11 21 24 00 9 1 (0.1)"), "line 2: \"24\" is not a valid hour"),
        (row("2026 11 21 06 60 9 1 (0.1)"), "line 2: \"60\" is not a valid minute"),
        (row("-5 11 21 06 00 9 1 (0.1)"), "line 2: \"-5\" is not a valid year"),
        (row("2026 11 21"), "line 2: the record ends before its hour"),
        (row("2026 11 21 06 00"), "line 2: the record has no values"),
        (row("2026 11 21 06 00 9.999"), "line 2: the record has no values"),
        (row("2026 11 21 06 00 9.999 x (0.1)"), "line 2: the value \"x\" is not a number"),
        (row("2026 11 21 06 00 9.999 1 (0.1) 2"), "line 2: after \"2\" a frequency in parentheses is missing"),
        (row("2026 11 21 06 00 9.999 1 (0.1) 2 0.2"), "line 2: after \"2\" a frequency in parentheses is missing"),
        (row("2026 11 21 06 00 9.999 1 (0.1) 2 (x)"), "line 2: after \"2\" a frequency in parentheses is missing"),
        (
            row("2026 11 21 06 00 9.999 1 (0.1) 2 (0.1)"),
            "line 2: the frequency 0.1 Hz follows 0.1 Hz: frequencies must ascend",
        ),
        (row("2026 11 21 06 00 9.999 1 (0.1) 2 (0.2)"), "line 2: 2 frequency bands, but 3 to 256 are needed"),
        (
            row("2026 11 21 06 00 9.999 1 (0.1) -2 (0.2) 1 (0.3)"),
            "line 2: the variance density -2 m^2/Hz must be at least 0 and below 100000 m^2/Hz",
        ),
        (many, "line 2: more than 256 frequency bands"),
        (columns, "line 2: more than 4096 columns"),
        (headers, "line 65: more than 64 header lines"),
        (format!("{BANDS}2026 11 21 06 00 1 2\n"), "line 2: 2 values for the 3 frequencies of line 1"),
        (format!("{BANDS}2026 11 21 06 00 1 2 x\n"), "line 2: the value \"x\" is not a number"),
        (format!("1 2 3\n{BANDS}"), "line 1: \"1 2 3\" stands before the first header line"),
        ("#YY MM DD hh mm .05 .04\n".into(), "line 1: the frequency 0.04 Hz follows 0.05 Hz: frequencies must ascend"),
        ("#YY MM DD hh mm .05 x\n".into(), "line 1: the frequency \"x\" is not a number"),
        ("#YY MM DD hh mm .05 3\n".into(), "line 1: the frequency 3 Hz must be above 0 and at most 2 Hz"),
        ("#YY MM DD hh mm\n".into(), "line 1: the header names neither frequencies nor values"),
        ("#YY MM DD hh mm WDIR WSPD\n".into(), "line 1: the column \"WDIR\" does not belong in a spectral file"),
    ] {
        assert_eq!(message("b.data_spec", &text), format!("b.data_spec, {want}"), "{text}");
    }
    assert_eq!(
        message("b", SPEC),
        "b: no variance density: add the buoy's raw spectral wave data from the NDBC (.data_spec)"
    );
    let unknown = format!("{BANDS}2026 11 21 06 00 1 2 3\n{BANDS}2026 11 21 06 00 4 5 6\n");
    let what = "neither the file name nor a comment says what this section holds: \
                put a comment such as \"# alpha1\" before the header";
    assert_eq!(message("b.txt", &unknown), format!("b.txt, line 1: {what}"));
    let what = "variance density of 2026-11-21 06:00 UTC is already in 44025w2023.txt, line 2: \
                remove one of the two records";
    assert_eq!(message("44025w2023.txt", &unknown), format!("44025w2023.txt, line 4: {what}"));
}

#[test]
fn impossible_directions_are_refused_and_large_moments_bounded() {
    for (i, from, to, want) in [
        (1, "240.0", "361.0", "44025.swdir, line 2: alpha1 of 361 is not within 0 to 360"),
        (2, "241.0", "-1.0", "44025.swdir2, line 2: alpha2 of -1 is not within 0 to 360"),
        (3, "0.80", "1.60", "44025.swr1, line 2: r1 of 1.6 is not within 0 to 1.5"),
        (4, "0.40", "-0.40", "44025.swr2, line 2: r2 of -0.4 is not within 0 to 1.5"),
    ] {
        let mut files = realtime_set();
        files[i].1 = files[i].1.replace(from, to);
        assert_eq!(read(&files).expect_err(want), want);
    }
    let mut files = realtime_set();
    files[1].1 = files[1].1.replace("240.0", "360.0");
    files[3].1 = files[3].1.replace("0.80", "1.20");
    let d = sea(&files).directions().map(|d| d[0]);
    assert_eq!(d, Some(DirectionalParameters { alpha1_deg: 0.0, alpha2_deg: 241.0, r1: 1.0, r2: 0.4 }));
}

#[test]
fn what_is_no_text_or_too_much_is_refused() {
    let one = |name: &str, bytes: &[u8]| MeasuredSpectrum::read(&[(name.into(), bytes.to_vec())]).expect_err(name);
    assert_eq!(MeasuredSpectrum::read(&[]), Err("no file was given".into()));
    let nine = vec![("b.csv".to_string(), b"0.1,1".to_vec()); 9];
    assert_eq!(MeasuredSpectrum::read(&nine), Err("9 files were given: give at most 8 for one spectrum".into()));
    let want = "b.csv: it holds complete spectra: read it without other files";
    assert_eq!(MeasuredSpectrum::read(&nine[..2]), Err(want.into()));
    let mixed = [nine[0].clone(), ("b.data_spec".into(), SPEC.into())];
    let want = "b.data_spec: its format differs from that of b.csv: read it alone";
    assert_eq!(MeasuredSpectrum::read(&mixed), Err(want.into()));
    assert_eq!(
        one("b.csv", &vec![b'0'; MAX_FILE_BYTES + 1]),
        "b.csv: the file is larger than 16 MiB: keep fewer records in it"
    );
    assert_eq!(one("b.csv", b"0.1,1\n0.2,\xff\n"), "b.csv: line 2 is not valid UTF-8: save the file as UTF-8");
    assert_eq!(one("b.txt.gz", b"\x1f\x8b\x08\x00"), "b.txt.gz: the file is compressed: unpack it first");
    assert_eq!(one("b.csv", b"\xff\xfe0\x00"), "b.csv: the file is UTF-16 text: save it as UTF-8");
    // File names and quotations in messages are printable and short.
    let name = format!("/tmp/\u{202e}a\n\x1b[31m{}", "x".repeat(500));
    let error = one(&name, format!("0.1,\u{7}{}\n", "y".repeat(5000)).as_bytes());
    assert!(error.len() < 200 && error.starts_with("a[31mxxx") && !error.contains(char::is_control), "{error}");
}

#[test]
fn random_files_never_panic() {
    let mut random = Lcg(1);
    let mut texts: Vec<String> = realtime_set().into_iter().map(|f| f.1).collect();
    texts.push(texts.concat());
    texts.extend([JONSWAP, TWO_SYSTEMS, PIERSON_MOSKOWITZ].map(String::from));
    let names = ["b.csv", "44025w2023.txt", "44025j2023.txt", "b.swr2", "b.data_spec", ""];
    let pieces =
        ["-", ".", "e9", "999.0", "(", ")", "#", "\n", " ", ",", ";", "\t", "1e308", "\u{feff}", "# r1\n", "MM"];
    let mut good = 0;
    for _ in 0..4000 {
        let files: Vec<(String, Vec<u8>)> = (0..1 + random.below(3) / 2)
            .map(|_| {
                let mut bytes = texts[random.below(texts.len())].clone().into_bytes();
                for _ in 0..random.below(4) {
                    let at = random.below(bytes.len());
                    match random.below(4) {
                        0 => bytes[at] = random.next() as u8,
                        1 => drop(bytes.drain(at..(at + 1 + random.below(40)).min(bytes.len()))),
                        2 => drop(bytes.splice(at..at, pieces[random.below(pieces.len())].bytes())),
                        _ => bytes.extend_from_within(at..),
                    }
                    if bytes.is_empty() {
                        bytes.push(b'1');
                    }
                }
                (names[random.below(names.len())].to_string(), bytes)
            })
            .collect();
        match MeasuredSpectrum::read(&files) {
            Ok(file) => {
                good += 1;
                assert!(file.notices.len() < 8);
                check(&file.spectrum);
            }
            Err(what) => assert!(!what.is_empty() && what.chars().count() < 300, "{what}"),
        }
    }
    assert!(good > 300, "{good}");
    for _ in 0..500 {
        let bytes = (0..random.below(300)).map(|_| random.next() as u8).collect();
        assert!(MeasuredSpectrum::read(&[("b".into(), bytes)]).is_err());
    }
}
