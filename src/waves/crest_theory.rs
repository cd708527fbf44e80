//! Distributions of crests, troughs and heights of the waves in a sea of constant statistics, and the lengths of its
//! wave groups, from its spectrum (docs/sea.md, "Crests, heights and groups").

use super::crests::WaveRecordStatistics;
use super::plan::Plan;
use super::statistics::SpectrumStatistics;
use crate::state::params::DispersionKind;
use std::f64::consts::TAU;

/// Number of waves of equal variance that represent the spectrum in integrals over frequency.
const SPECTRUM_BINS: usize = 400;
/// Number of time lags in a peak period at which the autocorrelation is computed.
const LAGS_PER_PEAK_PERIOD: usize = 200;
/// Largest Ursell number in Forristall's fits, which were made for smaller ones.
const MAX_URSELL: f64 = 1.0;
/// Smallest exponent beta of Forristall's distribution; only seas too steep for second-order theory reach it.
const MIN_BETA: f64 = 1.0;
/// Square of the ratio of the significant wave height to the rms wave height sqrt(8 m0).
const SQUARED_HS_OVER_RMS_HEIGHT: f64 = 2.0;

/// Probability exp(-(x / scale)^exponent) that a crest, a trough or a wave height exceeds x.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weibull {
    /// Scale, m.
    pub scale_m: f64,
    /// Exponent; 2 is Rayleigh's distribution.
    pub exponent: f64,
}

impl Weibull {
    fn rayleigh(scale_m: f64) -> Self {
        Self { scale_m, exponent: 2.0 }
    }

    /// Probability that `x_m` (m) is exceeded; 0 in calm water.
    pub fn exceedance(&self, x_m: f64) -> f64 {
        if self.scale_m > 0.0 { (-(x_m.max(0.0) / self.scale_m).powf(self.exponent)).exp() } else { 0.0 }
    }

    /// Value, m, that is exceeded with the probability `p` (above 0, at most 1); 0 in calm water.
    pub fn value_m(&self, p: f64) -> f64 {
        if self.scale_m > 0.0 { self.scale_m * (-p.ln()).powf(1.0 / self.exponent) } else { 0.0 }
    }
}

/// Forristall's (2000) parameters alpha and beta, P(crest > c) = exp(-(c / (alpha Hs))^beta), from the `steepness` S1
/// and the Ursell number `ursell`: of long-crested waves (2D), then of waves with a directional spread (3D). They are
/// fits to simulations by second-order theory.
pub fn forristall_alpha_beta(steepness: f64, ursell: f64) -> [[f64; 2]; 2] {
    let (s, u) = (steepness, ursell.min(MAX_URSELL));
    // The alpha of linear waves, 1 / sqrt(8), with the digits of the paper.
    let linear = 0.3536;
    let long_crested = [linear + 0.2892 * s + 0.1060 * u, 2.0 - 2.1597 * s + 0.0968 * u * u];
    let spread = [linear + 0.2568 * s + 0.0800 * u, 2.0 - 1.7912 * s - 0.5302 * u + 0.284 * u * u];
    [long_crested, spread].map(|[alpha, beta]| [alpha, beta.max(MIN_BETA)])
}

/// Parameters of a sea from which theory predicts the distributions of its crests and heights, and its wave groups.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CrestTheory {
    /// Significant wave height, m.
    pub hs_m: f64,
    /// Mean steepness S1 = 2 pi Hs / (g T1^2), with the mean period T1 = 2 pi m0 / m1.
    pub steepness: f64,
    /// Ursell number Hs / (k1^2 d^3), with the wave number k1 of the period T1 and the depth d; 0 in deep water.
    pub ursell: f64,
    /// Crests and troughs of linear waves with a narrow spectrum: Rayleigh's distribution (Longuet-Higgins 1952).
    pub rayleigh_crests: Weibull,
    /// Crests of second order in long-crested waves (Forristall 2000, 2D).
    pub forristall_2d_crests: Weibull,
    /// Crests of second order in waves with a directional spread (Forristall 2000, 3D).
    pub forristall_3d_crests: Weibull,
    /// Wave heights of linear waves with a narrow spectrum: Rayleigh's distribution.
    pub rayleigh_heights: Weibull,
    /// Boccotti's narrow-bandedness parameter psi*: minus the first minimum of the surface's autocorrelation.
    pub narrowness: f64,
    /// High waves of a finite bandwidth (Boccotti 1989): P = exp(-H^2 / (4 m0 (1 + psi*))).
    pub boccotti_heights: Weibull,
    /// Wave heights of a finite bandwidth (Naess 1985): P = exp(-H^2 / (4 m0 (1 - r))), with the autocorrelation r at
    /// half of the mean period T1.
    pub naess_heights: Weibull,
    /// Groups of waves higher than the significant wave height (Kimura 1980).
    pub groups: GroupTheory,
}

