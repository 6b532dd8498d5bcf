//! Flow control over simulated lines: real frames of the explorer, cut into chunks by the program's own code, go over a
//! line of any rate and round trip whose buffers never end.

use std::collections::VecDeque;
use std::sync::OnceLock;

use mdr_tui::tui::ansi_writer::AnsiWriter;
use mdr_tui::tui::flow::{Flow, Request};
use proptest::prelude::*;
use ratatui::buffer::Buffer;

use crate::ansi_writer::Counted;
use crate::random::Random;

/// Bytes of the first chunk, and the fewest of a later one; see `flow.rs`.
const FIRST: f64 = 240.0;
const LEAST: f64 = 96.0;

/// Seconds between frames of the run, and between keys.
const FRAME: f64 = 0.119;
const KEY: f64 = 2.93;

const SIZES: [(u16, u16); 3] = [(80, 24), (120, 40), (300, 80)];

/// Some consecutive frames of a running explorer, by the place of its size.
fn frames(size: usize) -> &'static [Buffer] {
    static FRAMES: [OnceLock<Vec<Buffer>>; 3] = [const { OnceLock::new() }; 3];
    FRAMES[size].get_or_init(|| {
        let mut counted = Counted::new(SIZES[size].0, SIZES[size].1);
        counted.frame(",");
        let frame = |_| {
            counted.running_frame(5);
            counted.screen()
        };
        (0..8).map(frame).collect()
    })
}

/// What the terminal at the other end answers.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Answers {
    All,
    /// Only whether it is ready.
    Status,
    None,
    /// Those of this time come together at its end.
    Withheld([f64; 2]),
}

/// Times in seconds, the rate in bytes per second.
#[derive(Debug, Clone, Copy)]
struct Line {
    rate: f64,
    round_trip: f64,
    /// The most that a chunk, and again its answer, is late.
    jitter: f64,
    size: usize,
    answers: Answers,
    /// From when on rate and round trip are others.
    then: Option<(f64, [f64; 2])>,
}

const LINE: Line = Line {
    rate: f64::INFINITY,
    round_trip: 0.0,
    jitter: 0.0,
    size: 0,
    answers: Answers::All,
    then: None,
};

/// A line with what is on it.
struct Wire {
    line: Line,
    random: Random,
    busy: f64,
    seen: f64,
    answers: VecDeque<(f64, Request)>,
}

impl Wire {
    /// Takes in bytes that end with a request; when they are carried, and when they are seen.
    fn carry(&mut self, now: f64, bytes: usize, request: Request) -> [f64; 2] {
        let Line {
            rate,
            round_trip,
            jitter,
            answers,
            ..
        } = self.line;
        let mut late = || self.random.between(0.0, jitter) + round_trip / 2.0;
        self.busy = self.busy.max(now) + bytes as f64 / rate;
        self.seen = self.seen.max(self.busy + late());
        let mut answered = self.seen + late();
        if let Answers::Withheld([from, to]) = answers
            && (from..to).contains(&answered)
        {
            answered = to;
        }
        if let Some((before, _)) = self.answers.back() {
            answered = answered.max(*before);
        }
        let is_mute = answers == Answers::None;
        if !is_mute && (answers != Answers::Status || request == Request::Status) {
            self.answers.push_back((answered, request));
        }
        [self.busy, self.seen]
    }
}

/// A chunk: when it was sent, its bytes, and when the line had carried it.
type Chunk = [f64; 3];

/// What a session of the explorer did to a line.
#[derive(Debug, Default)]
struct Session {
    chunks: Vec<Chunk>,
    /// When every cell had been seen once.
    complete: Option<f64>,
    /// When keys were pressed, and when their answers were seen.
    keys: Vec<[f64; 2]>,
    /// How long keys waited for what the line had to carry before their answers.
    waits: Vec<f64>,
}

