//! The coast of a running sea: places its land at once, and solves how the waves come ashore beside the running sea, in a
//! thread of its own or in slices of a frame. The solutions of the last seas are kept.

#[cfg(test)]
mod tests;

use crate::coast::transfer::{TransferLimits, TransferSolver};
use crate::coast::{PlacedCoast, Transfer};
use crate::state::Params;
use crate::state::coast::Coast;
use crate::waves::{Plan, SeaChange};
use std::sync::Arc;
#[cfg(not(target_arch = "wasm32"))]
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use web_time::{Duration, Instant};

/// Time for which a sea must stay the same before its coast is solved, s. While a slider is dragged, nothing is begun that
/// the next frame would throw away.
const SETTLING_S: f64 = 0.4;
/// Largest size of all kept envelopes, bytes. The newest solution is kept in any case.
const MAX_KEPT_BYTES: usize = 128 << 20;
/// Length of a slice of the work in a thread. Between two slices it looks whether it is still wanted.
#[cfg(not(target_arch = "wasm32"))]
const THREAD_SLICE: Duration = Duration::from_millis(20);

/// What a frame shows of a coast: its land, and its waves once they are solved.
pub type ShownCoast = (Option<Arc<PlacedCoast>>, Option<Arc<Transfer>>);

/// Calls `step`, which returns whether all is done, until it is or `slice` is over.
#[cfg_attr(not(target_arch = "wasm32"), expect(clippy::disallowed_methods, reason = "no browser runs this one"))]
pub fn work_for(slice: Duration, mut step: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !step() && begun.elapsed() < slice {}
}

/// Solves the transfer functions of a coast in slices.
pub trait StepwiseSolver: Send + Sized + 'static {
    /// Prepares the solution for the waves of `plan` over `coast`.
    fn begin(plan: &Plan, coast: &PlacedCoast) -> Self;

    /// Does one step of the work, some milliseconds long. Returns the fraction of the work that is done; 1 is all.
    fn step(&mut self) -> f32;

    /// The solution, once a step has returned 1.
    fn finish(self) -> Transfer;

    /// Steps until `slice` is over or the work is done. Returns the fraction that is done.
    fn advance(&mut self, slice: Duration) -> f32 {
        let mut done = 0.0;
        work_for(slice, || {
            done = self.step();
            done >= 1.0
        });
        done
    }
}

impl StepwiseSolver for TransferSolver {
    fn begin(plan: &Plan, coast: &PlacedCoast) -> Self {
        Self::new(plan, coast, &TransferLimits::default())
    }

    fn step(&mut self) -> f32 {
        Self::step(self) as f32
    }

    fn finish(self) -> Transfer {
        Self::finish(self)
    }
}

/// What the transfer functions of a coast depend on: waves, grid and coast of some parameters.
#[derive(Clone, Debug)]
pub struct CoastKey(Params);

impl CoastKey {
    /// The key of the coast of `params`; `None` in the open sea.
    pub fn of(params: &Params) -> Option<Self> {
        let Params { grid, sea, coast, .. } = params.clone();
        coast.is_on().then(|| Self(Params { grid, sea, coast, ..Params::default() }))
    }

    /// Whether the coast of `params` has the same transfer functions.
    pub fn fits(&self, params: &Params) -> bool {
        self.0.coast == params.coast && SeaChange::between(&self.0, params) != Some(SeaChange::Waves)
    }
}

/// Who does the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worker {
    /// [`CoastTask::update`] itself, in each call.
    EachCall,
    /// A thread for each solution.
    #[cfg(not(target_arch = "wasm32"))]
    Thread,
}

/// The land and the solution of the coast of a running sea.
pub struct CoastTask<S> {
    worker: Worker,
    /// The coast that was placed last, and what came of it: `None` in the open sea.
    placed: Option<(Coast, Result<Option<Arc<PlacedCoast>>, String>)>,
    /// The sea of the last call, and the time (s) since which it is the same.
    settled: Option<(CoastKey, f64)>,
    work: Option<Work<S>>,
    /// The last solutions, the newest at the end.
    kept: Vec<(CoastKey, Arc<Transfer>)>,
    /// The solution to show: that of the present sea, or until it is there that of the sea before, over the same coast.
    shown: Option<(CoastKey, Arc<Transfer>)>,
    /// Why the last solution failed.
    failure: Option<String>,
}

