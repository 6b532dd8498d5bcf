//! Tours of the presets: captions that say where to look and what to press.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::canvas::Canvas;
use super::panels::Panel;
use crate::plot::theme::Role;

/// The default preset, whose tour begins automatically.
pub const FIRST: &str = "li2019-fig3";

/// One caption of a tour.
#[derive(Debug, Clone, PartialEq, Eq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Caption {
    /// The title of the panel to focus.
    panel: Option<String>,
    /// The text.
    pub text: String,
    /// Whether the panel has a logarithmic scale in this preset, unless the user changes it.
    #[serde(default)]
    log: bool,
}

impl Caption {
    /// Returns the panel to focus.
    pub fn panel(&self) -> Option<Panel> {
        Panel::titled(self.panel.as_deref()?)
    }
}

static TOURS: LazyLock<HashMap<String, Vec<Caption>>> =
    LazyLock::new(|| toml::from_str(include_str!("tours.toml")).expect("tours are TOML"));

/// Returns the captions of a preset; empty for other scenarios.
pub fn captions(origin: &str) -> &'static [Caption] {
    TOURS.get(origin).map_or(&[], Vec::as_slice)
}

/// Returns the panels that a preset shows on a logarithmic scale.
pub fn logarithmic(origin: &str) -> impl Iterator<Item = Panel> {
    let asked = captions(origin).iter().filter(|caption| caption.log);
    asked.filter_map(Caption::panel)
}

/// A tour under way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tour {
    pub(super) origin: &'static str,
    at: usize,
}

impl Tour {
    /// Returns the tour of a scenario by its name; `None` if it has none.
    pub fn for_origin(origin: &str) -> Option<Self> {
        let (origin, _) = TOURS.get_key_value(origin)?;
        Some(Self { origin, at: 0 })
    }

    /// Returns the tour at its next caption; `None` after the last.
    pub fn next(self) -> Option<Self> {
        let at = self.at + 1;
        (at < captions(self.origin).len()).then_some(Self { at, ..self })
    }

    /// Returns the present caption.
    pub fn caption(&self) -> &'static Caption {
        &captions(self.origin)[self.at]
    }

    /// Draws the caption.
    pub fn draw(&self, mut canvas: Canvas) {
        let (at, count) = (self.at + 1, captions(self.origin).len());
        let title = format!("tour {at}/{count} (n next, Esc closes)");
        let text = canvas.printable(&self.caption().text);
        let mut inside = canvas.titled(&title, Role::Notice);
        inside.indented().write(text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::preset;

    #[test]
    fn every_preset_has_a_tour_that_fits_and_names_panels() {
        for preset in preset::ALL {
            let captions = captions(preset.name);
            assert!((2..=6).contains(&captions.len()), "{}", preset.name);
            for caption in captions {
                let length = caption.text.chars().count();
                assert!((40..=148).contains(&length), "{length}: {}", caption.text);
                assert_eq!(
                    caption.panel.is_some(),
                    caption.panel().is_some(),
                    "{caption:?}"
                );
            }
        }
        assert_eq!(TOURS.len(), preset::ALL.len());
        assert_eq!(Tour::for_origin("mine.toml"), None);
    }

    #[test]
    fn a_tour_ends_after_its_last_caption() {
        let mut tour = Tour::for_origin("hertz");
        let mut seen = 0;
        while let Some(now) = tour {
            seen += 1;
            tour = now.next();
        }
        assert_eq!(seen, captions("hertz").len());
    }
}