impl Session {
    /// A session of so many seconds; a key is pressed now and then, and answered in the last row.
    fn on(line: Line, seconds: f64) -> Self {
        let (mut flow, mut writer) = (Flow::default(), AnsiWriter::default());
        let mut frames = frames(line.size).to_vec();
        let mut missing: Vec<usize> = (0..frames[0].content.len()).collect();
        let (random, answers) = (Random::new(7), VecDeque::new());
        let mut wire = Wire {
            line,
            random,
            busy: 0.0,
            seen: 0.0,
            answers,
        };
        let mut session = Self::default();
        let ask = |flow: &mut Flow, wire: &mut Wire, now| {
            let asked = flow.measure(now);
            let kinds = [Request::Place, Request::Status];
            let kind = kinds.into_iter().find(|kind| kind.text() == asked);
            wire.carry(now, asked.len(), kind.expect("a request"));
        };
        ask(&mut flow, &mut wire, 0.0);
        let (mut now, mut is_due) = (0.0, true);
        let (mut frame, mut key, mut arrived) = (0, 0, None);
        let arrival = |key, line: &Line| 2.0 + KEY * f64::from(key) + line.round_trip / 2.0;
        while now < seconds {
            if let Some((_, [rate, round_trip])) = wire.line.then.filter(|(then, _)| now >= *then) {
                wire.line = Line {
                    rate,
                    round_trip,
                    then: None,
                    ..wire.line
                };
            }
            if now >= FRAME * (frame + 1) as f64 {
                (frame, is_due) = (frame + 1, true);
            }
            if now >= arrival(key, &wire.line) {
                session
                    .keys
                    .push([2.0 + KEY * f64::from(key), f64::INFINITY]);
                key += 1;
                let sign = char::from_u32(u32::from('a') + key % 26).expect("a letter");
                let feet = frames
                    .iter_mut()
                    .flat_map(|frame| frame.content.iter_mut().rev().take(30));
                feet.for_each(|cell| _ = cell.set_char(sign));
                flow.hurry(now);
                arrived = arrived.or(Some(now));
                is_due = true;
            }
            let come = wire
                .answers
                .iter()
                .take_while(|(then, _)| *then <= now)
                .count();
            for (_, request) in wire.answers.drain(..come) {
                flow.answered(now, request);
            }
            let wanted = &frames[frame % frames.len()];
            if is_due && flow.delay(now) == Some(0.0) {
                let (room, measures) = flow.room(now);
                let (text, is_whole) = writer.chunk(wanted, room);
                let bytes = text.len() + 4;
                if bytes > 4 {
                    if measures {
                        ask(&mut flow, &mut wire, now);
                    }
                    flow.note_sent(now, bytes);
                    flow.written();
                    let begin = wire.busy.max(now);
                    let waited = arrived.take().map(|arrived| begin - arrived);
                    session.waits.extend(waited);
                    let [carried, seen] = wire.carry(now, bytes, Request::Status);
                    session.chunks.push([now, bytes as f64, carried]);
                    missing.retain(|&i| writer.shown.content[i] != wanted.content[i]);
                    session.complete = session.complete.or(missing.is_empty().then_some(seen));
                    let waiting = session
                        .keys
                        .iter_mut()
                        .filter(|[_, seen]| seen.is_infinite());
                    waiting.for_each(|key| key[1] = seen);
                }
                is_due = !is_whole;
            }
            let free = flow.delay(now).filter(|_| is_due).map(|delay| now + delay);
            let answer = wire.answers.front().map(|(then, _)| *then);
            let next = [FRAME * (frame + 1) as f64, arrival(key, &wire.line)];
            let next = next.into_iter().chain(free).chain(answer);
            now = next.fold(seconds, f64::min).max(now) + 1e-6;
        }
        session
    }

    fn sent(&self, from: f64, to: f64) -> impl Iterator<Item = &Chunk> {
        let is_then = move |[sent, ..]: &&Chunk| (from..to).contains(sent);
        self.chunks.iter().filter(is_then)
    }

    /// The longest that a chunk of this time waits for the line and takes of it.
    fn queue(&self, from: f64, to: f64) -> f64 {
        let queues = self.sent(from, to).map(|[sent, _, carried]| carried - sent);
        queues.fold(0.0, f64::max)
    }

    /// The longest that a key pressed in this time takes to be seen.
    fn echo(&self, from: f64, to: f64) -> f64 {
        let keys = self
            .keys
            .iter()
            .filter(|[pressed, _]| (from..to).contains(pressed));
        keys.map(|[pressed, seen]| seen - pressed)
            .fold(0.0, f64::max)
    }

    fn bytes(&self, from: f64, to: f64) -> f64 {
        self.sent(from, to).map(|[_, bytes, _]| bytes).sum()
    }
}

