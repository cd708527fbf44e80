//! The waves of a transfer at a point and a time, in double precision.

use super::half_float::unpack;
use super::{Transfer, WaveGroup};
use crate::coast::complex::Complex;
use crate::waves::Plan;
use crate::waves::statistics::initial_amplitude;
use crate::waves::table::SpectrumTable;
use std::f64::consts::TAU;
use std::sync::Arc;

/// The waves of a transfer with the amplitudes that a sea gives them.
#[derive(Clone, Debug)]
pub struct CoastalWaves {
    transfer: Arc<Transfer>,
    waves: Vec<WaveInTime>,
    /// Cosine and sine of the turn of the frame.
    turn: [f64; 2],
}

impl PartialEq for CoastalWaves {
    /// Two are equal if they have the same transfer in memory and the same amplitudes.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.transfer, &other.transfer) && self.waves == other.waves
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct WaveInTime {
    /// Amplitude h0 of the lattice, m.
    h0: Complex,
    omega_rad_s: f64,
    cycles_per_period: u32,
    /// Ratio of the axes of the orbits in the open sea divided by the wave number, g / omega^2, m.
    orbit_m: f64,
}

/// Sums over the waves of a transfer at a point of the world, without their weight. Vectors have the components x and
/// z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CoastalSums {
    /// The sum Z of h0 T e^(-i omega t), m, of which the elevation is 2 Re Z and the local wave height 4 |Z|: real and
    /// imaginary part.
    pub half_amplitude_m: [f64; 2],
    /// Elevation without the set-up, m.
    pub elevation_m: f64,
    /// Slopes of the elevation.
    pub slope: [f64; 2],
    /// Horizontal displacement D of the water particles, m.
    pub displacement_m: [f64; 2],
    /// Strain (dDx/dx, dDz/dz, dDx/dz).
    pub strain: [f64; 3],
    /// Potential of D, m^2.
    pub displacement_potential_m2: f64,
    /// Orbital velocity (x, y, z), m/s.
    pub orbital_velocity_m_s: [f64; 3],
}

/// What a transfer says at a point of the world besides its waves, interpolated between its points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoastalGains {
    /// Factor on the waves that the transfer does not hold.
    pub short_gain: f64,
    /// Weight of its waves. The rest, times `short_gain`, is the factor on the same waves of the open sea.
    pub weight: f64,
    /// Mean level, m.
    pub set_up_m: f64,
    /// Depth below the still water, m; negative on land.
    pub depth_m: f64,
}

/// A wave of a transfer at a fixed point of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoastalWaveAtPoint {
    /// Complex amplitude (re, im) of the elevation at time 0, m.
    pub amplitude_m: [f64; 2],
    /// Gradient of that amplitude along x and z, as (re, im). For a plane wave it is i k times the amplitude.
    pub gradient: [[f64; 2]; 2],
    /// Angular frequency, rad/s.
    pub omega_rad_s: f64,
    /// Number of cycles in the period of the sea.
    pub cycles_per_period: u32,
}

/// The cell of a point, and the place in it: 0 to 1 along both axes.
struct Place {
    column: usize,
    row: usize,
    part: [f64; 2],
    /// Distance along the shore, m.
    y_m: f64,
    is_inside: bool,
}

impl Place {
    /// Value and derivatives (x, y, xy) of a field that is bilinear between its values at the corners of the cell.
    fn derivatives(&self, [a, b, c, d]: [Complex; 4], cell_m: f64) -> [Complex; 4] {
        let [p, q] = self.part;
        let (low, high) = (a * (1.0 - p) + b * p, c * (1.0 - p) + d * p);
        let value = low * (1.0 - q) + high * q;
        let x = ((b - a) * (1.0 - q) + (d - c) * q) * (1.0 / cell_m);
        let y = (high - low) * (1.0 / cell_m);
        let xy = (a - b - c + d) * (1.0 / (cell_m * cell_m));
        [value, x, y, xy]
    }

    /// Twice the carrier of a group, and its wave numbers along x and y, rad/m.
    fn carrier(&self, group: &WaveGroup, cell_m: f64) -> (Complex, [f64; 2]) {
        let phases = &group.column_phase_rad;
        let step_rad = phases[self.column + 1] - phases[self.column];
        let phase = phases[self.column] + self.part[0] * step_rad + group.ky_rad_m * self.y_m;
        (Complex::polar(2.0, phase), [step_rad / cell_m, group.ky_rad_m])
    }
}

