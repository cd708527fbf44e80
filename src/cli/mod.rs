//! The native command line: takes one state string, opens a window or writes pictures, maps and numbers.

mod args;
mod bench;
mod coast;
mod compare;
mod info;
mod spectra;

use crate::bench::BenchOptions;
use crate::bench::planned::Budget;
use crate::gpu::{Gpu, device};
use crate::lab::record::{self, RecordFormat, RecordSettings};
use crate::lab::reference::SamplingSettings;
use crate::lab::render::PictureSequence;
use crate::lab::{check, export, gallery, parameters, render, stats, thumbnails, validate};
use crate::ocean::device_info::DeviceInfo;
use crate::state::{Params, query};
use args::{Cli, Command, SeaArgs};
use clap::Parser as _;
use pollster::block_on;
use std::fmt::Write as _;
use std::path::Path;

/// Exit code of a command that fails for any reason, such as bad arguments or a missing GPU.
const FAILURE_EXIT_CODE: i32 = 2;

/// Runs the command that the arguments of this process name. Returns the exit code: 0, 1 if `seastate check` finds an
/// error above its tolerance, or `FAILURE_EXIT_CODE`.
pub fn main() -> i32 {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(e) if e.use_stderr() => {
            let text = e.to_string();
            let first = text.lines().next().unwrap_or_default().trim_start_matches("error: ");
            return fail(&format!("{first} (see 'seastate --help')"));
        }
        Err(help) => {
            // This prints help or the version. A closed pipe is no error.
            let _ = help.print();
            return 0;
        }
    };
    run(cli).unwrap_or_else(|message| fail(&message))
}

fn fail(message: &str) -> i32 {
    eprintln!("seastate: {message}");
    FAILURE_EXIT_CODE
}

/// Opens the desktop window with the named sea, else with the first one.
fn open_window(args: SeaArgs) -> Result<i32, String> {
    let is_first_sea = !args.names_sea();
    crate::app::native::run(&read_sea_params(&args.or_start())?, is_first_sea).map(|()| 0)
}

fn run(cli: Cli) -> Result<i32, String> {
    let gpu = || block_on(Gpu::request());
    let text = match cli.command {
        None => return open_window(cli.sea),
        Some(Command::Check { sea: args }) => return check(&read_sea_params(&args)?),
        Some(Command::Render { sea: args, size, output, frames: Some(count), fps, layers, .. }) => {
            let sequence = PictureSequence { picture_count: count, fps, writes_layers: layers };
            block_on(render::write_sequence(&gpu()?, &read_sea_params(&args)?, size, &sequence, &output))?
        }
        Some(Command::Render { sea: args, size, output, reference, samples, reference_seed, .. }) => {
            let sampling =
                reference.then_some(SamplingSettings { min_samples_per_pixel: samples, seed: reference_seed });
            block_on(render::write_picture(&gpu()?, &read_sea_params(&args)?, size, sampling, &output))?;
            return Ok(0);
        }
        Some(Command::Compare { reference, test, map, ppd }) => {
            compare::compare_pictures(&reference, &test, map.as_deref(), ppd)?
        }
        Some(Command::Export { sea: args, output, spectrum_to, raw }) => {
            let params = read_sea_params(&args)?;
            if let Some(path) = spectrum_to {
                spectra::export(&params, &path)?;
            }
            if let Some(output) = output {
                block_on(export::run(&gpu()?, &params, &output, raw))?;
            }
            return Ok(0);
        }
        Some(Command::Record { sea: args, at, hours, rate, waves, output }) => {
            let settings = RecordSettings { points: at, hours, rate_hz: rate, wave_count: waves as usize };
            let format = RecordFormat::for_path(&output)?;
            let record = record::run(&read_sea_params(&args)?, &settings)?;
            record.write(&output, format)?;
            format!("{}: the rms height of the waves left out is {:.3} m", output.display(), record.residual_rms_m)
        }
        Some(Command::Coast(args)) => coast::run(&args, &read_sea_params(&args.sea)?, report_notices)?,
        Some(Command::Spectra { files }) => spectra::listing(&files)?,
        Some(Command::Stats { sea: args, seeds, crests, hours, json }) => {
            let (params, notices) = args.read()?;
            let statistics = block_on(stats::run(&gpu()?, &params, seeds, crests.is_some().then_some(hours)))?;
            if let Some(path) = &crests {
                statistics.crests.write_csv(path, &query::write(&params))?;
            }
            if json {
                statistics.json(&notices)
            } else {
                report_notices(&notices);
                statistics.to_string()
            }
        }
        Some(Command::Bench { sea: args, sizes, budget: true, .. }) => {
            let sizes = if sizes.is_empty() { vec![[1920, 1080]] } else { sizes };
            Budget { params: &read_sea_params(&args)?, sizes: &sizes }.to_string()
        }
        Some(Command::Bench { sea: args, sizes, budget: false, no_picture, matrix, baseline, repeat, json }) => {
            let sizes = match (no_picture, matrix) {
                (true, _) => Vec::new(),
                (_, true) => bench::MATRIX_PICTURE_SIZES_PX.to_vec(),
                _ if sizes.is_empty() => vec![[1280, 720]],
                _ => sizes,
            };
            let options =
                BenchOptions { picture_sizes_px: sizes, submissions_per_measurement: repeat, matrix, baseline };
            let progress = |what: &str| eprintln!("seastate: measuring {what}");
            let report = block_on(crate::bench::run(&gpu()?, &read_sea_params(&args)?, &options, progress))?;
            if json { pretty_json(&bench::report_json(&report)) } else { report.to_string() }
        }
        Some(Command::Info { json }) => about(json)?,
        Some(Command::Validate { output, seeds, only }) => write_validation(&output, seeds, only.as_deref())?,
        Some(Command::Gallery { output, only, thumbnails }) => draw_gallery(&output, &only, thumbnails.as_deref())?,
        Some(Command::Keys { markdown: true }) => parameters::parameters_markdown(),
        Some(Command::Keys { markdown: false }) => parameters::parameter_listing(),
    };
    print_to_stdout(&text).map(|()| 0)
}

