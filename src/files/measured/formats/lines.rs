//! Reads a text file line by line and number by number, with the number of the line for messages.

use crate::files::measured::text::{MAX_COLUMNS, TextFile, parse_number, quoted_excerpt};

/// Position in a text file whose lines are read in order. Lines that begin with `comment` are passed over.
pub(super) struct Lines<'a> {
    file: &'a TextFile<'a>,
    rest: std::str::Lines<'a>,
    comment: Option<char>,
    /// Number of the line that was read last, from 1; 0 before the first one.
    number: usize,
    /// Line that was read but is still to be returned.
    pushed_back: Option<(usize, &'a str)>,
}

impl<'a> Lines<'a> {
    pub fn new(file: &'a TextFile<'a>, comment: Option<char>) -> Self {
        Self { file, rest: file.text.lines(), comment, number: 0, pushed_back: None }
    }

    /// Next line that is neither empty nor a comment, without white space at its ends; `None` at the end.
    pub fn next_line(&mut self) -> Option<&'a str> {
        if let Some((number, line)) = self.pushed_back.take() {
            self.number = number;
            return Some(line);
        }
        loop {
            let line = self.rest.next()?.trim_start_matches('\u{feff}').trim();
            self.number += 1;
            if !line.is_empty() && !self.comment.is_some_and(|c| line.starts_with(c)) {
                return Some(line);
            }
        }
    }

    /// Lets [`Self::next_line`] return this line, which it returned last, again.
    pub fn push_back(&mut self, line: &'a str) {
        self.pushed_back = Some((self.number, line));
    }

    /// Next line, or an error that says what is missing.
    pub fn expect_line(&mut self, what: &str) -> Result<&'a str, String> {
        self.next_line().ok_or_else(|| self.file.file_error(format!("the file ends early: {what} is missing")))
    }

    /// Makes an error message about the line that was read last.
    pub fn error(&self, what: impl std::fmt::Display) -> String {
        self.file.line_error(self.number, what)
    }

    /// Whole number at the beginning of the next line, at most `most`.
    pub fn count(&mut self, what: &str, most: usize) -> Result<usize, String> {
        let line = self.expect_line(what)?;
        let word = line.split_whitespace().next().unwrap_or_default();
        let count = word.parse::<usize>().ok().filter(|n| (1..=most).contains(n));
        count.ok_or_else(|| self.error(format!("{} is not {what}, 1 to {most}", quoted_excerpt(word))))
    }

    /// Reads `count` numbers from the next lines, however they are divided among lines, and appends them to `out`.
    pub fn numbers(&mut self, count: usize, what: &str, out: &mut Vec<f64>) -> Result<(), String> {
        let mut left = count;
        while left > 0 {
            let line = self.expect_line(what)?;
            for word in line.split_whitespace().take(MAX_COLUMNS + 1) {
                if left == 0 {
                    return Err(self.error(format!("more numbers than the {count} of {what}")));
                }
                out.push(
                    number(word)
                        .ok_or_else(|| self.error(format!("{} in {what} is not a number", quoted_excerpt(word))))?,
                );
                left -= 1;
            }
        }
        Ok(())
    }
}

/// Parses a number as Fortran writes it, such as `0.1E-03`, `1.D+00`; a missing E before a sign is read too.
pub(super) fn number(word: &str) -> Option<f64> {
    if let Some(v) = parse_number(word) {
        return Some(v);
    }
    if word.contains(['d', 'D']) {
        return parse_number(&word.replace(['d', 'D'], "e"));
    }
    // Three digits of an exponent leave no room for the letter: 0.1234-100.
    let sign = word.rfind(['+', '-']).filter(|&at| at > 0)?;
    parse_number(&format!("{}e{}", &word[..sign], &word[sign..]))
}