impl CoastalWaves {
    /// The waves of `transfer` with the amplitudes of `plan`; `None` if it was made for another lattice of waves.
    pub fn new(transfer: Arc<Transfer>, plan: &Plan) -> Option<Self> {
        let cascade = plan.cascades.first()?;
        if !transfer.fits(plan) {
            return None;
        }
        let table = SpectrumTable::new(plan, cascade);
        let half = plan.n as i32 / 2;
        let in_time = |[ix, iz]: [i32; 2]| {
            let wave = plan.wave_at_squared_index(cascade, (ix * ix + iz * iz) as u32);
            let is_held = ix.abs() < half && iz.abs() < half;
            let [re, im] = if is_held { initial_amplitude(plan, cascade, &table, ix, iz) } else { [0.0; 2] };
            WaveInTime {
                h0: Complex::new(re, im),
                omega_rad_s: wave.omega,
                cycles_per_period: wave.cycles_per_period,
                orbit_m: wave.orbit_width_over_height / wave.k,
            }
        };
        let waves = transfer.waves.iter().map(|wave| in_time(wave.lattice_index)).collect();
        let (sin, cos) = transfer.placement.turn_rad.sin_cos();
        Some(Self { transfer, waves, turn: [cos, sin] })
    }

    /// The transfer.
    pub fn transfer(&self) -> &Arc<Transfer> {
        &self.transfer
    }

    /// All waves at the point `at_m` (x, z) of the world, m; none outside the grid.
    pub fn at_point(&self, at_m: [f64; 2]) -> Vec<CoastalWaveAtPoint> {
        let (transfer, place) = (&*self.transfer, self.transfer.place(at_m));
        if !place.is_inside {
            return Vec::new();
        }
        let points = transfer.columns * transfer.rows;
        let first = place.row * transfer.columns + place.column;
        let corners = [first, first + 1, first + transfer.columns, first + transfer.columns + 1];
        let at_point = |(index, wave): (usize, &WaveInTime)| {
            let group = &transfer.groups[transfer.waves[index].group as usize];
            let (carrier, k) = place.carrier(group, transfer.cell_m);
            let envelope = corners.map(|point| wave.h0 * unpack(transfer.envelopes[index * points + point]));
            let [value, x, y, _] = place.derivatives(envelope, transfer.cell_m).map(|part| part * carrier);
            let [along_x, along_y] = [x + Complex::I * value * k[0], y + Complex::I * value * k[1]];
            let [cos, sin] = self.turn;
            let gradient = [along_x * cos - along_y * sin, along_x * sin + along_y * cos];
            CoastalWaveAtPoint {
                amplitude_m: [value.re, value.im],
                gradient: gradient.map(|part| [part.re, part.im]),
                omega_rad_s: wave.omega_rad_s,
                cycles_per_period: wave.cycles_per_period,
            }
        };
        self.waves.iter().enumerate().map(at_point).collect()
    }

    /// Sums at the point `at_m` (x, z) of the world, m, at the time `period_fraction` (2^32 per period of the sea).
    /// They are 0 outside the grid, where the waves have no weight.
    pub fn sums(&self, at_m: [f64; 2], period_fraction: u32) -> CoastalSums {
        let place = self.transfer.place(at_m);
        let mut sum = Accumulated::default();
        if !place.is_inside {
            return CoastalSums::default();
        }
        let transfer = &*self.transfer;
        let points = transfer.columns * transfer.rows;
        let first = place.row * transfer.columns + place.column;
        let corners = [first, first + 1, first + transfer.columns, first + transfer.columns + 1];
        for group in &transfer.groups {
            // The sums at the four corners of the cell: elevation and potential, and both times the frequency.
            let mut fields = [[Complex::ZERO; 4]; 4];
            for index in group.first_wave..group.first_wave + group.wave_count {
                let wave = &self.waves[index];
                let turns = f64::from(wave.cycles_per_period.wrapping_mul(period_fraction)) / 4_294_967_296.0;
                let phasor = wave.h0 * Complex::polar(1.0, -TAU * turns);
                let factors = [1.0, wave.orbit_m, wave.omega_rad_s, wave.omega_rad_s * wave.orbit_m];
                for (corner, point) in corners.into_iter().enumerate() {
                    let value = phasor * unpack(transfer.envelopes[index * points + point]);
                    for (field, factor) in fields.iter_mut().zip(factors) {
                        field[corner] += value * factor;
                    }
                }
            }
            let (carrier, k) = place.carrier(group, transfer.cell_m);
            sum.add(&fields, carrier, k, &place, transfer.cell_m);
        }
        sum.in_world(self.turn)
    }
}

