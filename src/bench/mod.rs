//! Benchmark: times every pass, and measures for comparison the adapter's peak rates and a baseline that computes the
//! waves as browser demos do. Runs natively and on the web page.

pub mod budget;
pub mod clock;
pub mod cost;
pub mod peak_rates;
pub mod planned;
pub mod stagewise_fft;

use crate::gpu::Gpu;
use crate::gpu::offscreen;
use crate::ocean::passes::{MapSizes, WavePass};
use crate::ocean::{Ocean, OutputKind, TimedPart};
use crate::state::{Params, query};
use budget::GPU_CLASSES;
use clock::{Stopwatch, Timing};
use cost::Cost;
use peak_rates::PeakRates;
use planned::FrameWork;
use stagewise_fft::StagewiseFft;
use std::fmt;

/// Texture format of the pictures that the benchmark draws to time the drawing.
const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// FFT sizes with which the benchmark's option `matrix` times the simulation, each with one to four cascades.
const MATRIX_FFT_SIZES: [u32; 4] = [128, 256, 512, 1024];
const MATRIX_CASCADES: [u32; 4] = [1, 2, 3, 4];
/// FFT size and number of cascades of each sea on which the program's FFT is timed against that of `StagewiseFft`.
const BASELINE_FFT_SIZES_AND_CASCADES: [[u32; 2]; 2] = [[256, 3], [512, 4]];

/// Options of a benchmark: what it times, and how often.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchOptions {
    /// Widths and heights of the pictures to be drawn and timed, pixels. If empty, no picture is timed.
    pub picture_sizes_px: Vec<[u32; 2]>,
    /// Number of submissions to the GPU that each measurement times.
    pub submissions_per_measurement: u32,
    /// Whether to time the simulation for many FFT sizes and cascade counts, instead of those of the given state.
    pub matrix: bool,
    /// Whether to time the baseline, too: the waves by an FFT with one dispatch per stage, as in browser demos.
    pub baseline: bool,
}

/// Measured time of one pass or group of passes (a row of the report), with the size of its work and its minimum cost.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTiming {
    /// Name of the pass or group of passes, such as `rows` or `frame`, as printed in the benchmark's report.
    pub pass: &'static str,
    /// FFT size and number of cascades of the simulated sea, in this order. None for passes that draw a picture.
    pub fft_size_and_cascades: Option<[u32; 2]>,
    /// Width and height of the drawn picture, pixels. None for passes of the simulation.
    pub picture_size: Option<[u32; 2]>,
    /// Measured times of the pass.
    pub timing: Timing,
    /// Least possible memory traffic and arithmetic of the pass, to judge its time. None where not known.
    pub cost: Option<Cost>,
    /// Number of compute dispatches in the pass or group of passes. None where they were not counted.
    pub dispatches: Option<u32>,
}

impl PassTiming {
    fn for_simulation_pass(pass: &'static str, sea: [u32; 2], timing: Timing, cost: Option<Cost>) -> Self {
        Self { pass, fft_size_and_cascades: Some(sea), picture_size: None, timing, cost, dispatches: None }
    }
}

/// Result of a benchmark: the times of the passes for one state (sea and picture) on one adapter.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchReport {
    /// State string: the timed parameters of sea and picture as text, such as `wind=14&t=40`.
    pub state: String,
    /// Name of the graphics adapter, with the backend that wgpu uses in parentheses.
    pub adapter: String,
    /// Whether GPU times were measured with timestamps; if not, the times are wall times.
    pub has_timestamps: bool,
    /// Number of submissions to the GPU that each measurement timed.
    pub submissions_per_measurement: u32,
    /// Measured rates of copying, arithmetic and texture reads of the adapter, to compare the passes with.
    pub peak_rates: PeakRates,
    /// Times of all passes and groups of passes, in the order in which they were measured.
    pub rows: Vec<PassTiming>,
}

