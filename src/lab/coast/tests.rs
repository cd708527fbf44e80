use super::*;
use crate::coast::placed::PlacingOptions;
use crate::coast::{Bathymetry, BuiltInCoast};
use crate::files::netcdf::Dataset;

fn over(name: &str, state: &str, settings: &CoastSettings) -> CoastSea {
    let options = PlacingOptions { cell_m: Some(25.0), ..PlacingOptions::default() };
    let coast = PlacedCoast::built_in(BuiltInCoast::find(name).expect("a coast"), &options).expect("a place");
    run(&query::parse(state).0, coast, settings).expect("a sea")
}

/// Over a flat bed the sea stays what it is: its height, its direction and its spectrum, at every gauge.
#[test]
fn over_a_flat_bed_the_sea_stays_what_it_is() {
    let coast = PlacedCoast {
        title: "flat".into(),
        built_in: None,
        about: "A flat bed.".into(),
        bathymetry: Bathymetry::from_fn(41, 41, 20.0, |_, _| 60.0),
        structures: Vec::new(),
        toward_deg: 60.0,
        middle_m: [0.0; 2],
        notices: Vec::new(),
    };
    let settings = CoastSettings { gauges_m: vec![[400.0, 400.0], [600.0, 380.0]], ..CoastSettings::default() };
    // A narrow swell of which all energy travels at less than 75 degrees from shoreward.
    let state = "depth=60&hs=1&tp=9&dir=240&spread=donelan-banner&n=64";
    let sea = run(&query::parse(state).0, coast, &settings).expect("a sea");
    assert!(sea.run_up.is_none() && sea.at_depth(10.0).is_none());
    assert!((sea.open.shoreward_hs_m / sea.open.hs_m - 1.0).abs() < 0.02, "{:?}", sea.open);
    for gauge in &sea.gauges.list {
        // Directions beyond 75 degrees are not solved, and friction takes little in water of 60 m.
        assert!((gauge.hs_m / sea.open.shoreward_hs_m - 1.0).abs() < 0.02, "{gauge:?} {:?}", sea.open);
        assert!((gauge.from_deg - 240.0).abs() < 1.5 && (gauge.tp_s / 9.0 - 1.0).abs() < 0.08, "{gauge:?}");
        assert_eq!(gauge.breaking_fraction, 0.0);
        let m0 = |density: &[f64]| {
            let pairs = sea.gauges.frequencies_hz.windows(2).zip(density.windows(2));
            pairs.map(|(f, s)| 0.5 * (s[0] + s[1]) * (f[1] - f[0])).sum::<f64>()
        };
        let ratio = m0(&gauge.spectrum_m2_hz) / m0(&sea.gauges.open_m2_hz);
        assert!((ratio - 1.0).abs() < 0.04, "{ratio}");
    }
}

#[test]
fn waves_come_ashore_on_the_beach() {
    let settings = CoastSettings { gauges_m: vec![[200.0, 700.0], [1490.0, 700.0]], wave_count: 40, solver: None };
    let sea = over("beach", "hs=2&tp=9&dir=240&n=64", &settings);
    let (edge, five, two) =
        (sea.at_edge().expect("sea"), sea.at_depth(5.0).expect("5 m"), sea.at_depth(2.0).expect("2 m"));
    // Waves of 2 m break in 2 m of water, and turn towards the shore, which lies in the east: they come from the west.
    assert!(edge.hs_m > 1.6 && two.hs_m < 1.3 && two.hs_m > 0.6, "{edge:?} {two:?}");
    // Battjes and Janssen's fraction for H_rms = 0.59 of the limit in 2 m of water is 7 %.
    assert!(edge.breaking_fraction < 0.02 && (0.05..0.12).contains(&two.breaking_fraction), "{two:?}");
    let oblique = |sea: &table::SeaAtDepth| (sea.from_deg - 270.0).abs();
    assert!(
        oblique(&two) < oblique(&five) && oblique(&five) < oblique(&edge) && oblique(&edge) < 30.0,
        "{edge:?} {two:?}"
    );
    let beach = sea.run_up.expect("a beach");
    assert!((0.02..0.09).contains(&beach.slope) && (0.4..2.0).contains(&beach.run_up.two_percent_m), "{beach:?}");
    // The second gauge stands on land.
    assert!(sea.gauges.list[0].depth_m > 8.0 && sea.gauges.list[1].depth_m < 0.0 && sea.gauges.list[1].hs_m == 0.0);
    let text = sea.to_string();
    for part in ["Straight beach.", "open sea", "10 m of water", "2 m of water", "gauge 2", "run-up: 2 %"] {
        assert!(text.contains(part), "{text}");
    }
    // The record at the first gauge has the variance of its waves.
    let record = sea.record_csv(0.0, 1.0, 1.0).expect("a record");
    let etas: Vec<f64> =
        record.lines().skip(2).map(|l| l.split(',').nth(1).expect("eta").parse().expect("a number")).collect();
    assert_eq!(etas.len(), 3600);
    let variance = etas.iter().map(|e| e * e).sum::<f64>() / 3600.0;
    let want: f64 = sea.waves_at_gauges[0].iter().map(|w| 0.5 * w[0] * w[0]).sum();
    assert!(want > 0.0 && (variance / want - 1.0).abs() < 0.2, "{variance} {want}");
    assert!(sea.record_csv(0.0, 1e9, 4.0).is_err() && sea.record_csv(0.0, 0.0, 4.0).is_err());
}

