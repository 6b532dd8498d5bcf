//! The clipboard of the terminal (OSC 52), which works over SSH too.

/// The largest text to be copied, in bytes: some terminals drop longer ones.
const LARGEST: usize = 70_000;

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Returns the sequence that puts a text on the clipboard; `None` if it is too long.
pub fn request(text: &str) -> Option<String> {
    (text.len() <= LARGEST).then(|| format!("\x1b]52;c;{}\x1b\\", base64(text.as_bytes())))
}

/// Encodes in base 64 as in RFC 4648, with padding.
fn base64(bytes: &[u8]) -> String {
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let all = (0..3).fold(0, |all, k| {
            all << 8 | u32::from(*three.get(k).unwrap_or(&0))
        });
        for k in 0..4 {
            let digit = DIGITS[(all >> (18 - 6 * k)) as usize & 63];
            text.push(if k <= three.len() {
                char::from(digit)
            } else {
                '='
            });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_written_as_the_terminal_reads_them() {
        for (text, encoded) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("µm", "wrVt"),
        ] {
            let expected = format!("\x1b]52;c;{encoded}\x1b\\");
            assert_eq!(request(text), Some(expected));
        }
        assert_eq!(request(&"x".repeat(80_000)), None);
    }
}
