//! How long recorded work takes: by the GPU's timestamps where it has them, and from the submission to its end.

use crate::gpu::Gpu;
use crate::gpu::readback;
use crate::gpu::timer;
use web_time::Instant;

/// Time that a submission should take at least, so that what it costs to submit and to wait counts little, ms.
const LEAST_MS: f64 = 10.0;
/// Most repetitions within one submission.
const MOST_AT_ONCE: u32 = 64;

/// Times of one piece of work, ms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Between timestamps, median; none where the adapter has no timestamps.
    pub gpu: Option<f64>,
    /// From the submission until the GPU says that it is done, over the repetitions of one submission: the least,
    pub least: f64,
    /// 10th percentile, median, 90th percentile.
    pub spread: [f64; 3],
    /// Least time on CPUs, of all threads of the process, where the system says.
    pub cpu: Option<f64>,
}

impl Timing {
    /// What to compare: the GPU's own time where there is one, else the median until it is done.
    pub fn ms(&self) -> f64 {
        self.gpu.unwrap_or(self.spread[1])
    }
}

/// Whether the timestamps of a device can be believed: a software GPU writes them when it takes the commands, not when it has
/// carried them out.
fn believes_stamps(gpu: &Gpu) -> bool {
    gpu.device.adapter_info().device_type != wgpu::DeviceType::Cpu && gpu.device.features().contains(timer::FEATURES)
}

/// Measures on a device.
pub struct Clock<'a> {
    /// Makes resources.
    pub gpu: &'a Gpu,
    stamps: Option<Stamps>,
    /// Submissions that count, for each piece of work.
    pub repeat: u32,
    /// Most repetitions within one submission.
    pub at_once: u32,
}

struct Stamps {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    period_ns: f64,
    between_passes: bool,
}

impl Stamps {
    fn new(gpu: &Gpu) -> Option<Self> {
        believes_stamps(gpu).then(|| Self {
            set: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("bench"),
                ty: wgpu::QueryType::Timestamp,
                count: 4,
            }),
            resolved: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("bench"),
                size: 4 * u64::from(wgpu::QUERY_SIZE),
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
            between_passes: gpu.device.features().contains(timer::BETWEEN_PASSES),
        })
    }

    /// Writes the first or the last stamp: between passes, or by an empty pass.
    fn mark(&self, encoder: &mut wgpu::CommandEncoder, last: bool) {
        let at = 2 * u32::from(last);
        if self.between_passes {
            encoder.write_timestamp(&self.set, at);
            encoder.write_timestamp(&self.set, at + 1);
            return;
        }
        drop(encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("mark"),
            timestamp_writes: Some(wgpu::ComputePassTimestampWrites {
                query_set: &self.set,
                beginning_of_pass_write_index: Some(at),
                end_of_pass_write_index: Some(at + 1),
            }),
        }));
    }

    /// From the end of the first mark to the beginning of the last, ms.
    async fn read(&self, gpu: &Gpu, staged: wgpu::Buffer) -> Result<f64, String> {
        let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(&readback::read(gpu, staged).await?);
        Ok(1e-6 * self.period_ns * stamps[2].saturating_sub(stamps[1]) as f64)
    }
}

impl<'a> Clock<'a> {
    /// A clock that repeats every measurement so often.
    pub fn new(gpu: &'a Gpu, repeat: u32) -> Self {
        Self { gpu, stamps: Stamps::new(gpu), repeat: repeat.max(1), at_once: MOST_AT_ONCE }
    }

    /// Whether the adapter says itself how long it takes.
    pub fn has_stamps(&self) -> bool {
        self.stamps.is_some()
    }

    /// Times what `record` records, which is told how often it has been called.
    ///
    /// # Errors
    /// If waiting for the GPU fails.
    #[cfg_attr(
        not(target_arch = "wasm32"),
        expect(clippy::disallowed_methods, reason = "web_time's is the standard one there")
    )]
    pub async fn time(&self, mut record: impl FnMut(u32, &mut wgpu::CommandEncoder)) -> Result<Timing, String> {
        let mut calls = 0;
        let mut submit = async |times: u32| -> Result<(f64, Option<f64>, Option<f64>), String> {
            let (start, spent) = (Instant::now(), cpu_ms());
            let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.stamps.iter().for_each(|s| s.mark(&mut encoder, false));
            for _ in 0..times {
                record(calls, &mut encoder);
                calls += 1;
            }
            let staged = self.stamps.as_ref().map(|s| {
                s.mark(&mut encoder, true);
                encoder.resolve_query_set(&s.set, 0..4, &s.resolved, 0);
                readback::stage_buffer(self.gpu, &mut encoder, &s.resolved)
            });
            self.gpu.submit(encoder);
            readback::done(self.gpu).await?;
            let ms = 1e3 * start.elapsed().as_secs_f64() / f64::from(times);
            let cpu = cpu_ms().zip(spent).map(|(after, before)| (after - before) / f64::from(times));
            let gpu = match (&self.stamps, staged) {
                (Some(stamps), Some(staged)) => Some(stamps.read(self.gpu, staged).await? / f64::from(times)),
                _ => None,
            };
            Ok((ms, gpu, cpu))
        };
        // Pipelines may be made at their first use, and buffers cleared.
        submit(1).await?;
        let once = submit(1).await?.0;
        let times = ((LEAST_MS / once.max(1e-3)).ceil() as u32).clamp(1, self.at_once);
        let (mut waits, mut stamps, mut least_cpu) = (Vec::new(), Vec::new(), None);
        for _ in 0..self.repeat {
            let (wait, gpu, cpu) = submit(times).await?;
            waits.push(wait);
            stamps.extend(gpu);
            least_cpu = least_cpu.into_iter().chain(cpu).reduce(f64::min);
        }
        let at = |sorted: &mut Vec<f64>, q: f64| -> f64 {
            sorted.sort_by(f64::total_cmp);
            sorted[((sorted.len() - 1) as f64 * q).round() as usize]
        };
        // A clock of no resolution says nothing.
        let gpu = (!stamps.is_empty()).then(|| at(&mut stamps, 0.5)).filter(|&ms| ms > 0.0);
        let spread = [0.1, 0.5, 0.9].map(|q| at(&mut waits, q));
        Ok(Timing { gpu, least: waits[0], spread, cpu: least_cpu })
    }
}

/// What the threads of this process have spent on CPUs so far, where Linux says it.
fn cpu_ms() -> Option<f64> {
    let threads = std::fs::read_dir("/proc/self/task").ok()?;
    let spent = |thread: std::fs::DirEntry| -> Option<f64> {
        let text = std::fs::read_to_string(thread.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<f64>().ok()
    };
    Some(1e-6 * threads.flatten().filter_map(spent).sum::<f64>())
}
