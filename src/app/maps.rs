//! The maps of the sea as one OpenEXR file, from the page as from the window: a layer for each cascade.

use super::{App, files, tasks};
use crate::ocean::{MapsF32, Ocean};
use crate::state::{Params, query};
use crate::waves::Plan;
use exr::prelude::*;
use std::io::Cursor;

/// The file's bytes: displacement X, Y, Z (m, chop applied) and slopes of the undisplaced surface, cascade by cascade;
/// column i holds x = i patch / n to the east, row j z = j patch / n to the south. The state string is its attribute `seastate`.
///
/// # Errors
/// If the maps cannot be written.
pub fn encode(plan: &Plan, maps: &MapsF32, state: &str) -> std::result::Result<Vec<u8>, String> {
    let chop = plan.sea.lambda().map(|l| l as f32);
    let n = maps.n;
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let layer = |c: usize| {
        let (d, g) = (maps.displacement(c), maps.gradients(c));
        let channel = |name: &str, value: &dyn Fn(usize) -> f32| {
            AnyChannel::new(name, FlatSamples::F32((0..n * n).map(value).collect()))
        };
        let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::from_vec(vec![
            channel("X", &|i| chop[0] * d[i][0]),
            channel("Y", &|i| d[i][1]),
            channel("Z", &|i| chop[1] * d[i][2]),
            channel("deta_dx", &|i| g[i][0]),
            channel("deta_dz", &|i| g[i][1]),
        ]);
        let patch = plan.cascades[c].patch_m;
        let attributes = LayerAttributes::named(format!("cascade{c} patch {patch:.4} m").as_str());
        Layer::new((n, n), attributes, encoding, AnyChannels::sort(channels))
    };
    let layers: SmallVec<[Layer<AnyChannels<FlatSamples>>; 2]> = (0..maps.cascades()).map(layer).collect();
    let size = IntegerBounds::from_dimensions((n, n));
    let mut image = Image::from_layers(ImageAttributes::new(size), layers);
    image.attributes.other.insert("seastate".into(), AttributeValue::Text(state.into()));
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).map_err(|e| format!("the maps cannot be written: {e}"))?;
    Ok(bytes.into_inner())
}

impl App {
    /// Saves the maps of the sea at this moment. It arrives in the inbox.
    pub(super) fn save_maps(&mut self) {
        let params: Params = super::tidy(&self.params);
        let state = query::write(&params);
        let gpu = self.gpu();
        let (inbox, ctx, folder) = (self.saved.clone(), self.ctx.clone(), self.save_folder.clone());
        tasks::spawn(async move {
            let plan = Plan::new(&params);
            let read = Ocean::waves_only(&gpu, &params).read_maps().await;
            let made = read.and_then(|maps| encode(&plan, &maps, &state));
            inbox.put(made.and_then(|exr| files::save(folder.as_deref(), "seastate-maps.exr", &exr)), &ctx);
        });
    }
}
