//! Lets a tool see every shader module and pipeline that the program makes, such as to compile them for other GPUs.

use super::kit::{AttachmentFormats, BindingType, RenderProgram};
use std::sync::OnceLock;

/// Something that [`super::Gpu`] made.
pub enum Made<'a> {
    /// A shader module, with its name and its WGSL text.
    Module(&'a wgpu::ShaderModule, &'a str, &'a str),
    /// A bind group layout, with the types of its bindings 0, 1, 2 and so on.
    Layout(&'a wgpu::BindGroupLayout, &'a [BindingType]),
    /// A compute pipeline: label, module, entry point, layouts of its bind groups, override constants.
    Compute(&'a str, &'a wgpu::ShaderModule, &'a str, &'a [&'a wgpu::BindGroupLayout], &'a [(&'a str, f64)]),
    /// A render pipeline: label, shaders, and what it draws on.
    Render(&'a str, &'a RenderProgram<'a>, &'a AttachmentFormats<'a>),
}

/// Called with all that is made, if it is set; nothing in the program sets it.
pub static OBSERVER: OnceLock<fn(&Made<'_>)> = OnceLock::new();

pub(super) fn report(made: &Made<'_>) {
    if let Some(observer) = OBSERVER.get() {
        observer(made);
    }
}
