//! Every shader module is valid for naga (Firefox and the native program use it), and Rust and WGSL agree on the layout
//! of every struct that they share.

mod common;

use common::wgsl::shaders;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use seastate::gpu::layout::StructDeclaration;
use seastate::gpu::map_format::MapFormat;
use std::collections::{BTreeMap, BTreeSet};

/// The shared structs, by their names in WGSL.
fn declarations() -> BTreeMap<&'static str, StructDeclaration> {
    seastate::sim::uniforms::SHARED_STRUCTS
        .iter()
        .chain(seastate::render::SHARED_STRUCTS)
        .map(|s| (s.name, *s))
        .collect()
}

fn parsed() -> Vec<(&'static str, naga::Module)> {
    let floats = shaders().with_map_format(MapFormat::Float);
    shaders()
        .all()
        .chain(floats.all())
        .map(|(name, text)| {
            let module =
                naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(&text)));
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
    shaders().all().find(|(n, _)| *n == name).map(|(_, text)| text).unwrap_or_default()
}

/// atan2(0, 0) is NaN on some GPUs, and 0 on software adapters. So it is called only by functions whose arguments are not
/// both zero: two check them, and one measures the elevation of a cloud, which never lies at the eye.
#[test]
fn only_functions_without_two_zeros_call_atan2() {
    const MAY: [&str; 3] = ["maths_phase", "sky_azimuth_turns", "sky_shifted_dome"];
    let mut callers = BTreeSet::new();
    for (_, module) in parsed() {
        let functions = module.functions.iter().map(|(_, f)| f);
        for function in functions.chain(module.entry_points.iter().map(|e| &e.function)) {
            let is_atan2 =
                |e: &naga::Expression| matches!(e, naga::Expression::Math { fun: naga::MathFunction::Atan2, .. });
            if function.expressions.iter().any(|(_, e)| is_atan2(e)) {
                callers.insert(function.name.clone().unwrap_or_default());
            }
        }
    }
    assert_eq!(callers, MAY.map(str::to_owned).into());
}

#[test]
fn rust_and_wgsl_agree_on_layouts() {
    let declarations = declarations();
    let mut checked = BTreeSet::new();
    for (name, module) in parsed() {
        for (_, ty) in module.types.iter() {
            let (Some(struct_name), naga::TypeInner::Struct { members, span }) = (&ty.name, &ty.inner) else {
                continue;
            };
            let Some(declaration) = declarations.get(struct_name.as_str()) else { continue };
            assert_eq!(*span as usize, declaration.size, "{name}: size of {struct_name}");
            for member in declaration.members.iter().filter(|member| !member.is_padding()) {
                let offset = members.iter().find(|m| m.name.as_deref() == Some(member.name)).map(|m| m.offset as usize);
                assert_eq!(offset, Some(member.offset), "{name}: {struct_name}.{}", member.name);
            }
            checked.insert(struct_name.clone());
        }
    }
    let all: BTreeSet<String> = declarations.into_keys().map(str::to_owned).collect();
    assert_eq!(checked, all, "every shared struct is used by a shader");
}

#[test]
fn every_uniform_struct_is_declared_in_rust() {
    let declarations = declarations();
    for (name, module) in parsed() {
        for (_, variable) in module.global_variables.iter() {
            if variable.space != naga::AddressSpace::Uniform {
                continue;
            }
            let ty = module.types[variable.ty].name.clone().unwrap_or_default();
            assert!(declarations.contains_key(ty.as_str()), "{name}: uniform {ty} is not declared in Rust");
        }
    }
}
