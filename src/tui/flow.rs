//! Flow control: a new frame goes to the terminal only when the last one has been read.
//!
//! Every frame is followed by a status request (DSR, `CSI 5 n`); the answer means that everything
//! before it has been read. A terminal that has never answered may be on a slow line or may not
//! know the request: it is sent no more than a slow line takes, so that the answer to a key never
//! waits behind a queue of frames. Keys are answered at once in any case, as long as little is in
//! flight.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// The status request after each frame.
pub const QUESTION: &str = "\x1b[5n";

/// The rate assumed for any line, bytes per second.
const SLOWEST: f64 = 300.0;

/// The rate from which a line gets whole frames, bytes per second.
const FAST: f64 = 20_000.0;

/// How long a frame may be on its way to the terminal, in seconds, and the fewest bytes of one.
const FRAME_TIME: f64 = 0.4;
const SMALLEST: usize = 240;

/// Longest pause after a frame for a terminal that does not answer.
const LONGEST_REST: Duration = Duration::from_secs(2);

/// An answer is lost if it takes longer than the frame on the slowest line plus this.
const LOST: Duration = Duration::from_secs(3);

/// Maximum number of frames in flight when a key is answered.
const MOST_UNDER_WAY: usize = 2;

/// Answers that come within this time may have waited for each other.
const TOGETHER: Duration = Duration::from_millis(5);

/// For how long, and for how many frames, the worker's output after a key counts as its answer.
const ANSWERED: Duration = Duration::from_millis(300);
const DRAWINGS: u32 = 2;

/// How long the worker may take to answer a key before a terminal that does not answer is sent a
/// whole screen.
const SETTLED: Duration = Duration::from_millis(50);

/// The state of the line to the terminal.
#[derive(Debug, Default)]
pub struct Flow {
    /// Chunks that the writer has not handed to the system yet.
    unwritten: usize,
    /// When the frames that the terminal has not acknowledged were sent, and their bytes.
    unanswered: VecDeque<(Instant, usize)>,
    /// When it last answered; none if it never has.
    answered: Option<Instant>,
    /// When all that was sent should have been read.
    read: Option<Instant>,
    /// When the first frame was sent.
    opened: Option<Instant>,
    /// The measured rate of the line, bytes per second.
    rate: Option<f64>,
    /// Until when drawings answer a key, and how many.
    hurry: Option<(Instant, u32)>,
}

impl Flow {
    /// From when on a drawing may be made, unless something happens before; `None` while the writer is busy.
    pub fn when(&self, now: Instant) -> Option<Instant> {
        if self.unwritten > 0 {
            return None;
        }
        let hurries = self.hurries(now);
        let most = if hurries { MOST_UNDER_WAY } else { 1 };
        let is_free = match self.hurry.filter(|_| hurries) {
            _ if self.answers() => self.unanswered.len() < most,
            Some((until, 1)) => return Some(until - ANSWERED + SETTLED),
            hurry => hurry.is_some(),
        };
        let give_up = self.give_up().filter(|_| !is_free);
        Some(give_up.unwrap_or(now))
    }

    /// From when on an answer that has not come is taken for lost; none if nothing was sent.
    fn give_up(&self) -> Option<Instant> {
        let patience = if self.answers() { LOST } else { Duration::ZERO };
        self.read.map(|read| read + patience)
    }

    /// A key was pressed: its answer takes precedence.
    pub fn hurry(&mut self, now: Instant) {
        self.hurry = Some((now + ANSWERED, DRAWINGS));
    }

    /// Notes that the writer was given a drawing of `bytes` in all, in this many frames. An empty one changes nothing.
    pub fn sent(&mut self, now: Instant, bytes: usize, frames: usize) {
        if let Some((_, drawings)) = &mut self.hurry {
            *drawings = drawings.saturating_sub(1);
        }
        if bytes == 0 {
            return;
        }
        if self.give_up().is_some_and(|give_up| now >= give_up) {
            // The answers to older ones were lost.
            self.unanswered.clear();
        }
        let takes = Duration::from_secs_f64(bytes as f64 / SLOWEST);
        self.read = Some(match (self.answers(), self.read) {
            // It is read behind what is on the line.
            (true, Some(before)) if !self.unanswered.is_empty() => before.max(now) + takes,
            (true, _) => now + takes,
            (false, _) => now + takes.min(LONGEST_REST),
        });
        self.opened.get_or_insert(now);
        self.unwritten += frames;
        for _ in 0..frames {
            self.unanswered.push_back((now, bytes / frames));
        }
    }

    /// The writer has handed a chunk to the system.
    pub fn written(&mut self) {
        self.unwritten = self.unwritten.saturating_sub(1);
    }

    /// The terminal has read a frame.
    pub fn answered(&mut self, now: Instant) {
        let before = self.answered.replace(now);
        let Some((sent, bytes)) = self.unanswered.pop_front() else {
            return;
        };
        // Before that, the line was busy with another frame.
        let free = before.map_or(sent, |before| before.max(sent));
        let took = now - free;
        // Two answers that are read at once tell nothing of the second frame.
        if free == sent || took > TOGETHER {
            self.rate = Some(bytes as f64 / took.as_secs_f64().max(1e-6));
        }
    }

