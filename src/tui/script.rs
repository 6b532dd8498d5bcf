//! `--keys SCRIPT --print SIZE`: the explorer without a terminal, for scripts and tests.

use std::io::{self, Write};
use std::sync::mpsc::Receiver;

use anyhow::{Context, Result, anyhow};
use ratatui::buffer::Cell;
use ratatui::prelude::*;

use super::app::App;
use super::event::Event;
use super::explorer::Next;
use super::keys::{self, Keystroke};
use super::screen;

/// Reads a size of the screen, `COLUMNSxROWS`.
///
/// # Errors
/// Says what a valid size is.
pub fn parse_size(text: &str) -> Result<Size, String> {
    let size = text.split_once(['x', 'X']).and_then(|(columns, rows)| {
        let within = |count: &u16| (1..=1000).contains(count);
        let columns = columns.parse().ok().filter(within)?;
        Some(Size::new(columns, rows.parse().ok().filter(within)?))
    });
    size.ok_or_else(|| "a size is COLUMNSxROWS from 1x1 to 1000x1000, e.g. 80x24".into())
}

/// Keys to press, and the size at which to print the screen after them.
#[derive(Debug, Clone)]
pub struct Script {
    /// The keys.
    pub strokes: Vec<ScriptStep>,
    /// The size of the screen.
    pub size: Size,
}

/// One action of a script: press a key, paste a text, resize the screen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ScriptStep {
    /// A key.
    Key(Keystroke),
    /// `<paste:TEXT>`
    Paste(String),
    /// `<resize:COLUMNSxROWS>`
    Resize(Size),
}

impl ScriptStep {
    /// Reads a script in the notation of [`keys`], extended by `<paste:TEXT>` and `<resize:80x24>`; an error says what
    /// could not be read.
    pub fn script(script: &str) -> Result<Vec<Self>, String> {
        keys::read(script, Self::Key, |name| match name.split_once(':') {
            Some(("paste", text)) => Some(Self::Paste(text.to_owned())),
            Some(("resize", size)) => parse_size(size).ok().map(Self::Resize),
            _ => Keystroke::of_name(name).map(Self::Key),
        })
    }
}

/// Presses the keys, waiting after each for the simulation's answer, and prints the last screen.
pub fn play(app: &mut App, script: &Script, events: &Receiver<Event>) -> Result<()> {
    crate::failpoint::hit("script");
    let size = press(app, &script.strokes, script.size, events)?;
    io::stdout().lock().write_all(text(app, size).as_bytes())?;
    match &app.explorer.unwritten {
        Some(text) => Err(anyhow!("{text}")),
        None => Ok(()),
    }
}

/// Executes the script, draws the screen after each stroke as a terminal would, and returns the final size.
///
/// # Errors
///
/// If the simulation has ended.
pub fn press(
    app: &mut App,
    strokes: &[ScriptStep],
    mut size: Size,
    events: &Receiver<Event>,
) -> Result<Size> {
    app.explorer.resize(size);
    catch_up(app, events)?;
    for stroke in strokes {
        match stroke {
            ScriptStep::Key(key) => app.press(*key),
            ScriptStep::Paste(text) => app.paste(text),
            ScriptStep::Resize(other) => {
                size = *other;
                app.explorer.resize(size);
            }
        }
        catch_up(app, events)?;
        if matches!(app.explorer.next, Next::Leave | Next::LeaveScreen) {
            break;
        }
        text(app, size);
    }
    Ok(size)
}

fn catch_up(app: &mut App, events: &Receiver<Event>) -> Result<()> {
    let frame = app.explorer.orders.frame();
    let frame = frame.context("the simulation has ended")?;
    app.explorer.show_frame(frame);
    while let Ok(event) = events.try_recv() {
        // A script waits for all points of a study. It has already waited for its frame, so other frames are ignored.
        match &event {
            Event::Sweep(live) => live.finish(),
            Event::Frame(_) => continue,
            _ => {}
        }
        app.handle(event);
    }
    Ok(())
}

/// Returns the character of a cell in plain text. A coloured blank becomes a half block, like a cell with two colours.
/// A blank between words has an ink and stays.
fn sign(cell: &Cell) -> &str {
    match cell.symbol() {
        " " if cell.bg != Color::Reset && cell.fg == Color::Reset => "▀",
        symbol => symbol,
    }
}

/// Returns the screen as lines of text, without trailing blanks.
pub fn text(app: &App, size: Size) -> String {
    let mut buffer = Buffer::empty(size.into());
    screen::draw(app, buffer.area, &mut buffer);
    let mut text = String::new();
    for row in buffer.area.rows() {
        let mut places = row.positions();
        let mut line = String::new();
        while let Some(at) = places.next() {
            let symbol = sign(&buffer[at]);
            line.push_str(symbol);
            // A wide character also covers the next cell.
            for _ in 1..Line::raw(symbol).width() {
                places.next();
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_paste_and_resize() {
        let strokes =
            ScriptStep::script(":<paste:set a=<1><Enter><resize:40x10>q").expect("a script");
        let expected = [
            ScriptStep::Key(Keystroke::Char(':')),
            ScriptStep::Paste("set a=<1".into()),
            ScriptStep::Key(Keystroke::Named(keys::Named::Enter)),
            ScriptStep::Resize(Size::new(40, 10)),
            ScriptStep::Key(Keystroke::Char('q')),
        ];
        assert_eq!(strokes, expected);
        for script in ["<paste:no end", "<resize:0x10>", "a<Nope>", "<resize:"] {
            ScriptStep::script(script).expect_err(script);
        }
    }
}
