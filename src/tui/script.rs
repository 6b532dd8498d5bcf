//! `--keys SCRIPT --print SIZE`: the explorer without a terminal, for scripts, tests and pictures.

use std::io::{self, Write};
use std::str::FromStr;
use std::sync::mpsc::{Receiver, Sender, channel};

use anyhow::{Context, Result};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use super::Event;
use super::app::App;
use super::keys::Key;
use super::order::Order;
use super::screen;

/// A size of the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    /// Columns.
    pub columns: u16,
    /// Rows.
    pub rows: u16,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let size = text.split_once(['x', 'X']).and_then(|(columns, rows)| {
            Some(Self {
                columns: columns.parse().ok()?,
                rows: rows.parse().ok()?,
            })
        });
        match size {
            Some(size) if (1..=1000).contains(&size.columns) && (1..=1000).contains(&size.rows) => {
                Ok(size)
            }
            _ => Err("a size is COLUMNSxROWS from 1x1 to 1000x1000, e.g. 80x24".into()),
        }
    }
}

/// Presses the keys one by one, each after the simulation has answered the one before, and prints
/// the last screen.
pub fn play(
    app: &mut App,
    keys: &[Key],
    size: Size,
    orders: &Sender<Order>,
    events: &Receiver<Event>,
) -> Result<()> {
    app.resize(size.columns, size.rows);
    catch_up(app, orders, events)?;
    for key in keys {
        app.press(*key);
        catch_up(app, orders, events)?;
        if app.leave.is_some() {
            break;
        }
    }
    io::stdout().lock().write_all(text(app, size).as_bytes())?;
    Ok(())
}

fn catch_up(app: &mut App, orders: &Sender<Order>, events: &Receiver<Event>) -> Result<()> {
    let (reply, answer) = channel();
    orders
        .send(Order::Sync(reply))
        .context("the simulation has ended")?;
    app.take_frame(answer.recv().context("the simulation has ended")?);
    // The companion is waited for, so that a script always sees its answer.
    while app.awaits_companion() {
        if let Event::Companion(answer) = events.recv().context("the simulation has ended")? {
            app.companion = Some(answer);
        }
    }
    while let Ok(event) = events.try_recv() {
        match event {
            Event::Notice(text) => app.notice = Some(text),
            Event::Companion(answer) => app.companion = Some(answer),
            _ => {}
        }
    }
    Ok(())
}

/// The screen as lines of text, trailing blanks cut.
pub fn text(app: &App, size: Size) -> String {
    let area = Rect::new(0, 0, size.columns, size.rows);
    let mut buffer = Buffer::empty(area);
    screen::draw(app, area, &mut buffer);
    let mut text = String::new();
    for row in area.rows() {
        let mut line = String::new();
        let mut covered = 0;
        for at in row.positions() {
            // A wide character covers the cell behind it.
            if covered > 0 {
                covered -= 1;
                continue;
            }
            let symbol = buffer[at].symbol();
            covered = Line::raw(symbol).width().saturating_sub(1);
            line.push_str(symbol);
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