/// Mean lengths of runs of waves higher than the significant wave height, by Kimura's (1980) theory: the heights of
/// successive waves are a Markov chain with a joint Rayleigh distribution.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GroupTheory {
    /// Correlation kappa of the complex envelope over one mean zero-crossing period Tm02, 0 to 1 (Battjes and van
    /// Vledder 1984): 1 for a narrow spectrum.
    pub envelope_correlation: f64,
    /// Mean number of waves in a run of waves higher than Hs.
    pub mean_run_length: f64,
    /// Mean number of waves from the begin of a run to that of the next.
    pub mean_repeat_length: f64,
}

impl GroupTheory {
    /// Lengths of groups for the correlation `kappa` (0 to 1) of the complex envelope from one wave to the next.
    fn new(kappa: f64) -> Self {
        let limit = SQUARED_HS_OVER_RMS_HEIGHT;
        let one_is_high = (-limit).exp();
        let next_is_high = probability_of_two_high_waves(kappa, limit) / one_is_high;
        let mean_run_length = 1.0 / (1.0 - next_is_high).max(1e-9);
        Self { envelope_correlation: kappa, mean_run_length, mean_repeat_length: mean_run_length / one_is_high }
    }
}

/// Probability that two successive waves both exceed the height whose square, divided by the mean square, is `limit`.
/// Squares of heights are a pair of exponential variables whose correlation is kappa^2. They are distributed as two
/// independent gamma variables of the shape j + 1 and the scale 1 - kappa^2, whose j has a geometric distribution.
fn probability_of_two_high_waves(kappa: f64, limit: f64) -> f64 {
    let squared = kappa.clamp(0.0, 0.999).powi(2);
    let y = limit / (1.0 - squared);
    // Weight of j; term and sum of the series e^-y (1 + y + ... + y^j / j!), the probability of exceedance of a gamma
    // variable.
    let (mut weight, mut term, mut gamma, mut sum) = (1.0 - squared, (-y).exp(), 0.0, 0.0);
    for j in 1..20_000 {
        gamma += term;
        sum += weight * gamma * gamma;
        weight *= squared;
        term *= y / f64::from(j);
        if weight < 1e-15 {
            break;
        }
    }
    sum
}

impl CrestTheory {
    /// Expectations for the sea of `plan` with its statistics by `theory`.
    pub fn new(plan: &Plan, theory: &SpectrumStatistics) -> Self {
        if plan.is_calm() || theory.tm01_s <= 0.0 || theory.tm02_s <= 0.0 {
            return Self::default();
        }
        let waves: Vec<[f64; 2]> = (plan.spectrum_integrals)
            .bins_of_equal_variance(0.0, f64::INFINITY, SPECTRUM_BINS)
            .into_iter()
            .map(|(k, variance_m2)| [plan.dispersion.omega(k), variance_m2 / theory.variance_m2])
            .collect();
        let (hs_m, depth_m) = (theory.hs_m, plan.sea.depth_m);
        let mean_k = plan.dispersion.wave_number(TAU / theory.tm01_s);
        let is_deep = plan.sea.dispersion == DispersionKind::Deep;
        let steepness = TAU * hs_m / (plan.sea.gravity_m_s2 * theory.tm01_s.powi(2));
        let ursell = if is_deep { 0.0 } else { hs_m / (mean_k * mean_k * depth_m.powi(3)) };
        let [forristall_2d_crests, forristall_3d_crests] = forristall_alpha_beta(steepness, ursell)
            .map(|[alpha, beta]| Weibull { scale_m: alpha * hs_m, exponent: beta });
        let lag_s = theory.tp_s / LAGS_PER_PEAK_PERIOD as f64;
        let narrowness = -(1..=LAGS_PER_PEAK_PERIOD)
            .map(|i| envelope(&waves, lag_s * i as f64)[0])
            .fold(f64::INFINITY, f64::min)
            .clamp(-1.0, 0.0);
        let [at_half_period, _] = envelope(&waves, 0.5 * theory.tm01_s);
        let [re, im] = envelope(&waves, theory.tm02_s);
        // Scale sqrt(4 m0 (1 + x)) of a height, with Hs^2 = 16 m0.
        let height = |x: f64| Weibull::rayleigh(0.5 * hs_m * (1.0 + x).sqrt());
        Self {
            hs_m,
            steepness,
            ursell,
            rayleigh_crests: Weibull::rayleigh(hs_m / 8f64.sqrt()),
            forristall_2d_crests,
            forristall_3d_crests,
            rayleigh_heights: height(1.0),
            narrowness,
            boccotti_heights: height(narrowness),
            naess_heights: height((-at_half_period).max(-0.99)),
            groups: GroupTheory::new(re.hypot(im)),
        }
    }

