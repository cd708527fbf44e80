//! `seastate stats`: theory, resolved and measured numbers of a sea, side by side.

use crate::gpu::Gpu;
use crate::gpu::readback;
use crate::oracle::foam::jacobian;
use crate::oracle::{self, transform};
use crate::shaders::Shaders;
use crate::sim::{MAX_STEPS, MapsF32, Simulation};
use crate::state::{Params, query};
use crate::waves::plan::Cascade;
use crate::waves::statistics::{self, Resolved, SpectralMoments, Theory};
use crate::waves::{Plan, noise};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::fmt;

/// Phase by which the fastest wave goes on between two looks at the sea, from which follows what travels where, rad.
const LOOK_RAD: f64 = 1.0;
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

/// From the f32 copy of the maps. Heights are those of the undisplaced grid; periods and directions those of the waves that
/// two looks tell apart from their opposites; skewness and kurtosis those of the displaced surface, weighted by the Jacobian.
#[derive(Debug)]
pub struct Measured {
    /// Significant wave height from the mean variance over the seeds, m.
    pub hs_m: Estimate,
    /// Mean elevation, m.
    pub mean_m: Estimate,
    /// Mean square slope.
    pub mss: Estimate,
    /// Mean period 2 pi m0 / m1, s.
    pub tm01_s: Estimate,
    /// Mean zero-crossing period 2 pi sqrt(m0 / m2), s.
    pub tm02_s: Estimate,
    /// Direction that the waves come from, degrees; None where there is none.
    pub from_deg: Option<Estimate>,
    /// First directional moment along the mean direction.
    pub r1: Estimate,
    /// Directional spread sqrt(2 (1 - r1)), degrees.
    pub spread_deg: Estimate,
    /// Skewness of the elevation.
    pub skewness: Estimate,
    /// Kurtosis of the elevation, 3 for a Gaussian.
    pub kurtosis: Estimate,
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
pub(super) struct Sample {
    variance: f64,
    mean: f64,
    mss: f64,
    skewness: f64,
    kurtosis: f64,
    travelling: SpectralMoments,
    parseval_error: f64,
}

/// A wave that travels along its wave vector, as two looks show it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Travelling {
    /// Variance, m^2.
    pub variance: f64,
    /// Wave number, rad/m.
    pub k: f64,
    /// Angular frequency, rad/s.
    pub omega: f64,
    /// Unit vector of travel (x, z).
    pub unit: [f64; 2],
}

async fn measure(gpu: &Gpu, params: &Params, plan: &Plan, seeds: u32) -> Result<Measured, String> {
    let mut sim = Simulation::new(gpu, plan.clone(), &Shaders::default());
    let whitecap_fraction = whitecaps(gpu, &mut sim, params.clock.t_s).await?;
    let samples = ensemble(gpu, &mut sim, params, seeds, &mut |_, _| ()).await?;
    Ok(Measured { whitecap_fraction, ..summary(&samples) })
}

/// One sample per seed; `visit` sees every wave of every seed (counted from 0).
pub(super) async fn ensemble(
    gpu: &Gpu,
    sim: &mut Simulation,
    params: &Params,
    seeds: u32,
    visit: &mut dyn FnMut(usize, &Travelling),
) -> Result<Vec<Sample>, String> {
    let shaders = Shaders::default();
    let t_s = params.clock.t_s;
    let plan = Plan::new(params);
    let look_s = LOOK_RAD / plan.dispersion.omega(plan.k_max());
    let mut samples = Vec::new();
    for i in 0..seeds {
        let mut params = params.clone();
        params.sea.seed = params.sea.seed.wrapping_add(i);
        let plan = Plan::new(&params);
        sim.set_plan(gpu, plan.clone(), &shaders);
        let now = sim.read_f32(gpu, t_s).await?;
        let later = sim.read_f32(gpu, t_s + look_s).await?;
        samples.push(sample(&plan, &now, &later, [t_s, t_s + look_s], &mut |wave| visit(i as usize, wave)));
    }
    Ok(samples)
}

