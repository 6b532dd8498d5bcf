//! The palette: every command by name, and every scenario key by `set KEY=VALUE`, with completion.

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::layout::Layout;
use ratatui::text::{Line, Span, Text};

use crate::guide::Topic;
use crate::plot::theme::Role;
use crate::scenario::hint::nearest;
use crate::tui::canvas::Canvas;
use crate::tui::command::{Act, COMMANDS, Command, CommandRow};
use crate::tui::completion::{self, Completion};
use crate::tui::explorer::Explorer;
use crate::tui::frame::Frame;
use crate::tui::keys::{Keystroke, Named};
use crate::tui::line::LineEdit;
use crate::tui::overlays::answer::{Answer, select, typing};
use crate::tui::settings::Setting;

/// The line being typed, and the index of the selected completion.
#[derive(Debug, Default)]
pub struct Palette {
    pub(super) line: LineEdit,
    at: usize,
}

/// Returns the completions, most likely first, each with its command if that needs no argument.
fn completions(typed: &str, frame: &Frame) -> Vec<(Completion, Option<Command>)> {
    let typed = typed.trim_start();
    let mut list = Vec::new();
    for row in COMMANDS {
        // Commands that move within lists make no sense by name.
        if matches!(
            row.command,
            Command::Palette | Command::Accept | Command::Back
        ) {
            continue;
        }
        let key = row.key_names().into_iter().next().unwrap_or_default();
        let (line, command) = match row.act {
            Act::Argument(complete) => {
                let argument = typed.strip_prefix(row.name);
                if let Some(argument) = argument.and_then(|rest| rest.strip_prefix(' ')) {
                    let fitting = complete(argument.trim(), frame).into_iter();
                    return fitting.map(|completion| (completion, None)).collect();
                }
                (format!("{} ", row.name), None)
            }
            _ => (row.name.to_owned(), Some(row.command)),
        };
        let completion = Completion::new(line, row.help).with_right(key);
        list.extend(rank(typed, row).map(|rank| (rank, completion, command)));
    }
    // A key of the scenario is also found without `set`.
    if typed.len() >= 2 {
        let changes = completion::set(typed, frame).into_iter();
        list.extend(changes.map(|change| (3, change, None)));
        let sweeps = completion::sweep(typed, frame).into_iter();
        let is_key = !typed.trim_end().contains(' ');
        let sweeps = sweeps.filter(|sweep| is_key && sweep.act.is_none());
        list.extend(sweeps.map(|sweep| (4, sweep, None)));
    }
    list.sort_by_key(|(rank, ..)| *rank);
    let list = list.into_iter();
    list.map(|(_, completion, command)| (completion, command))
        .collect()
}

/// Ranks how `typed` matches: at the start of a name, within it, or by words in keys, name and help.
fn rank(typed: &str, row: &CommandRow) -> Option<usize> {
    let typed = typed.trim_end().to_lowercase();
    let all = format!("{} {} {}", row.key_names().join(" "), row.name, row.help).to_lowercase();
    let position = [
        row.name.starts_with(&typed),
        row.name.contains(&typed),
        typed.split_whitespace().all(|word| all.contains(word)),
    ];
    position.into_iter().position(|fits| fits)
}

impl Palette {
    /// Opens the palette with the beginning of a line.
    pub fn begun(line: &str) -> Self {
        Self {
            line: LineEdit::new(line),
            at: 0,
        }
    }

    /// Opens the palette with the choices of a setting, the present one selected.
    pub fn choosing(setting: &Setting) -> Self {
        let mut words = setting.words().unwrap_or_default().into_iter();
        let now = setting.text();
        let now = words.position(|word| now.as_deref() == Some(word));
        Self {
            at: now.unwrap_or(0),
            ..Self::begun(&format!("set {}=", setting.key.path))
        }
    }

