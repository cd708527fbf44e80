//! Render pipelines specialised for the parts that a picture contains.

/// Variants of a pipeline, one for each combination of picture parts (such as bed and fog) that was needed so far.
/// Parts that are not needed are compiled out: their code costs registers on every GPU, and a software adapter executes
/// both sides of a branch.
pub struct PipelineVariants<P>(Vec<(P, wgpu::RenderPipeline)>);

impl<P> Default for PipelineVariants<P> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<P: Copy + PartialEq> PipelineVariants<P> {
    /// Selects the variant of the pipeline for `parts`, a combination of picture parts (such as bed and fog), so that
    /// [`Self::selected`] returns it. At first use `make` compiles it.
    pub fn select(&mut self, parts: P, make: impl FnOnce(P) -> wgpu::RenderPipeline) {
        // The selected pipeline is the last one.
        match self.0.iter().position(|(made, _)| *made == parts) {
            Some(at) => {
                let last = self.0.len() - 1;
                self.0.swap(at, last);
            }
            None => self.0.push((parts, make(parts))),
        }
    }

    /// The variant of the pipeline selected last; None before the first selection.
    pub fn selected(&self) -> Option<&wgpu::RenderPipeline> {
        self.0.last().map(|(_, pipeline)| pipeline)
    }
}

/// Name and value (1 or 0) of the override constant that tells a shader whether the picture contains a part.
pub fn switch_constant(name: &str, is_there: bool) -> (&str, f64) {
    (name, f64::from(u8::from(is_there)))
}
