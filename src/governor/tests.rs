//! The governor on simulated displays and GPUs.

use super::*;

/// How a display paces frames.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Pace {
    /// Two buffers: each frame waits for the refresh after its GPU work.
    DoubleBuffered,
    /// More buffers: frames follow each other at the refresh rate, or as fast as the GPU allows if that is slower.
    Capped,
}

/// Time for which the compiler of a pipeline holds up a frame, s.
const COMPILATION_S: f64 = 0.3;

/// A display with a refresh interval, and a GPU that takes `full_s` for a frame with all pixels, of which the fraction
/// `fixed` does not depend on the number of pixels.
#[derive(Clone, Copy, Debug)]
struct Machine {
    refresh_s: f64,
    pace: Pace,
    full_s: f64,
    fixed: f64,
    /// Factor that the lean light brings on the GPU time.
    lean: f64,
    /// Whether the machine tells GPU times.
    has_gpu_times: bool,
    /// Largest relative deviation of a frame's GPU time.
    noise: f64,
}

/// A display of 60 Hz with two buffers, and a GPU that takes `full_s` for a frame with all pixels.
fn machine(full_s: f64) -> Machine {
    Machine {
        refresh_s: 1.0 / 60.0,
        pace: Pace::DoubleBuffered,
        full_s,
        fixed: 0.0,
        lean: 1.0,
        has_gpu_times: true,
        noise: 0.04,
    }
}

impl Machine {
    fn gpu_s(&self, scale: f64) -> f64 {
        self.full_s * (self.fixed + (1.0 - self.fixed) * scale * scale)
    }

    /// Largest scale at which the GPU takes at most `gpu_s`.
    fn scale_for(&self, gpu_s: f64) -> f64 {
        ((gpu_s / self.full_s - self.fixed) / (1.0 - self.fixed)).max(0.0).sqrt().min(1.0)
    }

    fn interval_s(&self, gpu_s: f64) -> f64 {
        match self.pace {
            Pace::DoubleBuffered => (gpu_s / self.refresh_s - 1e-9).ceil().max(1.0) * self.refresh_s,
            Pace::Capped => gpu_s.max(self.refresh_s),
        }
    }

    /// Best resolution scales: for each frame time from 1/60 to 1/30 s that the display can show, the scale that fits,
    /// as far as at least `least` remains; at the longest frame time any scale.
    fn best_scale(&self, least: f64) -> f64 {
        let mut frame_s = self.refresh_s * (1.05 / 60.0 / self.refresh_s).floor().max(1.0);
        while frame_s + self.refresh_s <= 1.05 / 30.0 && self.scale_for(0.9 * frame_s) < least {
            frame_s += self.refresh_s;
        }
        self.scale_for(0.9 * frame_s)
    }

    /// A governor that has seen the start, when frames show no picture yet.
    fn after_start(&self) -> Governor {
        let mut governor = Governor::new(1.0, 0.4, 0);
        (0..8).for_each(|_| governor.note_idle_frame(self.refresh_s));
        governor
    }

    /// Runs the governor for some seconds. Returns time and scale of every frame.
    fn run(&self, governor: &mut Governor, seconds: f64) -> Vec<(f64, f64)> {
        let (mut t, mut frames) = (0.0, Vec::new());
        let mut in_flight: Vec<(u32, f64)> = Vec::new();
        let mut was_lean = governor.is_lean();
        while t < seconds {
            let (scale, level) = (governor.scale(), governor.level());
            // The first frame with the lean light compiles a pipeline.
            let is_first = governor.is_lean() && !std::mem::replace(&mut was_lean, governor.is_lean());
            let light = if governor.is_lean() { self.lean } else { 1.0 };
            // Noise by a formula, so that every run of the test has the same frames.
            let gpu_s = light * self.gpu_s(scale) * (1.0 + self.noise * (frames.len() as f64 * 2.399_963).sin());
            let interval_s = self.interval_s(gpu_s) + if is_first { COMPILATION_S } else { 0.0 };
            t += interval_s;
            frames.push((t, scale));
            in_flight.push((level, gpu_s));
            // GPU times arrive two frames later, and count only if the resolution is still the same.
            let arrived = (in_flight.len() > 2).then(|| in_flight.remove(0));
            let known = arrived.filter(|(at, _)| self.has_gpu_times && *at == level).map(|(_, gpu_s)| gpu_s);
            governor.note_frame(interval_s, known);
        }
        frames
    }
}

const REFRESH_RATES_HZ: [f64; 6] = [30.0, 60.0, 75.0, 90.0, 120.0, 144.0];
const FULL_TIMES_MS: [f64; 20] = [
    2.0, 3.0, 5.0, 7.0, 9.0, 11.0, 13.0, 15.0, 17.0, 19.0, 22.0, 25.0, 29.0, 33.0, 40.0, 50.0, 65.0, 90.0, 130.0, 200.0,
];

