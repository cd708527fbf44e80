//! The native command line: one state string in; a window, a picture, maps or numbers out.

pub mod bench;
pub mod compare;
pub mod export;
pub mod frames;
pub mod info;
pub mod parameters;
pub mod render;

use crate::bench::Options;
use crate::files::measured::MeasuredSpectrum;
use crate::gpu::Gpu;
use crate::lab::{check, flip, gallery, reference, stats, validate};
use crate::state::fields::FIELDS;
use crate::state::{Params, query};
use clap::{Parser, Subcommand};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Exit code of bad arguments and of a missing GPU.
const USAGE: i32 = 2;
/// Most pixels of a picture along a side.
const MAX_SIDE: u32 = 8192;

#[derive(Parser)]
#[command(
    name = "seastate",
    version,
    about = "An ocean you can believe: sea states computed on the GPU from oceanographic spectra",
    args_conflicts_with_subcommands = true,
    after_help = "A STATE is a query string such as 'wind=14&fetch=300&t=40', or a whole page address; see 'seastate keys'.\n\
                  WGPU_ADAPTER_NAME and WGPU_BACKEND choose the GPU."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// The sea to open in a window
    #[command(flatten)]
    sea: SeaArgs,
}

/// A sea on the command line.
#[derive(clap::Args)]
struct SeaArgs {
    /// The sea
    state: Option<String>,
    /// A buoy's spectrum to show: NDBC text (density, alpha1, alpha2, r1, r2 in one file or several) or CSV of f, S,
    /// direction, spread; may be given several times for the files of one buoy
    #[arg(long = "spectrum", value_name = "FILE")]
    spectrum: Vec<PathBuf>,
    /// A sky to show: an equirectangular picture in linear light, Radiance .hdr or OpenEXR
    #[arg(long, value_name = "FILE")]
    sky: Option<PathBuf>,
}

impl SeaArgs {
    /// The parameters, and what was not taken as written.
    fn read(&self) -> Result<(Params, Vec<String>), String> {
        let (mut params, mut notices) = query::parse(self.state.as_deref().unwrap_or_default());
        if !self.spectrum.is_empty() {
            let files = crate::app::native::read_files(&self.spectrum)?;
            let (measured, more) = MeasuredSpectrum::read(&files)?;
            notices.extend(more);
            params.sea.show_measured(measured);
        }
        if let Some(path) = &self.sky {
            let file = crate::app::native::read_sky(path)?;
            notices.extend(file.image.iter().flat_map(|p| p.notices.iter().map(|n| format!("{}: {n}", file.name))));
            params.look.sky.file = Some(file);
        }
        notices.extend(params.look.sky.missing_file());
        Ok((params, notices))
    }

    /// The same, with everything that there is to notice said on stderr.
    fn read_aloud(&self) -> Result<Params, String> {
        let (params, notices) = self.read()?;
        report_notices(&notices);
        report_notices(&crate::waves::Plan::new(&params).notices);
        Ok(params)
    }
}

