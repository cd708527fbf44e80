//! Measures the GPU times of the parts of a frame by timestamps that the passes themselves write.
//!
//! No pass exists for its timestamps alone: on Metal, empty passes write zeros. Reading the timestamps does not wait:
//! the next frame is timed once the times of the previous one have arrived. On devices without timestamps a timer
//! records nothing and returns no times.

use super::Gpu;
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// wgpu feature that a device needs so that a [`Timer`] measures: timestamp queries.
pub const TIMESTAMP_FEATURE: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY;
/// wgpu feature that allows timestamps between passes; benchmarks of arbitrary commands need it.
pub const TIMESTAMPS_BETWEEN_PASSES_FEATURE: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
/// Largest number of timestamps in a frame. Each timed pass writes one at its beginning and one at its end.
const MAX_TIMESTAMPS: u32 = 512;
/// Weight of the newest frame in the exponential moving average of the GPU times of its parts, 0 to 1.
const GPU_TIME_SMOOTHING_WEIGHT: f64 = 0.2;

/// Measures the GPU times of the parts of a frame, if the device has timestamps. Clones share all state and results.
///
/// Between [`Self::begin_frame`] and [`Self::end_frame`], whoever begins a pass asks for its timestamp writes, with the
/// name of the part to which the pass belongs.
#[derive(Clone, Debug, Default)]
pub struct Timer(Option<Arc<TimerShared>>);

#[derive(Debug)]
struct TimerShared {
    set: wgpu::QuerySet,
    state: Mutex<TimerState>,
}

#[derive(Debug)]
struct TimerState {
    resolved: wgpu::Buffer,
    staging: wgpu::Buffer,
    /// Time between two successive values of the GPU's timestamp counter, ns.
    period_ns: f64,
    phase: TimerPhase,
    /// For each timed pass of the frame in progress, the name of its part. If only the whole frame is timed, its first
    /// pass and its last.
    passes: Vec<&'static str>,
    /// Whether the parts of the frame in progress are timed, and not just the whole frame.
    with_parts: bool,
    /// Whether the last pass of the frame in progress has been recorded.
    has_last_pass: bool,
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
    /// The CPU records the commands of a timed frame. Its passes are counted even beyond [`MAX_TIMESTAMPS`]; a frame
    /// with that many is not timed.
    Recording,
    /// A timed frame has been recorded. If it was submitted, its timestamps are requested when the next frame begins.
    Recorded,
    /// The timestamps are being mapped for the CPU to read. The flag is 0 while waiting, 1 when mapped, 2 on failure.
    Mapping(Arc<AtomicU8>),
}

/// Indices in the query set of the timestamps at the beginning and at the end of a pass.
type PassQueries = [Option<u32>; 2];

impl Timer {
    /// Creates a timer for a device. If the device has no timestamps, it records nothing and returns no times.
    pub fn new(gpu: &Gpu) -> Self {
        if !gpu.device.features().contains(TIMESTAMP_FEATURE) {
            return Self(None);
        }
        let size = u64::from(MAX_TIMESTAMPS) * u64::from(wgpu::QUERY_SIZE);
        let state = TimerState {
            resolved: gpu.buffer("timer", size, wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            staging: gpu.buffer("timer staging", size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
            phase: TimerPhase::Idle,
            passes: Vec::new(),
            with_parts: false,
            has_last_pass: false,
            tag: 0,
            times: Vec::new(),
            frame_time: None,
        };
        let set = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("timer"),
            ty: wgpu::QueryType::Timestamp,
            count: MAX_TIMESTAMPS,
        });
        Self(Some(Arc::new(TimerShared { set, state: Mutex::new(state) })))
    }

    /// Whether the device has timestamps, so that GPU times are measured. If not, the timer does nothing.
    pub fn is_available(&self) -> bool {
        self.0.is_some()
    }

    /// Starts timing the frame whose passes are recorded next, unless the timestamps of an earlier frame are still
    /// awaited. If `is_submitted` is false, the previous frame was never submitted, and its timestamps are discarded.
    /// Only `with_parts` times the parts of the frame, too. [`Self::take_frame_time`] returns `tag` with the frame's
    /// time.
    pub fn begin_frame(&self, is_submitted: bool, with_parts: bool, tag: u32) {
        let Some(mut state) = self.lock_state() else { return };
        if !is_submitted && matches!(state.phase, TimerPhase::Recorded) {
            state.phase = TimerPhase::Idle;
        }
        state.collect_arrived_timestamps();
        if matches!(state.phase, TimerPhase::Idle) {
            state.phase = TimerPhase::Recording;
            (state.with_parts, state.tag, state.has_last_pass) = (with_parts, tag, false);
            state.passes.clear();
        }
    }

