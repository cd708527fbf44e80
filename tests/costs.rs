//! Compares the costs of the picture's shaders (src/bench/cost.rs) with what they execute when they draw the default
//! picture: rewritten shaders count their own operations and texture reads.
//!
//! `cargo test --test costs -- --nocapture` prints the constants for src/bench/cost.rs, and what each function costs.

mod common;
#[path = "costs/counter.rs"]
mod counter;
#[path = "costs/instrument.rs"]
mod instrument;

use counter::Count;
use half::f16;
use instrument::{Instrumented, Shown};
use naga::TypeInner;
use seastate::bench::cost::{self, CoastSizes, ShaderCost};
use seastate::gpu::kit::BindingType;
use seastate::gpu::map_format::MapFormat;
use seastate::gpu::offscreen::PendingPicture;
use seastate::gpu::{Gpu, readback};
use seastate::ocean::passes::planned_vertex_count;
use seastate::ocean::{Ocean, OutputKind};
use seastate::render;
use seastate::shaders::Shaders;
use seastate::state::Params;
use seastate::waves::Plan;
use wgpu::BindingResource::{Sampler, TextureView};
use wgpu::{BufferUsages, TextureFormat};

/// Size of the picture whose shaders are counted, pixels: the size for which the budgets are printed.
const SIZE_PX: [u32; 2] = [1920, 1080];

/// Cost of the light under water. No budget of the program knows it, because the picture at its start has none.
const UNDER_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 3446.8, reads: 36.4, max_ops: 6147.0, max_reads: 69.0 };

/// Costs of the light of the land, and of the water over the depths of a coast whose waves are those of the open sea.
/// The water mirrors the land, which shades it. Where the waves at the coast are drawn, a pixel of land also reads their
/// run-up.
const LAND_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 1793.4, reads: 23.6, max_ops: 2947.0, max_reads: 33.0 };
const SHALLOW_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 5565.9, reads: 66.3, max_ops: 7760.0, max_reads: 94.0 };

/// Counted operations and texture reads of a shader per pixel or vertex.
struct Executed {
    mean: Count,
    /// The most operations of a pixel or vertex, and the most reads of one.
    most: Count,
    /// Mean cost of each function alone, without those that it calls.
    functions: Vec<(String, Count)>,
}

fn text(module: &str) -> String {
    common::wgsl::shaders().all().find(|(name, _)| *name == module).expect("a module").1
}

/// The counts in a picture, in whose pixels with this tag a fragment shader shows them.
fn of_pixels(shader: &Instrumented, picture: &[[f16; 4]], tag: u8) -> Executed {
    let count = shader.functions.len();
    // For each function, then for everything: numbers of pixels, and sums of what they show.
    let mut shown = vec![[(0.0, 0.0); 2]; count + 1];
    let mut most = [0.0_f64; 2];
    for (i, pixel) in (0..).zip(picture) {
        let [high, low, of, _] = pixel.map(|channel| (255.0 * f64::from(channel)).round());
        if of != f64::from(tag) {
            continue;
        }
        let number = 256.0 * high + low;
        let Shown { function, reads } = Shown::of([i % SIZE_PX[0], i / SIZE_PX[0]], count);
        let (pixels, sum) = &mut shown[function.unwrap_or(count)][usize::from(reads)];
        (*pixels, *sum) = (*pixels + 1.0, *sum + number);
        if function.is_none() {
            most[usize::from(reads)] = most[usize::from(reads)].max(number);
        }
    }
    let means: Vec<_> = shown.iter().map(|of| Count::from(of.map(|(pixels, sum)| sum / pixels))).collect();
    Executed { mean: means[count], most: most.into(), functions: shader.functions.iter().cloned().zip(means).collect() }
}

/// Format of the canvas, and of the picture's linear light.
const FORMAT: TextureFormat = TextureFormat::Rgba16Float;

/// The default ocean, drawn with some shaders replaced.
fn ocean(gpu: &Gpu, replaced: &[(&str, &Instrumented)]) -> Ocean {
    let shaders = replaced.iter().fold(Shaders::default(), |all, (module, new)| all.replaced(module, new.text.clone()));
    Ocean::with_shaders(gpu, FORMAT, OutputKind::Screen, &Params::default(), shaders)
}

