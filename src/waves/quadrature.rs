//! Numerical integration by the 15-point Gauss-Kronrod rule, adaptive or with a fixed number of panels.

/// Pairs (node x >= 0, weight) of the 15-point Kronrod quadrature rule on [-1, 1]; the other seven nodes are -x.
const KRONROD_NODES_WEIGHTS: [(f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_18),
    (0.741_531_185_599_394_4, 0.140_653_259_715_525_92),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_41),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_89),
    (0.0, 0.209_482_141_084_727_83),
];
/// Weights of the 7-point Gauss rule embedded in the Kronrod rule. Its nodes are the entries 1, 3, 5 and 7 (counted
/// from 0) of [`KRONROD_NODES_WEIGHTS`].
const GAUSS_WEIGHTS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_7, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];
/// Depth limit of adaptive quadrature: how many times in succession an interval is bisected at most.
const MAX_BISECTION_DEPTH: u32 = 40;
/// Number of evaluated intervals after which adaptive quadrature of one integral bisects no further.
const MAX_INTERVALS: u32 = 20_000;

/// Difference of the Gauss from the Kronrod rule, relative to the integral, up to which a panel counts as exact. The
/// Kronrod rule's own error is then near (200 x 1e-11)^1.5 = 1e-13 (Piessens et al. 1983, QUADPACK).
const EXACT_PANEL_DIFFERENCE: f64 = 1e-11;

/// Rounding error of an adaptive integral, relative to the integral's magnitude.
const ROUNDING: f64 = 1e-15;

/// Returns the integral of `f` over [a, b] by the Kronrod rule, and its difference from the Gauss rule as error
/// estimate.
fn gauss_kronrod(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> (f64, f64) {
    let (mid, half) = (0.5 * (a + b), 0.5 * (b - a));
    let (mut k, mut g) = (0.0, 0.0);
    for (i, &(x, w)) in KRONROD_NODES_WEIGHTS.iter().enumerate() {
        let pair = if x == 0.0 { f(mid) } else { f(mid - half * x) + f(mid + half * x) };
        k += w * pair;
        if i % 2 == 1 {
            g += GAUSS_WEIGHTS[i / 2] * pair;
        }
    }
    (k * half, (k - g).abs() * half)
}

/// Integral of `f` from the first to the last of `knots` by adaptive quadrature. The allowed error is `tolerance` times
/// the sum of the magnitudes of the integrals between neighbouring knots.
///
/// `knots` holds at least two points in ascending order, among them all points where `f` is not smooth.
pub fn integrate_adaptive(f: impl Fn(f64) -> f64, knots: &[f64], tolerance: f64) -> f64 {
    integrate_between_knots(&f, knots, (tolerance, ROUNDING), MAX_BISECTION_DEPTH)
}

/// Integral of a smooth `f` from the first to the last of `knots` (ascending) by the 15-point Kronrod rule. Each interval
/// between neighbouring knots is bisected where the rule is not exact to rounding, down to panels of its `count`-th part.
pub fn integrate_panels(f: impl Fn(f64) -> f64, knots: &[f64], count: u32) -> f64 {
    let depth = count.next_power_of_two().ilog2();
    integrate_between_knots(&f, knots, (EXACT_PANEL_DIFFERENCE, EXACT_PANEL_DIFFERENCE), depth)
}

/// Integral of `f` from the first to the last of `knots`, with at most `depth` bisections in succession. The two
/// tolerances are relative to the sum of the magnitudes of the integrals between neighbouring knots: the error that is
/// allowed between two knots, shared by the halves of an interval, and the error below which no interval is bisected.
fn integrate_between_knots(f: &impl Fn(f64) -> f64, knots: &[f64], (tolerance, floor): (f64, f64), depth: u32) -> f64 {
    let rough: Vec<_> = knots.windows(2).map(|w| gauss_kronrod(f, w[0], w[1])).collect();
    let magnitude = rough.iter().map(|(value, _)| value.abs()).sum::<f64>().max(f64::MIN_POSITIVE);
    let mut left = MAX_INTERVALS;
    let piece = |(w, &estimate): (&[f64], &(f64, f64))| {
        refine(f, [w[0], w[1]], estimate, (tolerance * magnitude, floor * magnitude), depth, &mut left)
    };
    knots.windows(2).zip(&rough).map(piece).sum()
}

/// Integral of `f` over [a, b] by recursive bisection, from the integral and error that [`gauss_kronrod`] estimates. An
/// interval is accepted if its error is at most `allowed` (halved in each half) or `floor`, after `depth` bisections, or
/// when `left`, the number of intervals that may still be evaluated, has been counted down to 0.
fn refine(
    f: &impl Fn(f64) -> f64,
    [a, b]: [f64; 2],
    (value, error): (f64, f64),
    (allowed, floor): (f64, f64),
    depth: u32,
    left: &mut u32,
) -> f64 {
    if error <= allowed.max(floor) || depth == 0 || *left == 0 {
        return value;
    }
    let mid = 0.5 * (a + b);
    let half = |ends: [f64; 2], left: &mut u32| {
        *left = left.saturating_sub(1);
        refine(f, ends, gauss_kronrod(f, ends[0], ends[1]), (0.5 * allowed, floor), depth - 1, left)
    };
    half([a, mid], left) + half([mid, b], left)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_integrals() {
        assert!((integrate_adaptive(f64::exp, &[0.0, 1.0], 1e-12) - (1f64.exp() - 1.0)).abs() < 1e-12);
        // An integrand that never converges ends at the limits.
        assert!(integrate_adaptive(|x| (1e9 * x).sin().signum(), &[0.0, 1.0], 1e-12).abs() < 1.0);
        assert!((integrate_adaptive(|x| (x - 0.3).abs(), &[0.0, 1.0], 1e-10) - 0.29).abs() < 1e-9);
        assert!((integrate_panels(f64::cos, &[0.0, 1.0], 2) - 1f64.sin()).abs() < 1e-14);
    }
}
