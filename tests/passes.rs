//! Each GPU pass against its f64 twin, for every FFT size and several seas, and that planted faults are found.

mod common;

use seastate::bench::stagewise_fft::StagewiseFft;
use seastate::gpu::Gpu;
use seastate::gpu::map_format::MapFormat;
use seastate::gpu::readback;
use seastate::lab::check::{self, Comparison};
use seastate::shaders::Shaders;
use seastate::sim::Simulation;
use seastate::sim::resources::MapKind;
use seastate::sim::transform::FftImplementation;
use seastate::state::query;
use seastate::waves::Plan;

/// A sea of densities over 24 directions, of which the shortest waves come from another side than the longest.
const TABULATED: &str = "spectrum=measured&measured=d*24*7.5_\
    0.05*0.5*AAAAAAAAAAAAAAAAAAAAAAAAAAAVFogK..tZLWA9ACAAAAAA_\
    0.1*3*AAAAAAACBTNNhDU6DTAIAFAzE8SNqS....qSSNE8AzAFAAAA_\
    0.2*1*AAAAAAAAADAwITfwmedLk6y09I..6YuRflSTIxDXA9AMABAA_\
    0.4*0.1*AAABANBHDbH1OpXsiOs92a9H..-i5BwVl2bGRcJ1EpBsAZAC";

/// How an adapter computes the waves.
type Kind = (FftImplementation, MapFormat);
const GPU: Kind = (FftImplementation::Workgroup, MapFormat::Half);
/// A software adapter that filters float textures.
const SOFTWARE: Kind = (FftImplementation::Unrolled, MapFormat::Float);
/// llvmpipe, and software adapters that cannot filter float textures.
const LLVMPIPE: Kind = (FftImplementation::Unrolled, MapFormat::Half);

fn run(state: &str, (implementation, format): Kind, shaders: Shaders) -> Vec<Comparison> {
    // This device can filter both formats.
    let gpu = common::gpu_with(MapFormat::Float);
    let shaders = shaders.with_map_format(format);
    pollster::block_on(check::run_with(&gpu, &query::parse(state).0, &shaders, implementation)).expect("read-back")
}

fn assert_right(state: &str, kind: Kind) {
    let lines = run(state, kind, Shaders::default());
    let table: Vec<String> = lines.iter().map(ToString::to_string).collect();
    eprintln!("{state} {kind:?}\n{}", table.join("\n"));
    assert!(lines.iter().all(Comparison::passes), "{state} {kind:?}\n{}", table.join("\n"));
}

#[test]
fn every_size_agrees_with_the_oracle() {
    for n in [64, 128, 256] {
        for kind in [GPU, SOFTWARE, LLVMPIPE] {
            assert_right(&format!("wind=10&fetch=100&t=20&n={n}"), kind);
        }
    }
}

#[test]
fn large_sizes_agree_with_the_oracle() {
    for n in [512, 1024] {
        for kind in [GPU, SOFTWARE, LLVMPIPE] {
            assert_right(&format!("wind=10&fetch=100&t=20&n={n}&cascades=1"), kind);
        }
    }
}

/// Four wave systems of three lobes each, the most that a sea can have: Elfouhaily's spreading blended with another.
const FOUR_SYSTEMS: &str = "wind=12&spread=elfouhaily&blendto=hasselmann&blend=0.4&iso=0.1\
    &scale2=1&spread2=elfouhaily&blendto2=cos2-positive&blend2=0.3&scale3=1&spread3=mitsuyasu&blendto3=elfouhaily&blend3=0.6\
    &scale4=1&spread4=donelan-banner&blendto4=elfouhaily&blend4=0.5&spectrum4=pm&t=77";

