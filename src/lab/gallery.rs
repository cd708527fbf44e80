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
    /// State string (`key=value&...`) of the picture with its version, in the form in which the program writes links.
    pub state: &'static str,
}

/// The pictures of the gallery, in the order of the page.
pub const GALLERY_PICTURES: &[GalleryPicture] = &[
    GalleryPicture {
        title: "Calm at dawn",
        description: "Beaufort 1 with a very low swell under cirrus: the water mirrors the sky just after sunrise.",
        state: "v=2&spectrum=pm&wind=1.5&scale2=1&hs2=0.3&tp2=9&sun=3&sunaz=80&clouds=cirrus&cloudcover=0.4\
                &glints=1&gusts=1&bloom=0.04&y=3&heading=62&pitch=3&t=40",
    },
    GalleryPicture {
        title: "Trade wind",
        description: "8 m/s from the east, a fully developed sea with fair-weather cumulus, and the swell of a \
                      storm far to the north.",
        state: "v=2&spectrum=pm&wind=8&dir=80&scale2=1&dir2=340&hs2=2&tp2=13&sun=48&sunaz=120&clouds=cumulus\
                &cloudcover=0.3&glints=1&gusts=1&bloom=0.04&y=5&heading=250&pitch=1&t=40",
    },
    GalleryPicture {
        title: "Fresh breeze",
        description: "11 m/s over 130 km of water: moderate waves, many whitecaps, and shadows of clouds on the sea.",
        state: "v=2&wind=11&fetch=130&sun=32&sunaz=320&clouds=cumulus&cloudcover=0.3&glints=1&gusts=1&bloom=0.04\
                &y=2.5&heading=55&pitch=0&t=40",
    },
    GalleryPicture {
        title: "North Sea gale",
        description: "Beaufort 8 in water 40 m deep under stratocumulus: the TMA spectrum, steep waves, streaks \
                      of foam.",
        state: "v=2&spectrum=tma&wind=19&fetch=300&dir=330&depth=40&sunaz=230&clouds=stratocumulus&cloudcover=0.6\
                &glints=1&gusts=1&bloom=0.04&y=4&heading=170&pitch=-1&t=46",
    },
    GalleryPicture {
        title: "Southern Ocean storm",
        description: "Beaufort 10 over 750 km of open water: a significant height of 15 m, seen from a trough.",
        state: "v=2&wind=26&fetch=750&dir=270&sun=22&sunaz=200&clouds=stratocumulus&cloudcover=0.7&glints=1\
                &gusts=1&bloom=0.04&y=3&heading=255&pitch=1&fov=45&t=43",
    },
    GalleryPicture {
        title: "Long swell",
        description: "A swell of three metres and sixteen seconds from a distant storm, under a light breeze.",
        state: "v=2&spectrum=pm&wind=3&scale2=1&dir2=290&hs2=3&tp2=16&swell2=1&sun=14&sunaz=300&clouds=cirrus\
                &glints=1&gusts=1&bloom=0.04&y=6&heading=280&pitch=1&t=40",
    },
    GalleryPicture {
        title: "Crossing seas",
        description: "A fresh wind sea across a swell of nine seconds, with the glints of a high sun.",
        state: "v=2&wind=11&scale2=1&dir2=330&hs2=2.2&tp2=9&swell2=0.3&sun=35&sunaz=160&clouds=cumulus\
                &cloudcover=0.2&glints=1&gusts=1&bloom=0.04&y=6&heading=205&pitch=-3&t=40",
    },
    GalleryPicture {
        title: "Shallow tropical water",
        description: "Four metres of water over sand, seagrass and reefs, with caustics.",
        state: "v=2&spectrum=tma&wind=5&fetch=12&depth=4&sun=62&sunaz=100&clouds=cumulus&cloudcover=0.2&glints=1\
                &gusts=1&caustics=1&bloom=0.04&y=8&heading=220&pitch=-14&t=40",
    },
    GalleryPicture {
        title: "Overcast",
        description: "A fresh breeze under a closed deck of low clouds.",
        state: "v=2&wind=9&fetch=80&sun=40&sunaz=330&clouds=storm&cloudcover=0.9&glints=1&gusts=1&bloom=0.04&y=3\
                &heading=50&pitch=1&t=40",
    },
    GalleryPicture {
        title: "Dusk",
        description: "The sun has just set behind scattered clouds.",
        state: "v=2&wind=6&fetch=35&sun=-1&sunaz=285&clouds=stratocumulus&glints=1&gusts=1&bloom=0.04&y=4\
                &heading=290&pitch=2&t=40",
    },
    GalleryPicture {
        title: "From the air",
        description: "A strong breeze from 90 m: whitecaps with their fading trails, and cumulus to the horizon.",
        state: "v=2&wind=11&fetch=130&sun=38&sunaz=300&clouds=cumulus&cloudcover=0.25&glints=1&gusts=1&bloom=0.04\
                &y=90&pitch=-9&t=40",
    },
    GalleryPicture {
        title: "Close to the ripples",
        description: "A light breeze seen from 1.2 m, with gravity and capillary waves (Elfouhaily's spectrum).",
        state: "v=2&spectrum=elfouhaily&wind=3&fetch=5&spread=elfouhaily&dispersion=capillary&sun=25&sunaz=60\
                &glints=1&gusts=1&bloom=0.04&y=1.2&heading=62&pitch=-8&t=30",
    },
    GalleryPicture {
        title: "Golden hour",
        description: "A low sun between few clouds: broken gold on the faces that tilt towards it.",
        state: "v=2&sun=7&sunaz=200&clouds=cumulus&cloudcover=0.12&glints=1&gusts=1&bloom=0.04&y=2.5&heading=188\
                &pitch=1&t=52",
    },
    GalleryPicture {
        title: "Towering clouds",
        description: "A moderate breeze under towering cumulus.",
        state: "v=2&wind=9&fetch=85&sun=25&sunaz=250&clouds=towering&cloudcover=0.25&glints=1&gusts=1&bloom=0.04&y=3\
                &heading=320&pitch=6&t=40",
    },
    GalleryPicture {
        title: "Green crests",
        description: "A near gale in green coastal water: light comes through the crests.",
        state: "v=2&wind=14&fetch=250&sun=22&sunaz=65&clouds=cumulus&cloudcover=0.2&water=3c&glints=1&gusts=1\
                &bloom=0.04&y=2.5&pitch=-1&t=33",
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
