//! The bound waves of the second order against theory: exact kernels in their limits, the double sum over all pairs of
//! waves, and the statistics of the surface that the GPU simulates.

mod common;

use common::{gpu, params, travelling_east};
use seastate::gpu::Gpu;
use seastate::lab::ensemble::visit_surface_points;
use seastate::oracle::surface::bound_height_m;
use seastate::shaders::Shaders;
use seastate::sim::Simulation;
use seastate::state::Params;
use seastate::waves::dispersion::Dispersion;
use seastate::waves::second_order::{InteractionKernels, expected_skewness};
use seastate::waves::statistics::mean_sd_skewness_kurtosis;
use seastate::waves::{Plan, noise};
use std::f64::consts::TAU;

const GRAVITY_M_S2: f64 = 9.81;

#[test]
fn kernels_have_the_published_limits() {
    // Deep water, one direction (Longuet-Higgins 1963): -|k1 - k2| and k1 + k2.
    let deep = Dispersion::finite_depth(GRAVITY_M_S2, f64::INFINITY);
    for (k1, k2) in [(0.1, 0.2), (0.05, 1.0), (0.3, 0.29)] {
        let kernels = InteractionKernels::new(&deep, [k1, k2], 1.0);
        assert!((kernels.difference + f64::abs(k1 - k2)).abs() < 1e-9, "{kernels:?}");
        assert!((kernels.sum - (k1 + k2)).abs() < 1e-9, "{kernels:?}");
    }
    for depth_m in [5.0, 10.0, 20.0, 60.0] {
        let water = Dispersion::finite_depth(GRAVITY_M_S2, depth_m);
        for k in [0.05, 0.1, 0.2] {
            let kernels = InteractionKernels::new(&water, [k, k], 1.0);
            // The second harmonic of a Stokes wave is a^2 k cosh kh (2 + cosh 2kh) / (4 sinh^3 kh).
            let kh = k * depth_m;
            let stokes = k * kh.cosh() * (2.0 + (2.0 * kh).cosh()) / kh.sinh().powi(3);
            assert!((kernels.sum / stokes - 1.0).abs() < 2e-3, "{depth_m} {k}: {kernels:?} {stokes}");
            // The set-down under long groups is the radiation stress over g h - cg^2 (Longuet-Higgins and Stewart 1962).
            let cg = water.group_velocity(k);
            let n = cg * k / water.omega(k);
            let set_down = -2.0 * GRAVITY_M_S2 * (2.0 * n - 0.5) / (GRAVITY_M_S2 * depth_m - cg * cg);
            assert!((kernels.difference / set_down - 1.0).abs() < 2e-3, "{depth_m} {k}: {kernels:?} {set_down}");
        }
    }
}

#[test]
fn the_double_sum_is_that_of_one_line() {
    for (state, published) in [("", 0.171), ("hs=4&tp=8", 0.196), ("hs=3&tp=16", 0.037)] {
        let plan = Plan::new(&travelling_east(state, 0.0));
        let bins = plan.spectrum_integrals.bins_of_equal_variance(0.0, f64::INFINITY, 200);
        let m0: f64 = bins.iter().map(|b| b.1).sum();
        let pairs = bins.iter().flat_map(|a| bins.iter().map(move |b| a.1 * b.1 * a.0.min(b.0)));
        let one_line = 3.0 * pairs.sum::<f64>() / m0.powf(1.5);
        let double_sum = expected_skewness(&plan, 100);
        eprintln!("{state}: {one_line:.4}, {double_sum:.4}");
        assert!((double_sum / one_line - 1.0).abs() < 0.01, "{state}: {double_sum} {one_line}");
        assert!((one_line / published - 1.0).abs() < 0.05, "{state}: {one_line} {published}");
    }
}

