//! A recording of a session plays back to the screens that were seen.

use std::num::NonZeroU16;

use crate::test_dir::TestDir;

/// What a terminal shows that is sent all output of a recording.
fn played(cast: &str) -> vt100::Parser {
    let mut lines = cast.lines();
    let header: serde_json::Value =
        serde_json::from_str(lines.next().expect("a header")).expect("JSON");
    assert_eq!(header["version"], 2);
    let side = |name: &str| {
        let cells = header[name].as_u64().expect("a size");
        NonZeroU16::new(cells as u16).expect("cells")
    };
    let mut terminal = vt100::Parser::new(side("height"), side("width"), 0);
    let mut before = 0.0;
    for line in lines {
        let event: (f64, String, String) = serde_json::from_str(line).expect("an event");
        assert!(event.0 >= before && event.1 == "o", "{line}");
        before = event.0;
        terminal.process(event.2.as_bytes());
    }
    terminal
}

#[test]
fn a_recording_ends_on_the_last_screen() {
    let dir = TestDir::new();
    let line = "li2019-fig3 --keys ,,v.z --print 100x30 --record x.cast --marker ascii";
    let printed = dir.done(line);
    let cast = dir.read("x.cast");
    let terminal = played(&cast);
    let shown = terminal.screen().contents();
    let lines = |text: &str| -> Vec<String> {
        let lines = text.lines().map(|line| line.trim_end().to_owned());
        lines.collect()
    };
    let (mut shown, mut printed) = (lines(&shown), lines(&printed));
    for text in [&mut shown, &mut printed] {
        while text.last().is_some_and(String::is_empty) {
            text.pop();
        }
    }
    assert_eq!(shown, printed);
    // A frame a key, and the first one.
    assert_eq!(cast.lines().count(), 1 + 6);
}

#[test]
fn a_recording_is_never_written_over_another_file() {
    let dir = TestDir::new();
    dir.write("x.cast", b"mine");
    for (file, expected) in [
        ("x.cast", "already exists"),
        ("no/x.cast", "--record no/x.cast"),
    ] {
        let said = dir.say(&["hertz", "--keys", ",", "--print", "80x24", "--record", file]);
        assert_eq!(
            (said.code, said.err.lines().count()),
            (2, 1),
            "{}",
            said.err
        );
        assert!(said.err.contains(expected), "{}", said.err);
    }
    assert_eq!(dir.read("x.cast"), "mine");
}
