//! Export of the wave maps as one OpenEXR file with a layer for each cascade.

use super::MapsF32;
use crate::waves::Plan;
use exr::prelude::*;
use std::io::Cursor;

/// A channel of an OpenEXR layer: its name, and its value at the texel with a given index, row by row.
pub type Channel<'a> = (&'static str, Box<dyn Fn(usize) -> f32 + 'a>);

/// An OpenEXR layer of `n` x `n` texels with the given attributes and channels; every channel is written as f32.
pub fn exr_layer(n: usize, attributes: LayerAttributes, channels: &[Channel<'_>]) -> Layer<AnyChannels<FlatSamples>> {
    let list = channels
        .iter()
        .map(|(name, value)| AnyChannel::new(*name, FlatSamples::F32((0..n * n).map(value).collect())))
        .collect();
    // Scan lines in increasing order: equal states give equal bytes, and every reader supports them.
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    Layer::new((n, n), attributes, encoding, AnyChannels::sort(list))
}

/// The three OpenEXR channels X, Y and Z of the cascade with the index `cascade`: displacement of the water to the
/// east, up and to the south, m. X and Z are multiplied by the choppiness of `plan`.
pub fn displacement_channels<'a>(plan: &Plan, maps: &'a MapsF32, cascade: usize) -> [Channel<'a>; 3] {
    let (chop, d) = (plan.sea.choppiness_xz().map(|l| l as f32), maps.displacement(cascade));
    [
        ("X", Box::new(move |i| chop[0] * d[i][0])),
        ("Y", Box::new(move |i| d[i][1])),
        ("Z", Box::new(move |i| chop[1] * d[i][2])),
    ]
}

/// Encodes the wave maps as OpenEXR: displacement X, Y, Z (m, with choppiness) and slopes of the undisplaced surface,
/// one layer per cascade. For n x n texels on a patch of side s, column i lies at x = i s / n east, row j at z = j s /
/// n south. The attribute `seastate` holds `state`, the query string of all parameters, such as `wind=14&t=40`.
///
/// # Errors
/// If the OpenEXR encoder fails.
pub fn encode_exr(plan: &Plan, maps: &MapsF32, state: &str) -> std::result::Result<Vec<u8>, String> {
    let n = maps.n;
    let of_cascade = |c: usize| {
        let g = maps.gradients(c);
        let slopes: [Channel<'_>; 2] =
            [("deta_dx", Box::new(move |i| g[i][0])), ("deta_dz", Box::new(move |i| g[i][1]))];
        let channels: Vec<Channel<'_>> = displacement_channels(plan, maps, c).into_iter().chain(slopes).collect();
        let patch = plan.cascades[c].patch_m;
        exr_layer(n, LayerAttributes::named(format!("cascade{c} patch {patch:.4} m").as_str()), &channels)
    };
    let layers: SmallVec<[Layer<AnyChannels<FlatSamples>>; 2]> = (0..maps.cascade_count()).map(of_cascade).collect();
    let size = IntegerBounds::from_dimensions((n, n));
    let mut image = Image::from_layers(ImageAttributes::new(size), layers);
    image.attributes.other.insert("seastate".into(), AttributeValue::Text(state.into()));
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).map_err(|e| format!("the maps cannot be written: {e}"))?;
    Ok(bytes.into_inner())
}
