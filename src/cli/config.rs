//! `$XDG_CONFIG_HOME/mdr-tui/config.toml`: the user's preferences for every session, which the command line overrides.
//! The `config.toml` next to this file documents it and is shown in the guide.

use std::collections::BTreeMap;
use std::path::Path;

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::args::ColorChoice;
use super::complain;
use crate::export::own_directory;
use crate::plot::Marker;
use crate::plot::theme::Look;
use crate::scenario::Refusal;
use crate::scenario::bounded_read::{self, Unread};
use crate::scenario::hint::nearest;
use crate::scenario::typed;
use crate::tui::command::{COMMANDS, Command};
use crate::tui::keys::{Keystroke, parse_script};
use crate::tui::panels::Panel;

/// The preferences; each of them is optional.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Config {
    /// The colours.
    pub theme: Option<Look>,
    /// When to use colour.
    pub color: Option<ColorChoice>,
    /// How curves are drawn.
    pub marker: Option<Marker>,
    /// Maximum frame rate per second.
    #[serde(deserialize_with = "rate")]
    pub fps: Option<u16>,
    /// Whether the explorer uses the mouse.
    pub mouse: Option<bool>,
    /// The panels that come first.
    #[serde(deserialize_with = "panels")]
    pub panels: Vec<Panel>,
    /// Additional keys of commands.
    #[serde(deserialize_with = "keys")]
    pub keys: Vec<(Keystroke, Command)>,
}

/// The largest file to be read, in bytes.
const LARGEST: u64 = 1 << 20;

impl Config {
    /// Reads the user's file; without one, returns empty preferences.
    ///
    /// # Errors
    ///
    /// Names the file and what is wrong in it, in one line: invalid TOML, an unknown key, an invalid value.
    pub fn load() -> Result<Self, Refusal> {
        let Some(directory) = own_directory::config() else {
            return Ok(Self::default());
        };
        let path = directory.join("config.toml");
        match bounded_read::text(&path, LARGEST) {
            Ok(text) => Self::read(&text, &path),
            Err(Unread::Missing) => Ok(Self::default()),
            Err(why @ (Unread::TooLarge(_) | Unread::NotText(_))) => {
                Err(Refusal::new(path.display(), why))
            }
            // Something other than a file at this path is no reason not to start.
            Err(why) => {
                complain(&format!("{}: {why}; goes on without it", path.display()));
                Ok(Self::default())
            }
        }
    }

    fn read(text: &str, path: &Path) -> Result<Self, Refusal> {
        typed::read(text).map_err(|rule| Refusal::new(path.display(), rule))
    }
}

fn rate<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u16>, D::Error> {
    match u16::deserialize(from)? {
        fps @ 1..=120 => Ok(Some(fps)),
        fps => Err(D::Error::custom(format!("{fps}: must be from 1 to 120"))),
    }
}

fn panels<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Panel>, D::Error> {
    let titles = Vec::<String>::deserialize(from)?;
    let panel = |title: &String| {
        Panel::titled(title).ok_or_else(|| {
            let known = Panel::ALL.map(|panel| panel.recipe().title);
            let rule = match nearest(title, known.into_iter()) {
                Some(near) => format!("did you mean {near:?}?"),
                None => format!("known are {}", known.join(", ")),
            };
            D::Error::custom(format!("panels: {title:?} is not a panel; {rule}"))
        })
    };
    titles.iter().map(panel).collect()
}

fn keys<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<(Keystroke, Command)>, D::Error> {
    let written = BTreeMap::<String, String>::deserialize(from)?;
    let bound = written.iter().map(|(name, key)| {
        let keys = parse_script(key);
        let Ok([stroke]) = keys.as_deref() else {
            let rule = "must be one key, such as \"n\" or \"<Enter>\"";
            return Err(format!("keys.{name:?} = {key:?}: {rule}"));
        };
        let Some(row) = COMMANDS.iter().find(|row| row.name == name) else {
            let hint = match nearest(name, COMMANDS.iter().map(|row| row.name)) {
                Some(near) => format!("did you mean {near:?}?"),
                None => "the command palette (:) shows the names".to_owned(),
            };
            return Err(format!("keys: {name:?} is not a command; {hint}"));
        };
        Ok((*stroke, row.command))
    });
    bound.collect::<Result<_, _>>().map_err(D::Error::custom)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Config, String> {
        Config::read(text, Path::new("config.toml")).map_err(|error| error.to_string())
    }

    /// Returns the commented default with its comment signs removed, so that all keys are set.
    fn uncommented() -> String {
        let line = |line: &str| match line.strip_prefix("# ") {
            Some(key) if key.contains(" = ") => format!("{key}\n"),
            _ => format!("{line}\n"),
        };
        include_str!("config.toml").lines().map(line).collect()
    }

    #[test]
    fn the_commented_default_is_a_configuration() {
        assert_eq!(read(include_str!("config.toml")), Ok(Config::default()));
        let all = read(&uncommented()).expect("a configuration");
        assert_eq!(all.theme, Some(Look::Dark));
        assert_eq!(all.color, Some(ColorChoice::Auto));
        assert_eq!(all.marker, Some(Marker::Braille));
        assert_eq!((all.fps, all.mouse), (Some(10), Some(false)));
        assert_eq!(all.panels, [Panel::Stresses, Panel::Section]);
        assert!(
            all.keys
                .contains(&(Keystroke::Char('R'), Command::RunPause))
        );
    }

    #[test]
    fn what_is_wrong_is_said_in_a_line() {
        for (text, said) in [
            (
                "theme = \"green\"",
                "config.toml: line 1: unknown value green; known are dark, light, mono",
            ),
            ("fps = 0", "config.toml: line 1: 0: must be from 1 to 120"),
            (
                "\nthem = 1",
                "config.toml: line 2: unknown key them; did you mean theme?",
            ),
            (
                "panels = [\"stress\"]",
                "config.toml: line 1: panels: \"stress\" is not a panel; did you mean \"stresses\"?",
            ),
            (
                "[keys]\nstep = \"ab\"",
                "config.toml: line 1: keys.\"step\" = \"ab\": must be one key",
            ),
            (
                "[keys]\nstop = \"a\"",
                "config.toml: line 1: keys: \"stop\" is not a command; did you mean \"step\"?",
            ),
        ] {
            let error = read(text).expect_err(text);
            assert!(error.starts_with(said), "{error}");
            assert!(!error.contains('\n'), "{error}");
        }
    }
}
