//! A working directory with the program in it, and the files that the program writes there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// A separate working directory, and the program in it.
pub struct TestDir(TempDir);

/// What the program said when it had ended.
pub struct Said {
    /// The exit code.
    pub code: i32,
    /// What came on stdout.
    pub out: String,
    /// What came on stderr.
    pub err: String,
}

impl From<Output> for Said {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code().expect("an exit code"),
            out: String::from_utf8(output.stdout).expect("text"),
            err: String::from_utf8(output.stderr).expect("text"),
        }
    }
}

impl Said {
    /// Fails unless the program ended with `code` and a word on stderr.
    #[track_caller]
    pub fn ends(&self, code: i32, word: &str) {
        let is_so = self.code == code && self.err.contains(word);
        assert!(is_so, "{}, {:?} for {code}, {word:?}", self.code, self.err);
    }

    /// [`ends`](Self::ends) with one line on stderr.
    #[track_caller]
    pub fn fails(&self, code: i32, word: &str) {
        self.ends(code, word);
        assert_eq!(self.err.lines().count(), 1, "{}", self.err);
    }
}

/// Fails unless `text` has `part`.
#[track_caller]
pub fn has(text: &str, part: &str) {
    assert!(text.contains(part), "no {part:?} in {text}");
}

/// Fails if `text` has `part`.
#[track_caller]
pub fn lacks(text: &str, part: &str) {
    assert!(!text.contains(part), "{part:?} in {text}");
}

/// A table of cases, `input => expected` each.
pub fn cases<const N: usize>(table: [&str; N]) -> [(&str, &str); N] {
    table.map(|row| row.split_once(" => ").expect(row))
}

impl Default for TestDir {
    fn default() -> Self {
        Self(tempfile::tempdir().expect("a directory"))
    }
}

impl TestDir {
    /// A new one.
    pub fn new() -> Self {
        Self::default()
    }