    /// Timestamps that a compute pass of the part `part` is to write. The times of all passes of a part are added.
    pub fn compute_pass(&self, part: &'static str) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let [beginning_of_pass_write_index, end_of_pass_write_index] = self.lock_state()?.add_pass(part, false)?;
        let query_set = &self.0.as_ref()?.set;
        Some(wgpu::ComputePassTimestampWrites { query_set, beginning_of_pass_write_index, end_of_pass_write_index })
    }

    /// Timestamps that a render pass of the part `part` is to write. The times of all passes of a part are added.
    pub fn render_pass(&self, part: &'static str) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        self.render_pass_writes(part, false)
    }

    /// Timestamps that the last pass of the frame is to write, a render pass of the part `part`.
    pub fn last_render_pass(&self, part: &'static str) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        self.render_pass_writes(part, true)
    }

    fn render_pass_writes(&self, part: &'static str, is_last: bool) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let [beginning_of_pass_write_index, end_of_pass_write_index] = self.lock_state()?.add_pass(part, is_last)?;
        let query_set = &self.0.as_ref()?.set;
        Some(wgpu::RenderPassTimestampWrites { query_set, beginning_of_pass_write_index, end_of_pass_write_index })
    }

    /// Ends the timed frame. Records a copy of its timestamps to a buffer, which the CPU reads during a later frame.
    pub fn end_frame(&self, encoder: &mut wgpu::CommandEncoder) {
        let (Some(shared), Some(mut state)) = (&self.0, self.lock_state()) else { return };
        if !matches!(state.phase, TimerPhase::Recording) {
            return;
        }
        let count = state.timestamp_count();
        // Without its last pass a frame has no end. With too many passes it is not timed, but a later frame with fewer.
        if !state.has_last_pass || count > MAX_TIMESTAMPS {
            state.phase = TimerPhase::Idle;
            return;
        }
        encoder.resolve_query_set(&shared.set, 0..count, &state.resolved, 0);
        encoder.copy_buffer_to_buffer(&state.resolved, 0, &state.staging, 0, u64::from(count * wgpu::QUERY_SIZE));
        state.phase = TimerPhase::Recorded;
    }

    /// Names of the parts of the last frame whose timestamps have arrived, with their GPU times (ms), exponentially
    /// smoothed over the frames that contain the part. Empty if the device has no timestamps.
    pub fn part_times_ms(&self) -> Vec<(&'static str, f64)> {
        self.lock_state().map_or_else(Vec::new, |state| state.times.clone())
    }

    /// The tag given to [`Self::begin_frame`] and the GPU time, s, of the last frame whose timestamps have arrived.
    /// Returns each frame once. `None` also where the GPU writes only zeros.
    pub fn take_frame_time(&self) -> Option<(u32, f64)> {
        self.lock_state()?.frame_time.take()
    }

