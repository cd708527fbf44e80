//! Tests of densities over frequency and direction: links, limits, and the physics.

use super::super::directional::{HIGHEST_LEVEL, most_directions};
use super::super::{DirectionalTable, MAX_BANDS, MAX_TEXT_BYTES, MIN_BANDS, MIN_DIRECTIONS, MeasuredSpectrum};
use super::{Lcg, check};
use std::f64::consts::TAU;

/// A spectrum of random densities.
fn random_spectrum(random: &mut Lcg, band_count: usize, direction_count: usize) -> MeasuredSpectrum {
    let bands: Vec<(f64, f64)> =
        (1..=band_count).map(|i| (1.2345 * i as f64 / band_count as f64, 1e-5 + 12.0 * random.unit())).collect();
    let densities: Vec<f64> =
        (0..band_count * direction_count).map(|_| if random.below(3) == 0 { 0.0 } else { random.unit() }).collect();
    let table = DirectionalTable::new(720.0 * random.unit() - 360.0, direction_count, &densities).expect("a table");
    MeasuredSpectrum::with_table(&bands, table).expect("a spectrum")
}

#[test]
fn every_size_fits_in_a_link_and_comes_back_unchanged() {
    let mut random = Lcg(23);
    for i in 0..120 {
        let band_count = if i == 0 { MAX_BANDS } else { MIN_BANDS + random.below(MAX_BANDS - MIN_BANDS + 1) };
        let direction_count = if i < 3 { 1440 } else { MIN_DIRECTIONS + random.below(400) };
        let sea = random_spectrum(&mut random, band_count, direction_count);
        let table = sea.directional_table().expect("a table");
        assert!(table.direction_count() <= direction_count.min(most_directions(band_count)));
        assert!(sea.to_state().len() <= MAX_TEXT_BYTES);
        check(&sea);
    }
    let sea = random_spectrum(&mut random, 36, 36);
    assert!(sea.to_state().len() < 3300, "{}", sea.to_state().len());
    assert_eq!(sea.directional_table().map(DirectionalTable::direction_count), Some(36));
}

#[test]
fn levels_keep_the_densities_and_averages_keep_the_energy() {
    let (n, from_deg) = (36, 5.0);
    let density = |deg: f64, mean: f64| (0.5 + 0.5 * (deg - mean).to_radians().cos()).powi(6);
    let grid = |n: usize| -> Vec<f64> {
        let direction = move |i: usize| from_deg + 360.0 * i as f64 / n as f64;
        (0..3).flat_map(|band| (0..n).map(move |i| density(direction(i), 100.0 + 70.0 * f64::from(band)))).collect()
    };
    let table = DirectionalTable::new(from_deg, n, &grid(n)).expect("a table");
    for band in 0..3 {
        let d = table.distribution_of_band(band);
        let row = &grid(n)[band * n..(band + 1) * n];
        let sum: f64 = row.iter().sum::<f64>() * table.step_rad();
        let largest = d.iter().copied().fold(0.0, f64::max);
        for (d, want) in d.iter().zip(row) {
            assert!((d - want / sum).abs() < 1.0 / f64::from(HIGHEST_LEVEL) * largest, "{d} {want}");
        }
    }
    // 1440 directions become fewer, which keep the mean direction and nearly the spread.
    let (fine, moments) =
        (DirectionalTable::new(from_deg, 1440, &grid(1440)).expect("a table"), |t: &DirectionalTable| {
            t.between([(1, 1.0), (2, 0.0)]).first_moment()
        });
    assert_eq!(fine.direction_count(), 360);
    for (a, b) in moments(&fine).into_iter().zip(moments(&table)) {
        assert!((a - b).abs() < 3e-3, "{a} {b}");
    }
}

