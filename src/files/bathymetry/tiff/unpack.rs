//! The packings of strips and tiles: none, LZW, PackBits, Deflate.

/// How the bytes of a strip or tile are packed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Packing {
    None,
    Lzw,
    PackBits,
    Deflate,
}

impl Packing {
    pub(super) fn of_code(code: usize) -> Result<Self, String> {
        match code {
            1 => Ok(Self::None),
            5 => Ok(Self::Lzw),
            8 | 32_946 => Ok(Self::Deflate),
            32_773 => Ok(Self::PackBits),
            _ => Err(format!(
                "its compression {code} is not read: save it with COMPRESS=DEFLATE, for example with gdal_translate"
            )),
        }
    }
}

/// Unpacks bytes; the result has `size` bytes.
///
/// # Errors
/// One sentence, if the packed bytes are damaged or give fewer.
pub(super) fn unpack(packing: Packing, packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let mut out = match packing {
        Packing::None => packed[..packed.len().min(size)].to_vec(),
        Packing::PackBits => unpack_bits(packed, size),
        Packing::Lzw => unpack_lzw(packed, size),
        // A stream that would give more than the size ends there.
        Packing::Deflate => {
            miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(packed, size).unwrap_or_else(|fault| fault.output)
        }
    };
    if out.len() < size {
        return Err("a strip or tile is damaged or too short: copy the file again".into());
    }
    out.truncate(size);
    Ok(out)
}

/// PackBits: a count of literal bytes, or of repetitions of one byte.
fn unpack_bits(packed: &[u8], size: usize) -> Vec<u8> {
    let (mut out, mut rest) = (Vec::new(), packed);
    while let [head, tail @ ..] = rest {
        let count = usize::from(*head);
        rest = tail;
        if count < 128 {
            let literal = &rest[..rest.len().min(count + 1)];
            out.extend_from_slice(literal);
            rest = &rest[literal.len()..];
        } else if let (129.., [byte, tail @ ..]) = (count, rest) {
            out.resize(out.len() + 257 - count, *byte);
            rest = tail;
        }
        if out.len() >= size {
            break;
        }
    }
    out
}

/// LZW as in TIFF 6.0, section 13: codes of 9 to 12 bits, the largest bit first; 256 clears the table, 257 ends.
fn unpack_lzw(packed: &[u8], size: usize) -> Vec<u8> {
    /// Number of codes of 12 bits.
    const CODES: usize = 4096;
    let mut out: Vec<u8> = Vec::new();
    // Where the string of each code stands in the output. Codes below 258 have none: they are single bytes.
    let mut strings: Vec<(usize, usize)> = Vec::with_capacity(CODES);
    let (mut bits, mut held, mut width) = (0_u32, 0, 9);
    let mut before: Option<(usize, usize)> = None;
    for byte in packed {
        bits = bits << 8 | u32::from(*byte);
        held += 8;
        if held < width {
            continue;
        }
        held -= width;
        let code = (bits >> held) as usize & ((1 << width) - 1);
        bits &= (1 << held) - 1;
        if code == 257 || out.len() >= size {
            break;
        }
        if code == 256 {
            strings.clear();
            (width, before) = (9, None);
            continue;
        }
        let start = out.len();
        if code < 256 {
            out.push(code as u8);
        } else if let Some(&(at, length)) = strings.get(code - 258) {
            out.extend_from_within(at..at + length);
        } else {
            // The string that is about to be added: the one before, and its own first byte.
            let Some((at, length)) = before.filter(|_| code == 258 + strings.len()) else { break };
            out.extend_from_within(at..at + length);
            out.push(out[at]);
        }
        if let Some((at, length)) = before.filter(|_| 258 + strings.len() < CODES) {
            // The string before stands directly before this one, whose first byte belongs to it.
            strings.push((at, length + 1));
        }
        before = Some((start, out.len() - start));
        // Codes grow one code early.
        width = match 258 + strings.len() + 1 {
            0..512 => 9,
            512..1024 => 10,
            1024..2048 => 11,
            _ => 12,
        };
    }
    out
}
