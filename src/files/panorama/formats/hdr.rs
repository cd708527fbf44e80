//! Radiance files (.hdr; G. Ward, "Real pixels", Graphics Gems II, 1991): a header of text lines, then run-length
//! encoded rows of pixels with a shared exponent (RGBE).

use super::limits::{TOO_SHORT_MESSAGE, allocate, check_size};
use crate::files::panorama::sky_image::SkyImage;

/// Longest header of a Radiance file, bytes.
const MAX_HEADER_BYTES: usize = 64 * 1024;
/// Image widths, pixels, for which a row may be run-length encoded channel by channel (red, green, blue, exponent); in
/// rows of other widths only whole pixels can be repeated.
const CHANNEL_RLE_WIDTHS_PX: std::ops::Range<usize> = 8..0x8000;

const UNENDED_HEADER_MESSAGE: &str = "its header does not end: save it again";
const RUN_OVERFLOW_MESSAGE: &str = "a run of pixels does not fit its row: save it again";

/// Whether a file begins with the signature of a Radiance file.
pub(super) fn is_radiance_file(bytes: &[u8]) -> bool {
    bytes.starts_with(b"#?RADIANCE") || bytes.starts_with(b"#?RGBE")
}

pub(super) fn decode(bytes: &[u8], max_size: [usize; 2]) -> Result<SkyImage, String> {
    let mut rest = bytes;
    let (width, height) = read_header(&mut rest)?;
    check_size([width, height], max_size)?;
    // Even the shortest encoded row has eight bytes, the size of two pixels.
    if rest.len() / 8 < height {
        return Err(TOO_SHORT_MESSAGE.to_owned());
    }
    let mut pixels = allocate(width * height)?;
    let mut row = vec![[0; 4]; width];
    for _ in 0..height {
        read_row(&mut rest, &mut row)?;
        pixels.extend(row.iter().map(|p| rgbe_to_linear(*p)));
    }
    Ok(SkyImage { width, height, pixels })
}

/// Takes one RGBE pixel (three mantissas, exponent) off the front of `rest`, what is unread of the file; an error at
/// its end.
fn take_pixel(rest: &mut &[u8]) -> Result<[u8; 4], String> {
    let (pixel, after) = rest.split_first_chunk().ok_or(TOO_SHORT_MESSAGE)?;
    *rest = after;
    Ok(*pixel)
}

/// Takes one header line, without its line end, off the front of `rest`, the unread part of the file.
fn take_line<'a>(rest: &mut &'a [u8]) -> Result<&'a [u8], String> {
    let end = rest.iter().take(MAX_HEADER_BYTES).position(|b| *b == b'\n').ok_or(UNENDED_HEADER_MESSAGE)?;
    let line = &rest.split_off(..=end).ok_or(UNENDED_HEADER_MESSAGE)?[..end];
    Ok(line.strip_suffix(b"\r").unwrap_or(line))
}

/// Takes the Radiance header off `rest`, the unread file; returns width and height, pixels. Only RGBE colours are read.
fn read_header(rest: &mut &[u8]) -> Result<(usize, usize), String> {
    let whole = rest.len();
    loop {
        let line = take_line(rest)?;
        if line.is_empty() {
            break;
        }
        if line.strip_prefix(b"FORMAT=").is_some_and(|format| format.trim_ascii() != b"32-bit_rle_rgbe") {
            return Err("its colours are not RGBE: save it as Radiance RGBE or as OpenEXR".to_owned());
        }
        if whole - rest.len() > MAX_HEADER_BYTES {
            return Err(UNENDED_HEADER_MESSAGE.to_owned());
        }
    }
    let line = String::from_utf8_lossy(take_line(rest)?);
    let words: Vec<&str> = line.split_whitespace().collect();
    match words[..] {
        ["-Y", height, "+X", width] => {
            let number = |text: &str| text.parse().map_err(|_| "its size is not a number: save it again".to_owned());
            Ok((number(width)?, number(height)?))
        }
        _ => Err("its pixels do not run from the top down, left to right (-Y … +X …): save it so".to_owned()),
    }
}

