//! Benchmark: times every pass, and measures for comparison the adapter's peak rates and a baseline that computes the
//! waves as browser demos do. Runs natively and on the web page.

pub mod ceilings;
pub mod clock;
pub mod cost;
pub mod per_stage;

use crate::gpu::Gpu;
use crate::gpu::offscreen;
use crate::ocean::passes::{MapSizes, WavePass};
use crate::ocean::{Film, Ocean, Part};
use crate::state::camera::View;
use crate::state::{Params, query};
use ceilings::Ceilings;
use clock::{Stopwatch, Timing};
use cost::Cost;
use per_stage::PerStage;
use std::fmt;

/// Texture format of the pictures that are timed.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// FFT sizes of the benchmark matrix, which times the simulation for each size and number of cascades.
const MATRIX_N: [u32; 4] = [128, 256, 512, 1024];
const MATRIX_CASCADES: [u32; 4] = [1, 2, 3, 4];
/// FFT size and number of cascades of each comparison with the baseline.
const BASELINES: [[u32; 2]; 2] = [[256, 3], [512, 4]];

/// What a benchmark measures, and how often.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchOptions {
    /// Widths and heights of the timed pictures, pixels. If empty, no picture is timed.
    pub sizes: Vec<[u32; 2]>,
    /// Number of timed submissions for each measurement.
    pub repeat: u32,
    /// Whether to time the simulation for every FFT size and number of cascades, instead of only for the given state.
    pub matrix: bool,
    /// Whether to time the baseline, an FFT with one dispatch per stage, as well.
    pub baseline: bool,
}

/// Measured time of one pass, with what is needed to judge it.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTiming {
    /// Name of the pass, as it stands in the report.
    pub pass: &'static str,
    /// FFT size and number of cascades. None for passes of the picture.
    pub sea: Option<[u32; 2]>,
    /// Width and height of the picture, pixels. None for passes of the simulation.
    pub size: Option<[u32; 2]>,
    /// Measured times of the pass.
    pub timing: Timing,
    /// Minimum memory traffic and arithmetic of the pass, where known.
    pub cost: Option<Cost>,
    /// Number of compute dispatches of the pass, where counted.
    pub dispatches: Option<u32>,
}

impl PassTiming {
    fn sim(pass: &'static str, sea: [u32; 2], timing: Timing, cost: Option<Cost>) -> Self {
        Self { pass, sea: Some(sea), size: None, timing, cost, dispatches: None }
    }
}

/// Result of a benchmark: all times of one state on one adapter.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchReport {
    /// State string: the parameters of the timed state as text.
    pub state: String,
    /// Name of the graphics adapter and of its backend.
    pub adapter: String,
    /// Whether times are measured with GPU timestamps.
    pub has_stamps: bool,
    /// Number of timed submissions for each measurement.
    pub repeat: u32,
    /// Measured peak rates of the adapter.
    pub ceilings: Ceilings,
    /// Times of all measured passes, in the order of the measurements.
    pub rows: Vec<PassTiming>,
}

/// Runs the benchmark of a state on a device. `progress` gets the name of each measurement before it starts.
///
/// # Errors
/// If waiting for the GPU fails.
pub async fn run(
    gpu: &Gpu,
    params: &Params,
    options: &BenchOptions,
    mut progress: impl FnMut(&str),
) -> Result<BenchReport, String> {
    let adapter = gpu.device.adapter_info();
    let clock = Stopwatch::new(gpu, options.repeat);
    progress("ceilings");
    let ceilings = Ceilings::measure(&clock).await?;
    let mut rows = Vec::new();
    if options.matrix {
        for n in MATRIX_N {
            for cascades in MATRIX_CASCADES {
                progress(&format!("simulation, n {n}, cascades {cascades}"));
                rows.extend(simulation(&clock, &with_grid(params, [n, cascades])).await?);
            }
        }
    } else {
        progress("simulation");
        rows.extend(simulation(&clock, params).await?);
    }
    if options.baseline {
        for sea in BASELINES {
            progress(&format!("a dispatch per stage, n {}, cascades {}", sea[0], sea[1]));
            rows.extend(baseline(&clock, &with_grid(params, sea)).await?);
        }
    }
    for &size in &options.sizes {
        progress(&format!("picture of {}x{} pixels", size[0], size[1]));
        rows.extend(picture(&clock, params, size).await?);
    }
    Ok(BenchReport {
        state: query::write(params),
        adapter: format!("{} ({})", adapter.name, adapter.backend),
        has_stamps: clock.has_stamps(),
        repeat: clock.repeat,
        ceilings,
        rows,
    })
}

fn with_grid(params: &Params, [n, cascades]: [u32; 2]) -> Params {
    let mut out = params.clone();
    (out.grid.n, out.grid.cascades) = (n, cascades);
    out
}

