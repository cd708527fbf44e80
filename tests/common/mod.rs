//! What the tests on the GPU share.
#![allow(dead_code, reason = "every test crate uses some of it")]

pub mod harness;
pub mod skies;
pub mod wgsl;

use seastate::coast::transfer::{TransferLimits, TransferSolver};
use seastate::coast::{PlacedCoast, Transfer};
use seastate::files::measured::{DirectionalParameters, MeasuredSpectrum};
use seastate::gpu::map_format::MapFormat;
use seastate::gpu::{Gpu, device};
use seastate::ocean::still::{PICTURE_FORMAT, draw_ocean_picture};
use seastate::ocean::{Ocean, OutputKind};
use seastate::shaders::Shaders;
use seastate::sim::{MapsF32, Simulation};
use seastate::state::fields::{FIELDS, FieldKind};
use seastate::state::{Params, query};
use seastate::waves::Plan;
use seastate::waves::noise::pcg4d;
use std::f64::consts::TAU;
use std::sync::Arc;

pub fn gpu() -> Gpu {
    pollster::block_on(Gpu::request()).expect("a GPU adapter; install mesa-vulkan-drivers")
}

/// A device on which maps have this format, whichever would be chosen.
pub fn gpu_with(maps: MapFormat) -> Gpu {
    let adapter = pollster::block_on(device::choose_adapter()).expect("a GPU adapter; install mesa-vulkan-drivers");
    let mut descriptor = device::device_descriptor(&adapter);
    descriptor.required_features.set(MapFormat::FILTERABLE_FLOATS, maps == MapFormat::Float);
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).expect("a device");
    let gpu = Gpu { device, queue };
    assert_eq!(MapFormat::for_device(&gpu), maps);
    gpu
}

/// The parameters of a state without mistakes in it.
pub fn params(state: &str) -> Params {
    let (params, notices) = query::parse(state);
    assert_eq!(notices, Vec::<String>::new(), "{state}");
    params
}

/// Parameters of a state with its frequency spectrum, whose waves travel east with a directional spread of `spread_deg`.
pub fn travelling_east(state: &str, spread_deg: f64) -> Params {
    let mut params = params(state);
    let plan = Plan::new(&params);
    let peak_hz = plan.omega_p / TAU;
    // From half the peak frequency to four times it.
    let bands: Vec<(f64, f64)> = (0..200)
        .map(|i| {
            let f = peak_hz * 8.0f64.powf(f64::from(i) / 199.0) * 0.5;
            (f, TAU * plan.density(TAU * f))
        })
        .collect();
    let east = DirectionalParameters::from_spread(270.0, spread_deg);
    let measured = MeasuredSpectrum::new(&bands, Some(&vec![east; bands.len()])).expect("a spectrum");
    params.sea.set_measured_spectrum(measured);
    params
}

/// Renders one state after another on the same device: passes are compiled once.
pub struct Pictures {
    pub gpu: Gpu,
    ocean: Option<Ocean>,
}

impl Default for Pictures {
    fn default() -> Self {
        Self { gpu: gpu(), ocean: None }
    }
}

impl Pictures {
    /// The pixels of a state, which depend on it alone: time, sea or place are others than before, and the foam starts
    /// anew.
    pub fn render(&mut self, params: &Params, size: [u32; 2]) -> Vec<[u8; 4]> {
        let gpu = &self.gpu;
        let ocean = self.ocean.get_or_insert_with(|| Ocean::new(gpu, PICTURE_FORMAT, OutputKind::Screen, params));
        ocean.set_params(params);
        let bytes = pollster::block_on(draw_ocean_picture(&self.gpu, ocean, size)).expect("a picture");
        bytes.chunks(4).map(|p| [p[0], p[1], p[2], p[3]]).collect()
    }
}

