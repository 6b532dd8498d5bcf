//! One line of text being typed.

use super::keys::{Key, Named};

/// The longest line, in characters: a path fits, and a pasted document does not.
pub const LONGEST: usize = 4096;

/// The first line of a message that may have more, and how many follow.
pub fn one_line(text: &str) -> String {
    let mut lines = text.lines();
    let first = lines.next().unwrap_or_default();
    match lines.count() {
        0 => first.to_owned(),
        more => format!("{first} (and {more} more)"),
    }
}

/// The text and where the next character goes.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LineEdit {
    text: Vec<char>,
    at: usize,
}

impl LineEdit {
    /// A line that holds `text`, the cursor behind it.
    pub fn new(text: &str) -> Self {
        let mut line = Self::default();
        line.paste(text);
        line
    }

    /// Inserts a text without its control characters, as far as it fits. Returns false if some of
    /// it did not fit.
    pub fn paste(&mut self, text: &str) -> bool {
        let mut characters = text.chars().filter(|c| !c.is_control());
        let room = LONGEST.saturating_sub(self.text.len());
        let fitting: Vec<char> = characters.by_ref().take(room).collect();
        let end = self.at + fitting.len();
        self.text.splice(self.at..self.at, fitting);
        self.at = end;
        characters.next().is_none()
    }

    /// The whole line.
    pub fn text(&self) -> String {
        self.text.iter().collect()
    }

    /// Whether nothing has been typed.
    pub fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    /// The text before the cursor, and the text from it on.
    pub fn halves(&self) -> (String, String) {
        let (before, after) = self.text.split_at(self.at);
        (before.iter().collect(), after.iter().collect())
    }

    /// Takes a key as a shell's line does: characters, arrows, Home, End, Backspace, Delete, Ctrl-U
    /// for all before the cursor and Ctrl-W for the word before it. Returns false for other keys.
    pub fn press(&mut self, key: Key) -> bool {
        match key {
            Key::Char(_) if self.text.len() >= LONGEST => {}
            Key::Char(character) => {
                self.text.insert(self.at, character);
                self.at += 1;
            }
            Key::Named(Named::Backspace) if self.at > 0 => {
                self.at -= 1;
                self.text.remove(self.at);
            }
            Key::Named(Named::Delete) if self.at < self.text.len() => {
                self.text.remove(self.at);
            }
            Key::Named(Named::Backspace | Named::Delete) => {}
            Key::Named(Named::Left) => self.at = self.at.saturating_sub(1),
            Key::Named(Named::Right) => self.at = (self.at + 1).min(self.text.len()),
            Key::Named(Named::Home) | Key::Ctrl('a') => self.at = 0,
            Key::Named(Named::End) | Key::Ctrl('e') => self.at = self.text.len(),
            Key::Ctrl('u') => self.cut_to(0),
            Key::Ctrl('w') => {
                let before = &self.text[..self.at];
                let word = before.iter().rposition(|c| *c != ' ');
                let start = word.map_or(0, |end| {
                    before[..end]
                        .iter()
                        .rposition(|c| *c == ' ')
                        .map_or(0, |space| space + 1)
                });
                self.cut_to(start);
            }
            _ => return false,
        }
        true
    }

    /// Removes what stands from `start` to the cursor.
    fn cut_to(&mut self, start: usize) {
        self.text.drain(start..self.at);
        self.at = start;
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
        line.halves()
    }

    #[test]
    fn a_line_is_bounded_and_takes_what_is_pasted_where_the_cursor_is() {
        let mut line = LineEdit::new("ab");
        line.press(Key::Named(Named::Left));
        assert!(line.paste("1\n2\x1b3"));
        assert_eq!(line.halves(), ("a123".into(), "b".into()));
        assert!(!line.paste(&"x".repeat(1_000_000)));
        assert_eq!(line.text().len(), LONGEST);
        line.press(Key::Char('y'));
        assert_eq!(line.text().len(), LONGEST);
        assert!(line.text().ends_with("xb"));
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
        assert!(!LineEdit::default().press(Key::Named(Named::Enter)));
    }
}
