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
/// Number of drawn pixels along each side of a pixel of a picture, as on a screen with small pixels.
const PIXELS_PER_PIXEL: u32 = 2;
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
        title: "A fine day",
        description: "The sea that the page opens with: a fresh breeze on a long swell, a low sun beside cirrus, \
                      and a yacht that sails past.",
        state: "v=2&wind=8&fetch=60&dir=150&scale2=1&hs2=1.8&swell2=0.8&sun=18&sunaz=5&haze=0.2&clouds=cirrus\
                &cloudcover=0.3&glints=1&gusts=1&bloom=0.06&localexposure=0.5&y=3.5&heading=330&pitch=4&fov=45&t=42\
                &afloat=yacht*-40*-90",
    },
    GalleryPicture {
        title: "Calm at dawn",
        description: "Beaufort 1 with a very low swell under cirrus: the water mirrors the sky just after sunrise.",
        state: "v=2&spectrum=pm&wind=1.5&scale2=1&hs2=0.3&tp2=9&sun=3&sunaz=80&haze=0.5&clouds=cirrus&cloudcover=0.4\
                &glints=1&gusts=1&bloom=0.12&localexposure=0.5&y=3&heading=62&pitch=3&t=40&afloat=yacht*76*-36",
    },
    GalleryPicture {
        title: "Trade wind",
        description: "9 m/s from the south, a fully developed sea, and the swell of a storm far to the north: a yacht \
                      sails close to the wind in the last hour of the day.",
        state: "v=2&spectrum=pm&wind=9&dir=170&scale2=1&dir2=340&hs2=2&tp2=13&sun=8&sunaz=225&haze=0.3\
                &clouds=cirrus&cloudcover=0.4&glints=1&gusts=1&bloom=0.04&localexposure=0.5&y=3.5&heading=250\
                &pitch=2&fov=45&t=34&afloat=yacht*-32*18",
    },
    GalleryPicture {
        title: "Near gale",
        description: "Beaufort 7 over 250 km of water: a yacht beats to windward beside the sun's glitter.",
        state: "v=2&wind=15&fetch=250&dir=250&sun=12&sunaz=335&haze=0.3&clouds=stratocumulus&cloudcover=0.6&glints=1\
                &gusts=1&spray=1&exposure=-0.3&bloom=0.06&localexposure=0.5&y=4&heading=325&pitch=3&fov=35&t=47\
                &afloat=yacht*-34*-42",
    },
    GalleryPicture {
        title: "Southern Ocean storm",
        description: "Beaufort 10 over 800 km of open water, a significant height of 16 m: crests break in the sun \
                      between clouds, and the wind tears spray off them.",
        state: "v=2&wind=26&fetch=800&dir=270&seed=3&sun=20&sunaz=195&haze=0.25&clouds=stratocumulus&cloudcover=0.6\
                &glints=1&gusts=1&spray=1&bloom=0.05&localexposure=0.5&y=6&heading=240&pitch=2&fov=24&t=82",
    },
    GalleryPicture {
        title: "Spindrift",
        description: "Beaufort 10 beside the sun's glitter: streaks of foam lie along the wind, which tears spray \
                      off the crests.",
        state: "v=2&wind=26&fetch=500&dir=250&sun=12&sunaz=232&haze=0.1&clouds=stratocumulus&cloudcover=0.45&glints=1\
                &gusts=1&spray=1&exposure=-0.3&bloom=0.06&localexposure=0.5&y=3&heading=210&pitch=0&fov=40&t=31",
    },
    GalleryPicture {
        title: "Long swell",
        description: "A swell of four metres and fourteen seconds from a distant storm, under a light breeze.",
        state: "v=2&spectrum=pm&wind=4&scale2=1&dir2=290&hs2=4&tp2=14&swell2=1&sun=4&sunaz=268&haze=0.15\
                &clouds=cirrus&cloudcover=0.45&glints=1&gusts=1&exposure=-0.2&bloom=0.05&localexposure=0.3&y=4\
                &heading=285&pitch=1&fov=30&t=52&afloat=yacht*-95*-18",
    },
    GalleryPicture {
        title: "Golden hour",
        description: "A low sun below broken clouds, and a yacht in a moderate breeze on an old swell: waves shade \
                      each other, and the crests between carry the light.",
        state: "v=2&wind=5.5&fetch=40&dir=225&scale2=1&dir2=205&hs2=1.6&tp2=9&swell2=0.7&sun=3&sunaz=200&haze=0.5\
                &clouds=stratocumulus&cloudcover=0.65&glints=1&gusts=1&exposure=-0.2&bloom=0.06&localexposure=0.5\
                &y=2.5&heading=206&pitch=3&fov=42&t=105&afloat=yacht*-17*93",
    },
    GalleryPicture {
        title: "Under water",
        description: "Four metres down, over ripples of sand with caustics: Snell's window in the waves, total \
                      reflection around it, and shafts of sunlight.",
        state: "v=2&wind=5&fetch=25&depth=7&sun=42&sunaz=40&haze=0.3&clouds=cumulus&glints=1&gusts=1&bedcover=0\
                &bloom=0.05&localexposure=0.5&x=-150&dive=4&z=90&heading=30&pitch=8&fov=85&t=18",
    },
    GalleryPicture {
        title: "Sea mist",
        description: "A light air in thin fog: a yacht comes out of the haze beside the path of a low sun.",
        state: "v=2&spectrum=pm&wind=2.5&scale2=1&hs2=0.4&tp2=9&sun=7&sunaz=62&fog=2&glints=1&gusts=1&bloom=0.08\
                &localexposure=0.5&y=2.5&heading=48&pitch=3&fov=32&t=40&afloat=yacht*75*-105",
    },
    GalleryPicture {
        title: "Rain",
        description: "Showers from a broken deck: a low sun sends its rays between the clouds, and a yacht sails \
                      through.",
        state: "v=2&wind=6&fetch=20&dir=300&scale2=1&hs2=0.6&tp2=7&swell2=0.7&sun=5&sunaz=20&clouds=stratocumulus\
                &cloudcover=0.8&rain=3&squalls=1&glints=1&gusts=1&bloom=0.05&localexposure=0.5&y=3&heading=28&pitch=4\
                &fov=35&t=1000&afloat=yacht*42*-100",
    },
    GalleryPicture {
        title: "Shallow tropical water",
        description: "Four metres of water from 60 m: sand, seagrass and reefs below a light breeze, with caustics.",
        state: "v=2&spectrum=tma&wind=3&fetch=4&dir=140&depth=4&sun=50&sunaz=70&haze=0.3&clouds=cirrus&cloudcover=0.3\
                &glints=1&gusts=1&bedcover=0.45&caustics=1&bloom=0.04&localexposure=0.5&y=60&heading=300&pitch=-32\
                &fov=45&t=40",
    },
    GalleryPicture {
        title: "Dusk",
        description: "The sun has set for the sea, but not yet for the cirrus high above it.",
        state: "v=2&wind=4&fetch=20&scale2=1&hs2=1.2&tp2=9&swell2=0.7&sun=-1.5&sunaz=285&clouds=cirrus&cloudcover=0.5\
                &glints=1&gusts=1&bloom=0.04&localexposure=0.5&y=3&heading=294&pitch=3&t=40&afloat=yacht*-58*-13",
    },
    GalleryPicture {
        title: "Close to the ripples",
        description: "A light breeze seen from 1.2 m, with gravity and capillary waves (Elfouhaily's spectrum).",
        state: "v=2&spectrum=elfouhaily&wind=3&fetch=5&spread=elfouhaily&dispersion=capillary&sun=12&sunaz=52\
                &haze=0.2&clouds=cirrus&glints=1&gusts=1&bloom=0.06&localexposure=0.5&y=1.2&heading=62&pitch=-6&t=30",
    },
    GalleryPicture {
        title: "From the air",
        description: "A strong breeze from 55 m: whitecaps with their fading trails, a yacht with its wake, and \
                      cumulus to the horizon.",
        state: "v=2&wind=11&fetch=135&sun=30&sunaz=60&haze=0.4&clouds=cumulus&glints=1&gusts=1&bloom=0.04\
                &localexposure=0.5&y=55&heading=0&pitch=-9&t=40&afloat=yacht*22*-120",
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
        let drawn_size = PICTURE_SIZE.map(|side| side * PIXELS_PER_PIXEL);
        let pixels = still::draw_picture(gpu, &query::parse(picture.state).0, drawn_size).await?;
        write_jpeg(&reduced(&pixels), &folder.join(picture.file_name()))?;
    }
    let path = output.join("gallery.md");
    write_file(&path, gallery_markdown())?;
    Ok(format!("{} and {} of {} pictures", path.display(), chosen.len(), GALLERY_PICTURES.len()))
}

