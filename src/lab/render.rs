//! `seastate render`: writes a picture as PNG, a sequence of pictures, and layers for compositing software.

use super::create_folder;
use super::reference::{self, SamplingSettings};
use crate::gpu::{Gpu, readback};
use crate::ocean::still::{PICTURE_FORMAT, draw_ocean_picture, present_and_read_back};
use crate::ocean::{Ocean, OutputKind};
use crate::state::Params;
use crate::state::views::{DisplayedView, SurfaceView, ViewChoice};
use exr::prelude::*;
use std::path::Path;

/// Distance of the camera's near plane, m. A depth texture holds the near plane's distance divided by the surface's
/// distance, both along the viewing direction.
const NEAR_PLANE_M: f32 = 0.1;
/// Distance that is written to OpenEXR files for sky pixels, m: compositing software expects a very large number.
const SKY_DISTANCE_M: f32 = 1e10;

/// Settings of `seastate render --frames`: a sequence of pictures over simulated time.
#[derive(Clone, Debug)]
pub struct PictureSequence {
    /// Number of pictures in the sequence.
    pub picture_count: u32,
    /// Pictures per second of the played sequence. The state's `speed` (simulated seconds per second) divided by this
    /// rate is the simulated time between two pictures.
    pub fps: f64,
    /// Whether each picture also gets an OpenEXR file with its linear light, distances (m) and surface normals.
    pub writes_layers: bool,
}

/// Renders the sea of `params` at its time to a PNG. With `sampling`, a reference picture of many samples per pixel.
///
/// # Errors
/// One sentence, if reading back from the GPU fails or the file cannot be written.
pub async fn write_picture(
    gpu: &Gpu,
    params: &Params,
    size: [u32; 2],
    sampling: Option<SamplingSettings>,
    path: &Path,
) -> std::result::Result<(), String> {
    let mut ocean = Ocean::new(gpu, PICTURE_FORMAT, OutputKind::Screen, params);
    let mut pixels = draw_ocean_picture(gpu, &mut ocean, size).await?;
    if let Some(sampling) = sampling {
        pixels = reference::reference_picture(gpu, &mut ocean, size, sampling).await?;
    }
    write_png(pixels, size, path)
}

fn write_png(pixels: Vec<u8>, size: [u32; 2], path: &Path) -> std::result::Result<(), String> {
    let image = image::RgbaImage::from_raw(size[0], size[1], pixels).ok_or("the picture has a wrong size")?;
    image.save_with_format(path, image::ImageFormat::Png).map_err(|e| format!("cannot write {}: {e}", path.display()))
}

/// Renders a sequence of pictures that begins at the time of `params`, and writes it to a folder. Returns a line for
/// the terminal: the number of pictures and the folder.
///
/// # Errors
/// One sentence, if reading back from the GPU fails or a file cannot be written.
pub async fn write_sequence(
    gpu: &Gpu,
    params: &Params,
    size: [u32; 2],
    sequence: &PictureSequence,
    folder: &Path,
) -> std::result::Result<String, String> {
    if !(sequence.fps.is_finite() && sequence.fps > 0.0) {
        return Err("--fps must be above 0".into());
    }
    create_folder(folder)?;
    let mut params = params.clone();
    let start_s = params.clock.t_s;
    let film = if sequence.writes_layers { OutputKind::ReadBack } else { OutputKind::Screen };
    let mut ocean = Ocean::new(gpu, PICTURE_FORMAT, film, &params);
    for i in 0..sequence.picture_count {
        params.clock.t_s = start_s + f64::from(i) / sequence.fps * params.clock.speed;
        ocean.set_params(&params);
        let pixels = draw_ocean_picture(gpu, &mut ocean, size).await?;
        let path = folder.join(format!("frame-{i:05}.png"));
        write_png(pixels, size, &path)?;
        if sequence.writes_layers {
            write_layers(gpu, &mut ocean, &params, size, &path.with_extension("exr")).await?;
        }
    }
    let what = if sequence.writes_layers { "pictures and layers" } else { "pictures" };
    Ok(format!("{} {what} in {}", sequence.picture_count, folder.display()))
}

/// Writes an OpenEXR file with the linear light, distances (m) and surface normals of the picture that was last drawn.
async fn write_layers(
    gpu: &Gpu,
    ocean: &mut Ocean,
    params: &Params,
    size: [u32; 2],
    path: &Path,
) -> std::result::Result<(), String> {
    let light = light_of(gpu, ocean).await?;
    let mut view = params.clone();
    view.look.view = ViewChoice { displayed: DisplayedView::Surface(SurfaceView::Normals), cascade: 0 };
    ocean.set_params(&view);
    let mut encoder = gpu.encoder("layers");
    ocean.record_frame_with_complete_foam(&mut encoder, size);
    present_and_read_back(gpu, encoder, size, |pass| ocean.present(pass)).await?;
    let normals = light_of(gpu, ocean).await?;
    let texture = ocean.depth_texture().ok_or("nothing was drawn")?;
    let mut encoder = gpu.encoder("depth");
    let copy = readback::stage_texture(gpu, &mut encoder, texture, 0);
    gpu.submit(encoder);
    let depth: Vec<f32> = bytemuck::pod_collect_to_vec(&copy.read(gpu).await?);
    let width = size[0] as usize;
    let channels = SpecificChannels::build()
        .with_channel("R")
        .with_channel("G")
        .with_channel("B")
        .with_channel("Z")
        .with_channel("N.X")
        .with_channel("N.Y")
        .with_channel("N.Z")
        .with_pixel_fn(|at: Vec2<usize>| {
            let i = at.y() * width + at.x();
            let [r, g, b] = [0, 1, 2].map(|c| light[4 * i + c]);
            if depth[i] <= 0.0 {
                return (r, g, b, SKY_DISTANCE_M, 0.0, 0.0, 0.0);
            }
            // The debug view of normals maps the components east, north and up from -1..1 to 0..1.
            let [east, north, up] = [0, 1, 2].map(|c| 2.0 * normals[4 * i + c] - 1.0);
            (r, g, b, NEAR_PLANE_M / depth[i], east, up, -north)
        });
    Image::from_channels((width, size[1] as usize), channels)
        .write()
        .to_file(path)
        .map_err(|e| format!("cannot write {}: {e}", path.display()))
}

/// Reads back the linear light of the frame that `ocean` drew last: red, green, blue and alpha of each pixel, row by
/// row.
async fn light_of(gpu: &Gpu, ocean: &Ocean) -> std::result::Result<Vec<f32>, String> {
    let texture = ocean.lit_picture_texture().ok_or("nothing was drawn")?;
    let mut encoder = gpu.encoder("light");
    let copy = readback::stage_texture(gpu, &mut encoder, texture, 0);
    gpu.submit(encoder);
    let halves: Vec<f16> = bytemuck::pod_collect_to_vec(&copy.read(gpu).await?);
    Ok(halves.iter().map(|h| h.to_f32()).collect())
}
