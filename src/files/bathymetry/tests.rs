//! Small files of every format, written here: what is read from them, and what is refused.

use super::*;
use crate::files::netcdf::{Attribute, NewVariable, Values, write};
use ::tiff::encoder::{Compression, TiffEncoder, colortype};
use ::tiff::tags::{Predictor, Tag};

fn open(name: &str, bytes: &[u8]) -> Result<BathymetryFile, String> {
    read(name, bytes, ReadAs::default())
}

fn refusal(bytes: &[u8]) -> String {
    let reason = open("coast.dat", bytes).map(drop).expect_err("refused");
    assert!(reason.starts_with("coast.dat: ") && reason.lines().count() == 1, "{reason}");
    reason
}

/// Elevation of the sea floor of the tests: a slope towards the north-east.
fn floor(i: usize, j: usize) -> f32 {
    -12.0 + 3.0 * i as f32 + 0.5 * j as f32
}

/// The grid of [`floor`] from the south.
fn floor_grid(columns: usize, rows: usize) -> Vec<f32> {
    (0..columns * rows).map(|i| floor(i % columns, i / columns)).collect()
}

fn ascii(columns: usize, rows: usize, head: &str) -> String {
    let mut text = format!("ncols {columns}\nnrows {rows}\n{head}");
    for j in (0..rows).rev() {
        let row: Vec<String> = (0..columns).map(|i| floor(i, j).to_string()).collect();
        text += &format!("{}\n", row.join(" "));
    }
    text
}

#[test]
fn an_ascii_grid_lies_from_north_to_south() {
    let text = ascii(6, 4, "xllcorner 5000\nyllcorner 7000\ncellsize 20\nNODATA_value -9999\n");
    let file = open("a.asc", text.as_bytes()).expect("a grid");
    assert_eq!((file.grid.columns, file.grid.rows, file.grid.cell_m), (6, 4, [20.0, 20.0]));
    assert_eq!(file.grid.elevation_m, floor_grid(6, 4));
    assert_eq!(file.grid.middle_deg, None);
    assert!(file.notices.len() == 1 && file.notices[0].contains("positive up"), "{:?}", file.notices);
    // Bilinear inside, constant beyond the edge; the middle is the origin.
    assert!((file.grid.at(0.0, 0.0) - (-12.0 + 7.5 + 0.75)).abs() < 1e-6);
    assert!((file.grid.at(-1e6, -1e6) + 12.0).abs() < 1e-6 && (file.grid.at(50.0, 30.0) - 4.5).abs() < 1e-6);
}

#[test]
fn degrees_become_metres_on_the_ellipsoid() {
    // A minute of latitude at 45 degrees is 1852.2 m, of longitude 1314.2 m.
    let head = "xllcenter -10.5\nyllcenter 44.95\ncellsize 0.016666666667\n";
    let file = open("a.asc", ascii(6, 7, head).as_bytes()).expect("a grid");
    let [east, north] = file.grid.cell_m;
    assert!((east - 1314.2).abs() < 0.5 && (north - 1852.2).abs() < 0.5, "{east} {north}");
    let [latitude, longitude] = file.grid.middle_deg.expect("degrees");
    assert!((latitude - 45.0).abs() < 1e-6 && (longitude + 10.458_333).abs() < 1e-5, "{latitude} {longitude}");
    let metres = ReadAs { is_in_degrees: Some(false), ..ReadAs::default() };
    let file = read("a.asc", ascii(6, 7, head).as_bytes(), metres).expect("a grid");
    assert!((file.grid.cell_m[0] - 0.016_666_666_667).abs() < 1e-12);
}

#[test]
fn depths_and_elevations_are_told_apart() {
    let depths = "x;y;depth\n0;0;5\n10;0;6\n0;10;7\n10;10;8,0\n".replace(",0", "");
    let file = open("a.xyz", depths.as_bytes()).expect("points");
    assert_eq!((&file.grid.elevation_m[..], file.notices.len()), (&[-5.0, -6.0, -7.0, -8.0][..], 0));
    let without_words = "0 0 5\n10 0 6\n0 10 7\n10 10 8\n";
    let file = open("a.xyz", without_words.as_bytes()).expect("points");
    assert!(file.grid.elevation_m[0] == -5.0 && file.notices[0].contains("positive down"), "{:?}", file.notices);
    let named = open("harbour_depths.xyz", without_words.as_bytes()).expect("points");
    assert!(named.grid.elevation_m[0] == -5.0 && named.notices.is_empty(), "{:?}", named.notices);
    let said = read(
        "a.xyz",
        b"0 0 -5\n10 0 6\n0 10 7\n10 10 8\n",
        ReadAs { is_positive_up: Some(false), is_in_degrees: None },
    );
    assert_eq!(said.expect("points").grid.elevation_m, [5.0, -6.0, -7.0, -8.0]);
    let land = read("a.xyz", without_words.as_bytes(), ReadAs { is_positive_up: Some(true), is_in_degrees: None });
    assert!(land.expect_err("no sea").contains("all of it is land"));
}