/// Writes the validation page, or only one part of it, and returns a line for the terminal.
fn write_validation(output: &Path, seeds: u32, only: Option<&str>) -> Result<String, String> {
    let parts = only.map_or(validate::PAGE_PARTS.to_vec(), |part| vec![part]);
    let page = validate::build_validation_page(Some(&block_on(Gpu::request())?), seeds, &parts)?;
    if only.is_some() {
        page.write_chapters(output)?;
    } else {
        page.write(output)?;
    }
    Ok(format!("{} and {} figures", output.join("validation.md").display(), page.figure_svgs().len()))
}

/// The program's version, its GPU, and how it uses the GPU.
fn about(json: bool) -> Result<String, String> {
    let adapter = block_on(device::choose_adapter())?;
    let about = DeviceInfo::new(&adapter, &block_on(Gpu::open(&adapter))?);
    Ok(if json { pretty_json(&info::about_json(&about)) } else { info::about_text(&about) })
}

/// Draws the pictures of the gallery whose title contains `only`, or the thumbnails of the named seas to a file.
fn draw_gallery(output: &Path, only: &str, thumbnails: Option<&Path>) -> Result<String, String> {
    match thumbnails {
        Some(path) => block_on(thumbnails::run(&block_on(Gpu::request())?, path)),
        None => block_on(gallery::run(&block_on(Gpu::request())?, output, only)),
    }
}

/// Reads the parameters and files that the arguments name, and prints all notices to stderr.
fn read_sea_params(args: &SeaArgs) -> Result<Params, String> {
    let (params, notices) = args.read()?;
    report_notices(&notices);
    let plan = crate::waves::Plan::new(&params);
    report_notices(&plan.notices);
    report_notices(plan.resolution_note.as_slice());
    Ok(params)
}

fn report_notices(notices: &[String]) {
    for notice in notices {
        eprintln!("seastate: {notice}");
    }
}

/// Runs `seastate check` and prints the comparisons. The exit code is 1 if an error exceeds its tolerance.
fn check(params: &Params) -> Result<i32, String> {
    let gpu = block_on(Gpu::request())?;
    let info = gpu.device.adapter_info();
    let lines = block_on(check::run(&gpu, params))?;
    let mut text = format!("{} ({})\n", info.name, info.backend);
    let _ = writeln!(text, "{:<34} {:>7} {:>12} {:>12}", "pass", "cascade", "error", "tolerance");
    for line in &lines {
        let _ = writeln!(text, "{line}");
    }
    let wrong = lines.iter().filter(|l| !l.passes()).count();
    let verdict = if wrong == 0 { "all within tolerance".to_owned() } else { format!("{wrong} out of tolerance") };
    let _ = writeln!(text, "{} comparisons, {verdict}", lines.len());
    print_to_stdout(&text)?;
    Ok(i32::from(wrong > 0))
}

fn pretty_json(value: &serde_json::Value) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default()
}

/// Prints a text to stdout. A closed pipe (`seastate stats | head`) gives an error of one line, not a panic.
fn print_to_stdout(text: &str) -> Result<(), String> {
    use std::io::Write as _;
    writeln!(std::io::stdout(), "{}", text.trim_end()).map_err(|e| format!("cannot write: {e}"))
}
