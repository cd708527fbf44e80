//! NetCDF-4 files, which are HDF5 files, by the crate `netcdf-reader`. Programs without the feature `netcdf4`, among
//! them the web page, refuse them: the crate would make the page 9 % larger.

#[cfg(not(all(feature = "netcdf4", not(target_arch = "wasm32"))))]
pub use without::Hdf5File;

#[cfg(all(feature = "netcdf4", not(target_arch = "wasm32")))]
pub use with::Hdf5File;

/// Whether a file begins as HDF5.
pub fn is_hdf5(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x89HDF\r\n\x1a\n")
}

#[cfg(not(all(feature = "netcdf4", not(target_arch = "wasm32"))))]
mod without {
    use super::super::Variable;

    /// A file that cannot be opened.
    pub enum Hdf5File {}

    impl Hdf5File {
        pub fn open(_: &[u8]) -> Result<(Self, Vec<Variable>), String> {
            Err("it is a NetCDF-4 file, which only the desktop program reads: \
                 convert it to classic NetCDF, for example with nccopy -k classic"
                .into())
        }

        pub fn numbers(&self, _: &str) -> Result<Vec<f64>, String> {
            match *self {}
        }
    }
}

#[cfg(all(feature = "netcdf4", not(target_arch = "wasm32")))]
mod with {
    use super::super::{Attribute, MAX_ENTRIES, MAX_RANK, MAX_TEXT_BYTES, MAX_VALUES, Variable};
    use netcdf_reader::{NcAttrValue, NcFile, NcOpenOptions, NcType, NcVariable};

    /// Largest decompressed piece of a variable, bytes.
    const MAX_CHUNK_BYTES: usize = 8 * MAX_VALUES;

    /// An opened file.
    pub struct Hdf5File(NcFile);

    impl Hdf5File {
        /// Opens a file, and reads the names, shapes and attributes of the variables of its root group.
        pub fn open(bytes: &[u8]) -> Result<(Self, Vec<Variable>), String> {
            let options = NcOpenOptions {
                max_chunk_bytes: MAX_CHUNK_BYTES,
                max_read_bytes: MAX_CHUNK_BYTES,
                chunk_cache_bytes: 1 << 20,
                ..NcOpenOptions::default()
            };
            let file = NcFile::from_bytes_with_options(bytes, options).map_err(|e| one_line(&e))?;
            let variables = file.variables().map_err(|e| one_line(&e))?;
            if variables.len() > MAX_ENTRIES {
                return Err(format!("{} variables, but at most {MAX_ENTRIES} are read", variables.len()));
            }
            let variables = variables.iter().map(variable).collect::<Result<_, _>>()?;
            Ok((Self(file), variables))
        }

        /// All values of a variable; a letter is its code.
        pub fn numbers(&self, name: &str) -> Result<Vec<f64>, String> {
            let is_text = self.0.variable(name).map_err(|e| one_line(&e))?.dtype == NcType::Char;
            if is_text {
                let letters = self.0.read_variable_raw_bytes(name).map_err(|e| one_line(&e))?;
                return Ok(letters.into_iter().map(f64::from).collect());
            }
            let values = self.0.read_variable_as_f64(name).map_err(|e| one_line(&e))?;
            Ok(values.into_iter().collect())
        }
    }

    fn variable(of: &NcVariable) -> Result<Variable, String> {
        if of.dimensions.len() > MAX_RANK || of.attributes.len() > MAX_ENTRIES {
            return Err(format!("the variable {} has too many dimensions or attributes", of.name));
        }
        let value = |value: &NcAttrValue| match value.as_string() {
            Some(text) => Some(Attribute::Text(text)),
            None => value.as_f64_vec().map(Attribute::Numbers),
        };
        let attributes = of.attributes.iter().filter_map(|a| Some((a.name.clone(), value(&a.value)?)));
        Ok(Variable {
            name: of.name.chars().take(MAX_TEXT_BYTES).collect(),
            dimensions: of.dimensions.iter().map(|d| d.name.clone()).collect(),
            shape: of.dimensions.iter().map(|d| usize::try_from(d.size).unwrap_or(usize::MAX)).collect(),
            attributes: attributes.collect(),
        })
    }

    /// Text of the crate's error in one line.
    fn one_line(error: &netcdf_reader::Error) -> String {
        let text = error.to_string();
        format!("it cannot be read as NetCDF-4: {}", text.lines().next().unwrap_or_default())
    }
}
