//! Flow control: a new frame goes to the terminal only when the last one has been read.
//!
//! Every frame is followed by a status request (DSR, `CSI 5 n`); the answer means that everything
//! before it has been read. A terminal that has never answered may be on a slow line or may not
//! know the request: it is sent no more than a slow line takes, so that the answer to a key never
//! waits behind a queue of frames. Keys are answered at once in any case, as long as little is in
//! flight.

use std::time::{Duration, Instant};

/// The status request after each frame.
pub const QUESTION: &[u8] = b"\x1b[5n";

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
const MOST_UNDER_WAY: u32 = 2;

/// For how long, and for how many frames, the worker's output after a key counts as its answer.
const ANSWERED: Duration = Duration::from_millis(300);
const DRAWINGS: u32 = 2;

/// How long the worker may take to answer a key before a terminal that does not answer is sent a
/// whole screen.
const SETTLED: Duration = Duration::from_millis(50);

/// When to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum When {
    /// At once.
    Now,
    /// Then, unless something happens before.
    At(Instant),
    /// When something has happened.
    Told,
}

/// The state of the line to the terminal.
#[derive(Debug, Default)]
pub struct Flow {
    /// Chunks that the writer has not handed to the system yet.
    unwritten: u32,
    /// Frames that the terminal has not acknowledged yet.
    unanswered: u32,
    /// Whether it has ever answered.
    answers: bool,
    /// When the last frame was sent, and when a terminal that does not answer should have read it.
    sent: Option<(Instant, Instant)>,
    /// When the first frame was sent.
    opened: Option<Instant>,
    /// Bytes of the last frame; the measured rate of the line, bytes per second.
    last: usize,
    rate: Option<f64>,
    /// Until when drawings answer a key, and how many.
    hurry: Option<(Instant, u32)>,
}

impl Flow {
    /// When a drawing may be made.
    pub fn when(&self, now: Instant) -> When {
        if self.unwritten > 0 {
            return When::Told;
        }
        let hurries = self.hurries(now);
        let Some((_, read)) = self.sent else {
            return When::Now;
        };
        let is_free = match self.answers {
            true => self.unanswered == 0 || (hurries && self.unanswered < MOST_UNDER_WAY),
            false => match self.hurry.filter(|_| hurries) {
                Some((until, 1)) if now < until - ANSWERED + SETTLED => {
                    return When::At(until - ANSWERED + SETTLED);
                }
                hurry => hurry.is_some(),
            },
        };
        let give_up = match self.answers {
            true => read + LOST,
            false => read,
        };
        if is_free || now >= give_up {
            When::Now
        } else {
            When::At(give_up)
        }
    }

    /// A key was pressed: its answer takes precedence.
    pub fn hurry(&mut self, now: Instant) {
        self.hurry = Some((now + ANSWERED, DRAWINGS));
    }

    /// Notes that a frame of `bytes` was given to the writer; an empty one changes nothing.
    pub fn sent(&mut self, now: Instant, bytes: usize) {
        if let Some((_, drawings)) = &mut self.hurry {
            *drawings = drawings.saturating_sub(1);
        }
        if bytes == 0 {
            return;
        }
        let takes = Duration::from_secs_f64(bytes as f64 / SLOWEST);
        let rest = match self.answers {
            true => takes,
            false => takes.min(LONGEST_REST),
        };
        self.sent = Some((now, now + rest));
        self.opened.get_or_insert(now);
        self.last = bytes;
        self.unwritten += 1;
        self.unanswered = match self.unanswered {
            // The answers to older ones were lost.
            count if count > MOST_UNDER_WAY => 1,
            count => count + 1,
        };
    }

    /// The writer has handed a chunk to the system.
    pub fn written(&mut self) {
        self.unwritten = self.unwritten.saturating_sub(1);
    }

    /// The terminal has read a frame.
    pub fn answered(&mut self, now: Instant) {
        self.answers = true;
        self.unanswered = self.unanswered.saturating_sub(1);
        if let (0, Some((sent, _))) = (self.unanswered, self.sent) {
            let took = (now - sent).as_secs_f64().max(1e-6);
            self.rate = Some(self.last as f64 / took);
        }
    }

    /// How many bytes the next frame may have, so that it does not keep a key waiting; `None`: as many
    /// as there are.
    pub fn room(&self) -> Option<usize> {
        match self.rate {
            // The next frames show what did not fit into this one.
            Some(rate) if rate >= FAST => None,
            Some(rate) => Some(((rate * FRAME_TIME) as usize).max(SMALLEST)),
            None if self.opened.is_none() => None,
            None => Some(SMALLEST),
        }
    }

    /// Whether the next frame acknowledges a key at once, on a terminal that does not answer: the
    /// worker's answer must not wait behind a whole screen.
    pub fn acknowledges(&self, now: Instant) -> bool {
        !self.answers && self.hurries(now) && self.hurry.is_some_and(|(_, left)| left == DRAWINGS)
    }

    /// Whether a key waits for its answer.
    pub fn hurries(&self, now: Instant) -> bool {
        self.hurry
            .is_some_and(|(until, drawings)| now <= until && drawings > 0)
    }

    /// Whether the terminal answers status requests.
    pub fn answers(&self) -> bool {
        self.answers
    }

    /// Whether an answer is outstanding. One that is late for too long is no longer expected.
    pub fn is_awaited(&self, now: Instant) -> bool {
        let is_new = self
            .opened
            .is_some_and(|opened| now < opened + LONGEST_REST);
        self.unanswered > 0 && (self.answers || is_new)
    }

    /// The terminal was used by another program: outstanding answers will never come.
    pub fn forget(&mut self) {
        (self.unanswered, self.sent) = (0, None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: usize = 250;

    fn sent(flow: &mut Flow, now: Instant) {
        flow.sent(now, FRAME);
        flow.written();
    }

    #[test]
    fn no_frame_is_sent_while_the_last_is_not_gone() {
        let (mut flow, now) = (Flow::default(), Instant::now());
        assert_eq!(flow.when(now), When::Now);
        sent(&mut flow, now);
        flow.answered(now);
        assert_eq!(flow.when(now), When::Now);
        flow.sent(now, FRAME);
        // Not written, then not read.
        assert_eq!(flow.when(now), When::Told);
        flow.written();
        assert!(matches!(flow.when(now), When::At(_)));
        // A key goes first, once.
        flow.hurry(now);
        assert_eq!(flow.when(now), When::Now);
        sent(&mut flow, now);
        assert!(matches!(flow.when(now), When::At(_)));
        flow.answered(now);
        flow.answered(now);
        assert_eq!(flow.when(now), When::Now);
        // Does not wait forever for a lost answer.
        sent(&mut flow, now);
        assert_eq!(flow.when(now + Duration::from_secs(10)), When::Now);
        // An empty drawing needs no answer.
        flow.answered(now);
        flow.sent(now, 0);
        assert_eq!(flow.when(now), When::Now);
    }

    #[test]
    fn a_terminal_that_never_answers_gets_what_a_slow_line_takes() {
        let (mut flow, start) = (Flow::default(), Instant::now());
        let mut bytes = 0;
        for tenth in 0..600 {
            let now = start + Duration::from_millis(100 * tenth);
            if flow.when(now) == When::Now {
                sent(&mut flow, now);
                bytes += FRAME;
            }
        }
        assert!((15_000..=20_000).contains(&bytes), "{bytes}");
        // Keys are answered at once all the same.
        let now = start + Duration::from_secs(60);
        sent(&mut flow, now);
        flow.hurry(now);
        assert_eq!(flow.when(now), When::Now);
    }
}