/// Times the simulation and the drawing of the state `params` on a device, as `options` says. `progress` gets the name
/// of each measurement before it starts.
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
    let clock = Stopwatch::new(gpu, options.submissions_per_measurement);
    progress("peak_rates");
    let peak_rates = PeakRates::measure(&clock).await?;
    let mut rows = Vec::new();
    if options.matrix {
        for n in MATRIX_FFT_SIZES {
            for cascades in MATRIX_CASCADES {
                progress(&format!("simulation, n {n}, cascades {cascades}"));
                rows.extend(time_simulation(&clock, &with_fft_size_and_cascades(params, [n, cascades])).await?);
            }
        }
    } else {
        progress("simulation");
        rows.extend(time_simulation(&clock, params).await?);
    }
    if options.baseline {
        for sea in BASELINE_FFT_SIZES_AND_CASCADES {
            progress(&format!("a dispatch per stage, n {}, cascades {}", sea[0], sea[1]));
            rows.extend(time_baseline(&clock, &with_fft_size_and_cascades(params, sea)).await?);
        }
    }
    for &size in &options.picture_sizes_px {
        progress(&format!("picture of {}x{} pixels", size[0], size[1]));
        rows.extend(time_picture(&clock, params, size).await?);
    }
    Ok(BenchReport {
        state: query::write(params),
        adapter: format!("{} ({})", adapter.name, adapter.backend),
        has_timestamps: clock.has_timestamps(),
        submissions_per_measurement: clock.submissions_per_measurement,
        peak_rates,
        rows,
    })
}

fn with_fft_size_and_cascades(params: &Params, [n, cascades]: [u32; 2]) -> Params {
    let mut out = params.clone();
    (out.grid.n, out.grid.cascades) = (n, cascades);
    out
}

/// Times the passes of the simulation: each pass alone, rows and columns together, and all passes of a frame together.
async fn time_simulation(clock: &Stopwatch<'_>, params: &Params) -> Result<Vec<PassTiming>, String> {
    let mut ocean = Ocean::without_renderer(clock.gpu, params);
    let MapSizes { map_texels_per_side: n, cascades, foam_cells_per_side: foam_n, format } = ocean.map_sizes();
    let passes = ocean.wave_passes();
    let waves = [WavePass::Rows, WavePass::Columns];
    let step = [WavePass::Rows, WavePass::Columns, WavePass::Mips, WavePass::Foam];
    let measured: [(_, &[WavePass], _); 7] = [
        ("spectrum", &[WavePass::Spectrum], None),
        ("rows", &[WavePass::Rows], Some(cost::row_pass_cost(n, cascades))),
        ("columns", &[WavePass::Columns], Some(cost::column_pass_cost(n, cascades, format))),
        ("waves", &waves, Some(cost::row_and_column_pass_cost(n, cascades, format))),
        ("mips", &[WavePass::Mips], Some(cost::mip_pass_cost(n, cascades, format))),
        ("foam", &[WavePass::Foam], Some(cost::foam_pass_cost(foam_n, cascades, format))),
        ("step", &step, Some(cost::simulation_step_cost(n, foam_n, cascades, format))),
    ];
    let mut rows = Vec::new();
    for (name, recorded, cost) in measured {
        let timing = clock.measure(|_, e| recorded.iter().for_each(|&pass| passes.record(e, pass))).await?;
        let dispatches = (name == "step").then(|| passes.dispatch_count());
        rows.push(PassTiming { dispatches, ..PassTiming::for_simulation_pass(name, [n, cascades], timing, cost) });
    }
    Ok(rows)
}

/// Times the computation of the waves' displacement and gradient maps: by the program's row and column pass, and by the
/// baseline, whose FFT has one dispatch per stage.
async fn time_baseline(clock: &Stopwatch<'_>, params: &Params) -> Result<Vec<PassTiming>, String> {
    let gpu = clock.gpu;
    let mut ocean = Ocean::without_renderer(gpu, params);
    ocean.read_maps().await?;
    let MapSizes { map_texels_per_side: n, cascades, format, .. } = ocean.map_sizes();
    let sea = [n, cascades];
    let theirs = StagewiseFft::new(gpu, ocean.maps());
    let passes = ocean.wave_passes();
    let ours = clock.measure(|_, e| {
        passes.record(e, WavePass::Rows);
        passes.record(e, WavePass::Columns);
    });
    let ours = PassTiming::for_simulation_pass(
        "waves",
        sea,
        ours.await?,
        Some(cost::row_and_column_pass_cost(n, cascades, format)),
    );
    let timing = clock.measure(|_, e| theirs.run(e)).await?;
    let theirs = PassTiming {
        dispatches: Some(theirs.dispatch_count() as u32),
        ..PassTiming::for_simulation_pass("waves, a dispatch per stage", sea, timing, None)
    };
    Ok(vec![ours, theirs])
}

