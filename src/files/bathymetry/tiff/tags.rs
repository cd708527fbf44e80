//! The tags of the first image of a TIFF file.

/// Largest number of tags of an image.
const MAX_TAGS: usize = 4096;

/// A tag: its number, the type of its values, and where they lie.
struct Tag {
    number: u16,
    kind: u16,
    count: usize,
    /// Position of the first value, bytes from the start of the file.
    at: usize,
}

/// The tags of the first image.
pub(super) struct Directory<'a> {
    bytes: &'a [u8],
    tags: Vec<Tag>,
    /// Whether numbers begin with their smallest byte.
    pub is_little_endian: bool,
}

/// Bytes of a value of a type; 0 for unknown types.
fn size_of(kind: u16) -> usize {
    match kind {
        1 | 2 | 6 | 7 => 1,
        3 | 8 => 2,
        4 | 9 | 11 => 4,
        5 | 10 | 12 => 8,
        _ => 0,
    }
}

/// Unsigned number of up to eight bytes.
pub(super) fn word(bytes: &[u8], is_little_endian: bool) -> u64 {
    let join = |word: u64, b: &u8| word << 8 | u64::from(*b);
    if is_little_endian { bytes.iter().rev().fold(0, join) } else { bytes.iter().fold(0, join) }
}

impl<'a> Directory<'a> {
    pub(super) fn read(bytes: &'a [u8]) -> Result<Self, String> {
        let is_little_endian = bytes.starts_with(b"II");
        let number = |at: usize, size: usize| -> Result<u64, String> {
            let piece = at.checked_add(size).and_then(|end| bytes.get(at..end));
            Ok(word(piece.ok_or("the file ends within its tags: copy it again")?, is_little_endian))
        };
        match number(2, 2)? {
            42 => {}
            43 => return Err("it is a BigTIFF: save it as TIFF, with gdal_translate -co BIGTIFF=NO".into()),
            _ => return Err("it does not begin as a TIFF file".into()),
        }
        let at = number(4, 4)? as usize;
        let count = number(at, 2)? as usize;
        if count > MAX_TAGS {
            return Err(format!("{count} tags, but at most {MAX_TAGS} are read"));
        }
        let mut tags = Vec::with_capacity(count);
        for entry in (0..count).map(|i| at + 2 + 12 * i) {
            let (kind, count) = (number(entry + 2, 2)? as u16, number(entry + 4, 4)? as usize);
            let fits = count.checked_mul(size_of(kind)).is_some_and(|bytes| bytes <= 4);
            let at = if fits { entry + 8 } else { number(entry + 8, 4)? as usize };
            tags.push(Tag { number: number(entry, 2)? as u16, kind, count, at });
        }
        Ok(Self { bytes, tags, is_little_endian })
    }

    /// The values of a tag as numbers; none if the image lacks it.
    pub(super) fn numbers(&self, number: u16) -> Result<Vec<f64>, String> {
        let Some((tag, values)) = self.values(number)? else { return Ok(Vec::new()) };
        let number = |b: &[u8]| {
            let word = word(b, self.is_little_endian);
            match tag.kind {
                6 => f64::from(word as u8 as i8),
                8 => f64::from(word as u16 as i16),
                9 => f64::from(word as u32 as i32),
                11 => f64::from(f32::from_bits(word as u32)),
                12 => f64::from_bits(word),
                _ => word as f64,
            }
        };
        Ok(values.chunks_exact(size_of(tag.kind)).map(number).collect())
    }

    /// The first value of a tag as a whole number.
    pub(super) fn whole(&self, number: u16) -> Result<Option<usize>, String> {
        let first = self.numbers(number)?.first().copied();
        Ok(first.filter(|v| (0.0..4_294_967_296.0).contains(v)).map(|v| v as usize))
    }

    /// The text of a tag; empty if the image lacks it. Other letters than those of ASCII are left out.
    pub(super) fn text(&self, number: u16) -> String {
        let values = self.values(number).ok().flatten().filter(|(tag, _)| tag.kind == 2);
        values.map_or_else(String::new, |(_, bytes)| {
            bytes.iter().take(1 << 16).filter(|b| b.is_ascii()).map(|b| char::from(*b)).collect()
        })
    }

    fn values(&self, number: u16) -> Result<Option<(&Tag, &'a [u8])>, String> {
        let Some(tag) = self.tags.iter().find(|tag| tag.number == number && size_of(tag.kind) > 0) else {
            return Ok(None);
        };
        let end = tag.count.checked_mul(size_of(tag.kind)).and_then(|length| tag.at.checked_add(length));
        let values = end.and_then(|end| self.bytes.get(tag.at..end));
        values.map(|values| Some((tag, values))).ok_or_else(|| "the file ends before the values of a tag".to_owned())
    }
}
