//! Random and extreme states go through all passes, from the spectrum to the picture: maps hold finite numbers, no
//! pixel is magenta (the last pass paints pixels magenta that are not a number), wgpu reports no error (an error
//! panics), and a link brings the state back unchanged.

mod common;

use common::{gpu, params, read};
use seastate::gpu::Gpu;
use seastate::ocean::still::{PICTURE_FORMAT, present_and_read_back};
use seastate::ocean::{Ocean, OutputKind};
use seastate::shaders::Shaders;
use seastate::sim::Simulation;
use seastate::state::fields::{FIELDS, Field, FieldKind};
use seastate::state::{Params, query};
use seastate::waves::Plan;
use seastate::waves::noise::pcg4d;
use std::collections::BTreeMap;

const SIZE: [u32; 2] = [48, 32];

/// Least and greatest value of a field.
fn ends(field: &Field) -> [f64; 2] {
    match field.kind {
        FieldKind::Number { min, max, .. } => [min, max],
        FieldKind::Heading => [0.0, 359.99],
        FieldKind::Integer { min, max } => [f64::from(min), f64::from(max)],
        FieldKind::Choice(words) => [0.0, words.len() as f64 - 1.0],
        FieldKind::Flag => [0.0, 1.0],
        FieldKind::Colour => [0.0, f64::from(0x00ff_ffff)],
    }
}

/// The state with a number. Odd numbers give random states. Even numbers give states with values at an end of their
/// range: from a single value, of each field in turn at either end, up to nearly all values.
fn state(number: u32) -> Params {
    let mut p = if number.is_multiple_of(2) { params("n=64") } else { common::random_params("n=64", number) };
    if number.is_multiple_of(2) {
        let fields = FIELDS.len() as u32;
        let (turn, end) = (number / 2 % fields, number / 2 / fields % 2);
        let share = number / 2 / fields / 2 % 5;
        for (j, field) in (0..).zip(FIELDS.iter()) {
            let dice = pcg4d([number, j, 5, 55]);
            let chosen = if j == turn { Some(end) } else { (dice[0] % 5 < share).then_some(dice[1] % 2) };
            if let Some(end) = chosen {
                (field.set)(&mut p, ends(field)[end as usize]);
            }
        }
    }
    // Larger lattices only add waves, and take more time.
    p.grid.n = if number % 16 < 14 { 64 } else { 128 };
    p
}

struct Lab {
    gpu: Gpu,
    /// One for each lattice size and number of cascades, so that passes are compiled once.
    seas: BTreeMap<(u32, usize), (Simulation, Ocean)>,
}

impl Lab {
    /// The fault of a state, if it has one.
    fn fault(&mut self, p: &Params, solves_coast: bool) -> Option<String> {
        let gpu = &self.gpu;
        let plan = Plan::new(p);
        let link = query::write(p);
        if query::parse(&link) != (p.clone(), vec![]) {
            return Some("changes in its link".to_owned());
        }
        let make = || {
            let sim = Simulation::new(gpu, plan.clone(), &Shaders::default());
            (sim, Ocean::new(gpu, PICTURE_FORMAT, OutputKind::Screen, p))
        };
        let (sim, ocean) = self.seas.entry((plan.n, plan.cascades.len())).or_insert_with(make);
        sim.set_plan(gpu, plan, &Shaders::default());
        let maps = read(&self.gpu, sim, p.clock.t_s);
        let infinite = maps.texels.iter().flatten().filter(|v| !v.is_finite()).count();
        if infinite > 0 {
            return Some(format!("has {infinite} numbers in its maps that are not finite"));
        }
        ocean.set_params(p);
        if solves_coast {
            ocean.solve_coast();
        } else {
            ocean.show_coast(Default::default());
        }
        let mut encoder = gpu.encoder("test");
        // A few steps of the foam are enough to break a picture.
        ocean.record_frame(&mut encoder, SIZE, 3);
        let drawn = pollster::block_on(present_and_read_back(&self.gpu, encoder, SIZE, |pass| ocean.present(pass)));
        let pixels = drawn.expect("a picture");
        let broken = pixels.chunks(4).filter(|p| p[0] > 250 && p[1] < 5 && p[2] > 250).count();
        (broken > 0).then(|| format!("has {broken} broken pixels"))
    }
}

/// The faults of the states with the given numbers.
fn faults(numbers: impl Iterator<Item = u32>) -> Vec<String> {
    let mut lab = Lab { gpu: gpu(), seas: BTreeMap::new() };
    let fault = |number| {
        let p = state(number);
        // A coast takes seconds to solve.
        let text = format!("state {number} {}: {}", lab.fault(&p, number % 5 == 0)?, query::write(&p));
        eprintln!("{text}");
        Some(text)
    };
    numbers.filter_map(fault).collect()
}

#[test]
fn extreme_states_are_drawn() {
    // A sample of the states of the long test.
    assert_eq!(faults((0..36).map(|i| i * 139 % 5000)), Vec::<String>::new());
}

#[test]
#[ignore = "takes half an hour on a software GPU"]
fn five_thousand_states_are_drawn() {
    assert_eq!(faults(0..5000), Vec::<String>::new());
}

#[test]
fn every_field_has_its_turn_at_both_ends() {
    for (j, field) in FIELDS.iter().enumerate().filter(|(_, f)| f.key != "n") {
        for (end, value) in (0..).zip(ends(field)) {
            let number = 2 * (j + end * FIELDS.len()) as u32;
            assert!(number < 5000 && (field.get)(&state(number)) == value, "{} = {value}", field.key);
        }
    }
}