/// Means over the squares of drawn pixels, in linear light: the picture that the eye sees from a distance.
fn reduced(drawn: &[u8]) -> Vec<u8> {
    let (scale, [width, height]) = (PIXELS_PER_PIXEL as usize, PICTURE_SIZE.map(|side| side as usize));
    let mean = |x: usize, y: usize, channel: usize| {
        let places = (0..scale * scale).map(|i| (y * scale + i / scale) * width * scale + x * scale + i % scale);
        let squares = places.map(|place| f64::from(drawn[4 * place + channel]).powf(2.2)).sum::<f64>();
        (squares / (scale * scale) as f64).powf(1.0 / 2.2).round() as u8
    };
    (0..width * height * 4).map(|i| mean(i / 4 % width, i / 4 / width, i % 4)).collect()
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
         takes the string in quotes. `seastate gallery` renders all pictures, at 1920 x 1080 \
         pixels, which are halved as a screen with small pixels shows them.",
    );
    for picture in GALLERY_PICTURES {
        page.heading(2, picture.title);
        page.paragraph(&format!("![{}](gallery/{})", picture.title, picture.file_name()));
        page.paragraph(picture.description);
        page.paragraph(&format!("[`{0}`]({LOCAL_APP_URL}?{0})", picture.state));
    }
    page.markdown()
}