/// Means and standard errors over the seeds.
pub(super) fn summary(samples: &[Sample]) -> Measured {
    let over = |f: fn(&Sample) -> f64| estimate(&samples.iter().map(f).collect::<Vec<_>>());
    let variance = over(|s| s.variance);
    let hs_m = 4.0 * variance.value.sqrt();
    let [m0, m1, m2] = [0, 1, 2].map(|p| samples.iter().map(|s| s.travelling.m[p]).collect::<Vec<_>>());
    let [east, south] = [0, 1].map(|axis| samples.iter().map(|s| s.travelling.toward[axis]).collect::<Vec<_>>());
    let (x, z) = (east.iter().sum::<f64>(), south.iter().sum::<f64>());
    let length = x.hypot(z).max(f64::MIN_POSITIVE);
    // Along the mean direction and across it.
    let turned =
        |a: f64, b: f64| -> Vec<f64> { east.iter().zip(&south).map(|(e, s)| (e * a + s * b) / length).collect() };
    let (along, across) = (turned(x, z), turned(-z, x));
    let r1 = ratio(&along, &m0);
    let off = ratio(&across, &along).scaled(180.0 / PI);
    let spread_deg = statistics::spread_deg(r1.value);
    let tm02 = ratio(&m0, &m2);
    Measured {
        hs_m: variance.mapped(hs_m, 0.5 * hs_m / variance.value.max(f64::MIN_POSITIVE)),
        mean_m: over(|s| s.mean),
        mss: over(|s| s.mss),
        tm01_s: ratio(&m0, &m1).scaled(TAU),
        tm02_s: tm02.mapped(TAU * tm02.value.sqrt(), TAU * 0.5 / tm02.value.sqrt().max(1e-9)),
        from_deg: (r1.value > statistics::NO_DIRECTION).then(|| off.mapped(statistics::from_deg([x, z]), 1.0)),
        r1,
        spread_deg: r1.mapped(spread_deg, 180.0 / PI / spread_deg.to_radians().max(1e-9)),
        skewness: over(|s| s.skewness),
        kurtosis: over(|s| s.kurtosis),
        whitecap_fraction: 0.0,
        parseval_error: samples.iter().map(|s| s.parseval_error).fold(0.0, f64::max),
        seeds: samples.len() as u32,
    }
}

fn sample(plan: &Plan, now: &MapsF32, later: &MapsF32, times: [f64; 2], visit: &mut dyn FnMut(&Travelling)) -> Sample {
    let (mut variance, mut mean, mut mss) = (0.0, 0.0, 0.0);
    let count = (now.n * now.n) as f64;
    let mut travelling = SpectralMoments::default();
    for (c, cascade) in plan.cascades.iter().enumerate() {
        let sum = now.displacement(c).iter().map(|d| f64::from(d[1])).sum::<f64>() / count;
        mean += sum;
        variance += now.displacement(c).iter().map(|d| (f64::from(d[1]) - sum).powi(2)).sum::<f64>() / count;
        mss += now.gradients(c).iter().map(|g| f64::from(g[0]).powi(2) + f64::from(g[1]).powi(2)).sum::<f64>() / count;
        travel(plan, cascade, [now, later].map(|m| m.displacement(c)), times, &mut |wave| {
            travelling.add(wave.variance, wave.k, wave.omega, wave.unit);
            visit(wave);
        });
    }
    let drawn = statistics::realised_variance(plan, times[0]);
    let (skewness, kurtosis) = shape(plan, now);
    let parseval_error = (variance - drawn).abs() / drawn.max(f64::MIN_POSITIVE);
    let parseval_error = if drawn == 0.0 { variance } else { parseval_error };
    Sample { variance, mean, mss, skewness, kurtosis, travelling, parseval_error }
}

/// Visits the waves of a cascade as two looks show them: with X(k, t) = A e^{-i w t} + B* e^{+i w t} at both times, A is the
/// wave that travels along k, and its variance 2 |A|^2.
fn travel(
    plan: &Plan,
    cascade: &Cascade,
    looks: [&[[f32; 4]]; 2],
    times: [f64; 2],
    visit: &mut dyn FnMut(&Travelling),
) {
    let n = plan.n as usize;
    let [first, second] = looks.map(|d| heights_transform(n, d));
    let passed = plan.phase_time(times[1]).wrapping_sub(plan.phase_time(times[0]));
    let scale = 1.0 / (n * n) as f64;
    for z in 0..n {
        for x in 0..n {
            let (ix, iz) = (oracle::signed_index(x, n), oracle::signed_index(z, n));
            let wave = plan.wave(cascade, (ix * ix + iz * iz) as u32);
            if (ix, iz) == (0, 0) || !cascade.holds(wave.k) || ix == -(n as i32) / 2 || iz == -(n as i32) / 2 {
                continue;
            }
            let at = z * n + x;
            let turn = TAU * f64::from(wave.turns.wrapping_mul(passed)) / 4_294_967_296.0;
            let (sin, cos) = turn.sin_cos();
            // Conjugates: A* = (X2* - X1* e^{-i turn}) / (2 i sin turn).
            let (a, b) = (first[at], second[at]);
            let re = b[0] - (a[0] * cos + a[1] * sin);
            let im = b[1] - (a[1] * cos - a[0] * sin);
            let amplitude = scale / (2.0 * sin);
            let variance = 2.0 * (re * re + im * im) * amplitude * amplitude;
            let unit = [f64::from(ix), f64::from(iz)].map(|i| i * cascade.dk() / wave.k);
            visit(&Travelling { variance, k: wave.k, omega: wave.omega, unit });
        }
    }
}

