//! `seastate stats`: theory, resolved and measured numbers of a sea, side by side.

use crate::gpu::device::Gpu;
use crate::gpu::readback;
use crate::gpu::shaders::Shaders;
use crate::model::statistics::{self, Resolved, Theory};
use crate::model::{Params, Plan, noise, query};
use crate::oracle::foam::jacobian;
use crate::sim::{MAX_STEPS, MapsF32, Simulation};
use half::f16;
use serde_json::{Value, json};
use std::fmt;

/// Time between two looks at the sea, from which the sense of its travel follows, s.
const LOOK_S: f64 = 0.05;
/// Seeds that are looked at twice for it: the direction is known far better than the height.
const LOOKS: u32 = 8;
/// Points of the displaced surface that each seed contributes to skewness and kurtosis.
const POINTS: u32 = 1 << 16;

/// The numbers of one sea.
#[derive(Debug)]
pub struct Report {
    params: Params,
    plan: Plan,
    theory: Theory,
    resolved: Resolved,
    measured: Measured,
}

/// A mean over the seeds and its standard error (None for a single seed).
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// Mean.
    pub value: f64,
    /// Standard error of the mean.
    pub error: Option<f64>,
}

/// From the f32 copy of the maps. Heights are those of the undisplaced grid; skewness and kurtosis are those of the
/// displaced surface, weighted by the Jacobian.
#[derive(Debug)]
pub struct Measured {
    /// Significant wave height from the mean variance over the seeds, m.
    pub hs_m: Estimate,
    /// Mean elevation, m.
    pub mean_m: Estimate,
    /// Mean square slope.
    pub mss: Estimate,
    /// Skewness of the elevation.
    pub skewness: Estimate,
    /// Kurtosis of the elevation, 3 for a Gaussian.
    pub kurtosis: Estimate,
    /// Direction that the waves come from, degrees, from two looks; None on a calm.
    pub from_deg: Option<f64>,
    /// Mean foam of the first seed.
    pub whitecap_fraction: f64,
    /// Largest relative difference between a seed's variance and the sum of its squared amplitudes.
    pub parseval_error: f64,
    /// Seeds.
    pub seeds: u32,
}

/// Measures a state over `seeds` seeds, counted from the state's own.
///
/// # Errors
/// If the GPU does not give its memory back.
pub async fn run(gpu: &Gpu, params: &Params, seeds: u32) -> Result<Report, String> {
    let plan = Plan::new(params);
    let theory = Theory::new(&plan);
    let resolved = Resolved::new(&plan, theory.m0_m2);
    let measured = measure(gpu, params, &plan, seeds).await?;
    Ok(Report { params: params.clone(), plan, theory, resolved, measured })
}

/// What one seed gives.
struct Sample {
    variance: f64,
    mean: f64,
    mss: f64,
    skewness: f64,
    kurtosis: f64,
    flux: [f64; 2],
    parseval_error: f64,
}

async fn measure(gpu: &Gpu, params: &Params, plan: &Plan, seeds: u32) -> Result<Measured, String> {
    let shaders = Shaders::default();
    let (device, queue) = (&gpu.device, &gpu.queue);
    let t_s = params.clock.t_s;
    let mut sim = Simulation::new(device, queue, plan.clone(), &shaders);
    let whitecap_fraction = whitecaps(gpu, &mut sim, t_s).await?;
    let mut samples = Vec::new();
    for i in 0..seeds {
        let mut params = params.clone();
        params.sea.seed = params.sea.seed.wrapping_add(i);
        let plan = Plan::new(&params);
        sim.set_plan(device, queue, plan.clone(), &shaders);
        let now = sim.read_f32(device, queue, t_s).await?;
        let later = if i < LOOKS { Some(sim.read_f32(device, queue, t_s + LOOK_S).await?) } else { None };
        samples.push(sample(&plan, &now, later.as_ref(), t_s));
    }
    let over = |f: fn(&Sample) -> f64| estimate(&samples.iter().map(f).collect::<Vec<_>>());
    let variance = over(|s| s.variance);
    let hs_m = 4.0 * variance.value.sqrt();
    let flux = samples.iter().fold([0.0; 2], |sum, s| [sum[0] + s.flux[0], sum[1] + s.flux[1]]);
    Ok(Measured {
        hs_m: Estimate { value: hs_m, error: variance.error.map(|e| 0.5 * hs_m * e / variance.value.max(1e-300)) },
        mean_m: over(|s| s.mean),
        mss: over(|s| s.mss),
        skewness: over(|s| s.skewness),
        kurtosis: over(|s| s.kurtosis),
        from_deg: (flux[0].hypot(flux[1]) > 0.0).then(|| statistics::from_deg(flux)),
        whitecap_fraction,
        parseval_error: samples.iter().map(|s| s.parseval_error).fold(0.0, f64::max),
        seeds,
    })
}

