//! `seastate export`: writes the wave maps as OpenEXR files of 32-bit floats, and their description as plan.json.

use super::{create_folder, write_file};
use crate::gpu::Gpu;
use crate::ocean::Ocean;
use crate::ocean::maps_file::{self, Channel};
use crate::state::{Params, query};
use crate::waves::second_order::ProductFactors;
use exr::prelude::*;
use std::path::Path;

/// Index of the foam level that is exported: 0 is the smallest and finest of the square foam grids around the camera.
const EXPORTED_FOAM_LEVEL: usize = 1;

/// Writes the wave maps and one foam level of the sea of `params` at its time to a folder as OpenEXR files, with their
/// description as plan.json. With `raw`, also bare texels: heights.f32 (m) and displacement.f16 (half floats).
///
/// # Errors
/// One sentence, if a file cannot be written or reading back from the GPU fails.
pub async fn run(gpu: &Gpu, params: &Params, folder: &Path, raw: bool) -> std::result::Result<(), String> {
    create_folder(folder)?;
    let mut ocean = Ocean::without_renderer(gpu, params);
    let maps = ocean.read_maps().await?;
    let foam = ocean.read_foam().await?.remove(EXPORTED_FOAM_LEVEL);
    let plan = ocean.plan().clone();
    let n = maps.n;
    for c in 0..maps.cascade_count() {
        let (d, g) = (maps.displacement(c), maps.gradients(c));
        write_exr(
            &folder.join(format!("cascade{c}_displacement.exr")),
            n,
            &maps_file::displacement_channels(&plan, &maps, c),
        )?;
        let gradients: [Channel<'_>; 5] = [
            ("deta_dx", Box::new(move |i| g[i][0])),
            ("deta_dz", Box::new(move |i| g[i][1])),
            ("dDx_dx", Box::new(move |i| g[i][2])),
            ("dDz_dz", Box::new(move |i| g[i][3])),
            ("dDx_dz", Box::new(move |i| d[i][3])),
        ];
        write_exr(&folder.join(format!("cascade{c}_gradients.exr")), n, &gradients)?;
    }
    let channels: [Channel<'_>; 1] = [("foam", Box::new(|i| foam.foam[i]))];
    write_exr(&folder.join("foam.exr"), foam.cells_per_side, &channels)?;
    if raw {
        let heights: Vec<f32> =
            (0..maps.cascade_count()).flat_map(|c| maps.displacement(c).iter().map(|d| d[1])).collect();
        write_file(&folder.join("heights.f32"), bytemuck::cast_slice(&heights))?;
        // Mip level 0 of the half-float displacement maps that the renderer samples.
        let texels = ocean.read_displacement().await?;
        let halves: Vec<f16> = texels.iter().flatten().map(|&x| f16::from_f32(x)).collect();
        write_file(&folder.join("displacement.f16"), bytemuck::cast_slice(&halves))?;
    }
    let bound = plan.bound_waves();
    let factors = |f: ProductFactors| [f.elevation, f.displacement];
    let about = serde_json::json!({
        "state": query::write(params),
        "t_s": params.clock.t_s,
        "period_s": plan.repeat_period_s,
        "axes": "+x east, +y up, +z south; column i holds x = i patch_m / n, row j holds z = j patch_m / n",
        "chop_xz": plan.sea.choppiness_xz(),
        "level_m": plan.sea.still_water_level_m,
        "untile": plan.blends_copies,
        "notices": plan.notices.iter().chain(&plan.resolution_note).collect::<Vec<_>>(),
        "cascades": plan.cascades.iter().enumerate().map(|(i, c)| serde_json::json!({
            "displacement": format!("cascade{i}_displacement.exr"),
            "gradients": format!("cascade{i}_gradients.exr"),
            "n": plan.n, "patch_m": c.patch_m, "k_low": c.k_low, "k_high": c.k_high,
            "bound_own": factors(bound.cascades[i].own), "bound_level_m": bound.cascades[i].level_m,
            "bound_with_shorter": factors(bound.cascades[i].with_shorter),
        })).collect::<Vec<_>>(),
        "bound_elevation_gain": bound.totals.elevation_gain,
        "foam": {
            "file": "foam.exr", "n": foam.cells_per_side, "side_m": foam.cells_per_side as f64 * foam.cell_m,
            "corner_xz_m": foam.north_west_corner_m,
            "what": "foam 0..1 in undisplaced coordinates, first row at the smallest z; for the sea as drawn, which \
             blends shifted copies of the patches unless untile is false",
        },
    });
    let text = serde_json::to_string_pretty(&about).unwrap_or_default() + "\n";
    write_file(&folder.join("plan.json"), text)
}

/// Writes an OpenEXR file of `n` x `n` texels with f32 channels.
fn write_exr(path: &Path, n: usize, channels: &[Channel<'_>]) -> std::result::Result<(), String> {
    let layer = maps_file::exr_layer(n, LayerAttributes::default(), channels);
    let image = Image::from_layer(layer);
    image.write().to_file(path).map_err(|e| format!("cannot write {}: {e}", path.display()))
}