/// The transform of a map's heights: the inverse one, which for real values is the conjugate of the forward one.
pub(super) fn heights_transform(n: usize, displacement: &[[f32; 4]]) -> Vec<[f64; 2]> {
    let heights: Vec<[f64; 2]> = displacement.iter().map(|d| [f64::from(d[1]), 0.0]).collect();
    transform::inverse_2d(n, &heights)
}

/// Skewness and kurtosis of the displaced surface. The cascades are independent of each other and each is the same
/// everywhere in the mean, so that a point of the sum is one point of each, picked at random: no interpolation.
fn shape(plan: &Plan, maps: &MapsF32) -> (f64, f64) {
    let mut sums = [0.0; 5];
    points(plan, maps, &mut |eta, weight| {
        for (power, sum) in sums.iter_mut().enumerate() {
            *sum += weight * eta.powi(power as i32);
        }
    });
    moments(sums)
}

/// Elevation and Jacobian of random points of the sum of cascades.
pub(super) fn points(plan: &Plan, maps: &MapsF32, visit: &mut dyn FnMut(f64, f64)) {
    let n = maps.n as u32;
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
        visit(eta, jacobian([strain[0], strain[1], strain[2], strain[2]], plan.sea.lambda()));
    }
}

/// Skewness and kurtosis from sums of powers 0 to 4.
fn moments(sums: [f64; 5]) -> (f64, f64) {
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
pub(crate) async fn foam_levels(
    gpu: &Gpu,
    sim: &mut Simulation,
    t_s: f64,
    centre: [f64; 2],
) -> Result<Vec<Vec<f32>>, String> {
    let mut encoder = gpu.encoder("foam");
    sim.encode(gpu, &mut encoder, t_s, centre, MAX_STEPS);
    let copy = readback::stage_texture(gpu, &mut encoder, &sim.resources.foam, 0);
    gpu.submit(encoder);
    let texels = copy.read_map(gpu).await?;
    let size = sim.resources.foam_n as usize;
    Ok(texels.chunks(size * size).map(|level| level.iter().map(|t| t[0]).collect()).collect())
}

/// Mean and standard error.
pub(super) fn estimate(values: &[f64]) -> Estimate {
    let count = values.len() as f64;
    let value = values.iter().sum::<f64>() / count;
    let spread = values.iter().map(|v| (v - value).powi(2)).sum::<f64>();
    Estimate { value, error: (values.len() > 1).then(|| (spread / (count - 1.0) / count).sqrt()) }
}

/// The ratio of two means and its standard error, to first order.
pub(super) fn ratio(above: &[f64], below: &[f64]) -> Estimate {
    let mean = below.iter().sum::<f64>() / below.len() as f64;
    if mean == 0.0 {
        return Estimate { value: 0.0, error: None };
    }
    let value = above.iter().sum::<f64>() / below.len() as f64 / mean;
    let rest = estimate(&above.iter().zip(below).map(|(a, b)| (a - value * b) / mean).collect::<Vec<_>>());
    Estimate { value, error: rest.error }
}

impl Estimate {
    /// The estimate times a factor.
    pub fn scaled(self, factor: f64) -> Self {
        self.mapped(factor * self.value, factor)
    }

    /// A function of the estimate: its value there, and its derivative.
    pub fn mapped(self, value: f64, derivative: f64) -> Self {
        Self { value, error: self.error.map(|e| e * derivative.abs()) }
    }
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
                "m0_m2": t.m0_m2, "hs_m": t.hs_m, "tp_s": t.tp_s, "tm01_s": t.tm01_s, "tm02_s": t.tm02_s,
                "lambda_p_m": t.lambda_p_m, "lambda_mean_m": t.lambda_mean_m, "steepness": t.steepness,
                "mss": t.mss, "k_max": t.k_max, "mean_from_deg": t.mean_from_deg, "spread_deg": t.spread_deg,
                "benjamin_feir": t.benjamin_feir, "whitecap_fraction": t.whitecap_fraction,
            },
            "resolved": {
                "m0_m2": r.m0_m2, "hs_m": r.hs_m, "tm01_s": r.tm01_s, "tm02_s": r.tm02_s, "mss": r.mss,
                "k_max": t.k_max, "m0_fraction": r.m0_fraction, "r1": r.r1,
                "mean_from_deg": r.mean_from_deg, "spread_deg": r.spread_deg,
            },
            "measured": {
                "hs_m": m.hs_m.value, "hs_se_m": m.hs_m.error,
                "mean_m": m.mean_m.value, "mean_se_m": m.mean_m.error,
                "mss": m.mss.value, "mss_se": m.mss.error,
                "tm01_s": m.tm01_s.value, "tm01_se_s": m.tm01_s.error,
                "tm02_s": m.tm02_s.value, "tm02_se_s": m.tm02_s.error,
                "from_deg": m.from_deg.map(|e| e.value), "from_se_deg": m.from_deg.map(|e| e.error),
                "r1": m.r1.value, "r1_se": m.r1.error,
                "spread_deg": m.spread_deg.value, "spread_se_deg": m.spread_deg.error,
                "skewness": m.skewness.value, "skewness_se": m.skewness.error,
                "kurtosis": m.kurtosis.value, "kurtosis_se": m.kurtosis.error,
                "whitecap_fraction": m.whitecap_fraction,
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
        let value = |x: f64, digits: usize| format!("{x:.digits$}");
        let with_error = |e: &Estimate, digits: usize| match e.error {
            Some(error) => format!("{:.digits$} ± {error:.digits$}", e.value),
            None => value(e.value, digits),
        };
        let degrees = |d: Option<f64>| d.map_or("none".to_owned(), |d| value(d, 1));
        let from = m.from_deg.map_or("none".to_owned(), |e| with_error(&e, 1));
        let none = String::new;
        let mss = format!("mss to {:.1} rad/m", t.k_max);
        let rows: &[(&str, String, String, String)] = &[
            ("", "theory".into(), "resolved".into(), "measured".into()),
            ("Hs, m", value(t.hs_m, 4), value(r.hs_m, 4), with_error(&m.hs_m, 4)),
            ("Tp, s", value(t.tp_s, 2), none(), none()),
            ("Tm01, s", value(t.tm01_s, 3), value(r.tm01_s, 3), with_error(&m.tm01_s, 3)),
            ("Tm02, s", value(t.tm02_s, 3), value(r.tm02_s, 3), with_error(&m.tm02_s, 3)),
            ("peak wavelength, m", value(t.lambda_p_m, 1), none(), none()),
            ("mean wavelength, m", value(t.lambda_mean_m, 1), none(), none()),
            ("steepness Hs / lambda_p", value(t.steepness, 4), none(), none()),
            (&mss, value(t.mss, 5), value(r.mss, 5), with_error(&m.mss, 5)),
            ("from, degrees", degrees(t.mean_from_deg), degrees(r.mean_from_deg), from),
            ("directional spread, deg", value(t.spread_deg, 1), value(r.spread_deg, 1), with_error(&m.spread_deg, 1)),
            ("Benjamin-Feir index", value(t.benjamin_feir, 3), none(), none()),
            ("share of m0", none(), value(r.m0_fraction, 4), none()),
            ("mean, m", none(), none(), with_error(&m.mean_m, 4)),
            ("skewness", none(), none(), with_error(&m.skewness, 4)),
            ("kurtosis", none(), none(), with_error(&m.kurtosis, 4)),
            ("whitecap fraction", value(t.whitecap_fraction, 4), none(), value(m.whitecap_fraction, 4)),
            ("seeds", none(), none(), m.seeds.to_string()),
        ];
        for (what, theory, resolved, measured) in rows {
            writeln!(f, "{what:<26} {theory:>12} {resolved:>12} {measured:>22}")?;
        }
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