/// The waves at the coast of a sea: of `max_waves` components, solved on a grid of `points` a side.
pub fn coast_transfer(params: &Params, max_waves: usize, points: usize) -> Arc<Transfer> {
    let coast = PlacedCoast::of_state(&params.coast, None).expect("a coast").expect("a place");
    let limits = TransferLimits { max_waves, points, ..TransferLimits::default() };
    Arc::new(TransferSolver::new(&Plan::new(params), &coast, &limits).finish())
}

/// A sea with the waves at its coast, whose maps are those of the time `t_s` around `eye` (x, z), m. The foam has made
/// one time step, so that the map of foam lies around the eye.
pub fn ocean_at_coast(gpu: &Gpu, state: &str, transfer: &Arc<Transfer>, eye: [f64; 2], t_s: f64) -> Ocean {
    let mut params = params(state);
    (params.camera.x_m, params.camera.z_m) = (eye[0], eye[1]);
    let mut ocean = Ocean::new(gpu, PICTURE_FORMAT, OutputKind::Screen, &params);
    assert!(ocean.set_coast(Some(transfer.clone())));
    let mut encoder = gpu.encoder("test");
    ocean.simulation().encode(gpu, &mut encoder, t_s, eye, 1);
    gpu.submit(encoder);
    ocean
}

pub fn simulation(gpu: &Gpu, state: &str) -> Simulation {
    Simulation::new(gpu, Plan::new(&params(state)), &Shaders::default())
}

pub fn read(gpu: &Gpu, sim: &mut Simulation, t_s: f64) -> MapsF32 {
    pollster::block_on(sim.read_maps_f32(gpu, t_s)).expect("read-back")
}

/// The maps of a state at a time, in f32.
pub fn maps(gpu: &Gpu, state: &str, t_s: f64) -> MapsF32 {
    read(gpu, &mut simulation(gpu, state), t_s)
}

/// A random state within the ranges of all fields but `n`; the same for the same number.
pub fn random_params(start: &str, number: u32) -> Params {
    let mut p = params(start);
    for (j, field) in (0..).zip(FIELDS.iter()) {
        let dice = pcg4d([number, j, 77, 3]);
        let u = f64::from(dice[0]) / f64::from(u32::MAX);
        // A third of the values stay at their defaults, so that not every state is absurd.
        if dice[1].is_multiple_of(3) || field.key == "n" {
            continue;
        }
        let value = match field.kind {
            FieldKind::Number { min, max, log: true } => min * (max / min).powf(u),
            FieldKind::Number { min, max, .. } if dice[1] % 3 == 1 => min + (max - min) * u,
            // Ranges from 0 upwards hold most of what is interesting near 0.
            FieldKind::Number { min, max, .. } => min + (max - min) * u.powi(6),
            FieldKind::Integer { min, max } => (f64::from(min) + (f64::from(max) - f64::from(min)) * u).round(),
            FieldKind::Choice(words) => (u * words.len() as f64).floor().min(words.len() as f64 - 1.0),
            FieldKind::Heading => 359.9 * u,
            FieldKind::Flag => u.round(),
            FieldKind::Colour => (u * f64::from(0x0100_0000)).floor(),
        };
        (field.set)(&mut p, field.check_value(value).unwrap_or(field.default_value()));
    }
    p
}

/// Binds the maps of a simulation to the kernel of a module of the water.
pub fn bind_maps<const Q: usize, const A: usize>(kernel: &mut wgsl::Kernel<Q, A>, gpu: &Gpu, sim: &Simulation) {
    use wgpu::BindingResource::{Sampler, TextureView};
    let levels = gpu.sampler("levels", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Nearest);
    let maps = sim.maps();
    let resources = [
        (0, TextureView(&maps.displacement)),
        (1, TextureView(&maps.gradients)),
        (2, TextureView(&maps.slope_moments)),
        (4, Sampler(&sim.resources.repeating_sampler)),
        (5, Sampler(&levels)),
        (6, TextureView(&maps.no_coast)),
    ];
    kernel.bind(1, &resources);
}