/// Mean, standard deviation (both divided by that of the linear waves), skewness and kurtosis of the surface over
/// `seeds` seeds, for each seed: at first and at second order, from the same maps.
fn surface_statistics(gpu: &Gpu, params: &Params, seeds: u32) -> [Vec<[f64; 4]>; 2] {
    let mut sim: Option<Simulation> = None;
    let mut out = [Vec::new(), Vec::new()];
    for seed in 0..seeds {
        let mut params = params.clone();
        params.sea.seed = 1 + seed;
        let mut plan = Plan::new(&params);
        let sim = sim.get_or_insert_with(|| Simulation::new(gpu, plan.clone(), &Shaders::default()));
        sim.set_plan(gpu, plan.clone(), &Shaders::default());
        let maps = common::read(gpu, sim, 0.0);
        for (order, out) in (1..).zip(&mut out) {
            plan.sea.wave_order = order;
            let mut sums = [0.0; 5];
            visit_surface_points(&plan, &maps, &mut |eta, weight| {
                let u = eta / (0.25 * plan.hs_m());
                sums.iter_mut().zip(0..).for_each(|(sum, power)| *sum += weight * u.powi(power));
            });
            out.push(mean_sd_skewness_kurtosis(sums));
        }
    }
    out
}

/// Mean over the seeds, and its standard error.
fn mean_and_error(all: &[[f64; 4]], what: usize) -> [f64; 2] {
    let n = all.len() as f64;
    let mean = all.iter().map(|s| s[what]).sum::<f64>() / n;
    let variance = all.iter().map(|s| (s[what] - mean).powi(2)).sum::<f64>() / (n - 1.0);
    [mean, (variance / n).sqrt()]
}

/// Spread of long-crested waves that the lattice of wave vectors resolves, degrees. It lowers the skewness by 4 %.
const LATTICE_SPREAD_DEG: f64 = 12.0;

#[test]
fn skewness_and_level_are_those_of_theory() {
    let gpu = gpu();
    const SEEDS: u32 = 64;
    let seas: Vec<(String, Params, f64)> = [("", 0.010), ("hs=4&tp=8", 0.012), ("hs=3&tp=16", 0.005)]
        .map(|(state, tolerance)| {
            (format!("long-crested {state}"), travelling_east(&format!("n=128&{state}"), LATTICE_SPREAD_DEG), tolerance)
        })
        .into_iter()
        .chain(
            ["", "depth=43", "depth=20", "depth=12", "hs=2&tp=7&scale2=1&hs2=2&tp2=14&dir2=330", "spread=cos2"]
                .map(|state| (state.to_owned(), params(&format!("n=128&{state}")), f64::INFINITY)),
        )
        .collect();
    for (name, params, tolerance) in seas {
        let plan = Plan::new(&params);
        let want = expected_skewness(&plan, 40);
        let [first, second] = surface_statistics(&gpu, &params, SEEDS);
        let [skewness, error] = mean_and_error(&second, 2);
        let [[first_sd, _], [sd, _]] = [&first, &second].map(|all| mean_and_error(all, 1));
        let [[level, level_error], [kurtosis, _]] = [0, 3].map(|what| mean_and_error(&second, what));
        eprintln!(
            "{name}: kp h {:.2}, skewness {skewness:.4} +- {error:.4} for {want:.4} (linear {:.4}), level {level:.4} +- \
             {level_error:.4}, sd {sd:.4} for {first_sd:.4}, kurtosis {kurtosis:.3} (linear {:.3})",
            plan.dispersion.wave_number(plan.omega_p) * plan.sea.depth_m,
            mean_and_error(&first, 2)[0],
            mean_and_error(&first, 3)[0],
        );
        assert!((skewness - want).abs() < tolerance.min(0.1 * want), "{name}: {skewness} for {want}");
        assert!((sd / first_sd - 1.0).abs() < 0.005, "{name}: {sd} for {first_sd}");
        assert!(level.abs() < 0.002, "{name}: {level} sigma");
    }
}

/// Long-crested waves along a line, with wave numbers that are multiples of one.
struct LineOfWaves<'a> {
    plan: &'a Plan,
    dk: f64,
    /// Complex amplitudes a: the elevation is the sum of Re[a e^{ikx}].
    amplitudes: Vec<[f64; 2]>,
}