    pub(super) fn press(&mut self, key: Keystroke, explorer: &mut Explorer) -> Answer {
        let mut list = completions(&self.line.text(), &explorer.frame);
        let last = list.len().saturating_sub(1);
        let at = self.at.min(last);
        match (key, list.get_mut(at)) {
            (Keystroke::Named(Named::Esc), _) => return Answer::Close,
            (Keystroke::Named(Named::Backspace), _) if self.line.is_empty() => {
                return Answer::Close;
            }
            (Keystroke::Named(Named::Up | Named::BackTab) | Keystroke::Ctrl('p'), _) => {
                select(&mut self.at, list.len(), Keystroke::Named(Named::Up));
            }
            (Keystroke::Named(Named::Down) | Keystroke::Ctrl('n'), _) => {
                select(&mut self.at, list.len(), Keystroke::Named(Named::Down));
            }
            (Keystroke::Named(Named::Enter), Some((_, Some(command)))) => {
                return Answer::Run(*command);
            }
            (Keystroke::Named(Named::Enter | Named::Tab), Some((selected, _))) => {
                let act = selected.act.take();
                match act.filter(|_| key == Keystroke::Named(Named::Enter)) {
                    Some(act) => {
                        act(explorer);
                        return Answer::Done;
                    }
                    None => *self = Self::begun(&selected.line),
                }
            }
            (Keystroke::Named(Named::Enter), None) => {
                let typed = self.line.text();
                let typed = typed.trim();
                let word = typed.split_whitespace().next().unwrap_or_default();
                let near = nearest(word, COMMANDS.iter().map(|row| row.name));
                let hint = near.map(|name| format!("; did you mean {name}?"));
                let hint = hint.unwrap_or_default();
                explorer.notice = Some(format!("no such command: {typed}{hint}"));
            }
            _ if self.line.press(key) => self.at = 0,
            _ => {}
        }
        Answer::Stay
    }

    pub(super) fn draw(&self, frame: &Frame, mut canvas: Canvas) {
        let found = completions(&self.line.text(), frame);
        let rows = (canvas.area.height / 2).clamp(6, 12);
        let title = "commands (Tab completes, Enter runs, Esc closes)";
        let theme = canvas.theme;
        let mut inside = canvas.docked(title, rows + 3);
        let roles = [Role::Quiet, Role::Focus, Role::Title];
        let [quiet, focus, title] = roles.map(|role| inside.style(role));
        let mut line = typing(" :", &self.line, title);
        let text = self.line.text();
        let key = text.trim_start().strip_prefix("set ");
        let key = key.and_then(|rest| rest.split_once('='));
        if let Some(setting) = key.and_then(|(key, _)| frame.setting(key.trim())) {
            let unit = setting.typed_unit();
            let room = usize::from(inside.area.width).saturating_sub(line.width() + 1);
            line.push_span(Span::styled(
                format!("{:>room$}", inside.printable(&unit)),
                quiet,
            ));
        }
        inside.show(line);
        let [_, below] = Layout::vertical([Length(1), Fill(1)]).areas(inside.area);
        let mut below_line = inside.at(below);
        if found.is_empty() {
            // Who looks for a word of the field finds what it means.
            return match Topic::explanations(&self.line.text()) {
                rows if rows.is_empty() => below_line.write_text("no such command", Role::Quiet),
                rows => below_line
                    .indented()
                    .write(Text::from_iter(rows.into_iter().map(|[name, meaning]| {
                        theme.printable(&format!("{name}: {meaning}"))
                    }))),
            };
        }
        // Completions of a value omit the key, which is visible in the line above.
        let typed = self.line.text();
        let key = typed.rfind('=').map_or("", |at| &typed[..=at]);
        let name = |of: &Completion| of.line.strip_prefix(key).unwrap_or(&of.line).to_owned();
        let lengths = found.iter().map(|(of, _)| name(of).len());
        let longest = lengths.max().unwrap_or(0);
        let line = |(completion, _): &(Completion, Option<Command>)| {
            let name = format!(" {:1$} ", name(completion), longest.min(22));
            let name = Span::raw(name);
            let right = Span::styled(format!(" {} ", completion.right), title);
            let room = usize::from(below.width).saturating_sub(name.width() + right.width());
            let help = Span::styled(format!("{:room$.room$}", completion.help), quiet);
            Line::from(vec![name, help, right])
        };
        let at = self.at.min(found.len() - 1);
        below_line.list(found.iter().map(line), at, focus);
    }
}