/// A solution in progress.
struct Work<S> {
    key: CoastKey,
    job: Job<S>,
}

enum Job<S> {
    Here {
        /// `None` once it has finished.
        solver: Option<S>,
        /// Fraction that is done.
        done: f32,
    },
    #[cfg(not(target_arch = "wasm32"))]
    Thread(ThreadJob),
}

#[cfg(not(target_arch = "wasm32"))]
struct ThreadJob {
    shared: Arc<SharedProgress>,
    /// `None` once the thread was waited for. It returns `None` if it was told to stop.
    thread: Option<std::thread::JoinHandle<Option<Transfer>>>,
}

#[cfg(not(target_arch = "wasm32"))]
#[derive(Default)]
struct SharedProgress {
    /// Bits of the f32 fraction that is done.
    done: AtomicU32,
    is_stopped: AtomicBool,
}

#[cfg(not(target_arch = "wasm32"))]
impl Drop for ThreadJob {
    fn drop(&mut self) {
        self.shared.is_stopped.store(true, Ordering::Relaxed);
    }
}

impl<S: StepwiseSolver> CoastTask<S> {
    /// A task without a coast, whose work `worker` does.
    pub fn new(worker: Worker) -> Self {
        Self { worker, placed: None, settled: None, work: None, kept: Vec::new(), shown: None, failure: None }
    }

    /// Follows the parameters of this frame, at the time `now_s` (s) of the frame: places the land, begins or goes on with
    /// the solution, or takes one that is there. Without a thread, it works on the solution until `slice` is over.
    pub fn update(&mut self, params: &Params, now_s: f64, slice: Duration) {
        self.place(&params.coast);
        let Some(key) = CoastKey::of(params).filter(|_| self.land().is_some()) else {
            (self.settled, self.work, self.shown, self.failure) = (None, None, None, None);
            return;
        };
        if self.shown.as_ref().is_some_and(|(shown, _)| shown.0.coast != params.coast) {
            self.shown = None;
        }
        if self.settled.as_ref().is_none_or(|(settled, _)| !settled.fits(params)) {
            // The first solution of a coast is begun at once.
            let since_s = if self.settled.is_none() { f64::NEG_INFINITY } else { now_s };
            self.settled = Some((key.clone(), since_s));
            self.failure = None;
        }
        if let Some((key, transfer)) = self.kept.iter().rfind(|(kept, _)| kept.fits(params)) {
            self.shown = Some((key.clone(), transfer.clone()));
            self.work = None;
            return;
        }
        if self.work.as_ref().is_some_and(|work| !work.key.fits(params)) {
            self.work = None;
        }
        let is_settled = self.settled.as_ref().is_some_and(|(_, since_s)| now_s - since_s >= SETTLING_S);
        if self.work.is_none() && is_settled && self.failure.is_none() {
            self.begin(key, params);
        }
        self.work_on(slice);
    }

    /// The land; `None` in the open sea, and where the coast could not be placed.
    pub fn land(&self) -> Option<&Arc<PlacedCoast>> {
        self.placed.as_ref().and_then(|(_, placed)| placed.as_ref().ok()?.as_ref())
    }

    /// The transfer functions to show. While those of the present sea are being solved, these are the ones of the sea
    /// before, over the same coast, or `None`.
    pub fn transfer(&self) -> Option<&Arc<Transfer>> {
        self.shown.as_ref().map(|(_, transfer)| transfer)
    }

    /// Fraction of the solution that is done; `None` if nothing is being solved.
    pub fn progress(&self) -> Option<f32> {
        Some(match &self.work.as_ref()?.job {
            Job::Here { done, .. } => *done,
            #[cfg(not(target_arch = "wasm32"))]
            Job::Thread(job) => f32::from_bits(job.shared.done.load(Ordering::Relaxed)),
        })
    }

