//! Changes to a text that leave every line where it is.

use std::ops::Range;

/// Replacements of parts of a text.
#[derive(Debug, Default)]
pub(super) struct Edits {
    edits: Vec<(Range<usize>, String)>,
}

impl Edits {
    /// Takes a part out.
    pub(super) fn blank(&mut self, range: Range<usize>) {
        self.replace(range, "");
    }

    /// Puts `new`, which has no line breaks, in the place of a part; an empty part is a place to insert at.
    pub(super) fn replace(&mut self, range: Range<usize>, new: &str) {
        self.edits.push((range, new.to_owned()));
    }

    /// The text with all of it done. Line breaks of what goes stay; of edits that overlap the first to begin counts, and of those the
    /// longest.
    pub(super) fn apply(mut self, text: &str) -> String {
        self.edits.sort_by_key(|(range, _)| (range.start, std::cmp::Reverse(range.end)));
        let mut result = String::with_capacity(text.len());
        let mut at = 0;
        for (range, new) in self.edits {
            if range.start < at {
                continue;
            }
            result.push_str(&text[at..range.start]);
            result.push_str(&new);
            if new.is_empty() && !range.is_empty() {
                result.push(' ');
            }
            result.extend(text[range.clone()].matches('\n'));
            at = range.end;
        }
        result.push_str(&text[at..]);
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_stay() {
        let text = "one\ntwo\nthree four";
        let mut edits = Edits::default();
        edits.replace(14..18, "4");
        edits.blank(2..9);
        edits.blank(4..6);
        edits.replace(0..0, "zero ");
        assert_eq!(edits.apply(text), "zero on \n\nhree 4");
    }
}