#[test]
fn points_on_a_grid_become_it_in_any_order() {
    let mut lines: Vec<String> = (0..35)
        .map(|i| {
            format!(
                "{:.4},{:.4},{}",
                0.0042 * f64::from(i % 7),
                50.0 + 0.0042 * f64::from(i / 7),
                floor(i as usize % 7, i as usize / 7)
            )
        })
        .collect();
    lines.reverse();
    lines.swap(3, 20);
    let text = format!("lon,lat,elevation\n{}\n", lines.join("\n"));
    let file = open("a.csv", text.as_bytes()).expect("points");
    assert_eq!((file.grid.columns, file.grid.rows), (7, 5));
    assert_eq!(file.grid.elevation_m, floor_grid(7, 5));
    assert!(file.notices.is_empty() && file.grid.middle_deg.is_some());
    // A point less is a gap, which is filled and said.
    lines.remove(12);
    let file = open("a.csv", lines.join("\n").as_bytes()).expect("points");
    assert!(file.notices.iter().any(|n| n.contains("1 points without data")), "{:?}", file.notices);
}

#[test]
fn scattered_soundings_lie_on_triangles() {
    // A plane is reproduced exactly between the soundings.
    let plane = |x: f64, y: f64| -14.0 + 0.02 * x - 0.003 * y;
    let mut text = String::from("# soundings, elevation in metres\n");
    for i in 0..900_u32 {
        let [a, b, ..] = crate::waves::noise::pcg4d([i, 1, 2, 3]).map(|w| f64::from(w) / 4_294_967_296.0);
        let (x, y) = (1000.0 * a, 600.0 * b);
        text += &format!("{x} {y} {}\n", plane(x, y));
    }
    text += &[(0.0, 0.0), (1000.0, 0.0), (0.0, 600.0), (1000.0, 600.0)]
        .map(|(x, y)| format!("{x} {y} {}\n", plane(x, y)))
        .concat();
    let file = open("a.xyz", text.as_bytes()).expect("points");
    assert!(file.notices[0].contains("904 scattered points"), "{:?}", file.notices);
    let [wide, high] = file.grid.side_m();
    assert!((wide - 1000.0).abs() < 1e-6 && (high - 600.0).abs() < 1e-6, "{wide} {high}");
    for j in 0..file.grid.rows {
        for i in 0..file.grid.columns {
            let (x, y) = (i as f64 * file.grid.cell_m[0], j as f64 * file.grid.cell_m[1]);
            let found = f64::from(file.grid.elevation_m[j * file.grid.columns + i]);
            assert!((found - plane(x, y)).abs() < 1e-4, "{x} {y}: {found}");
        }
    }
}

/// A NetCDF file of [`floor`] with `columns` x `rows` points, as GEBCO writes it.
fn gebco(columns: usize, rows: usize, descends: bool) -> Vec<u8> {
    let text = |name: &'static str, value: &str| (name, Attribute::Text(value.to_owned()));
    let longitudes: Vec<f64> =
        (0..columns).map(|i| 179.99 + i as f64 / 240.0).map(|v| if v > 180.0 { v - 360.0 } else { v }).collect();
    let mut latitudes: Vec<f64> = (0..rows).map(|j| -40.0 + j as f64 / 240.0).collect();
    let mut values = floor_grid(columns, rows);
    if descends {
        latitudes.reverse();
        values = values.chunks(columns).rev().flatten().copied().collect();
    }
    let axis = |name, dimension, units: &str, values| NewVariable {
        name,
        dimensions: vec![dimension],
        attributes: vec![text("standard_name", name), text("units", units)],
        values: Values::F64(values),
    };
    let elevation = NewVariable {
        name: "elevation",
        dimensions: vec![0, 1],
        attributes: vec![
            text("standard_name", "height_above_mean_sea_level"),
            text("long_name", "Elevation relative to sea level"),
            text("units", "m"),
            ("_FillValue", Attribute::Numbers(vec![-32767.0])),
        ],
        values: Values::F32(&values),
    };
    let variables = [
        axis("latitude", 0, "degrees_north", &latitudes),
        axis("longitude", 1, "degrees_east", &longitudes),
        elevation,
    ];
    write(&[("latitude", rows), ("longitude", columns)], &[("title", "a test")], &variables)
}