impl Line {
    /// Bytes of the whole screen, and of the first and last row.
    fn costs(&self) -> [f64; 2] {
        let frame = &frames(self.size)[0];
        let mut edges = frame.clone();
        let (width, all) = (usize::from(frame.area.width), frame.content.len());
        edges.content[width..all - width].fill(Default::default());
        [frame, &edges].map(|frame| {
            let (text, _) = AnsiWriter::default().chunk(frame, usize::MAX);
            text.len() as f64
        })
    }

    /// The longest time until every cell was seen.
    fn complete(&self) -> f64 {
        2.2 * self.costs()[0] / self.rate + 3.0 * self.round_trip + 1.5 + 2.0 * self.jitter
    }

    /// The longest time until a key is seen.
    fn echo(&self) -> f64 {
        let queue = f64::max(0.3, LEAST / self.rate) + 0.2 + 2.0 * self.jitter;
        self.round_trip + queue + (3.0 * LEAST + self.costs()[1]) / self.rate
    }

    /// The longest queue in the line, from this time on.
    fn queue(&self) -> [f64; 2] {
        let chunk = (LEAST + self.costs()[1]) / self.rate;
        let queue = f64::max(0.25, LEAST / self.rate) + chunk + 4.0 * self.jitter;
        let begun = (FIRST + self.costs()[1]) / self.rate;
        [queue, 2.0 + 3.0 * self.round_trip + 3.0 * begun]
    }
}

fn lines() -> impl Strategy<Value = Line> {
    let rate =
        prop_oneof![9 => (2.0..6.5).prop_map(|power| 10f64.powf(power)), 1 => Just(f64::INFINITY)];
    let round_trip = prop_oneof![1 => Just(0.0), 3 => 0.0..2.0];
    let jitter = prop::sample::select(vec![0.0, 0.0, 0.01, 0.05]);
    let size = prop_oneof![4 => Just(0usize), 3 => Just(1), 1 => Just(2)];
    let parts = (rate, round_trip, jitter, size);
    parts.prop_map(|(rate, round_trip, jitter, size)| Line {
        rate,
        round_trip,
        jitter,
        size,
        ..LINE
    })
}

/// What simulations with other frames were found to hold, and a tenth more.
const MORE: f64 = 1.1;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn any_line_shows_the_whole_screen_soon_and_keys_at_once(line in lines()) {
        let complete = MORE * line.complete();
        let session = Session::on(line, complete.max(20.0) + 2.0 * MORE * line.echo());
        let end = complete.max(20.0);
        let found = session.complete.unwrap_or(f64::INFINITY);
        prop_assert!(found <= complete, "complete after {found} s, not {complete}");
        let (echo, most) = (session.echo(0.0, end), MORE * line.echo());
        prop_assert!(echo <= most, "a key after {echo} s, not {most}");
        let [most, from] = line.queue();
        let queue = session.queue(from, end);
        prop_assert!(queue <= MORE * most, "{queue} s of queue, not {most}");
    }
}

/// What is queued before a key; at the worst also the chunk that was under way, in which the first and last row come
/// whole.
#[test]
fn a_key_waits_for_a_third_of_a_second_of_queue_at_most() {
    for rate in [300.0, 600.0, 1200.0, 9600.0, f64::INFINITY] {
        for (round_trip, size) in [(0.0, 0), (0.1, 1), (0.3, 0), (1.0, 1)] {
            let line = Line {
                rate,
                round_trip,
                size,
                ..LINE
            };
            let mut waits = Session::on(line, 60.0).waits;
            waits.sort_by(f64::total_cmp);
            let (median, worst) = (waits[waits.len() / 2], waits[waits.len() - 1]);
            let usual = f64::max(round_trip, 0.3);
            assert!(
                median <= usual,
                "{rate} B/s, {round_trip} s: {median} s, not {usual}"
            );
            let most = usual + 2.0 * LEAST / rate;
            assert!(
                worst <= most,
                "{rate} B/s, {round_trip} s: {worst} s, not {most}"
            );
        }
    }
}

#[test]
fn at_a_round_trip_of_300_ms_and_any_rate_the_screen_is_complete_in_a_second() {
    for size in [0, 1, 2] {
        let line = Line {
            round_trip: 0.3,
            size,
            ..LINE
        };
        let complete = Session::on(line, 5.0).complete.expect("a whole screen");
        assert!(complete < 1.5, "{:?}: {complete} s", SIZES[size]);
    }
}

