//! Each GPU pass against its f64 twin, for every FFT size and several seas, and that planted faults are found.

mod common;

use seastate::bench::per_stage::PerStage;
use seastate::gpu::Gpu;
use seastate::gpu::map_format::MapFormat;
use seastate::gpu::readback;
use seastate::lab::check::{self, Line};
use seastate::shaders::Shaders;
use seastate::shaders::fft::Way;
use seastate::sim::Simulation;
use seastate::sim::resources::MapKind;
use seastate::state::query;
use seastate::waves::Plan;

fn run(state: &str, shaders: &Shaders) -> Vec<Line> {
    // It can read maps of either format.
    let gpu = common::gpu_with(MapFormat::Float);
    pollster::block_on(check::run(&gpu, &query::parse(state).0, shaders)).expect("read-back")
}

fn assert_right(state: &str, (way, maps): (Way, MapFormat)) {
    let lines = run(state, &Shaders::default().with_way(way).with_maps(maps));
    let table: Vec<String> = lines.iter().map(ToString::to_string).collect();
    eprintln!("{state} {way:?} {maps:?}\n{}", table.join("\n"));
    assert!(lines.iter().all(Line::passes), "{state} {way:?} {maps:?}\n{}", table.join("\n"));
}

const GPU: (Way, MapFormat) = (Way::Exchanged, MapFormat::Half);
const CPU: (Way, MapFormat) = (Way::Straight, MapFormat::Float);
/// An adapter that is a CPU and cannot filter floats.
const OLD_CPU: (Way, MapFormat) = (Way::Straight, MapFormat::Half);

#[test]
fn every_size_agrees_with_the_oracle() {
    for n in [64, 128, 256] {
        [GPU, CPU, OLD_CPU, LLVMPIPE]
            .into_iter()
            .for_each(|kind| assert_right(&format!("wind=10&fetch=100&t=20&n={n}"), kind));
    }
}

#[test]
fn large_sizes_agree_with_the_oracle() {
    for n in [512, 1024] {
        [GPU, CPU, LLVMPIPE]
            .into_iter()
            .for_each(|kind| assert_right(&format!("wind=10&fetch=100&t=20&n={n}&cascades=1"), kind));
    }
}

#[test]
fn other_seas_agree_with_the_oracle() {
    for state in [
        "spectrum=tma&depth=5&wind=15&t=3600&swell=0.5",
        "spread=hasselmann&wind=25&fetch=800&t=100000.25&dir=13",
        "spread=mitsuyasu&swell=1&loop=60&t=59.9&chop=0.7",
        "spread=isotropic&spectrum=pm&wind=3&g=3.71",
        "spectrum=elfouhaily&spread=elfouhaily&swell=0.4&dispersion=capillary&cascades=3&patch3=0.7&chopx=0.5&chopz=1.3",
        "spread=cos2-positive&blendto=hasselmann&blend=0.4&iso=0.2&scale2=1&hs2=2&tp2=12&dir2=310&overlap=1",
        "spectrum=measured&measured=0.05*0.5*250*251*0.8*0.5_0.1*3*240*241*0.7*0.4_0.2*1*200*230*0.5*0.2_0.4*0.1*190*190*0.4*0.1",
    ] {
        assert_right(&format!("{state}&n=64"), CPU);
    }
}

/// llvmpipe.
const LLVMPIPE: (Way, MapFormat) = (Way::Merged, MapFormat::Half);

/// One fault of 1 % in each pass: where it stands, and which lines must turn red.
const FAULTS: &[(&str, &str, &str, &str)] = &[
    ("spectrum", "h = gauss * sqrt(variance)", "h = 1.01 * gauss * sqrt(variance)", "spectrum"),
    ("foam/foam", "let l = sea.chop;", "let l = 1.01 * sea.chop;", "foam"),
];

