//! How the terminal wants to be drawn on: what its variables tell of colours, signs and background.

use crate::plot::Marker;
use crate::plot::theme::{Depth, Look, Theme};

/// The theme of this terminal, unless one was chosen.
pub fn theme_of(marker: Option<Marker>, colored: Option<bool>, look: Option<Look>) -> Theme {
    let no_color = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let colored = colored.unwrap_or(!no_color);
    // The console of Linux has half blocks in its fonts, but no Braille.
    let is_console = std::env::var("TERM").is_ok_and(|term| term == "linux");
    let marker = marker.unwrap_or(match utf8_locale() {
        true if is_console => Marker::HalfBlock,
        true => Marker::Braille,
        false => Marker::Ascii,
    });
    // The console of Linux does not know the question for its background and would print it.
    let follows_background = look.is_none() && colored && !is_console;
    let look = match look {
        _ if !colored => Look::Mono,
        Some(look) => look,
        None if light_background() => Look::Light,
        None => Look::Dark,
    };
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    let depth = Depth::of(&variable("COLORTERM"), &variable("TERM"));
    Theme {
        follows_background,
        ..Theme::new(look, marker).with_depth(depth)
    }
}

/// Whether the terminal says that its background is light: the last number of COLORFGBG.
fn light_background() -> bool {
    let colors = std::env::var("COLORFGBG").unwrap_or_default();
    matches!(colors.rsplit(';').next(), Some("7" | "15"))
}

/// Whether the locale says UTF-8: the first of LC_ALL, LC_CTYPE and LANG that is set decides;
/// without any, the terminal is assumed to be a modern one.
fn utf8_locale() -> bool {
    ["LC_ALL", "LC_CTYPE", "LANG"]
        .iter()
        .find_map(|name| std::env::var(name).ok().filter(|value| !value.is_empty()))
        .is_none_or(|locale| {
            let locale = locale.to_ascii_lowercase();
            locale.contains("utf-8") || locale.contains("utf8")
        })
}