/// Number of points along a line, over 30 wavelengths of the peak.
const POINTS: usize = 720;

/// Sums of a surface's values: weights, elevations over sigma and squares of the envelope over sigma squared.
type Values = Vec<[f64; 3]>;

impl<'a> LineOfWaves<'a> {
    fn new(plan: &'a Plan, seed: u32) -> Self {
        let dk = plan.dispersion.wave_number(plan.omega_p) / 30.0;
        let amplitudes = (1..240u32)
            .take_while(|i| plan.cascades.iter().any(|c| c.contains_wave_number(f64::from(*i) * dk)))
            .map(|i| {
                let variance = plan
                    .spectrum_integrals
                    .m0_between_wave_numbers((f64::from(i) - 0.5) * dk, (f64::from(i) + 0.5) * dk);
                let [u, v] = [0, 1].map(|j| (f64::from(noise::pcg4d([i, seed, 7, 1])[j]) + 0.5) / 4_294_967_296.0);
                let (radius, angle) = ((-2.0 * variance * f64::ln(u)).sqrt(), TAU * v);
                [radius * angle.cos(), radius * angle.sin()]
            })
            .collect();
        Self { plan, dk, amplitudes }
    }

    fn waves(&self) -> impl Iterator<Item = (f64, [f64; 2])> + '_ {
        self.amplitudes.iter().zip(1..).map(|(a, i)| (f64::from(i) * self.dk, *a))
    }

    fn places(&self) -> impl Iterator<Item = f64> {
        let step = TAU / self.dk / POINTS as f64;
        (0..POINTS).map(move |i| step * i as f64)
    }

    fn squared_envelope(&self, x: f64) -> f64 {
        let sum = self.waves().fold([0.0; 2], |[re, im], (k, [a, b])| {
            let (sin, cos) = (k * x).sin_cos();
            [re + a * cos - b * sin, im + a * sin + b * cos]
        });
        sum[0] * sum[0] + sum[1] * sum[1]
    }

    /// The elevation by the exact double sum, without its mean.
    fn exact(&self, kernels: &[Vec<InteractionKernels>]) -> Values {
        let count = self.amplitudes.len();
        // Complex amplitudes of the sums and differences of two wave numbers.
        let mut spectrum = vec![[0.0; 2]; 2 * count + 1];
        for (i, [a, b]) in self.amplitudes.iter().enumerate() {
            spectrum[i + 1][0] += a;
            spectrum[i + 1][1] += b;
            for (j, [c, d]) in self.amplitudes.iter().enumerate() {
                let kernels = &kernels[i][j];
                let sum = &mut spectrum[i + j + 2];
                *sum = [sum[0] + 0.25 * kernels.sum * (a * c - b * d), sum[1] + 0.25 * kernels.sum * (a * d + b * c)];
                if i > j {
                    let half = 0.5 * kernels.difference;
                    let apart = &mut spectrum[i - j];
                    *apart = [apart[0] + half * (a * c + b * d), apart[1] + half * (b * c - a * d)];
                }
            }
        }
        self.places()
            .map(|x| {
                let eta = spectrum.iter().zip(0..).fold(0.0, |sum, ([a, b], i)| {
                    let (sin, cos) = (f64::from(i) * self.dk * x).sin_cos();
                    sum + a * cos - b * sin
                });
                [1.0, eta, self.squared_envelope(x)]
            })
            .collect()
    }

    /// The elevation of the displaced surface with its bound waves, each point weighted by its width.
    fn drawn(&self) -> Values {
        let bound = self.plan.bound_waves();
        self.places()
            .map(|x| {
                let mut fields = vec![[0.0; 3]; bound.cascades.len()];
                let (mut strain, mut moved) = (0.0, 0.0);
                for (k, [a, b]) in self.waves() {
                    let cascade = self.plan.cascades.iter().position(|c| c.contains_wave_number(k)).expect("a cascade");
                    let (sin, cos) = (k * x).sin_cos();
                    let width = self.plan.dispersion.orbit_width_over_height(k);
                    let (eta, dx) = (a * cos - b * sin, -width * (a * sin + b * cos));
                    fields[cascade][0] += dx;
                    fields[cascade][1] += eta;
                    strain -= k * width * eta;
                    moved += dx;
                }
                let eta = fields.iter().map(|f| f[1]).sum::<f64>() + bound_height_m(&fields, &bound);
                [1.0 + strain, eta, self.squared_envelope(x + moved)]
            })
            .collect()
    }
}

