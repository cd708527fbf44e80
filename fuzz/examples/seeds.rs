//! Writes the seed corpus of the fuzz targets: a dictionary and valid files of each format.

use exr::prelude::*;
use seastate::files::measured::MeasuredSpectrum;
use seastate::files::picture;
use seastate::state::fields::{FIELDS, FieldKind};
use seastate::state::{presets, query};
use std::path::Path;

fn main() -> std::io::Result<()> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let put = |target: &str, name: &str, bytes: &[u8]| {
        let folder = corpus.join(target);
        std::fs::create_dir_all(&folder)?;
        std::fs::write(folder.join(name), bytes)
    };
    let buoy = include_str!("../../assets/spectra/two-systems.txt");
    let measured = MeasuredSpectrum::read(&[("b.txt".into(), buoy.into())]).expect("a sample").spectrum;
    let mut states: Vec<String> = presets::built_in().iter().map(|p| p.state.clone()).collect();
    states.push(format!("spectrum=measured&measured={}", measured.to_state()));
    states.push("sky=a%20b.hdr&afloat=buoy*1*2_boat*-3*4.5&foamcolour=ff0011&t=1e5#x".into());
    for (i, state) in states.iter().enumerate() {
        put("state", &i.to_string(), state.as_bytes())?;
    }
    let png = picture::encode([2, 2], &[9; 16], &query::write(&query::parse(&states[2]).0), "x").expect("a picture");
    put("picture", "0", &png)?;
    put("seas", "0", include_bytes!("../../assets/presets/seas.txt"))?;
    put("seas", "1", b"[a]\nabout: b\nsource: c\nstate: wind=3\nstate: sun=4\n# d\n[a]\nstate:\n")?;
    put("buoy", "links", measured.to_state().as_bytes())?;
    put("buoy", "sections", format!("b.txt\n{buoy}").as_bytes())?;
    put(
        "buoy",
        "realtime",
        format!("b.data_spec\n{}", include_str!("../../assets/spectra/pierson-moskowitz.data_spec")).as_bytes(),
    )?;
    put("buoy", "table", format!("b.csv\n{}", include_str!("../../assets/spectra/jonswap-10ms-100km.csv")).as_bytes())?;
    let header = "#YY MM DD hh mm .02 .05 .1\n2023 1 1 0 0";
    let archive = format!("44025w2023.txt\n{header} 0. 1.5 2\n\x1c44025d2023.txt\n{header} 10 20 30\n");
    put("buoy", "archive", archive.as_bytes())?;
    put_spectra(&put)?;
    for (name, bytes) in skies() {
        put("sky", &name, &bytes)?;
    }
    let words = FIELDS.iter().flat_map(|f| match f.kind {
        FieldKind::Choice(words) => words.to_vec(),
        _ => vec![f.key],
    });
    let more = [
        "measured",
        "afloat",
        "sky",
        "alpha1",
        "kind: r1",
        "#YY MM DD hh mm",
        "[a]",
        "state:",
        "about:",
        "999.0",
        "MM",
        "FACTOR",
        "NODATA",
        "ZERO",
        "LOCATION",
        "CDIR",
        "EnDens",
        "varianceDensity",
        "frequency",
        "d2fd",
        "efth",
    ];
    let dictionary: Vec<String> = words.chain(more).map(|word| format!("\"{word}\"\n")).collect();
    std::fs::write(corpus.join("words.dict"), dictionary.concat())
}

