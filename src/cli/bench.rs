//! `seastate bench`: what each pass costs, by submitting it alone and waiting. The least time is the nearest to what the
//! pass costs on a machine that does nothing else; median and percentiles say how quiet it was. Where the GPU is software, the
//! time that the process spent on CPUs says it better on a busy machine.

use super::render;
use crate::gpu::device::Gpu;
use crate::gpu::offscreen;
use crate::gpu::shaders::Shaders;
use crate::model::{Params, Plan, query};
use crate::ocean::{Ocean, Part};
use crate::sim::Simulation;
use serde_json::json;
use std::fmt;
use web_time::Instant;

/// Time of one pass over the repetitions, ms.
#[derive(Clone, Debug)]
struct Timing {
    pass: &'static str,
    least: f64,
    median: f64,
    low: f64,
    high: f64,
    /// Least time on CPUs, where the system says.
    cpu: Option<f64>,
}

/// The result.
#[derive(Debug)]
pub struct Report {
    state: String,
    adapter: String,
    backend: String,
    n: u32,
    cascades: usize,
    size: [u32; 2],
    repeat: u32,
    timings: Vec<Timing>,
}

/// Times the passes of a state and the whole frame at `size` pixels.
///
/// # Errors
/// If there is no adapter, or waiting for it fails.
pub async fn run(params: &Params, size: [u32; 2], repeat: u32) -> Result<Report, String> {
    let gpu = Gpu::request().await?;
    let plan = Plan::new(params);
    let mut sim = Simulation::new(&gpu.device, &gpu.queue, plan.clone(), &Shaders::default());
    let step = sim.push_step(&gpu.queue, params.clock.t_s, false);
    let foam = sim.push_foam_step(&gpu.queue, params.clock.t_s, [params.camera.x_m, params.camera.z_m]);
    let mut timings = Vec::new();
    {
        let (p, r) = (&sim.passes, &sim.resources);
        let mut add = |pass, record: &dyn Fn(&mut wgpu::CommandEncoder)| {
            timings.push(time(&gpu, repeat, pass, |_, encoder| record(encoder))?);
            Ok::<(), String>(())
        };
        add("spectrum", &|e| p.spectrum.run(e, r, step))?;
        add("rows", &|e| p.rows.run(e, r, step))?;
        add("columns", &|e| p.columns.run(e, r, step))?;
        add("mips", &|e| p.mips.run(e, r, step))?;
        add("foam", &|e| p.foam.run(e, r, step, foam))?;
    }
    let mut ocean = Ocean::new(&gpu.device, &gpu.queue, render::FORMAT, params);
    let target = offscreen::target(&gpu.device, render::FORMAT, size);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("picture") });
    ocean.encode_fully(&gpu.device, &gpu.queue, &mut encoder, size);
    gpu.queue.submit([encoder.finish()]);
    for (pass, part) in [("sky tables", Part::Light), ("background", Part::Background), ("water", Part::Water)] {
        timings.push(time(&gpu, repeat, pass, |_, encoder| ocean.record(encoder, part))?);
    }
    timings.push(time(&gpu, repeat, "present", |_, encoder| {
        offscreen::draw_over(encoder, &target, |pass| ocean.present(pass));
    })?);
    let mut frame = params.clone();
    timings.push(time(&gpu, repeat, "frame", |i, encoder| {
        frame.clock.t_s = params.clock.t_s + f64::from(i) / 60.0;
        ocean.set_params(&gpu.device, &gpu.queue, &frame);
        ocean.encode_fully(&gpu.device, &gpu.queue, encoder, size);
        offscreen::draw_over(encoder, &target, |pass| ocean.present(pass));
    })?);
    let info = gpu.adapter.get_info();
    Ok(Report {
        state: query::write(params),
        adapter: info.name,
        backend: info.backend.to_string(),
        n: plan.n,
        cascades: plan.cascades.len(),
        size,
        repeat,
        timings,
    })
}

/// Submits what `record` records and waits, `repeat` times after two to warm up.
#[expect(clippy::disallowed_methods, reason = "web_time's Instant is the standard one here, and no browser runs this")]
fn time(
    gpu: &Gpu,
    repeat: u32,
    pass: &'static str,
    mut record: impl FnMut(u32, &mut wgpu::CommandEncoder),
) -> Result<Timing, String> {
    let (mut times, mut cpu) = (Vec::new(), None);
    for i in 0..repeat + 2 {
        let (start, spent) = (Instant::now(), cpu_ms());
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(pass) });
        record(i, &mut encoder);
        gpu.queue.submit([encoder.finish()]);
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| e.to_string())?;
        if i >= 2 {
            times.push(1e3 * start.elapsed().as_secs_f64());
            let more = cpu_ms().zip(spent).map(|(after, before)| after - before);
            cpu = more.map(|more| cpu.map_or(more, |least: f64| least.min(more)));
        }
    }
    times.sort_by(f64::total_cmp);
    let at = |q: f64| times[((times.len() - 1) as f64 * q).round() as usize];
    Ok(Timing { pass, least: times[0], median: at(0.5), low: at(0.1), high: at(0.9), cpu })
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

impl Report {
    /// The report as JSON.
    pub fn json(&self) -> String {
        let passes: serde_json::Map<_, _> = (self.timings.iter())
            .map(|t| {
                (
                    t.pass.to_owned(),
                    json!({"least_ms": t.least, "median_ms": t.median, "p10_ms": t.low, "p90_ms": t.high, "least_cpu_ms": t.cpu}),
                )
            })
            .collect();
        let value = json!({
            "state": self.state, "adapter": self.adapter, "backend": self.backend, "n": self.n,
            "cascades": self.cascades, "size": self.size, "repeat": self.repeat,
            "method": "one submission, waited for", "passes": passes,
        });
        serde_json::to_string_pretty(&value).unwrap_or_default()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [w, h] = self.size;
        writeln!(f, "{} ({}), n {}, {} cascades, {w}x{h}", self.adapter, self.backend, self.n, self.cascades)?;
        writeln!(
            f,
            "{:<12} {:>10} {:>12} {:>24} {:>10}",
            "pass", "least, ms", "median, ms", "10th to 90th percentile", "CPU, ms"
        )?;
        for t in &self.timings {
            let cpu = t.cpu.map_or("-".to_owned(), |cpu| format!("{cpu:.3}"));
            let (pass, least, median) = (t.pass, t.least, t.median);
            writeln!(f, "{pass:<12} {least:>10.3} {median:>12.3} {:>14.3} {:>9.3} {cpu:>10}", t.low, t.high)?;
        }
        Ok(())
    }
}
