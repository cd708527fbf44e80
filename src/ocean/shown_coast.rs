//! The coast that an ocean shows: set by the app, which solves it beside the running sea, or solved at once for a still.

use super::Ocean;
use super::coast_task::{CoastKey, ShownCoast, solve_at_once};
use crate::coast::PlacedCoast;
use crate::coast::transfer::TransferSolver;
use crate::state::coast::CoastName;
use std::sync::Arc;

impl Ocean {
    /// Shows the waves of a coast in the frames from now on; without them the open sea. Waves that do not belong to the
    /// present sea wait until a running transition has led to theirs. The land of a file is shown, too; that of a built-in
    /// coast is shown already.
    pub fn show_coast(&mut self, (land, waves): ShownCoast) {
        if self.params.coast.name == CoastName::File {
            self.set_land(land);
        }
        let address = |waves: Option<&Arc<_>>| waves.map(Arc::as_ptr);
        if address(self.transfer()) != address(waves.as_ref()) && !self.in_transition() {
            self.set_coast(waves);
        }
    }

    /// Shows the coast of the parameters, and solves its waves first, which takes seconds, unless they are known from the
    /// last call. A coast that cannot be placed leaves the sea open.
    pub fn solve_coast(&mut self) {
        let params = &self.params;
        if self.coast_solved.as_ref().is_some_and(|(key, _)| key.fits(params)) {
            return self.show_coast(self.coast_solved.as_ref().map(|(_, shown)| shown.clone()).unwrap_or_default());
        }
        let land = PlacedCoast::of_state(&params.coast, None).ok().flatten();
        let Some((key, land)) = CoastKey::of(params).zip(land) else {
            return self.show_coast(ShownCoast::default());
        };
        let waves = Arc::new(solve_at_once::<TransferSolver>(params, &land));
        let shown = (Some(Arc::new(land)), Some(waves));
        self.coast_solved = Some((key, shown.clone()));
        self.show_coast(shown);
    }
}