fn read_row(rest: &mut &[u8], row: &mut [[u8; 4]]) -> Result<(), String> {
    let first = take_pixel(rest)?;
    if CHANNEL_RLE_WIDTHS_PX.contains(&row.len()) && first[0] == 2 && first[1] == 2 && first[2] < 128 {
        if usize::from(first[2]) << 8 | usize::from(first[3]) != row.len() {
            return Err("the length of a row differs from the width of the image: save it again".to_owned());
        }
        return (0..4).try_for_each(|channel| read_channel(rest, row, channel));
    }
    read_row_in_old_encoding(rest, first, row)
}

/// Reads one channel (0 red, 1 green, 2 blue, 3 exponent) of a run-length encoded row from `rest`, the unread file,
/// into `row`: runs of one value, and sequences of single values.
fn read_channel(rest: &mut &[u8], row: &mut [[u8; 4]], channel: usize) -> Result<(), String> {
    let mut at = 0;
    while at < row.len() {
        let count = *rest.split_off_first().ok_or(TOO_SHORT_MESSAGE)?;
        let length = usize::from(if count > 128 { count - 128 } else { count });
        let place = row.get_mut(at..at + length).filter(|_| length > 0).ok_or(RUN_OVERFLOW_MESSAGE)?;
        if count > 128 {
            let value = *rest.split_off_first().ok_or(TOO_SHORT_MESSAGE)?;
            place.iter_mut().for_each(|p| p[channel] = value);
        } else {
            place
                .iter_mut()
                .zip(rest.split_off(..length).ok_or(TOO_SHORT_MESSAGE)?)
                .for_each(|(p, value)| p[channel] = *value);
        }
        at += length;
    }
    Ok(())
}

/// Reads a row of RGBE pixels in the old encoding, from `first`, its first pixel, on: a pixel (1, 1, 1, n) stands for n
/// repetitions of the pixel before it, times 256 for each such pixel directly before this one.
fn read_row_in_old_encoding(rest: &mut &[u8], first: [u8; 4], row: &mut [[u8; 4]]) -> Result<(), String> {
    let (mut at, mut shift) = (0_usize, 0);
    let mut next = first;
    loop {
        if next[..3] == [1; 3] {
            let before = *at.checked_sub(1).and_then(|i| row.get(i)).ok_or(RUN_OVERFLOW_MESSAGE)?;
            // A fourth repetition in succession cannot fit, and its shift could overflow.
            let length = if shift < 24 { usize::from(next[3]) << shift } else { row.len() + 1 };
            row.get_mut(at..at + length).ok_or(RUN_OVERFLOW_MESSAGE)?.fill(before);
            (at, shift) = (at + length, shift + 8);
        } else {
            row[at] = next;
            (at, shift) = (at + 1, 0);
        }
        if at == row.len() {
            return Ok(());
        }
        next = take_pixel(rest)?;
    }
}