/// A picture of `size` pixels: its linear light, and the colours of a canvas of [`SIZE_PX`] that shows it.
fn picture(gpu: &Gpu, ocean: &mut Ocean, size: [u32; 2]) -> [Vec<[f16; 4]>; 2] {
    let mut encoder = gpu.encoder("counts");
    ocean.record_frame_with_complete_foam(&mut encoder, size);
    let light = readback::stage_texture(gpu, &mut encoder, ocean.lit_picture_texture().expect("a picture"), 0);
    let shown = PendingPicture::submit(gpu, encoder, FORMAT, SIZE_PX, |pass| ocean.present(pass));
    let bytes = pollster::block_on(async { [light.read(gpu).await, shown.read(gpu).await] });
    bytes.map(|bytes| bytemuck::pod_collect_to_vec(&bytes.expect("read-back")))
}

/// Counted operations and reads per vertex of the pass that displaces the mesh of a drawn picture, with the shadows that
/// waves cast on each other or without.
fn displacement(gpu: &Gpu, ocean: &Ocean, has_shadows: bool) -> Executed {
    let switch = "override WATER_SHADOWS: bool =";
    let shadows = text("water/displace").replace(&format!("{switch} false;"), &format!("{switch} {has_shadows};"));
    let shader = instrument::compute(&shadows, "main");
    let (vertices, maps) = (ocean.vertex_count(), ocean.maps());
    let frame = render::frame_uniform(&ocean.scene(SIZE_PX), maps, SIZE_PX);
    let frame = common::wgsl::buffer(gpu, bytemuck::bytes_of(&frame), BufferUsages::UNIFORM);
    let (module, info) = instrument::parse(&shader.text);
    let stride = module.global_variables.iter().find_map(|(_, global)| match module.types[global.ty].inner {
        TypeInner::Array { stride, .. } if global.name.as_deref() == Some("mesh_vertices") => Some(stride),
        _ => None,
    });
    let mesh = gpu.storage_buffer("vertices", u64::from(vertices) * u64::from(stride.expect("the mesh's vertices")));
    let sums = gpu.storage_buffer("sums", 8 * (shader.functions.len() as u64 + 1));
    let samplers = [wgpu::MipmapFilterMode::Linear, wgpu::MipmapFilterMode::Nearest]
        .map(|filter| gpu.sampler("waves", [wgpu::AddressMode::Repeat; 2], filter));
    let resources = [
        ((0, 0), frame.as_entire_binding()),
        ((0, 1), mesh.as_entire_binding()),
        ((1, 0), TextureView(&maps.displacement)),
        ((1, 1), TextureView(&maps.gradients)),
        ((1, 2), TextureView(&maps.slope_moments)),
        ((1, 3), TextureView(&maps.foam)),
        ((1, 4), Sampler(&samplers[0])),
        ((1, 5), Sampler(&samplers[1])),
        ((1, 6), TextureView(&maps.no_coast)),
        ((2, 0), sums.as_entire_binding()),
    ];
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("counts"),
        layout: None,
        module: &gpu.shader_module("counts", &shader.text),
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    // The pipeline has layouts of the bindings that the shader uses.
    let used = |(group, binding): (u32, u32)| {
        let bound =
            |v: &naga::GlobalVariable| v.binding.as_ref().is_some_and(|b| (b.group, b.binding) == (group, binding));
        let mut of = module.global_variables.iter().filter(|(_, variable)| bound(variable));
        of.any(|(handle, _)| !info.get_entry_point(0)[handle].is_empty())
    };
    let groups = [0, 1, 2].map(|group| {
        let entries = resources
            .iter()
            .filter(|(place, _)| place.0 == group && used(*place))
            .map(|(place, resource)| wgpu::BindGroupEntry { binding: place.1, resource: resource.clone() });
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(group),
            entries: &entries.collect::<Vec<_>>(),
        })
    });
    let mut encoder = gpu.encoder("counts");
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline);
    (0..).zip(&groups).for_each(|(i, group)| pass.set_bind_group(i, group, &[]));
    // A thread whose vertex is not one of the mesh does nothing.
    pass.dispatch_workgroups(128, 512, 1);
    drop(pass);
    let staging = readback::stage_buffer(gpu, &mut encoder, &sums);
    gpu.submit(encoder);
    let sums: Vec<[u32; 2]> =
        bytemuck::pod_collect_to_vec(&pollster::block_on(readback::read(gpu, staging)).expect("read-back"));
    let most = sums[shader.functions.len()].map(f64::from);
    let mean = |sum: &[u32; 2]| sum.map(|n| f64::from(n) / f64::from(vertices));
    let functions: Vec<_> = shader.functions.into_iter().zip(sums.iter().map(mean).map(Count::from)).collect();
    let mean = functions.iter().fold(Count::default(), |sum, (_, own)| sum + *own);
    Executed { mean, most: most.into(), functions }
}