/// Times the passes of a picture of `size` (width, height) pixels. Also times whole frames with waves and foam, between
/// which 1/60 s is simulated: at a constant wind, and while the wind changes as under a dragged slider.
async fn time_picture(clock: &Stopwatch<'_>, params: &Params, size: [u32; 2]) -> Result<Vec<PassTiming>, String> {
    let gpu = clock.gpu;
    let mut ocean = Ocean::new(gpu, PICTURE_FORMAT, OutputKind::Screen, params);
    ocean.solve_coast();
    let target = offscreen::create_target(gpu, PICTURE_FORMAT, size);
    let mut encoder = gpu.encoder("picture");
    ocean.record_frame_with_complete_foam(&mut encoder, size);
    gpu.submit(encoder);
    let row = |pass, timing| PassTiming {
        pass,
        fft_size_and_cascades: None,
        picture_size: Some(size),
        timing,
        cost: None,
        dispatches: None,
    };
    let work = FrameWork::new(params, ocean.plan(), size, ocean.map_sizes(), ocean.vertex_count());
    let counted = work.picture;
    let mut out = Vec::new();
    for (pass, part) in [
        ("sky tables", TimedPart::SkyTables),
        ("background", TimedPart::Background),
        ("mesh", TimedPart::Mesh),
        ("water", TimedPart::Water),
        ("tone", TimedPart::Tone),
    ] {
        let cost = match part {
            TimedPart::SkyTables => None,
            TimedPart::Background => Some(counted.background_cost()),
            TimedPart::Mesh => Some(counted.mesh_cost()),
            TimedPart::Water => Some(counted.water_cost()),
            TimedPart::Tone => Some(counted.tone_cost()),
        };
        out.push(PassTiming { cost, ..row(pass, clock.measure(|_, encoder| ocean.record_part(encoder, part)).await?) });
    }
    let present = clock.measure(|_, encoder| offscreen::clear_and_draw(encoder, &target, |pass| ocean.present(pass)));
    out.push(PassTiming { cost: Some(counted.present_cost()), ..row("present", present.await?) });
    let mut frame = params.clone();
    // A frame of a running sea fills a few rows of the dome of clouds, a still all of them.
    ocean.set_may_keep_pipelines(true);
    // Uniforms are written once per submission, so that a submission can hold only one frame.
    let mut one = Stopwatch::new(gpu, clock.submissions_per_measurement);
    one.max_repetitions_per_submission = 1;
    let frames = one.measure(|i, encoder| {
        frame.clock.t_s = params.clock.t_s + f64::from(i) / 60.0;
        ocean.set_params(&frame);
        ocean.record_frame_with_complete_foam(encoder, size);
        offscreen::clear_and_draw(encoder, &target, |pass| ocean.present(pass));
    });
    out.push(PassTiming { cost: Some(work.cost()), ..row("frame", frames.await?) });
    // Frames while the user drags the wind slider.
    let dragged = one.measure(|i, encoder| {
        frame.clock.t_s += 1.0 / 60.0;
        if let Some(wind) = frame.sea.systems.first_mut() {
            wind.wind_m_s = params.sea.first_system().wind_m_s + 0.01 * f64::from(i % 50);
        }
        ocean.transition_to(&frame, 1.0 / 60.0);
        ocean.record_frame_with_complete_foam(encoder, size);
        offscreen::clear_and_draw(encoder, &target, |pass| ocean.present(pass));
    });
    out.push(row("frame, wind dragged", dragged.await?));
    Ok(out)
}

impl BenchReport {
    /// Time of the row `of` divided by that of the last row named `over` with the same FFT size. None without one.
    fn time_ratio(&self, of: &PassTiming, over: &'static str) -> Option<f64> {
        let other = self.rows.iter().rfind(|r| {
            r.pass == over && r.fft_size_and_cascades.map(|s| s[0]) == of.fft_size_and_cascades.map(|s| s[0])
        })?;
        Some(of.timing.gpu_or_median_wall_ms() / other.timing.gpu_or_median_wall_ms())
    }

