//! Flow control: sends no more than the line to the terminal carries in a moment, so that a key never waits behind a
//! queue of frames, and keeps a line with a long round trip full.
//!
//! The line is taken to carry `rate` bytes per second; an answer comes `base` seconds after the line has carried its
//! request. Behind each chunk of a frame goes a status request. If it is answered at time t, the line had carried the
//! chunk at t − base, and the chunk before it at `end`: this one took t − base − max(sent, end) seconds, without the
//! round trip, whether the line was idle or not. From the rate and the chunks not yet answered follows for how long the
//! line is busy; the next chunk is sent when that is at most [`DELAY`], and is as large as keeps it so.
//!
//! The round trip is measured by a request of another kind, on an empty line. Its answer also tells where in the queue of
//! requests the terminal is, in case answers were lost. A terminal that does not answer both counts as silent.

use std::collections::VecDeque;

/// How long the line may be busy, seconds: half of a perceptible delay, and longer than usual jitter.
const DELAY: f64 = 0.25;

/// The shortest measurable time, seconds: OpenSSH sends answers on a grid of 20 ms, and radio links jitter.
const TICK: f64 = 0.05;

/// Bytes of the first chunk: the first line and two more rows, 0.8 s at 300 bytes per second.
const FIRST: f64 = 240.0;

/// Minimum bytes of a later chunk: its request, parts of the first and last line, and some 60 of the rest.
const LEAST: f64 = 96.0;

/// The rate assumed until the first answer, bytes per second.
const SLOW: f64 = 300.0;

/// The rate assumed from [`PATIENCE`] seconds on without any answer. Most such terminals are fast; one behind a slower
/// line is held back by the system's own buffers only.
const SILENT: f64 = 2400.0;
const PATIENCE: f64 = 3.0;

/// The weight of earlier measurements of the rate: about four chunks count. Jitter that delays one answer shortens the
/// next measurement, and their sum is exact.
const KEPT: f64 = 0.75;

/// The round trip is measured again after this many seconds and round trips; the line idles for a fifteenth of the
/// time.
const REFRESH: [f64; 2] = [3.0, 15.0];

/// The part of that time after which it is tried again, where a key came before the line was empty.
const AGAIN: f64 = 0.4;

/// How long a key has precedence, seconds.
const HURRY: f64 = 0.3;

/// Maximum delay of an answer before it counts as lost, seconds.
const LOST: f64 = 5.0;

/// Maximum wait for outstanding answers before the terminal is restored, in seconds, in addition to a round trip.
const LAST_ANSWERS: f64 = 0.5;

/// More outstanding answers than any line needs; a silent terminal owes no more.
const MOST_MARKS: usize = 500;

/// The requests to a terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Request {
    /// Whether it is ready (DSR), behind each chunk.
    Status,
    /// Where its cursor is (CPR), sent on an empty line to measure the round trip.
    Place,
}

impl Request {
    /// Returns the escape sequence.
    pub fn text(self) -> &'static str {
        match self {
            Self::Status => "\x1b[5n",
            Self::Place => "\x1b[6n",
        }
    }
}

/// An unanswered request, and the bytes sent up to it since the previous one.
#[derive(Debug, Clone, Copy)]
struct SentRequest {
    sent: f64,
    bytes: f64,
    request: Request,
}

/// The state of the line to the terminal. All times are in seconds since it was opened.
#[derive(Debug, Default)]
pub struct Flow {
    /// Chunks that the writer has not yet passed to the system.
    unwritten: usize,
    marks: VecDeque<SentRequest>,
    /// The shortest round trip, and when one close to it was last measured.
    base: f64,
    confirmed: f64,
    /// Bytes that the line has carried recently, and the time that took.
    carried: Option<[f64; 2]>,
    /// When the terminal last answered.
    heard: Option<f64>,
    /// Until when a key is hurried.
    hurried: f64,
}

impl Flow {
    /// Returns when the line had carried the last answered chunk.
    fn end(&self) -> f64 {
        self.heard.unwrap_or(0.0) - self.base
    }

    /// Returns the estimated rate, bytes per second.
    fn rate(&self, now: f64) -> f64 {
        if self.heard.is_none() {
            return if now < PATIENCE { SLOW } else { SILENT };
        }
        let rate = self.carried.map_or(SLOW, |[bytes, time]| bytes / time);
        // An answer that is late tells as much as one that has come.
        let delay = |oldest: &SentRequest| now - self.base - oldest.sent.max(self.end());
        let oldest = self.marks.front();
        let late = oldest.map(|oldest| (oldest.bytes, delay(oldest)));
        let late = late.filter(|(_, time)| *time > TICK);
        late.map_or(rate, |(bytes, time)| rate.min(bytes / time))
    }

    /// Returns how long the line will be busy with what was sent; negative if it is idle.
    fn wait(&self, now: f64) -> f64 {
        let rate = self.rate(now);
        let carry = |end: f64, mark: &SentRequest| end.max(mark.sent) + mark.bytes / rate;
        self.marks.iter().fold(self.end(), carry) - now
    }

