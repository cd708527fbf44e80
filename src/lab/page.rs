//! Builder for a page of Markdown with headings, prose, tables and figures.

use super::figure::Figure;
use super::{create_folder, write_file};
use std::fmt::Write as _;
use std::path::Path;

/// A page of Markdown under construction: its text so far, and name and SVG text of its figures.
#[derive(Clone, Debug, Default)]
pub struct MarkdownPage {
    text: String,
    figures: Vec<(String, String)>,
}

impl MarkdownPage {
    /// Adds a heading. Level 1 is the title of the page.
    pub fn heading(&mut self, level: usize, text: &str) {
        let _ = writeln!(self.text, "{} {text}\n", "#".repeat(level));
    }

    /// Adds a paragraph, broken into lines of at most 120 characters.
    pub fn paragraph(&mut self, text: &str) {
        let mut column = 0;
        for word in text.split_whitespace() {
            let length = word.chars().count();
            let gap = match column {
                0 => "",
                _ if column + 1 + length > 120 => "\n",
                _ => " ",
            };
            column = if gap == " " { column + 1 + length } else { length };
            let _ = write!(self.text, "{gap}{word}");
        }
        self.text.push_str("\n\n");
    }

    /// Adds a table to the page. `head` holds the column titles, separated by " | "; each row, one text per column.
    pub fn table(&mut self, head: &str, rows: &[Vec<String>]) {
        let columns = head.split(" | ").count();
        let _ = writeln!(self.text, "| {head} |\n|{}", "---|".repeat(columns));
        for row in rows {
            let _ = writeln!(self.text, "| {} |", row.join(" | "));
        }
        self.text.push('\n');
    }

    /// Adds a figure with its caption. `name` becomes the name of its SVG file, without the extension.
    ///
    /// # Errors
    /// If the figure cannot be drawn.
    pub fn figure(&mut self, name: &str, figure: &Figure, caption: &str) -> Result<(), String> {
        let _ = writeln!(self.text, "![{}](validation/{name}.svg)\n", figure.title());
        self.paragraph(&format!("*{caption}*"));
        self.store_figure_svg(name, figure)
    }

    /// Adds figures, two in a row, with one caption for all. Each is given as a pair: the name of its SVG file without
    /// the extension, and the figure.
    ///
    /// # Errors
    /// If one of the figures cannot be drawn.
    pub fn figures(&mut self, figures: &[(String, Figure)], caption: &str) -> Result<(), String> {
        self.text.push_str("| | |\n|---|---|\n");
        for pair in figures.chunks(2) {
            let cell = |(name, figure): &(String, Figure)| format!("![{}](validation/{name}.svg)", figure.title());
            let cells: Vec<_> = pair.iter().map(cell).collect();
            let _ = writeln!(self.text, "| {} | {} |", cells[0], cells.get(1).map_or("", String::as_str));
        }
        self.text.push('\n');
        self.paragraph(&format!("*{caption}*"));
        figures.iter().try_for_each(|(name, figure)| self.store_figure_svg(name, figure))
    }

    fn store_figure_svg(&mut self, name: &str, figure: &Figure) -> Result<(), String> {
        self.figures.push((name.to_owned(), figure.svg()?));
        Ok(())
    }

    /// The Markdown text of the page, with one line feed at its end.
    pub fn markdown(&self) -> String {
        format!("{}\n", self.text.trim_end())
    }

    /// File name without extension, and SVG text, of each figure that has been added to the page.
    pub fn figure_svgs(&self) -> &[(String, String)] {
        &self.figures
    }

    /// Writes the page as validation.md to a folder, and its figures to the subfolder validation/.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), String> {
        self.write_with_text(folder, &self.markdown())
    }

    /// Like [`Self::write`], but keeps the chapters (headings of level 2) of the validation.md in the folder, in which
    /// those of this page take the place of the chapters with the same number, or follow the last one.
    ///
    /// # Errors
    /// If the page in the folder cannot be read, or a file cannot be written.
    pub fn write_chapters(&self, folder: &Path) -> Result<(), String> {
        let path = folder.join("validation.md");
        let old = std::fs::read_to_string(&path).map_err(|e| format!("cannot read {}: {e}", path.display()))?;
        self.write_with_text(folder, &with_chapters(&old, &self.markdown()))
    }

    fn write_with_text(&self, folder: &Path, text: &str) -> Result<(), String> {
        let drawings = folder.join("validation");
        create_folder(&drawings)?;
        for (figure, svg) in &self.figures {
            write_file(&drawings.join(format!("{figure}.svg")), svg)?;
        }
        write_file(&folder.join("validation.md"), text)
    }
}

/// The text of a page in which the chapters of the page `new` take the place of those with the same number.
fn with_chapters(old: &str, new: &str) -> String {
    let split = |text: &str| -> Vec<String> {
        let mut parts = vec![String::new()];
        for line in text.trim_end().lines() {
            if line.starts_with("## ") {
                parts.push(String::new());
            }
            if let Some(part) = parts.last_mut() {
                part.push_str(line);
                part.push('\n');
            }
        }
        // One empty line parts two chapters.
        parts.iter().map(|part| format!("{}\n", part.trim_end())).collect()
    };
    let number = |part: &str| part.split('.').next().unwrap_or_default().to_owned();
    let mut parts = split(old);
    for chapter in split(new).into_iter().skip(1) {
        match parts.iter_mut().skip(1).find(|part| number(part) == number(&chapter)) {
            Some(part) => *part = chapter,
            None => parts.push(chapter),
        }
    }
    parts.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chapters_take_the_place_of_old_ones() {
        let old = "# Page\n\nText.\n\n## 1. One\n\nOld one.\n\n## 2. Two\n\nOld two.\n";
        assert_eq!(with_chapters(old, "# Page\n\nOther.\n"), old);
        let new = "# Page\n\n## 1. Uno\n\nNew one.\n\n## 8. Eight\n\n### More\n";
        let want = "# Page\n\nText.\n\n## 1. Uno\n\nNew one.\n\n## 2. Two\n\nOld two.\n\n## 8. Eight\n\n### More\n";
        assert_eq!(with_chapters(old, new), want);
    }
}