    /// Distributions of crests by Rayleigh and by Forristall (2D, 3D), and of heights by Rayleigh, Boccotti and Naess.
    pub fn laws(&self) -> [Weibull; 6] {
        [
            self.rayleigh_crests,
            self.forristall_2d_crests,
            self.forristall_3d_crests,
            self.rayleigh_heights,
            self.boccotti_heights,
            self.naess_heights,
        ]
    }
}

/// Headings of the columns of [`exceedance_table`], separated by commas.
pub const EXCEEDANCE_COLUMNS: &str = "probability,crest (m),trough (m),height (m),Rayleigh crest (m),\
    Forristall 2D crest (m),Forristall 3D crest (m),Rayleigh height (m),Boccotti height (m),Naess height (m)";

/// Table of exceedance: for each probability the crest, trough and height that waves of a record exceed, and the crests
/// and heights that `theory` expects (m; columns of [`EXCEEDANCE_COLUMNS`]). There is a row for each of the largest
/// hundred waves, and fewer of the others.
pub fn exceedance_table(record: &WaveRecordStatistics, theory: &CrestTheory) -> Vec<[f64; 10]> {
    let (crests, troughs, heights) = (record.crests.points(), record.troughs.points(), record.heights.points());
    (crests.iter().zip(&troughs).zip(&heights))
        .map(|((&[crest, p], &[trough, _]), &[height, _])| {
            let [rayleigh, long_crested, spread, rayleigh_height, boccotti, naess] =
                theory.laws().map(|l| l.value_m(p));
            [p, crest, trough, height, rayleigh, long_crested, spread, rayleigh_height, boccotti, naess]
        })
        .collect()
}

