//! How long the GPU takes for each part of a frame, by timestamps between the parts.
//!
//! A frame is timed only while somebody looks, and read back without waiting: the next frame is timed when the last one's
//! numbers are here. Where the adapter has no timestamps nothing is recorded and nothing is known.

use super::Gpu;
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The feature that timing needs; the program runs without it.
pub const FEATURES: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY;
/// What saves the empty passes, where there is such a thing.
pub const BETWEEN_PASSES: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
/// Most timestamps of a frame: two for each mark where they are made by empty passes.
const MARKS: u32 = 256;
/// Share of a new frame in the smoothed times.
const SHARE: f64 = 0.2;

/// Times the parts of frames. A clone times the same frames.
#[derive(Clone, Debug, Default)]
pub struct Timer(Option<Arc<Mutex<State>>>);

#[derive(Debug)]
struct State {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    staging: wgpu::Buffer,
    /// ns for each unit of a timestamp.
    period_ns: f64,
    between_passes: bool,
    phase: Phase,
    /// Names of the parts of the frame, in the order of the marks that end them.
    parts: Vec<&'static str>,
    /// Smoothed times of the parts of the last frame, ms.
    times: Vec<(&'static str, f64)>,
}

#[derive(Debug)]
enum Phase {
    Idle,
    /// Marks go to the frame at hand, whose wanted marks were counted even if there was no room.
    Recording,
    /// The frame has been recorded; it is submitted before the next one is.
    Recorded,
    /// Waiting for the memory: 0, then 1 when it is here or 2 when it will not be.
    Mapping(Arc<AtomicU8>),
}

impl Timer {
    /// A timer for a device; one that knows nothing if the device has no timestamps.
    pub fn new(gpu: &Gpu) -> Self {
        if !gpu.device.features().contains(FEATURES) {
            return Self(None);
        }
        let size = u64::from(MARKS) * u64::from(wgpu::QUERY_SIZE);
        let buffer = |label, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let state = State {
            set: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timer"),
                ty: wgpu::QueryType::Timestamp,
                count: MARKS,
            }),
            resolved: buffer("timer", wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            staging: buffer("timer staging", wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
            between_passes: gpu.device.features().contains(BETWEEN_PASSES),
            phase: Phase::Idle,
            parts: Vec::new(),
            times: Vec::new(),
        };
        Self(Some(Arc::new(Mutex::new(state))))
    }

    /// Whether the device can say how long something took.
    pub fn is_available(&self) -> bool {
        self.0.is_some()
    }

    /// Starts a frame, unless the last one is still being read; `is_submitted` says whether that one was submitted since.
    pub fn begin(&self, encoder: &mut wgpu::CommandEncoder, is_submitted: bool) {
        let Some(mut state) = self.state() else { return };
        if !is_submitted && matches!(state.phase, Phase::Recorded) {
            state.phase = Phase::Idle;
        }
        state.collect();
        if matches!(state.phase, Phase::Idle) {
            state.phase = Phase::Recording;
            state.parts.clear();
            state.mark(encoder, "");
        }
    }

    /// Ends a part: what was recorded since the last mark. Parts of one name are added up.
    pub fn mark(&self, encoder: &mut wgpu::CommandEncoder, part: &'static str) {
        let Some(mut state) = self.state() else { return };
        if matches!(state.phase, Phase::Recording) {
            state.mark(encoder, part);
        }
    }

    /// Ends the frame.
    pub fn end(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some(mut state) = self.state() else { return };
        if !matches!(state.phase, Phase::Recording) {
            return;
        }
        let marks = state.slot(state.parts.len());
        if marks > MARKS {
            // More parts than there is room for, while foam catches up: another frame will do.
            state.phase = Phase::Idle;
            return;
        }
        encoder.resolve_query_set(&state.set, 0..marks, &state.resolved, 0);
        encoder.copy_buffer_to_buffer(&state.resolved, 0, &state.staging, 0, u64::from(marks * wgpu::QUERY_SIZE));
        state.phase = Phase::Recorded;
    }

    /// The parts of the last frame that was timed, and how long each takes, ms, smoothed over the frames that had it.
    pub fn times(&self) -> Vec<(&'static str, f64)> {
        self.state().map_or_else(Vec::new, |state| state.times.clone())
    }

    fn state(&self) -> Option<MutexGuard<'_, State>> {
        self.0.as_ref().map(|state| state.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl State {
    /// First timestamp of a mark.
    fn slot(&self, mark: usize) -> u32 {
        mark as u32 * if self.between_passes { 1 } else { 2 }
    }

    fn mark(&mut self, encoder: &mut wgpu::CommandEncoder, part: &'static str) {
        let at = self.slot(self.parts.len());
        self.parts.push(part);
        if self.slot(self.parts.len()) > MARKS {
            return;
        }
        if self.between_passes {
            encoder.write_timestamp(&self.set, at);
        } else {
            // A browser has timestamps at the ends of passes alone, and both of one pass must be others.
            drop(encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("mark"),
                timestamp_writes: Some(wgpu::ComputePassTimestampWrites {
                    query_set: &self.set,
                    beginning_of_pass_write_index: Some(at),
                    end_of_pass_write_index: Some(at + 1),
                }),
            }));
        }
    }

    /// Takes what has arrived, and asks for what has been submitted.
    fn collect(&mut self) {
        match &self.phase {
            Phase::Recorded => {
                let arrived = Arc::new(AtomicU8::new(0));
                let flag = arrived.clone();
                self.staging.slice(..).map_async(wgpu::MapMode::Read, move |result| {
                    flag.store(if result.is_ok() { 1 } else { 2 }, Ordering::Release);
                });
                self.phase = Phase::Mapping(arrived);
            }
            Phase::Mapping(arrived) => match arrived.load(Ordering::Acquire) {
                0 => {}
                1 => {
                    self.take();
                    self.staging.unmap();
                    self.phase = Phase::Idle;
                }
                _ => self.phase = Phase::Idle,
            },
            Phase::Idle | Phase::Recording => {}
        }
    }

    fn take(&mut self) {
        let Ok(bytes) = self.staging.slice(..).get_mapped_range() else { return };
        let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        drop(bytes);
        let stamp = |mark: usize| stamps.get(self.slot(mark) as usize).copied().unwrap_or(0);
        let mut frame: Vec<(&'static str, f64)> = Vec::new();
        for (mark, part) in self.parts.iter().enumerate().skip(1) {
            // A stamp that was never written, or a clock that was set back, says nothing.
            let units = stamp(mark).saturating_sub(stamp(mark - 1));
            let ms = 1e-6 * self.period_ns * units as f64;
            match frame.iter_mut().find(|(name, _)| name == part) {
                Some((_, sum)) => *sum += ms,
                None => frame.push((part, ms)),
            }
        }
        let before = std::mem::take(&mut self.times);
        let smooth = |(name, ms): (&'static str, f64)| match before.iter().find(|(known, _)| *known == name) {
            Some((_, smooth)) => (name, smooth + SHARE * (ms - smooth)),
            None => (name, ms),
        };
        self.times = frame.into_iter().map(smooth).collect();
    }
}