    /// How many bytes the next frame may have, so that it does not keep a key waiting; `None`: as many
    /// as there are.
    pub fn room(&self, now: Instant) -> Option<usize> {
        // A frame that is long on its way tells of the line before its answer does.
        let oldest = self.unanswered.front();
        let most = oldest.map(|&(sent, bytes)| bytes as f64 / (now - sent).as_secs_f64());
        match self.rate.map(|rate| rate.min(most.unwrap_or(rate))) {
            // The next frames show what did not fit into this one.
            Some(rate) if rate >= FAST => None,
            Some(rate) => Some(((rate * FRAME_TIME) as usize).max(SMALLEST)),
            // Nothing is known of the line yet: the first frame measures it.
            None => Some(SMALLEST),
        }
    }

    /// Whether the next frame acknowledges a key at once, on a terminal that does not answer: the
    /// worker's answer must not wait behind a whole screen.
    pub fn acknowledges(&self, now: Instant) -> bool {
        !self.answers() && self.hurries(now) && self.hurry.is_some_and(|(_, left)| left == DRAWINGS)
    }

    /// Whether a key waits for its answer.
    pub fn hurries(&self, now: Instant) -> bool {
        self.hurry
            .is_some_and(|(until, drawings)| now <= until && drawings > 0)
    }

    /// Whether the terminal answers status requests.
    pub fn answers(&self) -> bool {
        self.answered.is_some()
    }

    /// Whether an answer is outstanding. One that is late for too long is no longer expected.
    pub fn is_awaited(&self, now: Instant) -> bool {
        let new = self.opened.filter(|opened| now < *opened + LONGEST_REST);
        !self.unanswered.is_empty() && (self.answers() || new.is_some())
    }

    /// The terminal was used by another program: outstanding answers will never come.
    pub fn forget(&mut self) {
        self.unanswered.clear();
        self.read = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: usize = 250;

    fn sent(flow: &mut Flow, now: Instant) {
        flow.sent(now, FRAME, 1);
        flow.written();
    }

    fn is_free(flow: &Flow, now: Instant) -> bool {
        flow.when(now).is_some_and(|then| then <= now)
    }

    #[test]
    fn no_frame_is_sent_while_the_last_is_not_gone() {
        let (mut flow, now) = (Flow::default(), Instant::now());
        assert!(is_free(&flow, now));
        sent(&mut flow, now);
        flow.answered(now);
        assert!(is_free(&flow, now));
        flow.sent(now, FRAME, 1);
        // Not written, then not read.
        assert_eq!(flow.when(now), None);
        flow.written();
        assert!(flow.when(now).is_some_and(|then| then > now));
        // A key goes first, once.
        flow.hurry(now);
        assert!(is_free(&flow, now));
        sent(&mut flow, now);
        assert!(flow.when(now).is_some_and(|then| then > now));
        flow.answered(now);
        flow.answered(now);
        assert!(is_free(&flow, now));
        // Does not wait forever for a lost answer.
        sent(&mut flow, now);
        assert!(is_free(&flow, now + Duration::from_secs(10)));
        // An empty drawing needs no answer.
        flow.answered(now);
        flow.sent(now, 0, 0);
        assert!(is_free(&flow, now));
    }

    #[test]
    fn a_terminal_that_never_answers_gets_what_a_slow_line_takes() {
        let (mut flow, start) = (Flow::default(), Instant::now());
        let mut bytes = 0;
        for tenth in 0..600 {
            let now = start + Duration::from_millis(100 * tenth);
            if is_free(&flow, now) {
                sent(&mut flow, now);
                bytes += FRAME;
            }
        }
        assert!((15_000..=20_000).contains(&bytes), "{bytes}");
        // Keys are answered at once all the same.
        let now = start + Duration::from_secs(60);
        sent(&mut flow, now);
        flow.hurry(now);
        assert!(is_free(&flow, now));
    }
    /// However many keys are pressed before the line is ever free.
    #[test]
    fn a_line_that_becomes_slow_is_noticed_under_keys() {
        let (mut flow, start) = (Flow::default(), Instant::now());
        let at = |seconds| start + Duration::from_secs_f64(seconds);
        flow.sent(start, 4000, 1);
        flow.written();
        flow.answered(at(0.001));
        assert_eq!(flow.room(at(0.1)), None);
        // From now on a line of 600 bytes a second, on which 3,000 are under way.
        flow.sent(at(0.1), 3000, 1);
        flow.written();
        let mut seconds = 4.0;
        for _ in 0..20 {
            flow.hurry(at(seconds));
            assert!(is_free(&flow, at(seconds)));
            let room = flow.room(at(seconds)).expect("a slow line");
            assert!((240..400).contains(&room), "{room}");
            flow.sent(at(seconds), room, 1);
            flow.written();
            // The one before is read only now, and no key is answered before the line is free again.
            assert!(!is_free(&flow, at(seconds + 1.0)));
            seconds = seconds.max(5.1) + room as f64 / 600.0;
            flow.answered(at(seconds));
        }
    }
}
