//! Words for times of the day that can be typed in place of an hour or of the sun's height.

use super::look::SkyLook;

/// A time of the day that has a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DayWord {
    Sunrise,
    Noon,
    Sunset,
    Midnight,
}

/// Words for the times of the day in the languages of the interface, in lower case. They are understood in every
/// language.
const DAY_WORDS: [(DayWord, &[&str]); 4] = [
    (
        DayWord::Sunrise,
        &[
            "sunrise",
            "sonnenaufgang",
            "lever du soleil",
            "amanecer",
            "salida del sol",
            "nascer do sol",
            "日の出",
            "日出",
        ],
    ),
    (DayWord::Noon, &["noon", "mittag", "midi", "mediodía", "mediodia", "meio-dia", "meio dia", "正午", "中午"]),
    (
        DayWord::Sunset,
        &[
            "sunset",
            "sonnenuntergang",
            "coucher du soleil",
            "puesta de sol",
            "puesta del sol",
            "pôr do sol",
            "pôr-do-sol",
            "por do sol",
            "日没",
            "日の入り",
            "日落",
        ],
    ),
    (
        DayWord::Midnight,
        &["midnight", "mitternacht", "minuit", "medianoche", "meia-noite", "meia noite", "真夜中", "午夜"],
    ),
];

/// The value of a typed word for a time of the day, such as "sunset", in any language of the interface: for the
/// parameter `hour` the time of the day, for the parameter `sun` the height of the sun. An hour may also be typed as on
/// a clock.
pub fn typed_value(key: &str, typed: &str, sky: &SkyLook) -> Option<f64> {
    if !matches!(key, "hour" | "sun") {
        return None;
    }
    let typed = typed.trim().to_lowercase();
    let (word, _) = DAY_WORDS.iter().find(|(_, words)| words.contains(&typed.as_str())).copied().unzip();
    match (key, word) {
        ("sun", Some(DayWord::Sunrise | DayWord::Sunset)) => Some(0.0),
        ("sun", _) => None,
        (_, Some(DayWord::Sunrise)) => sky.rise_and_set_h()[0],
        (_, Some(DayWord::Sunset)) => sky.rise_and_set_h()[1],
        (_, Some(DayWord::Noon)) => Some(12.0),
        (_, Some(DayWord::Midnight)) => Some(0.0),
        (_, None) => {
            let (hours, minutes) = typed.split_once(':')?;
            let (hours, minutes): (u8, u8) = (hours.trim().parse().ok()?, minutes.trim().parse().ok()?);
            (hours <= 24 && minutes < 60).then(|| f64::from(hours) + f64::from(minutes) / 60.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::look::SunPlacement;

    #[test]
    fn times_of_the_day_may_be_typed_as_words() {
        let sky = SkyLook { day: 80.0, latitude_deg: 45.0, sun_placement: SunPlacement::Date, ..SkyLook::default() };
        let [Some(rise), Some(set)] = sky.rise_and_set_h() else { panic!("the sun rises and sets in March") };
        let hour = |typed: &str| typed_value("hour", typed, &sky);
        assert_eq!([hour("Sunset"), hour("日没"), hour("sonnenaufgang")], [Some(set), Some(set), Some(rise)]);
        assert_eq!([hour("noon"), hour("minuit"), hour("18:30")], [Some(12.0), Some(0.0), Some(18.5)]);
        assert_eq!([hour("18:75"), hour("25:00"), hour("soon"), hour("7")], [None; 4]);
        assert_eq!([typed_value("sun", "sunset", &sky), typed_value("sun", "noon", &sky)], [Some(0.0), None]);
        assert_eq!(typed_value("wind", "sunset", &sky), None);
    }
}
