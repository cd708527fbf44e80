//! Reads the classic NetCDF formats CDF-1, CDF-2 and CDF-5 ("The NetCDF classic format specification", Unidata).
//!
//! A header lists dimensions, attributes and variables with the position of their values; all numbers are big-endian.
//! Variables over the unlimited dimension are stored record by record. Every size is checked against the file.

use super::{Attribute, MAX_ENTRIES, MAX_RANK, MAX_TEXT_BYTES, Variable};

const DIMENSIONS_TAG: u64 = 10;
const VARIABLES_TAG: u64 = 11;
const ATTRIBUTES_TAG: u64 = 12;

/// Whether a file begins as one of the classic formats.
pub fn is_classic(bytes: &[u8]) -> bool {
    matches!(bytes, [b'C', b'D', b'F', 1 | 2 | 5, ..])
}

/// Type of the values of a variable or an attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    I8,
    Letter,
    I16,
    I32,
    F32,
    F64,
    U8,
    U16,
    U32,
    I64,
    U64,
}

/// Where the values of a variable lie.
struct Place {
    kind: Kind,
    /// Position of the first value, bytes from the start of the file.
    begin: u64,
    /// Number of values of one record, or of the whole variable without the unlimited dimension.
    values_per_record: usize,
    /// Number of records; `None` without the unlimited dimension.
    records: Option<usize>,
}

/// An opened file of a classic format.
pub struct ClassicFile<'a> {
    bytes: &'a [u8],
    places: Vec<Place>,
    /// Distance of two records, bytes.
    record_bytes: u64,
}

impl Kind {
    fn from_code(code: u64) -> Result<Self, String> {
        let kinds = [Self::I8, Self::Letter, Self::I16, Self::I32, Self::F32, Self::F64];
        let more = [Self::U8, Self::U16, Self::U32, Self::I64, Self::U64];
        let index = usize::try_from(code).ok().and_then(|c| c.checked_sub(1));
        let kind = index.and_then(|i| kinds.iter().chain(&more).nth(i));
        kind.copied().ok_or_else(|| format!("a type has the unknown number {code}"))
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::Letter | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::F32 | Self::U32 => 4,
            Self::F64 | Self::I64 | Self::U64 => 8,
        }
    }

    /// Number at the beginning of `bytes`, which has at least the size of this type.
    fn number(self, bytes: &[u8]) -> f64 {
        let word = bytes[..self.size()].iter().fold(0_u64, |word, b| word << 8 | u64::from(*b));
        match self {
            Self::I8 => f64::from(word as u8 as i8),
            Self::I16 => f64::from(word as u16 as i16),
            Self::I32 => f64::from(word as u32 as i32),
            Self::I64 => word as i64 as f64,
            Self::Letter | Self::U8 | Self::U16 | Self::U32 | Self::U64 => word as f64,
            Self::F32 => f64::from(f32::from_bits(word as u32)),
            Self::F64 => f64::from_bits(word),
        }
    }
}

/// Position in the header of a file.
struct Header<'a> {
    bytes: &'a [u8],
    at: usize,
    version: u8,
}

impl<'a> Header<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let end = self.at.checked_add(count).filter(|end| *end <= self.bytes.len());
        let end = end.ok_or("the file ends within its header: copy it again")?;
        let piece = &self.bytes[self.at..end];
        self.at = end;
        Ok(piece)
    }

    fn word(&mut self, size: usize) -> Result<u64, String> {
        Ok(self.take(size)?.iter().fold(0, |word, b| word << 8 | u64::from(*b)))
    }

    /// A tag or a type: four bytes in all formats.
    fn code(&mut self) -> Result<u64, String> {
        self.word(4)
    }

    /// A number of things: four bytes, or eight in CDF-5.
    fn count(&mut self) -> Result<u64, String> {
        self.word(if self.version == 5 { 8 } else { 4 })
    }

    fn limited_count(&mut self, what: &str, most: usize) -> Result<usize, String> {
        let count = self.count()?;
        let limited = usize::try_from(count).ok().filter(|n| *n <= most);
        limited.ok_or_else(|| format!("{count} {what}, but at most {most} are read"))
    }

    /// Bytes, padded to a multiple of four.
    fn padded(&mut self, count: usize) -> Result<&'a [u8], String> {
        let piece = self.take(count)?;
        self.take(count.next_multiple_of(4) - count)?;
        Ok(piece)
    }

    fn name(&mut self) -> Result<String, String> {
        let length = self.limited_count("letters in a name", MAX_TEXT_BYTES)?;
        Ok(String::from_utf8_lossy(self.padded(length)?).into_owned())
    }

    /// Length of a list with this tag; 0 for a list that is absent.
    fn list(&mut self, tag: u64, what: &str) -> Result<usize, String> {
        let found = self.code()?;
        let count = self.limited_count(what, MAX_ENTRIES)?;
        if found != tag && !(found == 0 && count == 0) {
            return Err(format!("the list of {what} is damaged: copy the file again"));
        }
        Ok(count)
    }

    fn attributes(&mut self) -> Result<Vec<(String, Attribute)>, String> {
        let count = self.list(ATTRIBUTES_TAG, "attributes")?;
        let mut attributes = Vec::new();
        for _ in 0..count {
            let name = self.name()?;
            let kind = Kind::from_code(self.code()?)?;
            let length = self.limited_count("values of an attribute", MAX_TEXT_BYTES)?;
            let bytes = self.padded(length * kind.size())?;
            let value = if kind == Kind::Letter {
                Attribute::Text(String::from_utf8_lossy(bytes).trim_end_matches('\0').to_owned())
            } else {
                Attribute::Numbers(bytes.chunks_exact(kind.size()).map(|b| kind.number(b)).collect())
            };
            attributes.push((name, value));
        }
        Ok(attributes)
    }
}

