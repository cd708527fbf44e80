//! Writes the program's shader modules (WGSL) and a list of the pipelines that it makes of them (pipelines.json), as on
//! a GPU, for compilers that tell how many registers they need.
//!
//! `cargo run --example shaders -- FOLDER`

use seastate::gpu::Gpu;
use seastate::gpu::kit::BindingType;
use seastate::gpu::map_format::MapFormat;
use seastate::gpu::observer::{Made, OBSERVER};
use seastate::ocean::{Ocean, OutputKind, SampleGrid};
use seastate::shaders::Shaders;
use seastate::sim::Simulation;
use seastate::sim::transform::FftImplementation;
use seastate::state::params::Detail;
use seastate::state::query;
use seastate::waves::Plan;
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::sync::{LazyLock, Mutex};

/// Seas whose simulation has other pipelines.
const SEAS: [&str; 3] = ["n=256", "n=512", "n=1024"];
/// Pictures that together need the renderer's pipelines: one for each part that shaders have or lack, except for a sky
/// from a file, which no state string holds.
const PICTURES: [&str; 29] = [
    "",
    "detail=lean",
    "foam=0",
    "depth=4",
    "depth=4&caustics=1",
    "specular=ggx",
    "specular=blinn-phong",
    "fresnel=schlick",
    "fog=1",
    "overcast=0.5",
    "clouds=cumulus",
    "clouds=storm&squalls=0.3",
    "rain=5",
    "wind=20&spray=1",
    "glints=1",
    "gusts=1",
    "clouds=cumulus&glints=1&gusts=1&depth=4&caustics=1",
    "sun=5",
    "sun=-20",
    "view=height",
    "view=normals",
    "bloom=0.1",
    "afloat=buoy*12.5*-30",
    "dive=5",
    "dive=2&depth=5&clouds=cumulus",
    "dive=0.1&afloat=buoy*12.5*-30",
    "coast=harbour&depth=10.9&sun=8&x=82&z=-59&y=7&heading=150",
    "coast=harbour&depth=10.9&sun=8&x=82&z=-59&y=7&heading=150&detail=lean",
    "coast=beach&depth=12&sun=60&x=642&z=-110&y=8&heading=214&spray=1",
];

#[derive(Default)]
struct Record {
    modules: HashMap<wgpu::ShaderModule, String>,
    texts: BTreeMap<String, String>,
    /// Bindings with dynamic offsets of the layouts that have any.
    dynamic: HashMap<wgpu::BindGroupLayout, Vec<usize>>,
    /// Pipelines by name, which holds the constants that are not 0.
    pipelines: BTreeMap<String, Value>,
}

static RECORD: LazyLock<Mutex<Record>> = LazyLock::new(Mutex::default);

impl Record {
    fn add(&mut self, made: &Made<'_>) {
        match *made {
            Made::Module(module, name, text) => {
                let name = name.replace('/', "-");
                self.texts.insert(name.clone(), text.to_owned());
                self.modules.insert(module.clone(), name);
            }
            Made::Layout(layout, bindings) => {
                let is_dynamic = |(i, binding): (usize, &BindingType)| {
                    matches!(binding, BindingType::DynamicUniform(_)).then_some(i)
                };
                self.dynamic.insert(layout.clone(), bindings.iter().enumerate().filter_map(is_dynamic).collect());
            }
            Made::Compute(label, module, entry, layouts, constants) => {
                let of = |(group, layout): (usize, &&wgpu::BindGroupLayout)| {
                    let bindings = self.dynamic.get(*layout).into_iter().flatten();
                    bindings.map(move |binding| format!("{group}.{binding}")).collect::<Vec<_>>()
                };
                let dynamic: Vec<_> = layouts.iter().enumerate().flat_map(of).collect();
                self.pipeline(label, module, constants, json!({ "compute": entry, "dynamic": dynamic }));
            }
            Made::Render(label, program, onto) => {
                let format = |format: &wgpu::TextureFormat| format!("{format:?}").to_lowercase();
                let [vertex, fragment] = program.entry_points;
                let depth = onto.depth.map(|depth| format(&depth.format));
                let colours: Vec<_> = onto.formats.iter().map(format).collect();
                let rest = json!({ "vertex": vertex, "fragment": fragment, "colours": colours, "depth": depth });
                self.pipeline(label, program.module, program.constants, rest);
            }
        }
    }