    /// The program with these arguments, ready to start.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_mdr-tui"));
        command
            .args(arguments)
            .current_dir(self.0.path())
            .env("LC_ALL", "C.UTF-8")
            // Nobody's preferences.
            .env("XDG_CONFIG_HOME", self.0.path())
            .stdin(Stdio::null());
        command
    }

    /// Runs the program to its end.
    pub fn say(&self, arguments: &[&str]) -> Said {
        let output = self.command(arguments).output();
        output.expect("the program starts").into()
    }

    /// [`say`](Self::say) with the words of a line, without quoting.
    pub fn line(&self, line: &str) -> Said {
        self.say(&line.split_whitespace().collect::<Vec<_>>())
    }

    /// [`line`](Self::line) in an environment.
    pub fn line_with(&self, line: &str, environment: &[(&str, &str)]) -> Said {
        let mut command = self.command(&line.split_whitespace().collect::<Vec<_>>());
        let output = command.envs(environment.iter().copied()).output();
        output.expect("the program starts").into()
    }

    /// Runs a line of bash in which `$BIN` is the program.
    pub fn shell(&self, line: &str) -> Said {
        let mut command = Command::new("bash");
        command.args(["-c", line]).current_dir(self.0.path());
        command.env("BIN", env!("CARGO_BIN_EXE_mdr-tui"));
        command.env("XDG_CONFIG_HOME", self.0.path());
        command.env("XDG_STATE_HOME", self.path("state"));
        command.output().expect("a shell").into()
    }

    /// Runs a line without quoting, which must succeed and tell nothing on stderr; returns stdout.
    pub fn done(&self, line: &str) -> String {
        let said = self.line(line);
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{line}");
        said.out
    }

    /// Runs the program, which must refuse: code 2, its own lines without control characters that hold
    /// `expected`, nothing else said and nothing written. Returns what it said.
    #[track_caller]
    pub fn refuse(&self, arguments: &[&str], expected: &str) -> String {
        let before = self.inventory();
        let Said { code, out, err } = self.say(arguments);
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}: {err}");
        let lines = err.strip_suffix('\n').expect("whole lines");
        assert!((1..=20).contains(&lines.lines().count()), "{err}");
        for line in lines.lines() {
            assert!(line.starts_with("mdr-tui: ") && line.len() < 1000, "{line}");
            assert!(!line.chars().any(char::is_control), "{line:?}");
        }
        assert!(lines.contains(expected), "{lines:?} without {expected:?}");
        assert!(self.inventory() == before, "{arguments:?} wrote something");
        err
    }

    /// [`refuse`](Self::refuse) with the words of a line, without quoting, in one line.
    #[track_caller]
    pub fn refuse_line(&self, line: &str, expected: &str) {
        let said = self.refuse(&line.split_whitespace().collect::<Vec<_>>(), expected);
        assert_eq!(said.lines().count(), 1, "{line}: {said}");
    }

    /// The screen of `size` after `keys`: nothing on stderr, every line within the size.
    #[track_caller]
    pub fn screen(&self, arguments: &[&str], keys: &str, size: (usize, usize)) -> String {
        self.screen_in("C.UTF-8", arguments, keys, size)
    }

    /// [`screen`](Self::screen) in another locale.
    #[track_caller]
    pub fn screen_in(
        &self,
        locale: &str,
        arguments: &[&str],
        keys: &str,
        size: (usize, usize),
    ) -> String {
        let print = format!("{}x{}", size.0, size.1);
        let mut command = self.command(arguments);
        command.args(["--keys", keys, "--print", &print]);
        command.env("LC_ALL", locale);
        let said = Said::from(command.output().expect("the program starts"));
        let what = format!("{arguments:?} {keys}");
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{what}");
        fits(said.out, size, &what)
    }

    /// Starts the program with the words of a line, and with an environment besides.
    pub fn start(&self, line: &str, environment: &[(&str, &str)]) -> Child {
        let mut command = self.command(&line.split_whitespace().collect::<Vec<_>>());
        command.envs(environment.iter().copied());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().expect("the program starts")
    }

    /// Waits until a program has made the file `name`.
    #[track_caller]
    pub fn wait_for(&self, child: &mut Child, name: &str) {
        let start = Instant::now();
        while !self.path(name).exists() {
            assert!(start.elapsed() < Duration::from_secs(300), "no {name}");
            assert!(matches!(child.try_wait(), Ok(None)), "an early end");
            thread::sleep(Duration::from_millis(1));
        }
    }

    /// Fails unless two directories hold the same files with the same bytes.
    #[track_caller]
    pub fn alike(&self, one: &str, other: &str) {
        assert_eq!(names(&self.path(one)), names(&self.path(other)), "{other}");
        for name in names(&self.path(one)) {
            let read = |directory| self.read(&format!("{directory}/{name}"));
            assert!(read(one) == read(other), "{other}: {name} differs");
        }
    }

    /// Runs the scenario that a run has written again: both tables are bit-identical.
    #[track_caller]
    pub fn replays(&self, first: &str, again: &str, options: &str) {
        self.done(&format!(
            "run {first}/scenario.toml --out {again} --quiet {options}"
        ));
        for name in ["state.csv", "history.csv"] {
            let [kept, again] = [first, again].map(|out| self.read(&format!("{out}/{name}")));
            assert!(kept == again, "{first}/{name}: another run");
        }
    }

    /// Where `name` is.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Makes a file.
    pub fn write(&self, name: &str, text: &[u8]) {
        fs::write(self.path(name), text).expect("a file");
    }

    /// Reads a table.
    pub fn table(&self, name: &str) -> Table {
        Table::parse(&self.read(name))
    }

    /// Reads a file.
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect(name)
    }

    /// All there is, with its contents.
    pub fn inventory(&self) -> Vec<(PathBuf, Vec<u8>)> {
        let mut found = Vec::new();
        let mut waiting = vec![self.0.path().to_owned()];
        while let Some(directory) = waiting.pop() {
            for entry in fs::read_dir(directory).expect("a directory") {
                let path = entry.expect("an entry").path();
                if path.is_dir() {
                    found.push((path.clone(), Vec::new()));
                    waiting.push(path);
                } else {
                    // A link may lead nowhere.
                    let contents = fs::read(&path).unwrap_or_default();
                    found.push((path, contents));
                }
            }
        }
        found.sort();
        found
    }
}