    /// Returns when the outstanding answers count as lost.
    fn lost(&self) -> f64 {
        let Some((oldest, heard)) = self.marks.front().zip(self.heard) else {
            return f64::INFINITY;
        };
        let bytes: f64 = self.marks.iter().map(|mark| mark.bytes).sum();
        oldest.sent.max(heard) + self.base + LOST + bytes / SLOW
    }

    /// Returns the time between measurements of the round trip.
    fn refresh(&self) -> f64 {
        REFRESH[0] + REFRESH[1] * self.base
    }

    /// Whether the round trip should be measured again.
    fn is_old(&self, now: f64) -> bool {
        self.heard.is_some() && now > self.confirmed + self.refresh()
    }

    /// Returns how long to wait before sending a chunk, unless something happens first; `None` while the writer is
    /// busy.
    pub fn delay(&self, now: f64) -> Option<f64> {
        let least = LEAST / self.rate(now);
        let most = if now < self.hurried {
            // Allows one more small chunk than usual.
            DELAY.max(least)
        } else if self.is_old(now) && !self.marks.is_empty() {
            // Waits until the line is empty.
            f64::NEG_INFINITY
        } else {
            // The chunk itself takes at least half of the delay.
            DELAY - least.clamp(DELAY / 2.0, DELAY)
        };
        let delay = (self.wait(now) - most).min(self.lost() - now);
        (self.unwritten == 0).then_some(delay.clamp(0.0, 60.0))
    }

    /// Gives the answer to a key precedence.
    pub fn hurry(&mut self, now: f64) {
        self.hurried = now + HURRY;
    }

    /// Returns the maximum bytes of the next chunk, and whether the round trip is measured before it.
    pub fn room(&mut self, now: f64) -> (usize, bool) {
        if now >= self.lost() {
            self.forget();
        }
        let is_first = self.heard.is_none() && self.marks.len() <= 1;
        let least = if is_first { FIRST } else { LEAST };
        let room = self.rate(now) * (DELAY - self.wait(now).max(0.0));
        let measures = self.is_old(now) && self.marks.is_empty();
        (room.max(least) as usize, measures)
    }

    /// Returns the request that measures the round trip; it must be sent at once.
    pub fn measure(&mut self, now: f64) -> &'static str {
        self.confirmed = now;
        let request = Request::Place;
        self.mark(now, request.text().len(), request);
        request.text()
    }

    /// Notes that the writer received a chunk of this many bytes, including its request.
    pub fn note_sent(&mut self, now: f64, bytes: usize) {
        // An answer to a key was sent while the line was to become empty: keys in a row would keep it idle for long.
        if self.is_old(now) && !self.marks.is_empty() {
            self.confirmed = now - (1.0 - AGAIN) * self.refresh();
        }
        self.unwritten += 1;
        self.mark(now, bytes, Request::Status);
    }

    fn mark(&mut self, sent: f64, bytes: usize, request: Request) {
        let bytes = bytes as f64;
        self.marks.push_back(SentRequest {
            sent,
            bytes,
            request,
        });
        if self.marks.len() > MOST_MARKS {
            self.marks.pop_front();
        }
    }

    /// Notes that the writer has passed a chunk to the system.
    pub fn written(&mut self) {
        self.unwritten = self.unwritten.saturating_sub(1);
    }

    /// Notes an answer of the terminal.
    pub fn answered(&mut self, now: f64, request: Request) {
        let is_place = |mark: &SentRequest| mark.request == Request::Place;
        match (request, self.marks.iter().position(is_place)) {
            // What was asked before will have no answer.
            (Request::Place, Some(place)) => drop(self.marks.drain(..place)),
            // An earlier answer was mistaken for this one.
            (Request::Place, None) => return self.forget(),
            // That is to a chunk from before answers were lost.
            (Request::Status, Some(0)) => return,
            (Request::Status, _) => {}
        }
        let Some(mark) = self.marks.pop_front() else {
            return;
        };
        let (trip, end) = (now - mark.sent, self.end());
        if request == Request::Place || trip < self.base {
            self.base = trip;
        }
        if trip < self.base + 2.0 * TICK {
            self.confirmed = now;
        }
        self.heard = Some(now);
        let took = (now - self.base - mark.sent.max(end)).max(0.0);
        let [bytes, time] = self.carried.unwrap_or([SLOW * TICK, TICK]);
        // A shorter time tells only of a faster line.
        if request == Request::Status && (took > TICK || mark.bytes / TICK > bytes / time) {
            self.carried = Some([bytes * KEPT + mark.bytes, (time * KEPT + took).max(TICK)]);
        }
    }

    /// How long outstanding answers are waited for before the terminal is given back; `None` if there are none, or if it
    /// does not answer.
    pub fn last_answers(&self, now: f64) -> Option<f64> {
        let answers = self.heard.is_some() || now < PATIENCE;
        (answers && !self.marks.is_empty()).then_some(LAST_ANSWERS + self.base.min(PATIENCE))
    }

    /// Gives up on outstanding answers; the line may also be a different one.
    pub fn forget(&mut self) {
        self.marks.clear();
        self.carried = None;
        self.confirmed = f64::NEG_INFINITY;
    }
}