/// Sums over groups in the frame of the coast.
#[derive(Default)]
struct Accumulated {
    elevation: Complex,
    slope: [f64; 2],
    displacement: [f64; 2],
    /// Derivatives xx, yy and xy of the potential.
    strain: [f64; 3],
    potential: f64,
    rise: f64,
    drift: [f64; 2],
}

impl Accumulated {
    /// Adds the waves of a group: their fields at the corners of a cell, and twice the carrier at the point with its
    /// wave numbers.
    fn add(&mut self, fields: &[[Complex; 4]; 4], carrier: Complex, k: [f64; 2], place: &Place, cell_m: f64) {
        let derivatives = |corners: [Complex; 4]| place.derivatives(corners, cell_m).map(|part| part * carrier);
        let gradient = |[value, x, y, _]: [Complex; 4]| [x + Complex::I * value * k[0], y + Complex::I * value * k[1]];
        let [elevation, potential, elevation_rate, potential_rate] = [0, 1, 2, 3].map(|i| derivatives(fields[i]));
        self.elevation += elevation[0];
        self.potential += potential[0].re;
        // The derivative in time is -i omega, of which the real part is omega times the imaginary one.
        self.rise += elevation_rate[0].im;
        let [slope, displacement, drift] = [elevation, potential, potential_rate].map(gradient);
        for axis in 0..2 {
            self.slope[axis] += slope[axis].re;
            self.displacement[axis] += displacement[axis].re;
            self.drift[axis] += drift[axis].im;
        }
        let [value, x, y, xy] = potential;
        self.strain[0] += (Complex::I * x * (2.0 * k[0]) - value * (k[0] * k[0])).re;
        self.strain[1] += (Complex::I * y * (2.0 * k[1]) - value * (k[1] * k[1])).re;
        self.strain[2] += (xy + Complex::I * (x * k[1] + y * k[0]) - value * (k[0] * k[1])).re;
    }

    /// The sums with vectors along the axes of the world.
    fn in_world(&self, [cos, sin]: [f64; 2]) -> CoastalSums {
        let turned = |[x, y]: [f64; 2]| [x * cos - y * sin, x * sin + y * cos];
        let [xx, yy, xy] = self.strain;
        let [ux, uz] = turned(self.drift);
        CoastalSums {
            half_amplitude_m: [0.5 * self.elevation.re, 0.5 * self.elevation.im],
            elevation_m: self.elevation.re,
            slope: turned(self.slope),
            displacement_m: turned(self.displacement),
            strain: [
                xx * cos * cos - 2.0 * xy * sin * cos + yy * sin * sin,
                xx * sin * sin + 2.0 * xy * sin * cos + yy * cos * cos,
                (xx - yy) * sin * cos + xy * (cos * cos - sin * sin),
            ],
            displacement_potential_m2: self.potential,
            orbital_velocity_m_s: [ux, self.rise, uz],
        }
    }
}

impl Transfer {
    fn place(&self, at_m: [f64; 2]) -> Place {
        let grid = self.in_frame_m(at_m).map(|v| v / self.cell_m);
        let last = [self.columns, self.rows].map(|count| (count - 1) as f64);
        let is_inside = (0..2).all(|axis| (0.0..=last[axis]).contains(&grid[axis]));
        let inside = [0, 1].map(|axis| grid[axis].clamp(0.0, last[axis]));
        let [column, row] = [0, 1].map(|axis| (inside[axis] as usize).min(last[axis] as usize - 1));
        let part = [inside[0] - column as f64, inside[1] - row as f64];
        Place { column, row, part, y_m: inside[1] * self.cell_m, is_inside }
    }

    /// Gains and mean level at the point `at_m` (x, z) of the world, m. Outside the grid the waves have no weight; the
    /// others have the gain of its edge.
    pub fn gains(&self, at_m: [f64; 2]) -> CoastalGains {
        let place = self.place(at_m);
        let [p, q] = place.part;
        let first = place.row * self.columns + place.column;
        let mut out = CoastalGains { short_gain: 0.0, weight: 0.0, set_up_m: 0.0, depth_m: 0.0 };
        let corners =
            [(0, (1.0 - p) * (1.0 - q)), (1, p * (1.0 - q)), (self.columns, (1.0 - p) * q), (self.columns + 1, p * q)];
        for (step, share) in corners {
            let point = &self.points[first + step];
            out.short_gain += share * f64::from(point.short_gain);
            out.weight += share * f64::from(point.weight);
            out.set_up_m += share * f64::from(point.set_up_m);
            out.depth_m += share * f64::from(point.depth_m);
        }
        if !place.is_inside {
            (out.weight, out.set_up_m) = (0.0, 0.0);
        }
        out
    }
}
