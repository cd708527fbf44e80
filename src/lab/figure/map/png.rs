//! PNG files with a palette, and their text form inside SVG.

use super::palette::Colour;
use std::collections::HashMap;

/// Colours of a reduced picture: enough for the bands of four maps and the smooth edges of lines and letters, and few
/// enough for a small file.
const MAX_COLOURS: usize = 40;

/// Encodes a picture of palette indices, row by row from the top.
pub(super) fn indexed(width: usize, indices: &[u8], colours: &[Colour]) -> Result<Vec<u8>, String> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width as u32, (indices.len() / width) as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(colours.concat());
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header().map_err(|e| e.to_string())?;
    writer.write_image_data(indices).map_err(|e| e.to_string())?;
    writer.finish().map_err(|e| e.to_string())?;
    Ok(out)
}

/// Encodes a picture of red, green and blue with at most [`MAX_COLOURS`] colours beside those in `kept`: the most frequent
/// ones, each other colour as the nearest of them.
pub(super) fn reduced(width: usize, pixels: &[u8], kept: &[Colour]) -> Result<Vec<u8>, String> {
    let mut counts: HashMap<Colour, usize> = HashMap::new();
    for pixel in pixels.chunks_exact(3) {
        *counts.entry([pixel[0], pixel[1], pixel[2]]).or_default() += 1;
    }
    let often = pixels.len() / 3 / 4000;
    // Rare colours are told apart by as many bits a channel, from five down to two, as the palette has room for.
    let grouped = |bits: u32| {
        let (lost, middle) = (0xff_u8 >> bits, 0x80_u8 >> bits);
        let mut groups: HashMap<Colour, usize> = HashMap::new();
        for (colour, count) in &counts {
            let group = if *count > often { *colour } else { colour.map(|c| c & !lost | middle) };
            *groups.entry(group).or_default() += count;
        }
        groups
    };
    let groups = (2..=5).rev().map(grouped).find(|groups| groups.len() <= MAX_COLOURS).unwrap_or_else(|| grouped(2));
    let mut colours: Vec<(Colour, usize)> = groups.into_iter().collect();
    // The colour decides among equally frequent ones, so that a figure is always the same file.
    colours.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
    colours.truncate(MAX_COLOURS);
    // Colours that are used stay, however rare: a band of a few pixels keeps its meaning.
    let mut palette: Vec<Colour> = kept.to_vec();
    palette.extend(colours.into_iter().map(|c| c.0));
    palette.sort_unstable();
    palette.dedup();
    palette.truncate(256);
    let colours = palette;
    let mut known: HashMap<Colour, u8> = HashMap::new();
    let nearest = |colour: Colour| {
        let distance = |c: &Colour| (0..3).map(|i| (i32::from(c[i]) - i32::from(colour[i])).pow(2)).sum::<i32>();
        (0..colours.len()).min_by_key(|i| distance(&colours[*i])).unwrap_or_default() as u8
    };
    let indices: Vec<u8> = pixels
        .chunks_exact(3)
        .map(|p| *known.entry([p[0], p[1], p[2]]).or_insert_with(|| nearest([p[0], p[1], p[2]])))
        .collect();
    indexed(width, &indices, &colours)
}

/// Bytes as Base64 (RFC 4648).
pub(super) fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for piece in bytes.chunks(3) {
        let word = piece.iter().fold(0_u32, |word, b| word << 8 | u32::from(*b)) << (8 * (3 - piece.len()));
        for place in 0..4 {
            let is_padding = place > piece.len();
            let letter = LETTERS[(word >> (18 - 6 * place)) as usize & 63];
            out.push(if is_padding { '=' } else { char::from(letter) });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_become_letters() {
        // The test vectors of RFC 4648.
        for (bytes, text) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    #[test]
    fn few_colours_are_kept_and_many_are_reduced() {
        let few: Vec<u8> = (0..60).flat_map(|i| if i % 3 == 0 { [1, 2, 3] } else { [200, 100, 7] }).collect();
        let back = image::load_from_memory(&reduced(10, &few, &[]).expect("a file")).expect("a picture").to_rgb8();
        assert_eq!((back.dimensions(), back.into_raw()), ((10, 6), few));
        let many: Vec<u8> = (0..64 * 64).flat_map(|i| [(i % 64 * 4) as u8, (i / 64 * 4) as u8, 90]).collect();
        let back =
            image::load_from_memory(&reduced(64, &many, &[[9, 9, 9]]).expect("a file")).expect("a picture").to_rgb8();
        let worst = back.into_raw().iter().zip(&many).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(worst <= Some(64), "{worst:?}");
    }
}
