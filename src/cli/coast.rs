//! `seastate coast`: what a sea becomes over a built-in coast or the bathymetry of a file.

use super::args::SeaArgs;
use crate::coast::BuiltInCoast;
use crate::coast::built_in::BUILT_IN;
use crate::coast::placed::{PlacedCoast, PlacingOptions};
use crate::files::bathymetry::{self, ReadAs};
use crate::files::input;
use crate::lab::coast::{self, CoastSea, CoastSettings, Solver};
use crate::state::Params;
use clap::ValueEnum;
use std::path::{Path, PathBuf};

/// The arguments of the command.
#[derive(clap::Args)]
pub struct CoastArgs {
    #[command(flatten)]
    pub sea: SeaArgs,
    /// Built-in coast (beach, headland, island, harbour, bar, shoal), or a file with heights or depths: GeoTIFF, NetCDF
    /// as GEBCO gives it, ESRI ASCII grid, or text of x, y, z
    #[arg(long, value_name = "NAME|FILE")]
    coast: String,
    /// Direction from the sea to the land, degrees clockwise from north. Without it, a built-in coast has its own, and a
    /// file that in which the sea floor rises
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = parse_degrees)]
    toward: Option<f64>,
    /// Side of the square that is cut out of a file, m; without it as much as the file holds, at most 4000
    #[arg(long, value_name = "M")]
    size: Option<f64>,
    /// Middle of that square: metres east and north of the middle of the file
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = parse_point)]
    centre: Option<[f64; 2]>,
    /// Distance of two points of the grid on which the waves are solved, m; without it 1/200 of the side
    #[arg(long, value_name = "M")]
    cell: Option<f64>,
    /// What a file does not say itself: 'up' for heights or 'down' for depths, 'degrees' of longitude and latitude or
    /// 'metres'; several words separated by commas
    #[arg(long, value_name = "WORDS", value_delimiter = ',')]
    read_as: Vec<Word>,
    /// Gauges: points x,y in metres, separated by semicolons; x from the sea to the land, y along the shore, as on the maps
    #[arg(long, value_name = "X,Y;X,Y", allow_hyphen_values = true, value_delimiter = ';', value_parser = parse_point)]
    gauges: Vec<[f64; 2]>,
    /// File to write, by its ending: .png or .svg for the maps, .nc for the fields as NetCDF, .csv for the gauges with
    /// their spectra; repeat the option for several files
    #[arg(short, long = "output", visible_alias = "out", value_name = "FILE")]
    output: Vec<PathBuf>,
    /// CSV file for the elevation of the surface at the gauges over time
    #[arg(long, value_name = "FILE", requires = "gauges")]
    record: Option<PathBuf>,
    /// Length of that record in hours
    #[arg(long, default_value_t = 0.5, requires = "record")]
    hours: f64,
    /// Samples per second of that record
    #[arg(long, default_value_t = 4.0, requires = "record")]
    rate: f64,
    /// Number of waves, the strongest of the sea, that are summed for the picture of the surface and for the record
    #[arg(long, default_value_t = 300, value_parser = clap::value_parser!(u32).range(1..=2000))]
    waves: u32,
    /// Equation of the waves: parabolic is faster, elliptic also reflects waves from structures and steep shores. Without
    /// the option it is elliptic for a coast with structures
    #[arg(long)]
    solver: Option<Equation>,
}

/// The equations, as the option names them.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Equation {
    Parabolic,
    Elliptic,
}

/// A word about a file.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Word {
    Up,
    Down,
    Degrees,
    Metres,
}

/// What a file of the command holds.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Png,
    Svg,
    NetCdf,
    Csv,
}

impl Format {
    fn for_path(path: &Path) -> Result<Self, String> {
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("png") => Ok(Self::Png),
            Some("svg") => Ok(Self::Svg),
            Some("nc") => Ok(Self::NetCdf),
            Some("csv") => Ok(Self::Csv),
            _ => Err(format!("{}: the name of a file about a coast ends in .png, .svg, .nc or .csv", path.display())),
        }
    }
}