#[test]
fn fields_are_written_with_names_and_units() {
    let sea = over("bar", "hs=1.5&tp=8&dir=240&n=64", &CoastSettings { wave_count: 20, ..CoastSettings::default() });
    let bytes = sea.netcdf();
    let file = Dataset::open(&bytes).expect("a file");
    for name in ["x", "y", "east", "north", "depth", "hs", "from_direction", "tp", "breaking", "eta"] {
        let variable = &file.variables[file.find(name).unwrap_or_else(|| panic!("{name}"))];
        assert!(!variable.text("units").is_empty() && !variable.text("long_name").is_empty(), "{name}");
    }
    let hs = file.numbers(file.find("hs").expect("hs")).expect("values");
    let grid = &sea.coast.bathymetry;
    assert!(hs.iter().zip(&grid.depth_m).all(|(hs, depth)| hs.is_nan() == (*depth <= 0.0)));
    // A file written as a bathymetry is read back as the same coast.
    let again = crate::files::bathymetry::read("bar.nc", &bytes, Default::default()).expect("a bathymetry");
    assert_eq!((again.grid.columns, again.grid.rows), (grid.columns, grid.rows));
    assert!(again.grid.elevation_m.iter().zip(&grid.depth_m).all(|(up, down)| *up == -down));
    assert!(sea.surface_m.iter().any(|eta| eta.abs() > 0.1));
}

#[test]
fn what_cannot_be_solved_is_said() {
    let beach = || PlacedCoast::built_in(BuiltInCoast::find("beach").expect("a beach"), &PlacingOptions::default());
    let said = |state: &str, gauges_m: Vec<[f64; 2]>| {
        let settings = CoastSettings { gauges_m, ..CoastSettings::default() };
        run(&query::parse(state).0, beach().expect("a coast"), &settings).map(drop).expect_err("refused")
    };
    assert!(said("wind=0&n=64", vec![]).contains("no waves of this sea travel towards the land"));
    assert!(said("dir=90&spread=cos2-positive&hs=1&tp=8&n=64", vec![]).contains("turn the coast"));
}

/// A wall across the whole coast reflects the sea, and nothing comes behind it. Before it the mean energy is up to twice
/// that of the sea; beside a rough wall it is less.
#[test]
fn structures_reflect() {
    let before = |reflection: f64| {
        let mut bathymetry = Bathymetry::from_fn(41, 41, 12.0, |_, _| 12.0);
        let wall = crate::coast::Structure {
            name: "wall",
            line_m: vec![[300.0, -100.0], [300.0, 600.0]],
            top_width_m: 24.0,
            top_height_m: 5.0,
            side_slope: 0.0,
            reflection,
        };
        wall.build_in(&mut bathymetry);
        let (title, about) = ("wall".to_owned(), "A wall.".to_owned());
        let coast = PlacedCoast {
            title,
            built_in: None,
            about,
            bathymetry,
            structures: vec![wall],
            toward_deg: 60.0,
            middle_m: [0.0; 2],
            notices: Vec::new(),
        };
        let settings = CoastSettings { gauges_m: vec![[420.0, 240.0]], ..CoastSettings::default() };
        let sea =
            run(&query::parse("hs=1&tp=9&dir=240&spread=donelan-banner&n=64").0, coast, &settings).expect("a sea");
        assert!(sea.gauges.list[0].hs_m < 0.05, "behind the wall: {:?}", sea.gauges.list[0]);
        let row = &sea.maps.hs_m[20 * 41..20 * 41 + 24];
        (row.iter().map(|hs| f64::from(hs * hs)).sum::<f64>() / 24.0).sqrt()
    };
    let (smooth, rough) = (before(1.0), before(0.3));
    assert!(smooth > 1.15 * rough, "{smooth} {rough}");
}
