//! `seastate gallery`: docs/gallery.md and its pictures, each from its state string.

use super::validate::page::Page;
use crate::gpu::Gpu;
use crate::ocean::still;
use crate::state::query;
use image::codecs::jpeg::JpegEncoder;
use std::path::{Path, PathBuf};

/// Width and height of a picture, pixels.
const SIZE: [u32; 2] = [960, 540];
/// Of the JPEG files, of 100.
const QUALITY: u8 = 88;
/// Where `scripts/serve.sh` serves the page.
const PAGE: &str = "http://localhost:8080/";

/// A picture: its title, a line about it, and its state.
#[derive(Clone, Copy, Debug)]
pub struct Sea {
    /// Title; its file is called after it.
    pub title: &'static str,
    /// What is to be seen.
    pub about: &'static str,
    /// State string, as the program writes it.
    pub state: &'static str,
}

/// The pictures, in order.
pub const SEAS: &[Sea] = &[
    Sea {
        title: "Calm at dawn",
        about: "Beaufort 1 and hardly a swell: the sky lies in the water, and the sun is just up.",
        state: "spectrum=pm&wind=1.5&scale2=1&hs2=0.3&tp2=9&sun=3&y=3&heading=62&pitch=-3&t=40",
    },
    Sea {
        title: "Trade wind",
        about: "8 m/s from the east over as long a fetch as waves can use, with the swell of a storm far to the north: the sea of most days.",
        state: "spectrum=pm&wind=8&dir=80&scale2=1&dir2=340&tp2=13&sun=48&sunaz=120&y=9&heading=250&pitch=-6&t=40",
    },
    Sea {
        title: "Fresh breeze",
        about: "Beaufort 5 after 150 km: moderate waves, and many white horses.",
        state: "wind=10&sun=32&heading=55&pitch=-5&t=40",
    },
    Sea {
        title: "North Sea gale",
        about: "Beaufort 8 over 40 m of water: TMA's spectrum, steep seas, foam in streaks.",
        state: "spectrum=tma&wind=19&fetch=300&dir=330&depth=40&sun=18&sunaz=200&overcast=0.85&y=12&heading=150&pitch=-5&t=40",
    },
    Sea {
        title: "Southern Ocean storm",
        about: "Beaufort 10 over 750 km of open water: waves of eleven metres, seen from a trough.",
        state: "wind=26&fetch=750&dir=270&sun=14&sunaz=320&overcast=0.6&y=2&heading=275&pitch=1&fov=38&t=43",
    },
    Sea {
        title: "Long swell",
        about: "Three metres at sixteen seconds from a storm days away, under a light breeze.",
        state: "spectrum=pm&wind=3&scale2=1&dir2=290&hs2=3&tp2=16&swell2=1&sun=20&sunaz=300&y=10&heading=280&pitch=-5&t=40",
    },
    Sea {
        title: "Crossing seas",
        about: "A wind sea from the south-west and another, older one from the north-west: pyramids where crests meet.",
        state: "wind=11&scale2=1&dir2=330&hs2=2.2&tp2=9&swell2=0.3&sun=35&sunaz=160&y=14&heading=200&pitch=-9&t=40",
    },
    Sea {
        title: "Shallow tropical water",
        about: "Four metres over sand in the trade wind.",
        state: "spectrum=tma&wind=5&fetch=12&depth=4&sun=62&sunaz=100&y=8&heading=220&pitch=-14&t=40",
    },
    Sea {
        title: "Overcast",
        about: "A grey day, Beaufort 4: no sun, no glitter, all light from the deck of cloud.",
        state: "wind=7&fetch=50&sun=35&overcast=1&heading=50&t=40",
    },
    Sea {
        title: "Dusk",
        about: "The sun has gone; the water keeps the light of the western sky.",
        state: "wind=6&fetch=35&sun=-2&sunaz=285&y=5&heading=290&pitch=-3&t=40",
    },
    Sea {
        title: "From the air",
        about: "600 m up in a near gale: the groups of waves, their whitecaps, and the sun's glitter.",
        state: "wind=15&fetch=250&sun=42&sunaz=190&y=600&heading=185&pitch=-28&t=40",
    },
    Sea {
        title: "Close to the ripples",
        about: "A light air a metre below the eye: Elfouhaily's spectrum with capillary waves.",
        state: "spectrum=elfouhaily&wind=3&fetch=5&spread=elfouhaily&dispersion=capillary&sun=25&sunaz=60&y=1.2&heading=50&pitch=-18&t=40",
    },
];

/// Arguments of the command.
#[derive(clap::Args, Clone, Debug)]
pub struct Options {
    /// Folder to write gallery.md and gallery/ to
    #[arg(short, long, default_value = "docs")]
    pub output: PathBuf,
    /// Only the pictures whose title contains this text
    #[arg(long, default_value = "", hide_default_value = true)]
    pub only: String,
}

impl Sea {
    /// Name of its file, without folder.
    pub fn file(&self) -> String {
        format!("{}.jpg", self.title.to_lowercase().replace(' ', "-"))
    }
}

/// Renders the pictures and writes the page; returns what to say.
///
/// # Errors
/// If nothing is called `only`, there is no GPU, or a file cannot be written.
pub fn run(options: &Options) -> Result<String, String> {
    let only = options.only.to_lowercase();
    let chosen: Vec<&Sea> = SEAS.iter().filter(|sea| sea.title.to_lowercase().contains(&only)).collect();
    if chosen.is_empty() {
        let titles: Vec<&str> = SEAS.iter().map(|sea| sea.title).collect();
        return Err(format!("no picture is called \"{}\"; there are: {}", options.only, titles.join(", ")));
    }
    let folder = options.output.join("gallery");
    std::fs::create_dir_all(&folder).map_err(|e| format!("cannot make {}: {e}", folder.display()))?;
    let gpu = pollster::block_on(Gpu::request())?;
    for sea in &chosen {
        let pixels = pollster::block_on(still::picture(&gpu, &query::parse(sea.state).0, SIZE))?;
        write_jpeg(&pixels, &folder.join(sea.file()))?;
    }
    let path = options.output.join("gallery.md");
    std::fs::write(&path, page()).map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    Ok(format!("{} and {} of {} pictures", path.display(), chosen.len(), SEAS.len()))
}

fn write_jpeg(pixels: &[u8], path: &Path) -> Result<(), String> {
    let rgb: Vec<u8> = pixels.chunks(4).flat_map(|p| &p[..3]).copied().collect();
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, QUALITY)
        .encode(&rgb, SIZE[0], SIZE[1], image::ExtendedColorType::Rgb8)
        .map_err(|e| format!("cannot encode {}: {e}", path.display()))?;
    std::fs::write(path, bytes).map_err(|e| format!("cannot write {}: {e}", path.display()))
}

/// The page.
pub fn page() -> String {
    let mut page = Page::default();
    page.heading(1, "Gallery");
    page.prose(
        "Every picture is a state string and nothing else: the link opens it on the page while scripts/serve.sh serves \
         it, and the string in quotes is what every command takes. All are rendered anew by `seastate gallery`.",
    );
    for sea in SEAS {
        page.heading(2, sea.title);
        page.prose(&format!("![{}](gallery/{})", sea.title, sea.file()));
        page.prose(sea.about);
        page.prose(&format!("[`{0}`]({PAGE}?{0})", sea.state));
    }
    format!("{}\n", page.text().trim_end())
}
