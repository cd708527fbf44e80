//! Pipelines by the parts that a picture has.

/// The pipelines of a pass, one for each combination of parts that was needed so far. A part that a picture lacks is not in
/// its pipeline: its code would cost registers on every GPU, and a software adapter computes both sides of a branch.
pub struct Variants<P>(Vec<(P, wgpu::RenderPipeline)>);

impl<P> Default for Variants<P> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<P: Copy + PartialEq> Variants<P> {
    /// Chooses the pipeline of these parts, and makes it if there is none yet.
    pub fn choose(&mut self, parts: P, make: impl FnOnce(P) -> wgpu::RenderPipeline) {
        // The chosen pipeline is the last one.
        match self.0.iter().position(|(made, _)| *made == parts) {
            Some(at) => {
                let last = self.0.len() - 1;
                self.0.swap(at, last);
            }
            None => self.0.push((parts, make(parts))),
        }
    }

    /// The chosen pipeline.
    pub fn chosen(&self) -> Option<&wgpu::RenderPipeline> {
        self.0.last().map(|(_, pipeline)| pipeline)
    }
}

/// An override constant that says whether a picture has a part.
pub fn part(name: &str, is_there: bool) -> (&str, f64) {
    (name, f64::from(u8::from(is_there)))
}
