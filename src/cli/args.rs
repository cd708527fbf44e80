//! The arguments of the command line.

use crate::files::measured::MeasuredSpectrum;
use crate::lab::flip;
use crate::state::{Params, query};
use clap::{Parser, Subcommand};
use std::path::PathBuf;

/// Most pixels of a picture along a side.
pub const MAX_SIDE: u32 = 8192;

/// The command line.
#[derive(Parser)]
#[command(
    name = "seastate",
    version,
    about = "An ocean you can believe: sea states computed on the GPU from oceanographic spectra",
    args_conflicts_with_subcommands = true,
    after_help = "A STATE is a query string such as 'wind=14&fetch=300&t=40', or a whole page address; \
                  see 'seastate keys'.\n\
                  WGPU_ADAPTER_NAME and WGPU_BACKEND choose the GPU."
)]
pub struct Cli {
    /// The command; `None` opens the window.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The sea to open in a window.
    #[command(flatten)]
    pub sea: SeaArgs,
}

/// A sea on the command line.
#[derive(clap::Args)]
pub struct SeaArgs {
    /// State string of the sea
    state: Option<String>,
    /// Measured spectrum to show: NDBC text (density, alpha1, alpha2, r1, r2 in one file or several) or CSV of f, S,
    /// direction, spread; repeat the option for the files of one buoy
    #[arg(long = "spectrum", value_name = "FILE")]
    spectrum: Vec<PathBuf>,
    /// Sky to show: an equirectangular picture in linear light, Radiance .hdr or OpenEXR
    #[arg(long, value_name = "FILE")]
    sky: Option<PathBuf>,
}

impl SeaArgs {
    /// The parameters, and notices about everything that was not taken as written.
    pub fn read(&self) -> Result<(Params, Vec<String>), String> {
        let (mut params, mut notices) = query::parse(self.state.as_deref().unwrap_or_default());
        if !self.spectrum.is_empty() {
            let files = crate::files::input::read_all(&self.spectrum)?;
            let file = MeasuredSpectrum::read(&files)?;
            notices.extend(file.notices);
            params.sea.show_measured(file.spectrum);
        }
        if let Some(path) = &self.sky {
            let file = crate::app::native::read_sky(path)?;
            notices.extend(file.image.iter().flat_map(|p| p.notices.iter().map(|n| format!("{}: {n}", file.name))));
            params.look.sky.file = Some(file);
        }
        notices.extend(params.look.sky.missing_file());
        Ok((params, notices))
    }
}

/// The commands.
#[derive(Subcommand)]
pub enum Command {
    /// Renders a picture
    Render {
        #[command(flatten)]
        sea: SeaArgs,
        /// Width and height in pixels
        #[arg(long, default_value = "1280x720", value_parser = parse_size)]
        size: [u32; 2],
        /// PNG file to write; with --frames, folder for frame-00000.png, frame-00001.png, ...
        #[arg(short, long, default_value = "sea.png")]
        output: PathBuf,
        /// Renders a sequence in time with this number of pictures
        #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1_000_000), conflicts_with = "reference")]
        frames: Option<u32>,
        /// Pictures per second of the sequence
        #[arg(long, default_value_t = 30.0)]
        fps: f64,
        /// With --frames: also writes an OpenEXR file for each picture, with linear light (R, G, B), distance along the
        /// view in m (Z) and the normal in world axes (N.X east, N.Y up, N.Z south)
        #[arg(long, requires = "frames")]
        layers: bool,
        /// Renders the reference that the picture approximates: many unfiltered samples per pixel
        #[arg(long)]
        reference: bool,
        /// Samples per pixel of the reference
        #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=65_536))]
        samples: u32,
        /// Seed of the sample positions of the reference
        #[arg(long, default_value_t = 1)]
        reference_seed: u32,
    },
    /// Prints the perceived difference of two pictures: mean FLIP, from 0 (equal) to 1
    Compare {
        /// The picture to compare with, PNG
        reference: PathBuf,
        /// The picture to judge, PNG of equal size
        test: PathBuf,
        /// PNG of the difference to write; black pixels are equal
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
        /// Folder to write to; created if missing
        #[arg(short, long)]
        output: PathBuf,
        /// Also writes heights.f32 and displacement.f16: the numbers without a header, cascade by cascade
        #[arg(long)]
        raw: bool,
    },
    /// Prints theoretical, resolved and measured statistics of a sea
    Stats {
        #[command(flatten)]
        sea: SeaArgs,
        /// Number of seeds to measure
        #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
        seeds: u32,
        /// Prints JSON
        #[arg(long)]
        json: bool,
    },
    /// Compares every GPU pass with its twin in double precision
    Check {
        #[command(flatten)]
        sea: SeaArgs,
    },
    /// Measures the time of every GPU pass
    Bench {
        #[command(flatten)]
        sea: SeaArgs,
        /// Width and height of a picture in pixels; repeat the option for several pictures
        #[arg(long = "size", default_value = "1280x720", value_parser = parse_size)]
        sizes: Vec<[u32; 2]>,
        /// Measures no picture
        #[arg(long)]
        no_picture: bool,
        /// Measures the simulation for n from 128 to 1024 with 1 to 4 cascades, and pictures of three sizes
        #[arg(long)]
        matrix: bool,
        /// Also measures the waves with one dispatch for every stage of every transform, as browser demos compute them
        #[arg(long)]
        baseline: bool,
        /// Submissions for each number
        #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=10_000))]
        repeat: u32,
        /// Prints JSON
        #[arg(long)]
        json: bool,
    },
    /// Prints the program's version, its GPU, and how it uses the GPU
    Info {
        /// Prints JSON
        #[arg(long)]
        json: bool,
    },
    /// Writes the validation page and its figures: the program's numbers against theory and published measurements
    Validate {
        /// Folder for validation.md and validation/
        #[arg(short, long, default_value = "docs")]
        output: PathBuf,
        /// Number of seeds to measure
        #[arg(long, default_value_t = 12, value_parser = clap::value_parser!(u32).range(2..=10_000))]
        seeds: u32,
        /// Writes validation-all.md instead: every spectrum with every spreading in thirteen sea states
        #[arg(long)]
        all: bool,
        /// With --all: only the states that contain this text, such as 'spectrum=pm&spread=cos2&'
        #[arg(long, requires = "all", default_value = "", hide_default_value = true)]
        only: String,
    },
    /// Renders the gallery's pictures and writes its page
    Gallery {
        /// Folder for gallery.md and gallery/
        #[arg(short, long, default_value = "docs")]
        output: PathBuf,
        /// Renders only the pictures whose title contains this text
        #[arg(long, default_value = "", hide_default_value = true)]
        only: String,
    },
    /// Lists the keys of the state string
    Keys {
        /// Prints docs/parameters.md
        #[arg(long)]
        markdown: bool,
    },
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let parts = text.split_once(['x', 'X']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match parts {
        Some(size) if size.iter().all(|side| (1..=MAX_SIDE).contains(side)) => Ok(size),
        _ => Err(format!("a size is WIDTHxHEIGHT, each from 1 to {MAX_SIDE}, such as 1280x720")),
    }
}
