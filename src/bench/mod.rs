//! What every pass costs, beside what the adapter could do at best and what the browser demos' way would cost on it. The same
//! in a window's program and on a page.

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
use clock::{Clock, Timing};
use cost::Cost;
use per_stage::{Kernel, PerStage};
use std::fmt;

/// Format of the pictures that are timed.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// The full matrix.
const MATRIX_N: [u32; 4] = [128, 256, 512, 1024];
const MATRIX_CASCADES: [u32; 4] = [1, 2, 3, 4];
/// Seas that the demos' way is measured with, n and cascades.
const BASELINES: [[u32; 2]; 2] = [[256, 3], [512, 4]];

/// What to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Sizes of pictures; none leaves the picture out.
    pub sizes: Vec<[u32; 2]>,
    /// Submissions for each number.
    pub repeat: u32,
    /// Also the simulation for every n and number of cascades.
    pub matrix: bool,
    /// Also the demos' way.
    pub baseline: bool,
}

/// One measured pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What was measured.
    pub pass: &'static str,
    /// FFT size and number of cascades, for passes of the simulation.
    pub sea: Option<[u32; 2]>,
    /// Pixels, for passes of the picture.
    pub size: Option<[u32; 2]>,
    /// How long it takes.
    pub timing: Timing,
    /// What it has to move and to compute.
    pub cost: Option<Cost>,
    /// Compute dispatches, where they were counted.
    pub dispatches: Option<u32>,
}

impl Row {
    fn sim(pass: &'static str, sea: [u32; 2], timing: Timing, cost: Option<Cost>) -> Self {
        Self { pass, sea: Some(sea), size: None, timing, cost, dispatches: None }
    }
}

/// The result.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The state that was measured.
    pub state: String,
    /// Name of the adapter and of its backend.
    pub adapter: String,
    /// Whether times are the GPU's own.
    pub has_stamps: bool,
    /// Submissions for each number.
    pub repeat: u32,
    /// What the adapter can do.
    pub ceilings: Ceilings,
    /// All that was measured.
    pub rows: Vec<Row>,
}