    fn pipeline(&mut self, label: &str, module: &wgpu::ShaderModule, constants: &[(&str, f64)], rest: Value) {
        // Registers count on GPUs.
        let mut constants: BTreeMap<_, _> = constants.iter().copied().collect();
        constants.entry("SOFTWARE_ADAPTER").and_modify(|value| *value = 0.0);
        let list: Vec<_> = constants
            .iter()
            .filter(|(_, value)| **value != 0.0)
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        let mut pipeline = rest;
        let is_reference = pipeline["colours"][0] == "rgba32float";
        let kind = if is_reference {
            " (reference)"
        } else if pipeline["fragment"] == "lean_fragment" {
            " (lean)"
        } else {
            ""
        };
        let name = format!("{label} {}{kind}", list.join(" "));
        pipeline["name"] = name.trim().into();
        pipeline["module"] = self.modules[module].as_str().into();
        pipeline["constants"] = json!(constants);
        self.pipelines.insert(name, pipeline);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: shaders FOLDER")?;
    OBSERVER.get_or_init(|| |made| RECORD.lock().expect("no panic").add(made));
    let gpu = pollster::block_on(Gpu::request())?;
    let params = |state: &str| -> Result<_, String> {
        match query::parse(state) {
            (params, notices) if notices.is_empty() => Ok(params),
            (_, notices) => Err(format!("{state}: {notices:?}")),
        }
    };
    let shaders = Shaders::default().with_map_format(MapFormat::Half);
    for sea in SEAS {
        Simulation::with_fft_implementation(&gpu, Plan::new(&params(sea)?), &shaders, FftImplementation::Workgroup);
    }
    let size = [64, 64];
    let start = params("")?;
    let screen = wgpu::TextureFormat::Bgra8Unorm;
    let mut ocean = Ocean::with_shaders(&gpu, screen, OutputKind::Screen, &start, shaders);
    // Nothing is submitted: recording makes the pipelines, and a software adapter need not draw what was made for GPUs.
    for picture in PICTURES {
        let wanted = params(picture)?;
        ocean.set_params(&wanted);
        ocean.set_lean(wanted.screen.detail == Detail::Lean);
        ocean.solve_coast();
        let mut encoder = gpu.encoder("picture");
        ocean.record_frame(&mut encoder, size, 1);
    }
    let grid = SampleGrid { size, cells_per_pixel_side: 1, sample_position_in_cell: [0.5; 2] };
    ocean.set_params(&start);
    let mut encoder = gpu.encoder("reference");
    ocean.record_frame_samples(&mut encoder, &grid);
    RECORD.lock().expect("no panic").write(Path::new(&folder))?;
    Ok(())
}

impl Record {
    /// Writes the modules that pipelines are made of, and the pipelines.
    fn write(&self, folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
        std::fs::create_dir_all(folder)?;
        let pipelines: Vec<_> = self.pipelines.values().filter(|p| !is_for_software(p)).collect();
        let is_used = |name: &str| self.pipelines.values().any(|p| p["module"] == name.replace('/', "-").as_str());
        let missed: Vec<_> = Shaders::default()
            .all()
            .map(|(name, _)| name)
            .filter(|name| !name.contains("unrolled") && !is_used(name))
            .collect();
        if !missed.is_empty() {
            return Err(format!("no sea or picture of this example needs these modules: {}", missed.join(", ")).into());
        }
        for (name, text) in &self.texts {
            if pipelines.iter().any(|pipeline| pipeline["module"] == name.as_str()) {
                std::fs::write(folder.join(format!("{name}.wgsl")), text)?;
            }
        }
        let text = serde_json::to_string_pretty(&json!({ "pipelines": pipelines }))?;
        std::fs::write(folder.join("pipelines.json"), text)?;
        Ok(())
    }
}

/// Whether a pipeline is for adapters that are CPUs.
fn is_for_software(pipeline: &Value) -> bool {
    pipeline["module"].as_str().is_some_and(|module| module.contains("unrolled"))
}
