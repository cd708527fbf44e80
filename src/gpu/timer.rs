//! Measures the GPU times of the parts of a frame with timestamps between the parts.
//!
//! Reading the timestamps does not wait: the next frame is timed once the times of the previous one have arrived. On
//! devices without timestamps a timer records nothing and returns no times.

use super::Gpu;
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// wgpu feature that a device needs so that a [`Timer`] measures: timestamp queries.
pub const TIMESTAMP_FEATURE: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY;
/// wgpu feature that allows timestamps between passes. Without it, extra empty compute passes write them.
pub const TIMESTAMPS_BETWEEN_PASSES_FEATURE: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
/// Largest number of timestamps in a frame. Each mark (the start of the frame or the end of one of its parts) takes one
/// timestamp, or two if an empty compute pass writes them.
const MAX_TIMESTAMPS: u32 = 256;
/// Weight of the newest frame in the exponential moving average of the GPU times of its parts, 0 to 1.
const GPU_TIME_SMOOTHING_WEIGHT: f64 = 0.2;

/// Measures the GPU times of the parts of a frame, if the device has timestamps. Clones share all state and results.
#[derive(Clone, Debug, Default)]
pub struct Timer(Option<Arc<Mutex<TimerState>>>);

#[derive(Debug)]
struct TimerState {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    staging: wgpu::Buffer,
    /// Time between two successive values of the GPU's timestamp counter, ns.
    period_ns: f64,
    between_passes: bool,
    phase: TimerPhase,
    /// For each mark (end of a part of the frame), the name of that part; empty for mark 0, which starts the frame.
    parts: Vec<&'static str>,
    /// Whether the parts of the frame in progress are timed, and not just the whole frame.
    with_parts: bool,
    /// Tag of the frame in progress, as its caller chose it.
    tag: u32,
    /// Names of the parts of the last frame whose timestamps were read, and their smoothed GPU times, ms.
    times: Vec<(&'static str, f64)>,
    /// Tag and GPU time, s, of the last frame whose timestamps were read, until somebody takes them.
    frame_time: Option<(u32, f64)>,
}

#[derive(Debug)]
enum TimerPhase {
    Idle,
    /// The CPU records the commands of a timed frame. Its marks (ends of its parts) are counted even beyond
    /// [`MAX_TIMESTAMPS`]; a frame with that many is not timed.
    Recording,
    /// A timed frame has been recorded. If it was submitted, its timestamps are requested when the next frame begins.
    Recorded,
    /// The timestamps are being mapped for the CPU to read. The flag is 0 while waiting, 1 when mapped, 2 on failure.
    Mapping(Arc<AtomicU8>),
}

impl Timer {
    /// Creates a timer for a device. If the device has no timestamps, it records nothing and returns no times.
    pub fn new(gpu: &Gpu) -> Self {
        if !gpu.device.features().contains(TIMESTAMP_FEATURE) {
            return Self(None);
        }
        let size = u64::from(MAX_TIMESTAMPS) * u64::from(wgpu::QUERY_SIZE);
        let state = TimerState {
            set: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timer"),
                ty: wgpu::QueryType::Timestamp,
                count: MAX_TIMESTAMPS,
            }),
            resolved: gpu.buffer("timer", size, wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            staging: gpu.buffer("timer staging", size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
            between_passes: gpu.device.features().contains(TIMESTAMPS_BETWEEN_PASSES_FEATURE),
            phase: TimerPhase::Idle,
            parts: Vec::new(),
            with_parts: false,
            tag: 0,
            times: Vec::new(),
            frame_time: None,
        };
        Self(Some(Arc::new(Mutex::new(state))))
    }

    /// Whether the device has timestamps, so that GPU times are measured. If not, the timer does nothing.
    pub fn is_available(&self) -> bool {
        self.0.is_some()
    }

    /// Starts timing the frame that is recorded to `encoder`, unless the timestamps of an earlier frame are still
    /// awaited. If `is_submitted` is false, the previous frame was never submitted, and its timestamps are discarded.
    /// Only `with_parts` times the parts of the frame, too. [`Self::take_frame_time`] returns `tag` with the frame's
    /// time.
    pub fn begin_frame(&self, encoder: &mut wgpu::CommandEncoder, is_submitted: bool, with_parts: bool, tag: u32) {
        let Some(mut state) = self.lock_state() else { return };
        if !is_submitted && matches!(state.phase, TimerPhase::Recorded) {
            state.phase = TimerPhase::Idle;
        }
        state.collect_arrived_timestamps();
        if matches!(state.phase, TimerPhase::Idle) {
            state.phase = TimerPhase::Recording;
            (state.with_parts, state.tag) = (with_parts, tag);
            state.parts.clear();
            state.write_mark(encoder, "");
        }
    }

    /// Ends the part of the frame that consists of the commands recorded since the previous mark, and names it `part`.
    /// The times of parts with the same name are added.
    pub fn end_part(&self, encoder: &mut wgpu::CommandEncoder, part: &'static str) {
        let Some(mut state) = self.lock_state() else { return };
        if matches!(state.phase, TimerPhase::Recording) && state.with_parts {
            state.write_mark(encoder, part);
        }
    }