/// Times the passes of the simulation: each pass alone, and all passes of a frame together.
async fn simulation(clock: &Stopwatch<'_>, params: &Params) -> Result<Vec<PassTiming>, String> {
    let mut ocean = Ocean::waves_only(clock.gpu, params);
    let MapSizes { n, cascades, foam_n, format } = ocean.map_sizes();
    let passes = ocean.wave_passes();
    let waves = [WavePass::Rows, WavePass::Columns];
    let step = [WavePass::Rows, WavePass::Columns, WavePass::Mips, WavePass::Foam];
    let measured: [(_, &[WavePass], _); 7] = [
        ("spectrum", &[WavePass::Spectrum], None),
        ("rows", &[WavePass::Rows], Some(cost::rows(n, cascades))),
        ("columns", &[WavePass::Columns], Some(cost::columns(n, cascades, format))),
        ("waves", &waves, Some(cost::waves(n, cascades, format))),
        ("mips", &[WavePass::Mips], Some(cost::mips(n, cascades, format))),
        ("foam", &[WavePass::Foam], Some(cost::foam(foam_n, cascades, format))),
        ("step", &step, Some(cost::step(n, foam_n, cascades, format))),
    ];
    let mut rows = Vec::new();
    for (name, recorded, cost) in measured {
        let timing = clock.time(|_, e| recorded.iter().for_each(|&pass| passes.record(e, pass))).await?;
        let dispatches = (name == "step").then(|| passes.dispatches());
        rows.push(PassTiming { dispatches, ..PassTiming::sim(name, [n, cascades], timing, cost) });
    }
    Ok(rows)
}

/// Times the program's waves and, for comparison, those of the baseline.
async fn baseline(clock: &Stopwatch<'_>, params: &Params) -> Result<Vec<PassTiming>, String> {
    let gpu = clock.gpu;
    let mut ocean = Ocean::waves_only(gpu, params);
    ocean.read_maps().await?;
    let MapSizes { n, cascades, format, .. } = ocean.map_sizes();
    let sea = [n, cascades];
    let theirs = PerStage::new(gpu, ocean.maps());
    let passes = ocean.wave_passes();
    let ours = clock.time(|_, e| {
        passes.record(e, WavePass::Rows);
        passes.record(e, WavePass::Columns);
    });
    let ours = PassTiming::sim("waves", sea, ours.await?, Some(cost::waves(n, cascades, format)));
    let timing = clock.time(|_, e| theirs.run(e)).await?;
    let theirs = PassTiming {
        dispatches: Some(theirs.dispatches() as u32),
        ..PassTiming::sim("waves, a dispatch per stage", sea, timing, None)
    };
    Ok(vec![ours, theirs])
}

/// Times the passes of a picture of `size` pixels, and whole frames with waves and foam at 60 frames per second.
async fn picture(clock: &Stopwatch<'_>, params: &Params, size: [u32; 2]) -> Result<Vec<PassTiming>, String> {
    let gpu = clock.gpu;
    let mut ocean = Ocean::new(gpu, FORMAT, Film::Screen, params);
    let target = offscreen::target(gpu, FORMAT, size);
    let mut encoder = gpu.encoder("picture");
    ocean.encode_fully(&mut encoder, size);
    gpu.submit(encoder);
    let row = |pass, timing| PassTiming { pass, sea: None, size: Some(size), timing, cost: None, dispatches: None };
    let counted = counted(params, &ocean, size);
    let MapSizes { n, cascades, foam_n, format } = ocean.map_sizes();
    let simulation = cost::step(n, foam_n, cascades, format);
    let mut out = Vec::new();
    for (pass, part) in
        [("sky tables", Part::Light), ("background", Part::Background), ("mesh", Part::Mesh), ("water", Part::Water)]
    {
        let cost = match part {
            Part::Light => None,
            Part::Background => Some(counted.background()),
            Part::Mesh => Some(counted.mesh()),
            Part::Water => Some(counted.water()),
        };
        out.push(PassTiming { cost, ..row(pass, clock.time(|_, encoder| ocean.record(encoder, part)).await?) });
    }
    let present = clock.time(|_, encoder| offscreen::draw_over(encoder, &target, |pass| ocean.present(pass)));
    out.push(PassTiming { cost: Some(counted.present()), ..row("present", present.await?) });
    let mut frame = params.clone();
    // Uniforms are written once per submission, so that a submission can hold only one frame.
    let mut one = Stopwatch::new(gpu, clock.repeat);
    one.at_once = 1;
    let frames = one.time(|i, encoder| {
        frame.clock.t_s = params.clock.t_s + f64::from(i) / 60.0;
        ocean.set_params(&frame);
        ocean.encode_fully(encoder, size);
        offscreen::draw_over(encoder, &target, |pass| ocean.present(pass));
    });
    let whole = simulation + counted.water() + counted.background() + counted.present();
    out.push(PassTiming { cost: Some(whole), ..row("frame", frames.await?) });
    // Frames while the user drags the wind slider.
    let dragged = one.time(|i, encoder| {
        frame.clock.t_s += 1.0 / 60.0;
        if let Some(wind) = frame.sea.systems.first_mut() {
            wind.wind_m_s = params.sea.first_system().wind_m_s + 0.01 * f64::from(i % 50);
        }
        ocean.transition_to(&frame, 1.0 / 60.0);
        ocean.encode_fully(encoder, size);
        offscreen::draw_over(encoder, &target, |pass| ocean.present(pass));
    });
    out.push(row("frame, wind dragged", dragged.await?));
    Ok(out)
}