/// Spectra in the formats of wave models and of Spotter buoys.
fn put_spectra(put: &impl Fn(&str, &str, &[u8]) -> std::io::Result<()>) -> std::io::Result<()> {
    let state = "spectrum=measured&measured=d*8*20_.05*1*--AAggAAAAAAAABB_.1*3*ABAD--CCAAAAAAAA_.2*1*AAAA--QQAAAAQQAA";
    let sea = seastate::waves::Plan::new(&query::parse(state).0).directional_spectrum(state);
    put("swan", "2d", sea.to_swan().as_bytes())?;
    put("swan", "times", include_bytes!("../../tests/spectra/swan.sp2"))?;
    let head = "SWAN 1\nLOCATIONS\n 1\n 0 0\nRFREQ\n 3\n .1 .2 .3\nQUANT\n 3\n";
    let table = "EnDens\nJ/m2/Hz\n-99\nCDIR\ndegr\n-999\nDSPRDEGR\ndegr\n-9\nLOCATION 1\n 900 10 20\n 800 -999 -9\n 70 350 30\n";
    put("swan", "1d", format!("{head}{table}").as_bytes())?;
    let point = "20130101 000000\n'a         '  33.75-119.05  881.3 2.04 258.5 0.00 270.0\n 0.1E+00 0.2E+00 .1 0 0 0 1 2 3 1 1 1\n";
    let spectra = "'WAVEWATCH III SPECTRA' 3 4 1 'x'\n .1 .2 .3\n 0.0 1.571 3.142 4.712\n";
    put("wavewatch", "0", format!("{spectra}{point}{point}").as_bytes())?;
    put("wavewatch", "table", sea.to_csv().as_bytes())?;
    let moments = r#""frequency":[0.1,0.2,0.3],"varianceDensity":[1,2,0.5],"a1":[0.5,0,0],"b1":[0,1,0],"a2":[0,0,0.1],"b2":[0,0,0]"#;
    let means = r#""frequency":[0.1,0.2,0.3],"varianceDensity":[1,2,0.5],"direction":[1,null,3],"directionalSpread":[9,20,30]"#;
    put("spotter", "0", format!(r#"{{"data":{{"frequencyData":[{{{moments},"timestamp":"t"}},{{{means}}}]}}}}"#).as_bytes())?;
    put("netcdf", "own", &sea.to_netcdf())?;
    for (name, bytes) in [
        ("cdf1", &include_bytes!("../../tests/spectra/ww3-cdf1.nc")[..]),
        ("cdf5", include_bytes!("../../tests/spectra/ww3-cdf5.nc")),
        ("era5", include_bytes!("../../tests/spectra/era5-numbered.nc")),
        ("era5-4", include_bytes!("../../tests/spectra/era5-values.nc")),
    ] {
        put("netcdf", name, bytes)?;
    }
    Ok(())
}

/// A small sky in every file format and encoding that is read.
fn skies() -> Vec<(String, Vec<u8>)> {
    let light = |at: Vec2<usize>| {
        let sun = if at == Vec2(20, 4) { 900.0 } else { 0.0 };
        (0.3 + sun, 0.5 + 0.01 * at.x() as f32 + sun, 1.0 + sun)
    };
    let mut out = Vec::new();
    for compression in [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
    ] {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(16, 8))] {
            let half = |at| {
                let (r, g, b) = light(at);
                (f16::from_f32(r), f16::from_f32(g), b)
            };
            let layer = Layer::new(
                Vec2(32, 16),
                LayerAttributes::default(),
                Encoding { compression, blocks, line_order: LineOrder::Increasing },
                SpecificChannels::rgb(half),
            );
            let mut bytes = std::io::Cursor::new(Vec::new());
            if Image::from_layer(layer).write().to_buffered(&mut bytes).is_ok() {
                out.push((
                    format!("{}-{compression:?}.exr", if blocks == Blocks::ScanLines { "rows" } else { "tiles" }),
                    bytes.into_inner(),
                ));
            }
        }
    }
    let pixel = [[128_u8, 64, 32, 129]; 16];
    let head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n";
    let runs = [&[2, 2, 0, 16][..], &[144, 128], &[128 + 15, 64, 1, 64], &[144, 32], &[144, 129]].concat().repeat(8);
    for (name, rows) in
        [("bare", pixel.concat().repeat(8)), ("old", [128, 64, 32, 129, 1, 1, 1, 15].repeat(8)), ("runs", runs)]
    {
        out.push((format!("{name}.hdr"), [&head[..], &rows].concat()));
    }
    out
}
