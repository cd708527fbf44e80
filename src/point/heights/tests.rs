//! Tests of the heights on the CPU: vectorised sines, selection of the strongest waves, and Newton step.

use super::search::dot;
use super::waves::sin_cos_turns;
use super::*;
use crate::state::query;
use glam::DVec4;
use std::f64::consts::TAU;

fn plan(state: &str) -> Plan {
    Plan::new(&query::parse(state).0)
}

#[test]
fn sines_are_those_of_the_library() {
    let sin_cos = |turns: f64| {
        let (sin, cos) = sin_cos_turns(DVec4::splat(turns));
        (sin.x, cos.x)
    };
    let mut worst = 0.0f64;
    for i in -40_000..40_000 {
        let turns = f64::from(i) * 0.000_137;
        let (sin, cos) = sin_cos(turns);
        let want = (TAU * (turns - turns.round())).sin_cos();
        worst = worst.max((sin - want.0).abs()).max((cos - want.1).abs());
    }
    assert!(worst < 2e-15, "{worst}");
    for (turns, want) in [(0.0, (0.0, 1.0)), (0.25, (1.0, 0.0)), (-0.5, (0.0, -1.0)), (1e9 + 0.75, (-1.0, 0.0))] {
        let (sin, cos) = sin_cos(turns);
        assert!((sin - want.0).abs() < 1e-15 && (cos - want.1).abs() < 1e-15, "{turns}: {sin} {cos}");
    }
}

#[test]
fn the_strongest_come_first() {
    let plan = plan("wind=12&n=64");
    let all = StrongestWaves::new(&plan, usize::MAX);
    let total = all.kept_m2;
    assert_eq!((all.residual_rms_m(), all.residual_slope_rms(), all.variance_fraction()), (0.0, 0.0, 1.0));
    let mut waves = candidate_waves(&plan);
    waves.sort_by(|a, b| b.variance().total_cmp(&a.variance()));
    for modes in [1, 7, 200, 3000] {
        let some = StrongestWaves::new(&plan, modes);
        assert_eq!(some.wave_count(), modes);
        let kept: f64 = waves[..modes].iter().map(CandidateWave::variance).sum();
        assert!((some.kept_m2 / kept - 1.0).abs() < 1e-12);
        assert!(((some.kept_m2 + some.left_out_m2) / total - 1.0).abs() < 1e-12);
        let lanes = some
            .patches
            .iter()
            .flat_map(|p| &p.waves_by_four)
            .flat_map(|b| (b.amplitude_re_m * b.amplitude_re_m + b.amplitude_im_m * b.amplitude_im_m).to_array());
        let weakest = lanes.filter(|&s| s > 0.0).fold(f64::INFINITY, f64::min);
        assert!((0.5 * weakest / waves[modes - 1].variance() - 1.0).abs() < 1e-12);
    }
    assert_eq!(all.wave_count(), waves.len());
}

#[test]
fn as_many_as_an_error_wants() {
    let plan = plan("wind=12&n=64");
    for rms_m in [0.5, 0.1, 0.02] {
        let enough = StrongestWaves::for_height_error(&plan, rms_m);
        let fewer = StrongestWaves::new(&plan, enough.wave_count() - 1);
        assert!(enough.residual_rms_m() <= rms_m && fewer.residual_rms_m() > rms_m);
        let same = StrongestWaves::new(&plan, enough.wave_count());
        let waves = |sea: &StrongestWaves| -> Vec<_> { sea.patches.iter().map(|p| p.waves_by_four.clone()).collect() };
        assert_eq!(waves(&enough), waves(&same));
        assert!((same.residual_rms_m() / enough.residual_rms_m() - 1.0).abs() < 1e-12);
    }
    let all = StrongestWaves::new(&plan, usize::MAX).wave_count();
    for rms_m in [0.0, -1.0, f64::NAN] {
        assert_eq!(StrongestWaves::for_height_error(&plan, rms_m).wave_count(), all);
    }
    assert_eq!(StrongestWaves::for_height_error(&plan, f64::INFINITY).wave_count(), 0);
}

#[test]
fn a_step_is_newtons_where_the_water_is_upright() {
    let sea = StrongestWaves::new(&plan("wind=12&n=64&chopx=1.5&chopz=0.5"), 50);
    let (g, strain) = ([0.01, -0.02], [-0.3, 0.1, 0.2]);
    let p = sea.newton_step(g, strain);
    let [rx, rz] = sea.sqrt_chop;
    let h = [1.0 + rx * rx * strain[0], 1.0 + rz * rz * strain[1], rx * rz * strain[2]];
    assert!((h[0] * p[0] + h[2] * p[1] + g[0]).abs() < 1e-15);
    assert!((h[2] * p[0] + h[1] * p[1] + g[1]).abs() < 1e-15);
    // Inside a fold the step still decreases the potential.
    for strain in [[-1.7, 0.3, 0.0], [-2.0, -3.0, 0.5], [-2.0 / 3.0, 0.0, 0.0], [0.0, 0.0, 4.0]] {
        assert!(dot(sea.newton_step(g, strain), g) < 0.0);
    }
}