/// Counts the pixels, vertices and map bytes of the picture of a state.
fn counted(params: &Params, ocean: &Ocean, size: [u32; 2]) -> cost::PictureContents {
    let sizes = ocean.map_sizes();
    let [width, height] = size.map(f64::from);
    let view = View::new(&params.camera, width / height, 0.0);
    // With a level view, the lower half of the picture is below the horizon.
    let horizon = (-params.camera.pitch_deg.to_radians()).tan() / view.tan_half_fov[1];
    let texels = f64::from(sizes.n * sizes.n) * f64::from(sizes.cascades) * 4.0 / 3.0;
    cost::PictureContents {
        pixels: width * height,
        sea: (0.5 + 0.5 * horizon).clamp(0.0, 1.0),
        vertices: f64::from(ocean.vertices()),
        map_bytes: texels * f64::from(sizes.format.bytes()),
    }
}

impl BenchReport {
    /// Ratio of the time of the pass `of` to that of the last pass with the name `over` and the same FFT size.
    fn ratio(&self, of: &PassTiming, over: &'static str) -> Option<f64> {
        let other = self.rows.iter().rfind(|r| r.pass == over && r.sea.map(|s| s[0]) == of.sea.map(|s| s[0]))?;
        Some(of.timing.ms() / other.timing.ms())
    }

    /// Sentences that compare the times of the program with those of the baseline.
    pub fn comparisons(&self) -> Vec<String> {
        let mut out = Vec::new();
        for theirs in self.rows.iter().filter(|r| r.pass == "waves, a dispatch per stage") {
            let [n, cascades] = theirs.sea.unwrap_or_default();
            if let Some(ratio) = self.ratio(theirs, "waves") {
                out.push(format!(
                    "waves of {cascades} x {n}^2: {ratio:.1} times faster than with a dispatch per stage"
                ));
            }
        }
        let baseline = self.rows.iter().find(|r| r.pass == "waves, a dispatch per stage");
        for frame in self.rows.iter().filter(|r| r.pass == "frame") {
            if let (Some(baseline), Some([w, h])) = (baseline, frame.size) {
                let ratio = frame.timing.ms() / baseline.timing.ms();
                out.push(format!(
                    "frame of {w}x{h}: {ratio:.2} times the waves of 3 x 256^2 with a dispatch per stage"
                ));
            }
        }
        out
    }
}

impl fmt::Display for BenchReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let c = &self.ceilings;
        writeln!(f, "{}, '{}', {} submissions each", self.adapter, self.state, self.repeat)?;
        writeln!(
            f,
            "copy {:.2} GB/s, empty dispatch {:.4} ms, fragment arithmetic {:.2} GFLOP/s, reads of a map {:.4} G/s; {}",
            c.copy_gb_s,
            c.launch_ms,
            c.shading_gflop_s,
            c.reads_g_s,
            if self.has_stamps { "GPU times by timestamps" } else { "no timestamps: times from submission to end" }
        )?;
        writeln!(
            f,
            "{:<32} {:>12} {:>10} {:>10} {:>20} {:>10} {:>8} {:>9} {:>9} {:>12}",
            "pass", "of", "GPU, ms", "done, ms", "10 % to 90 %", "CPU, ms", "MB", "MFLOP", "x memory", "x arithmetic"
        )?;
        let number = |value: Option<f64>, digits: usize| value.map_or("-".to_owned(), |v| format!("{v:.digits$}"));
        for row in &self.rows {
            let t = &row.timing;
            let of = match (row.sea, row.size) {
                (Some([n, cascades]), _) => format!("{cascades} x {n}^2"),
                (_, Some([w, h])) => format!("{w}x{h}"),
                _ => String::new(),
            };
            let floor_ms = row.cost.map(|cost| 1e-6 * cost.bytes / c.copy_gb_s);
            writeln!(
                f,
                "{:<32} {of:>12} {:>10} {:>10.3} {:>10.3} {:>9.3} {:>10} {:>8} {:>9} {:>9} {:>12}",
                row.pass,
                number(t.gpu, 3),
                t.spread[1],
                t.spread[0],
                t.spread[2],
                number(t.cpu, 3),
                number(row.cost.map(|cost| 1e-6 * cost.bytes), 2),
                number(row.cost.map(|cost| 1e-6 * cost.flops), 1),
                number(floor_ms.map(|floor| t.ms() / floor), 1),
                number(row.cost.map(|cost| t.ms() / (1e-6 * cost.flops / c.shading_gflop_s)), 1),
            )?;
        }
        for (row, dispatches) in self.rows.iter().filter_map(|r| Some((r, r.dispatches?))) {
            writeln!(f, "{}: {dispatches} compute dispatches", row.pass)?;
        }
        self.comparisons().iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}
