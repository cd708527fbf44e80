//! Makes a transfer in small steps.

use super::envelopes::Envelopes;
use super::points::{ShortWaves, points};
use super::setup::Setup;
use super::shore::Shore;
use super::swash::Swash;
use super::{Transfer, TransferLimits, TransferWave};
use crate::coast::elliptic::EllipticSolver;
use crate::coast::field::ComponentField;
use crate::coast::losses::Dissipation;
use crate::coast::open_sea::Solver;
use crate::coast::parabolic::{LoneMarch, ParabolicSolver};
use crate::coast::placed::PlacedCoast;
use crate::waves::Plan;

/// Parts of the progress that end with the march of the whole sea, and with the solution of the waves.
const MARCHED: f64 = 0.2;
const SOLVED: f64 = 0.95;
/// Largest factor that raises waves near the shore to those of the swash.
const MAX_RAISE: f64 = 6.0;

/// Makes the [`Transfer`] of a planned sea over a coast. A step takes some milliseconds, so that a program with one
/// thread can draw frames between steps.
///
/// ```
/// use seastate::coast::{BuiltInCoast, PlacedCoast, placed::PlacingOptions};
/// use seastate::coast::transfer::{TransferLimits, TransferSolver};
/// use seastate::{state::query, waves::Plan};
///
/// let (params, _) = query::parse("hs=1.5&tp=9&dir=250&depth=12&n=64");
/// let beach = BuiltInCoast::find("beach").expect("a beach");
/// let coast = PlacedCoast::built_in(beach, &PlacingOptions::default())?;
/// let limits = TransferLimits { max_waves: 20, points: 40, ..TransferLimits::default() };
/// let mut solver = TransferSolver::new(&Plan::new(&params), &coast, &limits);
/// while solver.step() < 1.0 {}
/// let transfer = solver.finish();
/// assert_eq!((transfer.waves.len(), transfer.columns), (20, 40));
/// # Ok::<(), String>(())
/// ```
pub struct TransferSolver {
    setup: Setup,
    stage: Stage,
    envelopes: Envelopes,
    /// Whether each wave belongs to the shortest third.
    is_short: Vec<bool>,
}

/// What is done next.
enum Stage {
    /// The whole sea is marched ashore, to know how it breaks.
    Sea(Box<ParabolicSolver>),
    /// The waves are marched, each alone; the next one has this index.
    March(Box<LoneMarch>, usize),
    /// The waves are solved around structures; this many are done.
    Structures(Box<EllipticSolver>, Dissipation, usize),
    /// The waves are continued ashore.
    Ashore(Box<Ashore>, usize),
    /// The waves near the shore get their heights.
    Heights(Box<Ashore>, usize),
    /// All is done.
    Done(Box<Transfer>),
}

/// What is known once the waves are solved.
struct Ashore {
    sea: Dissipation,
    shore: Shore,
    swash: Swash,
    /// Points at which the waves are multiplied by a factor.
    factors: Vec<(usize, f64)>,
}

impl TransferSolver {
    /// Prepares the transfer of the sea of `plan` over `coast`.
    pub fn new(plan: &Plan, coast: &PlacedCoast, limits: &TransferLimits) -> Self {
        let setup = Setup::new(plan, coast, limits);
        let grid = &setup.grid;
        let stage = Stage::Sea(Box::new(ParabolicSolver::without_field(grid, &setup.bins, &setup.options)));
        let envelopes = Envelopes::new(setup.waves.len(), grid.columns, grid.rows, grid.cell_m);
        let mut omegas: Vec<f64> = setup.waves.iter().map(|wave| wave.omega_rad_s).collect();
        omegas.sort_by(f64::total_cmp);
        let short_from = omegas.get(omegas.len() * 2 / 3).copied().unwrap_or(f64::INFINITY);
        let is_short = setup.waves.iter().map(|wave| wave.omega_rad_s >= short_from).collect();
        Self { setup, stage, envelopes, is_short }
    }

    /// Does the next step. Returns the fraction of the work that is done, 1 at the end.
    pub fn step(&mut self) -> f64 {
        let waves = self.setup.waves.len();
        let of_waves = |done: usize| done as f64 / waves.max(1) as f64;
        match std::mem::replace(&mut self.stage, Stage::Done(Box::default())) {
            Stage::Sea(mut solver) => {
                let done = solver.advance();
                self.stage = if done < 1.0 { Stage::Sea(solver) } else { self.solve_waves(solver.finish().1) };
                MARCHED * done
            }
            Stage::March(march, next) => {
                let end = self.march(&march, next);
                self.stage =
                    if end < waves { Stage::March(march, end) } else { self.go_ashore(march.dissipation().clone()) };
                MARCHED + (SOLVED - MARCHED) * of_waves(end)
            }
            Stage::Structures(mut solver, sea, solved) => {
                let done = solver.advance();
                let fields = solver.take_solved();
                let solved = solved + fields.len();
                fields.iter().for_each(|(index, field)| self.store(*index, field));
                self.stage = if done < 1.0 { Stage::Structures(solver, sea, solved) } else { self.go_ashore(sea) };
                MARCHED + (SOLVED - MARCHED) * done
            }
            Stage::Ashore(ashore, next) if next < waves => {
                let wave = &self.setup.waves[next];
                let group = &self.setup.groups[wave.group as usize];
                self.envelopes.continue_ashore(next, wave, group, &ashore.shore);
                self.stage = Stage::Ashore(ashore, next + 1);
                SOLVED + 0.5 * (1.0 - SOLVED) * of_waves(next)
            }
            Stage::Ashore(mut ashore, _) => {
                ashore.factors = self.factors(&ashore);
                self.stage = Stage::Heights(ashore, 0);
                SOLVED + 0.5 * (1.0 - SOLVED)
            }
            Stage::Heights(ashore, next) if next < waves => {
                let (grid, open_from_m) = (&self.setup.grid, self.open_from_m(&ashore));
                let is_open = |point: usize| f64::from(grid.depth_m[point]) >= open_from_m;
                self.envelopes.scale(next, &ashore.factors, is_open);
                self.stage = Stage::Heights(ashore, next + 1);
                SOLVED + 0.5 * (1.0 - SOLVED) * (1.0 + 0.9 * of_waves(next))
            }
            Stage::Heights(ashore, _) => {
                self.stage = Stage::Done(Box::new(self.transfer(&ashore)));
                1.0
            }
            Stage::Done(transfer) => {
                self.stage = Stage::Done(transfer);
                1.0
            }
        }
    }

