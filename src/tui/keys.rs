//! Keys by name, in one notation for the command table, the help, and `--keys` scripts.
//!
//! A printable character stands for itself; everything else is written in angle brackets:
//! `<Space>`, `<Tab>`, `<S-Tab>`, `<Esc>`, `<Enter>`, `<Up>`, `<C-c>`; `<lt>` is "<" itself.

use std::fmt;

use strum::{EnumString, IntoStaticStr};

/// One key press.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Keystroke {
    /// A printable character, with Shift applied.
    Char(char),
    /// Ctrl and a character.
    Ctrl(char),
    /// A key without a character.
    Named(Named),
}

/// Keys that produce no character.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, EnumString, IntoStaticStr)]
pub enum Named {
    /// Tab.
    Tab,
    /// Shift and Tab.
    #[strum(serialize = "S-Tab")]
    BackTab,
    /// Escape.
    Esc,
    /// Return.
    Enter,
    /// Backspace.
    Backspace,
    /// Arrow up.
    Up,
    /// Arrow down.
    Down,
    /// Arrow left.
    Left,
    /// Arrow right.
    Right,
    /// Home.
    Home,
    /// End.
    End,
    /// Page up.
    PageUp,
    /// Page down.
    PageDown,
    /// Delete.
    Delete,
}

impl Keystroke {
    /// Returns the key with the given name, as written between angle brackets.
    pub(super) fn of_name(name: &str) -> Option<Self> {
        let with_ctrl = name.strip_prefix("C-").map(str::parse::<char>);
        match (name, with_ctrl) {
            ("Space", _) => Some(Self::Char(' ')),
            ("lt", _) => Some(Self::Char('<')),
            (_, Some(character)) => Some(Self::Ctrl(character.ok()?.to_ascii_lowercase())),
            _ => name.parse().ok().map(Self::Named),
        }
    }
}

impl fmt::Display for Keystroke {
    /// Formats the key for the help: `Space`, `Ctrl-c`, `q`.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Char(' ') => formatter.write_str("Space"),
            Self::Char(character) => write!(formatter, "{character}"),
            Self::Ctrl(character) => write!(formatter, "Ctrl-{}", character.to_ascii_uppercase()),
            Self::Named(Named::BackTab) => formatter.write_str("Shift-Tab"),
            Self::Named(named) => formatter.write_str(named.into()),
        }
    }
}

/// Parses a script of keys; an error says what could not be read and where.
pub fn parse_script(script: &str) -> Result<Vec<Keystroke>, String> {
    read(script, |key| key, Keystroke::of_name)
}

/// Parses a script of characters, each converted by `key`, and of names between angle brackets.
pub(super) fn read<T>(
    script: &str,
    key: fn(Keystroke) -> T,
    of_name: fn(&str) -> Option<T>,
) -> Result<Vec<T>, String> {
    let (mut read, mut rest) = (Vec::new(), script);
    while let Some(first) = rest.chars().next() {
        let next = match rest[first.len_utf8()..].split_once('>') {
            Some((name, after)) if first == '<' => of_name(name).map(|named| (named, after)),
            _ if first == '<' || first.is_control() => None,
            _ => Some((key(Keystroke::Char(first)), &rest[first.len_utf8()..])),
        };
        let Some((next, after)) = next else {
            let start: String = rest.chars().take(12).collect();
            return Err(format!(
                "--keys: {start:?} is not a key; keys are characters or <Space>, <Tab>, <Esc>, \
                 <Enter>, <Up>, <C-c>, and <lt> for \"<\""
            ));
        };
        read.push(next);
        rest = after;
    }
    Ok(read)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_read_characters_and_names() {
        let keys = parse_script("m<Space>M<Tab><C-c><lt>?").expect("a script");
        let expected = [
            Keystroke::Char('m'),
            Keystroke::Char(' '),
            Keystroke::Char('M'),
            Keystroke::Named(Named::Tab),
            Keystroke::Ctrl('c'),
            Keystroke::Char('<'),
            Keystroke::Char('?'),
        ];
        assert_eq!(keys, expected);
        assert_eq!(parse_script(""), Ok(Vec::new()));
    }

    #[test]
    fn a_bad_script_is_refused_with_its_place() {
        for script in ["<", "m<Nope>", "<C-xy>", "<C->", "<Spac", "a\u{1b}b", "<ü>"] {
            let refusal = parse_script(script).expect_err(script);
            assert!(!refusal.chars().any(char::is_control), "{refusal}");
        }
    }
}