fn machines() -> impl Iterator<Item = Machine> {
    REFRESH_RATES_HZ.into_iter().flat_map(|hz| {
        [Pace::DoubleBuffered, Pace::Capped].into_iter().flat_map(move |pace| {
            FULL_TIMES_MS.into_iter().flat_map(move |ms| {
                [0.0, 0.1].map(|fixed| Machine { refresh_s: 1.0 / hz, pace, fixed, ..machine(1e-3 * ms) })
            })
        })
    })
}

#[test]
fn the_scale_is_near_the_best_within_a_second_and_a_half_and_stays() {
    let mut faults = Vec::new();
    for machine in machines() {
        let frames = machine.run(&mut machine.after_start(), 12.0);
        let late: Vec<f64> = frames.iter().filter(|(t, _)| *t > 1.5).map(|(_, scale)| *scale).collect();
        let (least, most) = late.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), s| (a.min(*s), b.max(*s)));
        // Just where another frame time becomes the better one, both are right.
        let best = [0.66, 0.7, 0.78].map(|least| machine.best_scale(least).max(0.4));
        let is_near = best.iter().any(|best| (least / best - 1.0).abs() <= 0.1 && (most / best - 1.0).abs() <= 0.1);
        let changes = late.windows(2).filter(|pair| pair[0] != pair[1]).count();
        if !is_near || changes > 2 {
            faults.push(format!("{machine:?}: best {best:.3?}, found {least:.3} to {most:.3}, {changes} changes"));
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn an_idle_gpu_never_loses_pixels() {
    for machine in machines() {
        if machine.full_s * 1.04 > 0.45 * machine.refresh_s.max(SMOOTH_FRAME_S) {
            continue;
        }
        // Also if the display's refresh interval is not known, and if a power saver halves its rate.
        for mut governor in [Governor::new(1.0, 0.4, 0), machine.after_start()] {
            let mut frames = machine.run(&mut governor, 30.0);
            let saver = Machine { refresh_s: 2.0 * machine.refresh_s, ..machine };
            frames.extend(saver.run(&mut governor, 30.0));
            assert!(frames.iter().all(|(_, scale)| *scale == 1.0), "{machine:?}");
        }
    }
}

#[test]
fn a_display_capped_at_30_hz_gets_all_pixels() {
    for full_s in [0.002, 0.01, 0.016, 0.022, 0.028] {
        for has_gpu_times in [true, false] {
            let machine = Machine { refresh_s: 1.0 / 30.0, pace: Pace::Capped, has_gpu_times, ..machine(full_s) };
            let mut governor = Governor::new(1.0, 0.4, 0);
            machine.run(&mut governor, 1.5);
            let frames = machine.run(&mut governor, 20.0);
            assert!(frames.iter().all(|(_, scale)| *scale == 1.0), "{machine:?}");
        }
    }
}

#[test]
fn a_higher_cost_takes_pixels_and_a_lower_one_brings_them_back() {
    let machine = |full_s| Machine { fixed: 0.1, ..machine(full_s) };
    let mut governor = machine(0.005).after_start();
    for (full_s, scale) in [(0.005, 1.0..=1.0), (0.025, 0.7..=0.8), (0.09, 0.45..=0.55), (0.005, 1.0..=1.0)] {
        machine(full_s).run(&mut governor, 2.0);
        assert!(scale.contains(&governor.scale()), "{full_s}: {}", governor.scale());
    }
}

#[test]
fn without_gpu_times_a_slow_gpu_is_relieved_and_trials_become_rare() {
    for full_s in [0.022, 0.05, 0.12] {
        let machine = Machine { has_gpu_times: false, ..machine(full_s) };
        let mut governor = machine.after_start();
        machine.run(&mut governor, 60.0);
        let frames = machine.run(&mut governor, 60.0);
        let changes = frames.windows(2).filter(|pair| pair[0].1 != pair[1].1).count();
        assert!(changes <= 8, "{machine:?}: {changes} changes in a minute");
        let (scale, best) = (governor.scale(), machine.best_scale(MIN_SCALE_FOR_SMOOTH_MOTION));
        assert!(scale > 0.85 * best, "{machine:?}: {scale}, best {best}");
        assert!(machine.interval_s(machine.gpu_s(scale)) < 1.05 * LONGEST_FRAME_S, "{machine:?}: {scale}");
    }
}

#[test]
fn noise_does_not_make_the_resolution_flicker() {
    for full_ms in [13.0, 15.0, 17.0, 20.0, 25.0, 40.0, 80.0] {
        for pace in [Pace::DoubleBuffered, Pace::Capped] {
            let machine = Machine { pace, noise: 0.4, ..machine(1e-3 * full_ms) };
            let mut governor = machine.after_start();
            machine.run(&mut governor, 60.0);
            let frames = machine.run(&mut governor, 60.0);
            let changes = frames.windows(2).filter(|pair| pair[0].1 != pair[1].1).count();
            assert!(changes <= 6, "{machine:?}: {changes} changes in a minute");
        }
    }
}

#[test]
fn the_fft_shrinks_last_and_only_if_it_helps() {
    let machine = |full_s| Machine { pace: Pace::Capped, ..machine(full_s) };
    let mut governor = machine(0.15).after_start();
    machine(0.15).run(&mut governor, 3.0);
    assert!(governor.scale() < 0.43 && governor.halvings() == 0, "{governor:?}");
    // No resolution is low enough, and the FFT size makes no difference.
    machine(0.5).run(&mut governor, 6.0);
    assert_eq!((governor.scale(), governor.halvings()), (0.4, 0));
    let mut helped = machine(0.5).after_start();
    for _ in 0..60 {
        // Most of the cost is the FFT's.
        let full_s = 0.5 / 4.0_f64.powi(helped.halvings() as i32);
        Machine { fixed: 0.8, ..machine(full_s) }.run(&mut helped, 0.1);
    }
    assert!(helped.halvings() >= 1, "{helped:?}");
}

/// Largest relative distance from the best scale.
const NEARNESS: f64 = 0.1;

/// Scale and light that a machine ought to end with: the full light if it leaves the scale `least`.
fn best_with_light(machine: &Machine, least: f64) -> (f64, bool) {
    let full = machine.best_scale(least);
    if full >= least || machine.lean > NEEDED_SHORTENING {
        return (full.max(0.4), false);
    }
    let lean = Machine { full_s: machine.lean * machine.full_s, ..*machine };
    (lean.best_scale(least).max(0.4), true)
}

#[test]
fn the_lean_light_comes_before_less_than_half_of_the_pixels_and_stays() {
    let mut faults = Vec::new();
    for machine in machines().flat_map(|machine| [0.95, 0.85, 0.6, 0.4].map(|lean| Machine { lean, ..machine })) {
        let mut governor = machine.after_start();
        let frames = machine.run(&mut governor, 12.0);
        let late: Vec<f64> = frames.iter().filter(|(t, _)| *t > 4.0).map(|(_, scale)| *scale).collect();
        let changes = late.windows(2).filter(|pair| pair[0] != pair[1]).count();
        // Just where another frame time becomes the better one, both are right.
        let best = [0.66, 0.7, 0.78].map(|least| best_with_light(&machine, least));
        let is_near = best.iter().any(|(scale, is_lean)| {
            (governor.scale() / scale - 1.0).abs() <= NEARNESS && *is_lean == governor.is_lean()
        });
        // A step down that shortens frames by less than a tenth is undone. With fixed costs, that can leave more pixels
        // at a fifth more than the time of 30 Hz.
        let light = if governor.is_lean() { machine.lean } else { 1.0 };
        let interval_s = machine.interval_s(light * machine.gpu_s(governor.scale()));
        let is_rich = governor.scale() > best[1].0 && interval_s <= 1.201 * LONGEST_FRAME_S;
        let is_hopeless = machine.lean * machine.gpu_s(0.4) > GPU_TIME_FRACTION * LONGEST_FRAME_S;
        if !is_near && !is_rich && !is_hopeless || changes > 2 {
            faults.push(format!(
                "{machine:?}: best {best:.3?}, found {:.3} lean {}, {changes} changes",
                governor.scale(),
                governor.is_lean()
            ));
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults[..faults.len().min(30)].join("\n"));
}

#[test]
fn the_full_light_returns_with_time_and_by_choice() {
    let slow = Machine { lean: 0.4, ..machine(0.09) };
    let mut governor = slow.after_start();
    slow.run(&mut governor, 5.0);
    assert!(governor.is_lean() && governor.scale() > 0.85, "{governor:?}");
    let fast = Machine { lean: 0.4, ..machine(0.005) };
    fast.run(&mut governor, 10.0);
    assert_eq!(governor.level(), 0, "{governor:?}");
    slow.run(&mut governor, 15.0);
    assert!(governor.is_lean());
    governor.let_light_be_lean(false);
    assert!(!governor.is_lean());
    slow.run(&mut governor, 5.0);
    assert!(!governor.is_lean() && governor.scale() < 0.7, "{governor:?}");
}
