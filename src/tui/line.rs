//! One line of text being typed, and text fitted into lines.

use std::mem::take;

use ratatui::text::Span;

use super::keys::{Keystroke, Named};

/// Maximum length of a line, in characters: a path fits, a pasted document does not.
pub const LONGEST: usize = 4096;

/// Returns the first line of a message, with the number of lines that follow.
pub fn one_line(text: &str) -> String {
    let mut lines = text.lines();
    let first = lines.next().unwrap_or_default();
    match lines.count() {
        0 => first.to_owned(),
        more => format!("{first} (and {more} more)"),
    }
}

/// Returns the width of a text, in cells.
pub fn cells(text: &str) -> usize {
    Span::raw(text).width()
}

/// Breaks a text at blanks into lines no wider than `width` cells; longer words are cut.
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    let width = width.max(1);
    let mut lines = Vec::new();
    for line in text.lines() {
        let mut now = String::new();
        for word in line.split_whitespace() {
            if !now.is_empty() && cells(&now) + 1 + cells(word) > width {
                lines.push(take(&mut now));
            }
            if !now.is_empty() {
                now.push(' ');
            }
            for sign in word.chars() {
                if cells(&now) + cells(sign.encode_utf8(&mut [0; 4])) > width {
                    lines.push(take(&mut now));
                }
                now.push(sign);
            }
        }
        lines.push(now);
    }
    lines
}

/// The text before and after the cursor.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LineEdit {
    before: String,
    after: String,
}

impl LineEdit {
    /// Makes a line with `text`, the cursor at its end.
    pub fn new(text: &str) -> Self {
        let mut line = Self::default();
        line.paste(text);
        line
    }

    /// Inserts a text without its control characters, as far as it fits. Returns false if a part did not fit.
    pub fn paste(&mut self, text: &str) -> bool {
        let mut characters = text.chars().filter(|c| !c.is_control());
        let room = LONGEST.saturating_sub(self.text().chars().count());
        self.before.extend(characters.by_ref().take(room));
        characters.next().is_none()
    }

    /// The whole line.
    pub fn text(&self) -> String {
        [&*self.before, &self.after].concat()
    }

    /// Whether nothing has been typed.
    pub fn is_empty(&self) -> bool {
        self.text().is_empty()
    }

    /// Returns the text before and after the cursor.
    pub fn halves(&self) -> [&str; 2] {
        [&self.before, &self.after]
    }

    /// Handles a key as the filter of a list: characters, Backspace, Ctrl-U and Ctrl-W edit the end of the text.
    /// Returns false for other keys, which move in the list.
    pub fn filter(&mut self, key: Keystroke) -> bool {
        let is_filter = match key {
            // A filter does not begin with a blank.
            Keystroke::Char(' ') => !self.is_empty(),
            Keystroke::Char(_) => true,
            Keystroke::Named(Named::Backspace) | Keystroke::Ctrl('u' | 'w') => true,
            _ => false,
        };
        is_filter && self.press(key)
    }

    /// Whether each of its words occurs in the text, ignoring case.
    pub fn fits(&self, text: &str) -> bool {
        let (wanted, text) = (self.text().to_lowercase(), text.to_lowercase());
        wanted.split_whitespace().all(|word| text.contains(word))
    }

    /// Handles a key like a shell's line: characters, arrows, Home, End, Backspace, Delete, Ctrl-U for everything
    /// before the cursor and Ctrl-W for the word before it. Returns false for other keys.
    pub fn press(&mut self, key: Keystroke) -> bool {
        let (before, after) = (&mut self.before, &mut self.after);
        match key {
            Keystroke::Char(character) => _ = self.paste(&character.to_string()),
            Keystroke::Named(Named::Backspace) => _ = before.pop(),
            Keystroke::Named(Named::Left) => after.insert_str(0, &String::from_iter(before.pop())),
            Keystroke::Named(Named::Delete) if !after.is_empty() => _ = after.remove(0),
            Keystroke::Named(Named::Right) if !after.is_empty() => before.push(after.remove(0)),
            Keystroke::Named(Named::Delete | Named::Right) => {}
            Keystroke::Named(Named::Home) | Keystroke::Ctrl('a') => {
                after.insert_str(0, &take(before))
            }
            Keystroke::Named(Named::End) | Keystroke::Ctrl('e') => before.push_str(&take(after)),
            Keystroke::Ctrl('u') => before.clear(),
            Keystroke::Ctrl('w') => {
                let word = before.trim_end_matches(' ').rfind(' ');
                before.truncate(word.map_or(0, |space| space + 1));
            }
            _ => return false,
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::keys::parse_script;

    fn typed(script: &str) -> (String, String) {
        let mut line = LineEdit::new("ab");
        for key in parse_script(script).expect("a script") {
            line.press(key);
        }
        let [before, after] = line.halves().map(str::to_owned);
        (before, after)
    }

    #[test]
    fn a_line_is_bounded_and_takes_what_is_pasted_where_the_cursor_is() {
        let mut line = LineEdit::new("ab");
        line.press(Keystroke::Named(Named::Left));
        assert!(line.paste("1\n2\x1b3"));
        assert_eq!(line.halves(), ["a123", "b"]);
        assert!(!line.paste(&"x".repeat(1_000_000)));
        assert_eq!(line.text().len(), LONGEST);
        line.press(Keystroke::Char('y'));
        assert_eq!(line.text().len(), LONGEST);
        assert!(line.text().ends_with("xb"));
    }

    #[test]
    fn lines_are_broken_at_blanks_and_words_only_if_they_must() {
        assert_eq!(wrapped("one two  three", 8), ["one two", "three"]);
        assert_eq!(wrapped("abcdefghij k", 4), ["abcd", "efgh", "ij k"]);
        assert_eq!(wrapped("a\n\nb", 4), ["a", "", "b"]);
        assert_eq!(wrapped("接触の摩耗", 5), ["接触", "の摩", "耗"]);
    }

    #[test]
    fn it_edits_as_a_shell_does() {
        for (script, before, after) in [
            ("cd", "abcd", ""),
            ("<Left>x", "ax", "b"),
            ("<Left><Left><Left><Delete>", "", "b"),
            ("<Backspace><Backspace><Backspace>é", "é", ""),
            ("<Home>1<End>2", "1ab2", ""),
            (" cd ef<C-w>", "ab cd ", ""),
            (" cd  <C-w>", "ab ", ""),
            ("<C-w><C-w>", "", ""),
            ("<Left><C-u>", "", "b"),
        ] {
            assert_eq!(typed(script), (before.into(), after.into()), "{script}");
        }
        assert!(!LineEdit::default().press(Keystroke::Named(Named::Enter)));
    }
}
