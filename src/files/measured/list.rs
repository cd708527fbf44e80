//! The spectra that a file holds, each with its time and place.

use super::spectrum::{MeasuredSpectrum, SpectrumFile};
use super::text::printable_prefix;

/// Largest number of spectra that are read from a file.
pub const MAX_RECORDS: usize = 20_000;
/// Largest number of densities that are read from a file, over all its spectra.
pub const MAX_FILE_DENSITIES: usize = 16 << 20;

/// One spectrum of a file that may hold several.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumRecord {
    /// Time and place in the words of the file, printable and short; may be empty.
    pub label: String,
    /// The spectrum.
    pub spectrum: MeasuredSpectrum,
    /// Messages to the user about data of this spectrum that were not used.
    pub notices: Vec<String>,
}

/// Why a spectrum of a file is the one that is used unless the user chooses another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DefaultSpectrum {
    /// It has the most energy of all times and places.
    MostEnergy,
    /// It is the newest of a buoy's records.
    Newest,
}

impl DefaultSpectrum {
    /// The reason in words that follow a comma.
    fn reason(self) -> &'static str {
        match self {
            Self::MostEnergy => "which has the most energy",
            Self::Newest => "the newest complete one",
        }
    }
}

/// All spectra of a file, at least one: in the order of the file, or in the order of time if a buoy's files hold them.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumList {
    /// Name of the file for messages, without folders.
    pub name: String,
    /// The spectra.
    pub records: Vec<SpectrumRecord>,
    /// Index of the spectrum that is used unless the user chooses another one.
    pub default_index: usize,
    /// Why [`Self::default_index`] is the default.
    pub default_choice: DefaultSpectrum,
    /// Messages to the user about data of the whole file that were not used.
    pub notices: Vec<String>,
}

impl SpectrumList {
    /// Makes the list of a file. `skipped` counts spectra of the file without data or without waves.
    ///
    /// # Errors
    /// One sentence, if there are no records.
    pub(super) fn new(name: &str, records: Vec<SpectrumRecord>, skipped: usize) -> Result<Self, String> {
        if records.is_empty() {
            return Err(format!("{name}: no spectrum in it has waves: choose another file, time or place"));
        }
        let energy = |i: usize| records[i].spectrum.variance_m2();
        let default_index = (1..records.len()).fold(0, |best, i| if energy(i) > energy(best) { i } else { best });
        let mut notices = Vec::new();
        if skipped > 0 {
            notices.push(format!("{name}: {skipped} spectra without data or waves are left out"));
        }
        let default_choice = DefaultSpectrum::MostEnergy;
        Ok(Self { name: name.to_owned(), records, default_index, default_choice, notices })
    }

    /// Title of a spectrum for the user: name of the file, time and place.
    ///
    /// # Panics
    /// If `index` is not below the number of records.
    pub fn title(&self, index: usize) -> String {
        let label = &self.records[index].label;
        let comma = if label.is_empty() { "" } else { ", " };
        printable_prefix(&format!("{}{comma}{label}", self.name), 80)
    }

    /// Takes the spectrum with the given index, or the default one, with its notices. If the file holds several, a
    /// notice says which one is used.
    ///
    /// # Errors
    /// One sentence, if the index is not below the number of records.
    pub fn choose(mut self, index: Option<usize>) -> Result<SpectrumFile, String> {
        let count = self.records.len();
        let used = index.unwrap_or(self.default_index);
        if used >= count {
            return Err(format!("{}: it holds {count} spectra, numbered from 0: there is no number {used}", self.name));
        }
        if count > 1 {
            let why = index.map_or_else(|| format!(", {}", self.default_choice.reason()), |_| String::new());
            let label = &self.records[used].label;
            let label = if label.is_empty() { String::new() } else { format!(" ({label})") };
            let notice = format!("{}: number {used} of {count} spectra is used{label}{why}", self.name);
            self.notices.insert(0, notice);
        }
        let title = self.title(used);
        let SpectrumRecord { spectrum, notices, .. } = self.records.swap_remove(used);
        self.notices.extend(notices);
        Ok(SpectrumFile { spectrum, title, notices: self.notices })
    }
}
