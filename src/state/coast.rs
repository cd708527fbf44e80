//! The coast that the sea runs up to: which one, and where it lies.

use super::field::FieldKind::Choice;
use super::field::{choice_enum, number, parameters};
use crate::files::bathymetry::BathymetryFile;
use std::sync::Arc;

/// Why a sea whose coast is a file is open, and what to do.
pub const MISSING_FILE_NOTICE: &str =
    "the coast is a file, which a link cannot carry: drop the bathymetry on the sea, or name it with --bathymetry";

choice_enum! {
    /// A coast: none, one that comes with the program, or one from a file with heights or depths.
    pub enum CoastName {
        /// The open sea.
        None = "none",
        /// A straight sandy beach before dunes.
        Beach = "beach",
        /// A rocky headland beside a bay.
        Headland = "headland",
        /// An island before a beach.
        Island = "island",
        /// Two breakwaters around a basin with a quay.
        Harbour = "harbour",
        /// A sand bar along a beach, cut by a channel.
        Bar = "bar",
        /// An underwater hill that focuses waves.
        Shoal = "shoal",
        /// The bathymetry that the user has opened. A link cannot carry it; without the file the sea is open.
        File = "file",
    }
}

parameters! {
    /// The coast and its place. The middle of the coast's square lies at the world origin, unless it is moved.
    pub struct Coast {
        /// Coast that the waves run up to: they turn, grow, break and bend around obstacles over its depths. beach:
        /// straight and sandy; headland: rocks beside a bay; island: calm water behind it; harbour: breakwaters around
        /// a basin; bar: a sand bar with a channel; shoal: a hill under water that focuses waves; file: a bathymetry
        /// that was opened.
        name: CoastName = CoastName::None => ("coast", "Coast", "", Choice(CoastName::WORDS)),
        /// Distance by which the middle of the coast lies east of the world origin.
        x_m: f64 = 0.0 => ("coastx", "Coast east", "m", number(-1e5, 1e5)),
        /// Distance by which the middle of the coast lies south of the world origin.
        z_m: f64 = 0.0 => ("coastz", "Coast south", "m", number(-1e5, 1e5)),
        /// Angle by which the coast is turned clockwise from its own direction.
        turn_deg: f64 = 0.0 => ("coastturn", "Coast turn", "deg", number(-180.0, 180.0)),
        /// The bathymetry of the coast `file`; `None` until it is opened, and for every other coast.
        file: Option<CoastFile> = None,
    }
}

/// A bathymetry that the user has opened. Two are equal if they are the same one in memory.
#[derive(Clone, Debug)]
pub struct CoastFile(pub Arc<BathymetryFile>);

impl PartialEq for CoastFile {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Coast {
    /// Whether there is land: false in the open sea, and where the coast is a file that is not open.
    pub fn is_on(&self) -> bool {
        match self.name {
            CoastName::None => false,
            CoastName::File => self.file.is_some(),
            _ => true,
        }
    }

    /// Takes the file `opened`, if the coast is a file and has none; another coast drops its file.
    pub fn adopt_file(&mut self, opened: Option<&CoastFile>) {
        if self.name != CoastName::File {
            self.file = None;
        } else if self.file.is_none() {
            self.file = opened.cloned();
        }
    }

    /// Notice for the user if the coast is a file that is not open, else `None`.
    pub fn missing_file_notice(&self) -> Option<String> {
        (self.name == CoastName::File && self.file.is_none()).then(|| MISSING_FILE_NOTICE.to_owned())
    }
}