    /// Whether a coming call has something to do although the parameters stay the same.
    pub fn is_busy(&self, params: &Params) -> bool {
        self.land().is_some()
            && self.failure.is_none()
            && self.shown.as_ref().is_none_or(|(shown, _)| !shown.fits(params))
    }

    /// What the user should know about the coast, one sentence each.
    pub fn notices(&self) -> Vec<String> {
        let placed = self.placed.as_ref().map(|(_, placed)| placed);
        let of_land = match placed {
            Some(Ok(Some(land))) => land.notices.clone(),
            Some(Err(reason)) => vec![reason.clone()],
            Some(Ok(None)) | None => Vec::new(),
        };
        of_land.into_iter().chain(self.failure.clone()).collect()
    }

    fn place(&mut self, coast: &Coast) {
        if self.placed.as_ref().is_none_or(|(placed, _)| placed != coast) {
            let placed = PlacedCoast::of_state(coast, None).map(|land| land.map(Arc::new));
            self.placed = Some((coast.clone(), placed));
        }
    }

    fn begin(&mut self, key: CoastKey, params: &Params) {
        let Some(land) = self.land().cloned() else { return };
        let plan = Plan::new(params);
        let job = match self.worker {
            Worker::EachCall => Job::Here { solver: Some(S::begin(&plan, &land)), done: 0.0 },
            #[cfg(not(target_arch = "wasm32"))]
            Worker::Thread => {
                let shared = Arc::new(SharedProgress::default());
                let told = shared.clone();
                let solve = move || {
                    let mut solver = S::begin(&plan, &land);
                    while !told.is_stopped.load(Ordering::Relaxed) {
                        let done = solver.advance(THREAD_SLICE);
                        told.done.store(done.to_bits(), Ordering::Relaxed);
                        if done >= 1.0 {
                            return Some(solver.finish());
                        }
                    }
                    None
                };
                Job::Thread(ThreadJob { shared, thread: Some(std::thread::spawn(solve)) })
            }
        };
        self.work = Some(Work { key, job });
    }

    /// Works on the solution for this call's time, and takes it when it is complete.
    fn work_on(&mut self, slice: Duration) {
        let Some(work) = &mut self.work else { return };
        let solved = match &mut work.job {
            Job::Here { solver, done } => {
                *done = solver.as_mut().map_or(1.0, |solver| solver.advance(slice));
                (*done >= 1.0).then(|| solver.take().map(S::finish))
            }
            #[cfg(not(target_arch = "wasm32"))]
            Job::Thread(job) => {
                // A panic of the thread was already printed; the sea goes on without the waves of its coast.
                let is_over = job.thread.as_ref().is_some_and(std::thread::JoinHandle::is_finished);
                is_over.then(|| job.thread.take().and_then(|thread| thread.join().ok().flatten()))
            }
        };
        let Some(solved) = solved else { return };
        let Some(Work { key, .. }) = self.work.take() else { return };
        let Some(transfer) = solved.map(Arc::new) else {
            self.failure =
                Some("the waves near the coast could not be computed: they run on as in the open sea".into());
            return;
        };
        self.kept.push((key.clone(), transfer.clone()));
        let bytes = |kept: &[(CoastKey, Arc<Transfer>)]| kept.iter().map(|(_, t)| 4 * t.envelopes.len()).sum::<usize>();
        while self.kept.len() > 1 && bytes(&self.kept) > MAX_KEPT_BYTES {
            self.kept.remove(0);
        }
        self.shown = Some((key, transfer));
    }
}

/// Solves the transfer functions of the sea of `params` over `land` at once, without a running sea.
pub fn solve_at_once<S: StepwiseSolver>(params: &Params, land: &PlacedCoast) -> Transfer {
    let mut solver = S::begin(&Plan::new(params), land);
    while solver.step() < 1.0 {}
    solver.finish()
}