#[test]
fn four_systems_have_twelve_terms() {
    let terms = |state: &str| seastate::waves::table::directional_terms(&Plan::new(&query::parse(state).0)).0.len();
    assert_eq!(terms(FOUR_SYSTEMS), seastate::waves::system::MAX_SPECTRUM_TERMS);
    assert_eq!(terms("spread=elfouhaily&blendto=elfouhaily&blend=0.5"), 2, "a blend with itself");
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
        FOUR_SYSTEMS,
        TABULATED,
        "spectrum=measured&measured=0.05*0.5*250*251*0.8*0.5_0.1*3*240*241*0.7*0.4_0.2*1*200*230*0.5*0.2_0.4*0.1*190*190*0.4*0.1",
    ] {
        assert_right(&format!("{state}&n=64"), SOFTWARE);
    }
}

#[test]
fn the_waves_at_a_coast_agree_with_the_oracle() {
    for (n, kind) in [(64, GPU), (128, GPU), (64, SOFTWARE), (64, LLVMPIPE), (128, LLVMPIPE)] {
        assert_right(&format!("wind=10&fetch=100&t=20&coast=beach&n={n}"), kind);
    }
}

#[test]
fn a_fault_in_the_waves_at_a_coast_is_found() {
    for (module, from, to, red) in [
        ("coast/phasors", "a.x * cs.x + a.y * cs.y", "a.x * cs.x + 1.01 * a.y * cs.y", "coast displacement"),
        ("coast/envelopes", "potential += phasor.z", "potential += 1.01 * phasor.z", "coast gradients"),
        ("coast/sum", "2.0 * z.x + known.x", "2.02 * z.x + known.x", "coast displacement"),
        ("coast/sum", "let turns = beyond", "let turns = 1.01 * beyond", "coast displacement"),
        ("coast/sum", "vec4f(z, 4.0", "vec4f(1.01 * z, 4.0", "coast phases"),
        ("coast/sum", "4.0 * length(z) * known.y, known.z", "4.04 * length(z) * known.y, known.z", "coast breaking"),
        ("coast/sum", "known.y, known.z", "known.y, 1.01 * known.z", "coast depth"),
        ("coast/gradients", "vec4f(1.0, -8.0, 8.0, -1.0)", "vec4f(1.0, -8.0, 8.08, -1.0)", "coast gradients"),
        ("coast/gradients", "vec4f(-1.0, 16.0, 16.0, -1.0)", "vec4f(-1.0, 16.16, 16.0, -1.0)", "coast gradients"),
    ] {
        let shaders = Shaders::default().patched(module, from, to);
        let lines = run("wind=15&fetch=300&t=5&n=64&coast=beach", LLVMPIPE, shaders);
        let found = lines.iter().filter(|l| !l.passes()).map(|l| l.pass_and_quantity).collect::<Vec<_>>();
        assert!(found.contains(&red), "\"{to}\" in {module} went unseen: {found:?}");
    }
}

/// One fault of 1 % in each kernel: the adapter, the module, the text that is replaced, its replacement, and the
/// beginning of a line that must fail.
const FAULTS: &[(Kind, &str, &str, &str, &str)] = &[
    (GPU, "waves/spectrum", "h = gauss * sqrt(variance)", "h = 1.01 * gauss * sqrt(variance)", "spectrum"),
    (SOFTWARE, "waves/spectrum", "h = gauss * sqrt(variance)", "h = 1.01 * gauss * sqrt(variance)", "spectrum"),
    (GPU, "foam/foam", "let l = sea.choppiness;", "let l = 1.01 * sea.choppiness;", "foam"),
    (SOFTWARE, "foam/foam", "let l = sea.choppiness;", "let l = 1.01 * sea.choppiness;", "foam"),
    (
        GPU,
        "waves/mips",
        "0.25 * sum.gradients, 0.25 * sum.moments);\n      mips_store",
        "0.25 * sum.gradients, 0.2525 * sum.moments);\n      mips_store",
        "mips moments",
    ),
    (
        GPU,
        "waves/mips",
        "return MipTexels(0.25 * sum.displacement, 0.25",
        "return MipTexels(0.25 * sum.displacement, 0.2525",
        "mips gradients",
    ),
    (SOFTWARE, "waves/unrolled_mips", "0.25 * sum.moments)", "0.2525 * sum.moments)", "mips moments"),
    (SOFTWARE, "waves/unrolled_mips", "MipTexels(0.25", "MipTexels(0.2525", "mips displacement"),
    (GPU, "waves/rows", "forward + backward", "forward + 1.01 * backward", "rows"),
    (
        GPU,
        "waves/columns",
        "    row_transforms[(2u * c * N + z) * N + x] = v",
        "    row_transforms[(2u * c * N + z) * N + x] = 1.01 * v",
        "columns",
    ),
    (GPU, "waves/columns", "c, v.xzyw)", "c, 1.01 * v.xzyw)", "maps"),
    (SOFTWARE, "waves/unrolled_rows_first", "forward + backward", "forward + 1.01 * backward", "rows"),
    (SOFTWARE, "waves/unrolled_rows_second", "v * w.x", "1.01 * v * w.x", "rows"),
    (SOFTWARE, "waves/unrolled_columns_first", "v * w.x", "1.01 * v * w.x", "columns"),
    (SOFTWARE, "waves/unrolled_columns_second", "* N + x] = value", "* N + x] = 1.01 * value", "columns"),
    (SOFTWARE, "waves/unrolled_columns_second", "map_texel(value)", "map_texel(1.01 * value)", "maps"),
    (LLVMPIPE, "waves/unrolled_columns_second", "map_texel(value)", "map_texel(1.01 * value)", "maps"),
];

