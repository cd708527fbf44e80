//! Floating objects (moored buoys, boats and yachts): their kind, their position, and their text in the state string.

use super::field::choice_enum;
use super::text::shortest_decimal;

/// Largest number of floating objects that a state string can hold.
pub const MAX_FLOATING_OBJECTS: usize = 16;

choice_enum! {
    /// Kind of a floating object, buoy, boat or yacht, that the user can moor on the sea.
    pub enum FloatingObjectKind {
        /// A moored buoy, 3 m high.
        Buoy = "buoy",
        /// A small open boat, 7 m long, with its bow to the waves.
        Boat = "boat",
        /// A sailing yacht, 11 m long with a mast of 15 m, close-hauled; it heels in the wind.
        Yacht = "yacht",
    }
}

/// A floating object, moored at a fixed horizontal position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatingObject {
    /// Kind of the object.
    pub kind: FloatingObjectKind,
    /// Position of the mooring east of the world origin, m.
    pub x_m: f64,
    /// Position of the mooring south of the world origin, m.
    pub z_m: f64,
}

/// Parses the floating objects of a state string, each as kind, metres east and metres south: `buoy*12*-30_boat*0*40`.
///
/// # Errors
/// Returns one sentence that says what is wrong with the text.
pub fn parse_floating_objects(text: &str) -> Result<Vec<FloatingObject>, String> {
    let one = |part: &str| -> Option<FloatingObject> {
        let mut parts = part.split('*');
        let word = parts.next()?;
        let kind = FloatingObjectKind::ALL.into_iter().find(|kind| kind.word().eq_ignore_ascii_case(word))?;
        let mut metres = || parts.next()?.trim().parse::<f64>().ok().filter(|x| x.is_finite() && x.abs() <= 1e6);
        let float = FloatingObject { kind, x_m: metres()?, z_m: metres()? };
        parts.next().is_none().then_some(float)
    };
    let mut floats = Vec::new();
    for part in text.split('_').filter(|p| !p.is_empty()) {
        if floats.len() == MAX_FLOATING_OBJECTS {
            return Err(format!("more than {MAX_FLOATING_OBJECTS} objects float"));
        }
        floats.push(one(part).ok_or("an object is buoy, boat or yacht, metres east and metres south, joined by *")?);
    }
    Ok(floats)
}

/// Formats floating objects for a state string, as in `buoy*12*-30_boat*0*40`; [`parse_floating_objects`] is the
/// inverse.
pub fn format_floating_objects(floats: &[FloatingObject]) -> String {
    let one = |f: &FloatingObject| format!("{}*{}*{}", f.kind.word(), shortest_decimal(f.x_m), shortest_decimal(f.z_m));
    floats.iter().map(one).collect::<Vec<_>>().join("_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_read_back() {
        let floats = [
            FloatingObject { kind: FloatingObjectKind::Buoy, x_m: 12.5, z_m: -30.0 },
            FloatingObject { kind: FloatingObjectKind::Boat, x_m: 0.0, z_m: 40.0 },
        ];
        assert_eq!(format_floating_objects(&floats), "buoy*12.5*-30_boat*0*40");
        assert_eq!(parse_floating_objects("buoy*12.5*-30_boat*0*40").as_deref(), Ok(&floats[..]));
        assert_eq!(parse_floating_objects(""), Ok(vec![]));
        for bad in ["raft*1*2", "buoy", "buoy*1", "buoy*1*2*3", "buoy*NaN*0", "buoy*1e9*0", "*", "buoy*1*2 boat"] {
            assert!(parse_floating_objects(bad).is_err(), "{bad}");
        }
        assert!(parse_floating_objects(&"buoy*1*2_".repeat(MAX_FLOATING_OBJECTS + 1)).is_err());
    }
}
