//! Where escape sequences go: they are written, or only counted to find the shortest.

/// Takes text and numbers.
pub(super) trait Sink {
    /// Takes a text.
    fn text(&mut self, text: &str);

    /// Takes a number in decimal digits.
    fn number(&mut self, number: u16);
}

impl Sink for String {
    fn text(&mut self, text: &str) {
        self.push_str(text);
    }

    fn number(&mut self, number: u16) {
        self.push_str(&number.to_string());
    }
}

/// Counts bytes.
#[derive(Debug, Default)]
pub(super) struct Count(pub usize);

impl Sink for Count {
    fn text(&mut self, text: &str) {
        self.0 += text.len();
    }

    fn number(&mut self, number: u16) {
        self.0 += number.checked_ilog10().unwrap_or(0) as usize + 1;
    }
}

/// The bytes of what `write` writes.
pub(super) fn bytes_of(write: impl FnOnce(&mut Count)) -> usize {
    let mut count = Count::default();
    write(&mut count);
    count.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_counted_is_what_is_written() {
        for number in [0, 1, 9, 10, 99, 100, 999, 65_535] {
            let mut text = String::from("é");
            text.number(number);
            let count = bytes_of(|sink| {
                sink.text("é");
                sink.number(number);
            });
            assert_eq!(count, text.len(), "{number}");
        }
    }
}