#[test]
fn the_last_of_twelve_terms_counts() {
    let short = Shaders::default().patched("waves/spectrum", "i < sea.term_count", "i < min(sea.term_count, 11u)");
    let lines = run(&format!("{FOUR_SYSTEMS}&n=64"), SOFTWARE, short);
    assert!(lines.iter().any(|line| !line.passes() && line.pass_and_quantity.starts_with("spectrum")));
}

#[test]
fn a_planted_fault_of_one_per_cent_is_found() {
    let state = "wind=15&fetch=300&t=5&n=64";
    for &(kind, module, from, to, red) in FAULTS {
        let lines = run(state, kind, Shaders::default().patched(module, from, to));
        let found = lines.iter().filter(|l| !l.passes()).map(|l| l.pass_and_quantity).collect::<Vec<_>>();
        assert!(found.iter().any(|what| what.starts_with(red)), "\"{to}\" in {module} went unseen: {found:?}");
    }
}

#[test]
fn a_fault_in_tabulated_directions_is_found() {
    for (from, to) in [
        // One band weighs 1 % more.
        ("weights[i] * row[b] *", "weights[i] * (row[b] + 0.01 * row.y * f32(b)) *"),
        // All directions turn by a hundredth of a step.
        ("- (head.y - first);", "- (head.y - first) + 0.01;"),
        // The mean is taken over an angle that is 1 % too wide.
        ("let width = head.x *", "let width = 1.01 * head.x *"),
    ] {
        let lines = run(&format!("{TABULATED}&n=64"), SOFTWARE, Shaders::default().patched("waves/spectrum", from, to));
        let found = lines.iter().any(|l| !l.passes() && l.pass_and_quantity.starts_with("spectrum"));
        assert!(found, "\"{to}\" went unseen");
    }
}

#[test]
fn a_gpu_gets_few_dispatches_whatever_the_cascades() {
    let gpu = pollster::block_on(Gpu::request()).expect("a GPU adapter");
    for (n, cascades) in [(64, 1), (128, 4), (256, 3), (512, 4), (1024, 1)] {
        let params = query::parse(&format!("n={n}&cascades={cascades}")).0;
        let sim = Simulation::with_fft_implementation(
            &gpu,
            Plan::new(&params),
            &Shaders::default(),
            FftImplementation::Workgroup,
        );
        assert!(sim.passes.dispatch_count() <= 5, "n {n}, {cascades} cascades: {}", sim.passes.dispatch_count());
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
        let theirs = StagewiseFft::new(&gpu, sim.maps());
        assert_eq!(theirs.dispatch_count() as u32, 2 * (4 * 2 * n.ilog2() + 2));
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
                let layer = sim.resources.layers_of_kind(ours).start + cascade as u32;
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