#[test]
fn the_distribution_is_bilinear_and_complete() {
    let mut random = Lcg(29);
    let sea = random_spectrum(&mut random, 5, 12);
    let table = sea.directional_table().expect("a table");
    let bands = sea.bands();
    let theta = |i: usize| table.first_travel_rad() + i as f64 * table.step_rad();
    let energy = |f: f64, theta: f64| {
        let omega = TAU * f;
        TAU * sea.density(omega) * sea.tabulated_distribution(omega).expect("a distribution").density(theta)
    };
    for b in 0..4 {
        let d = table.distribution_of_band(b);
        for i in 0..12 {
            let at_node = energy(bands[b].0 * (1.0 + 1e-12), theta(i));
            assert!((at_node - bands[b].1 * d[i]).abs() < 1e-6 * (1.0 + at_node), "band {b}, direction {i}");
            let middle = 0.5 * (bands[b].0 + bands[b + 1].0);
            let corners = [(b, i), (b, (i + 1) % 12), (b + 1, i), (b + 1, (i + 1) % 12)];
            let mean: f64 = corners.iter().map(|&(b, i)| 0.25 * bands[b].1 * table.distribution_of_band(b)[i]).sum();
            assert!((energy(middle, theta(i) + 0.5 * table.step_rad()) - mean).abs() < 1e-9 * (1.0 + mean));
        }
        let distribution = sea.tabulated_distribution(TAU * 1.03 * bands[b].0).expect("a distribution");
        let steps = 12_000;
        let mut sums = [0.0; 3];
        for i in 0..steps {
            let angle = TAU * (f64::from(i) + 0.5) / f64::from(steps);
            let d = distribution.density(angle) * TAU / f64::from(steps);
            sums = [sums[0] + d, sums[1] + d * angle.cos(), sums[2] + d * angle.sin()];
        }
        let [x, z] = distribution.first_moment();
        assert!((sums[0] - 1.0).abs() < 1e-6 && (sums[1] - x).abs() < 1e-6 && (sums[2] - z).abs() < 1e-6, "{sums:?}");
        let mean: f64 = (0..12).map(|i| distribution.mean_density(theta(i), table.step_rad()) / 12.0).sum();
        assert!((mean * TAU - 1.0).abs() < 0.02, "{mean}");
    }
}

#[test]
fn waves_come_from_the_bearing_of_the_table() {
    for (bearing, travel) in [(0.0, [0.0, 1.0]), (90.0, [-1.0, 0.0]), (270.0, [1.0, 0.0])] {
        let mut densities = vec![0.0; 3 * 36];
        for band in 0..3 {
            densities[band * 36 + (bearing / 10.0) as usize] = 2.0;
        }
        let table = DirectionalTable::new(0.0, 36, &densities).expect("a table");
        let sea = MeasuredSpectrum::with_table(&[(0.1, 1.0), (0.2, 1.0), (0.3, 1.0)], table).expect("a sea");
        let [x, z] = sea.tabulated_distribution(1.0).expect("a distribution").first_moment();
        assert!((x - travel[0]).abs() < 0.01 && (z - travel[1]).abs() < 0.01, "{bearing}: {x} {z}");
    }
}

#[test]
fn hostile_tables_are_refused() {
    for (text, want) in [
        ("d*4_", "it begins with neither a band nor a number of directions and the first of them"),
        ("d*4*x_.1*1*AAAAAAAA", "it begins with neither a band nor a number of directions and the first of them"),
        ("d*4*0_.1*1*AAAAAAAA", "4 levels for 4 directions"),
        ("d*4*0_.1*1*AAAAAAA", "its levels have other letters than a link has"),
        ("d*4*0_.1*1*AAAAAA", "3 levels for 4 directions"),
        ("d*4*0_.1*AAAAAAAA", "it has not two numbers and levels"),
        ("d*4*0_.1*1*AAAAAA**_", "it has not two numbers and levels"),
        ("d*1e99*0_.1*1*AA_.2*1*AA_.3*1*AA", "1 levels for 18446744073709551615 directions"),
        ("d*4*360_.1*1*AAAAAAAA_.2*1*AAAAAAAA_.3*1*AAAAAAAA", "a direction or a level is out of range"),
        ("d*4*0_.1*0*AAAAAAAA_.2*0*AAAAAAAA_.3*0*AAAAAAAA", "there are no waves"),
    ] {
        let reason = MeasuredSpectrum::from_state(text).expect_err(text);
        assert!(reason.contains("measured spectrum: ") && reason.contains(want), "{reason}");
    }
    for (count, densities) in [(3, vec![1.0; 9]), (4, vec![1.0; 8]), (4, vec![f64::NAN; 12]), (4, vec![-1.0; 12])] {
        DirectionalTable::new(0.0, count, &densities).expect_err("refused");
    }
    let mut random = Lcg(31);
    let state = random_spectrum(&mut random, 6, 8).to_state();
    for _ in 0..3000 {
        let mut bytes = state.clone().into_bytes();
        for _ in 0..1 + random.below(3) {
            let at = random.below(bytes.len());
            bytes[at] = b"0123456789*_-.e\xe9xAZd"[random.below(20)];
        }
        if let Ok(sea) = MeasuredSpectrum::from_state(&String::from_utf8_lossy(&bytes)) {
            check(&sea);
        }
    }
}
