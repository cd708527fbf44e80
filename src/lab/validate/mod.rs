//! `seastate validate`: the page that compares the program's numbers with theory and with published measurements.
//!
//! Without a GPU only the measured table cells are missing; the tests compare all others with docs/validation.md.

pub mod cells;
pub mod coast;
mod crests;
mod depth;
mod dispersion;
mod measurement;
mod published;
mod slopes;
mod spectra;
mod spreading;
mod surface;

use super::page::MarkdownPage;
use crate::gpu::Gpu;
use crate::state::fields::{self, FieldKind};
use measurement::MeasurementSetup;

/// Names of the parts of the validation page, in order.
pub const PAGE_PARTS: [&str; 8] =
    ["spectra", "spreading", "dispersion", "published", "depth", "surface", "crests", "coast"];

/// Builds the validation page from the parts named in `parts` (see [`PAGE_PARTS`]), measured over `seeds` seeds.
/// Without a GPU its measured table cells hold [`cells::PENDING_CELL`].
///
/// # Errors
/// If reading back from the GPU fails, or a figure cannot be drawn.
pub fn build_validation_page(gpu: Option<&Gpu>, seeds: u32, parts: &[&str]) -> Result<MarkdownPage, String> {
    let lab = MeasurementSetup { gpu, seed_count: seeds };
    let mut page = MarkdownPage::default();
    add_introduction(&mut page, &lab);
    for part in parts {
        match *part {
            "spectra" => spectra::add_part(&mut page, &lab)?,
            "spreading" => spreading::add_part(&mut page, &lab)?,
            "dispersion" => dispersion::add_part(&mut page, &lab)?,
            "published" => {
                published::add_part(&mut page)?;
                slopes::add_part(&mut page, &lab)?;
            }
            "depth" => depth::add_part(&mut page, &lab)?,
            "surface" => surface::add_part(&mut page, &lab)?,
            "crests" => crests::add_part(&mut page, &lab)?,
            "coast" => coast::add_part(&mut page)?,
            other => return Err(format!("the validation page has no part {other}")),
        }
    }
    Ok(page)
}

fn add_introduction(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) {
    page.heading(1, "Validation");
    page.paragraph(
        "`seastate validate` writes this page and its figures from the program's own output. The seeds are fixed, and \
         `tests/validation.rs` compares the theoretical numbers of the page with the program.",
    );
    page.paragraph(
        "**Theory** integrates the spectrum by adaptive quadrature. **Resolved** sums over the waves that the cascades \
         hold. **Measured** is read back from the GPU's f32 maps, with the standard error of the mean over the seeds; \
         read-backs at two times separate waves of opposite directions. **Deviation** compares measured with resolved \
         numbers unless stated otherwise; the brackets give it in standard errors. One number in twenty is expected \
         beyond 2 σ, one in 370 beyond 3 σ.",
    );
    if let Some(gpu) = lab.gpu {
        let info = gpu.device.adapter_info();
        let short = info.name.split(" (").next().unwrap_or_default().to_owned();
        page.paragraph(&format!("Measured over {} seeds on {short} ({}).", lab.seed_count, info.backend));
    }
}

/// The values that the choice parameter `key` (such as `spectrum`) can have in a state string, except `measured`, which
/// needs a file.
pub fn choice_parameter_values(key: &str) -> Vec<&'static str> {
    match fields::find(key).map(|f| f.kind) {
        Some(FieldKind::Choice(words)) => words.iter().copied().filter(|w| *w != "measured").collect(),
        _ => vec![],
    }
}