/// Cost of an entry point without loops.
fn without_loops(module: &str, entry: &str) -> Executed {
    let (module, info) = instrument::parse(&text(module));
    let most = counter::without_loops(&module, &info, entry);
    Executed { mean: most, most, functions: Vec::new() }
}

/// Prints what a shader executes. Returns whether the known cost says so.
fn agrees(name: &str, executed: &Executed, known: ShaderCost) -> bool {
    let Executed { mean, most, functions } = executed;
    let (Count { ops, reads }, Count { ops: max_ops, reads: max_reads }) = (*mean, *most);
    eprintln!(
        "\npub const {name}: ShaderCost = ShaderCost {{ ops: {ops:.1}, reads: {reads:.1}, max_ops: {max_ops:.1}, \
         max_reads: {max_reads:.1} }};"
    );
    let mut sorted: Vec<_> = functions.iter().filter(|(_, own)| *own != Count::default()).collect();
    sorted.sort_by(|a, b| b.1.ops.total_cmp(&a.1.ops));
    for (function, own) in sorted {
        eprintln!("{:>8.1} operations {:>6.2} reads  {function}", own.ops, own.reads);
    }
    let is_near = |executed: f64, known: f64, least: f64| (executed - known).abs() <= (0.05 * known).max(least);
    is_near(ops, known.ops, 1.0)
        && is_near(reads, known.reads, 0.1)
        && most.ops <= known.max_ops * 1.05
        && most.reads <= known.max_reads * 1.05
}

fn check(all: &[(&str, Executed, ShaderCost)]) {
    let wrong = all.iter().filter(|(name, executed, known)| !agrees(name, executed, *known));
    let names: Vec<_> = wrong.map(|(name, ..)| name).collect();
    assert!(names.is_empty(), "these constants of src/bench/cost.rs differ from the counts above: {names:?}");
}

#[test]
fn the_costs_of_light_and_sky_are_what_they_execute() {
    let light = instrument::fragment(&text("water/light"), "light_fragment", 100);
    let sky = instrument::fragment(&text("sky/background"), "fragment", 200);
    let gpu = common::gpu();
    let [lit, _] = picture(&gpu, &mut ocean(&gpu, &[("water/light", &light), ("sky/background", &sky)]), SIZE_PX);
    check(&[
        ("LIGHT_FRAGMENT_COST", of_pixels(&light, &lit, 100), cost::LIGHT_FRAGMENT_COST),
        ("BACKGROUND_FRAGMENT_COST", of_pixels(&sky, &lit, 200), cost::BACKGROUND_FRAGMENT_COST),
    ]);
    let ShaderCost { ops, .. } = cost::LIGHT_FRAGMENT_COST;
    assert!(ops <= 3000.0, "the budget of the full tier");
}

#[test]
fn the_cost_of_the_lean_light_is_what_it_executes() {
    let lean = instrument::fragment(&text("water/light"), "lean_fragment", 100);
    let gpu = common::gpu();
    let mut ocean = ocean(&gpu, &[("water/light", &lean)]);
    ocean.set_lean(true);
    let [lit, _] = picture(&gpu, &mut ocean, SIZE_PX);
    check(&[("LEAN_LIGHT_FRAGMENT_COST", of_pixels(&lean, &lit, 100), cost::LEAN_LIGHT_FRAGMENT_COST)]);
    let ShaderCost { ops, reads, .. } = cost::LEAN_LIGHT_FRAGMENT_COST;
    assert!(ops <= 1500.0 && reads <= 20.0, "the budget of the lean tier");
}

/// The surface from below fills the upper half of the picture, and open water the rest.
#[test]
fn the_cost_of_the_light_under_water_is_what_it_executes() {
    let under = instrument::fragment(&text("water/under"), "under_fragment", 100);
    let gpu = common::gpu();
    let mut ocean = ocean(&gpu, &[("water/under", &under)]);
    ocean.set_params(&common::params("dive=5&pitch=10"));
    let [lit, _] = picture(&gpu, &mut ocean, SIZE_PX);
    check(&[("UNDER_FRAGMENT_COST", of_pixels(&under, &lit, 100), UNDER_FRAGMENT_COST)]);
    // With a peak of 2.2e12 operations per second, a GTX 1060 needs 3.2 ms for these in 1920 x 1080 pixels.
    let ShaderCost { ops, reads, .. } = UNDER_FRAGMENT_COST;
    assert!(ops <= 3500.0 && reads <= 40.0, "the budget under water");
}

