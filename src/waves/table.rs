//! Tables over the wave number |k| that the spectrum shader reads: frequencies, variances and spreading parameters.
//! They are computed on the CPU in f64 because f32 on a GPU is not accurate enough.
//!
//! Up to eight wave vectors of a square lattice have the same |k| by symmetry: (+-a, +-b) and (+-b, +-a). So a table
//! needs entries only for 0 <= b <= a <= n/2; the wave vector (a, b) has the entry a (a + 1) / 2 + b.

use super::lattice::LatticeWave;
use super::plan::{Cascade, Plan};
use super::spreading::Lobe;
use super::system::{DirectionalDistribution, DirectionalTermKind, WaveSystem, angle_from_travel};
use crate::files::measured::{MaximumEntropyDistribution, MeasuredSpectrum};
use std::f64::consts::PI;
use std::sync::Arc;

/// One part of the directional spectrum of a sea: one lobe of a wave system's directional spreading, or a measured
/// distribution. The variance of a wave is the sum over all these parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalTerm {
    /// Kind of the term, which defines the meaning of its values in a spectrum [`SpectrumTable`].
    pub kind: DirectionalTermKind,
    /// Main direction of travel of the wave system, a unit vector (x, z), from which the term's angles are measured.
    pub travel: [f64; 2],
    /// A table entry (all that is stored for one wave number) is a list of vectors of four numbers. This is the index
    /// of the first one that belongs to this term.
    pub first_vector: usize,
}

/// Returns the terms whose sum is the directional spectrum of a planned sea, and the number of vectors of four numbers
/// in each table entry, which is at least 1.
pub fn directional_terms(plan: &Plan) -> (Vec<DirectionalTerm>, usize) {
    let (mut terms, mut first_vector) = (Vec::new(), 0);
    for system in &plan.systems {
        for kind in system.terms() {
            terms.push(DirectionalTerm { kind, travel: system.travel_direction, first_vector });
            first_vector += kind.vectors_per_entry();
        }
    }
    (terms, first_vector.max(1))
}

/// Densities over frequency and direction of the sea's measured spectrum, in the form that the spectrum shader reads
/// behind the entries of all cascades: a vector (number of directions n, first direction of travel in steps of 2 pi / n,
/// 0, 0), then the density D (1/rad) of each band in each direction, four to a vector. Empty without such a spectrum.
pub fn tabulated_directions(plan: &Plan) -> Vec<[f64; 4]> {
    let tables = plan.systems.iter().filter_map(|s| s.spectrum.measured.as_ref()?.directional_table());
    let Some(table) = tables.into_iter().next() else { return Vec::new() };
    let count = table.direction_count() as f64;
    let first_steps = (table.first_travel_rad() / table.step_rad()).rem_euclid(count);
    let densities: Vec<f64> = (0..table.band_count()).flat_map(|band| table.distribution_of_band(band)).collect();
    let vectors = densities.chunks(4).map(|four| std::array::from_fn(|i| four.get(i).copied().unwrap_or(0.0)));
    std::iter::once([count, first_steps, 0.0, 0.0]).chain(vectors).collect()
}

/// Precomputed spectrum of one cascade for the spectrum shader. One entry serves all wave vectors of its lattice that
/// differ only in signs and order of (ix, iz), which have the same wave number |k|.
#[derive(Clone, Debug)]
pub struct SpectrumTable {
    /// Parts of the directional spectrum of the sea (spreading lobes, buoy distributions), the same for every cascade.
    pub terms: Vec<DirectionalTerm>,
    /// Number of vectors of four numbers in each table entry.
    pub vectors_per_entry: usize,
    /// Wave number and frequency for each table entry, shared by all its wave vectors; the wave number is 0 outside the
    /// band of the cascade.
    pub waves: Vec<LatticeWave>,
    /// Values of the terms in the layout of [`DirectionalTermKind`], `vectors_per_entry` vectors for each table entry.
    /// The variances in them are those of the real and of the imaginary part of the initial amplitude h0 (m^2): a
    /// quarter of the elevation variance in a lattice cell, before the directional factor.
    pub term_vectors: Vec<[f64; 4]>,
    /// Measured spectrum whose table of directions the terms of the kind `Tabulated` need.
    measured: Option<Arc<MeasuredSpectrum>>,
}

/// Number of entries of a table for a lattice of n x n wave vectors.
pub fn entry_count(n: u32) -> usize {
    let half = n as usize / 2;
    (half + 1) * (half + 2) / 2
}

