//! Every shader module is valid for naga (Firefox and the native program use it), and Rust and WGSL agree on the layout of
//! every struct that they share.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use seastate::gpu::layout::Layout;
use seastate::gpu::map_format::MapFormat;
use seastate::shaders::{Shaders, locate};
use std::collections::BTreeSet;

fn layouts() -> Vec<Layout> {
    seastate::sim::uniforms::LAYOUTS.iter().chain(seastate::render::LAYOUTS).copied().collect()
}

fn parsed() -> Vec<(&'static str, naga::Module)> {
    let floats = Shaders::default().with_maps(MapFormat::Float);
    Shaders::default()
        .all()
        .chain(floats.all())
        .map(|(name, text)| {
            let module = naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| {
                let line = e.location(&text).map_or(0, |l| l.line_number as usize);
                panic!("{name}, {:?}: {}", locate(name, line), e.emit_to_string(&text))
            });
            (name, module)
        })
        .collect()
}

#[test]
fn every_module_is_valid_without_optional_features() {
    for (name, module) in parsed() {
        // pack2x16float belongs to WebGPU's base, but naga has a capability for it.
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::SHADER_FLOAT16_IN_FLOAT32);
        if let Err(e) = validator.validate(&module) {
            panic!("{name}: {}", e.emit_to_string(&module_text(name)));
        }
    }
}

fn module_text(name: &str) -> String {
    Shaders::default().all().find(|(n, _)| *n == name).map(|(_, text)| text).unwrap_or_default()
}

#[test]
fn rust_and_wgsl_agree_on_layouts() {
    let layouts = layouts();
    let mut checked = BTreeSet::new();
    for (name, module) in parsed() {
        for (_, ty) in module.types.iter() {
            let (Some(struct_name), naga::TypeInner::Struct { members, span }) = (&ty.name, &ty.inner) else {
                continue;
            };
            let Some((_, fields, size)) = layouts.iter().find(|(wgsl, _, _)| wgsl == struct_name) else { continue };
            assert_eq!(*span as usize, *size, "{name}: size of {struct_name}");
            for member in members {
                let member_name = member.name.as_deref().unwrap_or_default();
                // A Rust array may stand for several WGSL members; those it names must agree.
                if let Some((_, offset)) = fields.iter().find(|(field, _)| *field == member_name) {
                    assert_eq!(member.offset as usize, *offset, "{name}: {struct_name}.{member_name}");
                }
            }
            for (field, _) in fields.iter().filter(|(field, _)| !field.starts_with("unused")) {
                assert!(
                    members.iter().any(|m| m.name.as_deref() == Some(field)),
                    "{name}: {struct_name} has no {field}"
                );
            }
            checked.insert(struct_name.clone());
        }
    }
    let all: BTreeSet<String> = layouts.iter().map(|(name, _, _)| (*name).to_owned()).collect();
    assert_eq!(checked, all, "every shared struct is used by a shader");
}

#[test]
fn every_uniform_struct_has_a_rust_twin() {
    let layouts = layouts();
    for (name, module) in parsed() {
        for (_, variable) in module.global_variables.iter() {
            if variable.space != naga::AddressSpace::Uniform {
                continue;
            }
            let ty = module.types[variable.ty].name.clone().unwrap_or_default();
            assert!(layouts.iter().any(|(wgsl, _, _)| *wgsl == ty), "{name}: uniform {ty} is not in LAYOUTS");
        }
    }
}