#[test]
fn a_long_round_trip_does_not_empty_the_line() {
    for round_trip in [0.0, 0.3, 1.0, 2.0] {
        let fast = Session::on(
            Line {
                rate: 1e5,
                round_trip,
                ..LINE
            },
            20.0,
        );
        let chunks = fast.sent(10.0, 20.0).count();
        assert!(chunks >= 72, "{round_trip} s: {chunks} chunks in 10 s");
        // More is wanted than this line carries.
        let line = Line {
            rate: 1200.0,
            round_trip,
            size: 2,
            ..LINE
        };
        let (session, from) = (Session::on(line, 70.0), 20.0);
        let used = session.bytes(from, 70.0) / (70.0 - from) / line.rate;
        assert!(
            (0.8..1.05).contains(&used),
            "{round_trip} s: {used} of the line"
        );
    }
}

/// Also one that tells only whether it is ready, and not where its cursor is, as no terminal is known to.
#[test]
fn a_silent_terminal_gets_what_a_slow_line_takes_and_soon_more() {
    for answers in [Answers::None, Answers::Status] {
        let line = Line {
            answers,
            size: 2,
            ..LINE
        };
        let session = Session::on(line, 20.0);
        let first = session.bytes(0.0, 3.0);
        assert!(
            first <= MORE * (FIRST + 3.0 * 300.0 + line.costs()[1]),
            "{first} bytes in 3 s"
        );
        for second in 4..20 {
            let [from, to] = [second, second + 1].map(f64::from);
            let (bytes, chunks) = (session.bytes(from, to), session.sent(from, to).count());
            assert!(
                chunks >= 3 && bytes <= MORE * (2400.0 + 2.0 * line.costs()[1]),
                "{bytes} bytes, {chunks} chunks"
            );
        }
        assert!(session.complete < Some(20.0), "{:?}", session.complete);
    }
}

#[test]
fn a_line_that_was_cut_for_a_while_recovers() {
    for (rate, most) in [(300.0, 3.0), (9600.0, 1.0), (f64::INFINITY, 1.0)] {
        for cut in [8.0, 20.0, 60.0] {
            let answers = Answers::Withheld([10.0, 10.0 + cut]);
            let line = Line {
                rate,
                round_trip: 0.1,
                answers,
                ..LINE
            };
            let session = Session::on(line, cut + 40.0);
            let queue = session.queue(cut + 13.0, cut + 40.0);
            assert!(
                queue < MORE * most,
                "{rate} B/s, {cut} s: {queue} s of queue"
            );
            let chunks = session.sent(cut + 20.0, cut + 40.0).count();
            assert!(chunks > 10, "{rate} B/s, {cut} s: {chunks} chunks in 20 s");
        }
    }
}

#[test]
fn a_line_that_changes_is_measured_anew() {
    for [before, after] in [
        [[f64::INFINITY, 0.05], [600.0, 0.05]],
        [[9600.0, 0.05], [9600.0, 1.0]],
        [[9600.0, 1.0], [9600.0, 0.05]],
        [[600.0, 0.3], [f64::INFINITY, 0.3]],
    ] {
        let [rate, round_trip] = before;
        let line = Line {
            rate,
            round_trip,
            then: Some((30.0, after)),
            ..LINE
        };
        let session = Session::on(line, 70.0);
        let [rate, round_trip] = after;
        let line = Line {
            rate,
            round_trip,
            ..LINE
        };
        let (echo, queue) = (session.echo(42.0, 65.0), session.queue(42.0, 65.0));
        assert!(echo <= MORE * line.echo(), "{before:?} {after:?}: {echo} s");
        assert!(
            queue <= MORE * line.queue()[0],
            "{before:?} {after:?}: {queue} s"
        );
    }
}

/// Over the slowest lines a key comes before the line is empty, time after time.
#[test]
fn keys_do_not_keep_a_slow_line_idle_until_its_round_trip_is_measured() {
    for (rate, round_trip) in [(100.0, 1.64), (110.0, 1.64), (130.0, 1.64), (100.0, 1.2)] {
        let line = Line {
            rate,
            round_trip,
            size: 1,
            ..LINE
        };
        let most = MORE * line.complete();
        let complete = Session::on(line, most).complete;
        assert!(
            complete.is_some(),
            "{rate} B/s, {round_trip} s: not in {most} s"
        );
    }
}