/// Index of the table entry for the wave vector with the signed lattice indices (ix, iz), each from -n/2 to n/2.
pub fn entry_index(ix: i32, iz: i32) -> usize {
    let [x, z] = [ix, iz].map(|i| i.unsigned_abs() as usize);
    let (a, b) = (x.max(z), x.min(z));
    a * (a + 1) / 2 + b
}

impl SpectrumTable {
    /// Computes the spectrum tables of all cascades of a plan, in the order of its cascades.
    pub fn for_all_cascades(plan: &Plan) -> Vec<Self> {
        let norms: Vec<LobeNorms> = plan.systems.iter().map(LobeNorms::new).collect();
        plan.cascades.iter().map(|c| Self::with_norms(plan, c, &norms)).collect()
    }

    /// Computes the spectrum table of `cascade`, one of the cascades of `plan`.
    pub fn new(plan: &Plan, cascade: &Cascade) -> Self {
        Self::with_norms(plan, cascade, &plan.systems.iter().map(LobeNorms::new).collect::<Vec<_>>())
    }

    fn with_norms(plan: &Plan, cascade: &Cascade, norms: &[LobeNorms]) -> Self {
        let half = plan.n / 2;
        let (terms, vectors_per_entry) = directional_terms(plan);
        let outside = LatticeWave { k: 0.0, cycles_per_period: 1, omega: 0.0, orbit_width_over_height: 0.0 };
        let entries = entry_count(plan.n);
        let mut out = Self {
            terms,
            vectors_per_entry,
            waves: Vec::with_capacity(entries),
            term_vectors: Vec::with_capacity(entries * vectors_per_entry),
            measured: plan.systems.iter().find_map(|s| s.spectrum.measured.clone()),
        };
        for a in 0..=half {
            for b in 0..=a {
                let i2 = a * a + b * b;
                let k = cascade.dk() * f64::from(i2).sqrt();
                if i2 == 0 || !cascade.contains_wave_number(k) {
                    out.waves.push(outside);
                } else {
                    let wave = plan.wave_at_squared_index(cascade, i2);
                    for (system, norms) in plan.systems.iter().zip(norms) {
                        let variance = 0.25 * plan.lattice_cell_variance_m2_per_rad(system, cascade, &wave);
                        push_system_values(&mut out.term_vectors, system, norms, variance, wave.omega);
                    }
                    out.waves.push(wave);
                }
                out.term_vectors.resize(out.waves.len() * vectors_per_entry, [0.0; 4]);
            }
        }
        out
    }

    /// Variance (m^2) of the real part, and equally of the imaginary part, of the initial complex amplitude h0 of the
    /// wave with signed lattice indices (ix, iz); 0 outside the band. The spectrum shader computes the same number.
    pub fn variance(&self, ix: i32, iz: i32) -> f64 {
        let entry = entry_index(ix, iz);
        if self.waves[entry].k == 0.0 {
            return 0.0;
        }
        let k = [f64::from(ix), f64::from(iz)];
        let value = |first_vector: usize| self.term_vectors[entry * self.vectors_per_entry + first_vector];
        let term = |term: &DirectionalTerm| {
            let [variance, p, q, r] = value(term.first_vector);
            match term.kind {
                DirectionalTermKind::Lobe(cosine) => {
                    variance
                        * Lobe { sech_rate_per_rad: p, cosine_exponent: q, cosine_factor: cosine }
                            .unnormalised_density(angle_from_travel(term.travel, k))
                        + r
                }
                DirectionalTermKind::Measured => {
                    let phi2 = [r, value(term.first_vector + 1)[0]];
                    MaximumEntropyDistribution { normalisation: variance, phi1: [p, q].into(), phi2: phi2.into() }
                        .density(k[1].atan2(k[0]))
                }
                DirectionalTermKind::Tabulated => {
                    let table = self.measured.as_ref().and_then(|m| m.directional_table());
                    let bands = [(q as usize, variance), (r as usize, p)];
                    table.map_or(0.0, |t| t.between(bands).mean_density(k[1].atan2(k[0]), 1.0 / k[0].hypot(k[1])))
                }
            }
        };
        self.terms.iter().map(term).sum()
    }
}

