//! `seastate validate`: the page that sets the program's numbers against theory and published measurements.
//!
//! Without a GPU all but the measured cells is the same: the tests compare that with the page in the repository.

pub mod all;
mod depth;
mod dispersion;
mod draw;
mod figure;
mod lab;
pub mod page;
mod published;
mod slopes;
mod spectra;
mod spreading;
mod surface;

use crate::gpu::Gpu;
use crate::state::fields::{self, FieldKind};
use lab::Lab;
use page::Page;
use std::path::PathBuf;

/// The parts of the page, in order.
pub const PARTS: [&str; 6] = ["spectra", "spreading", "dispersion", "published", "depth", "surface"];

/// Arguments of the command.
#[derive(clap::Args, Clone, Debug)]
pub struct Options {
    /// Folder to write validation.md and validation/ to
    #[arg(short, long, default_value = "docs")]
    pub output: PathBuf,
    /// Seeds to measure over
    #[arg(long, default_value_t = 12, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub seeds: u32,
    /// Writes validation-all.md instead: every spectrum with every spreading over thirteen sea states
    #[arg(long)]
    pub all: bool,
    /// Only the states of --all that contain this text, such as 'spectrum=pm&spread=cos2&'
    #[arg(long, requires = "all", default_value = "", hide_default_value = true)]
    pub only: String,
}

/// Measures, and writes the page; returns what to say.
///
/// # Errors
/// If there is no GPU, or a file cannot be written.
pub fn run(options: &Options) -> Result<String, String> {
    let gpu = pollster::block_on(Gpu::request())?;
    let (page, name) = if options.all {
        (all::build(&gpu, options.seeds, &options.only)?, "validation-all")
    } else {
        (build(Some(&gpu), options.seeds, &PARTS)?, "validation")
    };
    page.write(&options.output, name)?;
    Ok(format!("{} and {} figures", options.output.join(format!("{name}.md")).display(), page.figures().len()))
}

/// The page, or some of its parts.
///
/// # Errors
/// If the GPU does not give its memory back, or a figure cannot be drawn.
pub fn build(gpu: Option<&Gpu>, seeds: u32, parts: &[&str]) -> Result<Page, String> {
    let lab = Lab { gpu, seeds };
    let mut page = Page::default();
    introduce(&mut page, &lab);
    for part in parts {
        match *part {
            "spectra" => spectra::write(&mut page, &lab)?,
            "spreading" => spreading::write(&mut page, &lab)?,
            "dispersion" => dispersion::write(&mut page, &lab)?,
            "published" => {
                published::write(&mut page)?;
                slopes::write(&mut page, &lab)?;
            }
            "depth" => depth::write(&mut page, &lab)?,
            "surface" => surface::write(&mut page, &lab)?,
            other => return Err(format!("no part is called {other}")),
        }
    }
    Ok(page)
}

fn introduce(page: &mut Page, lab: &Lab<'_>) {
    page.heading(1, "Validation");
    page.prose(
        "`seastate validate` wrote this page and its figures from the program's own output: the seeds are fixed, and \
         `tests/validation.rs` compares its numbers of theory with the program, so that it cannot go stale. \
         `seastate validate --all` measures every spectrum with every spreading over thirteen sea states.",
    );
    page.prose(
        "**Theory** integrates the spectrum by adaptive quadrature. **Resolved** sums over the waves that the cascades hold. \
         **Measured** is read back from the GPU's f32 maps, with the standard error of the mean over the seeds; waves and \
         their opposites are told apart by two looks a moment apart. **Deviation** is measured against resolved unless it \
         says otherwise, in brackets in standard errors: one number in twenty is expected beyond 2 σ, one in 370 beyond 3 σ.",
    );
    if let Some(gpu) = lab.gpu {
        let info = gpu.device.adapter_info();
        let short = info.name.split(" (").next().unwrap_or_default().to_owned();
        page.prose(&format!("Measured over {} seeds on {short} ({}).", lab.seeds, info.backend));
    }
}

/// The words of a choice, without `measured`.
pub fn words(key: &str) -> Vec<&'static str> {
    match fields::find(key).map(|f| f.kind) {
        Some(FieldKind::Choice(words)) => words.iter().copied().filter(|w| *w != "measured").collect(),
        _ => vec![],
    }
}
