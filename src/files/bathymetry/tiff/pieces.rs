//! The strips or tiles of an image, and the numbers in them.

use super::tags::{Directory, word};
use super::unpack::{self, Packing};

/// Largest strip or tile, bytes.
const MAX_PIECE_BYTES: usize = 64 << 20;
/// Largest number of bytes of all strips or tiles together: tiles may reach beyond the image.
const MAX_BYTES: usize = 256 << 20;

/// What the bits of a sample mean.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sample {
    Unsigned,
    Signed,
    Float,
}

/// How the samples of an image lie in the file.
pub(super) struct Layout {
    /// Width of the image, pixels.
    pub columns: usize,
    /// Height of the image, pixels.
    pub rows: usize,
    /// Width and height of a strip or tile, pixels.
    piece: [usize; 2],
    /// Whether strips end with the image instead of being filled up, as tiles are.
    has_strips: bool,
    /// Positions and lengths of the strips or tiles of the first band, bytes.
    places: Vec<(usize, usize)>,
    packing: Packing,
    predictor: usize,
    sample: Sample,
    sample_bytes: usize,
    /// Samples of a pixel within a piece, of which the first is read.
    samples_per_pixel: usize,
    is_little_endian: bool,
}

impl Layout {
    pub(super) fn read(directory: &Directory<'_>) -> Result<Self, String> {
        let needed = |tag: u16, what: &str| {
            let value = directory.whole(tag)?.filter(|v| *v > 0);
            value.ok_or_else(|| format!("the image has no usable {what}"))
        };
        let or = |tag: u16, default: usize| Ok::<usize, String>(directory.whole(tag)?.unwrap_or(default));
        let (columns, rows) = (needed(256, "width")?, needed(257, "height")?);
        super::checked_count(columns, rows)?;
        let packing = Packing::of_code(or(259, 1)?)?;
        let (bits, samples_per_pixel) = (or(258, 1)?, or(277, 1)?.max(1));
        let sample = match or(339, 1)? {
            1 => Sample::Unsigned,
            2 => Sample::Signed,
            3 => Sample::Float,
            _ => return Err("its samples are neither whole nor floating-point numbers: save them as Float32".into()),
        };
        let is_known = if sample == Sample::Float { [32, 64].contains(&bits) } else { [8, 16, 32].contains(&bits) };
        if !is_known || directory.numbers(258)?.iter().any(|b| *b != bits as f64) {
            return Err(format!("samples of {bits} bits are not read: save them as Float32 or Int16"));
        }
        // Bands in planes of their own: only the first plane is read.
        let samples_per_pixel = if or(284, 1)? == 2 { 1 } else { samples_per_pixel };
        let has_strips = directory.whole(322)?.is_none();
        let piece = if has_strips {
            [columns, or(278, rows)?.clamp(1, rows)]
        } else {
            [needed(322, "width of its tiles")?, needed(323, "height of its tiles")?]
        };
        let (offsets, lengths) = if has_strips { (273, 279) } else { (324, 325) };
        let (offsets, lengths) = (directory.numbers(offsets)?, directory.numbers(lengths)?);
        let count = columns.div_ceil(piece[0]) * rows.div_ceil(piece[1]);
        if offsets.len() < count || lengths.len() < count {
            return Err("the list of its strips or tiles is too short: save it again".into());
        }
        let places =
            offsets.iter().zip(&lengths).take(count).map(|(at, length)| (*at as usize, *length as usize)).collect();
        let sample_bytes = bits / 8;
        let piece_bytes = (piece[0].checked_mul(piece[1]))
            .and_then(|pixels| pixels.checked_mul(sample_bytes)?.checked_mul(samples_per_pixel));
        let all_bytes = piece_bytes.and_then(|bytes| bytes.checked_mul(count));
        if piece_bytes.is_none_or(|b| b > MAX_PIECE_BYTES) || all_bytes.is_none_or(|b| b > MAX_BYTES) {
            return Err(format!(
                "its strips or tiles unpack to more than {} MiB each or {} MiB together: save it with one band, in tiles \
                 of 256 x 256",
                MAX_PIECE_BYTES >> 20,
                MAX_BYTES >> 20
            ));
        }
        let is_little_endian = directory.is_little_endian;
        let predictor = or(317, 1)?;
        let is_known = match predictor {
            1 => true,
            2 => sample != Sample::Float,
            3 => sample == Sample::Float,
            _ => false,
        };
        if !is_known {
            return Err(format!("its predictor {predictor} is not read: save it with PREDICTOR=1"));
        }
        Ok(Self {
            columns,
            rows,
            piece,
            has_strips,
            places,
            packing,
            predictor,
            sample,
            sample_bytes,
            samples_per_pixel,
            is_little_endian,
        })
    }