/// Appends what a table entry stores for one wave system, in the layout of [`DirectionalTermKind`], to `out`. The waves
/// of the entry have the angular frequency `omega` (rad/s). `variance` (m^2) is that of the real part of the amplitude
/// at time 0, before multiplication by the directional spreading (1/rad).
fn push_system_values(out: &mut Vec<[f64; 4]>, system: &WaveSystem, norms: &LobeNorms, variance: f64, omega: f64) {
    match system.directional_distribution(omega) {
        DirectionalDistribution::Tabulated(table) => {
            let [(low, low_fraction), (high, high_fraction)] = table.bands;
            out.push([variance * low_fraction, variance * high_fraction, low as f64, high as f64]);
        }
        DirectionalDistribution::Measured(mem) => {
            out.push([variance * mem.normalisation, mem.phi1[0], mem.phi1[1], mem.phi2[0]]);
            out.push([mem.phi2[1], 0.0, 0.0, 0.0]);
        }
        DirectionalDistribution::Lobes(at) => {
            let even = variance * at.isotropic_fraction / (2.0 * PI);
            if at.lobes.is_empty() {
                out.push([0.0, 0.0, 0.0, even]);
            }
            for (i, (share, lobe)) in at.lobes.iter().enumerate() {
                let even = if i == 0 { even } else { 0.0 };
                out.push([
                    variance * share * norms.lobe_norm_at(i, omega, lobe),
                    lobe.sech_rate_per_rad,
                    lobe.cosine_exponent,
                    even,
                ]);
            }
        }
    }
}

/// Normalising factors of the lobes of a wave system's directional spreading. Those without a closed form are
/// interpolated in ln(omega), because quadrature for every table entry would be too slow while the user moves a slider.
struct LobeNorms {
    steps: u32,
    /// For each lobe its interpolation tables, one for each interval of frequency in which the norm is smooth; `None`
    /// for a lobe whose norm has a closed form.
    lobes: Vec<Option<Vec<LobeNormTable>>>,
}

/// Table for interpolating a lobe's norm, the factor that makes its integral over all directions 1, in one interval of
/// frequency: ln(norm) at `LOG_OMEGA_INTERVALS` + 1 equidistant values of ln(omega).
struct LobeNormTable {
    ln_low: f64,
    step: f64,
    ln_norm: Vec<f64>,
}

impl LobeNorms {
    const LOG_OMEGA_INTERVALS: usize = 200;

    fn new(system: &WaveSystem) -> Self {
        let (low, high) = system.spectrum.frequency_range();
        let spreading = &system.spreading;
        let steps = spreading.spreading_norm_panels;
        let probe = spreading.lobes(low).lobes;
        let mut knots = spreading.breakpoints();
        knots.retain(|&w| w > low && w < high);
        knots.sort_by(f64::total_cmp);
        knots.insert(0, 0.1 * low);
        knots.push(high);
        let lobes = (0..probe.len())
            .map(|i| {
                let piece = |w: &[f64]| {
                    let (ln_low, ln_high) = (w[0].ln(), (w[1] * (1.0 - 1e-12)).ln());
                    let step = (ln_high - ln_low) / Self::LOG_OMEGA_INTERVALS as f64;
                    let node = |j| {
                        let omega = (ln_low + step * j as f64).exp().max(w[0]);
                        spreading.lobes(omega).lobes[i].1.normalising_factor(steps).ln()
                    };
                    LobeNormTable { ln_low, step, ln_norm: (0..=Self::LOG_OMEGA_INTERVALS).map(node).collect() }
                };
                probe[i].1.closed_form_normalising_factor().is_none().then(|| knots.windows(2).map(piece).collect())
            })
            .collect();
        Self { steps, lobes }
    }

