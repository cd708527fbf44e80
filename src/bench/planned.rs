//! The counted work of a frame, known before a GPU draws it.

use super::budget::{Assumptions, GPU_CLASSES};
use super::cost::{self, Cost, PictureContents};
use crate::ocean::passes::{MapSizes, planned_vertex_count, planned_wave_shadows};
use crate::state::Params;
use crate::state::camera::View;
use crate::waves::Plan;
use std::fmt;

/// Sizes from which the work of the passes of one frame is counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameWork {
    /// Width and height of the picture, pixels.
    pub size: [u32; 2],
    /// Sizes and format of the maps of the simulation.
    pub maps: MapSizes,
    /// Numbers of pixels, vertices and bytes of the picture.
    pub picture: PictureContents,
}

impl FrameWork {
    /// Work of a frame of `size` (width, height) pixels of `params`, whose waves are those of `plan`, with a mesh of
    /// `vertices`.
    pub fn new(params: &Params, plan: &Plan, size: [u32; 2], maps: MapSizes, vertices: u32) -> Self {
        let [width, height] = size.map(f64::from);
        let camera = &params.camera;
        let view = View::new(camera, width / height, 0.0);
        // With a level view, the lower half of the picture is below the horizon.
        let horizon = (-camera.pitch_deg.to_radians()).tan() / view.tan_half_fov[1];
        let texels = f64::from(maps.map_texels_per_side).powi(2) * f64::from(maps.cascades) * 4.0 / 3.0;
        let picture = PictureContents {
            pixels: width * height,
            sea_fraction: (0.5 + 0.5 * horizon).clamp(0.0, 1.0),
            vertices: f64::from(vertices),
            map_bytes: texels * f64::from(maps.format.bytes_per_texel()),
            light: cost::LIGHT_FRAGMENT_COST,
            displace: if planned_wave_shadows(params, plan) {
                cost::SHADED_DISPLACE_VERTEX_COST
            } else {
                cost::DISPLACE_VERTEX_COST
            },
            tone: if params.look.film.local_exposure > 0.0 {
                cost::TONE_LOCAL_FRAGMENT_COST
            } else {
                cost::TONE_FRAGMENT_COST
            },
        };
        Self { size, maps, picture }
    }

    /// Work of this frame when the cheaper of the two light shaders, `detail=lean`, lights the sea.
    pub fn lean(mut self) -> Self {
        self.picture.light = cost::LEAN_LIGHT_FRAGMENT_COST;
        self.picture.displace = cost::DISPLACE_VERTEX_COST;
        self
    }

    /// Work of a frame of `params` on a GPU, whose maps are of half floats.
    pub fn planned(params: &Params, size: [u32; 2]) -> Self {
        let plan = Plan::new(params);
        let vertices = planned_vertex_count(params, &plan, size);
        Self::new(params, &plan, size, MapSizes::planned(&plan), vertices)
    }

    /// Names and costs of the passes.
    pub fn passes(&self) -> [(&'static str, Cost); 9] {
        let MapSizes { map_texels_per_side: n, cascades, foam_cells_per_side: foam_n, format } = self.maps;
        [
            ("rows", cost::row_pass_cost(n, cascades)),
            ("columns", cost::column_pass_cost(n, cascades, format)),
            ("mips", cost::mip_pass_cost(n, cascades, format)),
            ("foam", cost::foam_pass_cost(foam_n, cascades, format)),
            ("mesh", self.picture.mesh_cost()),
            ("light", self.picture.light_cost()),
            ("background", self.picture.background_cost()),
            ("tone", self.picture.tone_cost()),
            ("present", self.picture.present_cost()),
        ]
    }

    /// Cost of the whole frame.
    pub fn cost(&self) -> Cost {
        self.passes().into_iter().fold(Cost::default(), |sum, (_, pass)| sum + pass)
    }
}

/// Counted work and predicted times of a frame of a state, without a GPU: printed by `seastate bench --budget`.
pub struct Budget<'a> {
    /// The sea and its picture.
    pub params: &'a Params,
    /// Widths and heights of the pictures, pixels.
    pub sizes: &'a [[u32; 2]],
}

impl fmt::Display for Budget<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for &size in self.sizes {
            let work = FrameWork::planned(self.params, size);
            let ([width, height], MapSizes { map_texels_per_side: n, cascades, .. }) = (size, work.maps);
            writeln!(
                f,
                "frame of {width}x{height}, {:.0} % of it below the horizon; {:.2} million vertices; \
                 {cascades} cascades of {n}^2 in half floats",
                100.0 * work.picture.sea_fraction,
                1e-6 * work.picture.vertices
            )?;
            writeln!(f, "{:<12} {:>20} {:>14} {:>8}", "pass", "million operations", "million reads", "MB")?;
            for (pass, cost) in
                work.passes().into_iter().chain([("frame", work.cost()), ("lean frame", work.lean().cost())])
            {
                let [ops, reads, bytes] = [cost.flops, cost.reads, cost.bytes].map(|n| 1e-6 * n);
                writeln!(f, "{pass:<12} {ops:>20.0} {reads:>14.1} {bytes:>8.0}")?;
            }
            writeln!(f)?;
        }
        write!(f, "{:<12}", "predicted ms")?;
        self.sizes.iter().try_for_each(|[width, height]| write!(f, " {:>11}", format!("{width}x{height}")))?;
        writeln!(f, "  usual size, full and lean")?;
        for gpu in &GPU_CLASSES {
            write!(f, "{:<12}", gpu.name)?;
            for &size in self.sizes {
                write!(f, " {:>11.1}", gpu.predicted_ms(&FrameWork::planned(self.params, size).cost()))?;
            }
            let [width, height] = gpu.picture_px;
            let usual = FrameWork::planned(self.params, gpu.picture_px);
            let [full, lean] = [usual, usual.lean()].map(|work| gpu.predicted_ms(&work.cost()));
            writeln!(f, "  {full:.1} and {lean:.1} at {width}x{height}")?;
        }
        write!(f, "{Assumptions}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_has_all_passes_and_classes() {
        let params = Params::default();
        let work = FrameWork::planned(&params, [1920, 1080]);
        assert!(work.passes().iter().all(|(_, cost)| cost.flops > 1e6 && cost.bytes > 1e6));
        let whole = work.cost();
        assert!(work.lean().cost().flops < 0.65 * whole.flops);
        assert!(whole.flops <= 6.0e9 && whole.reads <= 60e6, "the budget of the default frame: {whole:?}");
        let text = Budget { params: &params, sizes: &[[1920, 1080]] }.to_string();
        assert!(GPU_CLASSES.iter().all(|gpu| text.contains(gpu.name)), "{text}");
    }
}
