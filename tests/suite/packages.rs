//! What is handed to others: a Debian package, and one file for any host. Held where their tools are there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::test_dir::{Said, TestDir, has, names};

fn checkout(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn has_tool(name: &str, arguments: &[&str]) -> bool {
    let output = Command::new(name).args(arguments).output();
    output.is_ok_and(|output| output.status.success())
}

/// What a program says, which must end well; `None` where it is not there.
fn said(command: &mut Command) -> Option<String> {
    let said = Said::from(command.output().ok()?);
    assert_eq!(said.code, 0, "{command:?}: {}{}", said.out, said.err);
    Some(said.out)
}

/// As the guide makes it, but of this build.
#[test]
fn a_debian_package_is_installed_and_goes_again() {
    if !has_tool("cargo-deb", &["--version"]) || !has_tool("dpkg", &["--version"]) {
        eprintln!("not held here: there is no cargo-deb, or no dpkg");
        return;
    }
    let dir = TestDir::new();
    let files = checkout("target/package-files");
    dir.done(&format!("man --out {}/man", files.display()));
    for (shell, name) in [
        ("bash", "mdr-tui.bash"),
        ("zsh", "_mdr-tui"),
        ("fish", "mdr-tui.fish"),
    ] {
        let script = dir.done(&format!("completions {shell}"));
        fs::write(files.join(name), script).expect("a file");
    }
    fs::create_dir_all(dir.path("target/release")).expect("a directory");
    let program = dir.path("target/release/mdr-tui");
    fs::copy(env!("CARGO_BIN_EXE_mdr-tui"), program).expect("the program");
    let package = dir.path("mdr-tui.deb");
    let mut make = Command::new("cargo");
    make.args(["deb", "--no-build", "--no-strip", "--fast", "--output"]);
    make.arg(&package).current_dir(checkout(""));
    said(make.env("CARGO_TARGET_DIR", dir.path("target"))).expect("cargo");
    let listed = said(Command::new("dpkg-deb").arg("-c").arg(&package)).expect("dpkg-deb");
    for name in [
        "/usr/bin/mdr-tui\n",
        "/usr/share/man/man1/mdr-tui-run.1.gz\n",
        "/usr/share/bash-completion/completions/mdr-tui\n",
        "/usr/share/doc/mdr-tui/copyright\n",
    ] {
        has(&listed, name);
    }
    for made in ["root", "admin", "admin/info", "admin/updates"] {
        fs::create_dir(dir.path(made)).expect("a directory");
    }
    dir.write("admin/status", b"");
    let dpkg = |what: &str, of: &Path| {
        let mut dpkg = Command::new("dpkg");
        dpkg.args(["--force-not-root", "--force-depends"]);
        dpkg.arg(format!("--instdir={}", dir.path("root").display()));
        dpkg.arg(format!("--admindir={}", dir.path("admin").display()));
        said(dpkg.arg("--log=/dev/null").arg(what).arg(of)).expect("dpkg");
    };
    dpkg("--install", &package);
    let installed = dir.path("root/usr/bin/mdr-tui");
    let version = said(Command::new(installed).arg("--version")).expect("the program");
    assert_eq!(version, dir.done("--version"));
    dpkg("--remove", Path::new("mdr-tui"));
    assert!(names(&dir.path("root")).is_empty());
}

/// The guide says how it is built.
#[test]
fn a_static_binary_runs_where_nothing_is_installed() {
    let built = checkout("target/x86_64-unknown-linux-gnu/release/mdr-tui");
    let dir = TestDir::new();
    let may_enter = has_tool("unshare", &["--map-root-user", "true"]);
    if !may_enter || fs::copy(built, dir.path("mdr-tui")).is_err() {
        eprintln!("not held here: there is no static build, or no empty place to run it in");
        return;
    }
    let empty = |line: &str| {
        let mut command = Command::new("unshare");
        command
            .args(["--map-root-user", "chroot"])
            .arg(dir.path(""));
        said(command.args(line.split(' '))).expect("unshare")
    };
    empty("/mdr-tui run li2019-fig3 --cycles 2 --out /static --quiet");
    // One that was built of another commit has its own digits.
    if empty("/mdr-tui --version") != dir.done("--version") {
        return;
    }
    dir.done("run li2019-fig3 --cycles 2 --out here --quiet");
    for name in ["state.csv", "history.csv", "loop.csv"] {
        let read = |directory: &str| dir.read(&format!("{directory}/{name}"));
        assert!(read("static") == read("here"), "{name} differs");
    }
}
