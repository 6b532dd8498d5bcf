//! Turns the bytes from the terminal into keys, pasted text, clicks and answers.
//!
//! The Escape key is distinguished from the start of a sequence by what follows it, or by the pause after it: nothing is
//! bound to Alt. Ctrl-C is recognised whatever it comes in.

use std::str::from_utf8;

use ratatui::layout::Position;

use super::flow::Request;
use super::keys::{Keystroke, Named};
use super::line;
use super::mouse::Gesture;

/// The pause after which Escape counts as a key, milliseconds: a network may split a sequence by less.
const LONE_ESCAPE: u16 = 100;

/// The silence after which an incomplete sequence is given up, milliseconds.
const GIVE_UP: u16 = 250;

/// The same for strings, such as the answer about a colour: the rest of one would be taken for keys.
const GIVE_UP_STRING: u16 = 3000;

/// Longer than any sequence of interest here; of longer ones, only the ends are kept.
const LONGEST: usize = 64;

/// The bytes of Ctrl-C and Escape.
const INTERRUPT: u8 = 3;
const ESCAPE: u8 = 0x1b;

/// Input from a terminal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Input {
    /// A key.
    Key(Keystroke),
    /// Pasted text, cut to the maximum length of a line.
    Paste(String),
    /// A click, or a turn of the wheel.
    Point(Gesture),
    /// The answer to a request: the terminal has read everything sent before it.
    Answer(Request),
    /// The background colour, as red, green and blue.
    Background([u8; 3]),
    /// Ctrl-C.
    Interrupt,
}

/// The state of the reader.
#[derive(Debug, Default)]
pub struct Reader {
    inputs: Vec<Input>,
    /// The bytes of an incomplete character or sequence.
    begun: Vec<u8>,
    /// The text between the marks of a paste.
    paste: Option<String>,
    /// Whether the last character of an unfinished paste is Ctrl-C; answers of the terminal may follow it.
    is_interrupted: bool,
}

impl Reader {
    /// Takes in bytes that have come together, and returns what they mean.
    pub fn read(&mut self, bytes: &[u8]) -> Vec<Input> {
        // Within a text that was pasted it is a character, unless a hand has typed it.
        if bytes.contains(&INTERRUPT) && (self.paste.is_none() || bytes == [INTERRUPT]) {
            *self = Self::default();
            return vec![Input::Interrupt];
        }
        bytes.iter().for_each(|&byte| self.byte(byte));
        std::mem::take(&mut self.inputs)
    }

    fn byte(&mut self, byte: u8) {
        if !may_continue(&self.begun, byte) {
            // An Escape that does not end a string begins something else.
            let begins_again = matches!(self.begun[..], [_, _, .., ESCAPE]);
            self.typed();
            if begins_again {
                self.begun.push(ESCAPE);
                return self.byte(byte);
            }
        }
        let mut begun = std::mem::take(&mut self.begun);
        begun.push(byte);
        if !self.means(&begun) {
            if begun.len() > LONGEST {
                begun.remove(LONGEST / 2);
            }
            self.begun = begun;
        }
    }

    /// Interprets bytes; returns whether they are complete.
    fn means(&mut self, bytes: &[u8]) -> bool {
        match bytes {
            // A click in the encoding before mode 1006: button, column and row are one byte each.
            [ESCAPE, b'[', b'M', ..] if self.paste.is_none() => return bytes.len() == 6,
            [ESCAPE, b'[', numbers @ .., last @ b'@'..=b'~'] => self.sequence(numbers, *last),
            [ESCAPE, b'O', last] => self.push_named(*last, 0),
            [ESCAPE, b']', text @ .., 7] | [ESCAPE, b']', text @ .., ESCAPE, b'\\'] => {
                let color = text.strip_prefix(b"11;").and_then(color_of);
                let color = color.filter(|_| self.paste.is_none());
                self.inputs.extend(color.map(Input::Background));
            }
            [ESCAPE, _, .., ESCAPE, b'\\'] => {}
            [ESCAPE, ..] => return false,
            [byte @ 0..=31] => self.control(*byte),
            bytes => match from_utf8(bytes) {
                Ok(text) => text.chars().for_each(|character| self.character(character)),
                Err(error) => return error.error_len().is_some(),
            },
        }
        true
    }

    /// Turns what looked like the start of a sequence into keys; drops a longer one.
    fn typed(&mut self) {
        let begun = std::mem::take(&mut self.begun);
        if begun.first() == Some(&ESCAPE) && begun.len() <= 2 {
            self.key(Keystroke::Named(Named::Esc));
            let then = begun[1..].iter();
            then.for_each(|&byte| self.key(Keystroke::Char(byte.into())));
        }
    }

