//! What floats on the sea, as data of the state.

use super::number::shortest;

/// Most things that a sea carries.
pub const MOST: usize = 16;

/// What floats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A moored buoy, 3 m high.
    Buoy,
    /// A small open boat, 7 m long, bow to the waves.
    Boat,
}

impl Kind {
    /// Every kind and its word in the state string.
    pub const ALL: [(&'static str, Self); 2] = [("buoy", Self::Buoy), ("boat", Self::Boat)];

    /// Its word in the state string.
    pub fn word(self) -> &'static str {
        Self::ALL.iter().find(|(_, k)| *k == self).map_or("", |(word, _)| word)
    }
}

/// Something that floats, moored to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Float {
    /// What it is.
    pub kind: Kind,
    /// East of the origin, m.
    pub x_m: f64,
    /// South of the origin, m.
    pub z_m: f64,
}

/// Reads a list as it stands in a state string: `buoy*12*-30_boat*0*40`.
///
/// # Errors
/// One sentence that says what is wrong.
pub fn read(text: &str) -> Result<Vec<Float>, String> {
    let one = |part: &str| -> Option<Float> {
        let mut parts = part.split('*');
        let word = parts.next()?;
        let kind = Kind::ALL.iter().find(|(w, _)| w.eq_ignore_ascii_case(word))?.1;
        let mut metres = || parts.next()?.trim().parse::<f64>().ok().filter(|x| x.is_finite() && x.abs() <= 1e6);
        let float = Float { kind, x_m: metres()?, z_m: metres()? };
        parts.next().is_none().then_some(float)
    };
    let mut floats = Vec::new();
    for part in text.split('_').filter(|p| !p.is_empty()) {
        if floats.len() == MOST {
            return Err(format!("more than {MOST} things float"));
        }
        floats.push(one(part).ok_or("a thing that floats is buoy or boat, metres east, metres south, joined by *")?);
    }
    Ok(floats)
}

/// Writes a list for a state string.
pub fn write(floats: &[Float]) -> String {
    let one = |f: &Float| format!("{}*{}*{}", f.kind.word(), shortest(f.x_m), shortest(f.z_m));
    floats.iter().map(one).collect::<Vec<_>>().join("_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_read_back() {
        let floats =
            [Float { kind: Kind::Buoy, x_m: 12.5, z_m: -30.0 }, Float { kind: Kind::Boat, x_m: 0.0, z_m: 40.0 }];
        assert_eq!(write(&floats), "buoy*12.5*-30_boat*0*40");
        assert_eq!(read("buoy*12.5*-30_boat*0*40").as_deref(), Ok(&floats[..]));
        assert_eq!(read(""), Ok(vec![]));
        for bad in ["raft*1*2", "buoy", "buoy*1", "buoy*1*2*3", "buoy*NaN*0", "buoy*1e9*0", "*", "buoy*1*2 boat"] {
            assert!(read(bad).is_err(), "{bad}");
        }
        assert!(read(&"buoy*1*2_".repeat(MOST + 1)).is_err());
    }
}