/// The same in what differs between adapters.
const FAULTS_OF_A_WAY: &[((Way, MapFormat), &str, &str, &str, &str)] = &[
    (
        GPU,
        "mips_chain",
        "0.25 * sum.gradients, 0.25 * sum.moments);\n      mips_store",
        "0.25 * sum.gradients, 0.2525 * sum.moments);\n      mips_store",
        "mips moments",
    ),
    (
        GPU,
        "mips_chain",
        "return MipsTexel(0.25 * sum.displacement, 0.25",
        "return MipsTexel(0.25 * sum.displacement, 0.2525",
        "mips gradients",
    ),
    (CPU, "mips_level", "0.25 * sum.moments)", "0.2525 * sum.moments)", "mips moments"),
    (CPU, "mips_level", "MipsTexel(0.25", "MipsTexel(0.2525", "mips displacement"),
    (GPU, "rows", "forward + backward", "forward + 1.01 * backward", "rows"),
    (
        GPU,
        "columns",
        "    lines[(2u * c * N + z) * N + x] = v",
        "    lines[(2u * c * N + z) * N + x] = 1.01 * v",
        "columns",
    ),
    (GPU, "columns", "c, v.xzyw)", "c, 1.01 * v.xzyw)", "maps"),
    (CPU, "rows_first", "forward + backward", "forward + 1.01 * backward", "rows"),
    (CPU, "lines_second", "v * w.x", "1.01 * v * w.x", "rows"),
    (CPU, "columns_first", "v * w.x", "1.01 * v * w.x", "columns"),
    (CPU, "columns_second", "* N + x] = value", "* N + x] = 1.01 * value", "columns"),
    (CPU, "columns_second", "maps_texel(value)", "maps_texel(1.01 * value)", "maps"),
    (LLVMPIPE, "rows_first", "forward + backward", "forward + 1.01 * backward", "waves"),
    (LLVMPIPE, "middle", "v * w.x", "1.01 * v * w.x", "waves"),
    (LLVMPIPE, "columns_last", "* N + x] = value", "* N + x] = 1.01 * value", "waves"),
    (LLVMPIPE, "columns_last", "maps_texel(value)", "maps_texel(1.01 * value)", "maps"),
];

#[test]
fn a_planted_fault_of_one_per_cent_is_found() {
    let state = "wind=15&fetch=300&t=5&n=64";
    let assert_found = |shaders: Shaders, red: &str, fault: &str| {
        let lines = run(state, &shaders);
        let found = lines.iter().filter(|l| !l.passes()).map(|l| l.what).collect::<Vec<_>>();
        assert!(found.iter().any(|what| what.starts_with(red)), "\"{fault}\" went unseen: {found:?}");
    };
    for (module, from, to, red) in FAULTS {
        assert_found(Shaders::default().patched(module, from, to), red, to);
    }
    for ((way, maps), module, from, to, red) in FAULTS_OF_A_WAY {
        assert_found(Shaders::default().with_way(*way).with_maps(*maps).patched(module, from, to), red, to);
    }
}

#[test]
fn a_gpu_gets_few_dispatches_whatever_the_cascades() {
    let gpu = pollster::block_on(Gpu::request()).expect("a GPU adapter");
    for (n, cascades) in [(64, 1), (128, 4), (256, 3), (512, 4), (1024, 1)] {
        let params = query::parse(&format!("n={n}&cascades={cascades}")).0;
        let shaders = Shaders::default().with_way(Way::Exchanged).with_maps(MapFormat::Half);
        let sim = Simulation::new(&gpu, Plan::new(&params), &shaders);
        assert!(sim.passes.dispatches() <= 5, "n {n}, {cascades} cascades: {}", sim.passes.dispatches());
    }
}

/// What the program is measured beside is as right as it is, for even and odd numbers of stages.
#[test]
fn the_demos_way_makes_the_same_maps() {
    let gpu = pollster::block_on(Gpu::request()).expect("a GPU adapter");
    for n in [64u32, 128] {
        let params = query::parse(&format!("wind=10&t=20&n={n}&cascades=2")).0;
        let mut sim = Simulation::new(&gpu, Plan::new(&params), &Shaders::default());
        let mut encoder = gpu.encoder("test");
        sim.encode(&gpu, &mut encoder, params.clock.t_s, [0.0; 2], 0);
        gpu.submit(encoder);
        let theirs = PerStage::new(&gpu, &sim);
        assert_eq!(theirs.dispatches() as u32, 2 * (4 * 2 * n.ilog2() + 2));
        let mut encoder = gpu.encoder("test");
        theirs.run(&mut encoder);
        gpu.submit(encoder);
        let read = |texture: &wgpu::Texture, layer: u32| -> Vec<f64> {
            let mut encoder = gpu.encoder("test");
            let copy = readback::stage_layers(&gpu, &mut encoder, texture, 0, layer..layer + 1);
            gpu.submit(encoder);
            let texels = pollster::block_on(copy.read_map(&gpu)).expect("read-back");
            texels.iter().flatten().map(|&x| f64::from(x)).collect()
        };
        for cascade in 0..2 {
            for (ours, theirs) in [
                (MapKind::Displacement, &theirs.displacement[cascade]),
                (MapKind::Gradients, &theirs.gradients[cascade]),
            ] {
                let layer = sim.resources.layers(ours).start + cascade as u32;
                let (a, b) = (read(&sim.resources.maps, layer), read(theirs, 0));
                let square = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
                let difference: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
                let error = (square(&difference) / square(&a)).sqrt();
                // Half floats, cut off by some drivers.
                assert!(square(&a) > 0.0 && error < 1e-3, "n {n}, cascade {cascade}: {error:e}");
            }
        }
    }
}
