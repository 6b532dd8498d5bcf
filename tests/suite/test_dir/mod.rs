//! A working directory with the program in it, and the files that the program writes there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// A working directory of its own, and the program in it.
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
}

/// Fails unless `text` has `part`.
#[track_caller]
pub fn has(text: &str, part: &str) {
    assert!(text.contains(part), "no {part:?} in {text}");
}

impl TestDir {
    /// A new one.
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a directory"))
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

    /// Runs a line without quoting, which must succeed and tell nothing on stderr; returns stdout.
    pub fn done(&self, line: &str) -> String {
        let said = self.line(line);
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{line}");
        said.out
    }

    /// Where `name` is.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Makes a file.
    pub fn write(&self, name: &str, text: &[u8]) {
        fs::write(self.path(name), text).expect("a file");
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
                    let contents = fs::read(&path).expect("a file");
                    found.push((path, contents));
                }
            }
        }
        found.sort();
        found
    }
}

/// Waits until a program has ended that says no more than a pipe holds; fails if it does not end.
pub fn end(mut child: Child) -> Said {
    let start = Instant::now();
    while let Ok(None) = child.try_wait() {
        if start.elapsed() > Duration::from_secs(60) {
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