#[test]
fn the_costs_of_the_land_and_of_shallow_water_are_what_they_execute() {
    let land = instrument::fragment(&text("land/light"), "light_fragment", 100);
    let water = instrument::fragment(&text("water/light"), "light_fragment", 101);
    let gpu = common::gpu();
    let mut ocean = ocean(&gpu, &[("land/light", &land), ("water/light", &water)]);
    ocean.set_params(&common::params("coast=beach&depth=11&x=480&y=8&z=0&heading=60&pitch=-6&sun=25"));
    let [lit, _] = picture(&gpu, &mut ocean, SIZE_PX);
    check(&[
        ("LAND_FRAGMENT_COST", of_pixels(&land, &lit, 100), LAND_FRAGMENT_COST),
        ("SHALLOW_FRAGMENT_COST", of_pixels(&water, &lit, 101), SHALLOW_FRAGMENT_COST),
    ]);
    // A pixel shows land or water. With a peak of 2.2e12 operations per second, a GTX 1060 needs 1.5 ms for a picture of
    // 1920 x 1080 pixels of land, which is less than for one of water.
    const { assert!(LAND_FRAGMENT_COST.ops <= 0.6 * cost::LIGHT_FRAGMENT_COST.ops, "the budget of the land") }
}

#[test]
fn the_costs_of_mesh_and_tone_are_what_they_execute() {
    let gpu = common::gpu();
    // The tone pass writes bytes that the present pass copies, so that the canvas shows its counts.
    let tone = instrument::fragment(&text("film/tone"), "fragment", 100);
    let mut ocean = ocean(&gpu, &[("film/tone", &tone)]);
    let [_, shown] = picture(&gpu, &mut ocean, SIZE_PX);
    ocean.set_params(&common::params("localexposure=0.5"));
    let [_, locally_exposed] = picture(&gpu, &mut ocean, SIZE_PX);
    ocean.set_params(&Params::default());
    picture(&gpu, &mut ocean, SIZE_PX);
    let params = Params::default();
    let planned = planned_vertex_count(&params, &Plan::new(&params), SIZE_PX);
    assert_eq!(planned, ocean.vertex_count(), "budgets know the number of vertices without a GPU");
    let mut low_sun = self::ocean(&gpu, &[]);
    low_sun.set_params(&common::params("sun=5"));
    picture(&gpu, &mut low_sun, SIZE_PX);
    check(&[
        ("DISPLACE_VERTEX_COST", displacement(&gpu, &ocean, false), cost::DISPLACE_VERTEX_COST),
        ("SHADED_DISPLACE_VERTEX_COST", displacement(&gpu, &low_sun, true), cost::SHADED_DISPLACE_VERTEX_COST),
        ("MESH_VERTEX_COST", without_loops("water/light", "mesh_vertex"), cost::MESH_VERTEX_COST),
        ("MESH_FRAGMENT_COST", without_loops("water/light", "mesh_fragment"), cost::MESH_FRAGMENT_COST),
        ("TONE_FRAGMENT_COST", of_pixels(&tone, &shown, 100), cost::TONE_FRAGMENT_COST),
        ("TONE_LOCAL_FRAGMENT_COST", of_pixels(&tone, &locally_exposed, 100), cost::TONE_LOCAL_FRAGMENT_COST),
    ]);
}

#[test]
fn the_costs_of_copying_and_enlarging_are_what_they_execute() {
    let gpu = common::gpu();
    let present = instrument::fragment(&text("film/present"), "fragment", 100);
    let mut ocean = ocean(&gpu, &[("film/present", &present)]);
    let [copied, enlarged] = [SIZE_PX, [1280, 720]].map(|size| picture(&gpu, &mut ocean, size)[1].clone());
    check(&[
        ("COPY_FRAGMENT_COST", of_pixels(&present, &copied, 100), cost::COPY_FRAGMENT_COST),
        ("ENLARGE_FRAGMENT_COST", of_pixels(&present, &enlarged, 100), cost::ENLARGE_FRAGMENT_COST),
    ]);
}