#[derive(Subcommand)]
enum Command {
    /// Renders a picture
    Render {
        #[command(flatten)]
        sea: SeaArgs,
        /// Width and height in pixels
        #[arg(long, default_value = "1280x720", value_parser = parse_size)]
        size: [u32; 2],
        /// Where to write the PNG; with --frames the folder for frame-00000.png and on
        #[arg(short, long, default_value = "sea.png")]
        output: PathBuf,
        /// Renders so many pictures, a sequence in time
        #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1_000_000), conflicts_with = "reference")]
        frames: Option<u32>,
        /// Pictures to a second of the sequence
        #[arg(long, default_value_t = 30.0)]
        fps: f64,
        /// With --frames: also writes an OpenEXR file each, with linear light (R, G, B), distance along the view in m (Z) and
        /// the normal in world axes (N.X east, N.Y up, N.Z south)
        #[arg(long, requires = "frames")]
        layers: bool,
        /// Draws the truth that the picture approximates: many samples a pixel, none of them filtered
        #[arg(long)]
        reference: bool,
        /// Samples a pixel of the reference
        #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=65_536))]
        samples: u32,
        /// Chooses where the samples of the reference lie
        #[arg(long, default_value_t = 1)]
        reference_seed: u32,
    },
    /// Prints how different two pictures look: mean FLIP, from 0 (the same) to 1
    Compare {
        /// The picture to compare with, PNG
        reference: PathBuf,
        /// The picture to judge, PNG of the same size
        test: PathBuf,
        /// Where to write a PNG of the difference, black where there is none
        #[arg(long)]
        map: Option<PathBuf>,
        /// Pixels per degree of vision: 67 for a 4K screen of 70 cm seen from 70 cm
        #[arg(long, default_value_t = flip::PIXELS_PER_DEGREE)]
        ppd: f64,
    },
    /// Writes the maps of every cascade, the foam and the plan
    Export {
        #[command(flatten)]
        sea: SeaArgs,
        /// Folder to write to; made if missing
        #[arg(short, long)]
        output: PathBuf,
        /// Also writes heights.f32 and displacement.f16: the bare numbers, cascade by cascade
        #[arg(long)]
        raw: bool,
    },
    /// Prints theory, resolved and measured numbers of a sea
    Stats {
        #[command(flatten)]
        sea: SeaArgs,
        /// Seeds to measure over
        #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
        seeds: u32,
        /// Prints JSON
        #[arg(long)]
        json: bool,
    },
    /// Compares every GPU pass with the f64 oracle
    Check {
        #[command(flatten)]
        sea: SeaArgs,
    },
    /// Times the passes
    Bench {
        #[command(flatten)]
        sea: SeaArgs,
        /// Width and height of a picture in pixels; may be given several times
        #[arg(long = "size", default_value = "1280x720", value_parser = parse_size)]
        sizes: Vec<[u32; 2]>,
        /// Leaves the picture out
        #[arg(long)]
        no_picture: bool,
        /// Measures the simulation for n from 128 to 1024 and 1 to 4 cascades, and pictures of three sizes
        #[arg(long)]
        matrix: bool,
        /// Also measures the waves as the browser demos compute them: a dispatch for every stage of every transform
        #[arg(long)]
        baseline: bool,
        /// Submissions for each number
        #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=10_000))]
        repeat: u32,
        /// Prints JSON
        #[arg(long)]
        json: bool,
    },
    /// Says what the program is, which GPU it takes and what it makes of it
    Info {
        /// Prints JSON
        #[arg(long)]
        json: bool,
    },
    /// Writes the validation page and its figures: the program's numbers against theory and published measurements
    Validate(validate::Options),
    /// Renders the gallery's pictures and writes its page
    Gallery(gallery::Options),
    /// Lists the keys of the state string
    Keys {
        /// Prints docs/parameters.md
        #[arg(long)]
        markdown: bool,
    },
}

/// Runs the command line of this process; returns its exit code.
pub fn main() -> i32 {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(e) if e.use_stderr() => {
            let text = e.to_string();
            let first = text.lines().next().unwrap_or_default().trim_start_matches("error: ");
            return fail(&format!("{first} (see 'seastate --help')"));
        }
        Err(help) => {
            // Help and version; a closed pipe is no reason to complain.
            let _ = help.print();
            return 0;
        }
    };
    match run(cli) {
        Ok(code) => code,
        Err(message) => fail(&message),
    }
}

fn fail(message: &str) -> i32 {
    eprintln!("seastate: {message}");
    USAGE
}

