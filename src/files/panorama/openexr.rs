//! OpenEXR's .exr: what the header claims is held against the limits and the file's length before the crate `exr` decodes it.

use super::read::{Pixels, check_size, room};
use exr::error::Error;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, magic_number};
use exr::prelude::*;
use std::io::Cursor;
use std::result::Result;

/// Most bytes of a block of pixels, which are decoded at once.
const MAX_BLOCK: usize = 256 << 20;
/// Pictures of fewer pixels are decoded at once on this thread.
const SMALL: usize = 1 << 20;

pub(super) fn begins(bytes: &[u8]) -> bool {
    bytes.starts_with(&magic_number::BYTES)
}

pub(super) fn decode(bytes: &[u8], most: [usize; 2]) -> Result<Pixels, String> {
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(|e| said(&e))?;
    for header in reader.headers() {
        check(header, bytes.len(), most)?;
    }
    let colours = |header: &&Header| {
        let has = |name: &str| header.channels.find_index_of_channel(&Text::from(name)).is_some();
        !header.deep && ["R", "G", "B"].into_iter().all(has)
    };
    let header = reader.headers().iter().find(colours).ok_or("it has no layer with the channels R, G and B")?;
    let window = header.shared_attributes.display_window;
    let (width, height) = (window.size.width(), window.size.height());
    check_size([width, height], most)?;
    room(width * height)?;
    // Where the data begins in the picture: it may stand out, or leave an edge free.
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
    let layers = if width * height < SMALL { layers.non_parallel() } else { layers };
    let image = layers.from_chunks(reader).map_err(|e| said(&e))?;
    Ok((width, height, image.layer_data.channel_data.pixels))
}

/// Refuses a layer by what it claims.
fn check(header: &Header, file_bytes: usize, most: [usize; 2]) -> Result<(), String> {
    // Data may reach a little beyond the picture.
    for size in [header.layer_size, header.shared_attributes.display_window.size] {
        if size.width() > most[0] || size.height() > most[1] {
            let ([columns, rows], (width, height)) = (most, (size.width(), size.height()));
            return Err(format!("{width} x {height} pixels, where {columns} x {rows} are read: save it smaller"));
        }
    }
    let block = match header.blocks {
        BlockDescription::Tiles(tiles) => [tiles.tile_size.width(), tiles.tile_size.height()],
        BlockDescription::ScanLines => [header.layer_size.width(), header.compression.scan_lines_per_block()],
    };
    let bytes = block[0].checked_mul(block[1]).and_then(|n| n.checked_mul(header.channels.bytes_per_pixel));
    if bytes.is_none_or(|n| n > MAX_BLOCK) {
        let mib = MAX_BLOCK >> 20;
        return Err(format!(
            "one of its blocks of pixels is larger than {mib} MiB: save it as scanlines with ZIP, or in smaller tiles"
        ));
    }
    // Each block has its place in the file's table.
    if header.chunk_count > file_bytes / 8 {
        return Err("it ends too early: download or save it again".to_owned());
    }
    Ok(())
}

/// An error of the decoder on one line.
fn said(error: &Error) -> String {
    match error {
        Error::Invalid(what) if what.contains("missing bytes") => {
            "it ends too early: download or save it again".to_owned()
        }
        Error::Io(e) if e.kind() == std::io::ErrorKind::UnexpectedEof => {
            "it ends too early: download or save it again".to_owned()
        }
        Error::Invalid(what) => format!("it is broken: {}", line(what)),
        Error::NotSupported(what) => format!("this form of OpenEXR is not read: {}", line(what)),
        other => line(&other.to_string()),
    }
}

fn line(text: &str) -> String {
    text.lines().next().unwrap_or("no reason given").to_owned()
}
