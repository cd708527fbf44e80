//! Saved pictures: PNG files that carry their state string in a text chunk.

use super::MAX_STATE_BYTES;
use std::io::Cursor;

/// Keyword of the PNG text chunk that holds the state string.
const STATE_KEYWORD: &str = "seastate";
/// Largest memory that a PNG's parts before its pixels may take, bytes; one of these parts holds the state string.
const MAX_DECODER_BYTES: usize = 4 * 1024 * 1024;

/// Encodes a picture of `size` (width, height) from RGBA `pixels`, 8 bits each, as a PNG without alpha. Its text chunks
/// hold the state string `state` and, unless it is empty, `link`, the URL of this state.
///
/// # Errors
/// One sentence, if the pixels do not fit the size.
pub fn encode(size: [u32; 2], pixels: &[u8], state: &str, link: &str) -> Result<Vec<u8>, String> {
    let mut out = Vec::new();
    let mut info = png::Encoder::new(&mut out, size[0], size[1]);
    info.set_color(png::ColorType::Rgb);
    info.set_depth(png::BitDepth::Eight);
    let fault = |e: png::EncodingError| format!("the picture cannot be written: {e}");
    info.add_itxt_chunk(STATE_KEYWORD.into(), state.into()).map_err(fault)?;
    info.add_text_chunk("Software".into(), concat!("Seastate ", env!("CARGO_PKG_VERSION")).into()).map_err(fault)?;
    if !link.is_empty() {
        info.add_itxt_chunk("Source".into(), link.into()).map_err(fault)?;
    }
    let mut writer = info.write_header().map_err(fault)?;
    let rgb: Vec<u8> = pixels.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    writer.write_image_data(&rgb).map_err(fault)?;
    writer.finish().map_err(fault)?;
    Ok(out)
}

/// Whether a file begins with the signature of a PNG.
pub fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x89PNG\r\n\x1a\n")
}

/// Reads the state string from the text chunk of a PNG picture. The pixels are not decoded.
///
/// # Errors
/// One sentence, if the file is not a PNG, or has no state string or too long a one.
pub fn state_from_png(bytes: &[u8]) -> Result<String, String> {
    let decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: MAX_DECODER_BYTES });
    let reader = decoder.read_info().map_err(|e| format!("this is not a picture that can be decoded: {e}"))?;
    let found = reader.info().utf8_text.iter().find(|t| t.keyword == STATE_KEYWORD);
    let mut chunk = found.ok_or("the picture carries no state: choose one that Seastate saved")?.clone();
    let too_long = || format!("the state in the picture is longer than {MAX_STATE_BYTES} bytes");
    // The limit stops the decompression of text that is larger, perhaps by gigabytes.
    chunk.decompress_text_with_limit(MAX_STATE_BYTES).map_err(|_| too_long())?;
    let text = chunk.get_text().map_err(|e| format!("the state in the picture cannot be read: {e}"))?;
    if text.len() > MAX_STATE_BYTES { Err(too_long()) } else { Ok(text) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_remembers_its_sea() {
        let state = "wind=14&fetch=300&sky=B%C3%BCsum.hdr";
        let bytes = encode([2, 1], &[255, 0, 0, 255, 0, 0, 255, 255], state, "https://example.org/?wind=14")
            .expect("a picture");
        assert_eq!(state_from_png(&bytes).as_deref(), Ok(state));
        assert!(is_png(&bytes));
        let mut reader = png::Decoder::new(Cursor::new(&bytes)).read_info().expect("a picture");
        let mut pixels = [0; 6];
        reader.next_frame(&mut pixels).expect("its pixels");
        assert_eq!(pixels, [255, 0, 0, 0, 0, 255]);
    }

    #[test]
    fn other_files_are_refused() {
        assert!(state_from_png(b"").is_err());
        assert!(state_from_png(b"\x89PNG\r\n\x1a\nnonsense").is_err());
        let mut plain = Vec::new();
        let encoder = png::Encoder::new(&mut plain, 1, 1);
        encoder.write_header().and_then(|mut w| w.write_image_data(&[7])).expect("a picture");
        assert!(state_from_png(&plain).is_err_and(|e| e.contains("carries no state")));
        // A text chunk of 64 KiB that holds 64 MiB of one letter.
        let mut bomb = Vec::new();
        let mut encoder = png::Encoder::new(&mut bomb, 1, 1);
        let mut chunk = png::text_metadata::ITXtChunk::new(STATE_KEYWORD, "x".repeat(1 << 26));
        chunk.compressed = true;
        chunk.compress_text().expect("packed");
        encoder.set_color(png::ColorType::Grayscale);
        let mut writer = encoder.write_header().expect("a picture");
        writer.write_text_chunk(&chunk).expect("a chunk");
        writer.write_image_data(&[7]).expect("a pixel");
        writer.finish().expect("a picture");
        assert!(bomb.len() < 1 << 20, "{}", bomb.len());
        assert!(state_from_png(&bomb).is_err_and(|e| e.contains("longer than")), "{:?}", state_from_png(&bomb));
        let long = encode([1, 1], &[0; 4], &"x".repeat(MAX_STATE_BYTES + 1), "").expect("a picture");
        assert!(state_from_png(&long).is_err_and(|e| e.contains("longer than")));
        let whole = encode([1, 1], &[0; 4], "wind=3", "").expect("a picture");
        for end in 0..whole.len() {
            let _ = state_from_png(&whole[..end]);
        }
    }
}
