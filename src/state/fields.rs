//! List of all parameters, the source of the state string, the panel, the command-line help and property tests.

use super::coast::Coast;
use super::field::{FieldDescription, number};
use super::look::{BedLook, FilmLook, FoamLook, Look, Reflection, Scattering, SkyLook};
use super::params::{Camera, CascadeSettings, Clock, FoamSettings, Grid, Params, Screen, Sea, WaveSystemParams};
use super::views::ViewChoice;
use std::sync::LazyLock;

pub use super::field::{FieldKind, Group, InvalidValue, linear_rgb};

/// Description (key, label, unit, range, help) of one parameter of [`Params`], with functions to read and write it.
pub type Field = FieldDescription<Params>;

/// Descriptions of all parameters, in the order in which the state string writes them.
pub static FIELDS: LazyLock<Vec<Field>> = LazyLock::new(|| {
    // Fields of a parameter struct that is found at `$place` in `Params`.
    macro_rules! part {
        ($struct:ident, $group:ident, $($place:tt)+) => {
            $struct::fields(Group::$group, |p: &Params| &p.$($place)+, |p: &mut Params| &mut p.$($place)+)
        };
    }
    let parts = [
        part!(WaveSystemParams, Sea, sea.systems[0]),
        with_numbered_keys(2, part!(WaveSystemParams, SecondSystem, sea.systems[1])),
        with_numbered_keys(3, part!(WaveSystemParams, ThirdSystem, sea.systems[2])),
        with_numbered_keys(4, part!(WaveSystemParams, FourthSystem, sea.systems[3])),
        part!(Sea, Water, sea),
        part!(FoamSettings, Foam, sea.foam),
        part!(Coast, Coast, coast),
        part!(SkyLook, Sky, look.sky),
        part!(Scattering, Surface, look.surface.scattering),
        part!(Reflection, Surface, look.surface.reflection),
        part!(BedLook, Surface, look.surface.bed),
        part!(FoamLook, Foam, look.surface.foam),
        part!(FilmLook, Film, look.film),
        part!(Look, View, look),
        part!(ViewChoice, View, look.view),
        part!(Camera, Camera, camera),
        vec![loop_time_field()],
        part!(Clock, Clock, clock),
        vec![fft_size_field()],
        part!(Grid, Grid, grid),
        number_cascade_fields(1, part!(CascadeSettings, Grid, grid.patches[0])),
        number_cascade_fields(2, part!(CascadeSettings, Grid, grid.patches[1])),
        number_cascade_fields(3, part!(CascadeSettings, Grid, grid.patches[2])),
        number_cascade_fields(4, part!(CascadeSettings, Grid, grid.patches[3])),
        part!(Screen, Screen, screen),
    ];
    parts.into_iter().flatten().collect()
});

/// Appends `number` to the keys of parameters, as in `wind2` for the second wave system. The memory of the new keys is
/// never freed, but they are made only once, for [`FIELDS`].
fn with_numbered_keys(number: u32, mut fields: Vec<Field>) -> Vec<Field> {
    for field in &mut fields {
        field.key = format!("{}{number}", field.key).leak();
    }
    fields
}

/// Appends the number of a cascade (patch of sea with its own FFT) to the keys and labels of its parameters, as in
/// `patch1` and "Patch 1".
fn number_cascade_fields(number: u32, mut fields: Vec<Field>) -> Vec<Field> {
    for field in &mut fields {
        field.label = format!("{} {number}", field.label).leak();
    }
    with_numbered_keys(number, fields)
}

/// Description of the parameter [`Sea::repeat_period_s`], the period after which the sea repeats. It is a member of
/// [`Sea`], but the panel shows it in the section "Time".
fn loop_time_field() -> Field {
    Field {
        key: "loop",
        label: "Loop",
        unit: "s",
        group: Group::Clock,
        kind: number(0.0, 3600.0),
        zero_word: "none",
        help: "Period after which the sea repeats; 0 (none) is a day. Wave frequencies become multiples of 1/period.",
        get: Box::new(|p| p.sea.repeat_period_s),
        set: Box::new(|p, value| p.sea.repeat_period_s = value),
    }
}

/// Description of the parameter [`Grid::n`], the FFT size: a choice of 64, 128, 256, 512 and 1024.
fn fft_size_field() -> Field {
    const FFT_SIZES: [u32; 5] = [64, 128, 256, 512, 1024];
    Field {
        key: "n",
        label: "FFT size",
        unit: "",
        group: Group::Grid,
        kind: FieldKind::Choice(&["64", "128", "256", "512", "1024"]),
        zero_word: "",
        help: "Samples along one side of a cascade. More samples add shorter waves and never change the longer ones.",
        get: Box::new(|p| FFT_SIZES.iter().position(|&n| n == p.grid.n).unwrap_or(2) as f64),
        set: Box::new(|p, value| p.grid.n = FFT_SIZES[value as usize]),
    }
}

/// Finds the description of a parameter by its key in the state string, such as `wind`; `None` if no parameter has it.
pub fn find(key: &str) -> Option<&'static Field> {
    FIELDS.iter().find(|f| f.key == key)
}
