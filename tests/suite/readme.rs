//! The README is short and names what the program has; the manual page and the footer hold the
//! table of commands. Its commands and scenarios are tried together with the guide's.

use std::fs;
use std::path::Path;

use mdr_tui::scenario::preset;
use mdr_tui::tui::command::COMMANDS;
use mdr_tui::tui::footer;

use crate::test_dir::{TestDir, has};

#[test]
fn it_is_short_and_names_what_there_is() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join("README.md")).expect("the README");
    assert!(text.lines().count() <= 200);
    for preset in preset::ALL {
        has(&text, &format!("`{}`", preset.name));
    }
    let (_, picture) = text.split_once("](tests/pictures/").expect("a picture");
    let (file, _) = picture.split_once(')').expect("its file");
    assert!(root.join("tests/pictures").join(file).exists(), "{file}");
}

#[test]
fn the_manual_page_has_every_key() {
    let page = TestDir::new().done("man");
    assert_eq!(page.matches(".SH KEYS").count(), 1);
    for row in COMMANDS.iter().filter(|row| !row.keys.is_empty()) {
        let help = row.help.replace('-', "\\-");
        has(&page, &help);
    }
}

#[test]
fn the_footer_names_commands_of_the_table() {
    let screen = TestDir::new().done("--keys , --print 200x24");
    let footer = screen.lines().last().expect("a footer");
    for row in footer::USUAL.iter().map(|(command, _)| command.row()) {
        let shown = format!(" {} {}", row.keys[0], row.name);
        has(footer, &shown);
    }
}