    fn lobe_norm_at(&self, lobe_index: usize, omega: f64, lobe: &Lobe) -> f64 {
        let Some(pieces) = &self.lobes[lobe_index] else { return lobe.normalising_factor(self.steps) };
        let ln = omega.ln();
        let piece = pieces.iter().rev().find(|p| ln >= p.ln_low).unwrap_or(&pieces[0]);
        // Cubic interpolation between the four nearest nodes of the piece.
        let x = ((ln - piece.ln_low) / piece.step).clamp(0.0, Self::LOG_OMEGA_INTERVALS as f64);
        let first = (x as usize).clamp(1, Self::LOG_OMEGA_INTERVALS - 2) - 1;
        let f = x - first as f64;
        let weights = [
            -(f - 1.0) * (f - 2.0) * (f - 3.0) / 6.0,
            f * (f - 2.0) * (f - 3.0) / 2.0,
            -f * (f - 1.0) * (f - 3.0) / 2.0,
            f * (f - 1.0) * (f - 2.0) / 6.0,
        ];
        weights.iter().zip(&piece.ln_norm[first..]).map(|(w, y)| w * y).sum::<f64>().exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::measured::DirectionalTable;
    use crate::state::query;
    use crate::waves::statistics::{SpectralMoments, bearing_waves_come_from_deg, lattice_indices};

    #[test]
    fn the_table_is_the_model() {
        for state in [
            "swell=0.7",
            "scale2=1&blend=0.4&blendto=elfouhaily&iso=0.2&swell=0.3",
            "spread=cos2-positive&swell=1&spectrum=karaev",
            "spectrum=measured&measured=0.05*0.5*250*251*0.8*0.5_0.1*3*240*241*0.7*0.4_0.2*1*200*230*0.5*0.2",
            "spectrum=measured&measured=d*4*20_.05*1*--AAggAA_.1*3*ABAD--CC_.2*1*AAAA--QQ",
        ] {
            let plan = Plan::new(&query::parse(&format!("{state}&n=64")).0);
            for cascade in &plan.cascades {
                let table = SpectrumTable::new(&plan, cascade);
                for (ix, iz) in [(12, 0), (9, 9), (-3, 14), (20, -11), (-25, -17)] {
                    let wave = plan.wave_at_squared_index(cascade, (ix * ix + iz * iz) as u32);
                    if !cascade.contains_wave_number(wave.k) {
                        continue;
                    }
                    let k = [f64::from(ix), f64::from(iz)];
                    let system = |s: &WaveSystem| {
                        0.25 * plan.lattice_cell_variance_m2_per_rad(s, cascade, &wave)
                            * s.direction_density_in_cell(wave.omega, k)
                    };
                    let want: f64 = plan.systems.iter().map(system).sum();
                    let got = table.variance(ix, iz);
                    assert!((got - want).abs() <= 1e-6 * want, "{state} {ix} {iz}: {got} {want}");
                }
            }
        }
    }

    /// Tabulated directions may be far narrower than the cells of the lattice.
    #[test]
    fn a_single_direction_keeps_its_energy() {
        for (direction, from_deg) in [(8, 40.0), (9, 45.0), (29, 145.0), (54, 270.0)] {
            let densities: Vec<f64> = (0..4 * 72).map(|i| f64::from(u8::from(i % 72 == direction))).collect();
            let directions = DirectionalTable::new(0.0, 72, &densities).expect("a table");
            let bands = [(0.06, 0.0), (0.08, 20.0), (0.1, 1.0), (0.12, 0.0)];
            let mut params = query::parse("n=256").0;
            params.sea.set_measured_spectrum(MeasuredSpectrum::with_table(&bands, directions).expect("a spectrum"));
            let plan = Plan::new(&params);
            let (mut moments, m0) = (SpectralMoments::default(), plan.spectrum_integrals.m0());
            for cascade in &plan.cascades {
                let table = SpectrumTable::new(&plan, cascade);
                for (ix, iz) in lattice_indices(plan.n) {
                    let wave = table.waves[entry_index(ix, iz)];
                    if wave.k > 0.0 {
                        let unit = [f64::from(ix), f64::from(iz)].map(|i| i * cascade.dk() / wave.k);
                        moments.add(4.0 * table.variance(ix, iz), wave.k, wave.omega, unit);
                    }
                }
            }
            let held = moments.moments[0] / m0;
            let mean_deg = bearing_waves_come_from_deg(moments.first_moment);
            assert!((held - plan.resolved_variance_fraction()).abs() < 0.05, "{from_deg}: {held}");
            assert!((mean_deg - from_deg).abs() < 1.0, "{from_deg}: {mean_deg}");
        }
    }

    #[test]
    fn the_largest_tables_fit_a_binding() {
        use super::super::system::MAX_SPECTRUM_TERMS;
        // WebGPU's default limit of a storage buffer's binding is 128 MiB.
        let bytes = 16 * entry_count(1024) * crate::state::params::MAX_CASCADES * MAX_SPECTRUM_TERMS;
        assert!(bytes <= 128 << 20, "{bytes}");
    }

    #[test]
    fn the_triangle_covers_the_lattice_once() {
        let n = 64;
        let mut seen = vec![0; entry_count(n)];
        for a in 0..=(n as i32 / 2) {
            for b in 0..=a {
                seen[entry_index(a, -b)] += 1;
                assert_eq!(entry_index(a, b), entry_index(-b, a));
            }
        }
        assert!(seen.iter().all(|&s| s == 1));
    }
}
