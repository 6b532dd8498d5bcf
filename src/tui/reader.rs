//! Turns the bytes from the terminal into keys, pasted text, clicks and status reports.
//!
//! `vte` parses the bytes; this module adds what a keyboard needs. A lone Escape is told from the
//! start of a sequence by the pause after it. Ctrl-C is recognised in any state of the parser.

use ratatui::layout::Position;
use vte::{Params, Parser, Perform};

use super::keys::{Key, Named};
use super::line;
use super::mouse::Gesture;

/// The pause after which an Escape is a key, milliseconds.
const LONE_ESCAPE: u16 = 25;

/// The silence after which a sequence that has begun is given up, in milliseconds.
const GIVE_UP: u16 = 250;

/// The byte of Ctrl-C.
const INTERRUPT: u8 = 3;

/// Something that a terminal has sent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Input {
    /// A key.
    Key(Key),
    /// Text that was pasted, cut to the longest line.
    Paste(String),
    /// A click, or a turn of the wheel.
    Point(Gesture),
    /// The status report: the terminal has read everything sent before the request.
    Ready,
    /// The background, as red, green and blue.
    Background([u8; 3]),
    /// Ctrl-C.
    Interrupt,
}

/// The parser and what it has found.
#[derive(Default)]
pub struct Reader {
    parser: Parser,
    found: Found,
    /// The last byte was an Escape that may be a key.
    is_escape: bool,
    /// Bytes have come since the last thing found: a sequence may be under way.
    is_under_way: bool,
}

#[derive(Debug, Default)]
struct Found {
    inputs: Vec<Input>,
    /// The text between the marks of a paste.
    paste: Option<String>,
    /// The last character of a paste that has no end yet is that of Ctrl-C; what the terminal answers may follow.
    is_interrupted: bool,
    /// The character after `ESC O` is a key.
    is_single_shift: bool,
}

impl Reader {
    /// Takes in bytes that have come together; what they mean is added to `to`.
    pub fn take(&mut self, bytes: &[u8], to: &mut Vec<Input>) {
        // Within a text that was pasted it is a character, unless a hand has typed it.
        if bytes.contains(&INTERRUPT) && (self.found.paste.is_none() || bytes == [INTERRUPT]) {
            *self = Self::default();
            return to.push(Input::Interrupt);
        }
        for &byte in bytes {
            let begins = byte == 0x1b;
            // An Escape is followed by a printable character where it begins a sequence.
            if self.is_escape && (begins || byte < b' ') {
                self.lone_escape();
            }
            let before = self.found.inputs.len();
            self.parser.advance(&mut self.found, &[byte]);
            self.is_escape = begins;
            self.is_under_way = self.found.inputs.len() == before;
        }
        to.append(&mut self.found.inputs);
    }

    fn lone_escape(&mut self) {
        self.parser = Parser::new();
        self.is_escape = false;
        self.found.key(Key::Named(Named::Esc));
    }

    /// How long to wait for more before [`rest`](Self::rest); `None`: forever.
    pub fn patience(&self) -> Option<u16> {
        match self.is_escape {
            true => Some(LONE_ESCAPE),
            false => self.is_under_way.then_some(GIVE_UP),
        }
    }

    /// Nothing more has come for that long.
    pub fn rest(&mut self, to: &mut Vec<Input>) {
        if self.is_escape {
            self.lone_escape();
        }
        self.found.interrupt();
        self.parser = Parser::new();
        self.is_under_way = false;
        if std::mem::take(&mut self.found.is_single_shift) {
            self.found.inputs.push(Input::Key(Key::Char('O')));
        }
        to.append(&mut self.found.inputs);
    }
}

impl Found {
    /// Ctrl-C where a paste has no end, and a hand has typed it behind the text.
    fn interrupt(&mut self) {
        if std::mem::take(&mut self.is_interrupted) {
            self.paste = None;
            self.inputs.push(Input::Interrupt);
        }
    }

    fn key(&mut self, key: Key) {
        if self.paste.is_none() {
            self.inputs.push(Input::Key(key));
        }
    }

    /// The key of a sequence by its last character and first number.
    fn named(&mut self, last: char, number: u16) {
        let named = match (last, number) {
            ('A', _) => Named::Up,
            ('B', _) => Named::Down,
            ('C', _) => Named::Right,
            ('D', _) => Named::Left,
            ('H', _) | ('~', 1 | 7) => Named::Home,
            ('F', _) | ('~', 4 | 8) => Named::End,
            ('Z', _) => Named::BackTab,
            ('~', 3) => Named::Delete,
            ('~', 5) => Named::PageUp,
            ('~', 6) => Named::PageDown,
            _ => return,
        };
        self.key(Key::Named(named));
    }
}

impl Perform for Found {
    fn print(&mut self, character: char) {
        self.is_interrupted = false;
        if let Some(text) = &mut self.paste {
            if text.len() < 4 * line::LONGEST {
                text.push(character);
            }
        } else if std::mem::take(&mut self.is_single_shift) {
            self.named(character, 0);
        } else if character == '\x7f' {
            self.key(Key::Named(Named::Backspace));
        } else {
            self.key(Key::Char(character));
        }
    }

    fn execute(&mut self, byte: u8) {
        match byte {
            // In a text that is pasted, lines and columns become words.
            b'\t' | b'\r' | b'\n' if self.paste.is_some() => self.print(' '),
            b'\t' => self.key(Key::Named(Named::Tab)),
            b'\r' => self.key(Key::Named(Named::Enter)),
            INTERRUPT if self.paste.is_some() => self.is_interrupted = true,
            0 => self.key(Key::Ctrl(' ')),
            1..=26 => self.key(Key::Ctrl(char::from(byte - 1 + b'a'))),
            _ => {}
        }
    }