    /// Ends the timed frame. Records a copy of its timestamps to a buffer, which the CPU reads during a later frame.
    pub fn end_frame(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some(mut state) = self.lock_state() else { return };
        if !matches!(state.phase, TimerPhase::Recording) {
            return;
        }
        if !state.with_parts {
            state.write_mark(encoder, "frame");
        }
        let marks = state.first_query_index(state.parts.len());
        if marks > MAX_TIMESTAMPS {
            // Too many parts; a later frame with fewer parts is timed instead.
            state.phase = TimerPhase::Idle;
            return;
        }
        encoder.resolve_query_set(&state.set, 0..marks, &state.resolved, 0);
        encoder.copy_buffer_to_buffer(&state.resolved, 0, &state.staging, 0, u64::from(marks * wgpu::QUERY_SIZE));
        state.phase = TimerPhase::Recorded;
    }

    /// Names of the parts of the last frame whose timestamps have arrived, with their GPU times (ms), exponentially
    /// smoothed over the frames that contain the part. Empty if the device has no timestamps.
    pub fn part_times_ms(&self) -> Vec<(&'static str, f64)> {
        self.lock_state().map_or_else(Vec::new, |state| state.times.clone())
    }

    /// The tag given to [`Self::begin_frame`] and the GPU time, s, of the last frame whose timestamps have arrived.
    /// Returns each frame once. `None` also where the GPU's timestamps are all zero, as those of empty passes on Metal.
    pub fn take_frame_time(&self) -> Option<(u32, f64)> {
        self.lock_state()?.frame_time.take()
    }

    fn lock_state(&self) -> Option<MutexGuard<'_, TimerState>> {
        self.0.as_ref().map(|state| state.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Records an empty pass that writes two timestamps, with the indices `at` and `at + 1` in `set`. Browsers only allow
/// timestamps at the start and the end of a pass, and the two need different indices.
pub fn record_timestamp_pass(encoder: &mut wgpu::CommandEncoder, set: &wgpu::QuerySet, at: u32) {
    drop(encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
        label: Some("mark"),
        timestamp_writes: Some(wgpu::ComputePassTimestampWrites {
            query_set: set,
            beginning_of_pass_write_index: Some(at),
            end_of_pass_write_index: Some(at + 1),
        }),
    }));
}

impl TimerState {
    /// Index in the query set of the first timestamp of the mark with index `mark`. Mark 0 starts the frame, and each
    /// later mark ends a part of it.
    fn first_query_index(&self, mark: usize) -> u32 {
        mark as u32 * if self.between_passes { 1 } else { 2 }
    }

    fn write_mark(&mut self, encoder: &mut wgpu::CommandEncoder, part: &'static str) {
        let at = self.first_query_index(self.parts.len());
        self.parts.push(part);
        if self.first_query_index(self.parts.len()) > MAX_TIMESTAMPS {
            return;
        }
        if self.between_passes {
            encoder.write_timestamp(&self.set, at);
        } else {
            record_timestamp_pass(encoder, &self.set, at);
        }
    }

    /// Adds a frame's timestamps to the smoothed times if they have arrived, or requests those of a submitted frame.
    fn collect_arrived_timestamps(&mut self) {
        match &self.phase {
            TimerPhase::Recorded => {
                let arrived = Arc::new(AtomicU8::new(0));
                let flag = arrived.clone();
                self.staging.slice(..).map_async(wgpu::MapMode::Read, move |result| {
                    flag.store(if result.is_ok() { 1 } else { 2 }, Ordering::Release);
                });
                self.phase = TimerPhase::Mapping(arrived);
            }
            TimerPhase::Mapping(arrived) => match arrived.load(Ordering::Acquire) {
                0 => {}
                1 => {
                    self.read_times();
                    self.staging.unmap();
                    self.phase = TimerPhase::Idle;
                }
                _ => self.phase = TimerPhase::Idle,
            },
            TimerPhase::Idle | TimerPhase::Recording => {}
        }
    }

    fn read_times(&mut self) {
        let Ok(bytes) = self.staging.slice(..).get_mapped_range() else { return };
        let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        drop(bytes);
        let stamp = |mark: usize| stamps.get(self.first_query_index(mark) as usize).copied().unwrap_or(0);
        let frame_units = stamp(self.parts.len().saturating_sub(1)).saturating_sub(stamp(0));
        let frame_time = (frame_units > 0).then_some((self.tag, 1e-9 * self.period_ns * frame_units as f64));
        if !self.with_parts {
            self.frame_time = frame_time;
            return;
        }
        let mut frame: Vec<(&'static str, f64)> = Vec::new();
        for (mark, part) in self.parts.iter().enumerate().skip(1) {
            // A timestamp that was not written, or a clock that ran backwards, counts as no time.
            let units = stamp(mark).saturating_sub(stamp(mark - 1));
            let ms = 1e-6 * self.period_ns * units as f64;
            match frame.iter_mut().find(|(name, _)| name == part) {
                Some((_, sum)) => *sum += ms,
                None => frame.push((part, ms)),
            }
        }
        self.frame_time = frame_time;
        let before = std::mem::take(&mut self.times);
        let smooth = |(name, ms): (&'static str, f64)| match before.iter().find(|(known, _)| *known == name) {
            Some((_, smooth)) => (name, smooth + GPU_TIME_SMOOTHING_WEIGHT * (ms - smooth)),
            None => (name, ms),
        };
        self.times = frame.into_iter().map(smooth).collect();
    }
}
