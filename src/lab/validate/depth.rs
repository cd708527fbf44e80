//! Part 5: water of finite depth.

use super::figure::{Axis, Figure, Legend, Mark, Series, curve};
use super::lab::Lab;
use super::page::{Page, against, deviation, measured, number};
use super::published::theory;

const WIND: &str = "wind=20&fetch=300&n=128";
const DEPTHS: [f64; 10] = [2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 30.0, 50.0, 100.0, 200.0];
/// The forms of the depth factor.
const FORMS: [(&str, &str); 3] =
    [("exact", "spectrum=tma"), ("branches", "spectrum=tma&tmafit=branches"), ("Bouws", "spectrum=tma&bouws=1")];

/// Writes the part.
///
/// # Errors
/// If the GPU does not give its memory back, or a figure cannot be drawn.
pub fn write(page: &mut Page, lab: &Lab<'_>) -> Result<(), String> {
    page.heading(2, "5. Depth");
    page.prose(
        "TMA is JONSWAP times Kitaigorodskii's depth factor: exact, tanh²(kh) / (1 + 2kh / sinh 2kh); in the three branches of \
         Thompson and Vincent 1983; or exact with the α and γ of Bouws et al. 1985 as well. Whatever the spectrum, the sea is \
         capped at Hs = 0.6 h, where waves break. Wind 20 m/s over 300 km.",
    );
    let x = Axis::log("depth h, m", 2.0, 200.0);
    let mut figure = Figure::new(
        "Wave height against depth",
        x.clone(),
        Axis::linear("significant wave height Hs, m", 0.0, 9.0),
        Legend::LowerRight,
    )
    .with(Series::new("cap, 0.6 h", 6, Mark::Dashes(curve(&x, 200, |h| 0.6 * h))));
    for (i, (name, state)) in FORMS.into_iter().enumerate() {
        let mut line = Vec::new();
        for [depth, _] in curve(&x, 60, |_| 0.0) {
            line.push([depth, theory(&format!("{state}&{WIND}&depth={depth}"))?.hs_m]);
        }
        let mark = if name == "branches" { Mark::Dashes(line) } else { Mark::Line(line) };
        figure = figure.with(Series::new(&format!("tma, {name}"), i, mark));
    }
    let deep = theory(&format!("spectrum=jonswap&{WIND}"))?.hs_m;
    figure = figure.with(Series::new("jonswap in deep water", 3, Mark::Dashes(curve(&x, 60, |_| deep))));
    let (mut rows, mut points) = (Vec::new(), Vec::new());
    for depth in DEPTHS {
        let sea = lab.sea(&format!("{}&{WIND}&depth={depth}", FORMS[0].1), 0, &|_| None)?;
        let [branches, bouws] = [
            theory(&format!("{}&{WIND}&depth={depth}", FORMS[1].1))?.hs_m,
            theory(&format!("{}&{WIND}&depth={depth}", FORMS[2].1))?.hs_m,
        ];
        let seen = sea.get(|m| m.hs_m);
        if let Some(e) = seen {
            points.push([depth, e.value, e.error.unwrap_or(0.0)]);
        }
        let exact = sea.theory.hs_m;
        rows.push(vec![
            number(depth, 0),
            number(0.6 * depth, 2),
            number(exact, 3),
            number(sea.resolved.hs_m, 3),
            measured(seen.as_ref(), 3),
            deviation(seen.as_ref(), sea.resolved.hs_m),
            number(branches, 3),
            against(branches, exact),
            number(bouws, 3),
            against(bouws, exact),
        ]);
    }
    if lab.gpu.is_some() {
        figure = figure.with(Series::new("tma, exact, measured on the GPU", 0, Mark::Points(points)));
    }
    page.figure(
        "depth",
        &figure,
        "Significant wave height against depth for the three forms of TMA, with the cap. Sources: Kitaigorodskii et al. 1975; \
         Thompson and Vincent 1983; Bouws et al. 1985.",
    )?;
    let head = [
        "depth, m",
        "cap, m",
        "exact, theory",
        "resolved",
        "measured",
        "deviation",
        "branches",
        "against exact",
        "Bouws",
        "against exact",
    ];
    page.table(&head, &rows);
    page.prose(
        "The branches are a fit to the exact factor, within 0.023 of it. Bouws' α and γ grow with U² k_p / g, from a \
         different set of measurements than JONSWAP's, and apply at every depth.",
    );
    Ok(())
}