    fn lock_state(&self) -> Option<MutexGuard<'_, TimerState>> {
        self.0.as_ref().map(|shared| shared.state.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl TimerState {
    /// Number of timestamps of the passes recorded so far.
    fn timestamp_count(&self) -> u32 {
        if self.with_parts { 2 * self.passes.len() as u32 } else { 2 }
    }

    /// Adds a pass to the frame in progress. Returns where it writes its timestamps; None if it writes none.
    fn add_pass(&mut self, part: &'static str, is_last: bool) -> Option<PassQueries> {
        if !matches!(self.phase, TimerPhase::Recording) || self.has_last_pass {
            return None;
        }
        let is_first = self.passes.is_empty();
        self.has_last_pass = is_last;
        if self.with_parts {
            let at = self.timestamp_count();
            self.passes.push(part);
            return (self.timestamp_count() <= MAX_TIMESTAMPS).then_some([Some(at), Some(at + 1)]);
        }
        if is_first || is_last {
            self.passes.push(part);
        }
        (is_first || is_last).then_some([is_first.then_some(0), is_last.then_some(1)])
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
        // A timestamp that was not written, or a clock that ran backwards, counts as no time.
        let between = |first: u32, last: u32| stamps[last as usize].saturating_sub(stamps[first as usize]);
        let frame_units = between(0, self.timestamp_count() - 1);
        self.frame_time = (frame_units > 0).then_some((self.tag, 1e-9 * self.period_ns * frame_units as f64));
        if !self.with_parts {
            return;
        }
        let mut frame: Vec<(&'static str, f64)> = Vec::new();
        for (at, part) in (0..).step_by(2).zip(&self.passes) {
            let ms = 1e-6 * self.period_ns * between(at, at + 1) as f64;
            match frame.iter_mut().find(|(name, _)| name == part) {
                Some((_, sum)) => *sum += ms,
                None => frame.push((part, ms)),
            }
        }
        let before = std::mem::take(&mut self.times);
        let smooth = |(name, ms): (&'static str, f64)| match before.iter().find(|(known, _)| *known == name) {
            Some((_, smooth)) => (name, smooth + GPU_TIME_SMOOTHING_WEIGHT * (ms - smooth)),
            None => (name, ms),
        };
        self.times = frame.into_iter().map(smooth).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::kit::begin_compute;
    use crate::gpu::{offscreen, readback};

    /// A device with timestamps, and a timer for it.
    fn gpu_and_timer() -> (Gpu, Timer) {
        let gpu = pollster::block_on(Gpu::request()).unwrap();
        let timer = Timer::new(&gpu);
        assert!(timer.is_available(), "the tests need an adapter with timestamps");
        (gpu, timer)
    }

    fn compute_queries(timer: &Timer, part: &'static str) -> Option<PassQueries> {
        timer.compute_pass(part).map(|w| [w.beginning_of_pass_write_index, w.end_of_pass_write_index])
    }

    fn last_queries(timer: &Timer) -> Option<PassQueries> {
        timer.last_render_pass("last").map(|w| [w.beginning_of_pass_write_index, w.end_of_pass_write_index])
    }

    #[test]
    fn a_whole_frame_is_timed_from_its_first_pass_to_its_last() {
        let (_, timer) = gpu_and_timer();
        assert_eq!(compute_queries(&timer, "before the frame"), None);
        timer.begin_frame(true, false, 0);
        assert_eq!(compute_queries(&timer, "first"), Some([Some(0), None]));
        assert_eq!(compute_queries(&timer, "second"), None);
        assert_eq!(last_queries(&timer), Some([None, Some(1)]));
        assert_eq!(compute_queries(&timer, "after the frame"), None);
    }

    #[test]
    fn every_pass_of_a_frame_with_parts_has_timestamps_of_its_own() {
        let (_, timer) = gpu_and_timer();
        timer.begin_frame(true, true, 0);
        assert_eq!(compute_queries(&timer, "first"), Some([Some(0), Some(1)]));
        assert_eq!(compute_queries(&timer, "second"), Some([Some(2), Some(3)]));
        assert_eq!(last_queries(&timer), Some([Some(4), Some(5)]));
    }

    /// Records and submits a timed frame of the passes `parts`, and a last pass if `is_complete`.
    fn submit_frame(gpu: &Gpu, timer: &Timer, with_parts: bool, parts: &[&'static str], is_complete: bool) {
        let target = offscreen::create_target(gpu, wgpu::TextureFormat::Rgba8Unorm, [256, 256]);
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = gpu.encoder("test");
        timer.begin_frame(true, with_parts, 7);
        for &part in parts {
            drop(begin_compute(&mut encoder, part, timer.compute_pass(part)));
        }
        if is_complete {
            drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations::default(),
                })],
                timestamp_writes: timer.last_render_pass("last"),
                ..Default::default()
            }));
        }
        timer.end_frame(&mut encoder);
        gpu.submit(encoder);
        pollster::block_on(readback::wait_for_submitted_work(gpu)).unwrap();
    }

    #[test]
    fn times_of_passes_of_one_part_are_added() {
        let (gpu, timer) = gpu_and_timer();
        submit_frame(&gpu, &timer, true, &["rows", "columns", "rows"], true);
        // The next frame requests the timestamps, and the one after it reads them.
        timer.begin_frame(true, true, 0);
        pollster::block_on(readback::wait_for_submitted_work(&gpu)).unwrap();
        timer.begin_frame(true, true, 0);
        let parts: Vec<_> = timer.part_times_ms().iter().map(|(part, _)| *part).collect();
        assert_eq!(parts, ["rows", "columns", "last"]);
        assert!(timer.part_times_ms().iter().all(|(_, ms)| (0.0..1e4).contains(ms)));
    }

    #[test]
    fn a_frame_without_its_last_pass_has_no_time() {
        let (gpu, timer) = gpu_and_timer();
        for (is_complete, expected) in [(false, None), (true, Some(7))] {
            submit_frame(&gpu, &timer, false, &["first"], is_complete);
            for _ in 0..2 {
                timer.begin_frame(true, false, 0);
                timer.end_frame(&mut gpu.encoder("test"));
                pollster::block_on(readback::wait_for_submitted_work(&gpu)).unwrap();
            }
            assert_eq!(timer.take_frame_time().map(|(tag, _)| tag), expected);
        }
    }
}
