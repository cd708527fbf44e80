//! The page as it is written: headings, prose, tables and figures in Markdown.

use super::figure::Figure;
use crate::lab::stats::Estimate;
use std::fmt::Write as _;
use std::path::Path;

/// What stands for a measured number where there is no GPU.
pub const PENDING: &str = "…";

/// Markdown and the figures that it shows.
#[derive(Clone, Debug, Default)]
pub struct Page {
    text: String,
    figures: Vec<(String, String)>,
}

impl Page {
    /// A heading; 1 is the title.
    pub fn heading(&mut self, level: usize, text: &str) {
        let _ = writeln!(self.text, "{} {text}\n", "#".repeat(level));
    }

    /// A paragraph, broken into lines of at most 120 characters.
    pub fn prose(&mut self, text: &str) {
        let mut column = 0;
        for word in text.split_whitespace() {
            let length = word.chars().count();
            let gap = if column == 0 {
                ""
            } else if column + 1 + length > 120 {
                "\n"
            } else {
                " "
            };
            column = if gap == " " { column + 1 + length } else { length };
            let _ = write!(self.text, "{gap}{word}");
        }
        self.text.push_str("\n\n");
    }

    /// A table.
    pub fn table(&mut self, head: &[&str], rows: &[Vec<String>]) {
        let _ = writeln!(self.text, "| {} |", head.join(" | "));
        let _ = writeln!(self.text, "|{}", "---|".repeat(head.len()));
        for row in rows {
            let _ = writeln!(self.text, "| {} |", row.join(" | "));
        }
        self.text.push('\n');
    }

    /// A figure with its caption.
    ///
    /// # Errors
    /// If it cannot be drawn.
    pub fn figure(&mut self, name: &str, figure: &Figure, caption: &str) -> Result<(), String> {
        let _ = writeln!(self.text, "![{}](validation/{name}.svg)\n", figure.title());
        self.prose(&format!("*{caption}*"));
        self.keep(name, figure)
    }

    /// Figures two in a row, with one caption.
    ///
    /// # Errors
    /// If one cannot be drawn.
    pub fn gallery(&mut self, figures: &[(String, Figure)], caption: &str) -> Result<(), String> {
        self.text.push_str("| | |\n|---|---|\n");
        for pair in figures.chunks(2) {
            let cell = |(name, figure): &(String, Figure)| format!("![{}](validation/{name}.svg)", figure.title());
            let cells: Vec<_> = pair.iter().map(cell).collect();
            let _ = writeln!(self.text, "| {} | {} |", cells[0], cells.get(1).map_or("", String::as_str));
        }
        self.text.push('\n');
        self.prose(&format!("*{caption}*"));
        figures.iter().try_for_each(|(name, figure)| self.keep(name, figure))
    }

    fn keep(&mut self, name: &str, figure: &Figure) -> Result<(), String> {
        self.figures.push((name.to_owned(), figure.svg()?));
        Ok(())
    }

    /// The Markdown.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Names of the figures and their SVG.
    pub fn figures(&self) -> &[(String, String)] {
        &self.figures
    }

    /// Writes `name`.md and the folder of its figures.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, folder: &Path, name: &str) -> Result<(), String> {
        let save = |path: &Path, text: &str| {
            std::fs::write(path, text).map_err(|e| format!("cannot write {}: {e}", path.display()))
        };
        let drawn = if self.figures.is_empty() { folder.to_owned() } else { folder.join("validation") };
        std::fs::create_dir_all(&drawn).map_err(|e| format!("cannot make {}: {e}", drawn.display()))?;
        for (figure, svg) in &self.figures {
            save(&drawn.join(format!("{figure}.svg")), svg)?;
        }
        save(&folder.join(format!("{name}.md")), &format!("{}\n", self.text.trim_end()))
    }
}

/// A number with so many digits after the point.
pub fn number(value: f64, digits: usize) -> String {
    format!("{:.digits$}", value + 0.0)
}

/// An estimate and its standard error, or that there is none yet.
pub fn measured(estimate: Option<&Estimate>, digits: usize) -> String {
    estimate.map_or(PENDING.to_owned(), |e| match e.error {
        Some(error) => format!("{:.digits$} ± {error:.digits$}", e.value),
        None => number(e.value, digits),
    })
}

/// How far an estimate lies from what is expected, in per cent and in standard errors.
pub fn deviation(estimate: Option<&Estimate>, expected: f64) -> String {
    estimate.map_or(PENDING.to_owned(), |e| {
        let apart = e.value - expected;
        let errors = e.error.filter(|&se| se > 0.0).map_or(String::new(), |se| format!(" ({:+.1} σ)", apart / se));
        format!("{:+.2} %{errors}", 100.0 * apart / expected)
    })
}

/// How far an angle lies from what is expected, in degrees and in standard errors.
pub fn turned(estimate: Option<&Estimate>, expected: f64) -> String {
    estimate.map_or(PENDING.to_owned(), |e| {
        let apart = (e.value - expected + 540.0).rem_euclid(360.0) - 180.0;
        let errors = e.error.filter(|&se| se > 0.0).map_or(String::new(), |se| format!(" ({:+.1} σ)", apart / se));
        format!("{apart:+.2}°{errors}")
    })
}

/// How far a number of ours lies from a published one, in per cent.
pub fn against(ours: f64, published: f64) -> String {
    format!("{:+.1} %", 100.0 * (ours / published - 1.0))
}