    /// Predicted times of the whole frames that the report measured, on the classes of GPUs of [`GPU_CLASSES`]: for
    /// each picture size (width, height) in pixels, the name of the class and the time, ms.
    pub fn budgets(&self) -> Vec<([u32; 2], [(&'static str, f64); GPU_CLASSES.len()])> {
        let frames = self.rows.iter().filter(|row| row.pass == "frame");
        let sized = frames.filter_map(|row| Some((row.picture_size?, row.cost?)));
        sized.map(|(size, cost)| (size, GPU_CLASSES.map(|gpu| (gpu.name, gpu.predicted_ms(&cost))))).collect()
    }

    /// Writes the predicted times of the measured frames, with the assumptions behind them.
    fn write_budgets(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let budgets = self.budgets();
        if budgets.is_empty() {
            return Ok(());
        }
        for (size, times) in budgets {
            let list: Vec<String> = times.iter().map(|(name, ms)| format!("{name} {ms:.1}")).collect();
            writeln!(f, "predicted frame of {}x{}, ms: {}", size[0], size[1], list.join(", "))?;
        }
        write!(f, "{}", budget::Assumptions)
    }

    /// Sentences that compare the program's times with those of the baseline, an FFT with one dispatch per stage.
    pub fn comparisons(&self) -> Vec<String> {
        let mut out = Vec::new();
        for theirs in self.rows.iter().filter(|r| r.pass == "waves, a dispatch per stage") {
            let [n, cascades] = theirs.fft_size_and_cascades.unwrap_or_default();
            if let Some(ratio) = self.time_ratio(theirs, "waves") {
                out.push(format!(
                    "waves of {cascades} x {n}^2: {ratio:.1} times faster than with a dispatch per stage"
                ));
            }
        }
        let baseline = self.rows.iter().find(|r| r.pass == "waves, a dispatch per stage");
        for frame in self.rows.iter().filter(|r| r.pass == "frame") {
            if let (Some(baseline), Some([w, h])) = (baseline, frame.picture_size) {
                let ratio = frame.timing.gpu_or_median_wall_ms() / baseline.timing.gpu_or_median_wall_ms();
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
        let c = &self.peak_rates;
        writeln!(f, "{}, '{}', {} submissions each", self.adapter, self.state, self.submissions_per_measurement)?;
        writeln!(
            f,
            "copy {:.2} GB/s, empty dispatch {:.4} ms, fragment arithmetic {:.2} GFLOP/s, reads of a map {:.4} G/s; {}",
            c.copy_gb_s,
            c.empty_dispatch_ms,
            c.shading_gflop_s,
            c.giga_texture_reads_per_s,
            if self.has_timestamps { "GPU times by timestamps" } else { "no timestamps: times from submission to end" }
        )?;
        writeln!(
            f,
            "{:<32} {:>12} {:>10} {:>10} {:>20} {:>10} {:>8} {:>9} {:>8} {:>9} {:>12}",
            "pass",
            "of",
            "GPU, ms",
            "done, ms",
            "10 % to 90 %",
            "CPU, ms",
            "MB",
            "MFLOP",
            "Mreads",
            "x memory",
            "x arithmetic"
        )?;
        let number = |value: Option<f64>, digits: usize| value.map_or("-".to_owned(), |v| format!("{v:.digits$}"));
        for row in &self.rows {
            let t = &row.timing;
            let of = match (row.fft_size_and_cascades, row.picture_size) {
                (Some([n, cascades]), _) => format!("{cascades} x {n}^2"),
                (_, Some([w, h])) => format!("{w}x{h}"),
                _ => String::new(),
            };
            let floor_ms = row.cost.map(|cost| 1e-6 * cost.bytes / c.copy_gb_s);
            writeln!(
                f,
                "{:<32} {of:>12} {:>10} {:>10.3} {:>10.3} {:>9.3} {:>10} {:>8} {:>9} {:>8} {:>9} {:>12}",
                row.pass,
                number(t.gpu_ms, 3),
                t.wall_percentiles_ms[1],
                t.wall_percentiles_ms[0],
                t.wall_percentiles_ms[2],
                number(t.cpu_ms, 3),
                number(row.cost.map(|cost| 1e-6 * cost.bytes), 2),
                number(row.cost.map(|cost| 1e-6 * cost.flops), 1),
                number(row.cost.map(|cost| 1e-6 * cost.reads), 1),
                number(floor_ms.map(|floor| t.gpu_or_median_wall_ms() / floor), 1),
                number(row.cost.map(|cost| t.gpu_or_median_wall_ms() / (1e-6 * cost.flops / c.shading_gflop_s)), 1),
            )?;
        }
        for (row, dispatches) in self.rows.iter().filter_map(|r| Some((r, r.dispatches?))) {
            writeln!(f, "{}: {dispatches} compute dispatches", row.pass)?;
        }
        self.write_budgets(f)?;
        self.comparisons().iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}
