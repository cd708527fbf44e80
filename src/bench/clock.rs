//! Measures how long GPU work takes: by timestamps where the GPU has them, and from submission to completion.

use crate::gpu::Gpu;
use crate::gpu::readback;
use crate::gpu::timer;
use web_time::Instant;

/// Least intended duration of a timed submission, ms. Shorter work is repeated, so that overheads count little.
const MIN_SUBMISSION_MS: f64 = 10.0;
/// Largest number of times that short work is repeated within one submission, to reach `MIN_SUBMISSION_MS`.
const MAX_REPETITIONS_PER_SUBMISSION: u32 = 64;

/// Measured times of a piece of GPU work, ms: of doing it once, even if it was repeated for the measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Median over the submissions of the GPU time for doing the work once, ms, from timestamps before and after it.
    /// `None` without timestamps or if they are too coarse.
    pub gpu_ms: Option<f64>,
    /// Shortest wall time of a submission, from the start of its recording on the CPU to its completion on the GPU,
    /// divided by the number of repetitions of the measured work in it, ms.
    pub min_wall_ms: f64,
    /// 10th percentile, median and 90th percentile over the submissions of the wall time from the start of recording to
    /// completion on the GPU, divided by the repetitions of the work in a submission, ms.
    pub wall_percentiles_ms: [f64; 3],
    /// CPU time of all threads of the process for one repetition of the measured work, ms: the smallest over the
    /// submissions. `None` where the system does not tell.
    pub cpu_ms: Option<f64>,
}

impl Timing {
    /// The time to report for doing the work once, ms: the GPU time if known, else the median wall time to completion.
    pub fn gpu_or_median_wall_ms(&self) -> f64 {
        self.gpu_ms.unwrap_or(self.wall_percentiles_ms[1])
    }
}

/// Whether the device can write timestamps between passes, which tell when commands execute. A software adapter writes
/// them when it receives the commands, before it executes them.
fn do_timestamps_measure_execution(gpu: &Gpu) -> bool {
    !gpu.is_software() && gpu.device.features().contains(timer::TIMESTAMPS_BETWEEN_PASSES_FEATURE)
}

/// Measures how long GPU work takes on a device: by timestamps around it if the device can write them between passes,
/// by wall time, and by CPU time.
pub struct Stopwatch<'a> {
    /// The device on which the work is timed.
    pub gpu: &'a Gpu,
    stamps: Option<TimestampQueries>,
    /// Number of submissions that are timed for each piece of work, after a warm-up.
    pub submissions_per_measurement: u32,
    /// Largest number of times that short work is repeated within one submission, to make it last 10 ms.
    pub max_repetitions_per_submission: u32,
}

struct TimestampQueries {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    period_ns: f64,
}

impl TimestampQueries {
    fn new(gpu: &Gpu) -> Option<Self> {
        do_timestamps_measure_execution(gpu).then(|| Self {
            set: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("bench"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: gpu.buffer(
                "bench",
                2 * u64::from(wgpu::QUERY_SIZE),
                wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            ),
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
        })
    }

    /// Reads the timestamps in `staged`, before and after the work. Returns the GPU time of the work, ms.
    async fn read(&self, gpu: &Gpu, staged: wgpu::Buffer) -> Result<f64, String> {
        let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(&readback::read(gpu, staged).await?);
        Ok(1e-6 * self.period_ns * stamps[1].saturating_sub(stamps[0]) as f64)
    }
}

impl<'a> Stopwatch<'a> {
    /// Creates a stopwatch that submits each piece of work to be measured `repeat` times and times each submission.
    pub fn new(gpu: &'a Gpu, repeat: u32) -> Self {
        Self {
            gpu,
            stamps: TimestampQueries::new(gpu),
            submissions_per_measurement: repeat.max(1),
            max_repetitions_per_submission: MAX_REPETITIONS_PER_SUBMISSION,
        }
    }

    /// Whether [`Self::measure`] gets GPU times from timestamps, besides wall times.
    pub fn has_timestamps(&self) -> bool {
        self.stamps.is_some()
    }

    /// Returns GPU, wall and CPU times per call of `record`, from `repeat` submissions after a warm-up, each with
    /// several calls if the work is short. `record` gets the number of its earlier calls, and an encoder for the work.
    ///
    /// # Errors
    /// If waiting for the GPU fails.
    #[cfg_attr(
        not(target_arch = "wasm32"),
        expect(clippy::disallowed_methods, reason = "web_time::Instant is the standard one there")
    )]
    pub async fn measure(&self, mut record: impl FnMut(u32, &mut wgpu::CommandEncoder)) -> Result<Timing, String> {
        let mut calls = 0;
        let mut submit = async |times: u32| -> Result<(f64, Option<f64>, Option<f64>), String> {
            let (start, spent) = (Instant::now(), process_cpu_time_ms());
            let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.stamps.iter().for_each(|s| encoder.write_timestamp(&s.set, 0));
            for _ in 0..times {
                record(calls, &mut encoder);
                calls += 1;
            }
            let staged = self.stamps.as_ref().map(|s| {
                encoder.write_timestamp(&s.set, 1);
                encoder.resolve_query_set(&s.set, 0..2, &s.resolved, 0);
                readback::stage_buffer(self.gpu, &mut encoder, &s.resolved)
            });
            self.gpu.submit(encoder);
            readback::wait_for_submitted_work(self.gpu).await?;
            let ms = 1e3 * start.elapsed().as_secs_f64() / f64::from(times);
            let cpu = process_cpu_time_ms().zip(spent).map(|(after, before)| (after - before) / f64::from(times));
            let gpu = match (&self.stamps, staged) {
                (Some(stamps), Some(staged)) => Some(stamps.read(self.gpu, staged).await? / f64::from(times)),
                _ => None,
            };
            Ok((ms, gpu, cpu))
        };
        // Warm-up: drivers compile pipelines and clear buffers at their first use.
        submit(1).await?;
        let once = submit(1).await?.0;
        let times = ((MIN_SUBMISSION_MS / once.max(1e-3)).ceil() as u32).clamp(1, self.max_repetitions_per_submission);
        let (mut waits, mut stamps, mut least_cpu) = (Vec::new(), Vec::new(), None);
        for _ in 0..self.submissions_per_measurement {
            let (wait, gpu, cpu) = submit(times).await?;
            waits.push(wait);
            stamps.extend(gpu);
            least_cpu = least_cpu.into_iter().chain(cpu).reduce(f64::min);
        }
        let at = |sorted: &mut Vec<f64>, q: f64| -> f64 {
            sorted.sort_by(f64::total_cmp);
            sorted[((sorted.len() - 1) as f64 * q).round() as usize]
        };
        // Timestamps that are too coarse give 0, which is no measurement.
        let gpu = (!stamps.is_empty()).then(|| at(&mut stamps, 0.5)).filter(|&ms| ms > 0.0);
        let wall_percentiles_ms = [0.1, 0.5, 0.9].map(|q| at(&mut waits, q));
        Ok(Timing { gpu_ms: gpu, min_wall_ms: waits[0], wall_percentiles_ms, cpu_ms: least_cpu })
    }
}

/// CPU time that all threads of this process have used so far, ms. `None` where Linux's schedstat files are missing.
fn process_cpu_time_ms() -> Option<f64> {
    let threads = std::fs::read_dir("/proc/self/task").ok()?;
    let spent = |thread: std::fs::DirEntry| -> Option<f64> {
        let text = std::fs::read_to_string(thread.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<f64>().ok()
    };
    Some(1e-6 * threads.flatten().filter_map(spent).sum::<f64>())
}
