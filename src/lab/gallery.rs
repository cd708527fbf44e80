//! `seastate gallery`: writes docs/gallery.md and renders its pictures, each from a state string.

use super::page::MarkdownPage;
use super::{create_folder, write_file};
use crate::gpu::Gpu;
use crate::ocean::still;
use crate::state::query;
use image::codecs::jpeg::JpegEncoder;
use std::path::Path;

/// Width and height of a gallery picture, pixels.
const PICTURE_SIZE: [u32; 2] = [960, 540];
/// Quality of the JPEG files, 1 to 100.
const JPEG_QUALITY: u8 = 88;
/// Address at which `scripts/serve.sh` serves the app's web page; the gallery links each picture to it.
const LOCAL_APP_URL: &str = "http://localhost:8080/";

/// A picture of the gallery: title, description and state string.
#[derive(Clone, Copy, Debug)]
pub struct GalleryPicture {
    /// Title of the picture. Its file name is made from the title.
    pub title: &'static str,
    /// Text about the picture, a paragraph of the gallery page.
    pub description: &'static str,
    /// State string (`key=value&...`) of the picture, in the form in which the program itself writes it.
    pub state: &'static str,
}

/// The pictures of the gallery, in the order of the page.
pub const GALLERY_PICTURES: &[GalleryPicture] = &[
    GalleryPicture {
        title: "Calm at dawn",
        description: "Beaufort 1 with a very low swell: the water mirrors the sky just after sunrise.",
        state: "spectrum=pm&wind=1.5&scale2=1&hs2=0.3&tp2=9&sun=3&y=3&heading=62&pitch=-3&t=40",
    },
    GalleryPicture {
        title: "Trade wind",
        description: "8 m/s from the east, a fully developed sea, with the swell of a storm far to the north.",
        state: "spectrum=pm&wind=8&dir=80&scale2=1&dir2=340&tp2=13&sun=48&sunaz=120&y=9&heading=250&pitch=-6&t=40",
    },
    GalleryPicture {
        title: "Fresh breeze",
        description: "Beaufort 5 over 150 km of water: moderate waves and many whitecaps.",
        state: "wind=10&sun=32&heading=55&pitch=-5&t=40",
    },
    GalleryPicture {
        title: "North Sea gale",
        description: "Beaufort 8 in water 40 m deep: the TMA spectrum, steep waves, streaks of foam.",
        state: "spectrum=tma&wind=19&fetch=300&dir=330&depth=40&sun=18&sunaz=200&overcast=0.85&y=12&heading=150\
                &pitch=-5&t=40",
    },
    GalleryPicture {
        title: "Southern Ocean storm",
        description: "Beaufort 10 over 750 km of open water: waves eleven metres high, seen from a trough.",
        state: "wind=26&fetch=750&dir=270&sun=14&sunaz=320&overcast=0.6&y=2&heading=275&pitch=1&fov=38&t=43",
    },
    GalleryPicture {
        title: "Long swell",
        description: "A swell of three metres and sixteen seconds from a distant storm, under a light breeze.",
        state: "spectrum=pm&wind=3&scale2=1&dir2=290&hs2=3&tp2=16&swell2=1&sun=20&sunaz=300&y=10&heading=280\
                &pitch=-5&t=40",
    },
    GalleryPicture {
        title: "Crossing seas",
        description: "A wind sea from the south-west and an older sea from the north-west: pyramids where crests meet.",
        state: "wind=11&scale2=1&dir2=330&hs2=2.2&tp2=9&swell2=0.3&sun=35&sunaz=160&y=14&heading=200&pitch=-9&t=40",
    },
    GalleryPicture {
        title: "Shallow tropical water",
        description: "Water four metres deep over sand, in the trade wind.",
        state: "spectrum=tma&wind=5&fetch=12&depth=4&sun=62&sunaz=100&y=8&heading=220&pitch=-14&t=40",
    },
    GalleryPicture {
        title: "Overcast",
        description: "Beaufort 4 under a closed deck of cloud: no sun and no glitter.",
        state: "wind=7&fetch=50&sun=35&overcast=1&heading=50&t=40",
    },
    GalleryPicture {
        title: "Dusk",
        description: "After sunset, the water reflects the light of the western sky.",
        state: "wind=6&fetch=35&sun=-2&sunaz=285&y=5&heading=290&pitch=-3&t=40",
    },
    GalleryPicture {
        title: "From the air",
        description: "A near gale from a height of 600 m: wave groups, whitecaps and the sun's glitter.",
        state: "wind=15&fetch=250&sun=42&sunaz=190&y=600&heading=185&pitch=-28&t=40",
    },
    GalleryPicture {
        title: "Close to the ripples",
        description: "A light breeze, seen from a metre above the water: Elfouhaily's spectrum with capillary waves.",
        state: "spectrum=elfouhaily&wind=3&fetch=5&spread=elfouhaily&dispersion=capillary&sun=25&sunaz=60&y=1.2\
                &heading=50&pitch=-18&t=40",
    },
];

