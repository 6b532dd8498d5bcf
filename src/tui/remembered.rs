//! Remembers the screen for the next time: focus and page, zoom, theme.

use std::io::{Read, Write};
use std::path::Path;

use serde::Deserialize;

use super::explorer::Explorer;
use super::panels::Panel;
use crate::export::safe_open;
use crate::plot::theme::{Look, Theme};

/// The file in the program's directory, and the maximum size to be read.
const FILE: &str = "look.toml";
const LARGEST: u64 = 4096;

/// The state of the screen.
#[derive(Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct Remembered {
    panel: String,
    zoomed: bool,
    /// The theme, if the user chose one with the key.
    theme: Option<Look>,
}

impl Remembered {
    /// Reads the file; returns the initial state if it cannot be read.
    pub fn read(directory: &Path) -> Self {
        let mut text = String::new();
        let file = safe_open::read(&directory.join(FILE)).ok();
        let read = file.and_then(|file| file.take(LARGEST).read_to_string(&mut text).ok());
        read.and_then(|_| toml::from_str(&text).ok())
            .unwrap_or_default()
    }

    /// Returns the state of an explorer on leaving; includes the theme only if the user changed it.
    pub fn new(explorer: &Explorer) -> Self {
        let (stage, theme) = (&explorer.stage, &explorer.theme);
        Self {
            panel: stage.focus.recipe().title.to_owned(),
            zoomed: stage.zoomed,
            theme: explorer.has_chosen_theme.then_some(theme.look),
        }
    }

    /// Writes the file. A failure is ignored: the next time the screen starts in its initial state.
    pub fn write(&self, directory: &Path) {
        let theme = self
            .theme
            .map_or_else(String::new, |look| format!("theme = \"{look}\"\n"));
        let text = format!(
            "panel = {:?}\nzoomed = {}\n{theme}",
            self.panel, self.zoomed
        );
        if let Ok(mut file) = safe_open::open_or_make(&directory.join(FILE)) {
            let _ = file
                .set_len(0)
                .and_then(|()| file.write_all(text.as_bytes()));
        }
    }

    /// Restores the screen. A theme chosen by an option, the configuration or the environment stays.
    pub fn apply(&self, explorer: &mut Explorer) {
        if let Some(panel) = Panel::titled(&self.panel) {
            (explorer.stage.focus, explorer.stage.zoomed) = (panel, self.zoomed);
        }
        let theme = explorer.theme;
        if let Some(look) = self.theme.filter(|_| theme.follows_background) {
            explorer.theme = Theme {
                look,
                follows_background: false,
                ..theme
            };
            explorer.has_chosen_theme = true;
        }
        explorer.show();
    }
}