fn sample(plan: &Plan, now: &MapsF32, later: Option<&MapsF32>, t_s: f64) -> Sample {
    let (mut variance, mut mean, mut mss, mut flux) = (0.0, 0.0, 0.0, [0.0; 2]);
    let count = (now.n * now.n) as f64;
    for c in 0..now.cascades() {
        let sum = now.displacement(c).iter().map(|d| f64::from(d[1])).sum::<f64>() / count;
        mean += sum;
        variance += now.displacement(c).iter().map(|d| (f64::from(d[1]) - sum).powi(2)).sum::<f64>() / count;
        for (d, after) in now.displacement(c).iter().zip(later.into_iter().flat_map(|l| l.displacement(c))) {
            // <d eta/dt D> points against the travel: eta = sum h, D = sum i k/|k| h, d eta/dt = sum -i w h.
            let rate = f64::from(after[1] - d[1]) / LOOK_S;
            for (axis, at) in [(0, 0), (1, 2)] {
                flux[axis] -= rate * 0.5 * f64::from(d[at] + after[at]) / count;
            }
        }
        mss += now.gradients(c).iter().map(|g| f64::from(g[0]).powi(2) + f64::from(g[1]).powi(2)).sum::<f64>() / count;
    }
    let drawn = statistics::drawn_variance(plan, t_s);
    let (skewness, kurtosis) = shape(plan, now);
    let parseval_error = (variance - drawn).abs() / drawn.max(f64::MIN_POSITIVE);
    let parseval_error = if drawn == 0.0 { variance } else { parseval_error };
    Sample { variance, mean, mss, skewness, kurtosis, flux, parseval_error }
}

/// Skewness and kurtosis of the displaced surface. The cascades are independent of each other and each is the same
/// everywhere in the mean, so that a point of the sum is one point of each, picked at random: no interpolation.
fn shape(plan: &Plan, maps: &MapsF32) -> (f64, f64) {
    let n = maps.n as u32;
    let mut sums = [0.0; 5];
    for i in 0..POINTS {
        let (mut eta, mut strain) = (0.0, [0.0; 3]);
        for c in 0..maps.cascades() {
            let at = noise::pcg4d([i, c as u32, plan.sea.seed, 17]);
            let at = ((at[0] % n) * n + at[1] % n) as usize;
            let (d, g) = (maps.displacement(c)[at], maps.gradients(c)[at]);
            eta += f64::from(d[1]);
            strain[0] += f64::from(g[2]);
            strain[1] += f64::from(g[3]);
            strain[2] += f64::from(d[3]);
        }
        let weight = jacobian(strain, plan.sea.chop);
        for (power, sum) in sums.iter_mut().enumerate() {
            *sum += weight * eta.powi(power as i32);
        }
    }
    let [m1, m2, m3, m4] = [1, 2, 3, 4].map(|p| sums[p] / sums[0]);
    let variance = m2 - m1 * m1;
    if variance <= 0.0 {
        return (0.0, 0.0);
    }
    let third = m3 - 3.0 * m1 * m2 + 2.0 * m1.powi(3);
    let fourth = m4 - 4.0 * m1 * m3 + 6.0 * m1 * m1 * m2 - 3.0 * m1.powi(4);
    (third / variance.powf(1.5), fourth / (variance * variance))
}

/// Mean foam over all levels after a cold start.
async fn whitecaps(gpu: &Gpu, sim: &mut Simulation, t_s: f64) -> Result<f64, String> {
    let levels = foam_levels(gpu, sim, t_s, [0.0; 2]).await?;
    let count: usize = levels.iter().map(Vec::len).sum();
    Ok(levels.iter().flatten().map(|&f| f64::from(f)).sum::<f64>() / count as f64)
}

/// Foam of every level around `centre` after a cold start at `t_s`, as it lies in memory (toroidal).
pub(super) async fn foam_levels(
    gpu: &Gpu,
    sim: &mut Simulation,
    t_s: f64,
    centre: [f64; 2],
) -> Result<Vec<Vec<f32>>, String> {
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("foam") });
    sim.encode(&gpu.queue, &mut encoder, t_s, centre, MAX_STEPS);
    let copy = readback::stage_texture(&gpu.device, &mut encoder, &sim.resources.foam, 0);
    gpu.queue.submit([encoder.finish()]);
    let texels: Vec<[f16; 4]> = bytemuck::pod_collect_to_vec(&copy.read(&gpu.device).await?);
    let size = sim.resources.foam_n as usize;
    Ok(texels.chunks(size * size).map(|level| level.iter().map(|t| t[0].to_f32()).collect()).collect())
}

fn estimate(values: &[f64]) -> Estimate {
    let count = values.len() as f64;
    let value = values.iter().sum::<f64>() / count;
    let spread = values.iter().map(|v| (v - value).powi(2)).sum::<f64>();
    Estimate { value, error: (values.len() > 1).then(|| (spread / (count - 1.0) / count).sqrt()) }
}

impl Report {
    /// Integrals of the spectrum.
    pub fn theory(&self) -> &Theory {
        &self.theory
    }

