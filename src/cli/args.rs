//! The arguments of the command line.

use crate::coast::PlacedCoast;
use crate::files::bathymetry::{self, ReadAs};
use crate::files::input;
use crate::files::measured::MeasuredSpectrum;
use crate::lab::flip;
use crate::lab::validate::PAGE_PARTS;
use crate::state::coast::{CoastFile, CoastName};
use crate::state::start::given_or_start;
use crate::state::{Params, query};
use clap::{Parser, Subcommand};
use std::path::PathBuf;
use std::sync::Arc;

/// Largest width and height of a picture, pixels.
pub const MAX_PICTURE_SIDE: u32 = 8192;

/// The parsed command line: a command, or the sea to show in the window.
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
    /// The command to run; `None` opens the window.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The sea to show in the window if there is no command.
    #[command(flatten)]
    pub sea: SeaArgs,
}

/// The arguments that describe a sea: state string, measured spectrum and sky image.
#[derive(clap::Args)]
pub struct SeaArgs {
    /// State string of the sea. Without it the window opens with a composed sea, and a command takes the defaults
    state: Option<String>,
    /// Measured spectrum to show: NDBC text (density, alpha1, alpha2, r1, r2 in one file or several), CSV of f, S,
    /// direction, spread or of densities over f and direction, SWAN (.spc, .sp2), WAVEWATCH III (text or NetCDF), ERA5
    /// (NetCDF) or Spotter (JSON); repeat the option for the files of one buoy
    #[arg(long = "spectrum", value_name = "FILE")]
    spectrum: Vec<PathBuf>,
    /// Which spectrum of a file with several times or places, from 0; without it the one with the most energy, or the
    /// newest of a buoy. 'seastate spectra' lists them
    #[arg(long, value_name = "N", requires = "spectrum")]
    spectrum_index: Option<usize>,
    /// Sky image to show: an equirectangular picture in linear light, Radiance .hdr or OpenEXR
    #[arg(long, value_name = "FILE")]
    sky: Option<PathBuf>,
    /// Bathymetry that the sea runs up to: GeoTIFF, NetCDF as GEBCO gives it, ESRI ASCII grid, or text of x, y, z
    #[arg(long, value_name = "FILE")]
    bathymetry: Option<PathBuf>,
}

impl SeaArgs {
    /// Whether these arguments say which sea to show.
    pub fn names_sea(&self) -> bool {
        !self.spectrum.is_empty() || self.state.as_ref().is_some_and(|state| !state.is_empty())
    }

    /// These arguments with the state of the first sea, if they name neither a state nor a spectrum.
    pub fn or_start(mut self) -> Self {
        if self.spectrum.is_empty() {
            self.state = Some(given_or_start(self.state.as_deref().unwrap_or_default()).to_owned());
        }
        self
    }

    /// Reads the parameters and the named files. Also returns notices about everything that was changed or ignored.
    pub fn read(&self) -> Result<(Params, Vec<String>), String> {
        let (mut params, mut notices) = query::parse(self.state.as_deref().unwrap_or_default());
        if !self.spectrum.is_empty() {
            let files = input::read_all(&self.spectrum)?;
            let file = MeasuredSpectrum::read_list(&files)?.choose(self.spectrum_index)?;
            notices.extend(file.notices);
            params.sea.set_measured_spectrum(file.spectrum);
        }
        if let Some(path) = &self.sky {
            let file = crate::app::native::read_sky_file(path)?;
            notices.extend(file.image.iter().flat_map(|p| p.notices.iter().map(|n| format!("{}: {n}", file.name))));
            params.look.sky.file = Some(file);
        }
        if let Some(path) = &self.bathymetry {
            let (name, bytes) = input::read_up_to(path, bathymetry::MAX_FILE_BYTES)?;
            let file = Arc::new(bathymetry::read(&name, &bytes, ReadAs::default())?);
            (params.coast.name, params.coast.file) = (CoastName::File, Some(CoastFile(file)));
        }
        notices.extend(params.look.sky.missing_file_notice());
        match PlacedCoast::of_state(&params.coast, None) {
            Ok(land) => notices.extend(land.into_iter().flat_map(|land| land.notices)),
            Err(_) if params.coast.file.is_none() => notices.extend(params.coast.missing_file_notice()),
            Err(reason) => return Err(reason),
        }
        Ok((params, notices))
    }
}

