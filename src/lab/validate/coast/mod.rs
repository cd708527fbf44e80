//! Part 8 of the validation page: waves that come ashore, against analytic solutions and independent integrations.
//!
//! Each case is a function that solves it and returns the solution beside theory. The page shows the cases, and
//! `tests/coast*.rs` hold them to their limits.

pub mod berkhoff;
pub mod gap;
pub mod page_plane;
pub mod page_random;
pub mod page_shoals;
pub mod page_structures;
pub mod plane;
pub mod random;
pub mod runup;
pub mod shoals;
pub mod structures;
pub mod theory;

use crate::lab::page::MarkdownPage;

/// Acceleration of gravity in all cases, m/s^2.
pub const GRAVITY_M_S2: f64 = 9.81;

/// Adds part 8 to the validation page: waves over a coast.
///
/// # Errors
/// If a case cannot be solved, or a figure cannot be drawn.
pub fn add_part(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(2, "8. Coast");
    page.paragraph(
        "The mild-slope equation brings the components of a sea ashore ([design](design/coast.md)): the parabolic \
         solution holds the waves that travel shoreward, the elliptic one all. The numbers come from the solvers on the \
         CPU, and theory shares no code with them. Published numbers are compared where they could be had, which the sections \
         say; all other cases are held against an analytic solution or an independent integration.",
    );
    page_plane::add_flat_bed(page);
    page_plane::add_plane_beach(page)?;
    page_plane::add_surf(page)?;
    page_structures::add_walls(page)?;
    page_structures::add_pile(page)?;
    page_shoals::add_island(page)?;
    page_shoals::add_slope(page)?;
    page_shoals::add_elliptic_shoal(page)?;
    page_random::add_random_sea(page)?;
    page_random::add_run_up(page)
}