/// Cost of a pass of a coast in a thread whose loop `of_loop` runs once, and of one whose loop does not run.
fn with_one_turn(module: &str, of_loop: &str) -> [Count; 2] {
    let of = |text: &str| {
        assert!(!text.contains("for ("), "{module} has another loop");
        let (parsed, info) = instrument::parse(text);
        counter::without_loops(&parsed, &info, "main")
    };
    let text = text(module);
    let once = text.replace(of_loop, "{ let i = 0u; let g = 0u;");
    let (before, from) = text.split_once(of_loop).expect("the loop");
    let (_, after) = from.split_once("\n  }\n").expect("the end of the loop");
    [of(&once), of(&format!("{before}\n{after}"))]
}

#[test]
fn the_costs_of_the_waves_at_a_coast_are_what_they_execute() {
    const N: u32 = 64;
    let texels = f64::from(N * N);
    let of = |waves: u32, points: u32, groups: u32| {
        cost::coast_pass_cost(N, CoastSizes { waves, points, groups }, MapFormat::Half)
    };
    let (none, of_waves, of_groups) = (of(0, 0, 0), of(1, 1, 0), of(0, 0, 1));
    let more = cost::row_and_column_pass_cost(N, 1, MapFormat::Half) + cost::mip_pass_cost(N, 2, MapFormat::Half);
    let [wave, point] = with_one_turn("coast/envelopes", "for (var i = 0u; i < of_group.y; i++) {");
    let [group, texel] = with_one_turn("coast/sum", "for (var g = 0u; g < coast.group_count; g++) {");
    let (parsed, info) = instrument::parse(&text("coast/gradients"));
    let gradients = counter::without_loops(&parsed, &info, "main");
    eprintln!("{wave:?} {point:?} {group:?} {texel:?} {gradients:?}");
    let is_near = |counted: f64, known: f64| (counted / known - 1.0).abs() < 0.05;
    assert!(is_near(wave.ops - point.ops, of_waves.flops - none.flops), "a wave");
    assert!(is_near(group.ops - texel.ops, (of_groups.flops - none.flops) / texels), "a group");
    assert!(is_near(texel.ops + gradients.ops, (none.flops - more.flops) / texels), "a texel");
    assert_eq!(group.reads + gradients.reads, (of_groups.reads - more.reads) / texels);
}

#[test]
fn loops_branches_and_calls_count_as_often_as_they_run() {
    let shader = instrument::compute(
        "fn twice(x: f32) -> f32 { return x * 2.0 + 1.0; }
        @compute @workgroup_size(1)
        fn main(@builtin(global_invocation_id) id: vec3u) {
          var sum = f32(id.x);
          for (var i = 0u; i < id.x; i++) {
            if i == 1u { continue; }
            sum = twice(sum);
          }
        }",
        "main",
    );
    assert_eq!(shader.functions, ["twice", "main"]);
    let gpu = common::gpu();
    let sums = gpu.storage_buffer("sums", 24);
    let module = gpu.shader_module("counts", &shader.text);
    let layouts = [[].as_slice(), &[], &[BindingType::StorageReadWrite(24)]]
        .map(|bindings| gpu.bind_group_layout("counts", wgpu::ShaderStages::COMPUTE, bindings));
    let pipeline = gpu.compute_pipeline("counts", (&module, "main"), &layouts.each_ref(), &[]);
    let groups = [[].as_slice(), &[], &[sums.as_entire_binding()]];
    let mut encoder = gpu.encoder("counts");
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline);
    for (i, resources) in groups.iter().enumerate() {
        pass.set_bind_group(i as u32, &gpu.bind_group("counts", &layouts[i], resources), &[]);
    }
    pass.dispatch_workgroups(4, 1, 1);
    drop(pass);
    let staging = readback::stage_buffer(&gpu, &mut encoder, &sums);
    gpu.submit(encoder);
    let sums: Vec<u32> =
        bytemuck::pod_collect_to_vec(&pollster::block_on(readback::read(&gpu, staging)).expect("read-back"));
    // Threads 0 to 3 call `twice` 0, 1, 1 and 2 times. `main` converts once a thread, and compares, adds and compares.
    assert_eq!(sums, [2 * 4, 0, 4 + (1 + 2 + 3 + 4) + 2 * (1 + 2 + 3), 0, 2 * 2 + 1 + 4 + 2 * 3, 0]);
}