/// Converts an RGBE pixel to linear red, green and blue: mantissa / 256 x 2^(exponent - 128); black if exponent is 0.
fn rgbe_to_linear([r, g, b, exponent]: [u8; 4]) -> [f32; 3] {
    let unit = if exponent == 0 { 0.0 } else { 2f32.powi(i32::from(exponent) - 136) };
    [r, g, b].map(|mantissa| f32::from(mantissa) * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(width: usize, height: usize, rows: &[u8]) -> Vec<u8> {
        let head = format!("#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n");
        [head.as_bytes(), rows].concat()
    }

    fn decoded(width: usize, height: usize, rows: &[u8]) -> Result<Vec<[f32; 3]>, String> {
        decode(&file(width, height, rows), [1000, 500]).map(|image| image.pixels)
    }

    #[test]
    fn old_runs_new_runs_and_bare_pixels_are_read() {
        // The colour (1, 0.5, 0.25) in RGBE: mantissas with the shared exponent 129.
        let (p, want) = ([128, 64, 32, 129], [1.0, 0.5, 0.25]);
        let (dark, none) = ([128, 64, 32, 0], [0.0; 3]);
        let bare = [p, dark].concat().repeat(8 * 8);
        let got = decoded(16, 8, &bare).expect("bare pixels");
        assert!((got.len(), got[0], got[1], got[127]) == (128, want, none, none));
        // Rows of one pixel and a run of 15, then of one pixel and runs of 3 and 256.
        let old = [p, [1, 1, 1, 15]].concat().repeat(8);
        assert_eq!(decoded(16, 8, &old), Ok(vec![want; 128]));
        let long = [p, [1, 1, 1, 3], [1, 1, 1, 1]].concat().repeat(130);
        assert_eq!(decoded(260, 130, &long), Ok(vec![want; 260 * 130]));
        let row = [&[2, 2, 0, 16][..], &[144, 128], &[128 + 15, 64, 1, 64], &[144, 32], &[144, 129]].concat();
        assert_eq!(decoded(16, 8, &row.repeat(8)), Ok(vec![want; 128]));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let head = [2, 2, 0, 16];
        for (rows, what) in [
            (vec![0; 60], TOO_SHORT_MESSAGE),
            (vec![7; 100], TOO_SHORT_MESSAGE),
            ([1, 1, 1, 5].repeat(40), RUN_OVERFLOW_MESSAGE),
            ([9, 9, 9, 9, 1, 1, 1, 16].repeat(40), RUN_OVERFLOW_MESSAGE),
            // An empty repetition also shifts the count of the next one.
            ([vec![9; 4], [1, 1, 1, 0].repeat(9), [1, 1, 1, 1].repeat(60)].concat(), RUN_OVERFLOW_MESSAGE),
            ([&head[..], &[145, 7]].concat().repeat(40), RUN_OVERFLOW_MESSAGE),
            ([&head[..], &[0; 200]].concat(), RUN_OVERFLOW_MESSAGE),
            ([&head[..], &[128; 200]].concat(), RUN_OVERFLOW_MESSAGE),
            ([2, 2, 0, 17].repeat(40), "length of a row"),
        ] {
            assert!(decoded(16, 8, &rows).is_err_and(|e| e.contains(what)), "{rows:?}: {:?}", decoded(16, 8, &rows));
        }
    }

    #[test]
    fn headers_that_lie_are_refused_before_memory_is_asked_for() {
        for (head, what) in [
            (
                "#?RADIANCE\n\n-Y 500000 +X 1000000\n",
                "1000000 x 500000 pixels, but at most 1000 x 500 are read: save it smaller",
            ),
            ("#?RADIANCE\n\n-Y 99999999999999999999 +X 3\n", "not a number"),
            ("#?RADIANCE\n\n-Y -8 +X 16\n", "not a number"),
            ("#?RADIANCE\n\n+Y 8 +X 16\n", "top down"),
            ("#?RADIANCE\n\n", "does not end"),
            ("#?RADIANCE\n", "does not end"),
            ("#?RGBE\n\n-Y 0 +X 0\n", "too few"),
            ("#?RGBE\n\n-Y 500 +X 1000\n", TOO_SHORT_MESSAGE),
            ("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 8 +X 16\n", "save it as Radiance RGBE"),
        ] {
            let got = decode(head.as_bytes(), [1000, 500]);
            assert!(got.as_ref().is_err_and(|e| e.contains(what)), "{head}: {got:?}");
        }
        let endless = [&b"#?RADIANCE\n"[..], &b"a=b\n".repeat(40_000)].concat();
        assert!(decode(&endless, [1000, 500]).is_err_and(|e| e.contains("does not end")));
    }
}
