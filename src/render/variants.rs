//! Render pipelines specialised for the parts that a picture contains.

use crate::gpu::Gpu;
#[cfg(not(target_arch = "wasm32"))]
use std::sync::{Arc, OnceLock};

/// Variants of a pipeline, one for each combination of picture parts (such as bed and fog) that was needed so far.
/// Parts that are not needed are compiled out: their code costs registers on every GPU, and a software adapter executes
/// both sides of a branch.
pub struct PipelineVariants<P> {
    /// The variants made so far; the selected one is the last.
    made: Vec<(P, wgpu::RenderPipeline)>,
    /// The variant that a thread is compiling. Browsers have no such threads.
    #[cfg(not(target_arch = "wasm32"))]
    pending: Option<(P, Arc<OnceLock<wgpu::RenderPipeline>>)>,
}

impl<P> Default for PipelineVariants<P> {
    fn default() -> Self {
        Self {
            made: Vec::new(),
            #[cfg(not(target_arch = "wasm32"))]
            pending: None,
        }
    }
}

impl<P: Copy + PartialEq> PipelineVariants<P> {
    /// Selects the variant of the pipeline for `parts`, a combination of picture parts (such as bed and fog), so that
    /// [`Self::selected`] returns it. At first use `make` compiles it: at once, or, if `may_wait` and a variant was
    /// selected before, in a thread. Until the thread has finished, the variant before stays selected.
    pub fn select(
        &mut self,
        parts: P,
        may_wait: bool,
        make: impl FnOnce() -> wgpu::RenderPipeline + wgpu::WasmNotSend + 'static,
    ) {
        self.take_finished();
        if let Some(at) = self.made.iter().position(|(made, _)| *made == parts) {
            let last = self.made.len() - 1;
            self.made.swap(at, last);
        } else if !may_wait || self.made.is_empty() || cfg!(target_arch = "wasm32") {
            self.made.push((parts, make()));
        } else {
            self.compile_in_thread(parts, make);
        }
    }

    /// The variant of the pipeline selected last; None before the first selection.
    pub fn selected(&self) -> Option<&wgpu::RenderPipeline> {
        self.made.last().map(|(_, pipeline)| pipeline)
    }

    #[cfg(target_arch = "wasm32")]
    fn take_finished(&mut self) {}

    /// Adds the variant that the thread has compiled, if it has finished, without selecting it.
    #[cfg(not(target_arch = "wasm32"))]
    fn take_finished(&mut self) {
        // The thread has ended when it no longer shares the place for its result, which stays empty if it panicked.
        let Some((parts, mut compiled)) = self.pending.take() else { return };
        match Arc::get_mut(&mut compiled) {
            Some(result) => self.made.splice(0..0, result.take().map(|pipeline| (parts, pipeline))).for_each(drop),
            None => self.pending = Some((parts, compiled)),
        }
    }

    #[cfg(target_arch = "wasm32")]
    fn compile_in_thread(&mut self, parts: P, make: impl FnOnce() -> wgpu::RenderPipeline) {
        self.made.push((parts, make()));
    }

    /// Begins to compile a variant in a thread, unless one is already being compiled.
    #[cfg(not(target_arch = "wasm32"))]
    fn compile_in_thread(&mut self, parts: P, make: impl FnOnce() -> wgpu::RenderPipeline + Send + 'static) {
        if self.pending.is_some() {
            return;
        }
        let compiled = Arc::new(OnceLock::new());
        self.pending = Some((parts, compiled.clone()));
        std::thread::spawn(move || {
            compiled.get_or_init(make);
        });
    }
}

/// A compute pipeline in variants by `N` switches of its shader, each compiled when it is first selected.
pub struct ComputeVariants<const N: usize> {
    label: &'static str,
    module: wgpu::ShaderModule,
    layouts: Vec<wgpu::BindGroupLayout>,
    /// Names of the override constants that the switches set.
    switches: [&'static str; N],
    /// The variants made so far; the selected one is the last.
    made: Vec<([bool; N], wgpu::ComputePipeline)>,
}

impl<const N: usize> ComputeVariants<N> {
    /// Pipelines of the entry point `main` of a module. `layouts` are those of the bind groups 0, 1, 2 ...
    pub fn new(
        label: &'static str,
        module: wgpu::ShaderModule,
        layouts: &[&wgpu::BindGroupLayout],
        switches: [&'static str; N],
    ) -> Self {
        let layouts = layouts.iter().map(|layout| (*layout).clone()).collect();
        Self { label, module, layouts, switches, made: Vec::new() }
    }

    /// Selects the variant for [`Self::selected`].
    pub fn select(&mut self, gpu: &Gpu, are_on: [bool; N]) {
        if let Some(at) = self.made.iter().position(|(made, _)| *made == are_on) {
            let last = self.made.len() - 1;
            self.made.swap(at, last);
            return;
        }
        let layouts: Vec<_> = self.layouts.iter().collect();
        let constants: [_; N] = std::array::from_fn(|i| switch_constant(self.switches[i], are_on[i]));
        let compiled = gpu.compute_pipeline(self.label, (&self.module, "main"), &layouts, &constants);
        self.made.push((are_on, compiled));
    }

    /// The variant selected last; None before the first selection.
    pub fn selected(&self) -> Option<&wgpu::ComputePipeline> {
        self.made.last().map(|(_, pipeline)| pipeline)
    }
}

/// Name and value (1 or 0) of the override constant that tells a shader whether the picture contains a part.
pub fn switch_constant(name: &str, is_there: bool) -> (&str, f64) {
    (name, f64::from(u8::from(is_there)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::kit::{AttachmentFormats, RenderProgram};
    use std::sync::mpsc;

    fn pipeline(gpu: &Gpu) -> wgpu::RenderPipeline {
        let module = gpu.shader_module(
            "test",
            "@vertex fn vertex() -> @builtin(position) vec4f { return vec4f(0.0); }
             @fragment fn fragment() -> @location(0) vec4f { return vec4f(1.0); }",
        );
        let onto = AttachmentFormats { formats: &[wgpu::TextureFormat::Rgba8Unorm], depth: None, blend: None };
        gpu.render_pipeline("test", &RenderProgram::new(&module), &[], &onto)
    }

    #[test]
    fn the_variant_before_stays_until_a_thread_has_compiled_the_next() {
        let gpu = pollster::block_on(Gpu::request()).unwrap();
        let mut variants = PipelineVariants::default();
        let compiling = gpu.clone();
        variants.select(1, true, move || pipeline(&compiling));
        let first = variants.selected().cloned().expect("the first variant is compiled at once");
        let [(finish, may_finish), (report, is_compiled)] = [mpsc::channel(), mpsc::channel()];
        let compiling = gpu.clone();
        variants.select(2, true, move || {
            may_finish.recv().expect("a sender");
            let compiled = pipeline(&compiling);
            report.send(()).expect("a receiver");
            compiled
        });
        assert_eq!(variants.selected(), Some(&first), "the thread is still compiling");
        finish.send(()).expect("a receiver");
        is_compiled.recv_timeout(std::time::Duration::from_secs(60)).expect("the thread compiles");
        while variants.selected() == Some(&first) {
            variants.select(2, true, || panic!("compiled twice"));
            std::thread::yield_now();
        }
        variants.select(1, true, || panic!("made before"));
        assert_eq!(variants.selected(), Some(&first));
        variants.select(3, false, move || pipeline(&gpu));
        assert_ne!(variants.selected(), Some(&first), "a still waits for its pipeline");
    }
}
