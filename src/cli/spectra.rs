//! `seastate spectra` and `seastate export --spectrum-to`: lists the spectra of a file, and writes that of a sea.

use crate::files::input;
use crate::files::measured::MeasuredSpectrum;
use crate::state::{Params, query};
use crate::waves::Plan;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

/// Reads the files of one buoy or model, and lists their spectra as a table.
pub fn listing(paths: &[PathBuf]) -> Result<String, String> {
    let list = MeasuredSpectrum::read_list(&input::read_all(paths)?)?;
    let mut out = format!("{:>6} {:>8} {:>8}  time and place\n", "number", "Hs (m)", "Tp (s)");
    for (i, record) in list.records.iter().enumerate() {
        let mark = if i == list.default_index && list.records.len() > 1 { " (used by default)" } else { "" };
        let (hs_m, tp_s) = (record.spectrum.hs_m(), TAU / record.spectrum.omega_p());
        out += &format!("{i:>6} {hs_m:>8.2} {tp_s:>8.1}  {}{mark}\n", record.label);
    }
    out.extend(list.notices.iter().map(|notice| format!("{notice}\n")));
    Ok(out)
}

/// Writes the density of a sea over frequency and direction in the format that the ending of the file's name says.
pub fn export(params: &Params, path: &Path) -> Result<(), String> {
    let spectrum = Plan::new(params).directional_spectrum(&format!("seastate '{}'", query::write(params)));
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let bytes = match ending.as_deref() {
        Some("csv") => spectrum.to_csv().into_bytes(),
        Some("sp2" | "spc") => spectrum.to_swan().into_bytes(),
        Some("nc") => spectrum.to_netcdf(),
        _ => return Err(format!("{}: the name of a spectrum ends in .csv, .sp2 or .nc", path.display())),
    };
    std::fs::write(path, bytes).map_err(|e| format!("cannot write {}: {e}", path.display()))
}