    /// Sums over the waves of the cascades.
    pub fn resolved(&self) -> &Resolved {
        &self.resolved
    }

    /// What was read back.
    pub fn measured(&self) -> &Measured {
        &self.measured
    }

    /// The report as JSON; every measured quantity has its standard error beside it.
    pub fn json(&self, notices: &[String]) -> String {
        let (t, r, m) = (&self.theory, &self.resolved, &self.measured);
        let notices: Vec<&String> = notices.iter().chain(&self.plan.notices).collect();
        let cascades: Vec<Value> = (self.plan.cascades.iter())
            .map(|c| json!({"n": self.plan.n, "patch_m": c.patch_m, "k_low": c.k_low, "k_high": c.k_high}))
            .collect();
        let value = json!({
            "state": query::write(&self.params),
            "notices": notices,
            "theory": {
                "m0_m2": t.m0_m2, "hs_m": t.hs_m, "tp_s": t.tp_s, "tm02_s": t.tm02_s, "lambda_p_m": t.lambda_p_m,
                "mss": t.mss, "k_max": t.k_max, "mean_from_deg": t.mean_from_deg, "spread_deg": t.spread_deg,
            },
            "resolved": {
                "m0_m2": r.m0_m2, "hs_m": r.hs_m, "mss": r.mss, "k_max": t.k_max, "m0_fraction": r.m0_fraction,
                "mean_from_deg": r.mean_from_deg, "spread_deg": r.spread_deg,
            },
            "measured": {
                "hs_m": m.hs_m.value, "hs_se_m": m.hs_m.error,
                "mean_m": m.mean_m.value, "mean_se_m": m.mean_m.error,
                "mss": m.mss.value, "mss_se": m.mss.error,
                "skewness": m.skewness.value, "skewness_se": m.skewness.error,
                "kurtosis": m.kurtosis.value, "kurtosis_se": m.kurtosis.error,
                "from_deg": m.from_deg, "whitecap_fraction": m.whitecap_fraction,
                "parseval_error": m.parseval_error, "seeds": m.seeds,
            },
            "cascades": cascades,
        });
        serde_json::to_string_pretty(&value).unwrap_or_default()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (t, r, m) = (&self.theory, &self.resolved, &self.measured);
        let with_error = |e: &Estimate| match e.error {
            Some(error) => format!("{:.4} ± {error:.4}", e.value),
            None => format!("{:.4}", e.value),
        };
        writeln!(f, "{:<26} {:>12} {:>12} {:>20}", "", "theory", "resolved", "measured")?;
        writeln!(f, "{:<26} {:>12.4} {:>12.4} {:>20}", "Hs, m", t.hs_m, r.hs_m, with_error(&m.hs_m))?;
        let mss = format!("mss to {:.1} rad/m", t.k_max);
        writeln!(f, "{mss:<26} {:>12.5} {:>12.5} {:>20}", t.mss, r.mss, with_error(&m.mss))?;
        writeln!(f, "{:<26} {:>12.2}", "Tp, s", t.tp_s)?;
        writeln!(f, "{:<26} {:>12.2}", "Tm02, s", t.tm02_s)?;
        writeln!(f, "{:<26} {:>12.1}", "peak wavelength, m", t.lambda_p_m)?;
        let degrees = |d: Option<f64>| d.map_or("none".to_owned(), |d| format!("{d:.1}"));
        writeln!(
            f,
            "{:<26} {:>12} {:>12} {:>20}",
            "from, degrees",
            degrees(t.mean_from_deg),
            degrees(r.mean_from_deg),
            degrees(m.from_deg)
        )?;
        writeln!(f, "{:<26} {:>12.1} {:>12.1}", "directional spread, deg", t.spread_deg, r.spread_deg)?;
        writeln!(f, "{:<26} {:>12} {:>12.4}", "share of m0", "", r.m0_fraction)?;
        writeln!(f, "{:<26} {:>12} {:>12} {:>20}", "mean, m", "", "", with_error(&m.mean_m))?;
        writeln!(f, "{:<26} {:>12} {:>12} {:>20}", "skewness", "", "", with_error(&m.skewness))?;
        writeln!(f, "{:<26} {:>12} {:>12} {:>20}", "kurtosis", "", "", with_error(&m.kurtosis))?;
        let foam = statistics::monahan_coverage(self.plan.sea.wind_m_s);
        writeln!(f, "{:<26} {foam:>12.4} {:>12} {:>20.4}", "whitecap fraction", "", m.whitecap_fraction)?;
        writeln!(f, "{:<26} {:>12} {:>12} {:>20}", "seeds", "", "", m.seeds)?;
        for c in &self.plan.cascades {
            writeln!(
                f,
                "cascade {} x {0}, patch {:.1} m, {:.4} to {:.4} rad/m",
                self.plan.n, c.patch_m, c.k_low, c.k_high
            )?;
        }
        Ok(())
    }
}
