//! The text of a measured file: what instruments write is UTF-8, UTF-16 or Latin-1, with lines that end in any way.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

/// How many bytes are looked at for UTF-16 without a mark.
const HEAD: usize = 4096;

/// Decodes a file, and returns its text and the name of its encoding; `None` if it is no text.
pub(super) fn decode(bytes: &[u8]) -> Option<(String, &'static str)> {
    let encoding = encoding_of(bytes);
    let (text, ..) = encoding.decode(bytes);
    let is_control = |c: char| {
        c.is_control() && !"\t\r\n\u{c}\u{1a}\u{1b}\u{7f}".contains(c) && (c as u32) < 0x80
    };
    if text.contains(is_control) {
        return None;
    }
    // Old instruments end lines with a carriage return alone.
    let text = if text.contains('\n') {
        text.into_owned()
    } else {
        text.replace('\r', "\n")
    };
    Some((text, encoding.name()))
}

/// By the mark at the beginning, else by what the bytes can be.
fn encoding_of(bytes: &[u8]) -> &'static Encoding {
    if let Some((encoding, _)) = Encoding::for_bom(bytes) {
        return encoding;
    }
    let head = &bytes[..bytes.len().min(HEAD)];
    let zeros = |parity: usize| {
        let half = head.iter().skip(parity).step_by(2);
        3 * half.filter(|byte| **byte == 0).count() > head.len() / 2
    };
    match std::str::from_utf8(bytes) {
        _ if zeros(1) && !zeros(0) => UTF_16LE,
        _ if zeros(0) && !zeros(1) => UTF_16BE,
        Ok(_) => UTF_8,
        Err(_) => WINDOWS_1252,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_instruments_write_is_decoded() {
        let text = "r [µm];w\r\n1;2\r\n";
        let utf_16 = |bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            text.encode_utf16().flat_map(bytes).collect()
        };
        let latin_1: Vec<u8> = text.chars().map(|c| c as u8).collect();
        let marked = [b"\xff\xfe".to_vec(), utf_16(u16::to_le_bytes)].concat();
        for (bytes, name) in [
            (text.as_bytes().to_vec(), "UTF-8"),
            (format!("\u{feff}{text}").into_bytes(), "UTF-8"),
            (latin_1, "windows-1252"),
            (marked, "UTF-16LE"),
            (utf_16(u16::to_le_bytes), "UTF-16LE"),
            (utf_16(u16::to_be_bytes), "UTF-16BE"),
        ] {
            assert_eq!(decode(&bytes), Some((text.to_owned(), name)));
        }
        assert_eq!(decode(b"r\rx\r").expect("a text").0, "r\nx\n");
        assert_eq!(decode(b"\x7fELF\x02\x01\x01\x00\x00"), None);
    }
}