/// The commands of the command line.
#[derive(Subcommand)]
pub enum Command {
    /// Renders a picture, or with --frames a sequence of pictures
    Render {
        #[command(flatten)]
        sea: SeaArgs,
        /// Width and height of the picture in pixels
        #[arg(long, default_value = "1280x720", value_parser = parse_size)]
        size: [u32; 2],
        /// PNG file to write; with --frames, folder for frame-00000.png, frame-00001.png, ...
        #[arg(short, long, default_value = "sea.png")]
        output: PathBuf,
        /// Renders a sequence of this number of pictures over time
        #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1_000_000), conflicts_with = "reference")]
        frames: Option<u32>,
        /// Pictures per second; two pictures are speed / fps seconds of simulated time apart
        #[arg(long, default_value_t = 30.0)]
        fps: f64,
        /// With --frames: also writes an OpenEXR file for each picture, with linear light (R, G, B), distance along the
        /// view in m (Z) and the normal in world axes (N.X east, N.Y up, N.Z south)
        #[arg(long, requires = "frames")]
        layers: bool,
        /// Renders a reference picture of many unfiltered samples per pixel, which the usual picture approximates
        #[arg(long)]
        reference: bool,
        /// Minimum number of samples per pixel of the reference picture
        #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=65_536))]
        samples: u32,
        /// Seed of the sample positions in the reference picture
        #[arg(long, default_value_t = 1)]
        reference_seed: u32,
    },
    /// Prints the perceived difference of two pictures: mean FLIP, from 0 (equal) to 1
    Compare {
        /// PNG file of the reference picture
        reference: PathBuf,
        /// PNG file of the picture to compare with the reference, of equal size
        test: PathBuf,
        /// Grey PNG file to write the difference of each pixel to: black for none, white for the largest
        #[arg(long)]
        map: Option<PathBuf>,
        /// Pixels per degree of visual angle: 67 for a 4K screen of 70 cm seen from 70 cm
        #[arg(long, default_value_t = flip::PIXELS_PER_DEGREE)]
        ppd: f64,
    },
    /// Writes the wave maps of every cascade, the foam map, and their description as plan.json; or the spectrum
    Export {
        #[command(flatten)]
        sea: SeaArgs,
        /// Folder to write the files to; created if missing
        #[arg(short, long, required_unless_present = "spectrum_to")]
        output: Option<PathBuf>,
        /// Writes the density of the sea over frequency and direction to a file, for other programs: .csv, .sp2 (SWAN)
        /// or .nc (classic NetCDF with the names of WAVEWATCH III). Needs no GPU
        #[arg(long, value_name = "FILE")]
        spectrum_to: Option<PathBuf>,
        /// Also writes heights.f32 (m) and displacement.f16 (as the renderer reads it): texels without a header, one
        /// cascade after the other
        #[arg(long)]
        raw: bool,
    },
    /// Writes time series of elevation, velocity of the water and dynamic pressure at points. Needs no GPU
    Record {
        #[command(flatten)]
        sea: SeaArgs,
        /// Point to record: metres to the east, metres to the north, and the height from the still water (negative
        /// below; without it the moving surface); repeat the option for several points
        #[arg(long, required = true, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = parse_point)]
        at: Vec<(f64, f64, Option<f64>)>,
        /// Length of the record in hours
        #[arg(long, default_value_t = 3.0)]
        hours: f64,
        /// Samples per second
        #[arg(long, default_value_t = 4.0)]
        rate: f64,
        /// Number of waves that are summed: the strongest of the sea
        #[arg(long, default_value_t = 5000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
        waves: u32,
        /// File to write: .csv, or .nc for classic NetCDF
        #[arg(short, long)]
        output: PathBuf,
    },
    /// Solves what the sea becomes over a coast: prints heights, directions and breaking from the open sea to the beach, and
    /// writes maps, fields and gauges. Needs no GPU. The window, the page and 'render' draw the sea at a coast if the
    /// state names one: coast=NAME
    #[command(after_help = "Built-in coasts:\n  \
        beach     a long sandy beach before dunes\n  \
        headland  a rocky headland beside a bay\n  \
        island    an island before a beach\n  \
        harbour   two breakwaters of rubble around a basin with a quay\n  \
        bar       a sand bar along a beach, cut by a channel\n  \
        shoal     an underwater hill that focuses waves\n\
        Example: seastate coast 'hs=2&tp=9' --coast headland -o headland.png --gauges '900,600;1300,1150'")]
    Coast(super::coast::CoastArgs),
    /// Lists the spectra of a file with several times or places: number, height, peak period, time and place
    Spectra {
        /// The file, or the files of one buoy
        #[arg(required = true)]
        files: Vec<PathBuf>,
    },
    /// Prints statistics of a sea: by theory, of the waves on the FFT grids (resolved), and measured on the GPU
    Stats {
        #[command(flatten)]
        sea: SeaArgs,
        /// Number of seeds over which statistics are measured
        #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
        seeds: u32,
        /// Also measures crests, troughs and wave heights in a record of each seed at a fixed point, computed on the
        /// CPU, and writes their exceedance beside theory to this CSV file
        #[arg(long, value_name = "FILE")]
        crests: Option<PathBuf>,
        /// Length of each record in hours; a sea repeats after a day
        #[arg(long, default_value_t = 3.0, requires = "crests", value_parser = parse_hours)]
        hours: f64,
        /// Prints JSON instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Compares every GPU pass of the simulation with the same calculation on the CPU in double precision
    Check {
        #[command(flatten)]
        sea: SeaArgs,
    },
    /// Measures the time of every GPU pass
    Bench {
        #[command(flatten)]
        sea: SeaArgs,
        /// Width and height of a picture in pixels; repeat the option for several pictures. Without it, 1280x720 is
        /// measured, and the budget is for 1920x1080
        #[arg(long = "size", value_parser = parse_size)]
        sizes: Vec<[u32; 2]>,
        /// Measures nothing and needs no GPU: prints counted work of each pass and predicted times on classes of GPUs
        #[arg(long, conflicts_with_all = ["no_picture", "matrix", "baseline", "repeat", "json"])]
        budget: bool,
        /// Measures the simulation only, and no picture
        #[arg(long)]
        no_picture: bool,
        /// Measures the simulation for FFT sizes n from 128 to 1024 with 1 to 4 cascades, and pictures of three sizes
        #[arg(long)]
        matrix: bool,
        /// Also measures a baseline, as browser demos compute waves: one dispatch for every stage of every FFT
        #[arg(long)]
        baseline: bool,
        /// Number of GPU submissions from which each time is determined
        #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=10_000))]
        repeat: u32,
        /// Prints JSON instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Prints the program's version, its GPU, and how it uses the GPU
    Info {
        /// Prints JSON instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Writes the validation page and its figures: the program's numbers against theory and published measurements
    Validate {
        /// Folder to which validation.md and the folder validation/ are written
        #[arg(short, long, default_value = "docs")]
        output: PathBuf,
        /// Number of seeds over which statistics are measured
        #[arg(long, default_value_t = 12, value_parser = clap::value_parser!(u32).range(2..=10_000))]
        seeds: u32,
        /// Writes only this part, such as coast, in place of the one in the page that is there
        #[arg(long, value_parser = clap::builder::PossibleValuesParser::new(PAGE_PARTS))]
        only: Option<String>,
    },
    /// Renders the gallery's pictures and writes its page
    Gallery {
        /// Folder to which gallery.md and the folder gallery/ are written
        #[arg(short, long, default_value = "docs")]
        output: PathBuf,
        /// Renders only the pictures whose title contains this text
        #[arg(long, default_value = "", hide_default_value = true)]
        only: String,
        /// Renders the thumbnails of the named seas instead, to this file (assets/thumbnails/seas.jpg)
        #[arg(long, conflicts_with = "only")]
        thumbnails: Option<PathBuf>,
    },
    /// Lists the keys of the state string, with units, ranges, defaults and meaning
    Keys {
        /// Prints the list as the Markdown of docs/parameters.md
        #[arg(long)]
        markdown: bool,
    },
}

fn parse_point(text: &str) -> Result<(f64, f64, Option<f64>), String> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|n| n.trim().parse().ok().filter(|v: &f64| v.is_finite())).collect();
    match numbers.as_deref() {
        Some([x, y]) => Ok((*x, *y, None)),
        Some([x, y, z]) => Ok((*x, *y, Some(*z))),
        _ => Err("a point is X,Y or X,Y,Z in metres, such as 10,-20,-5".to_owned()),
    }
}

fn parse_hours(text: &str) -> Result<f64, String> {
    let hours = text.parse().ok().filter(|hours| (0.05..=24.0).contains(hours));
    hours.ok_or_else(|| "a record has a length of 0.05 to 24 hours".to_owned())
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let parts = text.split_once(['x', 'X']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match parts {
        Some(size) if size.iter().all(|side| (1..=MAX_PICTURE_SIDE).contains(side)) => Ok(size),
        _ => Err(format!("a size is WIDTHxHEIGHT, each from 1 to {MAX_PICTURE_SIDE}, such as 1280x720")),
    }
}
