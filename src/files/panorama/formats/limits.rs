//! Size limits of sky image files, checked before memory is allocated.

use crate::files::panorama::sky_image::check_shape;

/// Largest sky image file that is read, bytes.
pub const MAX_BYTES: usize = 512 << 20;
/// Largest sky image that is read, [columns, rows]; one with more columns or rows is refused. The limit is lower in a
/// browser, which has less memory. It allows one row more than half the columns.
pub(super) const MAX_IMAGE_SIZE: [usize; 2] =
    if cfg!(target_arch = "wasm32") { [11_586, 5_794] } else { [16_384, 8_193] };

/// Reason in the error about a sky image file that is shorter than its header says.
pub(super) const TOO_SHORT_MESSAGE: &str = "it ends too early: download or save it again";

/// Returns an error if a sky image of this size (columns, rows) exceeds `max_size`, or [`check_shape`] returns one.
pub(super) fn check_size(size: [usize; 2], max_size: [usize; 2]) -> Result<(), String> {
    check_within_limit(size, max_size)?;
    check_shape(size[0], size[1])
}

/// Returns an error if an image of this size (columns, rows) has more columns or rows than `max_size`.
pub(super) fn check_within_limit([width, height]: [usize; 2], max_size: [usize; 2]) -> Result<(), String> {
    if width > max_size[0] || height > max_size[1] {
        let [columns, rows] = max_size;
        return Err(format!("{width} x {height} pixels, but at most {columns} x {rows} are read: save it smaller"));
    }
    Ok(())
}

/// Returns an empty vector with room for `count` pixels, or an error where the memory does not suffice.
pub(super) fn allocate(count: usize) -> Result<Vec<[f32; 3]>, String> {
    let mut pixels = Vec::new();
    pixels.try_reserve_exact(count).map_err(|_| "there is not enough memory for it: save it smaller")?;
    Ok(pixels)
}
