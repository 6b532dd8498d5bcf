//! Random keys, pastes and resizes on every preset and size: nothing panics, nothing hangs.
//!
//! The same sessions each time. `MDR_TUI_FUZZ_SECONDS` lets it go on for so long, with longer sessions and from a seed of
//! the clock, and `MDR_TUI_FUZZ_SEED` sets where it begins: a session that fails tells its own seed, and is the first one
//! that this seed begins with.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use mdr_tui::scenario::preset;

use crate::hostile::fuzzed::strokes;
use crate::random::Random;
use crate::test_dir::{TestDir, end};

/// How many sessions there are, unless a time is given.
const SESSIONS: u64 = 40;

/// What writes files, and what a session does most of all.
const MORE: [&str; 8] = ["s", "S", ".", ".", "z", "<Enter>", "<Esc>", "<Esc>"];

fn script(random: &mut Random, keys: usize) -> String {
    let all: Vec<&str> = strokes::KEYS.split_whitespace().chain(MORE).collect();
    let mut script = String::new();
    for _ in 0..keys {
        match random.below(60) {
            0 => {
                let (columns, rows) = (1 + random.below(150), 1 + random.below(50));
                script.push_str(&format!("<resize:{columns}x{rows}>"));
            }
            1..=2 => script.push_str(random.pick(strokes::RARE)),
            _ => script.push_str(random.pick(&all)),
        }
    }
    script
}

/// One session; how many keys it has pressed.
fn session(dir: &TestDir, seed: u64, keys: usize) -> usize {
    let mut random = Random::new(seed);
    let preset = preset::ALL[random.below(preset::ALL.len())].name;
    let size = match random.below(4) {
        0 => format!("{}x{}", 1 + random.below(200), 1 + random.below(70)),
        _ => random
            .pick(&["80x24", "80x24", "120x40", "40x12", "20x8", "8x3", "1x1"])
            .to_owned(),
    };
    let points = format!("numerics.points={}", 4 + random.below(40));
    let steps = format!("numerics.steps_per_cycle={}", 1 + random.below(30));
    let script = script(&mut random, keys);
    let mut command = dir.command(&[preset, "--print", &size, "--keys", &script]);
    command.args(["--set", &points, "--set", &steps]);
    let (out, err) = (
        dir.path(&format!("{seed}.out")),
        dir.path(&format!("{seed}.err")),
    );
    let file = |path| std::fs::File::create(path).expect("a file");
    command.stdout(file(&out)).stderr(file(&err));
    let child = command.spawn().expect("the program starts");
    let told = format!(
        "MDR_TUI_FUZZ_SEED={seed}\n{preset} --print {size} --set {points} --set {steps} --keys '{script}'"
    );
    let ended = std::panic::catch_unwind(|| end(child));
    let code = ended.unwrap_or_else(|_| panic!("no end: {told}")).code;
    let err = std::fs::read_to_string(err).expect("text");
    assert!(
        (code, err.as_str()) == (0, "") || is_refusal(code, &err),
        "code {code}: {err}\n{told}"
    );
    keys
}

/// Some presets cannot start on any number of cells and steps: that is said in one line.
fn is_refusal(code: i32, line: &str) -> bool {
    (code == 1 || code == 2) && line.lines().count() == 1 && !line.contains("defect")
}

#[test]
fn random_keys_break_nothing() {
    let number = |name: &str| {
        std::env::var(name)
            .ok()
            .map(|text| text.parse::<u64>().expect("a number"))
    };
    let asked = number("MDR_TUI_FUZZ_SECONDS");
    let keys_each = if asked.is_some() { 500 } else { 150 };
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let now = now.map_or(1, |now| now.as_secs()) * 1_000_000;
    let first = number("MDR_TUI_FUZZ_SEED").unwrap_or(asked.map_or(1, |_| now));
    eprintln!("MDR_TUI_FUZZ_SEED={first}");
    let next = AtomicU64::new(first);
    let [keys, sessions] = [const { AtomicU64::new(0) }; 2];
    let start = Instant::now();
    let goes_on = |seed: u64| match asked {
        Some(seconds) => start.elapsed() < Duration::from_secs(seconds),
        None => seed < first + SESSIONS,
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..2)
            .map(|_| {
                scope.spawn(|| {
                    loop {
                        let seed = next.fetch_add(1, Ordering::SeqCst);
                        if !goes_on(seed) {
                            break;
                        }
                        let pressed = session(&TestDir::new(), seed, keys_each);
                        keys.fetch_add(pressed as u64, Ordering::SeqCst);
                        sessions.fetch_add(1, Ordering::SeqCst);
                    }
                })
            })
            .collect();
        for thread in threads {
            if let Err(panic) = thread.join() {
                std::panic::resume_unwind(panic);
            }
        }
    });
    let [keys, sessions] = [keys, sessions].map(AtomicU64::into_inner);
    eprintln!("{keys} keys in {sessions} sessions, seeds from {first} on");
    assert!(sessions > 0 && (asked.is_some() || sessions == SESSIONS));
}
