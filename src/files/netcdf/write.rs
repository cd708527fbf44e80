//! Writes NetCDF files of the classic format with 64-bit positions (CDF-2), which every NetCDF program reads.

use super::Attribute;

/// A variable to write.
#[derive(Clone, Debug)]
pub struct Variable<'a> {
    /// Name of the variable.
    pub name: &'a str,
    /// Indices of its dimensions in the file's list, the slowest first.
    pub dimensions: Vec<usize>,
    /// Names and values of its attributes.
    pub attributes: Vec<(&'a str, Attribute)>,
    /// Values, the last dimension fastest.
    pub values: Values<'a>,
}

/// Values of a variable, with the type that they have in the file.
#[derive(Clone, Debug)]
pub enum Values<'a> {
    /// 64-bit floating-point numbers.
    F64(&'a [f64]),
    /// 32-bit floating-point numbers.
    F32(&'a [f32]),
    /// Letters.
    Text(&'a [u8]),
}

impl Values<'_> {
    fn code(&self) -> u32 {
        match self {
            Self::Text(_) => 2,
            Self::F32(_) => 5,
            Self::F64(_) => 6,
        }
    }

    fn byte_count(&self) -> usize {
        match self {
            Self::Text(text) => text.len(),
            Self::F32(list) => 4 * list.len(),
            Self::F64(list) => 8 * list.len(),
        }
    }

    fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Text(text) => out.extend_from_slice(text),
            Self::F32(list) => list.iter().for_each(|v| out.extend(v.to_be_bytes())),
            Self::F64(list) => list.iter().for_each(|v| out.extend(v.to_be_bytes())),
        }
        pad(out);
    }
}

/// Makes a file of dimensions (name and length), global attributes (name and text) and variables.
///
/// # Panics
/// If a variable does not have as many values as its dimensions say.
pub fn write(dimensions: &[(&str, usize)], attributes: &[(&str, &str)], variables: &[Variable<'_>]) -> Vec<u8> {
    let global: Vec<(&str, Attribute)> =
        attributes.iter().map(|(name, text)| (*name, Attribute::Text((*text).to_owned()))).collect();
    let header = |first_byte: usize| {
        let mut out = b"CDF\x02\0\0\0\0".to_vec();
        list_head(&mut out, 10, dimensions.len());
        for (name, length) in dimensions {
            text(&mut out, name);
            word(&mut out, *length);
        }
        write_attributes(&mut out, &global);
        list_head(&mut out, 11, variables.len());
        let mut begin = first_byte;
        for variable in variables {
            let count: usize = variable.dimensions.iter().map(|d| dimensions[*d].1).product();
            let bytes = variable.values.byte_count();
            let width = bytes.checked_div(count).unwrap_or_default();
            assert!(count == 0 || width * count == bytes && [1, 4, 8].contains(&width), "{}", variable.name);
            text(&mut out, variable.name);
            word(&mut out, variable.dimensions.len());
            variable.dimensions.iter().for_each(|d| word(&mut out, *d));
            write_attributes(&mut out, &variable.attributes);
            out.extend(variable.values.code().to_be_bytes());
            // Readers ignore the size of a variable of 4 GiB or more.
            word(&mut out, bytes.next_multiple_of(4));
            out.extend((begin as u64).to_be_bytes());
            begin += bytes.next_multiple_of(4);
        }
        out
    };
    // The positions do not change the length of the header.
    let mut out = header(header(0).len());
    variables.iter().for_each(|v| v.values.write(&mut out));
    out
}

fn list_head(out: &mut Vec<u8>, tag: usize, count: usize) {
    word(out, if count == 0 { 0 } else { tag });
    word(out, count);
}

fn write_attributes(out: &mut Vec<u8>, attributes: &[(&str, Attribute)]) {
    list_head(out, 12, attributes.len());
    for (name, value) in attributes {
        text(out, name);
        match value {
            Attribute::Text(value) => {
                word(out, 2);
                text(out, value);
            }
            Attribute::Numbers(list) => {
                word(out, 6);
                word(out, list.len());
                list.iter().for_each(|v| out.extend(v.to_be_bytes()));
            }
        }
    }
}

/// A number of four bytes. A larger one becomes the largest, which marks a size that the format cannot hold.
fn word(out: &mut Vec<u8>, v: usize) {
    out.extend(u32::try_from(v).unwrap_or(u32::MAX).to_be_bytes());
}

fn text(out: &mut Vec<u8>, text: &str) {
    word(out, text.len());
    out.extend_from_slice(text.as_bytes());
    pad(out);
}

fn pad(out: &mut Vec<u8>) {
    out.resize(out.len().next_multiple_of(4), 0);
}
