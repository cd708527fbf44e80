//! Gauges: the sea at points of a coast, with its spectrum beside that of the open sea.

use std::fmt::Write as _;

/// The sea at one gauge.
#[derive(Clone, Debug, PartialEq)]
pub struct Gauge {
    /// The nearest point of the grid, where the gauge stands: its column and row.
    pub point: [usize; 2],
    /// Place of that point in the frame of the coast (x, y), m.
    pub at_m: [f64; 2],
    /// Depth, m; negative on land.
    pub depth_m: f64,
    /// Significant wave height, m.
    pub hs_m: f64,
    /// Peak period, s.
    pub tp_s: f64,
    /// Mean direction that the waves come from, degrees clockwise from north.
    pub from_deg: f64,
    /// Fraction of the waves that break, 0 to 1.
    pub breaking_fraction: f64,
    /// Variance density at the frequencies of [`Gauges::frequencies_hz`], m^2/Hz.
    pub spectrum_m2_hz: Vec<f64>,
}

/// The sea at all gauges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gauges {
    /// Frequencies of the spectra, Hz, ascending.
    pub frequencies_hz: Vec<f64>,
    /// Variance density of the open sea at these frequencies, m^2/Hz.
    pub open_m2_hz: Vec<f64>,
    /// The gauges, in the order in which they were given.
    pub list: Vec<Gauge>,
}

impl Gauges {
    /// Writes the gauges and their spectra as a table: a line for each frequency, and a column for the open sea and each
    /// gauge. `source` is what made it, with the state string of the sea; `coast` is the name of the coast.
    pub fn csv(&self, source: &str, coast: &str) -> String {
        let mut out = format!("# {source} over {coast}\n");
        out += "# x from the sea to the land, y along the shore; from: degrees clockwise from north\n";
        for (i, g) in self.list.iter().enumerate() {
            let [x, y] = g.at_m;
            let _ = writeln!(
                out,
                "# gauge {}: x {x} m, y {y} m, depth {:.2} m, Hs {:.3} m, Tp {:.2} s, from {:.1}, breaking {:.4}",
                i + 1,
                g.depth_m,
                g.hs_m,
                g.tp_s,
                g.from_deg,
                g.breaking_fraction
            );
        }
        out += "f_hz,open_m2_hz";
        out.extend((1..=self.list.len()).map(|i| format!(",gauge{i}_m2_hz")));
        out.push('\n');
        for (row, f) in self.frequencies_hz.iter().enumerate() {
            let _ = write!(out, "{f:.5},{:.5e}", self.open_m2_hz[row]);
            out.extend(self.list.iter().map(|g| format!(",{:.5e}", g.spectrum_m2_hz[row])));
            out.push('\n');
        }
        out
    }
}