/// Skewness, excess kurtosis, the elevation over sigma that 0.2 % of a surface exceed, that below which 0.2 % lie, and
/// the mean level under groups: the change of elevation with the square of the envelope, times sigma.
fn shape(values: &Values) -> [f64; 5] {
    let weight: f64 = values.iter().map(|v| v[0]).sum();
    let mean = |f: &dyn Fn(&[f64; 3]) -> f64| values.iter().map(|v| v[0] * f(v)).sum::<f64>() / weight;
    let (level, envelope) = (mean(&|v| v[1]), mean(&|v| v[2]));
    let [second, third, fourth] = [2, 3, 4].map(|power| mean(&|v| (v[1] - level).powi(power)));
    let sigma = second.sqrt();
    let mut sorted = values.clone();
    sorted.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let quantile = |q: f64| {
        let mut sum = 0.0;
        sorted
            .iter()
            .find(|v| {
                sum += v[0];
                sum >= q * weight
            })
            .map_or(0.0, |v| (v[1] - level) / sigma)
    };
    let sinking = mean(&|v| (v[1] - level) * (v[2] - envelope)) / mean(&|v| (v[2] - envelope).powi(2));
    [third / sigma.powi(3), fourth / second.powi(2) - 3.0, quantile(0.998), quantile(0.002), sinking * sigma]
}

/// Moments, crests, troughs and the level under groups agree with the exact second-order surface of the same waves.
#[test]
fn long_crested_waves_have_the_exact_shape() {
    for state in
        ["", "hs=4&tp=8", "hs=3&tp=16", "hs=3&tp=8&depth=43", "hs=2&tp=8&depth=21", "hs=1&tp=8&depth=12", "cascades=1"]
    {
        let params = travelling_east(&format!("n=256&{state}"), 0.0);
        let plan = Plan::new(&params);
        let lines: Vec<LineOfWaves<'_>> = (0..48).map(|seed| LineOfWaves::new(&plan, seed)).collect();
        let wave_numbers: Vec<f64> = lines[0].waves().map(|w| w.0).collect();
        let kernels: Vec<Vec<InteractionKernels>> = (wave_numbers.iter())
            .map(|a| wave_numbers.iter().map(|b| InteractionKernels::new(&plan.dispersion, [*a, *b], 1.0)).collect())
            .collect();
        let exact = shape(&lines.iter().flat_map(|line| line.exact(&kernels)).collect());
        let drawn = shape(&lines.iter().flat_map(LineOfWaves::drawn).collect());
        let kh = plan.dispersion.wave_number(plan.omega_p) * plan.sea.depth_m;
        eprintln!("{state}, kp h {kh:.2}:\n  exact {exact:.4?}\n  drawn {drawn:.4?}");
        let off: Vec<f64> = exact.iter().zip(&drawn).map(|(a, b)| b - a).collect();
        assert!(off[0].abs() < 0.1 * expected_skewness(&plan, 40), "{state}: skewness {exact:?} {drawn:?}");
        assert!(off[1].abs() < 0.03, "{state}: kurtosis {exact:?} {drawn:?}");
        assert!((drawn[2] / exact[2] - 1.0).abs() < 0.03, "{state}: crests {exact:?} {drawn:?}");
        assert!((drawn[3] / exact[3] - 1.0).abs() < 0.03, "{state}: troughs {exact:?} {drawn:?}");
    }
}