#[test]
fn gebco_is_read_across_the_date_line() {
    for descends in [false, true] {
        let file = open("gebco.nc", &gebco(9, 5, descends)).expect("a grid");
        assert_eq!((file.grid.columns, file.grid.rows), (9, 5));
        assert_eq!(file.grid.elevation_m, floor_grid(9, 5));
        assert_eq!(file.notices, [""; 0]);
        let [latitude, longitude] = file.grid.middle_deg.expect("degrees");
        assert!((latitude + 39.991_667).abs() < 1e-5 && (longitude + 179.993_333).abs() < 1e-5, "{longitude}");
    }
}

/// A GeoTIFF of a grid of floats, packed in one way; `tie` is the corner of the first pixel.
fn geotiff(compression: Compression, predictor: Predictor, values: &[f32], columns: u32, tie: [f64; 2]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut encoder =
        TiffEncoder::new(&mut bytes).expect("an encoder").with_compression(compression).with_predictor(predictor);
    let rows = values.len() as u32 / columns;
    let mut image = encoder.new_image::<colortype::Gray32Float>(columns, rows).expect("an image");
    image.rows_per_strip(3).expect("strips");
    let tags = image.encoder();
    tags.write_tag(Tag::ModelPixelScaleTag, &[25.0, 25.0, 0.0][..]).expect("a tag");
    tags.write_tag(Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, tie[0], tie[1], 0.0][..]).expect("a tag");
    tags.write_tag(Tag::GeoKeyDirectoryTag, &[1_u16, 1, 0, 2, 1024, 0, 1, 1, 1025, 0, 1, 1][..]).expect("a tag");
    tags.write_tag(Tag::GdalNodata, "-9999").expect("a tag");
    image.write_data(values).expect("the data");
    bytes.into_inner()
}

fn from_north(columns: usize, rows: usize) -> Vec<f32> {
    floor_grid(columns, rows).chunks(columns).rev().flatten().copied().collect()
}

#[test]
fn a_geotiff_is_read_in_every_packing() {
    use ::tiff::encoder::DeflateLevel;
    for compression in
        [Compression::Uncompressed, Compression::Lzw, Compression::Packbits, Compression::Deflate(DeflateLevel::Fast)]
    {
        // The second image is large enough for codes of 12 bits and a full table.
        for (columns, rows) in [(6, 8), (190, 160)] {
            let bytes =
                geotiff(compression, Predictor::None, &from_north(columns, rows), columns as u32, [300.0, 900.0]);
            let file = open("dem.tif", &bytes).expect("a grid");
            assert_eq!((file.grid.columns, file.grid.rows, file.grid.cell_m), (columns, rows, [25.0, 25.0]));
            assert_eq!(file.grid.elevation_m, floor_grid(columns, rows));
            assert_eq!(file.notices, [""; 0], "the name says that these are elevations");
        }
    }
    let mut values = from_north(6, 8);
    values[0] = -9999.0;
    let bytes = geotiff(Compression::Lzw, Predictor::None, &values, 6, [0.0; 2]);
    let file = open("dem.tif", &bytes).expect("a grid");
    assert!(file.notices[0].starts_with("1 points without data"), "{:?}", file.notices);
}

#[test]
fn whole_numbers_with_a_predictor_are_read() {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes)
        .expect("an encoder")
        .with_compression(Compression::Lzw)
        .with_predictor(Predictor::Horizontal);
    let values: Vec<i16> = (0..60 * 50).map(|i| (i % 60) as i16 * 7 - 300 + (i / 60) as i16).collect();
    let mut image = encoder.new_image::<colortype::GrayI16>(60, 50).expect("an image");
    image
        .encoder()
        .write_tag(
            Tag::ModelTransformationTag,
            &[10.0, 0.0, 0.0, 5.0, 0.0, 10.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0][..],
        )
        .expect("a tag");
    image.write_data(&values).expect("the data");
    let file = open("dem.tif", &bytes.into_inner()).expect("a grid");
    assert!(file.grid.elevation_m.iter().zip(&values).all(|(a, b)| *a == f32::from(*b)), "rows from the south");
}