/// Measures a state on a device. `progress` is told what comes next.
///
/// # Errors
/// If waiting for the GPU fails.
pub async fn run(
    gpu: &Gpu,
    params: &Params,
    options: &Options,
    mut progress: impl FnMut(&str),
) -> Result<Report, String> {
    let adapter = gpu.device.adapter_info();
    let clock = Clock::new(gpu, options.repeat);
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
    Ok(Report {
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

/// The passes of the simulation, each by itself, and all of a frame.
async fn simulation(clock: &Clock<'_>, params: &Params) -> Result<Vec<Row>, String> {
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
        rows.push(Row { dispatches, ..Row::sim(name, [n, cascades], timing, cost) });
    }
    Ok(rows)
}

/// The waves in the program's way and in the demos', and single transforms.
async fn baseline(clock: &Clock<'_>, params: &Params) -> Result<Vec<Row>, String> {
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
    let ours = Row::sim("waves", sea, ours.await?, Some(cost::waves(n, cascades, format)));
    let timing = clock.time(|_, e| theirs.run(e)).await?;
    let theirs = Row {
        dispatches: Some(theirs.dispatches() as u32),
        ..Row::sim("waves, a dispatch per stage", sea, timing, None)
    };
    let mut out = vec![ours, theirs];
    let fits = n <= gpu.device.limits().max_compute_invocations_per_workgroup;
    for (pass, kernel) in
        [("one field, a dispatch per stage", Kernel::Stages), ("one field, shared radix 2", Kernel::Shared)]
    {
        if kernel == Kernel::Stages || fits {
            let field = PerStage::one_field(gpu, n, kernel);
            let timing = clock.time(|_, e| field.run(e)).await?;
            let dispatches = Some(field.dispatches() as u32);
            out.push(Row { dispatches, ..Row::sim(pass, [n, 1], timing, None) });
        }
    }
    Ok(out)
}

/// The passes of the picture, and whole frames with waves and foam, each a sixtieth of a second after the last.
async fn picture(clock: &Clock<'_>, params: &Params, size: [u32; 2]) -> Result<Vec<Row>, String> {
    let gpu = clock.gpu;
    let mut ocean = Ocean::new(gpu, FORMAT, Film::Screen, params);
    let target = offscreen::target(gpu, FORMAT, size);
    let mut encoder = gpu.encoder("picture");
    ocean.encode_fully(&mut encoder, size);
    gpu.submit(encoder);
    let row = |pass, timing| Row { pass, sea: None, size: Some(size), timing, cost: None, dispatches: None };
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
        out.push(Row { cost, ..row(pass, clock.time(|_, encoder| ocean.record(encoder, part)).await?) });
    }
    let present = clock.time(|_, encoder| offscreen::draw_over(encoder, &target, |pass| ocean.present(pass)));
    out.push(Row { cost: Some(counted.present()), ..row("present", present.await?) });
    let mut frame = params.clone();
    // A frame's uniforms are of one submission.
    let mut one = Clock::new(gpu, clock.repeat);
    one.at_once = 1;
    let frames = one.time(|i, encoder| {
        frame.clock.t_s = params.clock.t_s + f64::from(i) / 60.0;
        ocean.set_params(&frame);
        ocean.encode_fully(encoder, size);
        offscreen::draw_over(encoder, &target, |pass| ocean.present(pass));
    });
    let whole = simulation + counted.water() + counted.background() + counted.present();
    out.push(Row { cost: Some(whole), ..row("frame", frames.await?) });
    // The same while somebody drags the wind.
    let dragged = one.time(|i, encoder| {
        frame.clock.t_s += 1.0 / 60.0;
        if let Some(wind) = frame.sea.systems.first_mut() {
            wind.wind_m_s = params.sea.local().wind_m_s + 0.01 * f64::from(i % 50);
        }
        ocean.transition_to(&frame, 1.0 / 60.0);
        ocean.encode_fully(encoder, size);
        offscreen::draw_over(encoder, &target, |pass| ocean.present(pass));
    });
    out.push(row("frame, wind dragged", dragged.await?));
    Ok(out)
}

/// What the picture of a state consists of.
fn counted(params: &Params, ocean: &Ocean, size: [u32; 2]) -> cost::Picture {
    let sizes = ocean.map_sizes();
    let [width, height] = size.map(f64::from);
    let view = View::new(&params.camera, width / height, 0.0);
    // Half of the picture is below an eye that looks along the horizon.
    let horizon = (-params.camera.pitch_deg.to_radians()).tan() / view.tan_half[1];
    let texels = f64::from(sizes.n * sizes.n) * f64::from(sizes.cascades) * 4.0 / 3.0;
    cost::Picture {
        pixels: width * height,
        sea: (0.5 + 0.5 * horizon).clamp(0.0, 1.0),
        vertices: f64::from(ocean.vertices()),
        map_bytes: texels * f64::from(sizes.format.bytes()),
    }
}

impl Report {
    /// Time of a pass over that of another of the same sea or, without one, of any.
    fn ratio(&self, of: &Row, over: &'static str) -> Option<f64> {
        let other = self.rows.iter().rfind(|r| r.pass == over && r.sea.map(|s| s[0]) == of.sea.map(|s| s[0]))?;
        Some(of.timing.ms() / other.timing.ms())
    }

    /// What the comparison with the demos' way comes to, a sentence a line.
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
        for stages in self.rows.iter().filter(|r| r.pass == "one field, a dispatch per stage") {
            if let Some(ratio) = self.ratio(stages, "one field, shared radix 2") {
                let n = stages.sea.unwrap_or_default()[0];
                out.push(format!("one field of {n}^2: a dispatch per stage takes {ratio:.3} of shared radix 2"));
            }
        }
        let step = self.rows.iter().find(|r| r.pass == "waves, a dispatch per stage");
        for frame in self.rows.iter().filter(|r| r.pass == "frame") {
            if let (Some(step), Some([w, h])) = (step, frame.size) {
                let ratio = frame.timing.ms() / step.timing.ms();
                out.push(format!(
                    "frame of {w}x{h}: {ratio:.2} times the waves of 3 x 256^2 with a dispatch per stage"
                ));
            }
        }
        out
    }
}

impl fmt::Display for Report {
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
            if self.has_stamps { "GPU times by timestamps" } else { "no timestamps: times until the GPU is done" }
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