/// The screen if it has its size and does nothing to a terminal.
#[track_caller]
pub fn fits(screen: String, (columns, rows): (usize, usize), what: &str) -> String {
    assert_eq!(screen.lines().count(), rows, "{what}");
    for line in screen.lines() {
        assert!(line.chars().count() <= columns, "{what}: {line}");
        assert!(!line.chars().any(char::is_control), "{line:?}");
    }
    screen
}

/// Sends a signal by its name.
pub fn signal(child: &Child, name: &str) {
    let kill = format!("kill -{name} {}", child.id());
    let sent = Command::new("sh").args(["-c", &kill]).status();
    assert!(sent.expect("a shell").success());
}

/// Kills a program that does not end by itself.
#[track_caller]
pub fn kill(mut child: Child) {
    let _ = child.kill();
    let status = child.wait().expect("an end");
    assert_eq!(status.code(), None, "it ended by itself");
}

/// Waits until a program has ended that says no more than a pipe holds; fails if it does not end.
pub fn end(mut child: Child) -> Said {
    let start = Instant::now();
    while let Ok(None) = child.try_wait() {
        if start.elapsed() > Duration::from_secs(300) {
            let _ = child.kill();
            let said = child.wait_with_output();
            panic!("it does not end; so far it said {said:?}");
        }
        thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().expect("an end").into()
}

/// Names in the directory, sorted. The file that tells when and where a run was made is no result.
pub fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(directory)
        .expect("a directory")
        .map(|entry| entry.expect("an entry").file_name())
        .map(|name| name.to_string_lossy().into_owned())
        .filter(|name| name != "provenance.toml")
        .collect();
    names.sort();
    names
}

/// A CSV file of the contract: header lines, columns, rows.
pub struct Table {
    /// The `# key: value` lines.
    pub header: Vec<(String, String)>,
    /// The names of the columns.
    pub columns: Vec<String>,
    /// The fields.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// Reads a file, which must be well-formed.
    pub fn parse(text: &str) -> Self {
        assert!(text.ends_with('\n') && !text.contains('\r'));
        let header = text
            .lines()
            .take_while(|line| line.starts_with('#'))
            .map(|line| {
                let (key, value) = line
                    .strip_prefix("# ")
                    .and_then(|line| line.split_once(": "))
                    .expect("a line `# key: value`");
                (key.to_owned(), value.to_owned())
            })
            .collect::<Vec<_>>();
        let fields = |line: &str| {
            let mut reader = csv::ReaderBuilder::new()
                .has_headers(false)
                .from_reader(line.as_bytes());
            let record = reader.records().next().expect("a line").expect("fields");
            record.iter().map(str::to_owned).collect::<Vec<_>>()
        };
        let mut lines = text.lines().skip(header.len());
        let columns = fields(lines.next().expect("a line of columns"));
        let rows: Vec<Vec<String>> = lines.map(fields).collect();
        assert!(rows.iter().all(|row| row.len() == columns.len()));
        Self {
            header,
            columns,
            rows,
        }
    }

    /// The value of a header line.
    pub fn header(&self, key: &str) -> &str {
        let found = self.header.iter().find(|(name, _)| name == key);
        &found.expect(key).1
    }

    /// A column's numbers; NaN where a field is empty.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.columns.iter().position(|column| column == name);
        let at = at.expect(name);
        let number = |field: &str| match field {
            "" => f64::NAN,
            field => field.parse().expect("a number"),
        };
        self.rows.iter().map(|row| number(&row[at])).collect()
    }
}

/// What tells equal numbers from almost equal ones.
pub fn bits(values: &[f64]) -> Vec<u64> {
    // The file does not tell -0 from 0.
    values.iter().map(|value| (value + 0.0).to_bits()).collect()
}