impl GalleryPicture {
    /// File name of the picture (made from its title, with the extension .jpg), without a folder.
    pub fn file_name(&self) -> String {
        format!("{}.jpg", self.title.to_lowercase().replace(' ', "-"))
    }
}

/// Renders the pictures whose title contains `only`, and writes gallery.md and the folder gallery/ into the folder
/// `output`. Returns a line for the terminal: the path of the page and the number of pictures.
///
/// # Errors
/// If no title contains `only`, reading back from the GPU fails, or a file cannot be written.
pub async fn run(gpu: &Gpu, output: &Path, only: &str) -> Result<String, String> {
    let lower_case = only.to_lowercase();
    let chosen: Vec<&GalleryPicture> =
        GALLERY_PICTURES.iter().filter(|p| p.title.to_lowercase().contains(&lower_case)).collect();
    if chosen.is_empty() {
        let titles: Vec<&str> = GALLERY_PICTURES.iter().map(|p| p.title).collect();
        return Err(format!("no picture is called \"{only}\"; there are: {}", titles.join(", ")));
    }
    let folder = output.join("gallery");
    create_folder(&folder)?;
    for picture in &chosen {
        let pixels = still::draw_picture(gpu, &query::parse(picture.state).0, PICTURE_SIZE).await?;
        write_jpeg(&pixels, &folder.join(picture.file_name()))?;
    }
    let path = output.join("gallery.md");
    write_file(&path, gallery_markdown())?;
    Ok(format!("{} and {} of {} pictures", path.display(), chosen.len(), GALLERY_PICTURES.len()))
}

fn write_jpeg(pixels: &[u8], path: &Path) -> Result<(), String> {
    let rgb: Vec<u8> = pixels.chunks(4).flat_map(|p| &p[..3]).copied().collect();
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY)
        .encode(&rgb, PICTURE_SIZE[0], PICTURE_SIZE[1], image::ExtendedColorType::Rgb8)
        .map_err(|e| format!("cannot encode {}: {e}", path.display()))?;
    write_file(path, bytes)
}

/// The Markdown text of docs/gallery.md.
pub fn gallery_markdown() -> String {
    let mut page = MarkdownPage::default();
    page.heading(1, "Gallery");
    page.paragraph(
        "Each picture shows one state string. The link opens it on the page while scripts/serve.sh runs; every command \
         takes the string in quotes. `seastate gallery` renders all pictures.",
    );
    for picture in GALLERY_PICTURES {
        page.heading(2, picture.title);
        page.paragraph(&format!("![{}](gallery/{})", picture.title, picture.file_name()));
        page.paragraph(picture.description);
        page.paragraph(&format!("[`{0}`]({LOCAL_APP_URL}?{0})", picture.state));
    }
    page.markdown()
}