    /// The samples of the first band, row by row from the top.
    pub(super) fn values(&self, bytes: &[u8]) -> Result<Vec<f32>, String> {
        let [width, height] = self.piece;
        let pixel_bytes = self.sample_bytes * self.samples_per_pixel;
        let pieces_across = self.columns.div_ceil(width);
        // Pieces lie in the file, so that a short file that promises a large image asks for no memory.
        let piece = |(at, length): (usize, usize)| at.checked_add(length).and_then(|end| bytes.get(at..end));
        if self.places.iter().any(|place| piece(*place).is_none()) {
            return Err("the file ends before its strips or tiles: copy it again".into());
        }
        let mut values = vec![f32::NAN; self.columns * self.rows];
        for (index, place) in self.places.iter().enumerate() {
            let (left, top) = (index % pieces_across * width, index / pieces_across * height);
            let high = if self.has_strips { height.min(self.rows - top) } else { height };
            let packed = piece(*place).unwrap_or_default();
            // GDAL leaves out pieces without data.
            if packed.is_empty() {
                continue;
            }
            let mut unpacked = unpack::unpack(self.packing, packed, width * high * pixel_bytes)?;
            for (j, row) in unpacked.chunks_exact_mut(width * pixel_bytes).enumerate().take(self.rows - top) {
                self.undo_predictor(row);
                let out = &mut values[(top + j) * self.columns..(top + j + 1) * self.columns][left..];
                for (out, pixel) in out.iter_mut().zip(row.chunks_exact(pixel_bytes)) {
                    *out = self.number(&pixel[..self.sample_bytes]);
                }
            }
        }
        Ok(values)
    }

    fn number(&self, bytes: &[u8]) -> f32 {
        // The third predictor leaves the largest byte first.
        let word = word(bytes, self.is_little_endian && self.predictor != 3);
        match (self.sample, bytes.len()) {
            (Sample::Float, 4) => f32::from_bits(word as u32),
            (Sample::Float, _) => f64::from_bits(word) as f32,
            (Sample::Signed, 1) => f32::from(word as u8 as i8),
            (Sample::Signed, 2) => f32::from(word as u16 as i16),
            (Sample::Signed, _) => word as u32 as i32 as f32,
            (Sample::Unsigned, _) => word as f32,
        }
    }

    /// Turns the differences of a row back into samples.
    fn undo_predictor(&self, row: &mut [u8]) {
        let (size, per_pixel) = (self.sample_bytes, self.samples_per_pixel);
        match self.predictor {
            2 => {
                // Each sample is the difference from that of the pixel before.
                for at in (size * per_pixel..row.len()).step_by(size) {
                    let before = at - size * per_pixel;
                    let sum = word(&row[at..at + size], self.is_little_endian)
                        .wrapping_add(word(&row[before..before + size], self.is_little_endian));
                    for (i, byte) in row[at..at + size].iter_mut().enumerate() {
                        *byte = (sum >> (8 * if self.is_little_endian { i } else { size - 1 - i })) as u8;
                    }
                }
            }
            3 => {
                // The first bytes of all samples, then the second ones and so on, each the difference from the byte
                // before of the same band.
                for at in per_pixel..row.len() {
                    row[at] = row[at].wrapping_add(row[at - per_pixel]);
                }
                let planes = row.to_vec();
                let count = row.len() / size;
                for (i, sample) in row.chunks_exact_mut(size).enumerate() {
                    sample.iter_mut().enumerate().for_each(|(byte, out)| *out = planes[byte * count + i]);
                }
            }
            _ => {}
        }
    }
}
