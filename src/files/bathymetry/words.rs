//! Words by which files say what their values are.

/// Words of elevations, positive up.
const UP: [&str; 9] =
    ["elevation", "elev", "altitude", "topography", "topo", "dem", "dtm", "height_above", "surface_altitude"];
/// Words of depths, positive down.
const DOWN: [&str; 5] = ["depth", "depths", "deptho", "sounding", "soundings"];
/// Words of longitude and latitude.
const DEGREES: [&str; 6] = ["lon", "longitude", "lat", "latitude", "degrees_east", "degrees_north"];
/// Words of projected coordinates.
const METRES: [&str; 4] = ["easting", "northing", "utm", "metres"];

/// Whether words say that values are positive up (elevations) or down (depths); `None` if they say neither or both.
pub(super) fn says_positive_up(text: &str) -> Option<bool> {
    one_of(says(text, &UP), says(text, &DOWN))
}

/// Whether words say that coordinates are degrees or metres; `None` if they say neither or both.
pub(super) fn says_degrees(text: &str) -> Option<bool> {
    one_of(says(text, &DEGREES), says(text, &METRES))
}

fn one_of(first: bool, second: bool) -> Option<bool> {
    (first != second).then_some(first)
}

/// Whether one of `words` stands in the text: as a word of its own, or joined to others by an underscore.
fn says(text: &str, words: &[&str]) -> bool {
    let text = text.to_ascii_lowercase();
    let mut pieces = text.split(|c: char| !c.is_ascii_alphabetic() && c != '_');
    pieces.any(|piece| words.contains(&piece) || piece.split('_').any(|word| words.contains(&word)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_say_up_and_down() {
        for (text, up) in [
            ("Elevation relative to sea level", Some(true)),
            ("x,y,depth", Some(false)),
            ("sea_floor_depth_below_sea_level", Some(false)),
            ("lon lat z", None),
            ("elevation and depth", None),
            ("harbour-dem.tif", Some(true)),
            ("demand.tif", None),
        ] {
            assert_eq!(says_positive_up(text), up, "{text}");
        }
        assert_eq!(says_degrees("Longitude;Latitude;z"), Some(true));
        assert_eq!(says_degrees("Easting,Northing,z"), Some(false));
        assert_eq!(says_degrees("x y z"), None);
    }
}