/// Runs the command for the sea of `params`, and returns the table. `report` prints notices.
pub fn run(args: &CoastArgs, params: &Params, report: impl Fn(&[String])) -> Result<String, String> {
    let formats = args.output.iter().map(|path| Format::for_path(path)).collect::<Result<Vec<_>, _>>()?;
    if formats.contains(&Format::Csv) && args.gauges.is_empty() {
        return Err("a .csv file holds the sea at gauges: name some with --gauges X,Y;X,Y".into());
    }
    let coast = args.placed()?;
    report(&coast.notices);
    let has_surface = args.record.is_some() || formats.iter().any(|format| *format != Format::Csv);
    let wave_count = if has_surface { args.waves as usize } else { 0 };
    let solver = args.solver.map(|solver| match solver {
        Equation::Parabolic => Solver::Parabolic,
        Equation::Elliptic => Solver::Elliptic,
    });
    let settings = CoastSettings { gauges_m: args.gauges.clone(), wave_count, solver };
    let sea = coast::run(params, coast, &settings)?;
    for (path, format) in args.output.iter().zip(&formats) {
        let bytes = match format {
            Format::Png => sea.figure().png()?,
            Format::Svg => sea.figure().svg()?.into_bytes(),
            Format::NetCdf => sea.netcdf(),
            Format::Csv => sea.gauges.csv(&format!("seastate coast '{}'", sea.state), &sea.coast.title).into_bytes(),
        };
        write(path, &bytes)?;
    }
    if let Some(path) = &args.record {
        write(path, sea.record_csv(params.clock.t_s, args.hours, args.rate)?.as_bytes())?;
    }
    Ok(CoastSea::to_string(&sea))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|e| format!("cannot write {}: {e}", path.display()))
}

impl CoastArgs {
    /// The coast that the arguments name, at its place.
    fn placed(&self) -> Result<PlacedCoast, String> {
        let options = PlacingOptions {
            toward_deg: self.toward,
            size_m: self.size,
            centre_m: self.centre.unwrap_or_default(),
            cell_m: self.cell,
        };
        if let Some(coast) = BuiltInCoast::find(&self.coast) {
            return PlacedCoast::built_in(coast, &options);
        }
        let path = Path::new(&self.coast);
        if !path.exists() {
            let names = BUILT_IN.iter().map(|coast| coast.name).collect::<Vec<_>>().join(", ");
            return Err(format!("{} is neither a file nor one of the built-in coasts {names}", self.coast));
        }
        let (name, bytes) = input::read_up_to(path, bathymetry::MAX_FILE_BYTES)?;
        let said = |yes: Word, no: Word| match (self.read_as.contains(&yes), self.read_as.contains(&no)) {
            (true, true) => Err("--read-as contradicts itself: give up or down, and degrees or metres".to_owned()),
            (false, false) => Ok(None),
            (yes, _) => Ok(Some(yes)),
        };
        let read_as =
            ReadAs { is_positive_up: said(Word::Up, Word::Down)?, is_in_degrees: said(Word::Degrees, Word::Metres)? };
        PlacedCoast::from_file(&bathymetry::read(&name, &bytes, read_as)?, &options)
    }
}

fn parse_point(text: &str) -> Result<[f64; 2], String> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|n| n.trim().parse().ok().filter(|v: &f64| v.is_finite())).collect();
    match numbers.as_deref() {
        Some([x, y]) => Ok([*x, *y]),
        _ => Err("a point is X,Y in metres, such as 900,400".to_owned()),
    }
}

fn parse_degrees(text: &str) -> Result<f64, String> {
    let deg = text.parse().ok().filter(|deg: &f64| (-360.0..=360.0).contains(deg));
    deg.ok_or_else(|| "a direction is 0 to 360 degrees".to_owned())
}
