//! NetCDF files: the classic formats are read and written, and NetCDF-4 files are read as HDF5.
//!
//! A file holds named variables, arrays of numbers or letters over named dimensions, with attributes. This module hides
//! which of the formats a file has.

mod classic;
mod hdf5;
mod write;

pub use write::{Values, Variable as NewVariable, write};

/// Largest number of values that are read from one variable.
pub const MAX_VALUES: usize = 8 << 20;
/// Largest number of dimensions and of variables of a file, and of attributes of a variable.
const MAX_ENTRIES: usize = 4096;
/// Largest number of dimensions of a variable.
const MAX_RANK: usize = 16;
/// Longest name or text attribute that is read, bytes.
const MAX_TEXT_BYTES: usize = 1 << 16;

/// Value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub enum Attribute {
    /// Text.
    Text(String),
    /// Numbers, of any type in the file.
    Numbers(Vec<f64>),
}

/// A variable: its name, its dimensions and its attributes. [`Dataset::numbers`] reads its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name of the variable.
    pub name: String,
    /// Names of its dimensions, the slowest first. A dimension of a NetCDF-4 file may have no name: then it is empty.
    pub dimensions: Vec<String>,
    /// Length of each dimension.
    pub shape: Vec<usize>,
    /// Names and values of its attributes.
    pub attributes: Vec<(String, Attribute)>,
}

impl Variable {
    /// Value of an attribute; `None` if the variable has none of this name.
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.0 == name).map(|a| &a.1)
    }

    /// Text of an attribute; empty if there is none.
    pub fn text(&self, name: &str) -> &str {
        if let Some(Attribute::Text(text)) = self.attribute(name) { text } else { "" }
    }

    /// First number of an attribute.
    pub fn number(&self, name: &str) -> Option<f64> {
        if let Some(Attribute::Numbers(list)) = self.attribute(name) { list.first().copied() } else { None }
    }

    /// Number of values; an error if there are more than [`MAX_VALUES`].
    pub fn value_count(&self) -> Result<usize, String> {
        let count = self.shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
        count.filter(|n| *n <= MAX_VALUES).ok_or_else(|| {
            format!("the variable {} has more than {MAX_VALUES} values: keep fewer times and places", self.name)
        })
    }
}

/// An opened file.
pub struct Dataset<'a> {
    /// Variables of the file, in its order or by name.
    pub variables: Vec<Variable>,
    source: Source<'a>,
}

enum Source<'a> {
    Classic(classic::ClassicFile<'a>),
    Hdf5(hdf5::Hdf5File),
}

/// Whether a file is NetCDF or HDF5, by its first bytes.
pub fn is_netcdf(bytes: &[u8]) -> bool {
    classic::is_classic(bytes) || hdf5::is_hdf5(bytes)
}

impl<'a> Dataset<'a> {
    /// Opens a file and reads the names, shapes and attributes of its variables.
    ///
    /// # Errors
    /// One sentence that says what is wrong with the file, without its name.
    pub fn open(bytes: &'a [u8]) -> Result<Self, String> {
        if hdf5::is_hdf5(bytes) {
            let (file, variables) = hdf5::Hdf5File::open(bytes)?;
            return Ok(Self { variables, source: Source::Hdf5(file) });
        }
        let (file, variables) = classic::ClassicFile::open(bytes)?;
        Ok(Self { variables, source: Source::Classic(file) })
    }

    /// Index of the variable of this name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.variables.iter().position(|v| v.name == name)
    }

    /// All values of a variable as the file stores them, the last dimension fastest. A letter is its code.
    ///
    /// # Errors
    /// One sentence, if there are too many values, or the file ends before them.
    ///
    /// # Panics
    /// If `index` is not below the number of variables.
    pub fn numbers(&self, index: usize) -> Result<Vec<f64>, String> {
        let variable = &self.variables[index];
        let count = variable.value_count()?;
        let values = match &self.source {
            Source::Classic(file) => file.numbers(index, count)?,
            Source::Hdf5(file) => file.numbers(&variable.name)?,
        };
        if values.len() != count {
            return Err(format!("the variable {} has {} values instead of {count}", variable.name, values.len()));
        }
        Ok(values)
    }
}