    /// Does all remaining steps. Returns the transfer.
    pub fn finish(mut self) -> Transfer {
        loop {
            if let Stage::Done(transfer) = self.stage {
                return *transfer;
            }
            self.step();
        }
    }

    fn solve_waves(&mut self, sea: Dissipation) -> Stage {
        let Setup { grid, options, waves, reflection, .. } = &self.setup;
        if waves.is_empty() {
            return self.go_ashore(sea);
        }
        match self.setup.solver {
            Solver::Parabolic => Stage::March(Box::new(LoneMarch::new(grid, sea, options)), 0),
            Solver::Elliptic => {
                let incident: Vec<_> = waves.iter().map(|wave| wave.incident).collect();
                let solver = EllipticSolver::new(grid, &incident, &sea, reflection, options);
                Stage::Structures(Box::new(solver), sea, 0)
            }
        }
    }

    /// Marches one wave for each thread from the one with the index `next` on; returns the index of the next one.
    fn march(&mut self, march: &LoneMarch, next: usize) -> usize {
        let end = (next + self.setup.options.threads.max(1)).min(self.setup.waves.len());
        let waves = &self.setup.waves[next..end];
        let fields: Vec<ComponentField> = if let [wave] = waves {
            vec![march.march(&wave.incident)]
        } else {
            std::thread::scope(|scope| {
                let threads: Vec<_> =
                    waves.iter().map(|wave| scope.spawn(move || march.march(&wave.incident))).collect();
                threads.into_iter().filter_map(|thread| thread.join().ok()).collect()
            })
        };
        for (index, field) in (next..end).zip(&fields) {
            self.store(index, field);
        }
        end
    }

    fn store(&mut self, index: usize, field: &ComponentField) {
        let wave = &self.setup.waves[index];
        let group = &self.setup.groups[wave.group as usize];
        self.envelopes.store(index, wave, field, group, self.is_short[index]);
    }

    fn go_ashore(&self, sea: Dissipation) -> Stage {
        let shore = Shore::new(&self.setup.grid, self.setup.shore);
        let swash = Swash::new(&self.setup, &sea, &self.envelopes.variance_m2, &shore);
        Stage::Ashore(Box::new(Ashore { sea, shore, swash, factors: Vec::new() }), 0)
    }

    /// The factors that give the waves the variance that they should have.
    fn factors(&self, ashore: &Ashore) -> Vec<(usize, f64)> {
        let mut has_m2 = self.envelopes.variance_m2.clone();
        for place in &ashore.shore.places {
            has_m2[place.point] = self.envelopes.continued_m2[place.point];
        }
        let factor = |(point, (wanted, has)): (usize, (&f64, &f64))| {
            let factor = if *has > 0.0 { (wanted / has).sqrt().min(MAX_RAISE) } else { 1.0 };
            (factor != 1.0).then_some((point, factor))
        };
        ashore.swash.variance_m2.iter().zip(&has_m2).enumerate().filter_map(factor).collect()
    }

    /// Depth, m, from which the waves are neither continued ashore nor raised to the swash.
    fn open_from_m(&self, ashore: &Ashore) -> f64 {
        self.setup.shore.least_depth_m.max(ashore.swash.begin_m)
    }

    fn transfer(&mut self, ashore: &Ashore) -> Transfer {
        let setup = &self.setup;
        let open_short = setup
            .waves
            .iter()
            .zip(&self.is_short)
            .filter(|(_, is_short)| **is_short)
            .map(|(w, _)| 0.5 * w.open_amplitude_m.powi(2))
            .sum();
        let short = ShortWaves { solved_m2: &self.envelopes.short_variance_m2, open_m2: open_short };
        let wave = |wave: &super::setup::Wave| TransferWave {
            lattice_index: wave.lattice_index,
            omega_rad_s: wave.omega_rad_s,
            group: wave.group,
        };
        Transfer {
            placement: setup.placement,
            columns: setup.grid.columns,
            rows: setup.grid.rows,
            cell_m: setup.grid.cell_m,
            open_from_m: self.open_from_m(ashore),
            lattice: setup.lattice,
            waves: setup.waves.iter().map(wave).collect(),
            groups: setup.groups.clone(),
            points: points(setup, &ashore.sea, &ashore.shore, &ashore.swash, &short),
            envelopes: std::mem::take(&mut self.envelopes.packed),
        }
    }
}
