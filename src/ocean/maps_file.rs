//! Export of the wave maps as one OpenEXR file with a layer for each cascade.

use super::MapsF32;
use crate::waves::Plan;
use exr::prelude::*;
use std::io::Cursor;

/// Encodes the wave maps as OpenEXR: displacement X, Y, Z (m, with choppiness) and slopes of the undisplaced surface,
/// one layer per cascade. Column i lies at x = i patch / n east, row j at z = j patch / n south. The attribute
/// `seastate` holds the state string.
///
/// # Errors
/// If the OpenEXR encoder fails.
pub fn encode(plan: &Plan, maps: &MapsF32, state: &str) -> std::result::Result<Vec<u8>, String> {
    let choppiness = plan.sea.choppiness().map(|l| l as f32);
    let n = maps.n;
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let layer = |c: usize| {
        let (d, g) = (maps.displacement(c), maps.gradients(c));
        let channel = |name: &str, value: &dyn Fn(usize) -> f32| {
            AnyChannel::new(name, FlatSamples::F32((0..n * n).map(value).collect()))
        };
        let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::from_vec(vec![
            channel("X", &|i| choppiness[0] * d[i][0]),
            channel("Y", &|i| d[i][1]),
            channel("Z", &|i| choppiness[1] * d[i][2]),
            channel("deta_dx", &|i| g[i][0]),
            channel("deta_dz", &|i| g[i][1]),
        ]);
        let patch = plan.cascades[c].patch_m;
        let attributes = LayerAttributes::named(format!("cascade{c} patch {patch:.4} m").as_str());
        Layer::new((n, n), attributes, encoding, AnyChannels::sort(channels))
    };
    let layers: SmallVec<[Layer<AnyChannels<FlatSamples>>; 2]> = (0..maps.cascade_count()).map(layer).collect();
    let size = IntegerBounds::from_dimensions((n, n));
    let mut image = Image::from_layers(ImageAttributes::new(size), layers);
    image.attributes.other.insert("seastate".into(), AttributeValue::Text(state.into()));
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).map_err(|e| format!("the maps cannot be written: {e}"))?;
    Ok(bytes.into_inner())
}
