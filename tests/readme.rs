//! The README shows what the program does: its screen and its keys are the program's own.
//!
//! `UPDATE_README=1 cargo test --test readme` writes them anew, to be read before they are kept.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use mdr_tui::tui::command::BINDINGS;
use mdr_tui::tui::manual;

fn readme() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("README.md")
}

/// What stands in the README from behind `start` to before `end`, which must be `wanted`.
fn hold(start: &str, end: &str, wanted: &str) {
    let text = fs::read_to_string(readme()).expect("the README");
    let (before, rest) = text
        .split_once(start)
        .unwrap_or_else(|| panic!("no {start:?}"));
    let (found, after) = rest.split_once(end).unwrap_or_else(|| panic!("no {end:?}"));
    if found == wanted {
        return;
    }
    if std::env::var_os("UPDATE_README").is_some() {
        let updated = format!("{before}{start}{wanted}{end}{after}");
        return fs::write(readme(), updated).expect("the README");
    }
    panic!(
        "README.md has\n{found}\nbut it is\n{wanted}\nUPDATE_README=1 cargo test --test readme writes it"
    );
}

fn said(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_mdr-tui"))
        .args(arguments)
        .env("LC_ALL", "C.UTF-8")
        .output()
        .expect("the program starts");
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn its_screens_and_its_keys_are_those_of_the_program() {
    let cycles = ",".repeat(42);
    let screen = said(&["--keys", &cycles, "--print", "80x24"]);
    hold("## The screen\n\n```text\n", "```\n", &screen);
    let keys = format!("{cycles}vz");
    let section = said(&["strong-wear", "--keys", &keys, "--print", "80x18"]);
    let start = "The bodies in section (`v`, then `z`):\n\n```text\n";
    hold(start, "```\n", &section);
    hold(
        "Keys, as `?` shows them:\n\n",
        "\n\n",
        manual::markdown().trim_end(),
    );
}

#[test]
fn the_manual_page_has_every_key() {
    let page = said(&["man"]);
    assert_eq!(page.matches(".SH KEYS").count(), 1);
    for binding in BINDINGS {
        let help = binding.help.replace('-', "\\-");
        assert!(page.contains(&help), "{help}");
    }
}

#[test]
fn the_footer_names_commands_of_the_table() {
    let screen = said(&["--keys", ",", "--print", "200x24"]);
    let footer = screen.lines().last().expect("a footer");
    for binding in BINDINGS.iter().filter(|binding| binding.in_footer) {
        let shown = format!(" {} {}", binding.keys[0], binding.name);
        assert!(footer.contains(&shown), "{shown} is not in {footer}");
    }
}