    fn esc_dispatch(&mut self, _: &[u8], _: bool, byte: u8) {
        match byte {
            b'O' => self.is_single_shift = true,
            // A character typed with Alt.
            b' '..=b'~' => self.key(Key::Char(char::from(byte))),
            _ => {}
        }
    }

    /// The answer to what the background is.
    fn osc_dispatch(&mut self, parameters: &[&[u8]], _: bool) {
        if let ([b"11", color], None) = (parameters, &self.paste) {
            let color = std::str::from_utf8(color).ok().and_then(color_of);
            self.inputs.extend(color.map(Input::Background));
        }
    }

    fn csi_dispatch(&mut self, parameters: &Params, marks: &[u8], _: bool, last: char) {
        let mut numbers = parameters.iter().filter_map(|sub| sub.first().copied());
        let mut number = || numbers.next().unwrap_or(0);
        match (marks, last, number()) {
            ([], '~', 200) => self.paste = Some(String::new()),
            ([], '~', 201) => {
                self.is_interrupted = false;
                let text = self.paste.take();
                self.inputs.extend(text.map(Input::Paste));
            }
            ([], 'n', 0) => {
                // A busy terminal leaves no silence behind a Ctrl-C; its answer tells that no text follows.
                self.interrupt();
                self.inputs.push(Input::Ready);
            }
            // Presses and the wheel, as mode 1006 tells them: columns and rows count from 1.
            ([b'<'], 'M', button) => {
                let [x, y] = [number(), number()].map(|place| place.saturating_sub(1));
                let gesture = match button {
                    0 => Gesture::Click(Position { x, y }),
                    64 => Gesture::WheelUp,
                    65 => Gesture::WheelDown,
                    _ => return,
                };
                self.inputs.push(Input::Point(gesture));
            }
            ([], last, number) => self.named(last, number),
            _ => {}
        }
    }
}

/// The colour that a terminal tells as `rgb:` or `rgba:` and shares of the brightest, one to four
/// hexadecimal digits each, slashes between them.
fn color_of(text: &str) -> Option<[u8; 3]> {
    let (_, shares) = text
        .split_once("rgb:")
        .or_else(|| text.split_once("rgba:"))?;
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

    /// What bytes mean that come in these pieces, with silence at the end.
    fn read(pieces: &[&[u8]]) -> Vec<Input> {
        let (mut reader, mut inputs) = (Reader::default(), Vec::new());
        for piece in pieces {
            reader.take(piece, &mut inputs);
        }
        if reader.patience().is_some() {
            reader.rest(&mut inputs);
        }
        inputs
    }

    fn key(key: Key) -> Input {
        Input::Key(key)
    }

    fn named(named: Named) -> Input {
        Input::Key(Key::Named(named))
    }

    #[test]
    fn the_background_is_read_however_it_is_told() {
        let cases: [(&[u8], &[[u8; 3]]); 8] = [
            (b"\x1b]11;rgb:ffff/ffff/ffff\x1b\\", &[[255; 3]]),
            (b"\x1b]11;rgb:fdfd/f6f6/e3e3\x07", &[[0xfd, 0xf6, 0xe3]]),
            (b"\x1b]11;rgb:0/8/f\x07", &[[0, 136, 255]]),
            (b"\x1b]11;rgba:0000/2b00/36ff/ffff\x07", &[[0, 42, 54]]),
            (b"\x1b]10;rgb:ffff/ffff/ffff\x07", &[]),
            (b"\x1b]11;rgb:fffff/ffffffffffff/\x07", &[]),
            (b"\x1b]11;black\x07", &[]),
            // No answer to a question, but a text that somebody has copied.
            (b"\x1b[200~\x1b]11;rgb:ff/ff/ff\x07\x1b[201~", &[]),
        ];
        for (bytes, expected) in cases {
            let mut told = read(&[bytes]);
            told.retain(|input| matches!(input, Input::Background(_)));
            let expected: Vec<_> = expected.iter().copied().map(Input::Background).collect();
            assert_eq!(told, expected, "{}", bytes.escape_ascii());
            for split in 1..bytes.len() {
                let mut told = read(&[&bytes[..split], &bytes[split..]]);
                told.retain(|input| matches!(input, Input::Background(_)));
                assert_eq!(told, expected, "{} {split}", bytes.escape_ascii());
            }
        }
    }

    #[test]
    fn keys_are_read_however_their_bytes_are_split() {
        let cases: [(&[u8], Vec<Input>); 14] = [
            (
                "aé∂ ".as_bytes(),
                ['a', 'é', '∂', ' '].map(|c| key(Key::Char(c))).to_vec(),
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
            (b"\x15\x17", vec![key(Key::Ctrl('u')), key(Key::Ctrl('w'))]),
            (b"\x1b", vec![named(Named::Esc)]),
            (b"\x1b\x1b", vec![named(Named::Esc), named(Named::Esc)]),
            (b"\x1b\r", vec![named(Named::Esc), named(Named::Enter)]),
            (
                b"\x1b[0n\x1b[?1;2c\x1b[5;7Rz",
                vec![Input::Ready, key(Key::Char('z'))],
            ),
            (b"\x1bz", vec![key(Key::Char('z'))]),
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
        let expected = [Input::Paste("q: set  xy".into()), key(Key::Char('q'))];
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
        for begun in [b"\x1b]0;title".as_slice(), b"\x1bPx", b"\x1b[12"] {
            let (mut reader, mut inputs) = (Reader::default(), Vec::new());
            reader.take(begun, &mut inputs);
            assert!(reader.patience().is_some(), "{begun:?}");
            reader.rest(&mut inputs);
            reader.take(b"q", &mut inputs);
            assert_eq!(inputs, [key(Key::Char('q'))], "{begun:?}");
        }
    }
}
