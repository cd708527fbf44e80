//! Tests of the task that solves a coast, with a solver of ten steps.

use super::*;
use crate::state::query;

/// A solver whose solution tells the sea and the coast that it was made for, after ten steps.
struct TenSteps {
    steps: usize,
    transfer: Transfer,
}

impl StepwiseSolver for TenSteps {
    fn begin(plan: &Plan, coast: &PlacedCoast) -> Self {
        let mut transfer = Transfer { cell_m: plan.sea.depth_m, placement: coast.placement(), ..empty() };
        transfer.lattice.seed = plan.sea.seed;
        Self { steps: 0, transfer }
    }

    fn step(&mut self) -> f32 {
        assert!(self.transfer.lattice.seed != 13, "this sea cannot be solved");
        self.steps += 1;
        self.steps as f32 / 10.0
    }

    fn finish(self) -> Transfer {
        self.transfer
    }
}

fn empty() -> Transfer {
    Transfer {
        placement: PlacedCoast::of_state(&query::parse("coast=bar").0.coast, None).unwrap().unwrap().placement(),
        columns: 0,
        rows: 0,
        cell_m: 0.0,
        open_from_m: 0.0,
        lattice: Default::default(),
        waves: vec![],
        groups: vec![],
        envelopes: vec![],
        points: vec![],
    }
}

fn params(state: &str) -> Params {
    query::parse(state).0
}

/// A task that does one step in each call.
fn step_by_step() -> CoastTask<TenSteps> {
    CoastTask::new(Worker::EachCall)
}

#[test]
fn a_coast_is_solved_over_frames_and_kept() {
    let (mut task, bar) = (step_by_step(), params("coast=bar&depth=12&n=64"));
    task.update(&bar, 0.0, Duration::ZERO);
    assert!(task.land().is_some() && task.transfer().is_none() && task.is_busy(&bar));
    assert_eq!(task.progress(), Some(0.1));
    for frame in 1..10 {
        assert!(task.transfer().is_none(), "frame {frame}");
        task.update(&bar, 0.0, Duration::ZERO);
    }
    let first = task.transfer().expect("a solution").clone();
    assert_eq!((first.cell_m, task.progress(), task.is_busy(&bar)), (12.0, None, false));
    // Light, time and the shape of crests need no other solution; a view neither.
    task.update(&params("coast=bar&depth=12&n=64&sun=3&t=9&chop=0.5&foamdecay=2&view=height"), 0.0, Duration::ZERO);
    assert!(Arc::ptr_eq(task.transfer().expect("the same"), &first) && task.progress().is_none());
    // Another depth glides first, with the old solution, and begins when it rests.
    let deeper = params("coast=bar&depth=14&n=64");
    for now_s in [1.0, 1.2] {
        task.update(&deeper, now_s, Duration::ZERO);
        assert!(task.progress().is_none() && task.is_busy(&deeper));
        assert!(Arc::ptr_eq(task.transfer().expect("the old one"), &first));
    }
    (0..10).for_each(|_| task.update(&deeper, 1.5, Duration::ZERO));
    assert_eq!(task.transfer().expect("a solution").cell_m, 14.0);
    // The way back is known.
    task.update(&bar, 2.0, Duration::ZERO);
    assert!(Arc::ptr_eq(task.transfer().expect("the kept one"), &first) && !task.is_busy(&bar));
}

#[test]
fn another_coast_has_no_waves_of_the_old_one() {
    let mut task = step_by_step();
    (0..10).for_each(|_| task.update(&params("coast=bar&n=64"), 0.0, Duration::ZERO));
    assert!(task.transfer().is_some());
    let island = params("coast=island&n=64");
    task.update(&island, 1.0, Duration::ZERO);
    assert!(task.transfer().is_none() && task.land().expect("land").title.contains("Island"));
    // A sea that changes again and again is not begun.
    for frame in 0..30 {
        task.update(
            &params(&format!("coast=island&n=64&wind={}", 5 + frame)),
            1.0 + 0.1 * f64::from(frame),
            Duration::ZERO,
        );
        assert!(task.progress().is_none());
    }
    // A solution that is under way is left when the sea is open, or another.
    task.update(&params("coast=island&n=64&wind=34"), 9.0, Duration::ZERO);
    assert!(task.progress().is_some());
    task.update(&params("n=64"), 9.0, Duration::ZERO);
    assert!(task.land().is_none() && task.progress().is_none() && !task.is_busy(&params("n=64")));
    assert!(task.notices().is_empty());
}

#[test]
fn what_cannot_be_placed_or_solved_is_said() {
    let mut task = step_by_step();
    let file = params("coast=file");
    task.update(&file, 0.0, Duration::ZERO);
    assert!(task.land().is_none() && !task.is_busy(&file));
    assert!(task.notices().len() == 1 && task.notices()[0].contains("--bathymetry"), "{:?}", task.notices());
}

#[cfg(not(target_arch = "wasm32"))]
#[test]
fn a_thread_solves_and_may_fail() {
    let mut task = CoastTask::<TenSteps>::new(Worker::Thread);
    let wait = |task: &mut CoastTask<TenSteps>, params: &Params| {
        while task.is_busy(params) {
            task.update(params, 0.0, Duration::ZERO);
            std::thread::yield_now();
        }
    };
    let bar = params("coast=bar&depth=9&n=64");
    task.update(&bar, 0.0, Duration::ZERO);
    wait(&mut task, &bar);
    assert_eq!(task.transfer().expect("a solution").cell_m, 9.0);
    let mut failing = CoastTask::<TenSteps>::new(Worker::Thread);
    let unlucky = params("coast=bar&seed=13&n=64");
    failing.update(&unlucky, 0.0, Duration::ZERO);
    wait(&mut failing, &unlucky);
    assert!(failing.transfer().is_none() && failing.land().is_some());
    assert_eq!(failing.notices().len(), 1);
    assert_eq!(solve_at_once::<TenSteps>(&bar, task.land().expect("land")).cell_m, 9.0);
}
