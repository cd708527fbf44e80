//! Renders a state string to a PNG without a window.
//!
//! `cargo run --release --example headless -- 'wind=14&fetch=300&sun=20' sea.png`

#![expect(clippy::print_stdout, reason = "the example prints its results")]

use seastate::gpu::Gpu;
use seastate::ocean::still;
use seastate::state::query;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let state = arguments.next().unwrap_or_else(|| "wind=12&t=40".to_owned());
    let path = arguments.next().unwrap_or_else(|| "sea.png".to_owned());

    // Every state string gives valid parameters. A value that cannot be taken becomes a notice.
    let (params, notices) = query::parse(&state);
    for notice in notices {
        eprintln!("{notice}");
    }

    let size = [1280, 720];
    let pixels = pollster::block_on(async {
        let gpu = Gpu::request().await?;
        still::draw_picture(&gpu, &params, size).await
    })?;

    image::save_buffer(&path, &pixels, size[0], size[1], image::ColorType::Rgba8)?;
    println!("{path}: {}", query::write(&params));
    Ok(())
}