    /// Returns how long to wait for more before [`rest`](Self::pause), milliseconds; `None` means forever.
    pub fn patience(&self) -> Option<u16> {
        match self.begun[..] {
            [] => self.is_interrupted.then_some(GIVE_UP),
            [ESCAPE] => Some(LONE_ESCAPE),
            [ESCAPE, b']' | b'P' | b'X' | b'^' | b'_', _, ..] => Some(GIVE_UP_STRING),
            _ => Some(GIVE_UP),
        }
    }

    /// Handles a pause of that length: bytes that look like the start of a sequence are keys.
    pub fn pause(&mut self) -> Vec<Input> {
        self.typed();
        self.interrupt();
        std::mem::take(&mut self.inputs)
    }

    /// Handles a Ctrl-C that was typed after the text of a paste without an end.
    fn interrupt(&mut self) {
        if std::mem::take(&mut self.is_interrupted) {
            self.paste = None;
            self.inputs.push(Input::Interrupt);
        }
    }

    fn key(&mut self, key: Keystroke) {
        if self.paste.is_none() {
            self.inputs.push(Input::Key(key));
        }
    }

    /// Adds the key for a sequence's last byte and first number.
    fn push_named(&mut self, last: u8, number: u16) {
        let named = match (last, number) {
            (b'A', _) => Named::Up,
            (b'B', _) => Named::Down,
            (b'C', _) => Named::Right,
            (b'D', _) => Named::Left,
            (b'H', _) | (b'~', 1 | 7) => Named::Home,
            (b'F', _) | (b'~', 4 | 8) => Named::End,
            (b'Z', _) => Named::BackTab,
            (b'~', 3) => Named::Delete,
            (b'~', 5) => Named::PageUp,
            (b'~', 6) => Named::PageDown,
            _ => return,
        };
        self.key(Keystroke::Named(named));
    }

    fn character(&mut self, character: char) {
        self.is_interrupted = false;
        match &mut self.paste {
            Some(text) if text.len() < 4 * line::LONGEST => text.push(character),
            Some(_) => {}
            None if character == '\x7f' => self.key(Keystroke::Named(Named::Backspace)),
            None => self.key(Keystroke::Char(character)),
        }
    }

    fn control(&mut self, byte: u8) {
        match byte {
            // In pasted text, line breaks and tabs become blanks.
            b'\t' | b'\r' | b'\n' if self.paste.is_some() => self.character(' '),
            b'\t' => self.key(Keystroke::Named(Named::Tab)),
            b'\r' => self.key(Keystroke::Named(Named::Enter)),
            INTERRUPT if self.paste.is_some() => self.is_interrupted = true,
            0 => self.key(Keystroke::Ctrl(' ')),
            1..=26 => self.key(Keystroke::Ctrl(char::from(byte - 1 + b'a'))),
            _ => {}
        }
    }

    /// A control sequence (CSI), by its mark and numbers, and its last byte.
    fn sequence(&mut self, text: &[u8], last: u8) {
        let text = String::from_utf8_lossy(text);
        let digits = text.trim_start_matches(['<', '=', '>', '?']);
        let mark = &text[..text.len() - digits.len()];
        let mut numbers = digits.split([';', ':']).map(str::parse::<u16>);
        let mut number = || numbers.next().and_then(Result::ok).unwrap_or(0);
        match (mark, last, number()) {
            ("", b'~', 200) => self.paste = Some(String::new()),
            ("", b'~', 201) => {
                self.is_interrupted = false;
                let text = self.paste.take();
                self.inputs.extend(text.map(Input::Paste));
            }
            ("", b'n', 0) => {
                // A busy terminal leaves no silence behind a Ctrl-C; its answer tells that no text follows.
                self.interrupt();
                self.inputs.push(Input::Answer(Request::Status));
            }
            ("", b'R', _) => self.inputs.push(Input::Answer(Request::Place)),
            // Presses and the wheel, as mode 1006 tells them: columns and rows count from 1.
            ("<", b'M', 0) => {
                let [x, y] = [number(), number()].map(|place| place.saturating_sub(1));
                self.inputs
                    .push(Input::Point(Gesture::Click(Position { x, y })));
            }
            ("<", b'M', 64) => self.inputs.push(Input::Point(Gesture::WheelUp)),
            ("<", b'M', 65) => self.inputs.push(Input::Point(Gesture::WheelDown)),
            ("", last, number) => self.push_named(last, number),
            _ => {}
        }
    }
}