fn run(cli: Cli) -> Result<i32, String> {
    match cli.command {
        None => crate::app::native::run(&cli.sea.read_aloud()?).map(|()| 0),
        Some(Command::Render { sea, size, output, frames: Some(count), fps, layers, .. }) => {
            let sequence = frames::Sequence { count, fps, layers };
            pollster::block_on(frames::run(&sea.read_aloud()?, size, &sequence, &output)).and_then(|said| print(&said))
        }
        Some(Command::Render { sea, size, output, reference, samples, reference_seed, .. }) => {
            let reference = reference.then_some(reference::Sampling { samples, seed: reference_seed });
            pollster::block_on(render::run(&sea.read_aloud()?, size, reference, &output)).map(|()| 0)
        }
        Some(Command::Compare { reference, test, map, ppd }) => {
            compare::run(&reference, &test, map.as_deref(), ppd).and_then(|said| print(&said))
        }
        Some(Command::Export { sea, output, raw }) => {
            pollster::block_on(export::run(&sea.read_aloud()?, &output, raw)).map(|()| 0)
        }
        Some(Command::Stats { sea, seeds, json }) => {
            let (params, notices) = sea.read()?;
            let report = pollster::block_on(async { stats::run(&Gpu::request().await?, &params, seeds).await })?;
            if !json {
                report_notices(&notices);
            }
            print(&if json { report.json(&notices) } else { report.to_string() })
        }
        Some(Command::Check { sea }) => pollster::block_on(check(&sea.read_aloud()?)),
        Some(Command::Bench { sea, sizes, no_picture, matrix, baseline, repeat, json }) => {
            let sizes = match (no_picture, matrix) {
                (true, _) => Vec::new(),
                (_, true) => bench::MATRIX_SIZES.to_vec(),
                _ => sizes,
            };
            let options = Options { sizes, repeat, matrix, baseline };
            print(&pollster::block_on(bench::run(&sea.read_aloud()?, &options, json))?)
        }
        Some(Command::Info { json }) => print(&pollster::block_on(info::run(json))?),
        Some(Command::Validate(options)) => validate::run(&options).and_then(|said| print(&said)),
        Some(Command::Gallery(options)) => gallery::run(&options).and_then(|said| print(&said)),
        Some(Command::Keys { markdown }) => print(&if markdown { parameters::page() } else { keys() }),
    }
}

async fn check(params: &Params) -> Result<i32, String> {
    let gpu = Gpu::request().await?;
    let info = gpu.device.adapter_info();
    let lines = check::run(&gpu, params, &crate::shaders::Shaders::default()).await?;
    let mut text = format!("{} ({})\n", info.name, info.backend);
    let _ = writeln!(text, "{:<34} {:>7} {:>12} {:>12}", "pass", "cascade", "error", "tolerance");
    for line in &lines {
        let _ = writeln!(text, "{line}");
    }
    let wrong = lines.iter().filter(|l| !l.passes()).count();
    let verdict = if wrong == 0 { "all within tolerance".to_owned() } else { format!("{wrong} out of tolerance") };
    let _ = writeln!(text, "{} comparisons, {verdict}", lines.len());
    print(&text)?;
    Ok(i32::from(wrong > 0))
}

fn report_notices(notices: &[String]) {
    for notice in notices {
        eprintln!("seastate: {notice}");
    }
}

/// Writes to stdout; a closed pipe (`seastate stats | head`) is an error in one line, not a panic.
fn print(text: &str) -> Result<i32, String> {
    use std::io::Write as _;
    writeln!(std::io::stdout(), "{}", text.trim_end()).map(|()| 0).map_err(|e| format!("cannot write: {e}"))
}

fn keys() -> String {
    let mut text = String::new();
    for field in FIELDS.iter() {
        let unit = if field.unit.is_empty() { String::new() } else { format!(" {}", field.unit) };
        let default = field.format(field.default_value());
        let _ = writeln!(text, "{:<10} {} (default {default}{unit})", field.key, field.range());
        let _ = writeln!(text, "           {}", field.help);
    }
    text += "measured   a buoy's spectrum, shown by spectrum=measured: bands f*S or f*S*alpha1*alpha2*r1*r2, separated by _\n";
    text += "           Hz, m2/Hz, degrees that the waves come from, and 0..1. Written by the program when it reads a file.\n";
    text += "afloat     what floats where: buoy or boat, metres east, metres south, joined by *, separated by _ (at most 16)\n";
    text +=
        "sky        name of a sky's file, equirectangular .hdr or .exr, that is dropped on the sea or given by --sky\n";
    text
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let parts = text.split_once(['x', 'X']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match parts {
        Some(size) if size.iter().all(|side| (1..=MAX_SIDE).contains(side)) => Ok(size),
        _ => Err(format!("a size is WIDTHxHEIGHT, each from 1 to {MAX_SIDE}, such as 1280x720")),
    }
}