impl<'a> ClassicFile<'a> {
    /// Reads the header of a file. Returns its variables, too.
    ///
    /// # Errors
    /// One sentence that says what is wrong.
    pub fn open(bytes: &'a [u8]) -> Result<(Self, Vec<Variable>), String> {
        if !is_classic(bytes) {
            return Err("the file does not begin as a NetCDF file".into());
        }
        let mut header = Header { bytes, at: 4, version: bytes[3] };
        let record_count = header.count()?;
        let mut dimensions = Vec::new();
        for _ in 0..header.list(DIMENSIONS_TAG, "dimensions")? {
            dimensions.push((header.name()?, header.count()?));
        }
        header.attributes()?;
        let (mut variables, mut places, mut record_sizes) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..header.list(VARIABLES_TAG, "variables")? {
            let name = header.name()?;
            let rank = header.limited_count("dimensions of a variable", MAX_RANK)?;
            let mut variable = Variable { name, dimensions: Vec::new(), shape: Vec::new(), attributes: Vec::new() };
            let mut records = None;
            for position in 0..rank {
                let index = header.count()?;
                let dimension = usize::try_from(index).ok().and_then(|i| dimensions.get(i));
                let (name, length) = dimension.ok_or("a variable has a dimension that the file lacks")?;
                let mut length = *length;
                if length == 0 {
                    // The unlimited dimension. While a file is written, its length may be unknown: all bits are set.
                    length = record_count;
                    if position > 0 {
                        return Err("the unlimited dimension is not the first of a variable".into());
                    }
                    records = Some(usize::try_from(length).unwrap_or(usize::MAX));
                }
                variable.dimensions.push(name.clone());
                variable.shape.push(usize::try_from(length).unwrap_or(usize::MAX));
            }
            variable.attributes = header.attributes()?;
            let kind = Kind::from_code(header.code()?)?;
            header.count()?; // The size in bytes, which follows from the shape and overflows for large variables.
            let begin = header.word(if header.version == 1 { 4 } else { 8 })?;
            let inner = &variable.shape[usize::from(records.is_some())..];
            let values_per_record = inner.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
            let values_per_record = values_per_record.ok_or("a variable is larger than any file")?;
            if records.is_some() {
                record_sizes.push(values_per_record.saturating_mul(kind.size()));
            }
            places.push(Place { kind, begin, values_per_record, records });
            variables.push(variable);
        }
        // A single variable with records has no padding between them.
        let padded = |size: &usize| size.checked_next_multiple_of(4).unwrap_or(usize::MAX) as u64;
        let record_bytes = match &record_sizes[..] {
            [only] => *only as u64,
            all => all.iter().map(padded).fold(0, u64::saturating_add),
        };
        Ok((Self { bytes, places, record_bytes }, variables))
    }

    /// Values of the variable with this index, `count` of them, the last dimension fastest.
    ///
    /// # Errors
    /// One sentence, if the file ends before them.
    pub fn numbers(&self, index: usize, count: usize) -> Result<Vec<f64>, String> {
        let place = &self.places[index];
        let size = place.kind.size();
        let piece = |begin: u64, values: usize| -> Result<&[u8], String> {
            let begin = usize::try_from(begin).ok();
            let end = begin.and_then(|b| b.checked_add(values.checked_mul(size)?));
            begin
                .zip(end)
                .and_then(|(b, e)| self.bytes.get(b..e))
                .ok_or_else(|| "the file ends before the values of a variable: copy it again".to_owned())
        };
        let records = place.records.unwrap_or(1);
        if records > 0 && place.values_per_record > 0 {
            // The last record is there, so all are, and memory is asked for only then.
            let last = place.begin.saturating_add((records as u64 - 1).saturating_mul(self.record_bytes));
            piece(last, place.values_per_record)?;
        }
        let mut out = Vec::with_capacity(count);
        for record in 0..if count == 0 { 0 } else { records as u64 } {
            let bytes = piece(place.begin.saturating_add(record * self.record_bytes), place.values_per_record)?;
            out.extend(bytes.chunks_exact(size).map(|b| place.kind.number(b)));
        }
        Ok(out)
    }
}