/// Whether a byte may continue an incomplete sequence; what does not begin with Escape is a UTF-8 character.
fn may_continue(begun: &[u8], byte: u8) -> bool {
    match begun {
        [] => true,
        [ESCAPE] => b"[O]PX^_".contains(&byte),
        [ESCAPE, b'O'] => matches!(byte, b'A'..=b'H' | b'M' | b'P'..=b'S' | b'j'..=b'y'),
        // Answers begin with a number or a mark.
        [ESCAPE, b']' | b'P'] => matches!(byte, b'0'..=b'9' | b'!' | b'$' | b'+' | b'<'..=b'?'),
        [ESCAPE, b'[', ..] => byte >= b' ',
        [ESCAPE, .., ESCAPE] => byte == b'\\',
        [ESCAPE, ..] => true,
        _ => byte & 0xc0 == 0x80,
    }
}

/// The colour that a terminal tells as `rgb:` or `rgba:` and shares of the brightest, one to four
/// hexadecimal digits each, slashes between them.
fn color_of(text: &[u8]) -> Option<[u8; 3]> {
    let (_, shares) = from_utf8(text).ok()?.split_once(':')?;
    let mut shares = shares.split('/').map(|digits| {
        let most = 16u32.checked_pow(u32::try_from(digits.len()).ok()?)? - 1;
        let share = u32::from_str_radix(digits, 16).ok()?;
        u8::try_from(share.checked_mul(255)? / most.max(1)).ok()
    });
    let mut next = || shares.next().flatten();
    Some([next()?, next()?, next()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the inputs for bytes that arrive in these pieces, with silence at the end.
    fn read(pieces: &[&[u8]]) -> Vec<Input> {
        let mut reader = Reader::default();
        let inputs = pieces.iter().flat_map(|piece| reader.read(piece));
        let mut inputs: Vec<Input> = inputs.collect();
        inputs.extend(reader.pause());
        inputs
    }

    fn key(key: Keystroke) -> Input {
        Input::Key(key)
    }

    fn named(named: Named) -> Input {
        Input::Key(Keystroke::Named(named))
    }

    #[test]
    fn the_background_is_read_in_every_notation() {
        let cases: [(&[u8], &[[u8; 3]]); 8] = [
            (b"\x1b]11;rgb:ffff/ffff/ffff\x1b\\", &[[255; 3]]),
            (b"\x1b]11;rgb:fdfd/f6f6/e3e3\x07", &[[0xfd, 0xf6, 0xe3]]),
            (b"\x1b]11;rgb:0/8/f\x07", &[[0, 136, 255]]),
            (b"\x1b]11;rgba:0000/2b00/36ff/ffff\x07", &[[0, 42, 54]]),
            (b"\x1b]10;rgb:ffff/ffff/ffff\x07", &[]),
            (b"\x1b]11;rgb:fffff/ffffffffffff/\x07", &[]),
            (b"\x1b]11;black\x07", &[]),
            // This is not an answer to a request, but text that somebody has copied.
            (b"\x1b[200~\x1b]11;rgb:ff/ff/ff\x07\x1b[201~", &[]),
        ];
        for (bytes, expected) in cases {
            let mut backgrounds = read(&[bytes]);
            backgrounds.retain(|input| matches!(input, Input::Background(_)));
            let expected: Vec<_> = expected.iter().copied().map(Input::Background).collect();
            assert_eq!(backgrounds, expected, "{}", bytes.escape_ascii());
            for split in 1..bytes.len() {
                let mut backgrounds = read(&[&bytes[..split], &bytes[split..]]);
                backgrounds.retain(|input| matches!(input, Input::Background(_)));
                assert_eq!(backgrounds, expected, "{} {split}", bytes.escape_ascii());
            }
        }
    }

    #[test]
    fn keys_are_read_however_their_bytes_are_split() {
        let cases: [(&[u8], Vec<Input>); 18] = [
            (
                "aé∂ ".as_bytes(),
                ['a', 'é', '∂', ' ']
                    .map(|c| key(Keystroke::Char(c)))
                    .to_vec(),
            ),
            (b"\x1b[A", vec![named(Named::Up)]),
            (b"\x1bOB", vec![named(Named::Down)]),
            (b"\x1b[1;5C", vec![named(Named::Right)]),
            (
                b"\x1b[3~\x1b[5~",
                vec![named(Named::Delete), named(Named::PageUp)],
            ),
            (
                b"\x1b[H\x1b[4~",
                vec![named(Named::Home), named(Named::End)],
            ),
            (
                b"\x1b[Z\t\r",
                vec![
                    named(Named::BackTab),
                    named(Named::Tab),
                    named(Named::Enter),
                ],
            ),
            (b"\x7f", vec![named(Named::Backspace)]),
            (
                b"\x15\x17",
                vec![key(Keystroke::Ctrl('u')), key(Keystroke::Ctrl('w'))],
            ),
            (b"\x1b", vec![named(Named::Esc)]),
            (b"\x1b\x1b", vec![named(Named::Esc), named(Named::Esc)]),
            (b"\x1b\r", vec![named(Named::Esc), named(Named::Enter)]),
            (
                b"\x1b[0n\x1b[?1;2c\x1b[5;7Rz",
                vec![
                    Input::Answer(Request::Status),
                    Input::Answer(Request::Place),
                    key(Keystroke::Char('z')),
                ],
            ),
            // Nothing is bound to Alt.
            (b"\x1bz", vec![named(Named::Esc), key(Keystroke::Char('z'))]),
            (
                "\x1bé\x1bO".as_bytes(),
                vec![
                    named(Named::Esc),
                    key(Keystroke::Char('é')),
                    named(Named::Esc),
                    key(Keystroke::Char('O')),
                ],
            ),
            (
                b"\x1b]]\x1b[",
                vec![
                    named(Named::Esc),
                    key(Keystroke::Char(']')),
                    key(Keystroke::Char(']')),
                    named(Named::Esc),
                    key(Keystroke::Char('[')),
                ],
            ),
            // A release (kitty), the focus, and what the terminal tells of itself.
            (
                b"\x1b[97;1:3u\x1b[I\x1b[O\x1b[?62;22c\x1b[>1;10;0c\x1b[8;24;80t\x1bP>|x(1)\x1b\\q",
                vec![key(Keystroke::Char('q'))],
            ),
            // A click as old terminals tell it.
            (b"\x1b[M !q\x1b[A", vec![named(Named::Up)]),
        ];
        for (bytes, expected) in cases {
            assert_eq!(read(&[bytes]), expected, "{bytes:?}");
            let single: Vec<&[u8]> = bytes.chunks(1).collect();
            assert_eq!(read(&single), expected, "{bytes:?} one by one");
        }
    }

    #[test]
    fn clicks_and_the_wheel_are_read() {
        let inputs = read(&[b"\x1b[<0;3;4M\x1b[<0;3;4m\x1b[<65;300;1M"]);
        let click = Gesture::Click(Position::new(2, 3));
        assert_eq!(inputs, [click, Gesture::WheelDown].map(Input::Point));
    }

    #[test]
    fn what_is_pasted_is_text_and_bounded() {
        let pasted = read(&[b"\x1b[200~q: set\r\nx\x1b[Ay\x1b[201~q"]);
        let expected = [Input::Paste("q: set  xy".into()), key(Keystroke::Char('q'))];
        assert_eq!(pasted, expected);
        let much = [b"\x1b[200~".as_slice(), &[b'x'; 1 << 20], b"\x1b[201~"].concat();
        match &read(&[&much])[..] {
            [Input::Paste(text)] => assert_eq!(text.len(), 4 * line::LONGEST),
            other => panic!("{} inputs", other.len()),
        }
    }

    #[test]
    fn ctrl_c_is_seen_in_whatever_it_comes() {
        let cases: [&[&[u8]]; 9] = [
            &[b"aaaa\x03bbbb"],
            &[b"\x1b]0;a title that never ends", b"\x03"],
            &[b"\x1bPq", b"\x03"],
            &[b"\x1b[200~a paste that never ends", b"\x03"],
            &[b"\x1b[200~a paste that never ends\x03"],
            &[b"\x1b[200~a paste that never ends\x03\x1b[0n"],
            &[b"\x1b[200~a paste that never ends\x1b[0n\x03", b"\x1b[0n"],
            &[b"\x1b[200~a paste that never ends\x03\x1b", b"[0n"],
            &[b"\x1b[12", b"\x03"],
        ];
        for pieces in cases {
            assert!(read(pieces).contains(&Input::Interrupt), "{pieces:?}");
        }
    }

    #[test]
    fn what_never_ends_is_given_up() {
        for (begun, least) in [
            (b"\x1b]0;title".as_slice(), 1000),
            (b"\x1b]11;rgb:ffff/ff\x1b", 1000),
            (b"\x1bP1", 1000),
            (b"\x1b[12", 100),
            (b"\x1b[M ", 100),
        ] {
            let mut reader = Reader::default();
            assert_eq!(reader.read(begun), []);
            assert!(reader.patience() >= Some(least), "{begun:?}");
            assert_eq!(reader.pause(), []);
            assert_eq!(reader.read(b"q"), [key(Keystroke::Char('q'))], "{begun:?}");
        }
    }
}