#[test]
fn the_floating_point_predictor_is_undone() {
    // Bytes as TIFF Technical Note 3 stores them: the first bytes of all samples, then the second ones ..., as differences.
    let values = from_north(6, 8);
    let mut bytes = geotiff(Compression::Uncompressed, Predictor::None, &values, 6, [0.0; 2]);
    let row_bytes = 24;
    let mut stored = Vec::new();
    for row in values.chunks(6) {
        let planes: Vec<u8> = (0..4).flat_map(|byte| row.iter().map(move |v| v.to_be_bytes()[byte])).collect();
        stored.extend((0..row_bytes).map(|i| if i == 0 { planes[0] } else { planes[i].wrapping_sub(planes[i - 1]) }));
    }
    let plain: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    let at = bytes.windows(72).position(|w| *w == plain[..72]).expect("the first strip");
    // The strips of three rows follow each other.
    bytes[at..at + stored.len()].copy_from_slice(&stored);
    // The tag of the sample format (339) becomes a predictor (317) beside it: tags are found by number, so rename one
    // that is not needed, the resolution unit (296), a short.
    let entry = bytes.windows(4).position(|w| w == [0x28, 0x01, 3, 0]).expect("a tag to rename");
    bytes[entry..entry + 2].copy_from_slice(&317_u16.to_le_bytes());
    bytes[entry + 8..entry + 10].copy_from_slice(&3_u16.to_le_bytes());
    let file = open("dem.tif", &bytes).expect("a grid");
    assert_eq!(file.grid.elevation_m, floor_grid(6, 8));
}

#[test]
fn refusals_say_what_to_do() {
    let huge = "ncols 100000\nnrows 100000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3";
    for (text, says) in [
        (huge, "100000 x 100000 points, but at most 8388608 are read: cut out the coast"),
        ("ncols 2000\nnrows 2000\ncellsize 1\n1 2 3", "too short: copy it again"),
        ("ncols 2\nnrows 2\ncellsize 0\n1 2 3 4", "cellsize"),
        ("ncols 2\nnrows 2\n1 2 3 4", "cellsize"),
        ("ncols -2\nnrows 2\ncellsize 1\n1 2 3 4", "no usable ncols"),
        ("ncols 2\nnrows 2\ncellsize 1\n1 2 x 4", "line 4: \"x\" is not a number"),
        ("ncols 2\nnrows 2\ncellsize 1\n1 2 3 4 5", "line 4: there are more than 2 x 2 values"),
        ("ncols 2\nnrows 2\ncellsize 1\n1 2 3    ", "3 values instead of 2 x 2"),
        ("ncols 2\nnrows 2\ncellsize 1\nnan nan nan nan", "no point has data"),
        ("ncols 2\nnrows 2\ncellsize 1\n1 2 3 1e30", "12000 m high or deep"),
        ("1 2\n3 4", "line 1: a point is x, y and z"),
        ("1 2 3\n3 4 5", "2 lines of x, y and z"),
        ("1 1 -1\n2 2 -2\n3 3 -3\n4.2 4.2 -4\n5.7 5.7 -2\n", "no point has data"),
        ("1e200 2 3\n", "is no place"),
        ("", "0 lines"),
        ("a\nb\nc", "0 lines"),
        ("II*\0", "within its tags"),
        ("PK\x03\x04", "unpack it first"),
        ("CDF\x01", "within its header"),
    ] {
        let reason = refusal(text.as_bytes());
        assert!(reason.contains(says), "{text:?}: {reason}");
    }
    assert!(refusal(&[0xff; 100]).contains("no bathymetry that can be read"));
    assert!(refusal(&b"II+\0\x08\0\0\0\x10\0\0\0".repeat(4)).contains("BigTIFF"));
}

#[test]
fn a_tiff_that_claims_too_much_is_refused_before_memory_is_asked_for() {
    use ::tiff::encoder::DeflateLevel;
    let whole = geotiff(Compression::Deflate(DeflateLevel::Fast), Predictor::None, &from_north(6, 8), 6, [0.0; 2]);
    let with = |tag: u16, value: u32| {
        let mut bytes = whole.clone();
        let directory = u32::from_le_bytes(bytes[4..8].try_into().expect("four bytes")) as usize;
        let count = usize::from(bytes[directory]);
        let entry = (0..count).map(|i| directory + 2 + 12 * i);
        let at = entry.into_iter().find(|at| bytes[*at..*at + 2] == tag.to_le_bytes()).expect("the tag");
        bytes[at + 8..at + 12].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    assert!(refusal(&with(256, 4_000_000_000)).contains("at most 8388608 are read"));
    assert!(refusal(&with(256, 2000)).contains("damaged or too short"));
    assert!(refusal(&with(257, 1_000_000)).contains("list of its strips or tiles is too short"));
    assert!(refusal(&with(259, 7)).contains("compression 7 is not read"));
    assert!(refusal(&with(273, u32::MAX)).contains("file ends before"));
    // Any cut and any changed byte is read or refused in one sentence.
    for end in 0..whole.len() {
        let _ = open("a.tif", &whole[..end]).map_err(|reason| assert!(reason.starts_with("a.tif: "), "{reason}"));
    }
    for i in 0..whole.len() {
        for flip in [0x01, 0x80, 0xff] {
            let mut bytes = whole.clone();
            bytes[i] ^= flip;
            let _ = open("a.tif", &bytes).map_err(|reason| assert!(reason.starts_with("a.tif: "), "{reason}"));
        }
    }
}
