//! What the tests on the GPU share.
#![allow(dead_code, reason = "every test crate uses some of it")]

use seastate::gpu::device::Gpu;
use seastate::gpu::shaders::Shaders;
use seastate::model::{Params, Plan, query};
use seastate::sim::{MapsF32, Simulation};

pub fn gpu() -> Gpu {
    pollster::block_on(Gpu::request()).expect("a GPU adapter; install mesa-vulkan-drivers")
}

/// The parameters of a state without mistakes in it.
pub fn params(state: &str) -> Params {
    let (params, notices) = query::parse(state);
    assert_eq!(notices, Vec::<String>::new(), "{state}");
    params
}

pub fn simulation(gpu: &Gpu, state: &str) -> Simulation {
    Simulation::new(&gpu.device, &gpu.queue, Plan::new(&params(state)), &Shaders::default())
}

pub fn read(gpu: &Gpu, sim: &mut Simulation, t_s: f64) -> MapsF32 {
    pollster::block_on(sim.read_f32(&gpu.device, &gpu.queue, t_s)).expect("read-back")
}

/// The maps of a state at a time, in f32.
pub fn maps(gpu: &Gpu, state: &str, t_s: f64) -> MapsF32 {
    read(gpu, &mut simulation(gpu, state), t_s)
}
