//! OpenEXR files (.exr). The header is checked against the limits and the length of the file before the crate `exr`
//! decodes it.

use super::limits::{TOO_SHORT_MESSAGE, allocate, check_size, check_within_limit};
use crate::files::panorama::sky_image::SkyImage;
use exr::error::Error;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, magic_number};
use exr::prelude::*;
use std::io::Cursor;
use std::result::Result;

/// Largest block of pixels in an OpenEXR file that is read, bytes; the decoder holds a whole block in memory.
const MAX_DECODED_BLOCK_BYTES: usize = 256 << 20;
/// Smallest number of pixels of an OpenEXR image that several threads decode; a smaller image is decoded by one.
const MIN_PIXELS_FOR_PARALLEL: usize = 1 << 20;

/// Whether a file begins with the magic number of OpenEXR.
pub(super) fn is_openexr_file(bytes: &[u8]) -> bool {
    bytes.starts_with(&magic_number::BYTES)
}

pub(super) fn decode(bytes: &[u8], max_size: [usize; 2]) -> Result<SkyImage, String> {
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(|e| error_message(&e))?;
    for header in reader.headers() {
        check_header(header, bytes.len(), max_size)?;
    }
    let colours = |header: &&Header| {
        let has = |name: &str| header.channels.find_index_of_channel(&Text::from(name)).is_some();
        !header.deep && ["R", "G", "B"].into_iter().all(has)
    };
    let header = reader.headers().iter().find(colours).ok_or("it has no layer with R, G and B: save it as RGB")?;
    let window = header.shared_attributes.display_window;
    let (width, height) = (window.size.width(), window.size.height());
    check_size([width, height], max_size)?;
    // The decoder aborts if an allocation fails, so an allocation of the same size is tried first.
    allocate(width * height)?;
    // Position of the pixel data in the image. The data may reach beyond the image or leave an edge free.
    let start = [
        i64::from(header.own_attributes.layer_position.x()) - i64::from(window.position.x()),
        i64::from(header.own_attributes.layer_position.y()) - i64::from(window.position.y()),
    ];
    let place = move |at: Vec2<usize>| {
        let x = usize::try_from(at.x() as i64 + start[0]).ok().filter(|x| *x < width)?;
        let y = usize::try_from(at.y() as i64 + start[1]).ok().filter(|y| *y < height)?;
        Some(y * width + x)
    };
    let layers = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            move |_, _| vec![[0f32; 3]; width * height],
            move |pixels: &mut Vec<[f32; 3]>, at, (r, g, b): (f32, f32, f32)| {
                if let Some(pixel) = place(at).and_then(|i| pixels.get_mut(i)) {
                    *pixel = [r, g, b];
                }
            },
        )
        .first_valid_layer()
        .all_attributes();
    let layers = if width * height < MIN_PIXELS_FOR_PARALLEL { layers.non_parallel() } else { layers };
    let image = layers.from_chunks(reader).map_err(|e| error_message(&e))?;
    Ok(SkyImage { width, height, pixels: image.layer_data.channel_data.pixels })
}

/// Returns an error if an OpenEXR header has an image above `max_size` (columns, rows), a block above
/// [`MAX_DECODED_BLOCK_BYTES`], or more blocks than a file of `file_bytes` bytes can hold.
fn check_header(header: &Header, file_bytes: usize, max_size: [usize; 2]) -> Result<(), String> {
    // The data may reach beyond the image, so both sizes are checked.
    for size in [header.layer_size, header.shared_attributes.display_window.size] {
        check_within_limit([size.width(), size.height()], max_size)?;
    }
    let block = match header.blocks {
        BlockDescription::Tiles(tiles) => [tiles.tile_size.width(), tiles.tile_size.height()],
        BlockDescription::ScanLines => [header.layer_size.width(), header.compression.scan_lines_per_block()],
    };
    let bytes = block[0].checked_mul(block[1]).and_then(|n| n.checked_mul(header.channels.bytes_per_pixel));
    if bytes.is_none_or(|n| n > MAX_DECODED_BLOCK_BYTES) {
        let mib = MAX_DECODED_BLOCK_BYTES >> 20;
        return Err(format!(
            "one of its blocks of pixels is larger than {mib} MiB: save it as scanlines with ZIP, or in smaller tiles"
        ));
    }
    // The file has a table with eight bytes for each block.
    if header.chunk_count > file_bytes / 8 {
        return Err(TOO_SHORT_MESSAGE.to_owned());
    }
    Ok(())
}

/// Formats an error of the OpenEXR decoder as a message of one line to the user.
fn error_message(error: &Error) -> String {
    let first_line = |text: &str| text.lines().next().unwrap_or("no reason given").to_owned();
    match error {
        Error::Invalid(what) if what.contains("missing bytes") => TOO_SHORT_MESSAGE.to_owned(),
        Error::Io(e) if e.kind() == std::io::ErrorKind::UnexpectedEof => TOO_SHORT_MESSAGE.to_owned(),
        Error::Invalid(what) => format!("it is broken, save it again: {}", first_line(what)),
        Error::NotSupported(what) => format!("this kind of OpenEXR is not supported: {}", first_line(what)),
        other => first_line(&other.to_string()),
    }
}
