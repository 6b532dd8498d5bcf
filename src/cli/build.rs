//! Passes the version to the program, with the commit if a release is built from a checkout or from a package of one.

use std::fs;
use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=src/cli/build.rs");
    let version = std::env::var("CARGO_PKG_VERSION").unwrap_or_default();
    // Test builds need not be redone after every commit.
    let is_release = std::env::var("PROFILE").is_ok_and(|profile| profile == "release");
    let commit = is_release
        .then(|| packaged().or_else(checked_out))
        .flatten();
    let version = commit.map_or_else(|| version.clone(), |commit| format!("{version} ({commit})"));
    println!("cargo::rustc-env=MDR_TUI_VERSION={version}");
    if !is_release {
        // `cargo test` passes it on to the tests, many of which wait for a terminal most of their time.
        let threads = 2 * std::thread::available_parallelism().map_or(1, usize::from);
        println!("cargo::rustc-env=RUST_TEST_THREADS={threads}");
    }
}

/// Returns the commit recorded by cargo in a package.
fn packaged() -> Option<String> {
    const INFO: &str = ".cargo_vcs_info.json";
    let info = fs::read_to_string(INFO).ok()?;
    println!("cargo::rerun-if-changed={INFO}");
    let hash = info.split("\"sha1\": \"").nth(1)?;
    hash.get(..10).map(str::to_owned)
}

/// Returns the commit of this checkout, but not of another one that the sources happen to lie in.
fn checked_out() -> Option<String> {
    if !Path::new(".git").exists() {
        return None;
    }
    let log = git(&["rev-parse", "--git-path", "logs/HEAD"])?;
    println!("cargo::rerun-if-changed={log}");
    git(&[
        "describe",
        "--always",
        "--dirty",
        "--abbrev=10",
        "--exclude=*",
    ])
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    (output.status.success() && !text.trim().is_empty()).then(|| text.trim().to_owned())
}