/// Complex autocorrelation (real, imaginary) at the time `lag_s` (s) of `waves`, given by angular frequency (rad/s) and
/// fraction of the variance. The real part is the autocorrelation of the surface.
fn envelope(waves: &[[f64; 2]], lag_s: f64) -> [f64; 2] {
    waves.iter().fold([0.0; 2], |[re, im], [omega, fraction]| {
        let (sin, cos) = (omega * lag_s).sin_cos();
        [re + fraction * cos, im + fraction * sin]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;
    use crate::waves::noise::{complex_gaussian, pcg4d};

    fn theory(state: &str) -> CrestTheory {
        let plan = Plan::new(&query::parse(state).0);
        CrestTheory::new(&plan, &SpectrumStatistics::new(&plan))
    }

    #[test]
    fn waves_without_steepness_are_rayleighs() {
        for [alpha, beta] in forristall_alpha_beta(0.0, 0.0) {
            assert!((alpha - 0.125f64.sqrt()).abs() < 1e-4 && beta == 2.0);
        }
        let flat = theory("hs=0.1&tp=16");
        for p in [0.1, 0.01, 1e-3, 1e-4] {
            for law in [flat.forristall_2d_crests, flat.forristall_3d_crests] {
                let ratio = law.value_m(p) / flat.rayleigh_crests.value_m(p);
                assert!((ratio - 1.0).abs() < 2e-3, "{p} {ratio}");
            }
        }
        // The crest of one wave in a thousand is 0.93 Hs, its height 1.86 Hs.
        assert!((flat.rayleigh_crests.value_m(1e-3) / flat.hs_m - 0.9292).abs() < 1e-3);
        assert!((flat.rayleigh_heights.value_m(1e-3) / flat.hs_m - 1.8585).abs() < 1e-3);
    }

    #[test]
    fn steep_and_shallow_waves_have_higher_crests() {
        // A worked example, by hand: Hs 12 m, T1 11 s, deep water. S1 = 2 pi 12 / (9.81 x 121) = 0.06352.
        let [[alpha_2d, beta_2d], [alpha_3d, beta_3d]] = forristall_alpha_beta(0.06352, 0.0);
        assert!((alpha_2d - 0.37197).abs() < 1e-5 && (beta_2d - 1.86282).abs() < 1e-5);
        assert!((alpha_3d - 0.36991).abs() < 1e-5 && (beta_3d - 1.88622).abs() < 1e-5);
        let deep = theory("hs=4&tp=8");
        let shallow = theory("hs=3&tp=12&depth=12&dispersion=finite");
        assert!(deep.ursell < 1e-6);
        assert!(shallow.ursell > 0.05 && shallow.ursell < 0.5, "{shallow:?}");
        for sea in [deep, shallow] {
            let crest = |law: Weibull| law.value_m(1e-3) / sea.hs_m;
            let rayleigh = crest(sea.rayleigh_crests);
            let [long, spread] = [crest(sea.forristall_2d_crests), crest(sea.forristall_3d_crests)];
            assert!(spread > 1.04 * rayleigh && long > rayleigh && long < 1.4 * rayleigh, "{sea:?}");
        }
    }

    #[test]
    fn a_narrow_spectrum_has_rayleighs_heights() {
        // Boccotti (2000): psi* is 0.73 for the mean JONSWAP spectrum and 0.65 for that of Pierson and Moskowitz.
        let (jonswap, pm) = (theory("spectrum=jonswap&gamma=3.3&wind=14&fetch=300"), theory("spectrum=pm&wind=14"));
        assert!((jonswap.narrowness - 0.73).abs() < 0.02, "{jonswap:?}");
        assert!((pm.narrowness - 0.65).abs() < 0.02, "{pm:?}");
        for sea in [jonswap, pm] {
            let height = |law: Weibull| law.value_m(1e-3) / sea.hs_m;
            let rayleigh = height(sea.rayleigh_heights);
            assert!(height(sea.boccotti_heights) < rayleigh && height(sea.boccotti_heights) > 0.85 * rayleigh);
            assert!((height(sea.naess_heights) / height(sea.boccotti_heights) - 1.0).abs() < 0.06, "{sea:?}");
        }
    }

    #[test]
    fn runs_are_longer_in_narrow_spectra() {
        // Independent waves: P = e^-2 = 0.135, runs of 1 / (1 - P) waves (Goda 1970: 1.16), repeated every 8.54.
        let independent = GroupTheory::new(0.0);
        assert!((independent.mean_run_length - 1.1565).abs() < 1e-3, "{independent:?}");
        assert!((independent.mean_repeat_length - 8.545).abs() < 1e-2, "{independent:?}");
        let runs: Vec<f64> =
            [0.0, 0.3, 0.5, 0.7, 0.9, 0.98].iter().map(|k| GroupTheory::new(*k).mean_run_length).collect();
        assert!(runs.is_sorted() && runs[5] > 4.0 && runs[5].is_finite(), "{runs:?}");
        // A second way: the joint probability by sampling at kappa = 0.7.
        let sample = |i: u32| {
            let words = pcg4d([i, 1, 2, 3]);
            let ([a, b], [c, d]) = (complex_gaussian([words[0], words[1]]), complex_gaussian([words[2], words[3]]));
            let turned = |a: f64, c: f64| 0.7 * a + 0.51f64.sqrt() * c;
            (a * a + b * b, turned(a, c).powi(2) + turned(b, d).powi(2))
        };
        let all: Vec<(f64, f64)> = (0..200_000).map(sample).collect();
        let mean = all.iter().map(|s| s.0).sum::<f64>() / all.len() as f64;
        let both = all.iter().filter(|s| s.0 > 2.0 * mean && s.1 > 2.0 * mean).count() as f64 / all.len() as f64;
        let exact = probability_of_two_high_waves(0.7, 2.0);
        assert!((both / exact - 1.0).abs() < 0.03, "{both} {exact}");
        let jonswap = theory("spectrum=jonswap&gamma=3.3&wind=14&fetch=300").groups;
        assert!(jonswap.mean_run_length > 1.2 && jonswap.mean_run_length < 1.8, "{jonswap:?}");
    }

    #[test]
    fn calm_water_has_no_crests() {
        let calm = theory("wind=0");
        assert_eq!(calm, CrestTheory::default());
        assert_eq!((calm.rayleigh_crests.value_m(0.01), calm.rayleigh_crests.exceedance(1.0)), (0.0, 0.0));
    }
}
